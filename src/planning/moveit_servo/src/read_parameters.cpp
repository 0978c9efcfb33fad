#include "read_parameters.hpp"

namespace moveit_servo
{
namespace
{
const char* const LOGNAME = "servo_node";

void readCollisionParameters(ParameterReader& reader, ServoParameters& p)
{
  reader.get("check_collisions", p.check_collisions);
  reader.get("collision_check_type", p.collision_check_type);
  reader.get("collision_check_rate", p.collision_check_rate);
  reader.get("collision_distance_safety_factor", p.collision_distance_safety_factor);
  reader.get("min_allowable_collision_distance", p.min_allowable_collision_distance);
  // One of both, in files of before 2020.
  double threshold = 0.0;
  if (reader.read("collision_proximity_threshold", threshold))
  {
    ROS_WARN_NAMED(LOGNAME,
                   "Parameter collision_proximity_threshold is of old: it is self_collision_proximity_threshold and "
                   "scene_collision_proximity_threshold now");
    p.self_collision_proximity_threshold = p.scene_collision_proximity_threshold = threshold;
    reader.read("self_collision_proximity_threshold", p.self_collision_proximity_threshold);
    reader.read("scene_collision_proximity_threshold", p.scene_collision_proximity_threshold);
    return;
  }
  reader.get("self_collision_proximity_threshold", p.self_collision_proximity_threshold);
  reader.get("scene_collision_proximity_threshold", p.scene_collision_proximity_threshold);
}

void readCommandParameters(ParameterReader& reader, ServoParameters& p)
{
  reader.get("command_in_type", p.command_in_type);
  reader.get("scale/linear", p.linear_scale);
  reader.get("scale/rotational", p.rotational_scale);
  reader.get("scale/joint", p.joint_scale);
  reader.get("cartesian_command_in_topic", p.cartesian_command_in_topic);
  reader.get("joint_command_in_topic", p.joint_command_in_topic);
  reader.get("joint_topic", p.joint_topic);
  reader.get("incoming_command_timeout", p.incoming_command_timeout);
  reader.get("command_out_topic", p.command_out_topic);
  reader.get("command_out_type", p.command_out_type);
  reader.get("publish_joint_positions", p.publish_joint_positions);
  reader.get("publish_joint_velocities", p.publish_joint_velocities);
  reader.get("publish_joint_accelerations", p.publish_joint_accelerations);
  reader.get("publish_period", p.publish_period);
  reader.get("num_outgoing_halt_msgs_to_publish", p.num_outgoing_halt_msgs_to_publish);
  reader.get("low_pass_filter_coeff", p.low_pass_filter_coeff);
  reader.get("use_gazebo", p.use_gazebo);
  reader.read("low_latency_mode", p.low_latency_mode);
  // Its name of old is warning_topic.
  if (reader.node().hasParam("status_topic") || !reader.read("warning_topic", p.status_topic))
    reader.get("status_topic", p.status_topic);
}

void readRobotParameters(ParameterReader& reader, ServoParameters& p)
{
  reader.get("move_group_name", p.move_group_name);
  reader.get("planning_frame", p.planning_frame);
  reader.get("ee_frame_name", p.ee_frame_name);
  reader.get("robot_link_command_frame", p.robot_link_command_frame);
  reader.get("lower_singularity_threshold", p.lower_singularity_threshold);
  reader.get("hard_stop_singularity_threshold", p.hard_stop_singularity_threshold);
  reader.get("joint_limit_margin", p.joint_limit_margin);
}

void tellOfOthers(const ParameterReader& reader)
{
  for (const char* name :
       { "halt_all_joints_in_joint_mode", "halt_all_joints_in_cartesian_mode", "is_primary_planning_scene_monitor",
         "smoothing_filter_plugin_name", "override_velocity_scaling_factor" })
    if (reader.node().hasParam(name))
      ROS_WARN_NAMED(LOGNAME, "Parameter %s is MoveIt 2's and has no effect", reader.node().resolveName(name).c_str());
}

// In this order, as upstream has it: the first that is wrong is told.
std::string whatIsWrongWithMotion(const ServoParameters& p)
{
  if (!(p.publish_period > 0.0))
    return "publish_period has to be greater than zero";
  if (p.num_outgoing_halt_msgs_to_publish < 0)
    return "num_outgoing_halt_msgs_to_publish has to be zero (publish for ever) or more";
  if (!(p.lower_singularity_threshold >= 0.0) || !(p.hard_stop_singularity_threshold >= p.lower_singularity_threshold))
    return "hard_stop_singularity_threshold has to be at least lower_singularity_threshold, and neither less than zero";
  if (!(p.low_pass_filter_coeff >= 1.0))
    return "low_pass_filter_coeff has to be at least 1: below it the filter rings";
  if (!(p.joint_limit_margin >= 0.0))
    return "joint_limit_margin has to be zero or more";
  return "";
}

std::string whatIsWrongWithCommands(const ServoParameters& p)
{
  if (p.command_in_type != "unitless" && p.command_in_type != "speed_units")
    return "command_in_type is '" + p.command_in_type + "'; it has to be 'unitless' or 'speed_units'";
  if (p.command_out_type != "trajectory_msgs/JointTrajectory" && p.command_out_type != "std_msgs/Float64MultiArray")
    return "command_out_type is '" + p.command_out_type +
           "'; it has to be 'trajectory_msgs/JointTrajectory' or 'std_msgs/Float64MultiArray'";
  if (!p.publish_joint_positions && !p.publish_joint_velocities && !p.publish_joint_accelerations)
    return "one of publish_joint_positions, publish_joint_velocities and publish_joint_accelerations has to be true";
  if (p.command_out_type == "std_msgs/Float64MultiArray" && p.publish_joint_positions && p.publish_joint_velocities)
    return "a std_msgs/Float64MultiArray holds positions or velocities: choose publish_joint_positions or publish_joint_velocities";
  return "";
}

std::string whatIsWrongWithCollisions(const ServoParameters& p)
{
  if (p.collision_check_type != "threshold_distance" && p.collision_check_type != "stop_distance")
    return "collision_check_type is '" + p.collision_check_type + "'; it has to be 'threshold_distance' or 'stop_distance'";
  if (!(p.self_collision_proximity_threshold >= 0.0))
    return "self_collision_proximity_threshold has to be zero or more";
  if (!(p.scene_collision_proximity_threshold >= 0.0))
    return "scene_collision_proximity_threshold has to be zero or more";
  if (!(p.collision_check_rate > 0.0))
    return "collision_check_rate has to be greater than zero";
  if (!(p.collision_distance_safety_factor >= 1.0))
    return "collision_distance_safety_factor has to be 1 or more";
  if (!(p.min_allowable_collision_distance >= 0.0))
    return "min_allowable_collision_distance has to be zero or more";
  return "";
}
}  // namespace

std::string whatIsWrong(const ServoParameters& p)
{
  for (const auto& part : { whatIsWrongWithMotion, whatIsWrongWithCommands, whatIsWrongWithCollisions })
  {
    const std::string wrong = part(p);
    if (!wrong.empty())
      return wrong;
  }
  return "";
}

bool readParameters(ServoParameters& p)
{
  ParameterReader reader(LOGNAME);
  readRobotParameters(reader, p);
  readCommandParameters(reader, p);
  readCollisionParameters(reader, p);
  tellOfOthers(reader);
  if (reader.errors() > 0)
    return false;
  const std::string wrong = whatIsWrong(p);
  if (!wrong.empty())
  {
    ROS_ERROR_NAMED(LOGNAME, "Parameters of %s: %s. Check the yaml file.", ros::this_node::getName().c_str(), wrong.c_str());
    return false;
  }
  if (p.scene_collision_proximity_threshold < p.self_collision_proximity_threshold)
    ROS_WARN_NAMED(LOGNAME,
                   "Parameter self_collision_proximity_threshold is greater than scene_collision_proximity_threshold; "
                   "is it meant?");
  return true;
}
}  // namespace moveit_servo
