// Moves an arm by velocities of its tip or of its joints, as long as nothing is in the way.
#pragma once

#include <memory>

#include <moveit_servo/collision_check.h>
#include <moveit_servo/servo_calcs.h>
#include <moveit_servo/servo_parameters.h>

namespace moveit_servo
{
class Servo
{
public:
  // Reads the parameters of the node's private namespace, whatever nh is; topics and services are those of nh. Parameters that
  // cannot be right, and a robot whose joint states do not come within 10 s, end the program with a line that says why.
  Servo(ros::NodeHandle& nh, const planning_scene_monitor::PlanningSceneMonitorPtr& planning_scene_monitor);
  ~Servo();

  void start();
  // Paused, the topics go on, but commands move nothing.
  void setPaused(bool paused);

  // The pose of robot_link_command_frame, and of ee_frame_name, in planning_frame. False before start().
  bool getCommandFrameTransform(Eigen::Isometry3d& transform) { return servo_calcs_->getCommandFrameTransform(transform); }
  bool getCommandFrameTransform(geometry_msgs::TransformStamped& transform)
  {
    return servo_calcs_->getCommandFrameTransform(transform);
  }
  bool getEEFrameTransform(Eigen::Isometry3d& transform) { return servo_calcs_->getEEFrameTransform(transform); }
  bool getEEFrameTransform(geometry_msgs::TransformStamped& transform) { return servo_calcs_->getEEFrameTransform(transform); }

  const ServoParameters& getParameters() const { return parameters_; }

  // From now on commands without a frame are in that of this link of the robot.
  void changeRobotLinkCommandFrame(const std::string& new_command_frame)
  {
    servo_calcs_->changeRobotLinkCommandFrame(new_command_frame);
  }

  friend class ServoFixture;  // of packages that test it

private:
  ros::NodeHandle nh_;
  planning_scene_monitor::PlanningSceneMonitorPtr planning_scene_monitor_;
  ServoParameters parameters_;
  std::unique_ptr<ServoCalcs> servo_calcs_;
  std::unique_ptr<CollisionCheck> collision_checker_;
};

using ServoPtr = std::shared_ptr<Servo>;
}  // namespace moveit_servo
