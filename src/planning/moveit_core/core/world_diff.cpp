#include <moveit/collision_detection/world_diff.h>

namespace collision_detection
{
WorldDiff::WorldDiff() = default;

WorldDiff::WorldDiff(const WorldPtr& world) { watch(world); }

WorldDiff::WorldDiff(WorldDiff& other) : changes_(other.changes_)
{
  if (const WorldPtr world = other.world_.lock())
    watch(world);
}

WorldDiff::~WorldDiff() { leave(); }

void WorldDiff::watch(const WorldPtr& world)
{
  world_ = world;
  observer_handle_ =
      world->addObserver([this](const World::ObjectConstPtr& object, World::Action action) { notify(object, action); });
}

void WorldDiff::leave()
{
  if (const WorldPtr world = world_.lock())
    world->removeObserver(observer_handle_);
  world_.reset();
}

void WorldDiff::reset()
{
  leave();
  clearChanges();
}

void WorldDiff::reset(const WorldPtr& world)
{
  reset();
  watch(world);
}

void WorldDiff::setWorld(const WorldPtr& world)
{
  if (const WorldPtr old = world_.lock())
    old->notifyObserverAllObjects(observer_handle_, World::DESTROY);
  leave();
  watch(world);
  world->notifyObserverAllObjects(observer_handle_, World::CREATE | World::ADD_SHAPE);
}

void WorldDiff::set(const std::string& id, World::Action val)
{
  if (val)
    changes_[id] = val;
  else
    changes_.erase(id);
}

// What is destroyed is that alone; what comes anew is new in all it has.
void WorldDiff::notify(const World::ObjectConstPtr& object, World::Action action)
{
  World::Action& known = changes_[object->id_];
  if (action == World::DESTROY)
    known = World::DESTROY;
  else
    known = World::Action(known | action);
}
}  // namespace collision_detection
