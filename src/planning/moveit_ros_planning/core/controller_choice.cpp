// Trajectories through controllers: which controllers, and each one's part.
#include <moveit/trajectory_execution_manager/trajectory_execution_manager.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "log_names.hpp"

namespace trajectory_execution_manager
{
namespace
{
std::string listed(const std::set<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
    text += name + " ";
  return text;
}

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& columns, double factor = 1.0)
{
  std::vector<double> some;
  for (const std::size_t column : columns)
    if (column < values.size())
      some.push_back(values[column] * factor);
  return some;
}

template <typename Trajectory>
std::vector<std::size_t> columnsOf(const Trajectory& trajectory, const std::set<std::string>& joints)
{
  std::vector<std::size_t> columns;
  for (const std::string& joint : joints)
  {
    const auto found = std::find(trajectory.joint_names.begin(), trajectory.joint_names.end(), joint);
    if (found != trajectory.joint_names.end())
      columns.push_back(found - trajectory.joint_names.begin());
  }
  return columns;
}

// The part of a trajectory that moves the joints, in alphabetical order.
moveit_msgs::RobotTrajectory partOf(const moveit_msgs::RobotTrajectory& whole, const std::set<std::string>& joints,
                                    double scaling)
{
  moveit_msgs::RobotTrajectory part;
  const std::vector<std::size_t> columns = columnsOf(whole.joint_trajectory, joints);
  if (!columns.empty())
  {
    part.joint_trajectory.header = whole.joint_trajectory.header;
    for (const std::size_t column : columns)
      part.joint_trajectory.joint_names.push_back(whole.joint_trajectory.joint_names[column]);
    for (const auto& point : whole.joint_trajectory.points)
    {
      part.joint_trajectory.points.emplace_back();
      auto& own = part.joint_trajectory.points.back();
      own.positions = picked(point.positions, columns);
      own.velocities = picked(point.velocities, columns, scaling);
      own.accelerations = picked(point.accelerations, columns);
      own.effort = picked(point.effort, columns);
      own.time_from_start = point.time_from_start;
    }
  }
  const std::vector<std::size_t> bases = columnsOf(whole.multi_dof_joint_trajectory, joints);
  if (!bases.empty())
  {
    part.multi_dof_joint_trajectory.header = whole.multi_dof_joint_trajectory.header;
    for (const std::size_t column : bases)
      part.multi_dof_joint_trajectory.joint_names.push_back(whole.multi_dof_joint_trajectory.joint_names[column]);
    for (const auto& point : whole.multi_dof_joint_trajectory.points)
    {
      part.multi_dof_joint_trajectory.points.emplace_back();
      auto& own = part.multi_dof_joint_trajectory.points.back();
      for (const std::size_t column : bases)
        if (column < point.transforms.size())
          own.transforms.push_back(point.transforms[column]);
      own.time_from_start = point.time_from_start;
    }
  }
  return part;
}

bool isWhole(const trajectory_msgs::JointTrajectory& trajectory)
{
  ros::Duration before(-1.0);
  for (const auto& point : trajectory.points)
  {
    if (point.positions.size() != trajectory.joint_names.size() || point.time_from_start <= before ||
        !std::all_of(point.positions.begin(), point.positions.end(), [](double value) { return std::isfinite(value); }))
      return false;
    before = point.time_from_start;
  }
  return true;
}
}  // namespace

TrajectoryExecutionManager::Joints TrajectoryExecutionManager::jointsOf(const std::string& controller) const
{
  std::vector<std::string> joints;
  controller_manager_->getControllerJoints(controller, joints);
  return Joints(joints.begin(), joints.end());
}

// Those that need a controller: not fixed, passive or mimic.
TrajectoryExecutionManager::Joints TrajectoryExecutionManager::actuated(const std::vector<std::string>& joints) const
{
  Joints wanted;
  for (const std::string& name : joints)
    if (robot_model_->hasJointModel(name))
    {
      const moveit::core::JointModel* joint = robot_model_->getJointModel(name);
      if (!joint->isPassive() && !joint->getMimic() && joint->getType() != moveit::core::JointModel::FIXED)
        wanted.insert(name);
    }
  return wanted;
}

