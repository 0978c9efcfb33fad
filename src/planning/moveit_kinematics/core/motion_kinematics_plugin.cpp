// The motion library's inverse kinematics as a plugin for compiled programs, under the names that kinematics.yaml has.
#include <moveit/kinematics_base/kinematics_base.h>
#include <moveit/robot_model/robot_model.h>
#include <moveit/robot_state/robot_state.h>
#include <pluginlib/class_list_macros.hpp>
#include <tf2_eigen/tf2_eigen.h>

#include <atomic>
#include <memory>

#include "motion/ik.hpp"

namespace motion_kinematics_plugin
{
class MotionKinematicsPlugin : public kinematics::KinematicsBase
{
public:
  bool initialize(const moveit::core::RobotModel& robot_model, const std::string& group_name, const std::string& base_frame,
                  const std::vector<std::string>& tip_frames, double search_discretization) override
  {
    storeValues(robot_model, group_name, base_frame, tip_frames, search_discretization);
    const moveit::core::JointModelGroup* group = robot_model.getJointModelGroup(group_name);
    if (!group)
      return false;
    try
    {
      group_ = &group->core();
      solver_.reset(new motion::IkSolver(robot_model.core(), *group_));
      for (const std::string& tip : tip_frames_)
        tips_.push_back(robot_model.core()->link(tip).index);
    }
    catch (const motion::Error& error)
    {
      ROS_ERROR_NAMED("kinematics", "%s", error.what());
      return false;
    }
    names_ = group->getActiveJointModelNames();
    double orientation_vs_position = 1.0;
    lookupParam("orientation_vs_position", orientation_vs_position, 1.0);
    lookupParam("position_only_ik", position_only_, false);
    position_only_ |= orientation_vs_position == 0.0;
    lookupParam("epsilon", tolerance_, 1e-5);
    return true;
  }

  bool supportsGroup(const moveit::core::JointModelGroup* jmg, std::string* error_text_out) const override
  {
    if (jmg->isSingleDOFJoints())
      return true;
    if (error_text_out)
      *error_text_out = "inverse kinematics needs joints with one variable";
    return false;
  }

  const std::vector<std::string>& getJointNames() const override { return names_; }
  const std::vector<std::string>& getLinkNames() const override { return tip_frames_; }

  using KinematicsBase::getPositionIK;
  bool getPositionIK(const geometry_msgs::Pose& pose, const std::vector<double>& seed, std::vector<double>& solution,
                     moveit_msgs::MoveItErrorCodes& error_code,
                     const kinematics::KinematicsQueryOptions& options) const override
  {
    return search({ pose }, seed, 0.0, {}, solution, IKCallbackFn(), error_code, options, nullptr);
  }

  bool searchPositionIK(const geometry_msgs::Pose& pose, const std::vector<double>& seed, double timeout,
                        std::vector<double>& solution, moveit_msgs::MoveItErrorCodes& error_code,
                        const kinematics::KinematicsQueryOptions& options) const override
  {
    return search({ pose }, seed, timeout, {}, solution, IKCallbackFn(), error_code, options, nullptr);
  }

  bool searchPositionIK(const geometry_msgs::Pose& pose, const std::vector<double>& seed, double timeout,
                        const std::vector<double>& consistency, std::vector<double>& solution,
                        moveit_msgs::MoveItErrorCodes& error_code,
                        const kinematics::KinematicsQueryOptions& options) const override
  {
    return search({ pose }, seed, timeout, consistency, solution, IKCallbackFn(), error_code, options, nullptr);
  }

  bool searchPositionIK(const geometry_msgs::Pose& pose, const std::vector<double>& seed, double timeout,
                        std::vector<double>& solution, const IKCallbackFn& callback, moveit_msgs::MoveItErrorCodes& error_code,
                        const kinematics::KinematicsQueryOptions& options) const override
  {
    return search({ pose }, seed, timeout, {}, solution, callback, error_code, options, nullptr);
  }

