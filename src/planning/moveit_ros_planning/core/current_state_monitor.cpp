#include <moveit/planning_scene_monitor/current_state_monitor.h>

#include <chrono>
#include <cmath>
#include <sstream>

#include <tf2_eigen/tf2_eigen.h>

#include "laws/state_stamps.hpp"
#include "log_names.hpp"

namespace planning_scene_monitor
{
namespace
{
const double CHANGE = 1e-5;  // of a joint of several degrees of freedom, that callbacks are told of

std::string listed(const std::vector<std::string>& names)
{
  std::string result;
  for (const std::string& name : names)
    result += (result.empty() ? "'" : ", '") + name + "'";
  return result;
}

bool isContinuous(const moveit::core::JointModel& joint)
{
  const auto* revolute = dynamic_cast<const moveit::core::RevoluteJointModel*>(&joint);
  return revolute && revolute->isContinuous();
}

// The frame that TF has a joint's transform in.
std::string parentFrame(const moveit::core::RobotModel& model, const moveit::core::JointModel& joint)
{
  const moveit::core::LinkModel* parent = joint.getParentLinkModel();
  return parent ? parent->getName() : model.getModelFrame();
}

}  // namespace

CurrentStateMonitor::CurrentStateMonitor(const moveit::core::RobotModelConstPtr& robot_model,
                                         const std::shared_ptr<tf2_ros::Buffer>& tf_buffer)
  : CurrentStateMonitor(robot_model, tf_buffer, ros::NodeHandle())
{
}

CurrentStateMonitor::CurrentStateMonitor(const moveit::core::RobotModelConstPtr& robot_model,
                                         const std::shared_ptr<tf2_ros::Buffer>& tf_buffer, const ros::NodeHandle& nh)
  : nh_(nh)
  , tf_buffer_(tf_buffer)
  , robot_model_(robot_model)
  , robot_state_(robot_model)
  , error_(std::numeric_limits<double>::epsilon())
{
  robot_state_.setToDefaultValues();
  nh_.setCallbackQueue(&queue_);
}

CurrentStateMonitor::~CurrentStateMonitor() { stopStateMonitor(); }

void CurrentStateMonitor::startStateMonitor(const std::string& joint_states_topic)
{
  if (started_ || !robot_model_)
    return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    joint_time_.clear();
  }
  if (joint_states_topic.empty())
    ROS_ERROR_NAMED(log_names::CURRENT_STATE_MONITOR, "The joint states topic cannot be an empty string");
  else
    joint_state_subscriber_ = nh_.subscribe(joint_states_topic, 25, &CurrentStateMonitor::take, this);
  if (tf_buffer_ && !robot_model_->getMultiDOFJointModels().empty())
  {
    tf_connection_ =
        std::make_unique<boost::signals2::connection>(tf_buffer_->_addTransformsChangedListener([this] { takeTransforms(); }));
    // What is there already may be all that comes: a static transform is sent once.
    const auto& joints = robot_model_->getMultiDOFJointModels();
    if (std::any_of(joints.begin(), joints.end(), [this](auto* joint) {
          return tf_buffer_->canTransform(parentFrame(*robot_model_, *joint), joint->getChildLinkModel()->getName(),
                                          ros::Time(0));
        }))
      takeTransforms();
  }
  spinner_ = std::make_unique<ros::AsyncSpinner>(1, &queue_);
  spinner_->start();
  started_ = true;
  monitor_start_time_ = ros::Time::now();
}

void CurrentStateMonitor::stopStateMonitor()
{
  if (!started_)
    return;
  joint_state_subscriber_.shutdown();
  spinner_.reset();
  if (tf_connection_)
    tf_buffer_->_removeTransformsChangedListener(*tf_connection_);
  tf_connection_.reset();
  started_ = false;
}

bool CurrentStateMonitor::isActive() const { return started_; }

std::string CurrentStateMonitor::getMonitoredTopic() const
{
  return joint_state_subscriber_ ? joint_state_subscriber_.getTopic() : "";
}

