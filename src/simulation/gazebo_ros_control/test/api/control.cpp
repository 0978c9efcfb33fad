// Not run: controllers, their manager and their tools, each member named once as the sources of others name it.
#include <angles/angles.h>
#include <boost/scoped_ptr.hpp>
#include <boost/shared_ptr.hpp>
#include <class_loader/class_loader.h>
#include <combined_robot_hw/combined_robot_hw.h>
#include <control_toolbox/ParametersConfig.h>
#include <control_toolbox/filters.h>
#include <control_toolbox/pid.h>
#include <controller_interface/controller.h>
#include <controller_interface/controller_base.h>
#include <controller_interface/multi_interface_controller.h>
#include <controller_manager/controller_loader.h>
#include <controller_manager/controller_loader_interface.h>
#include <controller_manager/controller_manager.h>
#include <controller_manager/controller_spec.h>
#include <dynamic_reconfigure/server.h>
#include <effort_controllers/joint_effort_controller.h>
#include <effort_controllers/joint_group_effort_controller.h>
#include <effort_controllers/joint_position_controller.h>
#include <effort_controllers/joint_velocity_controller.h>
#include <forward_command_controller/forward_command_controller.h>
#include <forward_command_controller/forward_joint_group_command_controller.h>
#include <hardware_interface/force_torque_sensor_interface.h>
#include <hardware_interface/joint_command_interface.h>
#include <pluginlib/class_list_macros.h>
#include <pluginlib/class_list_macros.hpp>
#include <pluginlib/class_loader.h>
#include <position_controllers/joint_group_position_controller.h>
#include <position_controllers/joint_position_controller.h>
#include <realtime_tools/realtime_box.h>
#include <realtime_tools/realtime_buffer.h>
#include <realtime_tools/realtime_clock.h>
#include <realtime_tools/realtime_publisher.h>
#include <realtime_tools/realtime_server_goal_handle.h>
#include <std_msgs/Float64.h>
#include <trajectory_interface/pos_vel_acc_state.h>
#include <trajectory_interface/quintic_spline_segment.h>
#include <trajectory_interface/trajectory_interface.h>
#include <transmission_interface/differential_transmission.h>
#include <transmission_interface/four_bar_linkage_transmission.h>
#include <transmission_interface/robot_transmissions.h>
#include <transmission_interface/simple_transmission.h>
#include <transmission_interface/transmission.h>
#include <transmission_interface/transmission_info.h>
#include <transmission_interface/transmission_interface.h>
#include <transmission_interface/transmission_interface_exception.h>
#include <transmission_interface/transmission_interface_loader.h>
#include <transmission_interface/transmission_loader.h>
#include <transmission_interface/transmission_parser.h>
#include <urdf_geometry_parser/urdf_geometry_parser.h>
#include <velocity_controllers/joint_group_velocity_controller.h>
#include <velocity_controllers/joint_velocity_controller.h>

#include <control_msgs/FollowJointTrajectoryAction.h>

namespace hi = hardware_interface;

// -- controllers ---------------------------------------------------------------------------------------------------------------------

class One : public controller_interface::Controller<hi::EffortJointInterface>
{
public:
  bool init(hi::EffortJointInterface* hw, ros::NodeHandle& nh) override
  {
    joint_ = hw->getHandle(nh.param("joint", std::string()));
    return !getHardwareInterfaceType().empty();
  }
  bool init(hi::EffortJointInterface*, ros::NodeHandle&, ros::NodeHandle&) override { return true; }
  void starting(const ros::Time&) override {}
  void update(const ros::Time&, const ros::Duration&) override { joint_.setCommand(0.0); }
  void stopping(const ros::Time&) override {}
  void waiting(const ros::Time&) override {}
  void aborting(const ros::Time&) override {}

private:
  hi::JointHandle joint_;
};
PLUGINLIB_EXPORT_CLASS(One, controller_interface::ControllerBase)

typedef controller_interface::MultiInterfaceController<hi::EffortJointInterface, hi::JointStateInterface,
                                                       hi::ForceTorqueSensorInterface>
    Three;
