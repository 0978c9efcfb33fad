// What a program needs to move a planning group: a client of move_group's actions, services and topics.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <actionlib/client/simple_action_client.h>
#include <geometry_msgs/PoseStamped.h>
#include <moveit/macros/class_forward.h>
#include <moveit/robot_state/conversions.h>
#include <moveit/robot_state/robot_state.h>
#include <moveit/utils/moveit_error_code.h>
#include <moveit_msgs/Constraints.h>
#include <moveit_msgs/Grasp.h>
#include <moveit_msgs/MotionPlanRequest.h>
#include <moveit_msgs/MoveGroupAction.h>
#include <moveit_msgs/PickupGoal.h>
#include <moveit_msgs/PlaceGoal.h>
#include <moveit_msgs/PlaceLocation.h>
#include <moveit_msgs/PlannerInterfaceDescription.h>
#include <moveit_msgs/RobotState.h>
#include <moveit_msgs/RobotTrajectory.h>
#include <tf2_ros/buffer.h>

namespace moveit {
namespace planning_interface {

using MoveItErrorCode = moveit::core::MoveItErrorCode;

MOVEIT_CLASS_FORWARD(MoveGroupInterface);

/// One planning group of one robot. Lengths are in m, angles in rad, times in s; poses without a frame are in the pose
/// reference frame. Calls that wait for move_group need no spinner of the program's own. Not to be shared between threads.
class MoveGroupInterface {
 public:
  static constexpr double DEFAULT_GOAL_JOINT_TOLERANCE = 1e-4;
  static constexpr double DEFAULT_GOAL_POSITION_TOLERANCE = 1e-4;
  static constexpr double DEFAULT_GOAL_ORIENTATION_TOLERANCE = 1e-3;
  static constexpr double DEFAULT_ALLOWED_PLANNING_TIME = 5.0;
  static constexpr int DEFAULT_NUM_PLANNING_ATTEMPTS = 1;

  /// The parameter that holds the robot unless another is named.
  static const std::string ROBOT_DESCRIPTION;

  struct Options {
    Options(std::string group_name, std::string desc = ROBOT_DESCRIPTION,
            const ros::NodeHandle& node_handle = ros::NodeHandle())
        : group_name_(std::move(group_name)), robot_description_(std::move(desc)), node_handle_(node_handle) {}

    std::string group_name_;
    std::string robot_description_;
    moveit::core::RobotModelConstPtr robot_model_;  // taken in place of the parameter when set
    ros::NodeHandle node_handle_;                   // its namespace is that of move_group
  };

  MOVEIT_STRUCT_FORWARD(Plan);

  /// A motion that was planned.
  struct Plan {
    moveit_msgs::RobotState start_state_;
    moveit_msgs::RobotTrajectory trajectory_;
    double planning_time_ = 0;
  };

  /// Waits for the servers of move_group, for ever when wait_for_servers is zero.
  /// @throws std::runtime_error for a robot or group that is not there, and for servers that do not come in time
  MoveGroupInterface(const Options& opt, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer = std::shared_ptr<tf2_ros::Buffer>(),
                     const ros::WallDuration& wait_for_servers = ros::WallDuration());
  MoveGroupInterface(const Options& opt, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer,
                     const ros::Duration& wait_for_servers);
  MoveGroupInterface(const std::string& group,
                     const std::shared_ptr<tf2_ros::Buffer>& tf_buffer = std::shared_ptr<tf2_ros::Buffer>(),
                     const ros::WallDuration& wait_for_servers = ros::WallDuration());
  MoveGroupInterface(const std::string& group, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer,
                     const ros::Duration& wait_for_servers);
  ~MoveGroupInterface();
  MoveGroupInterface(const MoveGroupInterface&) = delete;
  MoveGroupInterface& operator=(const MoveGroupInterface&) = delete;
  MoveGroupInterface(MoveGroupInterface&& other) noexcept;
  MoveGroupInterface& operator=(MoveGroupInterface&& other) noexcept;

  const std::string& getName() const;
  const std::vector<std::string>& getNamedTargets() const;
  moveit::core::RobotModelConstPtr getRobotModel() const;
  const ros::NodeHandle& getNodeHandle() const;
  const std::string& getPlanningFrame() const;
  const std::vector<std::string>& getJointModelGroupNames() const;
  const std::vector<std::string>& getLinkNames() const;
  /// Joint by joint; empty for a name that is not known.
  std::map<std::string, double> getNamedTargetValues(const std::string& name) const;
  /// All joints, fixed ones too.
  const std::vector<std::string>& getJoints() const;
  const std::vector<std::string>& getJointNames() const { return getVariableNames(); }
  /// One name per degree of freedom, mimic joints too.
  const std::vector<std::string>& getVariableNames() const;
  /// Those that a controller moves.
  const std::vector<std::string>& getActiveJoints() const;
  unsigned int getVariableCount() const;