// As few controllers as possible; of those the default ones, with few joints, active already.
std::vector<std::string> TrajectoryExecutionManager::select(const Joints& wanted, const std::vector<std::string>& allowed) const
{
  std::vector<std::string> useful;
  std::map<std::string, Joints> joints;
  for (const std::string& name : allowed)
  {
    joints[name] = jointsOf(name);
    if (std::any_of(joints[name].begin(), joints[name].end(),
                    [&](const std::string& joint) { return wanted.count(joint) > 0; }))
      useful.push_back(name);
  }
  std::sort(useful.begin(), useful.end());
  useful.resize(std::min<std::size_t>(useful.size(), 16));
  using Rank = std::tuple<int, int, int, int>;
  std::vector<std::string> best;
  Rank rank_of_best;
  for (unsigned option = 1; option < (1u << useful.size()); ++option)
  {
    std::vector<std::string> names;
    Joints covered;
    std::size_t sum = 0;
    int defaults = 0, active = 0;
    for (std::size_t i = 0; i < useful.size(); ++i)
      if (option & (1u << i))
      {
        names.push_back(useful[i]);
        covered.insert(joints[useful[i]].begin(), joints[useful[i]].end());
        sum += joints[useful[i]].size();
        const auto state = controller_manager_->getControllerState(useful[i]);
        defaults += state.default_;
        active += state.active_;
      }
    if (sum != covered.size() || !std::includes(covered.begin(), covered.end(), wanted.begin(), wanted.end()))
      continue;
    const int idle = static_cast<int>(names.size()) - active;
    // Without the right to switch, what is active already comes first.
    const Rank rank(manage_controllers_ ? 0 : idle, static_cast<int>(names.size()), -defaults, static_cast<int>(sum) + idle);
    if (best.empty() || rank < rank_of_best)
    {
      best = names;
      rank_of_best = rank;
    }
  }
  return best;
}

bool TrajectoryExecutionManager::configure(TrajectoryExecutionContext& context, const moveit_msgs::RobotTrajectory& trajectory,
                                           const std::vector<std::string>& controllers) const
{
  const auto& points = trajectory.joint_trajectory.points;
  if (points.empty() && trajectory.multi_dof_joint_trajectory.points.empty())
    return true;
  if (!isWhole(trajectory.joint_trajectory))
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER,
                    "Wrong trajectory: each point needs a position for each joint, later than the one before");
    return false;
  }
  if (!points.empty() && (trajectory.joint_trajectory.header.stamp + points.back().time_from_start).isZero())
    return true;  // takes no time
  if (!controller_manager_)
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "No controller manager is loaded: nothing can be executed");
    return false;
  }
  std::vector<std::string> names = trajectory.joint_trajectory.joint_names;
  names.insert(names.end(), trajectory.multi_dof_joint_trajectory.joint_names.begin(),
               trajectory.multi_dof_joint_trajectory.joint_names.end());
  const Joints wanted = actuated(names);
  if (wanted.empty())
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "The trajectory to execute specifies no joints");
    return false;
  }
  std::vector<std::string> known;
  controller_manager_->getControllersList(known);
  for (const std::string& name : controllers)
    if (std::find(known.begin(), known.end(), name) == known.end())
    {
      ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Controller '%s' is not known", name.c_str());
      return false;
    }
  context.controllers_ = select(wanted, controllers.empty() ? known : controllers);
  if (context.controllers_.empty())
  {
    std::string text;
    for (const std::string& name : known)
      text += name + " (" + listed(jointsOf(name)) + ") ";
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER,
                    "Unable to identify any set of controllers that can actuate the specified joints: [ %s]. Known "
                    "controllers and their joints: %s",
                    listed(wanted).c_str(), known.empty() ? "none" : text.c_str());
    return false;
  }
  for (const std::string& name : context.controllers_)
    context.trajectory_parts_.push_back(partOf(trajectory, jointsOf(name), execution_velocity_scaling_));
  return true;
}

