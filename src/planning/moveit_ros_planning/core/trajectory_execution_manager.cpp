// Trajectories through controllers: pushing, running, stopping.
#include <moveit/trajectory_execution_manager/trajectory_execution_manager.h>

#include <algorithm>

#include "built_in_controllers.hpp"
#include "dynamic_settings.hpp"
#include "execution_parameters.hpp"
#include "laws/execution.hpp"
#include "log_names.hpp"

namespace trajectory_execution_manager
{
namespace
{
using moveit_ros_planning::DynamicSettings;

double ownOr(const std::map<std::string, double>& own, const std::string& name, double standard)
{
  const auto found = own.find(name);
  return found == own.end() ? standard : found->second;
}
}  // namespace

const std::string TrajectoryExecutionManager::EXECUTION_EVENT_TOPIC = "trajectory_execution_event";

TrajectoryExecutionManager::TrajectoryExecutionManager(const moveit::core::RobotModelConstPtr& robot_model,
                                                       const planning_scene_monitor::CurrentStateMonitorPtr& csm)
  : robot_model_(robot_model)
  , csm_(csm)
{
  node_handle_.getParam("moveit_manage_controllers", manage_controllers_);
  initialize();
}

TrajectoryExecutionManager::TrajectoryExecutionManager(const moveit::core::RobotModelConstPtr& robot_model,
                                                       const planning_scene_monitor::CurrentStateMonitorPtr& csm,
                                                       bool manage_controllers)
  : robot_model_(robot_model)
  , csm_(csm)
  , manage_controllers_(manage_controllers)
{
  initialize();
}

TrajectoryExecutionManager::~TrajectoryExecutionManager()
{
  event_topic_subscriber_.shutdown();
  stopExecution(true);
}

void TrajectoryExecutionManager::initialize()
{
  const ros::NodeHandle settings(node_handle_, "trajectory_execution");
  settings_ = std::make_unique<DynamicSettings>(
      settings, execution::parameters(), log_names::TRAJECTORY_EXECUTION_MANAGER, [this](const DynamicSettings::Values& given) {
        execution_duration_monitoring_ = given.at("execution_duration_monitoring") != 0.0;
        allowed_execution_duration_scaling_ = given.at("allowed_execution_duration_scaling");
        allowed_goal_duration_margin_ = given.at("allowed_goal_duration_margin");
        execution_velocity_scaling_ = given.at("execution_velocity_scaling");
        allowed_start_tolerance_ = given.at("allowed_start_tolerance");
        wait_for_trajectory_completion_ = given.at("wait_for_trajectory_completion") != 0.0;
      });
  joints_allowed_start_tolerance_ = readStartTolerances(settings);
  controller_duration_scaling_ = readOfControllers(node_handle_, "allowed_execution_duration_scaling");
  controller_duration_margin_ = readOfControllers(node_handle_, "allowed_goal_duration_margin");
  loadControllers();
  event_topic_subscriber_ =
      root_node_handle_.subscribe<std_msgs::String>(EXECUTION_EVENT_TOPIC, 100, [this](const std_msgs::StringConstPtr& event) {
        ROS_INFO_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Received event '%s'", event->data.c_str());
        processEvent(event->data);
      });
  ROS_INFO_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Trajectory execution is %smanaging controllers",
                 manage_controllers_ ? "" : "not ");
}

void TrajectoryExecutionManager::loadControllers()
{
  std::string name;
  if (!node_handle_.getParam("moveit_controller_manager", name) || name.empty())
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER,
                    "Parameter '%s' not specified. It names what executes trajectories "
                    "(moveit_simple_controller_manager/MoveItSimpleControllerManager); no paths can be executed.",
                    node_handle_.resolveName("moveit_controller_manager").c_str());
    return;
  }
  controller_manager_ = makeBuiltInManager(name, node_handle_, *robot_model_);
  if (controller_manager_)
    return;
  try
  {
    controller_manager_loader_ = std::make_unique<pluginlib::ClassLoader<moveit_controller_manager::MoveItControllerManager>>(
        "moveit_core", "moveit_controller_manager::MoveItControllerManager");
    controller_manager_ = controller_manager_loader_->createUniqueInstance(name);
  }
  catch (const pluginlib::PluginlibException& error)
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Exception while loading controller manager '%s': %s",
                    name.c_str(), error.what());
  }
}