const CurrentStateMonitor::Joints& CurrentStateMonitor::activeJoints(const std::string& group) const
{
  if (group.empty())
    return robot_model_->getActiveJointModels();
  if (robot_model_->hasJointModelGroup(group))
    return robot_model_->getJointModelGroup(group)->getActiveJointModels();
  ROS_ERROR_STREAM_NAMED(log_names::CURRENT_STATE_MONITOR,
                         "There is no group with the name \"" << group << "\": all joints of the robot count");
  return robot_model_->getActiveJointModels();
}

bool CurrentStateMonitor::isComplete(const ros::Time& since, std::vector<std::string>* missing, const std::string& group) const
{
  const Joints& joints = activeJoints(group);
  const std::lock_guard<std::mutex> lock(mutex_);
  bool complete = true;
  for (const moveit::core::JointModel* joint : joints)
  {
    const auto heard = joint_time_.find(joint);
    if (heard != joint_time_.end() && heard->second >= since)
      continue;
    complete = false;
    if (missing)
      missing->push_back(joint->getName());
  }
  return complete;
}

// Static transforms have no time and hold nobody up. Zero when a joint was never heard of, or none at all.
ros::Time CurrentStateMonitor::oldest(const std::string& group, bool leave_out_the_unheard) const
{
  ros::Time result = ros::TIME_MAX;
  for (const moveit::core::JointModel* joint : activeJoints(group))
  {
    const auto heard = joint_time_.find(joint);
    if (heard == joint_time_.end() && !leave_out_the_unheard)
      return ros::Time();
    if (heard != joint_time_.end() && !heard->second.isZero())
      result = std::min(result, heard->second);
  }
  return joint_time_.empty() ? ros::Time() : result;
}

ros::Time CurrentStateMonitor::getCurrentStateTime(const std::string& group) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return oldest(group, false);
}

moveit::core::RobotStatePtr CurrentStateMonitor::getCurrentState() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::make_shared<moveit::core::RobotState>(robot_state_);
}

std::pair<moveit::core::RobotStatePtr, ros::Time> CurrentStateMonitor::getCurrentStateAndTime(const std::string& group) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return { std::make_shared<moveit::core::RobotState>(robot_state_), oldest(group, false) };
}

std::map<std::string, double> CurrentStateMonitor::getCurrentStateValues() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  std::map<std::string, double> values;
  for (const std::string& name : robot_state_.getVariableNames())
    values[name] = robot_state_.getVariablePosition(name);
  return values;
}

void CurrentStateMonitor::setToCurrentState(moveit::core::RobotState& upd) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  upd.setVariablePositions(robot_state_.getVariablePositions());
  if (!copy_dynamics_)
    return;
  if (robot_state_.hasVelocities())
    upd.setVariableVelocities(robot_state_.getVariableVelocities());
  if (robot_state_.hasAccelerations())
    upd.setVariableAccelerations(robot_state_.getVariableAccelerations());
  if (robot_state_.hasEffort())
    upd.setVariableEffort(robot_state_.getVariableEffort());
}

bool CurrentStateMonitor::waitForCurrentState(const ros::Time t, double wait_time) const
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait_time);
  std::unique_lock<std::mutex> lock(mutex_);
  const auto current = [&] { return oldest("", told_of_unheard_) >= t && !joint_time_.empty(); };
  if (changed_.wait_until(lock, end, current))
    return true;
  if (oldest("", true) >= t && !joint_time_.empty())
  {
    std::vector<std::string> unheard;
    for (const moveit::core::JointModel* joint : activeJoints(""))
      if (joint_time_.count(joint) == 0)
        unheard.push_back(joint->getName());
    ROS_WARN_STREAM_NAMED(log_names::CURRENT_STATE_MONITOR, "Nobody publishes the joints "
                                                                << listed(unheard) << " on '" << getMonitoredTopic()
                                                                << "': they are taken to be at their default values");
    told_of_unheard_ = true;
    return true;
  }
  ROS_INFO_STREAM_NAMED(log_names::CURRENT_STATE_MONITOR,
                        "Didn't receive robot state (joint angles) with recent timestamp within "
                            << wait_time << " seconds. Check clock synchronization if your are running ROS "
                            << "across multiple machines! " << whatIsWrong(t));
  return false;
}

