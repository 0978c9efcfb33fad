// Trajectories through controllers: which controllers, and each one's part.
#include <moveit/trajectory_execution_manager/trajectory_execution_manager.h>

#include <algorithm>

#include "laws/execution.hpp"
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
}  // namespace

TrajectoryExecutionManager::Joints TrajectoryExecutionManager::jointsOf(const std::string& controller) const
{
  std::vector<std::string> joints;
  controller_manager_->getControllerJoints(controller, joints);
  return Joints(joints.begin(), joints.end());
}

std::vector<std::string> TrajectoryExecutionManager::choose(const Joints& wanted, const std::vector<std::string>& allowed) const
{
  std::vector<execution::Controller> controllers;
  for (const std::string& name : allowed)
  {
    const auto state = controller_manager_->getControllerState(name);
    controllers.push_back({ name, jointsOf(name), state.active_, state.default_ });
  }
  return execution::choose(wanted, controllers, manage_controllers_);
}

bool TrajectoryExecutionManager::configure(TrajectoryExecutionContext& context, const moveit_msgs::RobotTrajectory& trajectory,
                                           const std::vector<std::string>& controllers) const
{
  const std::string fault = execution::fault(trajectory, *robot_model_->core());
  if (!fault.empty())
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "%s", fault.c_str());
    return false;
  }
  if (execution::takesNoTime(trajectory))
    return true;
  if (!controller_manager_)
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "No controller manager is loaded: nothing can be executed");
    return false;
  }
  std::vector<std::string> names = trajectory.joint_trajectory.joint_names;
  names.insert(names.end(), trajectory.multi_dof_joint_trajectory.joint_names.begin(),
               trajectory.multi_dof_joint_trajectory.joint_names.end());
  const Joints wanted = execution::actuated(names, *robot_model_->core());
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
  context.controllers_ = choose(wanted, controllers.empty() ? known : controllers);
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
    context.trajectory_parts_.push_back(execution::share(trajectory, jointsOf(name), execution_velocity_scaling_));
  return true;
}

// Does the trajectory start where the robot is?
bool TrajectoryExecutionManager::startsHere(const TrajectoryExecutionContext& context) const
{
  const execution::StartTolerance tolerance{ allowed_start_tolerance_, joints_allowed_start_tolerance_ };
  if (!tolerance.any() || !csm_ || context.trajectory_parts_.empty())
    return true;
  if (!heardOf(context))
    return false;
  const moveit::core::RobotStatePtr state = csm_->getCurrentState();
  for (const auto& part : context.trajectory_parts_)
  {
    const std::string line = execution::startDeviation(part, state->core(), tolerance);
    if (line.empty())
      continue;
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "%s", line.c_str());
    return false;
  }
  return true;
}

// Has each joint that is to move been heard of since now? One second at most is waited.
bool TrajectoryExecutionManager::heardOf(const TrajectoryExecutionContext& context) const
{
  const ros::Time now = ros::Time::now();
  csm_->waitForCurrentState(now, 1.0);
  std::vector<std::string> missing;
  csm_->haveCompleteState(now, missing);
  for (const auto& part : context.trajectory_parts_)
    for (const std::string& name : part.joint_trajectory.joint_names)
      if (std::find(missing.begin(), missing.end(), name) != missing.end())
      {
        ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER,
                        "Failed to validate trajectory: couldn't receive full current joint state within 1s: joint '%s' is not "
                        "in what %s says",
                        name.c_str(), csm_->getMonitoredTopic().c_str());
        return false;
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
  const std::vector<std::string> chosen = choose(execution::actuated(joints, *robot_model_->core()), known);
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
