#include <sdf/Element.hh>

#include <algorithm>
#include <iostream>

#include "schema.hpp"

namespace sdf
{
inline namespace v12
{
namespace
{

std::string escaped(const std::string& text)
{
  std::string result;
  for (const char each : text)
    switch (each)
    {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '\'':
        result += "&apos;";
        break;
      default:
        result += each;
    }
  return result;
}

}  // namespace

void Element::Describe(const internal::Description* description)
{
  described_ = description;
  name_ = description->name;
  required_ = description->required ? "1" : "0";
  for (const auto& each : description->attributes)
    if (!HasAttribute(each.name))
      AddAttribute(each.name, each.type, each.fallback, each.required);
  if (!description->type.empty() && !value_)
    AddValue(description->type, description->fallback, false);
}

ElementPtr Element::GetParent() const { return parent_.lock(); }

ElementPtr Element::Clone() const
{
  const ElementPtr clone = std::make_shared<Element>();
  clone->name_ = name_;
  clone->required_ = required_;
  clone->reference_ = reference_;
  clone->description_text_ = description_text_;
  clone->path_ = path_;
  clone->version_ = version_;
  clone->line_ = line_;
  clone->copy_children_ = copy_children_;
  clone->explicit_ = explicit_;
  clone->described_ = described_;
  clone->descriptions_ = descriptions_;
  for (const ParamPtr& each : attributes_)
  {
    clone->attributes_.push_back(each->Clone());
    clone->attributes_.back()->SetParentElement(clone);
  }
  for (const ElementPtr& each : elements_)
  {
    clone->elements_.push_back(each->Clone());
    clone->elements_.back()->parent_ = clone;
  }
  if (value_)
  {
    clone->value_ = value_->Clone();
    clone->value_->SetParentElement(clone);
  }
  return clone;
}

void Element::Copy(const ElementPtr element)
{
  const ElementPtr clone = element->Clone();
  name_ = clone->name_;
  required_ = clone->required_;
  reference_ = clone->reference_;
  description_text_ = clone->description_text_;
  path_ = clone->path_;
  version_ = clone->version_;
  line_ = clone->line_;
  copy_children_ = clone->copy_children_;
  explicit_ = clone->explicit_;
  described_ = clone->described_;
  descriptions_ = clone->descriptions_;
  attributes_ = clone->attributes_;
  value_ = clone->value_;
  elements_ = clone->elements_;
  for (const ElementPtr& each : elements_)
    each->parent_ = weak_from_this();
}

void Element::SetExplicitlySetInFile(bool value)
{
  explicit_ = value;
  for (const ElementPtr& each : elements_)
    each->SetExplicitlySetInFile(value);
}

void Element::print(const std::string& prefix, std::ostream& out) const
{
  out << prefix << "<" << name_;
  for (const ParamPtr& each : attributes_)
    if (each->GetSet() || each->GetRequired())
      out << " " << each->GetKey() << "='" << escaped(each->GetAsString()) << "'";
  if (!elements_.empty())
  {
    out << ">\n";
    for (const ElementPtr& each : elements_)
      each->print(prefix + "  ", out);
    out << prefix << "</" << name_ << ">\n";
  }
  else if (value_)
    out << ">" << escaped(value_->GetAsString()) << "</" << name_ << ">\n";
  else
    out << "/>\n";
}

std::string Element::ToString(const std::string& prefix) const
{
  std::ostringstream out;
  print(prefix, out);
  return out.str();
}

void Element::PrintValues(std::string prefix) const { print(prefix, std::cout); }

void Element::AddAttribute(const std::string& key, const std::string& type, const std::string& fallback, bool required,
                           const std::string& description)
{
  attributes_.push_back(std::make_shared<Param>(key, type, fallback, required, description));
  attributes_.back()->SetParentElement(weak_from_this().lock());
}

void Element::AddValue(const std::string& type, const std::string& fallback, bool required, const std::string& description)
{
  value_ = std::make_shared<Param>(name_, type, fallback, required, description);
  value_->SetParentElement(weak_from_this().lock());
}

ParamPtr Element::GetAttribute(const std::string& key) const
{
  for (const ParamPtr& each : attributes_)
    if (each->GetKey() == key)
      return each;
  return ParamPtr();
}

bool Element::GetAttributeSet(const std::string& key) const
{
  const ParamPtr found = GetAttribute(key);
  return found && found->GetSet();
}

void Element::RemoveAttribute(const std::string& key)
{
  attributes_.erase(std::remove(attributes_.begin(), attributes_.end(), GetAttribute(key)), attributes_.end());
}

std::any Element::GetAny(const std::string& key) const
{
  const ElementPtr child = key.empty() ? ElementPtr() : GetElementImpl(key);
  const ParamPtr param = key.empty() ? value_ : GetAttribute(key) ? GetAttribute(key) : child ? child->GetValue() : ParamPtr();
  std::any result;
  if (!param || !param->GetAny(result))
    sdferr << "There is no value of element [" << name_ << "] for key [" << key << "].\n";
  return result;
}

ElementPtr Element::GetNextElement(const std::string& name) const
{
  const ElementPtr parent = parent_.lock();
  if (!parent)
    return ElementPtr();
  const auto& all = parent->elements_;
  auto at = std::find_if(all.begin(), all.end(), [this](const ElementPtr& each) { return each.get() == this; });
  if (at == all.end())
    return ElementPtr();
  for (++at; at != all.end(); ++at)
    if (name.empty() || (*at)->GetName() == name)
      return *at;
  return ElementPtr();
}

std::set<std::string> Element::GetElementTypeNames() const
{
  std::set<std::string> names;
  for (const ElementPtr& each : elements_)
    names.insert(each->GetName());
  return names;
}

std::map<std::string, std::size_t> Element::CountNamedElements(const std::string& type,
                                                               const std::vector<std::string>& ignored) const
{
  std::map<std::string, std::size_t> counts;
  for (const ElementPtr& each : elements_)
    if ((type.empty() || each->GetName() == type) &&
        std::find(ignored.begin(), ignored.end(), each->GetName()) == ignored.end() && each->HasAttribute("name"))
      ++counts[each->Get<std::string>("name")];
  return counts;
}

bool Element::HasUniqueChildNames(const std::string& type) const
{
  for (const auto& each : CountNamedElements(type))
    if (each.second > 1)
      return false;
  return true;
}

ElementPtr Element::GetElementImpl(const std::string& name) const
{
  for (const ElementPtr& each : elements_)
    if (each->GetName() == name)
      return each;
  return ElementPtr();
}

ElementPtr Element::GetElement(const std::string& name)
{
  const ElementPtr found = GetElementImpl(name);
  return found ? found : AddElement(name);
}

ElementPtr Element::GetElementDescription(const std::string& name) const
{
  for (const ElementPtr& each : descriptions_)
    if (each->GetName() == name)
      return each;
  const internal::Description* const child = described_ ? described_->child(name) : nullptr;
  if (!child)
    return ElementPtr();
  const ElementPtr element = std::make_shared<Element>();
  element->Describe(child);
  return element;
}

ElementPtr Element::AddElement(const std::string& name)
{
  const ElementPtr pattern = GetElementDescription(name);
  if (!pattern)
  {
    sdferr << "Missing element description for [" << name << "] in [" << name_ << "]: ask HasElement first.\n";
    return ElementPtr();
  }
  const ElementPtr element = pattern->Clone();
  element->SetExplicitlySetInFile(false);
  InsertElement(element, true);
  if (element->described_)
    for (const internal::Description* each : element->described_->children)
      if (each->required)
        element->AddElement(each->name);
  return element;
}

void Element::InsertElement(ElementPtr element, bool becomes_parent)
{
  if (becomes_parent)
    element->SetParent(shared_from_this());
  elements_.push_back(element);
}

void Element::RemoveFromParent()
{
  if (const ElementPtr parent = parent_.lock())
    parent->RemoveChild(shared_from_this());
}

void Element::RemoveChild(ElementPtr child)
{
  const auto at = std::find(elements_.begin(), elements_.end(), child);
  if (at == elements_.end())
    return;
  elements_.erase(at);
  child->parent_.reset();
}

void Element::ClearElements()
{
  for (const ElementPtr& each : elements_)
    each->ClearElements();
  elements_.clear();
}

void Element::Clear()
{
  ClearElements();
  descriptions_.clear();
  attributes_.clear();
  parent_.reset();
  value_.reset();
  path_.clear();
  version_.clear();
}

void Element::Update()
{
  for (const ParamPtr& each : attributes_)
    each->Update();
  for (const ElementPtr& each : elements_)
    each->Update();
  if (value_)
    value_->Update();
}

void Element::Reset()
{
  ClearElements();
  descriptions_.clear();
  value_.reset();
  parent_.reset();
}

}  // namespace v12
}  // namespace sdf