class Many : public Three
{
public:
  Many() : Three(true) {}
  bool init(hi::RobotHW* hw, ros::NodeHandle&) override
  {
    return hw->get<hi::EffortJointInterface>() && !robot_hw_ctrl_.getNames().empty();
  }
  bool init(hi::RobotHW*, ros::NodeHandle&, ros::NodeHandle&) override { return allow_optional_interfaces_; }
  void update(const ros::Time&, const ros::Duration&) override {}
  void statics(hi::RobotHW* hw)
  {
    ClaimedResources resources;
    hasRequiredInterfaces(hw);
    clearClaims(hw);
    extractInterfaceResources(hw, &robot_hw_ctrl_);
    populateClaimedResources(hw, resources);
  }
};
PLUGINLIB_EXPORT_CLASS(Many, controller_interface::ControllerBase)

void controllers(hi::RobotHW* robot, ros::NodeHandle nh)
{
  std::shared_ptr<controller_interface::ControllerBase> shared = std::make_shared<One>();
  controller_interface::ControllerBaseSharedPtr same = shared;
  controller_interface::ControllerBase::ClaimedResources claimed;
  One one;
  same->initRequest(robot, nh, nh, claimed);
  const ros::Time now = ros::Time::now();
  bool yes = one.startRequest(now) && one.stopRequest(now) && one.waitRequest(now) && one.abortRequest(now);
  one.updateRequest(now, ros::Duration(0.001));
  yes = yes && one.isInitialized() && one.isRunning() && one.isStopped() && one.isWaiting() && one.isAborted();
  if (yes || one.state_ == controller_interface::ControllerBase::ControllerState::CONSTRUCTED)
    one.state_ = controller_interface::ControllerBase::ControllerState::WAITING;
  position_controllers::JointPositionController position;
  position_controllers::JointGroupPositionController positions;
  velocity_controllers::JointVelocityController velocity;
  velocity_controllers::JointGroupVelocityController velocities;
  effort_controllers::JointEffortController effort;
  effort_controllers::JointGroupEffortController efforts;
  effort_controllers::JointPositionController inside;
  effort_controllers::JointVelocityController turning;
  inside.setCommand(1.0, 2.0);
  turning.setCommand(1.0);
}

// -- the manager ---------------------------------------------------------------------------------------------------------------------

class MyManager : public controller_manager::ControllerManager
{
public:
  MyManager(hi::RobotHW* robot, const ros::NodeHandle& nh) : controller_manager::ControllerManager(robot, nh) {}
  controller_interface::ControllerBase* getControllerByName(const std::string& name) override
  {
    return controller_manager::ControllerManager::getControllerByName(name);
  }
};

void manager()
{
  combined_robot_hw::CombinedRobotHW robot;
  ros::NodeHandle nh;
  controller_manager::ControllerManager simple(&robot);
  MyManager manager(&robot, nh);
  manager.registerControllerLoader(controller_manager::ControllerLoaderInterfaceSharedPtr(
      new controller_manager::ControllerLoader<controller_interface::ControllerBase>("controller_interface",
                                                                                     "controller_interface::ControllerBase")));
  manager.loadController("one");
  manager.switchController({ "one" }, { "two" }, 2);
  manager.switchController({ "one" }, {}, 1, true, 1.0);
  manager.unloadController("one");
  manager.update(ros::Time::now(), ros::Duration(0.001));
  manager.update(ros::Time::now(), ros::Duration(0.001), true);
}

// -- tools ---------------------------------------------------------------------------------------------------------------------------

typedef actionlib::ActionServer<control_msgs::FollowJointTrajectoryAction> Server;

