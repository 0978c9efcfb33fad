// Construction, settings, and what is known of the robot.
#include "impl.h"

#include <std_msgs/String.h>
#include <moveit_msgs/AttachedCollisionObject.h>
#include <moveit_msgs/GetCartesianPath.h>
#include <moveit_msgs/GetPlannerParams.h>
#include <moveit_msgs/GraspPlanning.h>
#include <moveit_msgs/QueryPlannerInterfaces.h>
#include <moveit_msgs/SetPlannerParams.h>
#include <tf2/utils.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

namespace moveit {
namespace planning_interface {

const char LOGNAME[] = "move_group_interface";
const std::string MoveGroupInterface::ROBOT_DESCRIPTION = "robot_description";
constexpr double MoveGroupInterface::DEFAULT_GOAL_JOINT_TOLERANCE;
constexpr double MoveGroupInterface::DEFAULT_GOAL_POSITION_TOLERANCE;
constexpr double MoveGroupInterface::DEFAULT_GOAL_ORIENTATION_TOLERANCE;
constexpr double MoveGroupInterface::DEFAULT_ALLOWED_PLANNING_TIME;
constexpr int MoveGroupInterface::DEFAULT_NUM_PLANNING_ATTEMPTS;

namespace {

const double POLL = 0.005;        // s between two looks for a server
const double SAY_SO_AFTER = 5.0;  // s
// rospy, in which move_group is written, does not hear of a client that comes while another of the same process goes: it comes again.
const double COME_AGAIN_AFTER = 3.0;  // s

[[noreturn]] void refuse(const std::string& why) {
  ROS_FATAL_STREAM_NAMED(LOGNAME, why);
  throw std::runtime_error(why);
}

template <class Action>
void connect(std::unique_ptr<actionlib::SimpleActionClient<Action>>& client, ros::NodeHandle& nh, const std::string& name,
             const ros::WallTime& until, double allotted) {
  client = std::make_unique<actionlib::SimpleActionClient<Action>>(nh, name, false);
  const ros::WallTime began = ros::WallTime::now();
  ros::WallTime came = began;
  bool said = false;
  while (nh.ok() && !client->isServerConnected() && (until.isZero() || ros::WallTime::now() < until)) {
    ros::WallDuration(POLL).sleep();
    if ((ros::WallTime::now() - came).toSec() > COME_AGAIN_AFTER) {
      client.reset();  // its topics go first, or nobody is told
      client = std::make_unique<actionlib::SimpleActionClient<Action>>(nh, name, false);
      came = ros::WallTime::now();
    }
    if (!said && (ros::WallTime::now() - began).toSec() > SAY_SO_AFTER) {
      ROS_WARN_STREAM_NAMED(LOGNAME, "Still waiting for move_group action server '"
                                         << nh.resolveName(name)
                                         << "'. Does move_group run, in this namespace, and has "
                                            "it said \"You can start planning now!\"?");
      said = true;
    }
  }
  if (!client->isServerConnected()) {
    std::ostringstream why;
    why << "Unable to connect to move_group action server '" << name << "' within allotted time (" << allotted << "s)";
    throw std::runtime_error(why.str());
  }
}

geometry_msgs::PoseStamped stamped(const Eigen::Isometry3d& pose, const std::string& frame) {
  geometry_msgs::PoseStamped result;
  result.header.stamp = ros::Time::now();
  result.header.frame_id = frame;
  result.pose = tf2::toMsg(pose);
  return result;
}

}  // namespace

MoveGroupInterface::Impl::Impl(const Options& given, const std::shared_ptr<tf2_ros::Buffer>& tf,
                               const ros::WallDuration& wait_for_servers)
    : options(given), nh(given.node_handle_), tf_buffer(tf ? tf : getSharedTF()) {
  model = options.robot_model_ ? options.robot_model_ : getSharedRobotModel(options.robot_description_);
  if (!model) refuse("Unable to construct robot model. Please make sure all needed information is on the parameter server.");
  if (!model->hasJointModelGroup(options.group_name_)) refuse("Group '" + options.group_name_ + "' was not found.");
  group = model->getJointModelGroup(options.group_name_);
  start_state.is_diff = true;
  joint_target = std::make_shared<moveit::core::RobotState>(model);
  joint_target->setToDefaultValues();
  if (group->isChain()) end_effector_link = group->getLinkModelNames().back();
  pose_frame = model->getModelFrame();

  const std::string description = options.robot_description_.empty() ? ROBOT_DESCRIPTION : options.robot_description_;
  const std::string kinematics = description + "_kinematics/" + options.group_name_;
  nh.param(kinematics + "/goal_joint_tolerance", joint_tolerance, DEFAULT_GOAL_JOINT_TOLERANCE);
  nh.param(kinematics + "/goal_position_tolerance", position_tolerance, DEFAULT_GOAL_POSITION_TOLERANCE);
  nh.param(kinematics + "/goal_orientation_tolerance", orientation_tolerance, DEFAULT_GOAL_ORIENTATION_TOLERANCE);
  nh.param(description + "_planning/default_velocity_scaling_factor", velocity_scaling, 0.1);
  nh.param(description + "_planning/default_acceleration_scaling_factor", acceleration_scaling, 0.1);

  event_publisher = nh.advertise<std_msgs::String>("trajectory_execution_event", 1);
  attached_publisher = nh.advertise<moveit_msgs::AttachedCollisionObject>("attached_collision_object", 1);
  monitor = getSharedStateMonitor(model, tf_buffer, nh);

  const ros::WallTime until = wait_for_servers.isZero() ? ros::WallTime() : ros::WallTime::now() + wait_for_servers;
  ros::NodeHandle actions(nh);
  actions.setCallbackQueue(queue.get());
  connect(move_client, actions, "move_group", until, wait_for_servers.toSec());
  connect(pick_client, actions, "pickup", until, wait_for_servers.toSec());
  connect(place_client, actions, "place", until, wait_for_servers.toSec());
  connect(execute_client, actions, "execute_trajectory", until, wait_for_servers.toSec());
  query_service = nh.serviceClient<moveit_msgs::QueryPlannerInterfaces>("query_planner_interface");
  get_params_service = nh.serviceClient<moveit_msgs::GetPlannerParams>("get_planner_params");
  set_params_service = nh.serviceClient<moveit_msgs::SetPlannerParams>("set_planner_params");
  cartesian_service = nh.serviceClient<moveit_msgs::GetCartesianPath>("compute_cartesian_path");
  grasps_service = nh.serviceClient<moveit_msgs::GraspPlanning>("plan_grasps");
  ROS_INFO_STREAM_NAMED(LOGNAME, "Ready to take commands for planning group " << options.group_name_ << ".");
}

moveit::core::RobotStatePtr MoveGroupInterface::Impl::currentState(double wait) const {
  if (!monitor->isActive()) monitor->startStateMonitor();
  if (monitor->waitForCurrentState(ros::Time::now(), wait)) return monitor->getCurrentState();
  ROS_ERROR_NAMED(LOGNAME, "Failed to fetch current robot state");
  return nullptr;
}

moveit::core::RobotStatePtr MoveGroupInterface::Impl::startState() const {
  moveit::core::RobotStatePtr state = currentState();
  if (state && !(start_state.joint_state.name.empty() && start_state.multi_dof_joint_state.joint_names.empty() &&
                 start_state.attached_collision_objects.empty()))
    moveit::core::robotStateMsgToRobotState(start_state, *state, true);
  return state;
}

void MoveGroupInterface::Impl::setScalingFactor(double& factor, double wanted, const char* name) {
  if (wanted > 1) {
    ROS_WARN_NAMED(LOGNAME, "Limiting max_%s (%.2f) to 1.0.", name, wanted);
    factor = 1;
  } else if (wanted > 0) {
    factor = wanted;
  } else {
    nh.param(std::string("robot_description_planning/default_") + name, factor, 0.1);
    if (wanted < 0) ROS_WARN_NAMED(LOGNAME, "max_%s < 0.0! Setting to default: %.2f.", name, factor);
  }
}

MoveGroupInterface::MoveGroupInterface(const Options& opt, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer,
                                       const ros::WallDuration& wait_for_servers)
    : impl_(std::make_unique<Impl>(opt, tf_buffer, wait_for_servers)) {}

MoveGroupInterface::MoveGroupInterface(const Options& opt, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer,
                                       const ros::Duration& wait_for_servers)
    : MoveGroupInterface(opt, tf_buffer, ros::WallDuration(wait_for_servers.toSec())) {}

namespace {

MoveGroupInterface::Options checked(const std::string& group) {
  if (!ros::ok()) throw std::runtime_error("ROS does not seem to be running");
  return MoveGroupInterface::Options(group);
}

}  // namespace

MoveGroupInterface::MoveGroupInterface(const std::string& group, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer,
                                       const ros::WallDuration& wait_for_servers)
    : MoveGroupInterface(checked(group), tf_buffer, wait_for_servers) {}

MoveGroupInterface::MoveGroupInterface(const std::string& group, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer,
                                       const ros::Duration& wait_for_servers)
    : MoveGroupInterface(checked(group), tf_buffer, ros::WallDuration(wait_for_servers.toSec())) {}

MoveGroupInterface::~MoveGroupInterface() = default;
MoveGroupInterface::MoveGroupInterface(MoveGroupInterface&& other) noexcept = default;
MoveGroupInterface& MoveGroupInterface::operator=(MoveGroupInterface&& other) noexcept = default;

const std::string& MoveGroupInterface::getName() const { return impl_->options.group_name_; }
moveit::core::RobotModelConstPtr MoveGroupInterface::getRobotModel() const { return impl_->model; }
const ros::NodeHandle& MoveGroupInterface::getNodeHandle() const { return impl_->options.node_handle_; }
const std::string& MoveGroupInterface::getPlanningFrame() const { return impl_->model->getModelFrame(); }
const std::vector<std::string>& MoveGroupInterface::getNamedTargets() const { return impl_->group->getDefaultStateNames(); }
const std::vector<std::string>& MoveGroupInterface::getJointModelGroupNames() const {
  return impl_->model->getJointModelGroupNames();
}
const std::vector<std::string>& MoveGroupInterface::getLinkNames() const { return impl_->group->getLinkModelNames(); }
const std::vector<std::string>& MoveGroupInterface::getJoints() const { return impl_->group->getJointModelNames(); }
const std::vector<std::string>& MoveGroupInterface::getVariableNames() const { return impl_->group->getVariableNames(); }
const std::vector<std::string>& MoveGroupInterface::getActiveJoints() const { return impl_->group->getActiveJointModelNames(); }
unsigned int MoveGroupInterface::getVariableCount() const { return impl_->group->getVariableCount(); }

std::map<std::string, double> MoveGroupInterface::getNamedTargetValues(const std::string& name) const {
  std::map<std::string, double> values;
  const auto remembered = remembered_.find(name);
  if (remembered == remembered_.end()) {
    impl_->group->getVariableDefaultPositions(name, values);
    return values;
  }
  const std::vector<std::string>& names = getVariableNames();
  for (std::size_t i = 0; i < names.size() && i < remembered->second.size(); ++i) values[names[i]] = remembered->second[i];
  return values;
}

bool MoveGroupInterface::getInterfaceDescriptions(std::vector<moveit_msgs::PlannerInterfaceDescription>& desc) const {
  moveit_msgs::QueryPlannerInterfaces query;
  if (!impl_->query_service.call(query) || query.response.planner_interfaces.empty()) return false;
  desc = query.response.planner_interfaces;
  return true;
}

bool MoveGroupInterface::getInterfaceDescription(moveit_msgs::PlannerInterfaceDescription& desc) const {
  std::vector<moveit_msgs::PlannerInterfaceDescription> all;
  if (!getInterfaceDescriptions(all)) return false;
  desc = all.front();
  return true;
}

std::map<std::string, std::string> MoveGroupInterface::getPlannerParams(const std::string& planner_id,
                                                                        const std::string& group) const {
  moveit_msgs::GetPlannerParams query;
  query.request.planner_config = planner_id;
  query.request.group = group;
  std::map<std::string, std::string> params;
  if (impl_->get_params_service.call(query))
    for (std::size_t i = 0; i < query.response.params.keys.size() && i < query.response.params.values.size(); ++i)
      params[query.response.params.keys[i]] = query.response.params.values[i];
  return params;
}

void MoveGroupInterface::setPlannerParams(const std::string& planner_id, const std::string& group,
                                          const std::map<std::string, std::string>& params, bool bReplace) {
  moveit_msgs::SetPlannerParams command;
  command.request.planner_config = planner_id;
  command.request.group = group;
  command.request.replace = bReplace;
  for (const auto& [key, value] : params) {
    command.request.params.keys.push_back(key);
    command.request.params.values.push_back(value);
  }
  impl_->set_params_service.call(command);
}

std::string MoveGroupInterface::getDefaultPlanningPipelineId() const {
  std::string id;
  impl_->nh.getParam("move_group/default_planning_pipeline", id);
  return id;
}

void MoveGroupInterface::setPlanningPipelineId(const std::string& pipeline_id) {
  if (pipeline_id == impl_->pipeline_id) return;
  impl_->pipeline_id = pipeline_id;
  impl_->planner_id.clear();
}

std::string MoveGroupInterface::getDefaultPlannerId(const std::string& group) const {
  const std::string pipeline = impl_->pipeline_id.empty() ? getDefaultPlanningPipelineId() : impl_->pipeline_id;
  std::string id;
  impl_->nh.getParam("move_group" + (pipeline.empty() ? "" : "/planning_pipelines/" + pipeline) +
                         (group.empty() ? "" : "/" + group) + "/default_planner_config",
                     id);
  return id;
}

const std::string& MoveGroupInterface::getPlanningPipelineId() const { return impl_->pipeline_id; }
void MoveGroupInterface::setPlannerId(const std::string& planner_id) { impl_->planner_id = planner_id; }
const std::string& MoveGroupInterface::getPlannerId() const { return impl_->planner_id; }
double MoveGroupInterface::getPlanningTime() const { return impl_->planning_time; }
void MoveGroupInterface::setPlanningTime(double seconds) {
  if (seconds > 0) impl_->planning_time = seconds;
}
void MoveGroupInterface::setNumPlanningAttempts(unsigned int attempts) { impl_->attempts = attempts; }
void MoveGroupInterface::setMaxVelocityScalingFactor(double factor) {
  impl_->setScalingFactor(impl_->velocity_scaling, factor, "velocity_scaling_factor");
}
void MoveGroupInterface::setMaxAccelerationScalingFactor(double factor) {
  impl_->setScalingFactor(impl_->acceleration_scaling, factor, "acceleration_scaling_factor");
}
void MoveGroupInterface::limitMaxCartesianLinkSpeed(const double max_speed, const std::string& link_name) {
  impl_->speed_limited_link = link_name;
  impl_->max_cartesian_speed = max_speed;
}
void MoveGroupInterface::clearMaxCartesianLinkSpeed() { limitMaxCartesianLinkSpeed(0); }

double MoveGroupInterface::getGoalJointTolerance() const { return impl_->joint_tolerance; }
double MoveGroupInterface::getGoalPositionTolerance() const { return impl_->position_tolerance; }
double MoveGroupInterface::getGoalOrientationTolerance() const { return impl_->orientation_tolerance; }
void MoveGroupInterface::setGoalTolerance(double tolerance) {
  impl_->joint_tolerance = impl_->position_tolerance = impl_->orientation_tolerance = tolerance;
}
void MoveGroupInterface::setGoalJointTolerance(double tolerance) { impl_->joint_tolerance = tolerance; }
void MoveGroupInterface::setGoalPositionTolerance(double tolerance) { impl_->position_tolerance = tolerance; }
void MoveGroupInterface::setGoalOrientationTolerance(double tolerance) { impl_->orientation_tolerance = tolerance; }

void MoveGroupInterface::setWorkspace(double minx, double miny, double minz, double maxx, double maxy, double maxz) {
  impl_->workspace.header.frame_id = getPlanningFrame();
  impl_->workspace.header.stamp = ros::Time::now();
  impl_->workspace.min_corner.x = minx;
  impl_->workspace.min_corner.y = miny;
  impl_->workspace.min_corner.z = minz;
  impl_->workspace.max_corner.x = maxx;
  impl_->workspace.max_corner.y = maxy;
  impl_->workspace.max_corner.z = maxz;
}

void MoveGroupInterface::allowLooking(bool flag) { impl_->look = flag; }
void MoveGroupInterface::allowReplanning(bool flag) { impl_->replan = flag; }
void MoveGroupInterface::setLookAroundAttempts(int32_t attempts) {
  if (attempts < 0) ROS_ERROR_NAMED(LOGNAME, "Tried to set negative number of look-around attempts");
  else impl_->look_attempts = attempts;
}
void MoveGroupInterface::setReplanAttempts(int32_t attempts) {
  if (attempts < 0) ROS_ERROR_NAMED(LOGNAME, "Tried to set negative number of replan attempts");
  else impl_->replan_attempts = attempts;
}
void MoveGroupInterface::setReplanDelay(double delay) {
  if (delay < 0) ROS_ERROR_NAMED(LOGNAME, "Tried to set negative replan delay");
  else impl_->replan_delay = delay;
}
void MoveGroupInterface::setSupportSurfaceName(const std::string& name) { impl_->support_surface = name; }

bool MoveGroupInterface::startStateMonitor(double wait) {
  if (!impl_->monitor->isActive()) impl_->monitor->startStateMonitor();
  impl_->monitor->waitForCompleteState(getName(), wait);
  return true;
}

moveit::core::RobotStatePtr MoveGroupInterface::getCurrentState(double wait) const { return impl_->currentState(wait); }

std::vector<double> MoveGroupInterface::getCurrentJointValues() const {
  std::vector<double> values;
  if (const moveit::core::RobotStatePtr state = impl_->currentState()) state->copyJointGroupPositions(getName(), values);
  return values;
}

std::vector<double> MoveGroupInterface::getRandomJointValues() const {
  std::vector<double> values;
  impl_->group->getVariableRandomPositions(impl_->joint_target->getRandomNumberGenerator(), values);
  return values;
}

namespace {

// Identity when the link or the state is not known, as it has always been.
Eigen::Isometry3d linkPose(const moveit::core::RobotStatePtr& state, const std::string& link) {
  const moveit::core::LinkModel* model = state ? state->getLinkModel(link) : nullptr;
  return model ? state->getGlobalLinkTransform(model) : Eigen::Isometry3d::Identity();
}

bool isNamed(const std::string& link) {
  if (link.empty()) ROS_ERROR_NAMED(LOGNAME, "No end-effector specified");
  return !link.empty();
}

}  // namespace

geometry_msgs::PoseStamped MoveGroupInterface::getCurrentPose(const std::string& end_effector_link) const {
  const std::string& link = impl_->link(end_effector_link);
  return stamped(isNamed(link) ? linkPose(impl_->currentState(), link) : Eigen::Isometry3d::Identity(), getPlanningFrame());
}

std::vector<double> MoveGroupInterface::getCurrentRPY(const std::string& end_effector_link) const {
  const std::string& link = impl_->link(end_effector_link);
  const moveit::core::RobotStatePtr state = isNamed(link) ? impl_->currentState() : nullptr;
  if (!state || !state->getLinkModel(link)) return {};
  tf2::Quaternion q;
  tf2::fromMsg(tf2::toMsg(linkPose(state, link)).orientation, q);
  double roll, pitch, yaw;
  tf2::Matrix3x3(q).getRPY(roll, pitch, yaw);
  return {roll, pitch, yaw};
}

geometry_msgs::PoseStamped MoveGroupInterface::getRandomPose(const std::string& end_effector_link) const {
  const std::string& link = impl_->link(end_effector_link);
  const moveit::core::RobotStatePtr state = isNamed(link) ? impl_->currentState() : nullptr;
  if (state) {
    state->setToRandomPositions(impl_->group);
    state->update();
  }
  return stamped(linkPose(state, link), getPlanningFrame());
}

void MoveGroupInterface::rememberJointValues(const std::string& name) { rememberJointValues(name, getCurrentJointValues()); }
void MoveGroupInterface::rememberJointValues(const std::string& name, const std::vector<double>& values) {
  remembered_[name] = values;
}
void MoveGroupInterface::forgetJointValues(const std::string& name) { remembered_.erase(name); }

void MoveGroupInterface::setConstraintsDatabase(const std::string& host, unsigned int port) {
  ROS_ERROR_NAMED(LOGNAME,
                  "No constraints are read from the database at %s:%u: this library knows none. Give them to "
                  "setPathConstraints() as a message.",
                  host.c_str(), port);
}
std::vector<std::string> MoveGroupInterface::getKnownConstraints() const { return {}; }
bool MoveGroupInterface::setPathConstraints(const std::string& constraint) {
  ROS_ERROR_NAMED(LOGNAME,
                  "No path constraints named '%s': constraints are stored nowhere. Give them to "
                  "setPathConstraints() as a message.",
                  constraint.c_str());
  return false;
}
moveit_msgs::Constraints MoveGroupInterface::getPathConstraints() const {
  return impl_->path_constraints ? *impl_->path_constraints : moveit_msgs::Constraints();
}
void MoveGroupInterface::setPathConstraints(const moveit_msgs::Constraints& constraint) {
  impl_->path_constraints = std::make_unique<moveit_msgs::Constraints>(constraint);
}
void MoveGroupInterface::clearPathConstraints() { impl_->path_constraints.reset(); }
moveit_msgs::TrajectoryConstraints MoveGroupInterface::getTrajectoryConstraints() const {
  return impl_->trajectory_constraints ? *impl_->trajectory_constraints : moveit_msgs::TrajectoryConstraints();
}
void MoveGroupInterface::setTrajectoryConstraints(const moveit_msgs::TrajectoryConstraints& constraint) {
  impl_->trajectory_constraints = std::make_unique<moveit_msgs::TrajectoryConstraints>(constraint);
}
void MoveGroupInterface::clearTrajectoryConstraints() { impl_->trajectory_constraints.reset(); }

}  // namespace planning_interface
}  // namespace moveit
