#include <moveit/kinematics_base/kinematics_base.h>

#include <moveit/robot_model/joint_model_group.h>
#include <moveit/robot_model/robot_model.h>

#include "frames.hpp"
#include "log_names.hpp"

namespace kinematics
{
namespace detail
{
namespace
{
std::string& privateName()
{
  static std::string name = "~";
  return name;
}
}  // namespace

ros::NodeHandle& privateParameters()
{
  static ros::NodeHandle* const handle = new ros::NodeHandle(privateName());  // never destroyed: it would outlive roscpp
  return *handle;
}

void setPrivateParameters(const std::string& node_name) { privateName() = node_name; }
}  // namespace detail

const double KinematicsBase::DEFAULT_SEARCH_DISCRETIZATION = 0.1;
const double KinematicsBase::DEFAULT_TIMEOUT = 1.0;

KinematicsBase::KinematicsBase()
  : tip_frame_("DEPRECATED")
  , search_discretization_(DEFAULT_SEARCH_DISCRETIZATION)
  , default_timeout_(DEFAULT_TIMEOUT)
  , supported_methods_{ DiscretizationMethods::NO_DISCRETIZATION }
{
}

KinematicsBase::~KinematicsBase() = default;

void KinematicsBase::storeValues(const moveit::core::RobotModel& robot_model, const std::string& group_name,
                                 const std::string& base_frame, const std::vector<std::string>& tip_frames,
                                 double search_discretization)
{
  robot_model_ = moveit::core::RobotModelConstPtr(&robot_model, [](const moveit::core::RobotModel*) {});
  setValues("", group_name, base_frame, tip_frames, search_discretization);
}

void KinematicsBase::setValues(const std::string& robot_description, const std::string& group_name,
                               const std::string& base_frame, const std::vector<std::string>& tip_frames,
                               double search_discretization)
{
  robot_description_ = robot_description;
  group_name_ = group_name;
  base_frame_ = frames::withoutSlash(base_frame);
  tip_frames_.clear();
  for (const std::string& name : tip_frames)
    tip_frames_.push_back(frames::withoutSlash(name));
  if (tip_frames_.size() == 1)
    tip_frame_ = tip_frames_[0];
  search_discretization_ = search_discretization;
  setSearchDiscretization(search_discretization);
}

void KinematicsBase::setValues(const std::string& robot_description, const std::string& group_name,
                               const std::string& base_frame, const std::string& tip_frame, double search_discretization)
{
  setValues(robot_description, group_name, base_frame, std::vector<std::string>{ tip_frame }, search_discretization);
}

bool KinematicsBase::initialize(const moveit::core::RobotModel& /*robot_model*/, const std::string& group_name,
                                const std::string& /*base_frame*/, const std::vector<std::string>& /*tip_frames*/,
                                double /*search_discretization*/)
{
  ROS_WARN_NAMED(log_names::KINEMATICS_BASE,
                 "The IK plugin for group '%s' relies on deprecated API. Please implement initialize(RobotModel, ...).",
                 group_name.c_str());
  return false;
}

bool KinematicsBase::initialize(const std::string& robot_description, const std::string& group_name,
                                const std::string& base_frame, const std::vector<std::string>& tip_frames,
                                double search_discretization)
{
  if (tip_frames.size() == 1)
    return initialize(robot_description, group_name, base_frame, tip_frames[0], search_discretization);
  ROS_ERROR_NAMED(log_names::KINEMATICS_BASE, "This solver does not support multiple tip frames");
  return false;
}

bool KinematicsBase::initialize(const std::string& /*robot_description*/, const std::string& /*group_name*/,
                                const std::string& /*base_frame*/, const std::string& /*tip_frame*/,
                                double /*search_discretization*/)
{
  return false;
}

const std::string& KinematicsBase::getTipFrame() const
{
  if (tip_frames_.size() > 1)
    ROS_ERROR_NAMED(log_names::KINEMATICS_BASE, "This kinematic solver has more than one tip frame, do not call getTipFrame()");
  return tip_frames_.at(0);
}

bool KinematicsBase::setRedundantJoints(const std::vector<unsigned int>& redundant_joint_indices)
{
  for (unsigned int index : redundant_joint_indices)
    if (index >= getJointNames().size())
      return false;
  redundant_joint_indices_ = redundant_joint_indices;
  setSearchDiscretization(search_discretization_);
  return true;
}

bool KinematicsBase::setRedundantJoints(const std::vector<std::string>& redundant_joint_names)
{
  const std::vector<std::string>& names = getJointNames();
  std::vector<unsigned int> indices;
  for (const std::string& name : redundant_joint_names)
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name)
        indices.push_back(i);
  return indices.size() == redundant_joint_names.size() && setRedundantJoints(indices);
}