  bool getInterfaceDescriptions(std::vector<moveit_msgs::PlannerInterfaceDescription>& desc) const;
  bool getInterfaceDescription(moveit_msgs::PlannerInterfaceDescription& desc) const;
  std::map<std::string, std::string> getPlannerParams(const std::string& planner_id, const std::string& group = "") const;
  void setPlannerParams(const std::string& planner_id, const std::string& group,
                        const std::map<std::string, std::string>& params, bool bReplace = false);
  std::string getDefaultPlanningPipelineId() const;
  /// Forgets the planner, when the pipeline is another one.
  void setPlanningPipelineId(const std::string& pipeline_id);
  const std::string& getPlanningPipelineId() const;
  std::string getDefaultPlannerId(const std::string& group = "") const;
  void setPlannerId(const std::string& planner_id);
  const std::string& getPlannerId() const;
  void setPlanningTime(double seconds);
  double getPlanningTime() const;
  void setNumPlanningAttempts(unsigned int num_planning_attempts);
  /// Above 0 up to 1; 0 and below ask for the default of joint_limits.yaml.
  void setMaxVelocityScalingFactor(double max_velocity_scaling_factor);
  void setMaxAccelerationScalingFactor(double max_acceleration_scaling_factor);
  /// No faster than max_speed (m/s) of the link; the tip when no link is named.
  void limitMaxCartesianLinkSpeed(const double max_speed, const std::string& link_name = "");
  void clearMaxCartesianLinkSpeed();
  double getGoalJointTolerance() const;
  double getGoalPositionTolerance() const;
  double getGoalOrientationTolerance() const;
  void setGoalTolerance(double tolerance);
  void setGoalJointTolerance(double tolerance);
  void setGoalPositionTolerance(double tolerance);
  void setGoalOrientationTolerance(double tolerance);
  /// Box in the planning frame that planar and floating joints stay in.
  void setWorkspace(double minx, double miny, double minz, double maxx, double maxy, double maxz);

  /// Where plans begin, until another state is set.
  void setStartState(const moveit_msgs::RobotState& start_state);
  void setStartState(const moveit::core::RobotState& start_state);
  void setStartStateToCurrentState();
  /// What objects stand on, for pick and place.
  void setSupportSurfaceName(const std::string& name);

  // Joint targets. False when the target is out of bounds, though it is set then, or when it cannot be set.
  bool setJointValueTarget(const std::vector<double>& group_variable_values);
  bool setJointValueTarget(const std::map<std::string, double>& variable_values);
  bool setJointValueTarget(const std::vector<std::string>& variable_names, const std::vector<double>& variable_values);
  bool setJointValueTarget(const moveit::core::RobotState& robot_state);
  bool setJointValueTarget(const std::string& joint_name, const std::vector<double>& values);
  bool setJointValueTarget(const std::string& joint_name, double value);
  bool setJointValueTarget(const sensor_msgs::JointState& state);
  // The joints that inverse kinematics finds for a pose of the link; approximate ones may end beside it.
  bool setJointValueTarget(const geometry_msgs::Pose& eef_pose, const std::string& end_effector_link = "");
  bool setJointValueTarget(const geometry_msgs::PoseStamped& eef_pose, const std::string& end_effector_link = "");
  bool setJointValueTarget(const Eigen::Isometry3d& eef_pose, const std::string& end_effector_link = "");
  bool setApproximateJointValueTarget(const geometry_msgs::Pose& eef_pose, const std::string& end_effector_link = "");
  bool setApproximateJointValueTarget(const geometry_msgs::PoseStamped& eef_pose, const std::string& end_effector_link = "");
  bool setApproximateJointValueTarget(const Eigen::Isometry3d& eef_pose, const std::string& end_effector_link = "");
  void setRandomTarget();
  /// A remembered name, or a state of the SRDF.
  bool setNamedTarget(const std::string& name);
  void getJointValueTarget(std::vector<double>& group_variable_values) const;
  const moveit::core::RobotState& getJointValueTarget() const;

