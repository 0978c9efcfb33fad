#include <sdf/sdf.hh>

#include <sys/stat.h>
#include <tinyxml2.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "schema.hpp"

namespace sdf
{
inline namespace v12
{
namespace
{

struct Reader
{
  Errors& errors;
  std::string source, version;

  bool fail(ErrorCode code, const std::string& message, int line)
  {
    errors.emplace_back(code, message, source, line);
    return false;
  }

  /// What the file says, below an element that is described or not.
  bool read(const tinyxml2::XMLElement& xml, const ElementPtr& element)
  {
    element->SetFilePath(source);
    element->SetLineNumber(xml.GetLineNum());
    element->SetOriginalVersion(version);
    element->SetExplicitlySetInFile(true);
    if (!attributes(xml, element) || !value(xml, element))
      return false;
    for (const tinyxml2::XMLElement* each = xml.FirstChildElement(); each; each = each->NextSiblingElement())
      if (!child(*each, element))
        return fail(ErrorCode::ELEMENT_INVALID, "Error reading element <" + std::string(xml.Name()) + ">", xml.GetLineNum());
    if (const internal::Description* const known = element->Described())
      for (const internal::Description* each : known->children)
        if (each->required && !element->HasElement(each->name))
          element->AddElement(each->name);
    return true;
  }

  bool attributes(const tinyxml2::XMLElement& xml, const ElementPtr& element)
  {
    for (const tinyxml2::XMLAttribute* each = xml.FirstAttribute(); each; each = each->Next())
    {
      if (!element->HasAttribute(each->Name()))
        element->AddAttribute(each->Name(), "string", "", false);
      if (!element->GetAttribute(each->Name())->SetFromString(each->Value()))
        return fail(ErrorCode::ATTRIBUTE_INVALID,
                    "Unable to read attribute[" + std::string(each->Name()) + "] of element[" + xml.Name() + "]",
                    xml.GetLineNum());
    }
    for (const ParamPtr& each : element->GetAttributes())
      if (each->GetRequired() && !each->GetSet())
        return fail(ErrorCode::ATTRIBUTE_MISSING,
                    "Required attribute[" + each->GetKey() + "] in element[" + xml.Name() + "] is not specified in SDF.",
                    xml.GetLineNum());
    return true;
  }

  bool value(const tinyxml2::XMLElement& xml, const ElementPtr& element)
  {
    const std::string text = xml.GetText() ? trim(xml.GetText()) : std::string();
    if (text.empty())
      return true;
    if (!element->Described() && !element->GetValue())
      element->AddValue("string", text, true);
    if (element->GetValue() && !element->GetValue()->SetFromString(text))
      return fail(ErrorCode::ELEMENT_INVALID,
                  "Element <" + std::string(xml.Name()) + "> has the value '" + text + "', which is no " +
                      element->GetValue()->GetTypeName(),
                  xml.GetLineNum());
    return true;
  }

  bool child(const tinyxml2::XMLElement& xml, const ElementPtr& parent)
  {
    const internal::Description* const known = parent->Described() ? parent->Described()->child(xml.Name()) : nullptr;
    const ElementPtr element = std::make_shared<Element>();
    element->SetName(xml.Name());
    if (known)
      element->Describe(known);
    parent->InsertElement(element, true);
    return read(xml, element);
  }
};

const tinyxml2::XMLElement* find(const tinyxml2::XMLNode& below, const std::string& name)
{
  for (const tinyxml2::XMLElement* each = below.FirstChildElement(); each; each = each->NextSiblingElement())
  {
    if (name == each->Name())
      return each;
    if (const tinyxml2::XMLElement* inside = find(*each, name))
      return inside;
  }
  return nullptr;
}

bool refuse(Errors& errors, ErrorCode code, const std::string& message, const std::string& source)
{
  sdferr << message << "\n";
  errors.emplace_back(code, message, source);
  return false;
}

bool parse(tinyxml2::XMLDocument& xml, const std::string& text, const std::string& source, Errors& errors)
{
  if (xml.Parse(text.c_str(), text.size()) == tinyxml2::XML_SUCCESS)
    return true;
  return refuse(errors, ErrorCode::STRING_READ, "Error parsing XML: " + std::string(xml.ErrorStr()), source);
}

bool read_document(const std::string& text, const std::string& source, const SDFPtr& sdf, Errors& errors)
{
  tinyxml2::XMLDocument xml;
  if (!parse(xml, text, source, errors))
    return false;
  const tinyxml2::XMLElement* top = xml.FirstChildElement("sdf");
  if (!top)
    top = xml.FirstChildElement("gazebo");
  if (!top)
    return refuse(errors, ErrorCode::ELEMENT_MISSING,
                  "There is no <sdf> in it; a robot's description (URDF) is not read here: spawn it, or write it as SDF.",
                  source);
  if (!top->Attribute("version"))
    return refuse(errors, ErrorCode::ATTRIBUTE_MISSING, "<sdf> has no version.", source);
  if (!sdf->Root())
    init(sdf);
  Reader reader{ errors, source, top->Attribute("version") };
  sdf->SetOriginalVersion(reader.version);
  sdf->SetFilePath(source);
  return reader.read(*top, sdf->Root());
}

void print(const Errors& errors)
{
  for (const Error& each : errors)
    sdferr << each << "\n";
}

bool file_text(const std::string& file, std::string& text)
{
  std::ifstream in(file);
  std::ostringstream all;
  all << in.rdbuf();
  text = all.str();
  return static_cast<bool>(in);
}

std::vector<std::pair<std::string, std::string>>& folders()
{
  static std::vector<std::pair<std::string, std::string>> all;
  return all;
}

std::function<std::string(const std::string&)>& find_callback()
{
  static std::function<std::string(const std::string&)> one;
  return one;
}

bool exists(const std::string& path)
{
  struct stat status;
  return stat(path.c_str(), &status) == 0;
}

}  // namespace

std::string findFile(const std::string& name, bool local, bool callback)
{
  for (const auto& [uri, folder] : folders())
    if (name.compare(0, uri.size(), uri) == 0 && exists(folder + "/" + name.substr(uri.size())))
      return folder + "/" + name.substr(uri.size());
  const char* const path = std::getenv("SDF_PATH");
  for (const std::string& folder : split(path ? path : "", ":"))
    if (!folder.empty() && exists(folder + "/" + name))
      return folder + "/" + name;
  if ((local || (!name.empty() && name[0] == '/')) && exists(name))
    return name;
  if (callback && find_callback())
    return find_callback()(name);
  return "";
}

void addURIPath(const std::string& uri, const std::string& path)
{
  for (const std::string& each : split(path, ":"))
    if (!each.empty())
      folders().emplace_back(uri, each);
}

void setFindCallback(std::function<std::string(const std::string&)> callback) { find_callback() = callback; }

SDF::SDF()
{
  init(SDFPtr(this, [](SDF*) {}));
}

std::string& SDF::version()
{
  static std::string value = SDF_VERSION;
  return value;
}

void SDF::PrintValues() const { std::cout << ToString(); }

std::string SDF::ToString() const
{
  const std::string text = root_ ? root_->ToString("") : std::string();
  const bool wrapped = root_ && root_->GetName() == "sdf";
  return "<?xml version='1.0'?>\n" + (wrapped ? text : "<sdf version='" + Version() + "'>\n" + text + "</sdf>\n");
}

void SDF::Write(const std::string& file)
{
  std::ofstream out(file);
  if (!(out << ToString()))
    sdferr << "Unable to open file[" << file << "] for writing\n";
}

void SDF::SetFromString(const std::string& text)
{
  init(SDFPtr(this, [](SDF*) {}));
  Errors errors;
  if (!read_document(text, "<data-string>", SDFPtr(this, [](SDF*) {}), errors))
  {
    print(errors);
    sdferr << "Unable to parse sdf string[" << text << "]\n";
  }
}

void SDF::Clear()
{
  root_.reset(new Element());
  path_.clear();
  version_.clear();
}

ElementPtr SDF::WrapInRoot(const ElementPtr& element)
{
  const ElementPtr root = std::make_shared<Element>();
  root->Describe(internal::described("sdf"));
  root->GetAttribute("version")->SetFromString(Version());
  root->InsertElement(element);
  return root;
}

bool init(SDFPtr sdf)
{
  const ElementPtr root = std::make_shared<Element>();
  root->Describe(internal::described("sdf"));
  sdf->Root(root);
  return true;
}

bool readFile(const std::string& file, SDFPtr sdf, Errors& errors)
{
  const std::string found = findFile(file, true, true);
  std::string text;
  if (found.empty() || !file_text(found, text))
    return refuse(errors, ErrorCode::FILE_READ, "Error finding file [" + file + "].", file);
  return read_document(text, found, sdf, errors);
}

bool readFile(const std::string& file, SDFPtr sdf)
{
  Errors errors;
  const bool done = readFile(file, sdf, errors);
  print(errors);
  return done;
}

SDFPtr readFile(const std::string& file, Errors& errors)
{
  const SDFPtr sdf = std::make_shared<SDF>();
  return readFile(file, sdf, errors) ? sdf : SDFPtr();
}

SDFPtr readFile(const std::string& file)
{
  Errors errors;
  const SDFPtr sdf = readFile(file, errors);
  print(errors);
  return sdf;
}

bool readString(const std::string& text, SDFPtr sdf, Errors& errors)
{
  return read_document(text, "<data-string>", sdf, errors);
}

bool readString(const std::string& text, SDFPtr sdf)
{
  Errors errors;
  const bool done = readString(text, sdf, errors);
  print(errors);
  return done;
}

bool readString(const std::string& text, ElementPtr element, Errors& errors)
{
  tinyxml2::XMLDocument xml;
  if (!parse(xml, text, "<data-string>", errors))
    return false;
  const tinyxml2::XMLElement* const top = xml.FirstChildElement("sdf");
  const tinyxml2::XMLElement* const found = find(xml, element->GetName());
  if (!found)
    return refuse(errors, ErrorCode::ELEMENT_MISSING, "There is no <" + element->GetName() + "> in it.", "<data-string>");
  const char* const version = top ? top->Attribute("version") : nullptr;
  return Reader{ errors, "<data-string>", version ? version : "" }.read(*found, element);
}

bool readString(const std::string& text, ElementPtr element)
{
  Errors errors;
  const bool done = readString(text, element, errors);
  print(errors);
  return done;
}

bool initFile(const std::string& name, ElementPtr element)
{
  const std::size_t slash = name.find_last_of('/');
  std::string tag = slash == std::string::npos ? name : name.substr(slash + 1);
  if (tag.size() > 4 && tag.compare(tag.size() - 4, 4, ".sdf") == 0)
    tag.resize(tag.size() - 4);
  const internal::Description* const known = internal::described(tag);
  if (!known)
  {
    sdferr << "There is no description of <" << tag << ">.\n";
    return false;
  }
  element->Describe(known);
  return true;
}

bool initFile(const std::string& name, SDFPtr sdf)
{
  const ElementPtr root = std::make_shared<Element>();
  sdf->Root(root);
  return initFile(name, root);
}

}  // namespace v12
}  // namespace sdf
