// One scene for move_group and for the process of its compiled capabilities.
#pragma once

#include <moveit_msgs/PlanningScene.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <mutex>

#include <moveit/planning_scene_monitor/planning_scene_monitor.h>

namespace move_group
{
// Keeps the scene of the capabilities and move_group's the same. What a capability changes is sent to move_group as a difference, and
// the change is numbered; move_group sends its whole scene with the number of the last change that it holds. A scene that lacks a
// change of this process is not taken: the one that holds it follows.
class SharedScene
{
public:
  explicit SharedScene(const planning_scene_monitor::PlanningSceneMonitorPtr& monitor);

private:
  void changed(planning_scene_monitor::PlanningSceneMonitor::SceneUpdateType type);
  bool holdsOthers();
  bool send();
  void follow(const moveit_msgs::PlanningScene& scene);

  planning_scene_monitor::PlanningSceneMonitorPtr monitor_;
  ros::ServiceClient to_move_group_;
  ros::CallbackQueue queue_;  // its own: a scene comes also while a capability is at work in the thread of all others
  ros::Subscriber from_move_group_;
  std::mutex mutex_;                         // of the two below
  planning_scene::PlanningScenePtr common_;  // the scene when both last had the same
  std::uint32_t changes_ = 0;                // that this process has sent
  static thread_local bool following_;
  ros::AsyncSpinner spinner_{ 1, &queue_ };  // last: it ends before what it uses
};
}  // namespace move_group
