#pragma once
#include <any>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <sdf/Param.hh>
#include <sdf/Types.hh>

namespace sdf
{
inline namespace v12
{

namespace internal
{
struct Description;
}

/// An element with attributes, children and perhaps a value. Those that the format describes know their defaults, and make described
/// children on demand; below <plugin>, and below all that is not described, there is what the file says.
class SDFORMAT_VISIBLE Element : public std::enable_shared_from_this<Element>
{
public:
  Element() = default;
  virtual ~Element() = default;
  Element(const Element&) = delete;
  Element& operator=(const Element&) = delete;

  ElementPtr Clone() const;
  void Copy(const ElementPtr element);
  ElementPtr GetParent() const;  // in the library, whose name tells what a plugin asks for (core/loader.cpp)
  void SetParent(const ElementPtr parent) { parent_ = parent; }
  void SetName(const std::string& name) { name_ = name; }
  const std::string& GetName() const { return name_; }
  void SetRequired(const std::string& required) { required_ = required; }
  const std::string& GetRequired() const { return required_; }
  void SetExplicitlySetInFile(bool value);
  bool GetExplicitlySetInFile() const { return explicit_; }
  void SetCopyChildren(bool value) { copy_children_ = value; }
  bool GetCopyChildren() const { return copy_children_; }
  void SetReferenceSDF(const std::string& value) { reference_ = value; }
  std::string ReferenceSDF() const { return reference_; }
  std::string GetDescription() const { return description_text_; }
  void SetDescription(const std::string& text) { description_text_ = text; }
  void SetFilePath(const std::string& path) { path_ = path; }
  const std::string& FilePath() const { return path_; }
  void SetLineNumber(int line) { line_ = line; }
  std::optional<int> LineNumber() const { return line_; }
  void SetOriginalVersion(const std::string& version) { version_ = version; }
  const std::string& OriginalVersion() const { return version_; }
  std::string ToString(const std::string& prefix) const;
  void PrintValues(std::string prefix) const;

  void AddAttribute(const std::string& key, const std::string& type, const std::string& fallback, bool required,
                    const std::string& description = "");
  void AddValue(const std::string& type, const std::string& fallback, bool required, const std::string& description = "");
  ParamPtr GetAttribute(const std::string& key) const;
  ParamPtr GetAttribute(unsigned int index) const { return index < attributes_.size() ? attributes_[index] : ParamPtr(); }
  const Param_V& GetAttributes() const { return attributes_; }
  std::size_t GetAttributeCount() const { return attributes_.size(); }
  bool HasAttribute(const std::string& key) const { return GetAttribute(key) != nullptr; }
  bool GetAttributeSet(const std::string& key) const;
  void RemoveAttribute(const std::string& key);
  void RemoveAllAttributes() { attributes_.clear(); }
  ParamPtr GetValue() const { return value_; }
  std::any GetAny(const std::string& key = "") const;

  /// Of an attribute or a child with this name; without a name, the own value. What is not there is the type's default.
  template <typename T>
  T Get(const std::string& key = "") const
  {
    return Get<T>(key, T()).first;
  }
  /// With whether it was there.
  template <typename T>
  std::pair<T, bool> Get(const std::string& key, const T& fallback) const
  {
    std::pair<T, bool> result(fallback, true);
    if (key.empty())
      result.second = value_ && value_->Get<T>(result.first);
    else if (const ParamPtr attribute = GetAttribute(key))
      attribute->Get<T>(result.first);
    else if (HasElement(key))
      result.first = GetElementImpl(key)->Get<T>();
    else if (HasElementDescription(key))
      result.first = GetElementDescription(key)->Get<T>();
    else
      result.second = false;
    return result;
  }
  template <typename T>
  bool Get(const std::string& key, T& value, const T& fallback) const
  {
    const std::pair<T, bool> result = Get<T>(key, fallback);
    value = result.first;
    return result.second;
  }
  template <typename T>
  bool Set(const T& value)
  {
    return value_ && value_->Set(value);
  }

  bool HasElement(const std::string& name) const { return GetElementImpl(name) != nullptr; }
  ElementPtr GetFirstElement() const { return elements_.empty() ? ElementPtr() : elements_.front(); }
  ElementPtr GetNextElement(const std::string& name = "") const;
  std::set<std::string> GetElementTypeNames() const;
  /// How many children of a kind (of all) have which name.
  std::map<std::string, std::size_t> CountNamedElements(
      const std::string& type = "", const std::vector<std::string>& ignored = std::vector<std::string>()) const;
  bool HasUniqueChildNames(const std::string& type = "") const;
  /// A described child that is not there is made; of others there is none.
  ElementPtr GetElement(const std::string& name);
  ElementPtr FindElement(const std::string& name) { return GetElementImpl(name); }
  ElementConstPtr FindElement(const std::string& name) const { return GetElementImpl(name); }
  ElementPtr GetElementImpl(const std::string& name) const;
  ElementPtr AddElement(const std::string& name);
  void InsertElement(ElementPtr element) { elements_.push_back(element); }
  void InsertElement(ElementPtr element, bool becomes_parent);
  void RemoveFromParent();
  void RemoveChild(ElementPtr child);
  void ClearElements();
  void Clear();
  void Update();
  void Reset();

  bool HasElementDescription(const std::string& name) const { return GetElementDescription(name) != nullptr; }
  ElementPtr GetElementDescription(const std::string& name) const;
  void AddElementDescription(ElementPtr element) { descriptions_.push_back(element); }

  /// By the name in the format's description; for the parser.
  void Describe(const internal::Description* description);
  const internal::Description* Described() const { return described_; }

private:
  void print(const std::string& prefix, std::ostream& out) const;

  std::string name_, required_, reference_, description_text_, path_, version_;
  bool copy_children_ = false, explicit_ = true;
  std::optional<int> line_;
  ElementWeakPtr parent_;
  Param_V attributes_;
  ParamPtr value_;
  ElementPtr_V elements_, descriptions_;
  const internal::Description* described_ = nullptr;
};

}  // namespace v12
}  // namespace sdf
