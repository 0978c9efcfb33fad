// What changed in a world since one began to look.
#pragma once

#include <map>
#include <string>

#include <moveit/collision_detection/world.h>
#include <moveit/macros/class_forward.h>

namespace collision_detection
{
MOVEIT_CLASS_FORWARD(WorldDiff);

class WorldDiff
{
public:
  WorldDiff();
  WorldDiff(const WorldPtr& world);
  WorldDiff(WorldDiff& other);
  ~WorldDiff();

  void setWorld(const WorldPtr& world);  // another one: what the old one has goes, what the new one has comes
  void reset(const WorldPtr& world);     // another one, and nothing changed
  void reset();                          // none
  const std::map<std::string, World::Action>& getChanges() const { return changes_; }
  using const_iterator = std::map<std::string, World::Action>::const_iterator;
  const_iterator begin() const { return changes_.begin(); }
  const_iterator end() const { return changes_.end(); }
  size_t size() const { return changes_.size(); }
  const_iterator find(const std::string& id) const { return changes_.find(id); }
  void set(const std::string& id, World::Action val);
  void clearChanges() { changes_.clear(); }

private:
  void watch(const WorldPtr& world);
  void leave();
  void notify(const World::ObjectConstPtr& object, World::Action action);

  std::map<std::string, World::Action> changes_;
  World::ObserverHandle observer_handle_;
  WorldWeakPtr world_;
};
}  // namespace collision_detection