// Does the trajectory start where the robot is?
bool TrajectoryExecutionManager::startsHere(const TrajectoryExecutionContext& context) const
{
  if (!(allowed_start_tolerance_ > 0.0) || !csm_ || context.trajectory_parts_.empty())
    return true;
  if (!csm_->waitForCurrentState(ros::Time::now(), 1.0))
    ROS_WARN_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER,
                   "Failed to validate trajectory: couldn't receive full current joint state within 1s");
  const moveit::core::RobotStatePtr state = csm_->getCurrentState();
  std::map<std::string, double> own;
  ros::param::get(node_handle_.resolveName("trajectory_execution/joints_allowed_start_tolerance"), own);
  for (const auto& part : context.trajectory_parts_)
  {
    if (part.joint_trajectory.points.empty())
      continue;
    const auto& names = part.joint_trajectory.joint_names;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const moveit::core::JointModel* joint = robot_model_->getJointModel(names[i]);
      if (!joint || joint->getVariableCount() != 1)
        continue;
      const double allowed = own.count(names[i]) ? own[names[i]] : allowed_start_tolerance_;
      double expected = part.joint_trajectory.points[0].positions[i], current = *state->getJointPositions(joint);
      joint->enforcePositionBounds(&expected);
      joint->enforcePositionBounds(&current);
      if (allowed > 0.0 && !(joint->distance(&expected, &current) <= allowed))
      {
        ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER,
                        "Invalid Trajectory: start point deviates from current robot state more than %g: joint '%s': "
                        "expected: %g, current: %g. Plan again from where the robot is now",
                        allowed, names[i].c_str(), expected, current);
        return false;
      }
    }
  }
  return true;
}

bool TrajectoryExecutionManager::areControllersActive(const std::vector<std::string>& controllers)
{
  return controller_manager_ && std::all_of(controllers.begin(), controllers.end(), [this](const std::string& name) {
           return controller_manager_->getControllerState(name).active_;
         });
}

bool TrajectoryExecutionManager::ensureActiveControllersForGroup(const std::string& group)
{
  const moveit::core::JointModelGroup* joints = robot_model_->getJointModelGroup(group);
  return joints && ensureActiveControllersForJoints(joints->getJointModelNames());
}

bool TrajectoryExecutionManager::ensureActiveControllersForJoints(const std::vector<std::string>& joints)
{
  if (!controller_manager_)
    return false;
  std::vector<std::string> known;
  controller_manager_->getControllersList(known);
  const std::vector<std::string> chosen = select(actuated(joints), known);
  return !chosen.empty() && ensureActiveControllers(chosen);
}

bool TrajectoryExecutionManager::ensureActiveControllers(const std::vector<std::string>& controllers)
{
  if (areControllersActive(controllers))
    return true;
  if (!controller_manager_ || !manage_controllers_)
  {
    ROS_WARN_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER,
                   "Controllers are not active, and this node does not manage controllers (~moveit_manage_controllers)");
    return false;
  }
  // Those that hold joints of the new ones go.
  std::vector<std::string> idle, active, holders;
  Joints joints;
  for (const std::string& name : controllers)
    if (!controller_manager_->getControllerState(name).active_)
    {
      idle.push_back(name);
      const Joints own = jointsOf(name);
      joints.insert(own.begin(), own.end());
    }
  controller_manager_->getActiveControllers(active);
  for (const std::string& name : active)
  {
    const Joints own = jointsOf(name);
    if (std::any_of(own.begin(), own.end(), [&](const std::string& joint) { return joints.count(joint) > 0; }) &&
        std::find(controllers.begin(), controllers.end(), name) == controllers.end())
      holders.push_back(name);
  }
  return controller_manager_->switchControllers(idle, holders);
}
}  // namespace trajectory_execution_manager
