// From a twist or joint velocities to the next joint command.
#include <moveit_servo/servo_calcs.h>

#include <tf2/exceptions.h>

#include "laws.hpp"
#include "say.hpp"

namespace moveit_servo
{
namespace
{
const char* const LOGNAME = "servo_calcs";
constexpr double ROS_LOG_THROTTLE_PERIOD = 30.0;  // s
// So many points of one trajectory: by simulated time the first may be past when it comes.
constexpr int GAZEBO_POINTS = 30;
// A joint's step, rad, that tells which way a singularity lies: as small as differences of condition numbers allow.
constexpr double LOOK_AHEAD = 1e-4;
}  // namespace

// ---------------------------------------------------------------- commands

bool ServoCalcs::cartesianServoCalcs(geometry_msgs::TwistStamped cmd, Trajectory& joint_trajectory)
{
  double* const parts[] = { &cmd.twist.linear.x,  &cmd.twist.linear.y,  &cmd.twist.linear.z,
                            &cmd.twist.angular.x, &cmd.twist.angular.y, &cmd.twist.angular.z };
  for (std::size_t i = 0; i < control_dimensions_.size(); ++i)
    if (!control_dimensions_[i])
      *parts[i] = 0.0;
  Eigen::Matrix3d rotation;
  if (!rotationToPlanningFrame(cmd.header.frame_id, rotation))
    return false;
  Eigen::VectorXd delta_x = scaleCartesianCommand(cmd);
  delta_x.head<3>() = rotation * delta_x.head<3>();
  delta_x.tail<3>() = rotation * delta_x.tail<3>();

  if (!joint_model_group_->isChain())
  {
    SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_ERROR_NAMED, LOGNAME,
              "Group '%s' is not a chain: it follows joint commands, not twists", parameters_.move_group_name.c_str());
    return false;
  }
  const Eigen::MatrixXd J = jacobian(*current_state_);
  Eigen::VectorXd held(J.rows());
  for (Eigen::Index row = 0; row < held.size(); ++row)
    held[row] = delta_x[heldDimensions()[row]];
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(laws::RANK);
  Eigen::ArrayXd delta_theta = svd.solve(held);
  enforceVelLimits(delta_theta);
  applyVelocityScaling(delta_theta, velocityScalingFactorForSingularity(held, svd));
  convertDeltasToOutgoingCmd(delta_theta, joint_trajectory);
  return true;
}

bool ServoCalcs::jointServoCalcs(const control_msgs::JointJog& cmd, Trajectory& joint_trajectory)
{
  Eigen::ArrayXd delta_theta = scaleJointCommand(cmd);
  enforceVelLimits(delta_theta);
  applyVelocityScaling(delta_theta, 1.0);
  convertDeltasToOutgoingCmd(delta_theta, joint_trajectory);
  return true;
}

bool ServoCalcs::rotationToPlanningFrame(const std::string& frame, Eigen::Matrix3d& rotation) const
{
  const std::string name = !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
  if (name.empty() || name == parameters_.robot_link_command_frame)
    rotation = command_frame_.linear();
  else if (name == parameters_.ee_frame_name)
    rotation = ee_frame_.linear();
  else if (name == parameters_.planning_frame)
    rotation.setIdentity();
  else if (name == current_state_->getRobotModel()->getModelFrame() || current_state_->knowsFrameTransform(name))
    rotation = poseInPlanningFrame(name).linear();
  else
  {
    std::string why = "there is no TF here";
    try
    {
      if (const auto& transforms = planning_scene_monitor_->getTFClient())
      {
        rotation = tf2::transformToEigen(transforms->lookupTransform(parameters_.planning_frame, name, ros::Time(0))).linear();
        return true;
      }
    }
    catch (const tf2::TransformException& error)
    {
      why = error.what();
    }
    SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_WARN_NAMED, LOGNAME,
              "A twist in frame '%s' is skipped: the robot has no such link, and %s", name.c_str(), why.c_str());
    return false;
  }
  return true;
}

Eigen::VectorXd ServoCalcs::scaleCartesianCommand(const geometry_msgs::TwistStamped& command) const
{
  const bool unitless = parameters_.command_in_type == "unitless";
  const auto& v = command.twist.linear;
  const auto& w = command.twist.angular;
  Eigen::VectorXd delta(6);
  delta << v.x, v.y, v.z, w.x, w.y, w.z;
  delta.head<3>() *= (unitless ? parameters_.linear_scale : 1.0) * parameters_.publish_period;
  delta.tail<3>() *= (unitless ? parameters_.rotational_scale : 1.0) * parameters_.publish_period;
  return delta;
}