void realtime(ros::NodeHandle nh, Server::GoalHandle goal)
{
  realtime_tools::RealtimePublisher<std_msgs::Float64> publisher(nh, "topic", 1, true), later;
  later.init(nh, "topic", 1);
  realtime_tools::RealtimePublisherSharedPtr<std_msgs::Float64> shared;
  boost::shared_ptr<realtime_tools::RealtimePublisher<std_msgs::Float64> > boosted;
  boost::scoped_ptr<realtime_tools::RealtimePublisher<std_msgs::Float64> > scoped(
      new realtime_tools::RealtimePublisher<std_msgs::Float64>(nh, "topic", 1));
  std::unique_ptr<realtime_tools::RealtimePublisher<std_msgs::Float64> > unique;
  if (publisher.trylock())
  {
    publisher.msg_.data = 1.0;
    publisher.unlockAndPublish();
  }
  publisher.lock();
  publisher.unlock();
  publisher.stop();

  realtime_tools::RealtimeBuffer<double> buffer, started(1.0), copied(started);
  buffer = copied;
  buffer.initRT(1.0);
  buffer.writeFromNonRT(*buffer.readFromRT() + *buffer.readFromNonRT());
  realtime_tools::RealtimeBox<double> box(1.0);
  double value;
  box.set(2.0);
  box.get(value);
  realtime_tools::RealtimeClock clock;

  typedef realtime_tools::RealtimeServerGoalHandle<control_msgs::FollowJointTrajectoryAction> Goal;
  boost::shared_ptr<Goal> handle(new Goal(goal));
  handle->preallocated_feedback_->header.stamp = clock.getSystemTime(ros::Time::now());
  if (handle->valid())
    handle->setSucceeded(handle->preallocated_result_);
  handle->setAborted(handle->preallocated_result_);
  handle->setCanceled(handle->preallocated_result_);
  handle->setFeedback(handle->preallocated_feedback_);
  ros::Timer timer = nh.createTimer(ros::Duration(0.1), &Goal::runNonRealtime, handle);
  handle->gh_.setAccepted();
}

void pids(ros::NodeHandle nh, TiXmlElement* element)
{
  control_toolbox::Pid pid, made(1.0, 2.0, 3.0, 4.0, -4.0), copy(made), windup(1.0, 2.0, 3.0, 4.0, -4.0, true);
  bool yes = pid.init(nh) && pid.init(nh, true) && pid.initParam("/pid") && pid.initParam("/pid", true) && pid.initXml(element);
  pid.initPid(1.0, 2.0, 3.0, 4.0, -4.0);
  pid.initPid(1.0, 2.0, 3.0, 4.0, -4.0, nh);
  pid.initPid(1.0, 2.0, 3.0, 4.0, -4.0, true);
  pid.initPid(1.0, 2.0, 3.0, 4.0, -4.0, true, nh);
  pid.initDynamicReconfig(nh);
  pid.updateDynamicReconfig();
  pid.reset();
  double a, b, c, d, e;
  pid.computeCommand(1.0, ros::Duration(0.01));
  pid.computeCommand(1.0, 2.0, ros::Duration(0.01));
  pid.getGains(a, b, c, d, e);
  pid.getGains(a, b, c, d, e, yes);
  control_toolbox::Pid::Gains gains = pid.getGains();
  gains.p_gain_ = gains.i_gain_ = gains.d_gain_ = gains.i_max_ = gains.i_min_ = 1.0;
  gains.antiwindup_ = true;
  pid.setGains(gains);
  pid.setGains(1.0, 2.0, 3.0, 4.0, -4.0, true);
  pid.setCurrentCmd(pid.getCurrentCmd());
  pid.getCurrentPIDErrors(&a, &b, &c);
  pid.printValues();
  pid = copy;
  a = filters::clamp(1.0, 0.0, 2.0) + filters::exponentialSmoothing(1.0, 2.0, 0.5) + angles::normalize_angle(b);
  control_toolbox::ParametersConfig config;
  dynamic_reconfigure::Server<control_toolbox::ParametersConfig> server(nh);
  server.updateConfig(config);
}

// -- transmissions, trajectories, descriptions ---------------------------------------------------------------------------------------