std::string CurrentStateMonitor::whatIsWrong(const ros::Time& t) const
{
  const std::string topic = getMonitoredTopic();
  if (!started_ || topic.empty())
    return "The monitor does not listen: startStateMonitor() was not called.";
  if (joint_state_subscriber_.getNumPublishers() == 0)
    return "Nobody publishes '" + topic + "': start joint_state_publisher, or the robot's joint_state_controller.";
  if (joint_time_.empty())
    return "'" + topic + "' has publishers, but none of this robot's joints has come from them.";
  for (const auto& [joint, stamp] : joint_time_)
    if (!stamp.isZero() && stamp < t)
    {
      std::ostringstream text;
      text << "The newest state of joint '" << joint->getName() << "' is " << (t - stamp).toSec() << " s older than asked for";
      if (std::abs((t - stamp).toSec()) > 1e6)
        text << ": this node and who publishes '" << topic << "' differ in use_sim_time";
      return text.str() + ".";
    }
  return "";
}

bool CurrentStateMonitor::waitForCompleteState(double wait_time) const { return waitForCompleteState("", wait_time); }

bool CurrentStateMonitor::waitForCompleteState(const std::string& group, double wait_time) const
{
  {
    const Joints& joints = activeJoints(group);
    std::unique_lock<std::mutex> lock(mutex_);
    const bool complete = changed_.wait_for(lock, std::chrono::duration<double>(wait_time), [&] {
      return std::all_of(joints.begin(), joints.end(), [&](auto* joint) { return joint_time_.count(joint) != 0; });
    });
    if (complete)
      return true;
  }
  std::vector<std::string> missing;
  if (haveCompleteState(missing, group))
    return true;
  if (!group.empty())
    ROS_ERROR_STREAM_NAMED(log_names::CURRENT_STATE_MONITOR, "\"" << group << "\" has missing joints: " << listed(missing));
  return false;
}

void CurrentStateMonitor::addUpdateCallback(const JointStateUpdateCallback& fn)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (fn)
    update_callbacks_.push_back(fn);
}

void CurrentStateMonitor::clearUpdateCallbacks()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  update_callbacks_.clear();
}

// Whether the stamp is that of a state to be taken. Where time jumped back, what is known is forgotten first.
bool CurrentStateMonitor::isNews(const moveit::core::JointModel& joint, const ros::Time& stamp)
{
  const auto heard = joint_time_.find(&joint);
  if (heard == joint_time_.end())
    return true;
  const state_stamps::Order order = state_stamps::order(heard->second, stamp, ros::Time::now());
  if (order == state_stamps::Order::JUMPED_BACK)
  {
    ROS_WARN_STREAM_NAMED(log_names::CURRENT_STATE_MONITOR,
                          "New joint state for joint '"
                              << joint.getName() << "' is not newer than the previous state. Assuming your rosbag looped.");
    // A static transform, which has no time, is not sent again.
    for (auto entry = joint_time_.begin(); entry != joint_time_.end();)
      entry = entry->second.isZero() ? std::next(entry) : joint_time_.erase(entry);
  }
  return order != state_stamps::Order::REPEATED;
}

