// The joint trajectory controller, to be instantiated for hardware interfaces of others and to be derived from. The controllers of
// this package's controllers.xml are Python's; both follow trajectories in the same way.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <actionlib/server/action_server.h>
#include <boost/dynamic_bitset.hpp>
#include <boost/shared_ptr.hpp>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <control_msgs/JointTrajectoryControllerState.h>
#include <control_msgs/QueryTrajectoryState.h>
#include <controller_interface/controller.h>
#include <hardware_interface/internal/demangle_symbol.h>
#include <hardware_interface/joint_command_interface.h>
#include <joint_trajectory_controller/hardware_interface_adapter.h>
#include <joint_trajectory_controller/hold_trajectory_builder.h>
#include <joint_trajectory_controller/init_joint_trajectory.h>
#include <joint_trajectory_controller/joint_trajectory_segment.h>
#include <joint_trajectory_controller/stop_trajectory_builder.h>
#include <realtime_tools/realtime_box.h>
#include <realtime_tools/realtime_buffer.h>
#include <realtime_tools/realtime_publisher.h>
#include <realtime_tools/realtime_server_goal_handle.h>
#include <ros/node_handle.h>
#include <trajectory_interface/trajectory_interface.h>
#include <trajectory_msgs/JointTrajectory.h>
#include <urdf/model.h>

namespace joint_trajectory_controller
{

/// Follows trajectories on the joints of parameter joints, by the topic command and the action follow_joint_trajectory.
///
/// \tparam SegmentImpl such as trajectory_interface::QuinticSplineSegment<double>
/// \tparam HardwareInterface has a HardwareInterfaceAdapter
///
/// Commands come in threads of roscpp, one after the other. A long trajectory is joined while update() goes on: what both change is
/// held for a few pointers, and for no message that is sent or received. The control loop calls starting, stopping, update,
/// updateStates, publishState, preemptActiveGoal and setHoldPosition; a derived class that writes an update() of its own does without the
/// lock: then a trajectory may change between two of its statements, but never a trajectory that it has already taken.
template <class SegmentImpl, class HardwareInterface>
class JointTrajectoryController : public controller_interface::Controller<HardwareInterface>
{
public:
  JointTrajectoryController() = default;
  ~JointTrajectoryController() override;

  using controller_interface::Controller<HardwareInterface>::init;
  bool init(HardwareInterface* hw, ros::NodeHandle& root_nh, ros::NodeHandle& controller_nh) override;
  void starting(const ros::Time& time) override;
  void stopping(const ros::Time& time) override;
  void update(const ros::Time& time, const ros::Duration& period) override;

private:
  // Recursive, as what derived classes call locks as well; first, to be destroyed last. Who takes both takes commands_lock_ first.
  std::recursive_mutex commands_lock_;  // of the threads that bring commands; update() never takes it
  std::recursive_mutex lock_;           // of what update() and commands change

protected:
  struct TimeData
  {
    ros::Time time;        // of the last update
    ros::Duration period;  // before it
    ros::Time uptime;      // since the controller was started
  };

  typedef actionlib::ActionServer<control_msgs::FollowJointTrajectoryAction> ActionServer;
  typedef std::shared_ptr<ActionServer> ActionServerPtr;
  typedef ActionServer::GoalHandle GoalHandle;
  typedef realtime_tools::RealtimeServerGoalHandle<control_msgs::FollowJointTrajectoryAction> RealtimeGoalHandle;
  typedef boost::shared_ptr<RealtimeGoalHandle> RealtimeGoalHandlePtr;
  typedef trajectory_msgs::JointTrajectory::ConstPtr JointTrajectoryConstPtr;
  typedef realtime_tools::RealtimePublisher<control_msgs::JointTrajectoryControllerState> StatePublisher;
  typedef std::unique_ptr<StatePublisher> StatePublisherPtr;

  typedef JointTrajectorySegment<SegmentImpl> Segment;
  typedef std::vector<Segment> TrajectoryPerJoint;
  typedef std::vector<TrajectoryPerJoint> Trajectory;
  typedef std::shared_ptr<Trajectory> TrajectoryPtr;
  typedef std::shared_ptr<TrajectoryPerJoint> TrajectoryPerJointPtr;
  typedef realtime_tools::RealtimeBox<TrajectoryPtr> TrajectoryBox;
  typedef typename Segment::Scalar Scalar;

  typedef HardwareInterfaceAdapter<HardwareInterface, typename Segment::State> HwIfaceAdapter;
  typedef typename HardwareInterface::ResourceHandleType JointHandle;

