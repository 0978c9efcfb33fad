// States: inverse kinematics through the solvers of groups, and differential kinematics.
#include <tf2_eigen/tf2_eigen.h>

#include <Eigen/SVD>

#include <moveit/robot_state/robot_state.h>

#include "frames.hpp"
#include "log_names.hpp"
#include "motion/robot_state.hpp"

namespace moveit
{
namespace core
{
namespace
{
Eigen::Isometry3d fromMessage(const geometry_msgs::Pose& pose)
{
  Eigen::Isometry3d out;
  tf2::fromMsg(pose, out);
  return out;
}
}  // namespace

bool RobotState::setFromIK(const JointModelGroup* group, const geometry_msgs::Pose& pose, double timeout,
                           const GroupStateValidityCallbackFn& constraint, const kinematics::KinematicsQueryOptions& options)
{
  return setFromIK(group, fromMessage(pose), timeout, constraint, options);
}

bool RobotState::setFromIK(const JointModelGroup* group, const geometry_msgs::Pose& pose, const std::string& tip,
                           double timeout, const GroupStateValidityCallbackFn& constraint,
                           const kinematics::KinematicsQueryOptions& options)
{
  return setFromIK(group, fromMessage(pose), tip, timeout, constraint, options);
}

bool RobotState::setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, double timeout,
                           const GroupStateValidityCallbackFn& constraint, const kinematics::KinematicsQueryOptions& options)
{
  const kinematics::KinematicsBaseConstPtr& solver = group->getSolverInstance();
  if (!solver)
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "No kinematics solver instantiated for group '%s'. Is kinematics.yaml loaded?",
                    group->getName().c_str());
    return false;
  }
  return setFromIK(group, pose, solver->getTipFrame(), timeout, constraint, options);
}

bool RobotState::setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, const std::string& tip, double timeout,
                           const GroupStateValidityCallbackFn& constraint, const kinematics::KinematicsQueryOptions& options)
{
  return setFromIK(group, pose, tip, std::vector<double>(), timeout, constraint, options);
}

bool RobotState::setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, const std::string& tip,
                           const std::vector<double>& consistency_limits, double timeout,
                           const GroupStateValidityCallbackFn& constraint, const kinematics::KinematicsQueryOptions& options)
{
  return setFromIK(group, EigenSTL::vector_Isometry3d{ pose }, std::vector<std::string>{ tip },
                   std::vector<std::vector<double>>{ consistency_limits }, timeout, constraint, options);
}

bool RobotState::setFromIK(const JointModelGroup* group, const EigenSTL::vector_Isometry3d& poses,
                           const std::vector<std::string>& tips, double timeout, const GroupStateValidityCallbackFn& constraint,
                           const kinematics::KinematicsQueryOptions& options)
{
  return setFromIK(group, poses, tips, std::vector<std::vector<double>>(), timeout, constraint, options);
}

bool RobotState::setToIKSolverFrame(Eigen::Isometry3d& pose, const kinematics::KinematicsBaseConstPtr& solver)
{
  return setToIKSolverFrame(pose, solver->getBaseFrame());
}

bool RobotState::setToIKSolverFrame(Eigen::Isometry3d& pose, const std::string& ik_frame)
{
  if (Transforms::sameFrame(ik_frame, robot_model_->getModelFrame()))
    return true;
  bool known = false;
  const Eigen::Isometry3d base = getFrameTransform(ik_frame, &known);
  if (!known)
  {
    ROS_ERROR_STREAM_NAMED(log_names::ROBOT_STATE, "The following IK frame does not exist: " << ik_frame);
    return false;
  }
  pose = base.inverse() * pose;
  return true;
}