// Whether the state is another one than before.
bool CurrentStateMonitor::takeJoint(const sensor_msgs::JointState& joint_state, const ros::Time& stamp, std::size_t i)
{
  if (!robot_model_->hasJointModel(joint_state.name[i]))
    return false;
  const moveit::core::JointModel* joint = robot_model_->getJointModel(joint_state.name[i]);
  if (joint->getVariableCount() != 1)
    return false;
  double position = joint_state.position[i];
  if (!std::isfinite(position))
  {
    ROS_ERROR_STREAM_THROTTLE_NAMED(
        5, log_names::CURRENT_STATE_MONITOR,
        "joint '" << joint->getName() << "' has the position " << position << " on " << getMonitoredTopic() << ": ignored");
    return false;
  }
  if (!isNews(*joint, stamp))
    return false;
  joint_time_[joint] = stamp;
  const moveit::core::VariableBounds& bounds = joint->getVariableBounds()[0];
  if (bounds.position_bounded_ && !isContinuous(*joint))
  {
    if (position < bounds.min_position_ && position >= bounds.min_position_ - error_)
      position = bounds.min_position_;
    else if (position > bounds.max_position_ && position <= bounds.max_position_ + error_)
      position = bounds.max_position_;
  }
  bool changed = robot_state_.getJointPositions(joint)[0] != position;
  if (changed)
    robot_state_.setJointPositions(joint, &position);
  if (copy_dynamics_ && joint_state.velocity.size() == joint_state.name.size())
  {
    changed = changed || !robot_state_.hasVelocities() || robot_state_.getJointVelocities(joint)[0] != joint_state.velocity[i];
    robot_state_.setJointVelocities(joint, &joint_state.velocity[i]);
  }
  if (copy_dynamics_ && joint_state.effort.size() == joint_state.name.size())
  {
    changed = changed || !robot_state_.hasEffort() || robot_state_.getJointEffort(joint)[0] != joint_state.effort[i];
    robot_state_.setJointEfforts(joint, &joint_state.effort[i]);
  }
  return changed;
}

void CurrentStateMonitor::take(const sensor_msgs::JointStateConstPtr& joint_state)
{
  if (joint_state->name.size() != joint_state->position.size())
  {
    ROS_ERROR_THROTTLE_NAMED(1, log_names::CURRENT_STATE_MONITOR,
                             "State monitor received invalid joint state (number of joint names does not "
                             "match number of positions)");
    return;
  }
  ros::Time stamp = joint_state->header.stamp;
  if (stamp.isZero())
  {
    ROS_WARN_ONCE_NAMED(log_names::CURRENT_STATE_MONITOR,
                        "joint states on %s carry no time; the time of their arrival is used instead",
                        getMonitoredTopic().c_str());
    stamp = ros::Time::now();
  }
  std::vector<JointStateUpdateCallback> callbacks;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    bool changed = false;
    for (std::size_t i = 0; i < joint_state->name.size(); ++i)
      changed = takeJoint(*joint_state, stamp, i) || changed;
    if (changed)
      callbacks = update_callbacks_;
  }
  for (const JointStateUpdateCallback& callback : callbacks)
    callback(joint_state);
  changed_.notify_all();
}

void CurrentStateMonitor::takeTransforms()
{
  std::vector<JointStateUpdateCallback> callbacks;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const moveit::core::JointModel* joint : robot_model_->getMultiDOFJointModels())
    {
      const moveit::core::LinkModel* child = joint->getChildLinkModel();
      geometry_msgs::TransformStamped transform;
      try
      {
        transform = tf_buffer_->lookupTransform(parentFrame(*robot_model_, *joint), child->getName(), ros::Time(0));
      }
      catch (const tf2::TransformException& error)
      {
        ROS_WARN_STREAM_ONCE_NAMED(
            log_names::CURRENT_STATE_MONITOR,
            "Unable to update multi-DOF joint '" << joint->getName() << "': TF does not tell where it is: " << error.what());
        continue;
      }
      const auto heard = joint_time_.find(joint);
      if (heard != joint_time_.end() && !transform.header.stamp.isZero() &&
          (transform.header.stamp == heard->second || !isNews(*joint, transform.header.stamp)))
        continue;
      joint_time_[joint] = transform.header.stamp;
      std::vector<double> values(joint->getVariableCount());
      joint->computeVariablePositions(child->getJointOriginTransform().inverse() * tf2::transformToEigen(transform),
                                      values.data());
      if (joint->distance(values.data(), robot_state_.getJointPositions(joint)) > CHANGE)
        callbacks = update_callbacks_;
      robot_state_.setJointPositions(joint, values.data());
    }
  }
  const auto nothing = boost::make_shared<sensor_msgs::JointState>();
  for (const JointStateUpdateCallback& callback : callbacks)
    callback(nothing);
  changed_.notify_all();
}

}  // namespace planning_scene_monitor
