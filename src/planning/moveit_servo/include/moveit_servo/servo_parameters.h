// The private parameters of a node that servoes; config/ur_simulated_config.yaml describes each.
#pragma once

#include <cstddef>
#include <string>

namespace moveit_servo
{
// Of publishers and subscribers.
constexpr size_t ROS_QUEUE_SIZE = 2;

struct ServoParameters
{
  std::string move_group_name;
  std::string joint_topic;
  std::string cartesian_command_in_topic;
  std::string robot_link_command_frame;
  std::string command_out_topic;
  std::string planning_frame;
  std::string ee_frame_name;
  std::string status_topic;
  std::string joint_command_in_topic;
  std::string command_in_type;
  std::string command_out_type;
  double linear_scale = 0.0;      // m/s
  double rotational_scale = 0.0;  // rad/s
  double joint_scale = 0.0;       // rad/s or m/s
  double lower_singularity_threshold = 0.0;
  double hard_stop_singularity_threshold = 0.0;
  double low_pass_filter_coeff = 0.0;
  double publish_period = 0.0;            // s
  double incoming_command_timeout = 0.0;  // s
  double joint_limit_margin = 0.0;        // rad or m
  int num_outgoing_halt_msgs_to_publish = 0;
  bool use_gazebo = false;
  bool publish_joint_positions = false;
  bool publish_joint_velocities = false;
  bool publish_joint_accelerations = false;
  bool low_latency_mode = false;
  // Collision checking
  bool check_collisions = false;
  std::string collision_check_type;
  double collision_check_rate = 0.0;                 // Hz
  double scene_collision_proximity_threshold = 0.0;  // m
  double self_collision_proximity_threshold = 0.0;   // m
  double collision_distance_safety_factor = 0.0;
  double min_allowable_collision_distance = 0.0;  // m
};
}  // namespace moveit_servo
