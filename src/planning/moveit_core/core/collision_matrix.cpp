#include <moveit/collision_detection/collision_matrix.h>

#include <algorithm>
#include <atomic>
#include <iomanip>

#include "motion/collision.hpp"

namespace collision_detection
{
namespace
{
using Core = motion::AllowedCollisionMatrix;

Core::Entry entryOf(bool allowed) { return allowed ? Core::Allowed : Core::Never; }
}  // namespace

void CollisionResult::print() const
{
  for (const auto& pair : contacts)
    for (const Contact& contact : pair.second)
      ROS_INFO_STREAM_THROTTLE(0.1, "Found a contact between '" << contact.body_name_1 << "' and '" << contact.body_name_2
                                                                << "', which constitutes a collision.");
}

AllowedCollisionMatrix::AllowedCollisionMatrix() : AllowedCollisionMatrix(Core()) {}

AllowedCollisionMatrix::AllowedCollisionMatrix(const Core& core) : core_(new Core(core)) { changed(); }

void AllowedCollisionMatrix::changed()
{
  static std::atomic<std::uint64_t> last{ 0 };
  version_ = ++last;
}

AllowedCollisionMatrix::~AllowedCollisionMatrix() = default;

AllowedCollisionMatrix::AllowedCollisionMatrix(const AllowedCollisionMatrix& other)
  : core_(new Core(*other.core_))
  , conditions_(other.conditions_)
  , default_conditions_(other.default_conditions_)
  , version_(other.version_)
{
}

AllowedCollisionMatrix& AllowedCollisionMatrix::operator=(const AllowedCollisionMatrix& other)
{
  *core_ = *other.core_;
  conditions_ = other.conditions_;
  default_conditions_ = other.default_conditions_;
  version_ = other.version_;
  return *this;
}

AllowedCollisionMatrix::AllowedCollisionMatrix(const std::vector<std::string>& names, bool allowed) : AllowedCollisionMatrix()
{
  setEntry(names, names, allowed);
}

AllowedCollisionMatrix::AllowedCollisionMatrix(const srdf::Model& srdf) : AllowedCollisionMatrix()
{
  for (const std::string& name : srdf.getNoDefaultCollisionLinks())
    setDefaultEntry(name, true);
  for (const auto& pair : srdf.getEnabledCollisionPairs())
    setEntry(pair.link1_, pair.link2_, false);
  for (const auto& pair : srdf.getDisabledCollisionPairs())
    setEntry(pair.link1_, pair.link2_, true);
}

AllowedCollisionMatrix::AllowedCollisionMatrix(const moveit_msgs::AllowedCollisionMatrix& msg) : AllowedCollisionMatrix()
{
  if (msg.entry_names.size() != msg.entry_values.size() || msg.default_entry_names.size() != msg.default_entry_values.size())
  {
    ROS_ERROR_NAMED("collision_detection",
                    "The number of links does not match the number of entries in AllowedCollisionMatrix message");
    return;
  }
  for (std::size_t i = 0; i < msg.default_entry_names.size(); ++i)
    setDefaultEntry(msg.default_entry_names[i], msg.default_entry_values[i]);
  for (std::size_t i = 0; i < msg.entry_names.size(); ++i)
  {
    if (msg.entry_values[i].enabled.size() != msg.entry_names.size())
    {
      ROS_ERROR_NAMED("collision_detection", "Number of entries is incorrect for link '%s' in AllowedCollisionMatrix message",
                      msg.entry_names[i].c_str());
      return;
    }
    for (std::size_t j = i + 1; j < msg.entry_names.size(); ++j)
      setEntry(msg.entry_names[i], msg.entry_names[j], msg.entry_values[i].enabled[j]);
  }
}

AllowedCollisionMatrix::Pair AllowedCollisionMatrix::ordered(const std::string& a, const std::string& b)
{
  return a < b ? Pair(a, b) : Pair(b, a);
}

bool AllowedCollisionMatrix::getEntry(const std::string& name1, const std::string& name2, AllowedCollision::Type& type) const
{
  const Core::Entry entry = core_->entry(name1, name2);
  if (entry == Core::None)
    return false;
  type = conditions_.count(ordered(name1, name2)) ? AllowedCollision::CONDITIONAL
         : entry == Core::Allowed                 ? AllowedCollision::ALWAYS
                                                  : AllowedCollision::NEVER;
  return true;
}

bool AllowedCollisionMatrix::getEntry(const std::string& name1, const std::string& name2, DecideContactFn& fn) const
{
  const auto found = conditions_.find(ordered(name1, name2));
  if (found == conditions_.end())
    return false;
  fn = found->second;
  return true;
}

bool AllowedCollisionMatrix::hasEntry(const std::string& name) const
{
  const std::vector<std::string> names = core_->names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool AllowedCollisionMatrix::hasEntry(const std::string& name1, const std::string& name2) const
{
  return core_->entry(name1, name2) != Core::None;
}

void AllowedCollisionMatrix::removeEntry(const std::string& name1, const std::string& name2)
{
  conditions_.erase(ordered(name1, name2));
  core_->setEntry(name1, name2, Core::None);
  changed();
}

void AllowedCollisionMatrix::removeEntry(const std::string& name)
{
  for (auto it = conditions_.begin(); it != conditions_.end();)
    it = it->first.first == name || it->first.second == name ? conditions_.erase(it) : std::next(it);
  core_->remove(name);
  changed();
}

void AllowedCollisionMatrix::setEntry(const std::string& name1, const std::string& name2, bool allowed)
{
  conditions_.erase(ordered(name1, name2));
  core_->setEntry(name1, name2, entryOf(allowed));
  changed();
}

void AllowedCollisionMatrix::setEntry(const std::string& name1, const std::string& name2, const DecideContactFn& fn)
{
  core_->setEntry(name1, name2, Core::Never);
  conditions_[ordered(name1, name2)] = fn;
  changed();
}

void AllowedCollisionMatrix::setEntry(const std::string& name, bool allowed)
{
  for (const std::string& other : core_->names())
    if (other != name)
      setEntry(name, other, allowed);
}

void AllowedCollisionMatrix::setEntry(const std::string& name, const std::vector<std::string>& other_names, bool allowed)
{
  for (const std::string& other : other_names)
    if (other != name)
      setEntry(name, other, allowed);
}

void AllowedCollisionMatrix::setEntry(const std::vector<std::string>& names1, const std::vector<std::string>& names2,
                                      bool allowed)
{
  for (const std::string& name : names1)
    setEntry(name, names2, allowed);
}

void AllowedCollisionMatrix::setEntry(bool allowed)
{
  const std::vector<std::string> names = core_->names();
  for (const std::string& a : names)
    for (const std::string& b : names)
      if (core_->entry(a, b) != Core::None)
        setEntry(a, b, allowed);
}

void AllowedCollisionMatrix::getAllEntryNames(std::vector<std::string>& names) const { names = core_->names(); }

std::size_t AllowedCollisionMatrix::getSize() const { return core_->names().size(); }

void AllowedCollisionMatrix::clear() { *this = AllowedCollisionMatrix(); }

void AllowedCollisionMatrix::getMessage(moveit_msgs::AllowedCollisionMatrix& msg) const
{
  msg = moveit_msgs::AllowedCollisionMatrix();
  msg.entry_names = core_->names();
  msg.entry_values.resize(msg.entry_names.size());
  for (std::size_t i = 0; i < msg.entry_names.size(); ++i)
    for (const std::string& other : msg.entry_names)
      msg.entry_values[i].enabled.push_back(other == msg.entry_names[i]
                                                ? core_->entry(other, other) == Core::Allowed
                                                : core_->allowed(msg.entry_names[i], other));  // by its defaults, too
  for (const auto& item : core_->defaults())
  {
    msg.default_entry_names.push_back(item.first);
    msg.default_entry_values.push_back(item.second == Core::Allowed);
  }
}

// ---------------------------------------------------------------- defaults

void AllowedCollisionMatrix::setDefaultEntry(const std::string& name, bool allowed)
{
  default_conditions_.erase(name);
  core_->setDefault(name, entryOf(allowed));
  changed();
}

void AllowedCollisionMatrix::setDefaultEntry(const std::string& name, const DecideContactFn& fn)
{
  core_->setDefault(name, Core::Never);
  default_conditions_[name] = fn;
  changed();
}

bool AllowedCollisionMatrix::getDefaultEntry(const std::string& name, AllowedCollision::Type& type) const
{
  const Core::Entry entry = core_->defaultEntry(name);
  if (entry == Core::None)
    return false;
  type = default_conditions_.count(name) ? AllowedCollision::CONDITIONAL
         : entry == Core::Allowed        ? AllowedCollision::ALWAYS
                                         : AllowedCollision::NEVER;
  return true;
}

bool AllowedCollisionMatrix::getDefaultEntry(const std::string& name, DecideContactFn& fn) const
{
  const auto found = default_conditions_.find(name);
  if (found == default_conditions_.end())
    return false;
  fn = found->second;
  return true;
}

bool AllowedCollisionMatrix::getAllowedCollision(const std::string& name1, const std::string& name2, DecideContactFn& fn) const
{
  if (core_->entry(name1, name2) != Core::None)
    return getEntry(name1, name2, fn);
  DecideContactFn other;
  const bool first = getDefaultEntry(name1, fn), second = getDefaultEntry(name2, other);
  if (first && second)
  {
    const DecideContactFn both = fn;
    fn = [both, other](Contact& contact) { return both(contact) && other(contact); };
  }
  else if (second)
    fn = other;
  return first || second;
}

bool AllowedCollisionMatrix::getAllowedCollision(const std::string& name1, const std::string& name2,
                                                 AllowedCollision::Type& type) const
{
  if (getEntry(name1, name2, type))
    return true;
  AllowedCollision::Type other;
  const bool first = getDefaultEntry(name1, type), second = getDefaultEntry(name2, other);
  if (first && second && type != other)
    type = type == AllowedCollision::NEVER || other == AllowedCollision::NEVER ? AllowedCollision::NEVER
                                                                               : AllowedCollision::CONDITIONAL;
  else if (second && !first)
    type = other;
  return first || second;
}

void AllowedCollisionMatrix::print(std::ostream& out) const
{
  const std::vector<std::string> names = core_->names();
  for (const std::string& a : names)
  {
    out << std::setw(32) << a << ' ';
    for (const std::string& b : names)
    {
      AllowedCollision::Type type;
      out << (getAllowedCollision(a, b, type) ? (type == AllowedCollision::ALWAYS  ? '1'
                                                 : type == AllowedCollision::NEVER ? '0'
                                                                                   : '?')
                                              : '-');
    }
    out << '\n';
  }
}
}  // namespace collision_detection
