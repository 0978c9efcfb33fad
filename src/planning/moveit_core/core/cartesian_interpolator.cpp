#include <moveit/robot_state/cartesian_interpolator.h>

#include <moveit/robot_model/revolute_joint_model.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "log_names.hpp"

namespace moveit
{
namespace core
{
namespace
{
// Below this number of steps a mean says nothing.
constexpr std::size_t MIN_STEPS_FOR_JUMP_THRESH = 10;

// Beyond a limit the same pose may be had by turning a joint all the way back, which is no step along a line.
bool turnsOver(const RobotState& before, const RobotState& after, const JointModelGroup& group)
{
  for (const JointModel* joint : group.getActiveJointModels())
    if (joint->getType() == JointModel::REVOLUTE && !static_cast<const RevoluteJointModel*>(joint)->isContinuous() &&
        std::abs(*after.getJointPositions(joint) - *before.getJointPositions(joint)) > M_PI)
      return true;
  return false;
}
}  // namespace

namespace
{
// How far each active joint may go in one step, in its unit; none where no threshold asks for it.
std::vector<double> mostOfAStep(const JointModelGroup& group, const JumpThreshold& threshold)
{
  std::vector<double> most;
  if (threshold.prismatic <= 0.0 && threshold.revolute <= 0.0)
    return most;
  for (const JointModel* joint : group.getActiveJointModels())
  {
    const double limit = joint->getType() == JointModel::REVOLUTE    ? threshold.revolute
                         : joint->getType() == JointModel::PRISMATIC ? threshold.prismatic
                                                                     : 0.0;
    most.push_back(limit > 0.0 ? limit : joint->getMaximumExtent());
  }
  return most;
}

// Puts the link where it is wanted without a turn over; if that cannot be, the state stays as it is.
bool stepTo(RobotState& state, const JointModelGroup& group, const Eigen::Isometry3d& of_link, const LinkModel& link,
            const std::vector<double>& consistency, const GroupStateValidityCallbackFn& validCallback,
            const kinematics::KinematicsQueryOptions& options)
{
  const RobotState before(state);
  if (!state.setFromIK(&group, of_link, link.getName(), consistency, 0.0, validCallback, options))
    return false;
  if (!turnsOver(before, state, group))
    return true;
  state = before;  // arms with joints to spare may have another way
  const std::vector<double> half_turn(group.getVariableCount(), 0.99 * M_PI);
  if (state.setFromIK(&group, of_link, link.getName(), half_turn, 0.0, validCallback, options) &&
      !turnsOver(before, state, group))
    return true;
  state = before;
  return false;
}
}  // namespace

double CartesianInterpolator::computeCartesianPath(RobotState* start_state, const JointModelGroup* group,
                                                   std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                                   const Eigen::Vector3d& translation, bool global_reference_frame,
                                                   const MaxEEFStep& max_step, const JumpThreshold& jump_threshold,
                                                   const GroupStateValidityCallbackFn& validCallback,
                                                   const kinematics::KinematicsQueryOptions& options)
{
  Eigen::Isometry3d target = start_state->getGlobalLinkTransform(link);
  target.translation() += global_reference_frame ? translation : Eigen::Vector3d(target.linear() * translation);
  // This one answers with a length, not with a share.
  return translation.norm() *
         computeCartesianPath(start_state, group, traj, link, target, true, max_step, jump_threshold, validCallback, options);
}

double CartesianInterpolator::computeCartesianPath(RobotState* start_state, const JointModelGroup* group,
                                                   std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                                   const Eigen::Isometry3d& target, bool global_reference_frame,
                                                   const MaxEEFStep& max_step, const JumpThreshold& jump_threshold,
                                                   const GroupStateValidityCallbackFn& validCallback,
                                                   const kinematics::KinematicsQueryOptions& options,
                                                   const Eigen::Isometry3d& link_offset)
{
  // Continuous joints keep their turn.
  for (const JointModel* joint : group->getContinuousJointModels())
    start_state->enforceBounds(joint);
  const Eigen::Isometry3d start = start_state->getGlobalLinkTransform(link) * link_offset;
  const Eigen::Isometry3d goal =
      global_reference_frame ? target : Eigen::Isometry3d(start_state->getGlobalLinkTransform(link) * target);
  const Eigen::Isometry3d to_link = link_offset.inverse();
  const Eigen::Quaterniond start_turn(start.linear()), goal_turn(goal.linear());
  if (max_step.translation <= 0.0 && max_step.rotation <= 0.0)
  {
    ROS_ERROR_NAMED(log_names::CARTESIAN_INTERPOLATOR,
                    "Invalid MaxEEFStep passed into computeCartesianPath. Both the MaxEEFStep.rotation and "
                    "MaxEEFStep.translation components must be non-negative and at least one component must be "
                    "greater than zero");
    return 0.0;
  }
  const double way = (goal.translation() - start.translation()).norm(), turn = start_turn.angularDistance(goal_turn);
  std::size_t steps = 1;
  if (max_step.translation > 0.0)
    steps = std::max<std::size_t>(steps, std::floor(way / max_step.translation) + 1);
  if (max_step.rotation > 0.0)
    steps = std::max<std::size_t>(steps, std::floor(turn / max_step.rotation) + 1);
  if (jump_threshold.factor > 0.0)
    steps = std::max(steps, MIN_STEPS_FOR_JUMP_THRESH);

  traj.clear();
  traj.push_back(std::make_shared<RobotState>(*start_state));
  const std::vector<double> consistency = mostOfAStep(*group, jump_threshold);
  double reached = 0.0;
  for (std::size_t i = 1; i <= steps; ++i)
  {
    const double share = static_cast<double>(i) / static_cast<double>(steps);
    Eigen::Isometry3d pose(start_turn.slerp(share, goal_turn));
    pose.translation() = share * goal.translation() + (1.0 - share) * start.translation();
    if (!stepTo(*start_state, *group, pose * to_link, *link, consistency, validCallback, options))
      break;
    traj.push_back(std::make_shared<RobotState>(*start_state));
    reached = share;
  }
  return reached * checkJointSpaceJump(group, traj, jump_threshold);
}

double CartesianInterpolator::computeCartesianPath(RobotState* start_state, const JointModelGroup* group,
                                                   std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                                   const EigenSTL::vector_Isometry3d& waypoints, bool global_reference_frame,
                                                   const MaxEEFStep& max_step, const JumpThreshold& jump_threshold,
                                                   const GroupStateValidityCallbackFn& validCallback,
                                                   const kinematics::KinematicsQueryOptions& options,
                                                   const Eigen::Isometry3d& link_offset)
{
  double reached = 0.0;
  traj.clear();
  for (std::size_t i = 0; i < waypoints.size(); ++i)
  {
    std::vector<RobotStatePtr> part;
    // Jumps are looked for in the whole path, so that the mean is over all of it.
    const double share = computeCartesianPath(start_state, group, part, link, waypoints[i], global_reference_frame, max_step,
                                              JumpThreshold(), validCallback, options, link_offset);
    traj.insert(traj.end(), traj.empty() ? part.begin() : std::next(part.begin()), part.end());
    if (std::abs(share - 1.0) > std::numeric_limits<double>::epsilon())
    {
      reached = (static_cast<double>(i) + share) / static_cast<double>(waypoints.size());
      break;
    }
    reached = static_cast<double>(i + 1) / static_cast<double>(waypoints.size());
  }
  return reached * checkJointSpaceJump(group, traj, jump_threshold);
}

double CartesianInterpolator::checkJointSpaceJump(const JointModelGroup* group, std::vector<RobotStatePtr>& traj,
                                                  const JumpThreshold& jump_threshold)
{
  double share = 1.0;
  if (traj.size() <= 1)
    return share;
  if (jump_threshold.factor > 0.0)
    share = checkRelativeJointSpaceJump(group, traj, jump_threshold.factor);
  if (jump_threshold.revolute > 0.0 || jump_threshold.prismatic > 0.0)
    share = std::min(share, checkAbsoluteJointSpaceJump(group, traj, jump_threshold.revolute, jump_threshold.prismatic));
  return share;
}

double CartesianInterpolator::checkRelativeJointSpaceJump(const JointModelGroup* group, std::vector<RobotStatePtr>& traj,
                                                          double jump_threshold_factor)
{
  if (traj.size() < MIN_STEPS_FOR_JUMP_THRESH)
    ROS_WARN_NAMED(log_names::CARTESIAN_INTERPOLATOR,
                   "The computed trajectory is too short to detect jumps in joint-space. Need at least %zu steps, "
                   "only got %zu. Try a lower max_step.",
                   MIN_STEPS_FOR_JUMP_THRESH, traj.size());
  std::vector<double> steps;
  for (std::size_t i = 1; i < traj.size(); ++i)
    steps.push_back(traj[i]->distance(*traj[i - 1], group));
  const double limit =
      jump_threshold_factor * std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (steps[i] > limit)
    {
      const double share = static_cast<double>(i + 1) / static_cast<double>(traj.size());
      ROS_DEBUG_NAMED(log_names::CARTESIAN_INTERPOLATOR,
                      "Truncating Cartesian path due to detected jump in joint-space distance");
      traj.resize(i + 1);
      return share;
    }
  return 1.0;
}

double CartesianInterpolator::checkAbsoluteJointSpaceJump(const JointModelGroup* group, std::vector<RobotStatePtr>& traj,
                                                          double revolute_jump_threshold, double prismatic_jump_threshold)
{
  for (std::size_t i = 1; i < traj.size(); ++i)
    for (const JointModel* joint : group->getActiveJointModels())
    {
      const double limit = joint->getType() == JointModel::REVOLUTE    ? revolute_jump_threshold
                           : joint->getType() == JointModel::PRISMATIC ? prismatic_jump_threshold
                                                                       : 0.0;
      const double step = traj[i]->distance(*traj[i - 1], joint);
      if (limit <= 0.0 || step <= limit)
        continue;
      ROS_DEBUG_NAMED(log_names::CARTESIAN_INTERPOLATOR,
                      "Truncating Cartesian path due to detected jump of %.4f > %.4f in joint %s", step, limit,
                      joint->getName().c_str());
      const double share = static_cast<double>(i) / static_cast<double>(traj.size());
      traj.resize(i);
      return share;
    }
  return 1.0;
}

// ---------------------------------------------------------------- its former place

double RobotState::computeCartesianPath(const JointModelGroup* group, std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                        const Eigen::Vector3d& direction, bool global_reference_frame, double distance,
                                        double max_step, double jump_threshold_factor,
                                        const GroupStateValidityCallbackFn& validCallback,
                                        const kinematics::KinematicsQueryOptions& options)
{
  return CartesianInterpolator::computeCartesianPath(this, group, traj, link, direction, global_reference_frame, distance,
                                                     MaxEEFStep(max_step), JumpThreshold(jump_threshold_factor), validCallback,
                                                     options);
}

double RobotState::computeCartesianPath(const JointModelGroup* group, std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                        const Eigen::Isometry3d& target, bool global_reference_frame, double max_step,
                                        double jump_threshold_factor, const GroupStateValidityCallbackFn& validCallback,
                                        const kinematics::KinematicsQueryOptions& options)
{
  return CartesianInterpolator::computeCartesianPath(this, group, traj, link, target, global_reference_frame,
                                                     MaxEEFStep(max_step), JumpThreshold(jump_threshold_factor), validCallback,
                                                     options);
}

double RobotState::computeCartesianPath(const JointModelGroup* group, std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                        const EigenSTL::vector_Isometry3d& waypoints, bool global_reference_frame,
                                        double max_step, double jump_threshold_factor,
                                        const GroupStateValidityCallbackFn& validCallback,
                                        const kinematics::KinematicsQueryOptions& options)
{
  return CartesianInterpolator::computeCartesianPath(this, group, traj, link, waypoints, global_reference_frame,
                                                     MaxEEFStep(max_step), JumpThreshold(jump_threshold_factor), validCallback,
                                                     options);
}
}  // namespace core
}  // namespace moveit