void KinematicsBase::setSearchDiscretization(double sd)
{
  redundant_joint_discretization_.clear();
  for (unsigned int index : redundant_joint_indices_)
    redundant_joint_discretization_[index] = sd;
}

void KinematicsBase::setSearchDiscretization(const std::map<int, double>& discretization)
{
  redundant_joint_discretization_ = discretization;
  redundant_joint_indices_.clear();
  for (const auto& item : discretization)
    redundant_joint_indices_.push_back(item.first);
}

double KinematicsBase::getSearchDiscretization(int joint_index) const
{
  const auto found = redundant_joint_discretization_.find(joint_index);
  return found == redundant_joint_discretization_.end() ? 0.0 : found->second;
}

bool KinematicsBase::supportsGroup(const moveit::core::JointModelGroup* jmg, std::string* error_text_out) const
{
  if (jmg->isChain())
    return true;
  if (error_text_out)
    *error_text_out = "This plugin only supports joint groups which are chains";
  return false;
}

bool KinematicsBase::getPositionIK(const std::vector<geometry_msgs::Pose>& ik_poses, const std::vector<double>& ik_seed_state,
                                   std::vector<std::vector<double>>& solutions, KinematicsResult& result,
                                   const KinematicsQueryOptions& options) const
{
  result.solution_percentage = 0.0;
  if (options.discretization_method != DiscretizationMethods::NO_DISCRETIZATION)
  {
    result.kinematic_error = KinematicErrors::UNSUPORTED_DISCRETIZATION_REQUESTED;
    return false;
  }
  if (ik_poses.size() != 1)
  {
    ROS_ERROR_NAMED(log_names::KINEMATICS_BASE, "This kinematic solver does not support getPositionIK for multiple poses");
    result.kinematic_error = ik_poses.empty() ? KinematicErrors::EMPTY_TIP_POSES : KinematicErrors::MULTIPLE_TIPS_NOT_SUPPORTED;
    return false;
  }
  std::vector<double> solution;
  moveit_msgs::MoveItErrorCodes error_code;
  if (!getPositionIK(ik_poses[0], ik_seed_state, solution, error_code, options))
  {
    result.kinematic_error = KinematicErrors::NO_SOLUTION;
    return false;
  }
  solutions.assign(1, solution);
  result.kinematic_error = KinematicErrors::OK;
  result.solution_percentage = 1.0;
  return true;
}

bool KinematicsBase::searchPositionIK(const std::vector<geometry_msgs::Pose>& ik_poses,
                                      const std::vector<double>& ik_seed_state, double timeout,
                                      const std::vector<double>& consistency_limits, std::vector<double>& solution,
                                      const IKCallbackFn& solution_callback, moveit_msgs::MoveItErrorCodes& error_code,
                                      const KinematicsQueryOptions& options,
                                      const moveit::core::RobotState* /*context_state*/) const
{
  if (ik_poses.size() != 1)
  {
    ROS_ERROR_NAMED(log_names::KINEMATICS_BASE, "This kinematic solver does not support searchPositionIK with multiple poses");
    return false;
  }
  if (solution_callback)
    return searchPositionIK(ik_poses[0], ik_seed_state, timeout, consistency_limits, solution, solution_callback, error_code,
                            options);
  return searchPositionIK(ik_poses[0], ik_seed_state, timeout, consistency_limits, solution, error_code, options);
}
}  // namespace kinematics
