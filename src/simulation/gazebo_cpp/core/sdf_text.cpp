#include "sdf_text.hpp"

#include <mutex>

namespace gazebo
{
namespace
{

sdf::ElementPtr read(const std::string& text)
{
  static std::mutex mutex;  // the parser has global state
  const std::lock_guard<std::mutex> lock(mutex);
  static const sdf::SDFPtr empty = [] {
    sdf::SDFPtr made(new sdf::SDF());
    sdf::init(made);  // reads sdformat's descriptions of all elements: 60 ms
    return made;
  }();
  sdf::SDFPtr document(new sdf::SDF());
  document->Root(empty->Root()->Clone());
  sdf::Errors errors;
  sdf::Console::Instance()->SetQuiet(true);  // the server has told what is wrong with the file
  const bool done = sdf::readString(text, document, errors);
  sdf::Console::Instance()->SetQuiet(false);
  return done ? document->Root() : sdf::ElementPtr();
}

sdf::ElementPtr child(const std::string& text, const std::string& tag, const std::string& fallback)
{
  for (const std::string& each : { text, fallback })
    if (const sdf::ElementPtr root = read(each))
      if (root->HasElement(tag))
        return root->GetElement(tag);
  return sdf::ElementPtr();
}

constexpr const char* kAnyModel = "<sdf version='1.6'><model name='any'><link name='link'/></model></sdf>";

}  // namespace

sdf::ElementPtr model_element(const std::string& text, const std::string& name)
{
  const sdf::ElementPtr root = text.find("<actor") == std::string::npos ? sdf::ElementPtr() : read(text);
  const auto found = root && root->HasElement("actor") ? root->GetElement("actor") : child(text, "model", kAnyModel);
  if (found)
    found->GetAttribute("name")->SetFromString(name);
  return found;
}

sdf::ElementPtr world_element(const std::string& text, const std::string& name)
{
  const auto found = child(text, "world", "<sdf version='1.6'><world name='any'/></sdf>");
  if (found)
    found->GetAttribute("name")->SetFromString(name);
  return found;
}

sdf::ElementPtr plugin_element(const sdf::ElementPtr& owner, int index, const std::string& text)
{
  if (owner && owner->HasElement("plugin"))
  {
    sdf::ElementPtr found = owner->GetElement("plugin");
    for (int i = 0; found && i < index; ++i)
      found = found->GetNextElement("plugin");
    if (found)
      return found;
  }
  const auto alone = child("<sdf version='1.6'><model name='any'><link name='link'/>" + text + "</model></sdf>", "model", "");
  return alone && alone->HasElement("plugin") ? alone->GetElement("plugin") : sdf::ElementPtr();
}

}  // namespace gazebo