class MyLoader : public transmission_interface::TransmissionLoader
{
public:
  transmission_interface::TransmissionSharedPtr load(const transmission_interface::TransmissionInfo& info) override
  {
    double reduction = 1.0, offset = 0.0;
    std::string role;
    TiXmlElement actuator = loadXmlElement(info.actuators_[0].xml_element_),
                 joint = loadXmlElement(info.joints_[0].xml_element_);
    if (!checkActuatorDimension(info, 1) || !checkJointDimension(info, 1) ||
        getActuatorReduction(actuator, info.actuators_[0].name_, info.name_, true, reduction) != SUCCESS ||
        getJointReduction(joint, info.joints_[0].name_, info.name_, false, reduction) == BAD_TYPE ||
        getJointOffset(joint, info.joints_[0].name_, info.name_, false, offset) == BAD_TYPE ||
        getActuatorRole(actuator, info.actuators_[0].name_, info.name_, false, role) == NO_DATA ||
        getJointRole(joint, info.joints_[0].role_, info.type_, false, role) == NO_DATA)
      return transmission_interface::TransmissionSharedPtr();
    return transmission_interface::TransmissionSharedPtr(new transmission_interface::SimpleTransmission(reduction, offset));
  }
};
PLUGINLIB_EXPORT_CLASS(MyLoader, transmission_interface::TransmissionLoader)

void transmissions(hi::RobotHW* robot, const std::string& urdf)
{
  namespace ti = transmission_interface;
  ti::RobotTransmissions robots;
  ti::TransmissionInterfaceLoader loader(robot, &robots);
  std::vector<ti::TransmissionInfo> infos;
  if (ti::TransmissionParser::parse(urdf, infos) && loader.load(infos) && loader.load(infos[0]) && loader.load(urdf))
    robots.get<ti::ActuatorToJointStateInterface>()->propagate();
  robots.get<ti::JointToActuatorEffortInterface>()->propagate();
  loader.getData()->transmission_interfaces.jnt_to_act_pos_cmd.propagate();
  double numbers[6] = {};
  ti::ActuatorData motors;
  ti::JointData joints;
  motors.position = motors.velocity = motors.effort = { numbers };
  joints.position = joints.velocity = joints.effort = { numbers + 3 };
  ti::SimpleTransmission simple(10.0, 0.1);
  ti::DifferentialTransmission wrist({ 1.0, 1.0 }, { 1.0, 1.0 }), shifted({ 1.0, 1.0 }, { 1.0, 1.0 }, { 0.1, 0.1 });
  ti::FourBarLinkageTransmission bars({ 1.0, 1.0 }, { 1.0, 1.0 }, { 0.1, 0.1 });
  ti::Transmission& any = simple;
  any.actuatorToJointPosition(motors, joints);
  any.actuatorToJointVelocity(motors, joints);
  any.actuatorToJointEffort(motors, joints);
  any.jointToActuatorPosition(joints, motors);
  any.jointToActuatorVelocity(joints, motors);
  any.jointToActuatorEffort(joints, motors);
  if (any.numActuators() != any.numJoints())
    throw ti::TransmissionInterfaceException("on purpose");
  ti::ActuatorToJointStateHandle handle("joint", &simple, motors, joints);
  handle.propagate();
}

void trajectories(ros::NodeHandle nh)
{
  typedef trajectory_interface::QuinticSplineSegment<double> Segment;
  Segment::State from(2), to(2), at;
  std::vector<Segment> trajectory(1, Segment(0.0, from, 1.0, to));
  trajectory[0].init(0.0, from, 1.0, to);
  if (trajectory_interface::findSegment(trajectory, 0.5) != trajectory.end())
    trajectory_interface::sample(trajectory, 0.5, at);
  from.time_from_start =
      trajectory[0].startTime() + trajectory[0].endTime() + trajectory[0].timeFromStart() + trajectory[0].size();
  urdf_geometry_parser::UrdfGeometryParser parser(nh, "base_link");
  urdf::Vector3 position;
  double number = 0.0;
  if (parser.getTransformVector("joint", "base_link", position) && parser.getDistanceBetweenJoints("one", "two", number) &&
      parser.getJointRadius("joint", number))
    parser.getJointSteeringLimits("joint", number);
}
