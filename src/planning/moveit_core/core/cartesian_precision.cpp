// Straight lines of a link that are followed to a given precision.
#include <moveit/robot_state/cartesian_interpolator.h>

#include <algorithm>
#include <cmath>

#include "log_names.hpp"

namespace moveit
{
namespace core
{
namespace
{
Eigen::Isometry3d between(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double share)
{
  Eigen::Isometry3d pose(Eigen::Quaterniond(from.linear()).slerp(share, Eigen::Quaterniond(to.linear())));
  pose.translation() = (1.0 - share) * from.translation() + share * to.translation();
  return pose;
}

// A place on the way: its share of the way, the pose of the frame, the state that puts it there.
struct Place
{
  double share;
  Eigen::Isometry3d pose;
  RobotState state;
};

class Line
{
public:
  Line(const JointModelGroup& group, const LinkModel& link, const Eigen::Isometry3d& link_offset,
       const CartesianPrecision& precision, const GroupStateValidityCallbackFn& valid,
       const kinematics::KinematicsQueryOptions& options, std::vector<RobotStatePtr>& states)
    : group_(group)
    , link_(link)
    , offset_(link_offset)
    , to_link_(link_offset.inverse())
    , precision_(precision)
    , valid_(valid)
    , options_(options)
    , states_(states)
  {
  }

  // The state is where the solver starts from; false when it finds none.
  bool solve(Place& place) const
  {
    return place.state.setFromIK(&group_, place.pose * to_link_, link_.getName(), 0.0, valid_, options_);
  }

  // Adds what is between two places, and the second; `reached` grows with what is added.
  bool add(const Place& from, const Place& to, double& reached)
  {
    Place middle{ 0.5 * (from.share + to.share), between(from.pose, to.pose, 0.5), RobotState(from.state) };
    from.state.interpolate(to.state, 0.5, middle.state);
    if (isNear(middle))
    {
      states_.push_back(std::make_shared<RobotState>(to.state));
      reached = to.share;
      return true;
    }
    if (to.share - from.share < precision_.max_resolution)
    {
      ROS_WARN_NAMED(log_names::CARTESIAN_INTERPOLATOR, "Failed to find linear interpolation within max_resolution: %f < %f",
                     to.share - from.share, precision_.max_resolution);
      return false;
    }
    return solve(middle) && add(from, middle, reached) && add(middle, to, reached);
  }

private:
  bool isNear(const Place& place) const
  {
    const Eigen::Isometry3d pose = place.state.getGlobalLinkTransform(&link_) * offset_;
    return (pose.translation() - place.pose.translation()).norm() <= precision_.translational &&
           Eigen::Quaterniond(pose.linear()).angularDistance(Eigen::Quaterniond(place.pose.linear())) <= precision_.rotational;
  }

  const JointModelGroup& group_;
  const LinkModel& link_;
  const Eigen::Isometry3d offset_, to_link_;
  const CartesianPrecision& precision_;
  const GroupStateValidityCallbackFn& valid_;
  const kinematics::KinematicsQueryOptions& options_;
  std::vector<RobotStatePtr>& states_;
};

std::size_t stepsOf(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, const MaxEEFStep& most)
{
  std::size_t steps = 1;
  const double way = (to.translation() - from.translation()).norm();
  const double turn = Eigen::Quaterniond(from.linear()).angularDistance(Eigen::Quaterniond(to.linear()));
  if (most.translation > 0.0)
    steps = std::max<std::size_t>(steps, std::floor(way / most.translation) + 1);
  if (most.rotation > 0.0)
    steps = std::max<std::size_t>(steps, std::floor(turn / most.rotation) + 1);
  return steps;
}
}  // namespace

double CartesianInterpolator::computeCartesianPath(const RobotState* start_state, const JointModelGroup* group,
                                                   std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                                   const Eigen::Vector3d& translation, bool global_reference_frame,
                                                   const MaxEEFStep& max_step, const CartesianPrecision& precision,
                                                   const GroupStateValidityCallbackFn& validCallback,
                                                   const kinematics::KinematicsQueryOptions& options)
{
  Eigen::Isometry3d target = start_state->getGlobalLinkTransform(link);
  target.translation() += global_reference_frame ? translation : Eigen::Vector3d(target.linear() * translation);
  return translation.norm() *
         computeCartesianPath(start_state, group, traj, link, target, true, max_step, precision, validCallback, options);
}

double CartesianInterpolator::computeCartesianPath(const RobotState* start_state, const JointModelGroup* group,
                                                   std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                                   const Eigen::Isometry3d& target, bool global_reference_frame,
                                                   const MaxEEFStep& max_step, const CartesianPrecision& precision,
                                                   const GroupStateValidityCallbackFn& validCallback,
                                                   const kinematics::KinematicsQueryOptions& options,
                                                   const Eigen::Isometry3d& link_offset)
{
  RobotState state(*start_state);
  for (const JointModel* joint : group->getContinuousJointModels())
    state.enforceBounds(joint);
  const Eigen::Isometry3d start = state.getGlobalLinkTransform(link) * link_offset;
  const Eigen::Isometry3d goal = global_reference_frame ? target : Eigen::Isometry3d(start * target);
  const std::size_t steps = stepsOf(start, goal, max_step);
  traj.clear();
  traj.push_back(std::make_shared<RobotState>(*start_state));
  Line line(*group, *link, link_offset, precision, validCallback, options, traj);
  double reached = 0.0;
  Place before{ 0.0, start, state };
  for (std::size_t i = 1; i <= steps; ++i)
  {
    const double share = static_cast<double>(i) / static_cast<double>(steps);
    Place place{ share, between(start, goal, share), before.state };
    if (!line.solve(place) || !line.add(before, place, reached))
      break;
    before = place;
  }
  return reached;
}

double CartesianInterpolator::computeCartesianPath(const RobotState* start_state, const JointModelGroup* group,
                                                   std::vector<RobotStatePtr>& traj, const LinkModel* link,
                                                   const EigenSTL::vector_Isometry3d& waypoints, bool global_reference_frame,
                                                   const MaxEEFStep& max_step, const CartesianPrecision& precision,
                                                   const GroupStateValidityCallbackFn& validCallback,
                                                   const kinematics::KinematicsQueryOptions& options,
                                                   const Eigen::Isometry3d& link_offset)
{
  traj.clear();
  for (std::size_t i = 0; i < waypoints.size(); ++i)
  {
    std::vector<RobotStatePtr> part;
    const double share = computeCartesianPath(traj.empty() ? start_state : traj.back().get(), group, part, link, waypoints[i],
                                              global_reference_frame, max_step, precision, validCallback, options, link_offset);
    traj.insert(traj.end(), traj.empty() ? part.begin() : std::next(part.begin()), part.end());
    if (share < 1.0)
      return (static_cast<double>(i) + share) / static_cast<double>(waypoints.size());
  }
  return 1.0;
}
}  // namespace core
}  // namespace moveit