  bool searchPositionIK(const geometry_msgs::Pose& pose, const std::vector<double>& seed, double timeout,
                        const std::vector<double>& consistency, std::vector<double>& solution, const IKCallbackFn& callback,
                        moveit_msgs::MoveItErrorCodes& error_code,
                        const kinematics::KinematicsQueryOptions& options) const override
  {
    return search({ pose }, seed, timeout, consistency, solution, callback, error_code, options, nullptr);
  }

  bool searchPositionIK(const std::vector<geometry_msgs::Pose>& poses, const std::vector<double>& seed, double timeout,
                        const std::vector<double>& consistency, std::vector<double>& solution, const IKCallbackFn& callback,
                        moveit_msgs::MoveItErrorCodes& error_code, const kinematics::KinematicsQueryOptions& options,
                        const moveit::core::RobotState* context_state) const override
  {
    return search(poses, seed, timeout, consistency, solution, callback, error_code, options, context_state);
  }

  bool getPositionFK(const std::vector<std::string>& link_names, const std::vector<double>& joint_angles,
                     std::vector<geometry_msgs::Pose>& poses) const override
  {
    if (!solver_ || joint_angles.size() != names_.size())
      return false;
    motion::RobotState state(robot_model_->core());
    state.setGroup(*group_, joint_angles.data());
    poses.clear();
    for (const std::string& name : link_names)
    {
      motion::Transform pose;
      if (!state.framePose(name, pose))
        return false;
      poses.push_back(tf2::toMsg(Eigen::Isometry3d(base(state).inverse() * pose)));
    }
    return true;
  }

private:
  motion::Transform base(const motion::RobotState& state) const
  {
    motion::Transform pose = motion::Transform::Identity();
    state.framePose(base_frame_, pose);
    return pose;
  }

  bool search(const std::vector<geometry_msgs::Pose>& poses, const std::vector<double>& seed, double timeout,
              const std::vector<double>& consistency, std::vector<double>& solution, const IKCallbackFn& callback,
              moveit_msgs::MoveItErrorCodes& error_code, const kinematics::KinematicsQueryOptions& query,
              const moveit::core::RobotState* context) const
  {
    static std::atomic<std::uint64_t> asked{ 0 };
    error_code.val = moveit_msgs::MoveItErrorCodes::NO_IK_SOLUTION;
    if (!solver_ || seed.size() != names_.size() || poses.size() != tips_.size())
    {
      ROS_ERROR_NAMED("kinematics",
                      "inverse kinematics of group '%s': %zu seed values and %zu poses, but %zu joints and %zu tips",
                      group_name_.c_str(), seed.size(), poses.size(), names_.size(), tips_.size());
      return false;
    }
    motion::RobotState state = context ? context->core() : motion::RobotState(robot_model_->core());
    state.setGroup(*group_, seed.data());
    std::vector<motion::IkTarget> targets;
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
      Eigen::Isometry3d pose;
      tf2::fromMsg(poses[i], pose);
      targets.push_back({ tips_[i], base(state) * pose, true, !position_only_ });
    }
    motion::IkOptions options;
    options.timeout = timeout;
    options.tolerance = tolerance_;
    options.max_restarts = timeout > 0.0 ? -1 : 0;
    options.consistency = consistency;
    options.return_approximate = query.return_approximate_solution;
    options.random_seed = ++asked;
    if (callback)
      options.valid = [&](const double* values) {
        moveit_msgs::MoveItErrorCodes verdict;
        callback(poses[0], std::vector<double>(values, values + names_.size()), verdict);
        return verdict.val == moveit_msgs::MoveItErrorCodes::SUCCESS;
      };
    const motion::IkResult result = solver_->solve(state, targets, options);
    if (result.solutions.empty())
      return false;
    solution = result.solutions[0];
    error_code.val = moveit_msgs::MoveItErrorCodes::SUCCESS;
    return true;
  }

  std::unique_ptr<motion::IkSolver> solver_;
  const motion::JointModelGroup* group_ = nullptr;
  std::vector<int> tips_;
  std::vector<std::string> names_;
  bool position_only_ = false;
  double tolerance_ = 1e-5;
};
}  // namespace motion_kinematics_plugin

PLUGINLIB_EXPORT_CLASS(motion_kinematics_plugin::MotionKinematicsPlugin, kinematics::KinematicsBase)
