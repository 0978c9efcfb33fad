// How fast the arm may go for what is near it: internal/collision_velocity_scale, from 0 to 1.
#pragma once

#include <atomic>
#include <limits>

#include <moveit/collision_detection/collision_common.h>
#include <moveit/planning_scene_monitor/planning_scene_monitor.h>
#include <moveit/robot_model_loader/robot_model_loader.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64.h>

#include <moveit_servo/low_pass_filter.h>
#include <moveit_servo/servo_parameters.h>

namespace moveit_servo
{
enum CollisionCheckType
{
  K_THRESHOLD_DISTANCE = 1,  // slower the nearer it is
  K_STOP_DISTANCE = 2        // halted when it could not stop in time
};

// Looks at a rate of its own, in the thread of nh's callbacks.
class CollisionCheck
{
public:
  // The monitor's scene and state have to be monitored already.
  CollisionCheck(ros::NodeHandle& nh, const moveit_servo::ServoParameters& parameters,
                 const planning_scene_monitor::PlanningSceneMonitorPtr& planning_scene_monitor);
  ~CollisionCheck() { timer_.stop(); }

  void start();
  void setPaused(bool paused) { paused_ = paused; }

private:
  struct Distances  // m, without sign
  {
    bool collision = false;
    double to_scene = std::numeric_limits<double>::max();
    double to_self = std::numeric_limits<double>::max();
  };

  void run(const ros::TimerEvent& timer_event);
  Distances look() const;
  double velocityScale(const Distances& found);

  ros::NodeHandle nh_;
  const ServoParameters& parameters_;
  planning_scene_monitor::PlanningSceneMonitorPtr planning_scene_monitor_;
  CollisionCheckType type_;
  ros::Duration period_;
  std::atomic<bool> paused_{ false };
  double last_distance_ = std::numeric_limits<double>::max();                       // m
  std::atomic<double> worst_case_stop_time_{ std::numeric_limits<double>::max() };  // s

  ros::Timer timer_;
  ros::Publisher collision_velocity_scale_pub_;
  ros::Subscriber worst_case_stop_time_sub_;
};
}  // namespace moveit_servo
