// What transmissions and their handles throw.
#pragma once

#include <exception>
#include <string>

namespace transmission_interface
{

class TransmissionInterfaceException : public std::exception
{
public:
  TransmissionInterfaceException(const std::string& message) : message_(message) {}
  const char* what() const noexcept override { return message_.c_str(); }

private:
  std::string message_;
};

}  // namespace transmission_interface
