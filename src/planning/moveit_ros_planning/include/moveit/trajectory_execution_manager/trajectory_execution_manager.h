// Trajectories through controllers: which of them, whether they take the time they should, and how to stop them.
#pragma once

#include <moveit_msgs/RobotTrajectory.h>
#include <ros/ros.h>
#include <std_msgs/String.h>

#include <boost/function.hpp>
#include <atomic>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <pluginlib/class_loader.hpp>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <moveit/controller_manager/controller_manager.h>
#include <moveit/macros/class_forward.h>
#include <moveit/planning_scene_monitor/current_state_monitor.h>
#include <moveit/robot_model/robot_model.h>

namespace moveit_ros_planning
{
class DynamicSettings;
}

namespace trajectory_execution_manager
{
MOVEIT_CLASS_FORWARD(TrajectoryExecutionManager);

class TrajectoryExecutionManager
{
public:
  static const std::string EXECUTION_EVENT_TOPIC;  // trajectory_execution_event, std_msgs/String: "stop"
  typedef boost::function<void(const moveit_controller_manager::ExecutionStatus&)> ExecutionCompleteCallback;
  using PathSegmentCompleteCallback = boost::function<void(std::size_t)>;

  // A trajectory, and each controller's part of it.
  struct TrajectoryExecutionContext
  {
    std::vector<std::string> controllers_;
    std::vector<moveit_msgs::RobotTrajectory> trajectory_parts_;
  };

  // With the controllers of ~moveit_controller_manager and the parameters below ~trajectory_execution.
  TrajectoryExecutionManager(const moveit::core::RobotModelConstPtr& robot_model,
                             const planning_scene_monitor::CurrentStateMonitorPtr& csm);
  TrajectoryExecutionManager(const moveit::core::RobotModelConstPtr& robot_model,
                             const planning_scene_monitor::CurrentStateMonitorPtr& csm, bool manage_controllers);
  ~TrajectoryExecutionManager();  // stops what moves
  TrajectoryExecutionManager(const TrajectoryExecutionManager&) = delete;
  TrajectoryExecutionManager& operator=(const TrajectoryExecutionManager&) = delete;

  bool isManagingControllers() const { return manage_controllers_; }
  // Null when none could be loaded; the log says why.
  const moveit_controller_manager::MoveItControllerManagerPtr& getControllerManager() const { return controller_manager_; }
  void processEvent(const std::string& event);

  bool ensureActiveControllersForGroup(const std::string& group);
  bool ensureActiveControllersForJoints(const std::vector<std::string>& joints);
  bool ensureActiveController(const std::string& controller) { return ensureActiveControllers({ controller }); }
  bool ensureActiveControllers(const std::vector<std::string>& controllers);
  bool isControllerActive(const std::string& controller) { return areControllersActive({ controller }); }
  bool areControllersActive(const std::vector<std::string>& controllers);

  // To be executed after those that were pushed before. False, and a line in the log, when nothing can execute it.
  bool push(const moveit_msgs::RobotTrajectory& trajectory, const std::string& controller = "");
  bool push(const trajectory_msgs::JointTrajectory& trajectory, const std::string& controller = "");
  bool push(const trajectory_msgs::JointTrajectory& trajectory, const std::vector<std::string>& controllers);
  bool push(const moveit_msgs::RobotTrajectory& trajectory, const std::vector<std::string>& controllers);
  const std::vector<TrajectoryExecutionContext*>& getTrajectories() const { return pushed_; }

  void execute(const ExecutionCompleteCallback& callback = ExecutionCompleteCallback(), bool auto_clear = true)
  {
    execute(callback, PathSegmentCompleteCallback(), auto_clear);
  }
  void execute(const ExecutionCompleteCallback& callback, const PathSegmentCompleteCallback& part_callback,
               bool auto_clear = true);
  moveit_controller_manager::ExecutionStatus executeAndWait(bool auto_clear = true);
  moveit_controller_manager::ExecutionStatus waitForExecution();
  // (trajectory, way point) where the robot should be now; -1 when nothing moves.
  std::pair<int, int> getCurrentExpectedTrajectoryIndex() const;
  moveit_controller_manager::ExecutionStatus getLastExecutionStatus() const;
  void stopExecution(bool auto_clear = true);
  void clear();