Eigen::VectorXd ServoCalcs::scaleJointCommand(const control_msgs::JointJog& command) const
{
  const double scale = (parameters_.command_in_type == "unitless" ? parameters_.joint_scale : 1.0) * parameters_.publish_period;
  Eigen::VectorXd delta = Eigen::VectorXd::Zero(joints_.size());
  for (std::size_t i = 0; i < command.joint_names.size(); ++i)
  {
    const auto found = std::find(joint_names_.begin(), joint_names_.end(), command.joint_names[i]);
    if (found == joint_names_.end())
      SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_WARN_NAMED, LOGNAME, "Ignoring joint '%s': group '%s' has none of that name",
                command.joint_names[i].c_str(), parameters_.move_group_name.c_str());
    else
      delta[found - joint_names_.begin()] = command.velocities[i] * scale;
  }
  return delta;
}

// ---------------------------------------------------------------- the arm

Eigen::MatrixXd ServoCalcs::jacobian(const moveit::core::RobotState& state) const
{
  // RobotState's is in the frame of the link that carries the group.
  const auto* base = joint_model_group_->getJointModels()[0]->getParentLinkModel();
  const Eigen::Matrix3d rotation =
      poseInPlanningFrame(base ? base->getName() : state.getRobotModel()->getModelFrame()).linear();
  const Eigen::MatrixXd all = state.getJacobian(joint_model_group_);
  Eigen::MatrixXd in_planning_frame(6, joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i)
  {
    const Eigen::VectorXd column = all.col(joint_model_group_->getVariableGroupIndex(joint_names_[i]));
    in_planning_frame.col(i) << rotation * column.head<3>(), rotation * column.tail<3>();
  }
  const std::vector<int> held = heldDimensions();
  Eigen::MatrixXd rows(held.size(), joints_.size());
  for (std::size_t i = 0; i < held.size(); ++i)
    rows.row(i) = in_planning_frame.row(held[i]);
  return rows;
}

std::vector<int> ServoCalcs::heldDimensions() const
{
  std::vector<int> held;
  for (int i = 0; i < 6; ++i)
    if (!drift_dimensions_[i])
      held.push_back(i);
  return held.empty() ? std::vector<int>{ 0 } : held;
}

double ServoCalcs::velocityScalingFactorForSingularity(const Eigen::VectorXd& delta_x,
                                                       const Eigen::JacobiSVD<Eigen::MatrixXd>& svd)
{
  const double condition = laws::condition(svd);
  const double scale =
      laws::singularityScale(condition, parameters_.lower_singularity_threshold, parameters_.hard_stop_singularity_threshold);
  if (scale == 1.0)
    return 1.0;
  // The direction in which the tip moves worst leads towards the singularity or, with the other sign, away from it: a small step
  // tells which.
  const Eigen::VectorXd worst = svd.matrixU().col(svd.matrixU().cols() - 1);
  double towards = worst.dot(delta_x);
  if (condition < laws::ON_THE_SINGULARITY)
  {
    const Eigen::VectorXd step = svd.solve(worst).normalized() * LOOK_AHEAD;
    moveit::core::RobotState ahead(*current_state_);
    for (std::size_t i = 0; i < joints_.size(); ++i)
      ahead.setVariablePosition(joint_names_[i], measured_[i] + step[i]);
    ahead.update();
    if (laws::condition(Eigen::JacobiSVD<Eigen::MatrixXd>(jacobian(ahead))) < condition)
      towards = -towards;
  }
  else
    towards = std::abs(towards);
  if (towards <= 1e-6 * delta_x.norm())
    return 1.0;
  setStatus(scale > 0.0 ? StatusCode::DECELERATE_FOR_SINGULARITY : StatusCode::HALT_FOR_SINGULARITY);
  SAY_EVERY(
      ROS_LOG_THROTTLE_PERIOD, ROS_WARN_NAMED, LOGNAME, "%s (condition number %.1f)",
      SERVO_STATUS_CODE_MAP.at(scale > 0.0 ? StatusCode::DECELERATE_FOR_SINGULARITY : StatusCode::HALT_FOR_SINGULARITY).c_str(),
      condition);
  return scale;
}

void ServoCalcs::enforceVelLimits(Eigen::ArrayXd& delta_theta)
{
  const double none = std::numeric_limits<double>::max();
  Eigen::ArrayXd lower = Eigen::ArrayXd::Constant(joints_.size(), -none),
                 upper = Eigen::ArrayXd::Constant(joints_.size(), none);
  for (std::size_t i = 0; i < joints_.size(); ++i)
  {
    const auto& bounds = joints_[i]->getVariableBounds()[0];
    if (!bounds.velocity_bounded_)
      continue;
    lower[i] = bounds.min_velocity_;
    upper[i] = bounds.max_velocity_;
  }
  delta_theta *= laws::velocityLimitScale(delta_theta / parameters_.publish_period, lower, upper);
}

