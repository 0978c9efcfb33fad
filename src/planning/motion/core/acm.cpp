#include <set>

#include "motion/collision.hpp"

namespace motion
{
AllowedCollisionMatrix::AllowedCollisionMatrix(const RobotModel& model)
{
  for (const LinkModel& link : model.links)
    if (link.hasGeometry())
      entries_[link.name];  // every link that can touch has a row, as in messages of MoveIt
  auto known = [&](const std::string& link) { return model.findLink(link) != nullptr; };
  for (const std::string& link : model.srdf.no_default_collision)
    if (known(link))
      setDefault(link, Allowed);
  for (const Srdf::LinkPair& pair : model.srdf.enabled)
    if (known(pair.link1) && known(pair.link2))
      setEntry(pair.link1, pair.link2, Never);
  for (const Srdf::LinkPair& pair : model.srdf.disabled)
    if (known(pair.link1) && known(pair.link2))
      setEntry(pair.link1, pair.link2, Allowed);
}

AllowedCollisionMatrix::Entry AllowedCollisionMatrix::entry(const std::string& a, const std::string& b) const
{
  const auto row = entries_.find(a);
  if (row == entries_.end())
    return None;
  const auto cell = row->second.find(b);
  return cell == row->second.end() ? None : cell->second;
}

void AllowedCollisionMatrix::setEntry(const std::string& a, const std::string& b, Entry entry)
{
  if (entry == None)
  {
    entries_[a].erase(b);
    entries_[b].erase(a);
    return;
  }
  entries_[a][b] = entry;
  entries_[b][a] = entry;
}

AllowedCollisionMatrix::Entry AllowedCollisionMatrix::defaultEntry(const std::string& name) const
{
  const auto found = defaults_.find(name);
  return found == defaults_.end() ? None : found->second;
}

void AllowedCollisionMatrix::setDefault(const std::string& name, Entry entry)
{
  if (entry == None)
    defaults_.erase(name);
  else
    defaults_[name] = entry;
}

void AllowedCollisionMatrix::remove(const std::string& name)
{
  entries_.erase(name);
  for (auto& [other, row] : entries_)
    row.erase(name);
  defaults_.erase(name);
}

bool AllowedCollisionMatrix::allowed(const std::string& a, const std::string& b) const
{
  const Entry own = entry(a, b);
  if (own != None)
    return own == Allowed;
  const Entry da = defaultEntry(a), db = defaultEntry(b);
  if (da == None && db == None)
    return false;
  return da != Never && db != Never;
}

bool AllowedCollisionMatrix::knows(const std::string& name) const { return entries_.count(name) || defaults_.count(name); }

std::vector<std::string> AllowedCollisionMatrix::names() const
{
  std::vector<std::string> out;
  for (const auto& [name, row] : entries_)
    out.push_back(name);
  return out;
}
}  // namespace motion