  void enableExecutionDurationMonitoring(bool flag) { execution_duration_monitoring_ = flag; }
  void setAllowedExecutionDurationScaling(double scaling) { allowed_execution_duration_scaling_ = scaling; }
  void setAllowedGoalDurationMargin(double margin) { allowed_goal_duration_margin_ = margin; }
  void setExecutionVelocityScaling(double scaling) { execution_velocity_scaling_ = scaling; }
  void setAllowedStartTolerance(double tolerance) { allowed_start_tolerance_ = tolerance; }
  void setWaitForTrajectoryCompletion(bool flag) { wait_for_trajectory_completion_ = flag; }

private:
  using Status = moveit_controller_manager::ExecutionStatus;
  using Joints = std::set<std::string>;

  void initialize();
  void loadControllers();
  Joints jointsOf(const std::string& controller) const;
  std::vector<std::string> choose(const Joints& wanted, const std::vector<std::string>& allowed) const;
  bool configure(TrajectoryExecutionContext& context, const moveit_msgs::RobotTrajectory& trajectory,
                 const std::vector<std::string>& controllers) const;
  bool startsHere(const TrajectoryExecutionContext& context) const;
  bool heardOf(const TrajectoryExecutionContext& context) const;
  void run(const ExecutionCompleteCallback& callback, const PathSegmentCompleteCallback& part_callback, bool auto_clear);
  Status executePart(std::size_t index);
  bool send(const TrajectoryExecutionContext& context);
  double allowedDuration(const TrajectoryExecutionContext& context) const;
  Status watch(const TrajectoryExecutionContext& context, const ros::Time& started);
  void waitForRest(const TrajectoryExecutionContext& context) const;
  void cancelHandles();
  void join();

  moveit::core::RobotModelConstPtr robot_model_;
  planning_scene_monitor::CurrentStateMonitorPtr csm_;
  ros::NodeHandle node_handle_{ "~" }, root_node_handle_;
  ros::Subscriber event_topic_subscriber_;
  bool manage_controllers_ = false;
  std::unique_ptr<pluginlib::ClassLoader<moveit_controller_manager::MoveItControllerManager>> controller_manager_loader_;
  moveit_controller_manager::MoveItControllerManagerPtr controller_manager_;

  std::vector<std::unique_ptr<TrajectoryExecutionContext>> trajectories_;
  std::vector<TrajectoryExecutionContext*> pushed_;
  mutable std::mutex mutex_;
  std::condition_variable complete_;
  std::thread thread_;
  std::mutex thread_mutex_;
  bool running_ = false;
  std::atomic<bool> stopped_{ false };
  std::vector<moveit_controller_manager::MoveItControllerHandlePtr> active_handles_;
  Status last_execution_status_ = Status::SUCCEEDED;
  int current_ = -1;
  ros::Time current_started_;

  // Set by clients of dynamic_reconfigure, too, while a trajectory runs.
  std::atomic<bool> execution_duration_monitoring_, wait_for_trajectory_completion_;
  std::atomic<double> allowed_execution_duration_scaling_, allowed_goal_duration_margin_;
  std::atomic<double> allowed_start_tolerance_, execution_velocity_scaling_;
  // Of the controllers and joints that have their own.
  std::map<std::string, double> controller_duration_scaling_, controller_duration_margin_, joints_allowed_start_tolerance_;
  std::unique_ptr<moveit_ros_planning::DynamicSettings> settings_;  // ends first: it writes into the above
};
}  // namespace trajectory_execution_manager