void TrajectoryExecutionManager::processEvent(const std::string& event)
{
  if (event == "stop")
    stopExecution(true);
  else
    ROS_WARN_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Unknown event type: '%s'", event.c_str());
}

// ---------------------------------------------------------------- pushing

bool TrajectoryExecutionManager::push(const moveit_msgs::RobotTrajectory& trajectory, const std::string& controller)
{
  return push(trajectory, controller.empty() ? std::vector<std::string>() : std::vector<std::string>{ controller });
}

bool TrajectoryExecutionManager::push(const trajectory_msgs::JointTrajectory& trajectory, const std::string& controller)
{
  return push(trajectory, controller.empty() ? std::vector<std::string>() : std::vector<std::string>{ controller });
}

bool TrajectoryExecutionManager::push(const trajectory_msgs::JointTrajectory& trajectory,
                                      const std::vector<std::string>& controllers)
{
  moveit_msgs::RobotTrajectory all;
  all.joint_trajectory = trajectory;
  return push(all, controllers);
}

bool TrajectoryExecutionManager::push(const moveit_msgs::RobotTrajectory& trajectory,
                                      const std::vector<std::string>& controllers)
{
  auto context = std::make_unique<TrajectoryExecutionContext>();
  const bool usable = configure(*context, trajectory, controllers);
  std::lock_guard<std::mutex> lock(mutex_);
  if (running_)
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Cannot push a new trajectory while another is being executed");
    return false;
  }
  if (!usable)
  {
    last_execution_status_ = Status::ABORTED;
    return false;
  }
  trajectories_.push_back(std::move(context));
  pushed_.push_back(trajectories_.back().get());
  return true;
}

void TrajectoryExecutionManager::clear()
{
  std::lock_guard<std::mutex> lock(mutex_);
  if (running_)
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Trajectories are not cleared while one is being executed");
    return;
  }
  pushed_.clear();
  trajectories_.clear();
}

// ---------------------------------------------------------------- running

void TrajectoryExecutionManager::execute(const ExecutionCompleteCallback& callback,
                                         const PathSegmentCompleteCallback& part_callback, bool auto_clear)
{
  if (trajectories_.empty())
    return;
  stopExecution(false);
  if (!startsHere(*trajectories_.front()))
  {
    last_execution_status_ = Status::ABORTED;
    if (auto_clear)
      clear();
    if (callback)
      callback(Status::ABORTED);
    return;
  }
  std::lock_guard<std::mutex> thread_lock(thread_mutex_);
  std::lock_guard<std::mutex> lock(mutex_);
  running_ = true;
  stopped_ = false;
  last_execution_status_ = Status::RUNNING;
  thread_ = std::thread([this, callback, part_callback, auto_clear]() { run(callback, part_callback, auto_clear); });
}

void TrajectoryExecutionManager::run(const ExecutionCompleteCallback& callback,
                                     const PathSegmentCompleteCallback& part_callback, bool auto_clear)
{
  Status status = Status::SUCCEEDED;
  std::size_t i = 0;
  for (; i < trajectories_.size() && status == Status::SUCCEEDED; ++i)
  {
    status = executePart(i);
    if (status == Status::SUCCEEDED && part_callback)
      part_callback(i);
    if (stopped_)
      status = Status::PREEMPTED;
  }
  if (status == Status::SUCCEEDED && i > 0)
    waitForRest(*trajectories_[i - 1]);
  ROS_INFO_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Completed trajectory execution with status %s ...",
                 status.asString().c_str());
  {
    std::lock_guard<std::mutex> lock(mutex_);
    last_execution_status_ = status;
    running_ = false;
    current_ = -1;
    active_handles_.clear();
    if (auto_clear)
    {
      pushed_.clear();
      trajectories_.clear();
    }
    complete_.notify_all();
  }
  if (callback)
    callback(status);
}

