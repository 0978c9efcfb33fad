// The node: commands come by topics below its name.
#include <moveit_servo/servo.h>
#include <tf2_ros/transform_listener.h>

int main(int argc, char** argv)
{
  ros::init(argc, argv, "servo_server");
  ros::AsyncSpinner spinner(8);
  spinner.start();
  ros::NodeHandle nh("~");

  const auto transforms = std::make_shared<tf2_ros::Buffer>();
  const tf2_ros::TransformListener listener(*transforms);
  using planning_scene_monitor::PlanningSceneMonitor;
  const auto monitor = std::make_shared<PlanningSceneMonitor>("robot_description", transforms);
  if (!monitor->getPlanningScene())
    return EXIT_FAILURE;  // the monitor has said why
  monitor->startSceneMonitor();
  monitor->startWorldGeometryMonitor(PlanningSceneMonitor::DEFAULT_COLLISION_OBJECT_TOPIC,
                                     PlanningSceneMonitor::DEFAULT_PLANNING_SCENE_WORLD_TOPIC, false);
  monitor->startStateMonitor(nh.param<std::string>("joint_topic", PlanningSceneMonitor::DEFAULT_JOINT_STATES_TOPIC));

  moveit_servo::Servo servo(nh, monitor);
  servo.start();
  ros::waitForShutdown();
  return EXIT_SUCCESS;
}