// The question for the solver when `tip` is to be at `pose`: which of its tips, and where that one is then.
bool RobotState::queryFor(Eigen::Isometry3d pose, std::string tip, const kinematics::KinematicsBaseConstPtr& solver,
                          std::size_t& which, geometry_msgs::Pose& query)
{
  tip = frames::withoutSlash(tip);
  if (!setToIKSolverFrame(pose, solver))
    return false;
  const std::vector<std::string>& own = solver->getTipFrames();
  for (which = 0; which < own.size(); ++which)
    if (frames::withoutSlash(own[which]) == tip)
    {
      query = tf2::toMsg(pose);
      return true;
    }
  Eigen::Isometry3d in_parent;
  const LinkModel* parent = getRigidlyConnectedParentLinkModel(tip, &in_parent);
  for (which = 0; parent && which < own.size(); ++which)
  {
    Eigen::Isometry3d own_in_parent;
    if (getRigidlyConnectedParentLinkModel(own[which], &own_in_parent) != parent)
      continue;
    query = tf2::toMsg(Eigen::Isometry3d(pose * in_parent.inverse() * own_in_parent));
    return true;
  }
  ROS_ERROR_NAMED(log_names::ROBOT_STATE,
                  "Cannot compute IK for query pose reference frame '%s': the solver of group '%s' moves '%s'", tip.c_str(),
                  solver->getGroupName().c_str(), own.empty() ? "" : own[0].c_str());
  return false;
}

bool RobotState::solve(const JointModelGroup* group, const JointModelGroup::KinematicsSolver& solver,
                       const std::vector<geometry_msgs::Pose>& queries, const std::vector<double>& consistency, double timeout,
                       const GroupStateValidityCallbackFn& constraint, const kinematics::KinematicsQueryOptions& options,
                       const JointModelGroup* reported)
{
  const std::vector<unsigned int>& place = solver.bijection_;
  std::vector<double> values, seed(place.size()), limits, found;
  copyJointGroupPositions(group, values);
  for (std::size_t i = 0; i < place.size(); ++i)
    seed[i] = values[place[i]];
  if (consistency.size() == values.size())
    for (unsigned int index : place)
      limits.push_back(consistency[index]);
  auto inGroup = [&](const std::vector<double>& solution) {
    std::vector<double> all = values;
    for (std::size_t i = 0; i < place.size() && i < solution.size(); ++i)
      all[place[i]] = solution[i];
    return all;
  };
  kinematics::KinematicsBase::IKCallbackFn callback;
  if (constraint)
    callback = [&](const geometry_msgs::Pose& /*pose*/, const std::vector<double>& solution,
                   moveit_msgs::MoveItErrorCodes& error_code) {
      const std::vector<double> all = inGroup(solution);
      error_code.val = constraint(this, reported, all.data()) ? moveit_msgs::MoveItErrorCodes::SUCCESS
                                                              : moveit_msgs::MoveItErrorCodes::NO_IK_SOLUTION;
    };
  moveit_msgs::MoveItErrorCodes error;
  if (!solver.solver_instance_->searchPositionIK(queries, seed, timeout, limits, found, callback, error, options, this))
    return false;
  setJointGroupPositions(group, inGroup(found));
  return true;
}