void ServoCalcs::applyVelocityScaling(Eigen::ArrayXd& delta_theta, double singularity_scale)
{
  const double collision_scale = collision_velocity_scale_;
  if (collision_scale <= 0.0)
    setStatus(StatusCode::HALT_FOR_COLLISION);
  else if (collision_scale < 1.0)
  {
    setStatus(StatusCode::DECELERATE_FOR_COLLISION);
    SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_WARN_NAMED, LOGNAME, "%s",
              SERVO_STATUS_CODE_MAP.at(StatusCode::DECELERATE_FOR_COLLISION).c_str());
  }
  delta_theta *= collision_scale * singularity_scale;
  // It lasts until something is near, but does not touch, or the status is reset.
  if (status_ == StatusCode::HALT_FOR_COLLISION)
  {
    SAY_EVERY(3, ROS_WARN_NAMED, LOGNAME, "Halting for collision! When the way is free: rosservice call %s",
              reset_servo_status_.getService().c_str());
    delta_theta.setZero();
  }
}

bool ServoCalcs::meetsPositionLimit(const Eigen::ArrayXd& delta_theta) const
{
  bool meets = false;
  for (std::size_t i = 0; i < joints_.size(); ++i)
  {
    const auto& bounds = joints_[i]->getVariableBounds()[0];
    const double margin = parameters_.joint_limit_margin;
    if (!bounds.position_bounded_ || !((delta_theta[i] < 0.0 && measured_[i] < bounds.min_position_ + margin) ||
                                       (delta_theta[i] > 0.0 && measured_[i] > bounds.max_position_ - margin)))
      continue;
    SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_WARN_NAMED, LOGNAME, "%s close to a position limit. Halting.",
              joint_names_[i].c_str());
    meets = true;
  }
  return meets;
}

void ServoCalcs::setStatus(StatusCode status)
{
  // What touches something does not move for the sake of a lesser warning.
  const bool about_collisions = status == StatusCode::HALT_FOR_COLLISION || status == StatusCode::DECELERATE_FOR_COLLISION;
  if (about_collisions || status_ != StatusCode::HALT_FOR_COLLISION)
    status_ = status;
}

// ---------------------------------------------------------------- messages

void ServoCalcs::convertDeltasToOutgoingCmd(const Eigen::ArrayXd& delta_theta, Trajectory& joint_trajectory)
{
  if (meetsPositionLimit(delta_theta))
  {
    suddenHalt(joint_trajectory);
    resetPositions();
    setStatus(StatusCode::JOINT_BOUND);
  }
  else
  {
    commanded_ = laws::nextPositions(commanded_, measured_, delta_theta, parameters_.publish_period);
    trajectory_msgs::JointTrajectoryPoint point;
    point.time_from_start = ros::Duration(parameters_.publish_period);
    for (std::size_t i = 0; i < joints_.size(); ++i)
    {
      const auto& bounds = joints_[i]->getVariableBounds()[0];
      if (bounds.position_bounded_)
        commanded_[i] = std::min(std::max(commanded_[i], bounds.min_position_), bounds.max_position_);
      const double smooth = position_filters_[i].filter(commanded_[i]);
      if (parameters_.publish_joint_positions)
        point.positions.push_back(smooth);
      if (parameters_.publish_joint_velocities)
        point.velocities.push_back(delta_theta[i] / parameters_.publish_period);
      if (parameters_.publish_joint_accelerations)  // some controllers want to see them
        point.accelerations.push_back(0.0);
    }
    joint_trajectory.points.assign(1, point);
    in_motion_ = true;
  }
  if (!parameters_.use_gazebo)
    return;
  joint_trajectory.points.resize(GAZEBO_POINTS, joint_trajectory.points[0]);
  for (int i = 1; i < GAZEBO_POINTS; ++i)
    joint_trajectory.points[i].time_from_start = ros::Duration((i + 1) * parameters_.publish_period);
}

void ServoCalcs::suddenHalt(Trajectory& joint_trajectory) const
{
  trajectory_msgs::JointTrajectoryPoint point;
  point.time_from_start.fromNSec(1);  // at once, yet not in the past
  if (parameters_.publish_joint_positions)
    point.positions.assign(measured_.data(), measured_.data() + measured_.size());
  if (parameters_.publish_joint_velocities)
    point.velocities.assign(joints_.size(), 0.0);
  if (parameters_.publish_joint_accelerations)
    point.accelerations.assign(joints_.size(), 0.0);
  joint_trajectory.points.assign(1, point);
}

void ServoCalcs::resetPositions()
{
  in_motion_ = false;
  commanded_ = measured_;
  for (std::size_t i = 0; i < joints_.size(); ++i)
    position_filters_[i].reset(measured_[i]);
}

ServoCalcs::Trajectory ServoCalcs::emptyTrajectory() const
{
  Trajectory trajectory;  // its stamp of zero means at once
  trajectory.header.frame_id = parameters_.planning_frame;
  trajectory.joint_names = joint_names_;
  return trajectory;
}
}  // namespace moveit_servo