  // Pose targets of a link, the end effector's when none is named. One of several is enough to reach.
  bool setPositionTarget(double x, double y, double z, const std::string& end_effector_link = "");
  bool setRPYTarget(double roll, double pitch, double yaw, const std::string& end_effector_link = "");
  bool setOrientationTarget(double x, double y, double z, double w, const std::string& end_effector_link = "");
  bool setPoseTarget(const Eigen::Isometry3d& end_effector_pose, const std::string& end_effector_link = "");
  bool setPoseTarget(const geometry_msgs::Pose& target, const std::string& end_effector_link = "");
  bool setPoseTarget(const geometry_msgs::PoseStamped& target, const std::string& end_effector_link = "");
  bool setPoseTargets(const EigenSTL::vector_Isometry3d& end_effector_pose, const std::string& end_effector_link = "");
  bool setPoseTargets(const std::vector<geometry_msgs::Pose>& target, const std::string& end_effector_link = "");
  bool setPoseTargets(const std::vector<geometry_msgs::PoseStamped>& target, const std::string& end_effector_link = "");
  void setPoseReferenceFrame(const std::string& pose_reference_frame);
  const std::string& getPoseReferenceFrame() const;
  bool setEndEffectorLink(const std::string& end_effector_link);
  bool setEndEffector(const std::string& eef_name);
  const std::string& getEndEffectorLink() const;
  const std::string& getEndEffector() const;
  void clearPoseTarget(const std::string& end_effector_link = "");
  void clearPoseTargets();
  const geometry_msgs::PoseStamped& getPoseTarget(const std::string& end_effector_link = "") const;
  const std::vector<geometry_msgs::PoseStamped>& getPoseTargets(const std::string& end_effector_link = "") const;

  // Planning and execution. Those with async in their name return when the goal is sent.
  moveit::core::MoveItErrorCode asyncMove();
  actionlib::SimpleActionClient<moveit_msgs::MoveGroupAction>& getMoveGroupClient() const;
  moveit::core::MoveItErrorCode move();
  moveit::core::MoveItErrorCode plan(Plan& plan);
  moveit::core::MoveItErrorCode asyncExecute(const Plan& plan);
  moveit::core::MoveItErrorCode asyncExecute(const moveit_msgs::RobotTrajectory& trajectory);
  moveit::core::MoveItErrorCode execute(const Plan& plan);
  moveit::core::MoveItErrorCode execute(const moveit_msgs::RobotTrajectory& trajectory);