bool RobotState::setFromIK(const JointModelGroup* group, const EigenSTL::vector_Isometry3d& poses,
                           const std::vector<std::string>& tips, const std::vector<std::vector<double>>& consistency_limits,
                           double timeout, const GroupStateValidityCallbackFn& constraint,
                           const kinematics::KinematicsQueryOptions& options)
{
  if (poses.size() != tips.size() || poses.empty())
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "Number of poses must be the same as number of tips");
    return false;
  }
  const JointModelGroup::KinematicsSolver& own = group->getGroupKinematics().first;
  if (!own.solver_instance_)
  {
    if (poses.size() > 1 || !group->getGroupKinematics().second.empty())
      return setFromIKSubgroups(group, poses, tips, consistency_limits, timeout, constraint, options);
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "No kinematics solver instantiated for group '%s'. Is kinematics.yaml loaded?",
                    group->getName().c_str());
    return false;
  }
  const kinematics::KinematicsBaseConstPtr solver = own.solver_instance_;
  const std::size_t wanted = solver->getTipFrames().size();
  if (poses.size() > wanted)
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "%zu poses for the solver of group '%s', which takes %zu", poses.size(),
                    group->getName().c_str(), wanted);
    return false;
  }
  // Tips that nothing is said of stay where they are.
  std::vector<geometry_msgs::Pose> queries(wanted);
  std::vector<char> said(wanted, 0);
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    std::size_t which;
    geometry_msgs::Pose query;
    if (!queryFor(poses[i], tips[i], solver, which, query))
      return false;
    queries[which] = query;
    said[which] = 1;
  }
  for (std::size_t i = 0; i < wanted; ++i)
  {
    std::size_t which;
    const Eigen::Isometry3d now = getFrameTransform(solver->getTipFrames()[i]);
    if (!said[i] && !queryFor(now, solver->getTipFrames()[i], solver, which, queries[i]))
      return false;
  }
  const std::vector<double> limits = consistency_limits.empty() ? std::vector<double>() : consistency_limits[0];
  if (timeout < std::numeric_limits<double>::epsilon())
    timeout = group->getDefaultIKTimeout();
  return solve(group, own, queries, limits, timeout, constraint, options, group);
}

bool RobotState::setFromIKSubgroups(const JointModelGroup* group, const EigenSTL::vector_Isometry3d& poses,
                                    const std::vector<std::string>& tips,
                                    const std::vector<std::vector<double>>& consistency_limits, double timeout,
                                    const GroupStateValidityCallbackFn& constraint,
                                    const kinematics::KinematicsQueryOptions& options)
{
  std::vector<std::pair<const JointModelGroup*, const JointModelGroup::KinematicsSolver*>> parts;
  for (const auto& sub : group->getGroupKinematics().second)
    if (sub.second.solver_instance_)
      parts.emplace_back(sub.first, &sub.second);
  if (parts.size() < poses.size() || parts.empty())
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "%zu poses for the %zu subgroups of '%s' that have kinematics solvers",
                    poses.size(), parts.size(), group->getName().c_str());
    return false;
  }
  const RobotState before(*this);
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    // The subgroup whose solver moves this tip.
    bool done = false;
    for (const auto& part : parts)
    {
      const kinematics::KinematicsBaseConstPtr solver = part.second->solver_instance_;
      if (solver->getTipFrames().size() != 1 || !part.first->canSetStateFromIK(tips[i]))
        continue;
      std::size_t which;
      std::vector<geometry_msgs::Pose> query(1);
      JointModelGroup::KinematicsSolver own = part.first->getGroupKinematics().first;
      const double time = timeout < std::numeric_limits<double>::epsilon() ? part.first->getDefaultIKTimeout() : timeout;
      const std::vector<double> limits = i < consistency_limits.size() ? consistency_limits[i] : std::vector<double>();
      done = queryFor(poses[i], tips[i], solver, which, query[0]) &&
             solve(part.first, own, query, limits, time, GroupStateValidityCallbackFn(), options, group);
      break;
    }
    if (!done)
    {
      *this = before;
      return false;
    }
  }
  if (constraint)
  {
    std::vector<double> values;
    copyJointGroupPositions(group, values);
    if (!constraint(this, group, values.data()))
    {
      *this = before;
      return false;
    }
  }
  return true;
}

// ---------------------------------------------------------------- differential kinematics

