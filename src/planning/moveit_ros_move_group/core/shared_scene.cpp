// One scene for move_group and for the process of its compiled capabilities.
#include "shared_scene.hpp"

#include <moveit_msgs/ApplyPlanningScene.h>

#include <moveit/planning_scene/scene_difference.h>

namespace move_group
{
namespace
{
using planning_scene::PlanningScene;
using Scene = moveit_msgs::PlanningScene;
using planning_scene_monitor::LockedPlanningSceneRO;
using planning_scene_monitor::LockedPlanningSceneRW;
using planning_scene_monitor::PlanningSceneMonitor;

// The number of the last change of this process that a scene holds: in a header that nobody else fills in.
std::uint32_t& changesIn(Scene& scene) { return scene.robot_state.joint_state.header.seq; }

std::vector<std::string> attachedTo(const PlanningScene& scene)
{
  std::vector<const moveit::core::AttachedBody*> bodies;
  scene.getCurrentState().getAttachedBodies(bodies);
  std::vector<std::string> names;
  for (const moveit::core::AttachedBody* body : bodies)
    names.push_back(body->getName() + "/" + body->getAttachedLinkName());
  return names;
}

bool isNothing(const Scene& change)
{
  Scene nothing;
  nothing.is_diff = nothing.robot_state.is_diff = true;
  return change == nothing;
}
}  // namespace

thread_local bool SharedScene::following_ = false;

SharedScene::SharedScene(const planning_scene_monitor::PlanningSceneMonitorPtr& monitor) : monitor_(monitor)
{
  // move_group alone listens to objects and publishes the scene.
  monitor_->stopPublishingPlanningScene();
  monitor_->stopWorldGeometryMonitor();
  common_ = PlanningScene::clone(monitor_->getPlanningScene());
  ros::NodeHandle node("~");
  to_move_group_ = node.serviceClient<moveit_msgs::ApplyPlanningScene>("apply_planning_scene");
  monitor_->addUpdateCallback([this](PlanningSceneMonitor::SceneUpdateType type) { changed(type); });
  node.setCallbackQueue(&queue_);
  from_move_group_ =
      node.subscribe<Scene>("planning_scene", 1, [this](const moveit_msgs::PlanningSceneConstPtr& scene) { follow(*scene); });
  spinner_.start();
}

// Joint states come to both, often: nobody tells the other of them. What is attached is part of the robot's state, too.
void SharedScene::changed(PlanningSceneMonitor::SceneUpdateType type)
{
  if (!following_ && (type != PlanningSceneMonitor::UPDATE_STATE || holdsOthers()))
    send();
}

// Whether other bodies are attached than when both last had the same.
bool SharedScene::holdsOthers()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const LockedPlanningSceneRO lock_of_scene(monitor_);
  return attachedTo(*common_) != attachedTo(*monitor_->getPlanningScene());
}

// Whether there was something to send.
bool SharedScene::send()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  moveit_msgs::ApplyPlanningScene call;
  {
    const LockedPlanningSceneRO lock_of_scene(monitor_);
    call.request.scene = planning_scene::difference(*common_, *monitor_->getPlanningScene());
    if (isNothing(call.request.scene))
      return false;
    common_ = PlanningScene::clone(monitor_->getPlanningScene());
  }
  changesIn(call.request.scene) = ++changes_;
  if (!to_move_group_.call(call) || !call.response.success)
    ROS_ERROR("move_group does not take the scene that a capability has changed: %s", to_move_group_.getService().c_str());
  return true;
}

void SharedScene::follow(const Scene& message)
{
  if (send())  // what a capability has changed and not told yet
    return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Scene scene = message;
    if (changesIn(scene) < changes_)
      return;
    changesIn(scene) = 0;
    LockedPlanningSceneRW own(monitor_);
    if (!isNothing(planning_scene::difference(*common_, *monitor_->getPlanningScene())))
      return;  // changed just now: it will be sent, and come back
    own->usePlanningSceneMsg(scene);
    common_ = PlanningScene::clone(monitor_->getPlanningScene());
  }
  following_ = true;
  monitor_->triggerSceneUpdateEvent(PlanningSceneMonitor::UPDATE_SCENE);
  following_ = false;
}
}  // namespace move_group
