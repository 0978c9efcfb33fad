// Inverse kinematics for what is dragged: the newest pose wins.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <moveit/robot_state/robot_state.h>
#include <mutex>
#include <ros/service_client.h>
#include <string>
#include <thread>

namespace moveit_rviz_plugin {

// Asks move_group's service compute_ik in a thread of its own.
class IkFollower {
 public:
  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
  struct Request {
    EIGEN_MAKE_ALIGNED_OPERATOR_NEW
    std::string service;  // compute_ik, in move_group's namespace
    std::string group, link;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // of the link, in the model frame
    moveit::core::RobotStatePtr seed;
    bool avoid_collisions = false;
    bool approximate = false;  // as far as there is a way, along the straight line from where the seed has the link
  };
  struct Answer {
    moveit::core::RobotStatePtr state;  // null: nothing new is reachable
    bool reached = false;               // the pose that was asked for
    std::string problem;                // one line, when the service could not be asked
  };

  // `done` is called in the thread.
  explicit IkFollower(std::function<void(const Answer&)> done);
  ~IkFollower();

  // Forgets a request that has not begun.
  void follow(const Request& request);

 private:
  void work();
  Answer answer(const Request& request);
  // 1: solved, 0: there is no solution, -1: nobody answers.
  int solve(const Request& request, const Eigen::Isometry3d& pose, moveit::core::RobotState& state);

  std::function<void(const Answer&)> done_;
  std::mutex lock_;
  std::condition_variable changed_;
  std::unique_ptr<Request> request_;
  bool ending_ = false;
  ros::ServiceClient client_;
  std::string client_name_;
  std::thread thread_;
};

}  // namespace moveit_rviz_plugin
