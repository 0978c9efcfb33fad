#pragma once
#include <memory>
#include <string>
#include <vector>

namespace sdf
{
inline namespace v12
{
namespace internal
{

/// What the format says of an element.
struct Description
{
  struct Attribute
  {
    std::string name, type, fallback;
    bool required;
  };
  std::string name, type, fallback;
  bool required = false;
  std::vector<Attribute> attributes;
  std::vector<const Description*> children;

  const Description* child(const std::string& tag) const;
};

/// :return: nothing where the format has no such element
const Description* described(const std::string& name);

}  // namespace internal
}  // namespace v12
}  // namespace sdf
