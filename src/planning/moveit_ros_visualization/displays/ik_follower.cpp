#include "ik_follower.hpp"

#include <moveit/robot_state/conversions.h>
#include <moveit_msgs/GetPositionIK.h>
#include <ros/node_handle.h>
#include <tf2_eigen/tf2_eigen.h>

namespace moveit_rviz_plugin {
namespace {
constexpr double TIMEOUT = 0.05;  // s for one solution: longer, and the hand would wait
constexpr int HALVINGS = 5;
}  // namespace

IkFollower::IkFollower(std::function<void(const Answer&)> done) : done_(std::move(done)), thread_([this]() { work(); }) {}

IkFollower::~IkFollower() {
  {
    const std::lock_guard<std::mutex> lock(lock_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void IkFollower::follow(const Request& request) {
  {
    const std::lock_guard<std::mutex> lock(lock_);
    request_ = std::make_unique<Request>(request);
  }
  changed_.notify_one();
}

void IkFollower::work() {
  for (;;) {
    std::unique_ptr<Request> request;
    {
      std::unique_lock<std::mutex> lock(lock_);
      changed_.wait(lock, [this]() { return ending_ || request_; });
      if (ending_) return;
      request = std::move(request_);
    }
    done_(answer(*request));
  }
}

IkFollower::Answer IkFollower::answer(const Request& request) {
  Answer result;
  const auto state = std::make_shared<moveit::core::RobotState>(*request.seed);
  const int found = solve(request, request.pose, *state);
  if (found < 0) {
    result.problem = "nobody answers " + client_name_ + ": is move_group running?";
    return result;
  }
  if (found > 0) {
    result.state = state;
    result.reached = true;
    return result;
  }
  if (!request.approximate) return result;
  const Eigen::Isometry3d from = request.seed->getGlobalLinkTransform(request.link);
  const Eigen::Quaterniond turn_from(from.linear()), turn_to(request.pose.linear());
  double low = 0.0, high = 1.0;
  for (int i = 0; i < HALVINGS; ++i) {
    const double middle = 0.5 * (low + high);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = (1.0 - middle) * from.translation() + middle * request.pose.translation();
    pose.linear() = turn_from.slerp(middle, turn_to).toRotationMatrix();
    auto nearer = std::make_shared<moveit::core::RobotState>(result.state ? *result.state : *request.seed);
    if (solve(request, pose, *nearer) > 0) {
      result.state = nearer;
      low = middle;
    } else {
      high = middle;
    }
  }
  return result;
}

int IkFollower::solve(const Request& request, const Eigen::Isometry3d& pose, moveit::core::RobotState& state) {
  if (!client_.isValid() || client_name_ != request.service) {
    client_name_ = request.service;
    client_ = ros::NodeHandle().serviceClient<moveit_msgs::GetPositionIK>(client_name_, true);
  }
  moveit_msgs::GetPositionIK call;
  moveit_msgs::PositionIKRequest& ik = call.request.ik_request;
  ik.group_name = request.group;
  ik.ik_link_name = request.link;
  ik.avoid_collisions = request.avoid_collisions;
  ik.timeout = ros::Duration(TIMEOUT);
  ik.pose_stamped.header.frame_id = state.getRobotModel()->getModelFrame();
  ik.pose_stamped.pose = tf2::toMsg(pose);
  moveit::core::robotStateToRobotStateMsg(state, ik.robot_state, request.avoid_collisions);
  if (!client_.call(call)) {
    client_.shutdown();
    return -1;
  }
  if (call.response.error_code.val != moveit_msgs::MoveItErrorCodes::SUCCESS) return 0;
  const moveit::core::JointModelGroup* group = state.getJointModelGroup(request.group);
  moveit::core::RobotState solved = state;
  moveit::core::jointStateToRobotState(call.response.solution.joint_state, solved);
  // Only the group moves: the rest is as it is asked here, not as the robot stands.
  std::vector<double> values;
  solved.copyJointGroupPositions(group, values);
  state.setJointGroupPositions(group, values);
  state.update();
  return 1;
}

}  // namespace moveit_rviz_plugin
