// Numbers and lists of parameters.
#pragma once

#include <xmlrpcpp/XmlRpc.h>

#include <string>
#include <vector>

namespace moveit
{
namespace core
{
// A number, whole or not; throws XmlRpcException for anything else.
double parseDouble(const XmlRpc::XmlRpcValue& v);

// Is it an array of `size` members (0: any number) whose names are given? With a name, what is wrong is logged.
bool isArray(const XmlRpc::XmlRpcValue& v, size_t size = 0, const std::string& name = "", const std::string& description = "");

// Is it a struct with these members?
bool isStruct(const XmlRpc::XmlRpcValue& v, const std::vector<std::string>& keys = {}, const std::string& name = "");
}  // namespace core
}  // namespace moveit
