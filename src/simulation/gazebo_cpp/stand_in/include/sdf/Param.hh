#pragma once
#include <algorithm>
#include <any>
#include <cstdint>
#include <functional>
#include <iomanip>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include <ignition/math/Angle.hh>
#include <ignition/math/Color.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector2.hh>
#include <ignition/math/Vector3.hh>

#include <sdf/Console.hh>
#include <sdf/Types.hh>

namespace sdf
{
inline namespace v12
{

class Element;
class Param;
typedef std::shared_ptr<Element> ElementPtr;
typedef std::shared_ptr<const Element> ElementConstPtr;
typedef std::weak_ptr<Element> ElementWeakPtr;
typedef std::vector<ElementPtr> ElementPtr_V;
typedef std::shared_ptr<Param> ParamPtr;
typedef std::vector<ParamPtr> Param_V;

namespace internal
{

// What is no value of the type leaves it alone, and returns false; key is for the message.
bool SDFORMAT_VISIBLE parse(const std::string& key, const std::string& text, std::string& value);
bool SDFORMAT_VISIBLE parse(const std::string& key, const std::string& text, bool& value);
bool SDFORMAT_VISIBLE parse(const std::string& key, const std::string& text, char& value);
bool SDFORMAT_VISIBLE parse(const std::string& key, const std::string& text, int& value);
bool SDFORMAT_VISIBLE parse(const std::string& key, const std::string& text, unsigned int& value);
bool SDFORMAT_VISIBLE parse(const std::string& key, const std::string& text, std::uint64_t& value);
bool SDFORMAT_VISIBLE parse(const std::string& key, const std::string& text, double& value);
bool SDFORMAT_VISIBLE parse(const std::string& key, const std::string& text, float& value);
bool SDFORMAT_VISIBLE parse(const std::string& key, const std::string& text, ignition::math::Pose3d& value);
bool SDFORMAT_VISIBLE parse(const std::string& key, const std::string& text, ignition::math::Color& value);
void SDFORMAT_VISIBLE report(const std::string& key, const std::string& text);

template <typename T>
bool parse(const std::string& key, const std::string& text, T& value)
{
  std::istringstream in(text);
  T read{};
  in >> read;
  if (in.fail())
  {
    report(key, text);
    return false;
  }
  value = read;
  return true;
}

/// Whether text is a value of a type that descriptions name.
bool SDFORMAT_VISIBLE valid(const std::string& key, const std::string& type, const std::string& text);
std::string SDFORMAT_VISIBLE name_of(const std::type_info& type);

}  // namespace internal

/// A value, kept as its text, with the type that it was described as.
class SDFORMAT_VISIBLE Param
{
public:
  Param(const std::string& key, const std::string& type, const std::string& fallback, bool required,
        const std::string& description = "");
  Param(const std::string& key, const std::string& type, const std::string& fallback, bool required, const std::string& minimum,
        const std::string& maximum, const std::string& description = "");
  Param(const Param& other) = default;
  Param& operator=(const Param& other) = default;
  virtual ~Param() = default;

  std::string GetAsString() const { return text_; }
  std::string GetDefaultAsString() const { return fallback_; }
  bool SetFromString(const std::string& text);
  bool SetFromString(const std::string& text, bool) { return SetFromString(text); }
  ElementPtr GetParentElement() const { return parent_.lock(); }
  bool SetParentElement(ElementPtr parent)
  {
    parent_ = parent;
    return true;
  }
  void Reset()
  {
    text_ = fallback_;
    set_ = false;
  }
  const std::string& GetKey() const { return key_; }
  const std::string& GetTypeName() const { return type_; }
  template <typename T>
  bool IsType() const
  {
    return internal::name_of(typeid(T)) == type_;
  }
  bool GetRequired() const { return required_; }
  bool GetSet() const { return set_; }
  ParamPtr Clone() const { return std::make_shared<Param>(*this); }
  std::string GetDescription() const { return description_; }
  void SetDescription(const std::string& text) { description_ = text; }
  /// Asked for its value by Update().
  template <typename F>
  void SetUpdateFunc(F function)
  {
    update_ = [function](Param& self) { self.Set(function()); };
  }
  void Update()
  {
    if (update_)
      update_(*this);
  }

  template <typename T>
  bool Set(const T& value)
  {
    std::ostringstream out;
    if constexpr (std::is_floating_point<T>::value)
      out << std::setprecision(std::numeric_limits<T>::max_digits10);
    out << value;
    return SetFromString(out.str());
  }
  template <typename T>
  bool Get(T& value) const
  {
    return internal::parse(key_, text_, value);
  }
  bool GetAny(std::any& value) const;
  template <typename T>
  bool GetDefault(T& value) const
  {
    return internal::parse(key_, fallback_, value);
  }
  bool ValidateValue() const { return internal::valid(key_, type_, text_); }
  friend std::ostream& operator<<(std::ostream& out, const Param& param) { return out << param.text_; }

private:
  std::string key_, type_, fallback_, text_, description_;
  bool required_ = false, set_ = false;
  ElementWeakPtr parent_;
  std::function<void(Param&)> update_;
};

}  // namespace v12
}  // namespace sdf
