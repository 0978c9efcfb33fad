// Sends the arm to four joint angles and prints where the joints are:
//   rosrun arm_controller arm_controller_node 1 1 1 1
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64.h>

namespace {

constexpr std::size_t kJoints = 4;

/// Reads a whole word as a finite number; false when it is anything else.
bool parseAngle(const char* word, double& angle) {
  char* end = nullptr;
  angle = std::strtod(word, &end);
  return end != word && *end == '\0' && std::isfinite(angle);
}

void printPositions(const sensor_msgs::JointState::ConstPtr& state) {
  ROS_INFO("Received joint_state message:");
  for (std::size_t i = 0; i < state->name.size() && i < state->position.size(); ++i)
    ROS_INFO("Position of Joint %s: %f", state->name[i].c_str(), state->position[i]);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "arm_controller");
  if (argc != 1 + static_cast<int>(kJoints)) {
    ROS_INFO(
        "Repeat the command with the right number of the desired joint positions... "
        "(arm_controller_node J0 J1 J2 J3: four angles in rad, got %d)",
        argc - 1);
    return EXIT_FAILURE;
  }
  std::array<std_msgs::Float64, kJoints> commands;
  for (std::size_t i = 0; i < kJoints; ++i) {
    if (!parseAngle(argv[i + 1], commands[i].data)) {
      ROS_ERROR("Joint angle J%zu is '%s': give a finite number in rad.", i, argv[i + 1]);
      return EXIT_FAILURE;
    }
  }

  ros::NodeHandle arm("arm");
  const ros::Subscriber states = arm.subscribe("joint_states", 10, printPositions);
  std::array<ros::Publisher, kJoints> publishers;
  for (std::size_t i = 0; i < kJoints; ++i)
    publishers[i] = arm.advertise<std_msgs::Float64>("joint" + std::to_string(i) + "_position_controller/command", 1);

  ros::Rate rate(10);  // in simulated time when /use_sim_time is set
  while (ros::ok()) {
    for (std::size_t i = 0; i < kJoints; ++i) {
      ROS_INFO("Position command to joint%zu: %.2f", i, commands[i].data);
      publishers[i].publish(commands[i]);
    }
    ros::spinOnce();
    rate.sleep();
  }
  return EXIT_SUCCESS;
}