TrajectoryExecutionManager::Status TrajectoryExecutionManager::executePart(std::size_t index)
{
  const TrajectoryExecutionContext& context = *trajectories_[index];
  if (context.trajectory_parts_.empty())
    return Status::SUCCEEDED;
  if (!ensureActiveControllers(context.controllers_))
    return Status::ABORTED;
  ros::Time started;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_)
      return Status::PREEMPTED;
    if (!send(context))
    {
      cancelHandles();
      return Status::ABORTED;
    }
    started = ros::Time::now();  // of the controllers: an action server that comes up first takes none of their time
    current_ = static_cast<int>(index);
    current_started_ = started;
  }
  return watch(context, started);
}

bool TrajectoryExecutionManager::send(const TrajectoryExecutionContext& context)
{
  active_handles_.clear();
  for (std::size_t i = 0; i < context.controllers_.size(); ++i)
  {
    const std::string& name = context.controllers_[i];
    try
    {
      const auto handle = controller_manager_->getControllerHandle(name);
      if (!handle)
        ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "No controller handle for controller '%s'. Aborting.",
                        name.c_str());
      else if (handle->sendTrajectory(context.trajectory_parts_[i]))
      {
        active_handles_.push_back(handle);
        continue;
      }
    }
    catch (const std::exception& error)
    {
      ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Controller '%s': %s", name.c_str(), error.what());
    }
    ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Failed to send trajectory part %zu of %zu to controller %s",
                    i + 1, context.controllers_.size(), name.c_str());
    return false;
  }
  return true;
}

// The longest of the controllers' times.
double TrajectoryExecutionManager::allowedDuration(const TrajectoryExecutionContext& context) const
{
  const ros::Time now = ros::Time::now();
  double longest = 0.0;
  for (std::size_t i = 0; i < context.controllers_.size(); ++i)
  {
    const std::string& name = context.controllers_[i];
    const double scaling = ownOr(controller_duration_scaling_, name, allowed_execution_duration_scaling_);
    const double margin = ownOr(controller_duration_margin_, name, allowed_goal_duration_margin_);
    longest = std::max(longest, execution::allowedDuration(context.trajectory_parts_[i], now, scaling, margin));
  }
  return longest;
}

TrajectoryExecutionManager::Status TrajectoryExecutionManager::watch(const TrajectoryExecutionContext& context,
                                                                     const ros::Time& started)
{
  const double allowed = allowedDuration(context);
  std::vector<moveit_controller_manager::MoveItControllerHandlePtr> handles;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    handles = active_handles_;
  }
  for (const auto& handle : handles)
  {
    while (ros::ok() && !handle->waitForExecution(ros::Duration(0.1)))
    {
      if (stopped_)
        return Status::PREEMPTED;
      if (execution_duration_monitoring_ && (ros::Time::now() - started).toSec() > allowed)
      {
        ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER,
                        "Controller is taking too long to execute trajectory (the expected upper bound for the "
                        "trajectory execution was %f seconds). Stopping trajectory.",
                        allowed);
        std::lock_guard<std::mutex> lock(mutex_);
        cancelHandles();
        return Status::TIMED_OUT;
      }
    }
    if (stopped_ || !ros::ok())
      return Status::PREEMPTED;
    const Status status = handle->getLastExecutionStatus();
    if (status != Status::SUCCEEDED)
    {
      ROS_WARN_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Controller handle %s reports status %s",
                     handle->getName().c_str(), status.asString().c_str());
      std::lock_guard<std::mutex> lock(mutex_);
      cancelHandles();
      return status;
    }
  }
  return Status::SUCCEEDED;
}

