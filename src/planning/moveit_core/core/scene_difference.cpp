#include <moveit/planning_scene/scene_difference.h>

#include <map>

namespace planning_scene
{
namespace
{
using moveit_msgs::AttachedCollisionObject;
using moveit_msgs::CollisionObject;
using Attached = std::map<std::string, AttachedCollisionObject>;

Attached attachedTo(const PlanningScene& scene)
{
  std::vector<AttachedCollisionObject> messages;
  scene.getAttachedCollisionObjectMsgs(messages);
  Attached attached;
  for (const AttachedCollisionObject& message : messages)
    attached[message.object.id] = message;
  return attached;
}

CollisionObject removalOf(const std::string& id)
{
  CollisionObject object;
  object.id = id;
  object.operation = CollisionObject::REMOVE;
  return object;
}

// What is let go stands in the world: the world's part of the message, which is read later, takes it away where it is not to stay.
void compareAttached(const Attached& before, const PlanningScene& now, const Attached& attached,
                     moveit_msgs::PlanningScene& change)
{
  for (const auto& [id, message] : before)
  {
    if (attached.count(id))
      continue;
    AttachedCollisionObject gone;
    gone.link_name = message.link_name;
    gone.object = removalOf(id);
    change.robot_state.attached_collision_objects.push_back(gone);
    if (!now.getWorld()->hasObject(id))
      change.world.collision_objects.push_back(removalOf(id));
  }
  for (const auto& [id, message] : attached)
  {
    const auto known = before.find(id);
    if (known == before.end() || !(known->second == message))
      change.robot_state.attached_collision_objects.push_back(message);
  }
}

// What is attached has left the world by that.
void compareWorlds(const PlanningScene& before, const PlanningScene& now, const Attached& attached,
                   moveit_msgs::PlanningScene& change)
{
  const std::string& octomap = PlanningScene::OCTOMAP_NS;
  for (const auto& [id, object] : *before.getWorld())
    if (!now.getWorld()->hasObject(id))
    {
      if (id == octomap)
        change.world.octomap.octomap.id = "OcTree";  // without data: there is none any more
      else if (!attached.count(id))
        change.world.collision_objects.push_back(removalOf(id));
    }
  for (const auto& [id, object] : *now.getWorld())
  {
    if (before.getWorld()->getObject(id) == object)
      continue;
    if (id == octomap)
    {
      now.getOctomapMsg(change.world.octomap);
      continue;
    }
    change.world.collision_objects.emplace_back();
    now.getCollisionObjectMsg(change.world.collision_objects.back(), id);
  }
}

// `list` is what `read` gives of `now`, where it gives something else of `before`.
template <typename List, typename Read>
void keepIfChanged(const PlanningScene& before, const PlanningScene& now, List& list, const Read& read)
{
  List old;
  read(before, old);
  read(now, list);
  if (list == old)
    list = List();
}
}  // namespace

moveit_msgs::PlanningScene difference(const PlanningScene& before, const PlanningScene& now)
{
  moveit_msgs::PlanningScene change;
  change.is_diff = change.robot_state.is_diff = true;
  const Attached attached_before = attachedTo(before), attached = attachedTo(now);
  compareAttached(attached_before, now, attached, change);
  compareWorlds(before, now, attached, change);
  keepIfChanged(before, now, change.allowed_collision_matrix,
                [](const PlanningScene& scene, auto& matrix) { scene.getAllowedCollisionMatrix().getMessage(matrix); });
  keepIfChanged(before, now, change.link_padding,
                [](const PlanningScene& scene, auto& padding) { scene.getCollisionEnv()->getPadding(padding); });
  keepIfChanged(before, now, change.link_scale,
                [](const PlanningScene& scene, auto& scale) { scene.getCollisionEnv()->getScale(scale); });
  keepIfChanged(before, now, change.object_colors,
                [](const PlanningScene& scene, auto& colors) { scene.getObjectColorMsgs(colors); });
  return change;
}
}  // namespace planning_scene
