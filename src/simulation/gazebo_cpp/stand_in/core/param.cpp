#include <sdf/Param.hh>

#include <cerrno>
#include <cstdlib>
#include <map>
#include <stdexcept>

namespace sdf
{
inline namespace v12
{
namespace internal
{
namespace
{

bool hexadecimal(const std::string& text) { return text.compare(0, 2, "0x") == 0 || text.compare(0, 2, "0X") == 0; }

/// The number that the text begins with, as std::stoi and its like read it.
template <typename T, typename F>
bool number(const std::string& key, const std::string& text, T& value, F read)
{
  const std::string word = lowercase(trim(text));
  try
  {
    value = static_cast<T>(word == "true" ? 1 : word == "false" ? 0 : read(word));
    return true;
  }
  catch (const std::invalid_argument&)
  {
    sdferr << "Invalid argument. Unable to set value [" << text << "] for key[" << key << "].\n";
  }
  catch (const std::out_of_range&)
  {
    sdferr << "Out of range. Unable to set value [" << text << "] for key[" << key << "].\n";
  }
  return false;
}

}  // namespace

void report(const std::string& key, const std::string& text)
{
  sdferr << "Unable to set value [" << text << "] for key[" << key << "].\n";
}

bool parse(const std::string&, const std::string& text, std::string& value)
{
  const std::string word = lowercase(text);
  value = word == "true" ? "1" : word == "false" ? "0" : text;  // a boolean, however it is written
  return true;
}

bool parse(const std::string&, const std::string& text, bool& value)
{
  const std::string word = lowercase(trim(text));
  const bool yes = word == "true" || word == "1", no = word == "false" || word == "0";
  if (!yes && !no)
    sdferr << "Invalid boolean value [" << text << "]: it is true, false, 1 or 0.\n";
  value = yes;
  return yes || no;
}

bool parse(const std::string& key, const std::string& text, char& value)
{
  std::string word;
  parse(key, text, word);
  value = word.empty() ? '\0' : word[0];
  return true;
}

bool parse(const std::string& key, const std::string& text, int& value)
{
  return number(key, text, value,
                [](const std::string& word) { return std::stoi(word, nullptr, hexadecimal(word) ? 16 : 10); });
}

bool parse(const std::string& key, const std::string& text, unsigned int& value)
{
  return number(key, text, value,
                [](const std::string& word) { return std::stoul(word, nullptr, hexadecimal(word) ? 16 : 10); });
}

bool parse(const std::string& key, const std::string& text, std::uint64_t& value)
{
  return number(key, text, value, [](const std::string& word) { return std::stoull(word); });
}

bool parse(const std::string& key, const std::string& text, double& value)
{
  return number(key, text, value, [](const std::string& word) { return std::stod(word); });
}

bool parse(const std::string& key, const std::string& text, float& value)
{
  return number(key, text, value, [](const std::string& word) { return std::stof(word); });
}

bool parse(const std::string& key, const std::string& text, ignition::math::Pose3d& value)
{
  std::istringstream in(text);
  std::vector<double> numbers;
  std::string word;
  while (in >> word)
  {
    double read = 0;
    if (!parse(key, word, read))
      return false;
    numbers.push_back(read);
  }
  if (!numbers.empty() && numbers.size() != 6)
  {
    sdferr << "A pose has 6 numbers; <" << key << "> has " << numbers.size() << ": '" << text << "'.\n";
    return false;
  }
  if (!numbers.empty())
    value.Set(numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]);
  return true;
}

bool parse(const std::string& key, const std::string& text, ignition::math::Color& value)
{
  std::istringstream in(text);
  float parts[4] = { 0, 0, 0, 1 };
  int count = 0;
  while (count < 4 && in >> parts[count])
    ++count;
  const bool inside = std::all_of(parts, parts + 4, [](float part) { return part >= 0 && part <= 1; });
  if (count < 3 || !inside)
  {
    sdferr << "A colour has 3 or 4 numbers from 0 to 1; <" << key << "> is '" << text << "'.\n";
    return false;
  }
  value.Set(parts[0], parts[1], parts[2], count == 3 ? 1 : parts[3]);
  return true;
}

std::string name_of(const std::type_info& type)
{
  static const std::map<std::string, std::string> names = {
    { typeid(bool).name(), "bool" },
    { typeid(char).name(), "char" },
    { typeid(std::string).name(), "string" },
    { typeid(int).name(), "int" },
    { typeid(std::uint64_t).name(), "uint64_t" },
    { typeid(unsigned int).name(), "unsigned int" },
    { typeid(double).name(), "double" },
    { typeid(float).name(), "float" },
    { typeid(Time).name(), "time" },
    { typeid(ignition::math::Angle).name(), "angle" },
    { typeid(ignition::math::Color).name(), "color" },
    { typeid(ignition::math::Vector2i).name(), "vector2i" },
    { typeid(ignition::math::Vector2d).name(), "vector2d" },
    { typeid(ignition::math::Vector3d).name(), "vector3" },
    { typeid(ignition::math::Quaterniond).name(), "quaternion" },
    { typeid(ignition::math::Pose3d).name(), "pose" },
  };
  const auto found = names.find(type.name());
  return found == names.end() ? std::string() : found->second;
}

namespace
{

template <typename T>
bool reads_as(const std::string& key, const std::string& text, std::any* value)
{
  T read{};
  if (!parse(key, text, read))
    return false;
  if (value)
    *value = read;
  return true;
}

typedef bool (*Reader)(const std::string&, const std::string&, std::any*);

Reader reader_of(const std::string& type)
{
  static const std::map<std::string, Reader> readers = {
    { "bool", reads_as<bool> },
    { "char", reads_as<char> },
    { "int", reads_as<int> },
    { "uint64_t", reads_as<std::uint64_t> },
    { "unsigned int", reads_as<unsigned int> },
    { "double", reads_as<double> },
    { "float", reads_as<float> },
    { "time", reads_as<Time> },
    { "angle", reads_as<ignition::math::Angle> },
    { "color", reads_as<ignition::math::Color> },
    { "vector2i", reads_as<ignition::math::Vector2i> },
    { "vector2d", reads_as<ignition::math::Vector2d> },
    { "vector3", reads_as<ignition::math::Vector3d> },
    { "quaternion", reads_as<ignition::math::Quaterniond> },
    { "pose", reads_as<ignition::math::Pose3d> },
  };
  const auto found = readers.find(type);
  return found == readers.end() ? reads_as<std::string> : found->second;
}

}  // namespace

bool valid(const std::string& key, const std::string& type, const std::string& text)
{
  return reader_of(type)(key, text, nullptr);
}

}  // namespace internal

Param::Param(const std::string& key, const std::string& type, const std::string& fallback, bool required,
             const std::string& description)
  : key_(key)
  , type_(type)
  , fallback_(fallback)
  , text_(fallback)
  , description_(description)
  , required_(required)
{
}

Param::Param(const std::string& key, const std::string& type, const std::string& fallback, bool required, const std::string&,
             const std::string&, const std::string& description)
  : Param(key, type, fallback, required, description)
{
}

bool Param::SetFromString(const std::string& text)
{
  const std::string trimmed = trim(text);
  if (trimmed.empty() && required_)
  {
    sdferr << "<" << key_ << "> wants a value.\n";
    return false;
  }
  if (trimmed.empty())
  {
    text_ = fallback_;
    return true;
  }
  if (!internal::valid(key_, type_, trimmed))
    return false;
  text_ = trimmed;
  return set_ = true;
}

bool Param::GetAny(std::any& value) const { return internal::reader_of(type_)(key_, text_, &value); }

}  // namespace v12
}  // namespace sdf