// Three states in a row without motion, one second at most.
void TrajectoryExecutionManager::waitForRest(const TrajectoryExecutionContext& context) const
{
  const execution::StartTolerance tolerance{ allowed_start_tolerance_, joints_allowed_start_tolerance_ };
  if (!tolerance.any() || !wait_for_trajectory_completion_ || !csm_)
    return;
  std::vector<std::string> joints;
  for (const auto& part : context.trajectory_parts_)
    joints.insert(joints.end(), part.joint_trajectory.joint_names.begin(), part.joint_trajectory.joint_names.end());
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(1.0);
  moveit::core::RobotStatePtr before = csm_->getCurrentState();
  for (int still = 0; still < 3 && !stopped_ && ros::WallTime::now() < end;)
  {
    if (!csm_->waitForCurrentState(ros::Time::now(), std::max(0.01, (end - ros::WallTime::now()).toSec())))
      return;
    const moveit::core::RobotStatePtr now = csm_->getCurrentState();
    still = execution::moved(joints, before->core(), now->core(), tolerance, 1.0) ? 0 : still + 1;
    before = now;
  }
}

// ---------------------------------------------------------------- waiting and stopping

TrajectoryExecutionManager::Status TrajectoryExecutionManager::executeAndWait(bool auto_clear)
{
  execute(ExecutionCompleteCallback(), auto_clear);
  return waitForExecution();
}

TrajectoryExecutionManager::Status TrajectoryExecutionManager::waitForExecution()
{
  {
    std::unique_lock<std::mutex> lock(mutex_);
    complete_.wait(lock, [this]() { return !running_; });
  }
  join();
  return getLastExecutionStatus();
}

TrajectoryExecutionManager::Status TrajectoryExecutionManager::getLastExecutionStatus() const
{
  std::lock_guard<std::mutex> lock(mutex_);
  return last_execution_status_;
}

void TrajectoryExecutionManager::stopExecution(bool auto_clear)
{
  {
    std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
    if (running_)
    {
      cancelHandles();
      ROS_INFO_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Stopped trajectory execution.");
    }
  }
  join();
  if (auto_clear)
    clear();
}

void TrajectoryExecutionManager::join()
{
  std::lock_guard<std::mutex> lock(thread_mutex_);
  if (!thread_.joinable())
    return;
  if (thread_.get_id() == std::this_thread::get_id())
    thread_.detach();  // the callback at its end calls
  else
    thread_.join();
}

// The lock is held.
void TrajectoryExecutionManager::cancelHandles()
{
  for (const auto& handle : active_handles_)
    try
    {
      handle->cancelExecution();
    }
    catch (const std::exception& error)
    {
      ROS_ERROR_NAMED(log_names::TRAJECTORY_EXECUTION_MANAGER, "Caught %s when canceling execution.", error.what());
    }
}

std::pair<int, int> TrajectoryExecutionManager::getCurrentExpectedTrajectoryIndex() const
{
  std::lock_guard<std::mutex> lock(mutex_);
  if (current_ < 0 || current_ >= static_cast<int>(trajectories_.size()))
    return { -1, -1 };
  const ros::Duration gone = ros::Time::now() - current_started_;
  const moveit_msgs::RobotTrajectory* longest = nullptr;
  for (const auto& part : trajectories_[current_]->trajectory_parts_)
    if (!longest || part.joint_trajectory.points.size() > longest->joint_trajectory.points.size())
      longest = &part;
  if (!longest || longest->joint_trajectory.points.empty())
    return { current_, -1 };
  const auto& points = longest->joint_trajectory.points;
  const auto next =
      std::find_if(points.begin(), points.end(), [&gone](const auto& point) { return point.time_from_start >= gone; });
  return { current_, static_cast<int>(next - points.begin()) };
}
}  // namespace trajectory_execution_manager