bool RobotState::getJacobian(const JointModelGroup* group, const LinkModel* link,
                             const Eigen::Vector3d& reference_point_position, Eigen::MatrixXd& jacobian,
                             bool use_quaternion_representation) const
{
  if (!group->isChain())
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "The group '%s' is not a chain. Cannot compute Jacobian.",
                    group->getName().c_str());
    return false;
  }
  if (!group->isLinkUpdated(link->getName()))
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "Link name '%s' does not exist in the chain '%s' or is not a child for this chain",
                    link->getName().c_str(), group->getName().c_str());
    return false;
  }
  const motion::Jacobian J = core_->jacobian(group->core(), link->getLinkIndex(), reference_point_position);
  jacobian = Eigen::MatrixXd::Zero(use_quaternion_representation ? 7 : 6, group->getVariableCount());
  Eigen::Matrix<double, 4, 3> to_quaternion;
  if (use_quaternion_representation)
  {
    const LinkModel* base = group->getJointModels()[0]->getParentLinkModel();
    Eigen::Isometry3d pose = getGlobalLinkTransform(link);
    if (base)
      pose = getGlobalLinkTransform(base).inverse() * pose;
    const Eigen::Quaterniond q(pose.linear());
    to_quaternion << -q.x(), -q.y(), -q.z(), q.w(), q.z(), -q.y(), -q.z(), q.w(), q.x(), q.y(), -q.x(), q.w();
  }
  const std::vector<std::string>& active = group->core().variable_names;
  for (std::size_t i = 0; i < active.size(); ++i)
  {
    const int column = group->getVariableGroupIndex(active[i]);
    jacobian.col(column).head<3>() = J.col(i).head<3>();
    if (use_quaternion_representation)
      jacobian.col(column).tail<4>() = 0.5 * to_quaternion * J.col(i).tail<3>();
    else
      jacobian.col(column).tail<3>() = J.col(i).tail<3>();
  }
  return true;
}

Eigen::MatrixXd RobotState::getJacobian(const JointModelGroup* group, const Eigen::Vector3d& reference_point_position) const
{
  Eigen::MatrixXd jacobian;
  if (!getJacobian(group, group->getLinkModels().back(), reference_point_position, jacobian))
    throw Exception("Unable to compute Jacobian");
  return jacobian;
}

void RobotState::computeVariableVelocity(const JointModelGroup* jmg, Eigen::VectorXd& qdot, const Eigen::VectorXd& twist,
                                         const LinkModel* tip) const
{
  Eigen::MatrixXd J;
  if (!getJacobian(jmg, tip, Eigen::Vector3d::Zero(), J))
    throw Exception("Unable to compute Jacobian");
  // From the base's axes to the tip's.
  const LinkModel* base = jmg->getJointModels()[0]->getParentLinkModel();
  Eigen::Matrix3d to_tip = getGlobalLinkTransform(tip).linear().transpose();
  if (base)
    to_tip = to_tip * getGlobalLinkTransform(base).linear();
  J.topRows<3>() = to_tip * J.topRows<3>();
  J.bottomRows<3>() = to_tip * J.bottomRows<3>();
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(1e-9);
  qdot = svd.solve(twist);
}

bool RobotState::integrateVariableVelocity(const JointModelGroup* jmg, const Eigen::VectorXd& qdot, double dt,
                                           const GroupStateValidityCallbackFn& constraint)
{
  Eigen::VectorXd q(jmg->getVariableCount());
  copyJointGroupPositions(jmg, q);
  q += dt * qdot;
  setJointGroupPositions(jmg, q);
  enforceBounds(jmg);
  if (!constraint)
    return true;
  std::vector<double> values;
  copyJointGroupPositions(jmg, values);
  return constraint(this, jmg, values.data());
}

bool RobotState::setFromDiffIK(const JointModelGroup* group, const Eigen::VectorXd& twist, const std::string& tip, double dt,
                               const GroupStateValidityCallbackFn& constraint)
{
  Eigen::VectorXd qdot;
  computeVariableVelocity(group, qdot, twist, getLinkModel(tip));
  return integrateVariableVelocity(group, qdot, dt, constraint);
}

bool RobotState::setFromDiffIK(const JointModelGroup* group, const geometry_msgs::Twist& twist, const std::string& tip,
                               double dt, const GroupStateValidityCallbackFn& constraint)
{
  Eigen::VectorXd vector(6);
  vector << twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.x, twist.angular.y, twist.angular.z;
  return setFromDiffIK(group, vector, tip, dt, constraint);
}
}  // namespace core
}  // namespace moveit
