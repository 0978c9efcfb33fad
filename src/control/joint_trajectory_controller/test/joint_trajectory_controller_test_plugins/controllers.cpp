// Trajectory controllers in C++: one for each interface, and two that are derived from, as packages of others do it.
#include <joint_trajectory_controller/joint_trajectory_controller.h>
#include <pluginlib/class_list_macros.hpp>
#include <trajectory_interface/quintic_spline_segment.h>

namespace compiled
{

typedef trajectory_interface::QuinticSplineSegment<double> Spline;
template <class HardwareInterface>
using Controller = joint_trajectory_controller::JointTrajectoryController<Spline, HardwareInterface>;

typedef Controller<hardware_interface::PositionJointInterface> PositionTrajectory;
typedef Controller<hardware_interface::VelocityJointInterface> VelocityTrajectory;
typedef Controller<hardware_interface::EffortJointInterface> EffortTrajectory;
typedef Controller<hardware_interface::PosVelJointInterface> PosVelTrajectory;
typedef Controller<hardware_interface::PosVelAccJointInterface> PosVelAccTrajectory;

/// Follows trajectories at half their speed, by an update() of its own that leaves results to the timer.
class ScaledTrajectory : public PositionTrajectory
{
public:
  void update(const ros::Time& time, const ros::Duration& period) override
  {
    TrajectoryPtr trajectory;
    this->curr_trajectory_box_.get(trajectory);
    TimeData now;
    now.time = time;
    now.period = ros::Duration(0.5 * period.toSec());
    now.uptime = this->time_data_.readFromRT()->uptime + now.period;
    this->time_data_.writeFromNonRT(now);
    this->updateStates(now.uptime, trajectory.get());
    for (unsigned int i = 0; i < this->getNumberOfJoints(); ++i)
    {
      TrajectoryPerJoint::const_iterator segment = sample((*trajectory)[i], now.uptime.toSec(), this->desired_joint_state_);
      const RealtimeGoalHandlePtr goal = segment->getGoalHandle();
      if (!goal || goal != this->rt_active_goal_ || now.uptime.toSec() < segment->endTime() ||
          segment != --(*trajectory)[i].end())
        continue;
      this->state_joint_error_.position[0] = this->state_error_.position[i];
      const joint_trajectory_controller::SegmentTolerancesPerJoint<Scalar>& limits = segment->getTolerances();
      if (checkStateTolerancePerJoint(this->state_joint_error_, limits.goal_state_tolerance))
        this->successful_joint_traj_[i] = 1;
    }
    RealtimeGoalHandlePtr goal(this->rt_active_goal_);
    if (goal && this->successful_joint_traj_.count() == this->joints_.size())
    {
      goal->preallocated_result_->error_code = control_msgs::FollowJointTrajectoryResult::SUCCESSFUL;
      goal->setSucceeded(goal->preallocated_result_);
      this->rt_active_goal_.reset();
      this->successful_joint_traj_.reset();
    }
    this->hw_iface_adapter_.updateCommand(now.uptime, now.period, this->desired_state_, this->state_error_);
    this->publishState(now.uptime);
  }
};

/// Stops where a joint is to be faster than 50 rad/s, and takes no commands from the topic.
class GuardedTrajectory : public PositionTrajectory
{
  bool init(hardware_interface::PositionJointInterface* hw, ros::NodeHandle& root_nh, ros::NodeHandle& controller_nh) override
  {
    return PositionTrajectory::init(hw, root_nh, controller_nh) && !this->joint_names_.empty();
  }

  void trajectoryCommandCB(const JointTrajectoryConstPtr& /*msg*/) override {}

  void updateFuncExtensionPoint(const Trajectory& /*curr_traj*/, const TimeData& time_data) override
  {
    for (unsigned int i = 0; i < this->getNumberOfJoints(); ++i)
      if (std::abs(this->desired_state_.velocity[i]) > 50.0)
      {
        this->preemptActiveGoal();
        this->setHoldPosition(time_data.uptime);
        TrajectoryPtr trajectory;
        this->curr_trajectory_box_.get(trajectory);
        this->updateStates(time_data.uptime, trajectory.get());
      }
  }
};

}  // namespace compiled

PLUGINLIB_EXPORT_CLASS(compiled::PositionTrajectory, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(compiled::VelocityTrajectory, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(compiled::EffortTrajectory, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(compiled::PosVelTrajectory, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(compiled::PosVelAccTrajectory, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(compiled::ScaledTrajectory, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(compiled::GuardedTrajectory, controller_interface::ControllerBase)