  bool verbose_ = false;  // derived classes ask it before they log
  std::string name_;
  std::vector<JointHandle> joints_;
  std::vector<bool> angle_wraparound_;  // joints that turn without end
  std::vector<std::string> joint_names_;
  SegmentTolerances<Scalar> default_tolerances_;
  HwIfaceAdapter hw_iface_adapter_;

  RealtimeGoalHandlePtr rt_active_goal_;

  TrajectoryBox curr_trajectory_box_;
  TrajectoryPtr hold_trajectory_ptr_;

  // Made once, as the control loop must not allocate. The joint states are of one joint, the others of all.
  typename Segment::State current_state_, desired_state_, old_desired_state_, state_error_;
  typename Segment::State desired_joint_state_, state_joint_error_;

  std::unique_ptr<TrajectoryBuilder<SegmentImpl>> hold_traj_builder_;

  realtime_tools::RealtimeBuffer<TimeData> time_data_;
  TimeData old_time_data_;

  ros::Duration state_publisher_period_;
  ros::Duration action_monitor_period_;

  typename Segment::Time stop_trajectory_duration_ = 0;
  boost::dynamic_bitset<> successful_joint_traj_;  // joints that have reached the goal
  bool allow_partial_joints_goal_ = false;

  ros::NodeHandle controller_nh_;
  ros::Subscriber trajectory_command_sub_;
  ActionServerPtr action_server_;
  ros::ServiceServer query_state_service_;
  StatePublisherPtr state_publisher_;

  ros::Timer goal_handle_timer_;
  ros::Time last_state_publish_time_;

  /// Join a message to the running motion; one without points stops it. \return false: the motion is as it was, error_string says why
  virtual bool updateTrajectoryCommand(const JointTrajectoryConstPtr& msg, RealtimeGoalHandlePtr gh,
                                       std::string* error_string = nullptr);
  virtual void trajectoryCommandCB(const JointTrajectoryConstPtr& msg);
  virtual void goalCB(GoalHandle gh);
  virtual void cancelCB(GoalHandle gh);
  virtual void preemptActiveGoal();
  virtual bool queryStateService(control_msgs::QueryTrajectoryState::Request& req,
                                 control_msgs::QueryTrajectoryState::Response& resp);

  /// On the topic state, when that is due. \param time since the controller was started
  void publishState(const ros::Time& time);

  /// Come to rest, as stop_trajectory_duration says. \param time since the controller was started
  void setHoldPosition(const ros::Time& time, RealtimeGoalHandlePtr gh = RealtimeGoalHandlePtr());

  unsigned int getNumberOfJoints() const { return joints_.size(); }

  /// Where the joints are, where they should be, and the difference. \param sample_time since the controller was started
  void updateStates(const ros::Time& sample_time, const Trajectory* const traj);

  /// One segment at 0 for each joint, to be filled in by a TrajectoryBuilder.
  static TrajectoryPtr createHoldTrajectory(const unsigned int& number_of_joints);

private:
  /// For derived classes: in every update, before commands are written.
  virtual void updateFuncExtensionPoint(const Trajectory& /*curr_traj*/, const TimeData& /*time_data*/) {}

  /// What a new trajectory is joined to.
  struct Moment
  {
    TrajectoryPtr running;
    TimeData last;
  };

  bool readParameters();
  bool readJoints(HardwareInterface* hw, const ros::NodeHandle& root_nh);
  void advertise();
  bool rest(const ros::Time& uptime);
  bool supervise(const Trajectory& trajectory, double uptime);
  void abort(int code, const std::string& why);
  void setActionFeedback();
  void monitorGoal(const ros::TimerEvent& event);
  std::string look(bool is_goal, Moment* now);
  TrajectoryPtr join(const trajectory_msgs::JointTrajectory& msg, Moment& now, const RealtimeGoalHandlePtr& gh,
                     std::string* error_string);
  bool replace(const TrajectoryPtr& running, const TrajectoryPtr& joined);
  bool follow(const RealtimeGoalHandlePtr& goal, unsigned int stops);
  void judgeAgain();

  std::vector<bool> angular_;  // their errors are the short way round; those of prismatic joints are plain differences
  RealtimeGoalHandlePtr monitored_goal_;
  std::mutex feedback_lock_;    // of the active goal's feedback: update() does without where it is being sent
  bool known_ = false;          // whether the hardware has said where all joints are
  bool commanding_ = false;     // a command of this class is at work, of commands_lock_
  bool between_goals_ = false;  // its trajectory is followed already and its goal not yet: nothing is judged
  unsigned int stops_ = 0;      // how often the controller was stopped
};

}  // namespace joint_trajectory_controller

#include <joint_trajectory_controller/joint_trajectory_controller_impl.h>
