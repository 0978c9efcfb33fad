// A node for the rostest: what PoseTracking and its Servo offer, by topics and services.
#include <std_msgs/Float64MultiArray.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <moveit_servo/pose_tracking.h>

#include "../src/examples/example.hpp"

namespace
{
class Node
{
public:
  Node(ros::NodeHandle& nh, const planning_scene_monitor::PlanningSceneMonitorPtr& monitor) : tracker_(nh, monitor)
  {
    outcome_ = nh.advertise<std_msgs::Int8>("outcome", 10);
    move_ = nh.subscribe("move", 1, &Node::move, this);
    gains_ = nh.subscribe("gains", 1, &Node::gains, this);
    stop_ = nh.advertiseService("stop", &Node::stop, this);
    reset_ = nh.advertiseService("reset", &Node::reset, this);
    errors_ = nh.advertiseService("errors", &Node::errors, this);
    pause_ = nh.advertiseService("pause", &Node::pause, this);
  }

private:
  // Three tolerances of the position, m, that of the angle, rad, and how old the target may be, s.
  void move(const std_msgs::Float64MultiArrayConstPtr& msg)
  {
    const auto& d = msg->data;
    std_msgs::Int8 outcome;
    outcome.data = static_cast<int8_t>(tracker_.moveToPose(Eigen::Vector3d(d[0], d[1], d[2]), d[3], d[4]));
    outcome_.publish(outcome);
  }

  void gains(const std_msgs::Float64MultiArrayConstPtr& msg)
  {
    const auto& d = msg->data;
    tracker_.updatePIDConfig(d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7], d[8], d[9], d[10], d[11]);
  }

  bool stop(std_srvs::Trigger::Request& /*req*/, std_srvs::Trigger::Response& res)
  {
    tracker_.stopMotion();
    return res.success = true;
  }

  bool reset(std_srvs::Trigger::Request& /*req*/, std_srvs::Trigger::Response& res)
  {
    tracker_.resetTargetPose();
    return res.success = true;
  }

  bool errors(std_srvs::Trigger::Request& /*req*/, std_srvs::Trigger::Response& res)
  {
    double e[4];
    tracker_.getPIDErrors(e[0], e[1], e[2], e[3]);
    for (const double each : e)
      res.message += std::to_string(each) + " ";
    return res.success = true;
  }

  bool pause(std_srvs::SetBool::Request& req, std_srvs::SetBool::Response& res)
  {
    tracker_.servo_->setPaused(req.data);
    return res.success = true;
  }

  moveit_servo::PoseTracking tracker_;
  ros::Publisher outcome_;
  ros::Subscriber move_, gains_;
  ros::ServiceServer stop_, reset_, errors_, pause_;
};
}  // namespace

int main(int argc, char** argv)
{
  ros::init(argc, argv, "pose_tracker");
  ros::NodeHandle nh("~");
  ros::AsyncSpinner spinner(8);
  spinner.start();
  const auto monitor = monitorScene();
  if (!monitor)
    return EXIT_FAILURE;
  const Node node(nh, monitor);
  ros::waitForShutdown();
  return EXIT_SUCCESS;
}