  /// Straight lines of the end effector from point to point, a state every eef_step or closer.
  /// @param jump_threshold cut the path where a step of the joints is this many times the mean one; 0 allows all
  /// @return which share of the path there is, -1 for an error
  double computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step, double jump_threshold,
                              moveit_msgs::RobotTrajectory& trajectory, bool avoid_collisions = true,
                              moveit_msgs::MoveItErrorCodes* error_code = nullptr);
  double computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step,
                              moveit_msgs::RobotTrajectory& trajectory, bool avoid_collisions = true,
                              moveit_msgs::MoveItErrorCodes* error_code = nullptr);
  double computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step, double jump_threshold,
                              moveit_msgs::RobotTrajectory& trajectory, const moveit_msgs::Constraints& path_constraints,
                              bool avoid_collisions = true, moveit_msgs::MoveItErrorCodes* error_code = nullptr);
  double computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step,
                              moveit_msgs::RobotTrajectory& trajectory, const moveit_msgs::Constraints& path_constraints,
                              bool avoid_collisions = true, moveit_msgs::MoveItErrorCodes* error_code = nullptr);

  /// End whatever moves now, also what others sent.
  void stop();
  void allowReplanning(bool flag);
  void setReplanAttempts(int32_t attempts);
  void setReplanDelay(double delay);
  void allowLooking(bool flag);
  void setLookAroundAttempts(int32_t attempts);
  void constructMotionPlanRequest(moveit_msgs::MotionPlanRequest& request);

  moveit_msgs::PickupGoal constructPickupGoal(const std::string& object, std::vector<moveit_msgs::Grasp> grasps,
                                              bool plan_only) const;
  moveit_msgs::PlaceGoal constructPlaceGoal(const std::string& object, std::vector<moveit_msgs::PlaceLocation> locations,
                                            bool plan_only) const;
  /// Down to each pose and back along the end effector.
  std::vector<moveit_msgs::PlaceLocation> posesToPlaceLocations(const std::vector<geometry_msgs::PoseStamped>& poses) const;

  moveit::core::MoveItErrorCode pick(const std::string& object, bool plan_only = false) {
    return pick(constructPickupGoal(object, std::vector<moveit_msgs::Grasp>(), plan_only));
  }
  moveit::core::MoveItErrorCode pick(const std::string& object, const moveit_msgs::Grasp& grasp, bool plan_only = false) {
    return pick(constructPickupGoal(object, {grasp}, plan_only));
  }
  moveit::core::MoveItErrorCode pick(const std::string& object, std::vector<moveit_msgs::Grasp> grasps,
                                     bool plan_only = false) {
    return pick(constructPickupGoal(object, std::move(grasps), plan_only));
  }
  moveit::core::MoveItErrorCode pick(const moveit_msgs::PickupGoal& goal);
  /// Grasps from the service plan_grasps, which a program of somebody else's offers.
  moveit::core::MoveItErrorCode planGraspsAndPick(const std::string& object = "", bool plan_only = false);
  moveit::core::MoveItErrorCode planGraspsAndPick(const moveit_msgs::CollisionObject& object, bool plan_only = false);
  moveit::core::MoveItErrorCode place(const std::string& object, bool plan_only = false) {
    return place(constructPlaceGoal(object, std::vector<moveit_msgs::PlaceLocation>(), plan_only));
  }
  moveit::core::MoveItErrorCode place(const std::string& object, std::vector<moveit_msgs::PlaceLocation> locations,
                                      bool plan_only = false) {
    return place(constructPlaceGoal(object, std::move(locations), plan_only));
  }
  moveit::core::MoveItErrorCode place(const std::string& object, const std::vector<geometry_msgs::PoseStamped>& poses,
                                      bool plan_only = false) {
    return place(constructPlaceGoal(object, posesToPlaceLocations(poses), plan_only));
  }
  moveit::core::MoveItErrorCode place(const std::string& object, const geometry_msgs::PoseStamped& pose,
                                      bool plan_only = false) {
    return place(constructPlaceGoal(object, posesToPlaceLocations({pose}), plan_only));
  }
  moveit::core::MoveItErrorCode place(const moveit_msgs::PlaceGoal& goal);

  /// To the link, the end effector's when none is named. True means asked for, not done.
  bool attachObject(const std::string& object, const std::string& link = "");
  bool attachObject(const std::string& object, const std::string& link, const std::vector<std::string>& touch_links);
  /// An object's name, or a link's; all of the group without one.
  bool detachObject(const std::string& name = "");

  /// Listen to the joints already now, and wait for a state of the whole group.
  bool startStateMonitor(double wait = 1.0);
  /// Empty when no state newer than the call comes within a second.
  std::vector<double> getCurrentJointValues() const;
  /// Null when no state newer than the call comes within the time.
  moveit::core::RobotStatePtr getCurrentState(double wait = 1) const;
  /// In the planning frame.
  geometry_msgs::PoseStamped getCurrentPose(const std::string& end_effector_link = "") const;
  std::vector<double> getCurrentRPY(const std::string& end_effector_link = "") const;
  std::vector<double> getRandomJointValues() const;
  geometry_msgs::PoseStamped getRandomPose(const std::string& end_effector_link = "") const;

  void rememberJointValues(const std::string& name);
  void rememberJointValues(const std::string& name, const std::vector<double>& values);
  const std::map<std::string, std::vector<double>>& getRememberedJointValues() const { return remembered_; }
  void forgetJointValues(const std::string& name);

  /// Constraints by name come from a database, which there is none of here: docs/differences.md.
  void setConstraintsDatabase(const std::string& host, unsigned int port);
  std::vector<std::string> getKnownConstraints() const;
  moveit_msgs::Constraints getPathConstraints() const;
  bool setPathConstraints(const std::string& constraint);
  void setPathConstraints(const moveit_msgs::Constraints& constraint);
  void clearPathConstraints();
  moveit_msgs::TrajectoryConstraints getTrajectoryConstraints() const;
  void setTrajectoryConstraints(const moveit_msgs::TrajectoryConstraints& constraint);
  void clearTrajectoryConstraints();

 protected:
  const moveit::core::RobotState& getTargetRobotState() const;

 private:
  struct Impl;

  bool setTarget(const geometry_msgs::Pose& pose, const std::string& link, const std::string& frame, bool approximate);
  geometry_msgs::PoseStamped partOfTarget(const std::string& link) const;
  moveit::core::MoveItErrorCode requestMove(bool wait);
  moveit::core::MoveItErrorCode requestExecution(const moveit_msgs::RobotTrajectory& trajectory, bool wait);

  std::map<std::string, std::vector<double>> remembered_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace planning_interface
}  // namespace moveit
