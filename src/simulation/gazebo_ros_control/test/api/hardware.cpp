// Not run: every class of hardware_interface and joint_limits_interface, each member named once as the sources of others name it.
#include <hardware_interface/actuator_command_interface.h>
#include <hardware_interface/actuator_state_interface.h>
#include <hardware_interface/controller_info.h>
#include <hardware_interface/force_torque_sensor_interface.h>
#include <hardware_interface/hardware_interface.h>
#include <hardware_interface/imu_sensor_interface.h>
#include <hardware_interface/interface_resources.h>
#include <hardware_interface/internal/demangle_symbol.h>
#include <hardware_interface/internal/hardware_resource_manager.h>
#include <hardware_interface/internal/interface_manager.h>
#include <hardware_interface/internal/resource_manager.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_mode_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <hardware_interface/position_velocity_torque_gains_command_interface.h>
#include <hardware_interface/posvel_command_interface.h>
#include <hardware_interface/posvelacc_command_interface.h>
#include <hardware_interface/robot_hw.h>
#include <joint_limits_interface/joint_limits.h>
#include <joint_limits_interface/joint_limits_interface.h>
#include <joint_limits_interface/joint_limits_interface_exception.h>
#include <joint_limits_interface/joint_limits_rosparam.h>
#include <joint_limits_interface/joint_limits_urdf.h>
#include <ros/ros.h>
#include <urdf/model.h>

namespace hi = hardware_interface;
namespace jl = joint_limits_interface;

void handles()
{
  double numbers[9] = {};
  hi::JointStateHandle nothing, state("joint", numbers, numbers + 1, numbers + 2);
  hi::JointStateHandle absolute("joint", numbers, numbers + 1, numbers + 2, numbers + 3);
  hi::JointStateHandle torque("joint", numbers, numbers + 1, numbers + 2, numbers + 4, true);
  hi::JointStateHandle both("joint", numbers, numbers + 1, numbers + 2, numbers + 3, numbers + 4);
  const std::string name = both.getName();
  double sum = both.getPosition() + both.getVelocity() + both.getEffort() + both.getAbsolutePosition() + both.getTorqueSensor();
  const double* at[] = { both.getPositionPtr(), both.getVelocityPtr(), both.getEffortPtr(), both.getAbsolutePositionPtr(),
                         both.getTorqueSensorPtr() };
  bool has = both.hasAbsolutePosition() && both.hasTorqueSensor();

  hi::JointHandle joint(state, numbers + 5), unset;
  joint.setCommand(1.0);
  sum += joint.getCommand() + *joint.getCommandPtr();

  hi::PosVelJointHandle pv(state, numbers + 5, numbers + 6);
  pv.setCommand(1.0, 2.0);
  pv.setCommandPosition(1.0);
  pv.setCommandVelocity(2.0);
  sum += pv.getCommandPosition() + pv.getCommandVelocity() + *pv.getCommandPositionPtr() + *pv.getCommandVelocityPtr();

  hi::PosVelAccJointHandle pva(state, numbers + 5, numbers + 6, numbers + 7);
  pva.setCommand(1.0, 2.0, 3.0);
  pva.setCommandAcceleration(3.0);
  sum += pva.getCommandAcceleration() + *pva.getCommandAccelerationPtr();

  hi::PositionVelocityTorqueGainsJointHandle gains(state, numbers, numbers + 1, numbers + 2, numbers + 3, numbers + 4);
  gains.setCommand(1.0, 2.0, 3.0, 4.0, 5.0);
  sum += gains.getCommandPosition() + gains.getCommandVelocity() + gains.getCommandEffort();

  hi::JointCommandModes mode = hi::JointCommandModes::MODE_POSITION;
  hi::JointModeHandle modes("joint", &mode);
  modes.setMode(hi::JointCommandModes::EMERGENCY_STOP);
  has = has && modes.getMode() == *modes.getModePtr() && !modes.getModeName(hi::JointCommandModes::BEGIN).empty();

  hi::ActuatorStateHandle motor_state("motor", numbers, numbers + 1, numbers + 2);
  hi::ActuatorHandle motor(motor_state, numbers + 3);
  motor.setCommand(motor.getCommand() + motor.getPosition());

  hi::ImuSensorHandle::Data data;
  data.name = "imu";
  data.frame_id = "link";
  data.orientation = data.orientation_covariance = data.angular_velocity = numbers;
  data.angular_velocity_covariance = data.linear_acceleration = data.linear_acceleration_covariance = numbers;
  hi::ImuSensorHandle imu(data), imu_of_eight("imu", "link", numbers, numbers, numbers, numbers, numbers, numbers), no_imu;
  sum += imu.getOrientation()[0] + imu.getOrientationCovariance()[0] + imu.getAngularVelocity()[0] +
         imu.getAngularVelocityCovariance()[0] + imu.getLinearAcceleration()[0] + imu.getLinearAccelerationCovariance()[0];
  hi::ForceTorqueSensorHandle wrist("wrist", "link", numbers, numbers + 3);
  sum += wrist.getForce()[0] + wrist.getTorque()[0];
  ROS_INFO_STREAM(name << sum << has << at[0] << imu.getName() << imu.getFrameId() << wrist.getName() << wrist.getFrameId());
}

// An interface of a stranger's own, and a robot with hooks.

struct LampHandle
{
  std::string getName() const { return "lamp"; }
};
class LampInterface : public hi::HardwareResourceManager<LampHandle, hi::ClaimResources>
{
};
class SeenLampInterface : public hi::HardwareResourceManager<LampHandle>
{
};

class Robot : public hi::RobotHW
{
public:
  bool init(ros::NodeHandle& root_nh, ros::NodeHandle& robot_hw_nh) override { return hi::RobotHW::init(root_nh, robot_hw_nh); }
  bool checkForConflict(const std::list<hi::ControllerInfo>& info) const override
  {
    return hi::RobotHW::checkForConflict(info);
  }
  bool prepareSwitch(const std::list<hi::ControllerInfo>& start, const std::list<hi::ControllerInfo>& stop) override
  {
    return start.empty() || stop.front().claimed_resources[0].resources.count(start.front().name + start.front().type) == 0;
  }
  void doSwitch(const std::list<hi::ControllerInfo>&, const std::list<hi::ControllerInfo>&) override {}
  SwitchState switchResult() const override { return SwitchState::ONGOING; }
  SwitchState switchResult(const hi::ControllerInfo& info) const override
  {
    return info.name.empty() ? SwitchState::DONE : SwitchState::ERROR;
  }
  void read(const ros::Time& time, const ros::Duration& period) override { hi::RobotHW::read(time, period); }
  void write(const ros::Time& time, const ros::Duration& period) override { hi::RobotHW::write(time, period); }

  hi::JointStateInterface states;
  hi::EffortJointInterface efforts;
  hi::VelocityJointInterface velocities;
  hi::PositionJointInterface positions;
  hi::PosVelJointInterface pv;
  hi::PosVelAccJointInterface pva;
  hi::PositionVelocityTorqueGainsJointInterface gains;
  hi::JointModeInterface modes;
  hi::ActuatorStateInterface motor_states;
  hi::EffortActuatorInterface motor_efforts;
  hi::VelocityActuatorInterface motor_velocities;
  hi::PositionActuatorInterface motor_positions;
  hi::ImuSensorInterface imus;
  hi::ForceTorqueSensorInterface wrists;
  LampInterface lamps;
  SeenLampInterface seen;
};

void robots()
{
  Robot robot, other;
  robot.registerInterface(&robot.states);
  robot.registerInterface(&robot.lamps);
  robot.lamps.registerHandle(LampHandle());
  robot.registerInterfaceManager(&other);
  LampHandle lamp = robot.get<LampInterface>()->getHandle("lamp");
  robot.lamps.claim(lamp.getName());
  const std::set<std::string> claims = robot.lamps.getClaims();
  robot.lamps.clearClaims();
  std::vector<hi::ResourceManager<LampHandle>::ResourceManagerType*> several = { &robot.lamps, &robot.seen };
  hi::ResourceManager<LampHandle>::concatManagers(several, &robot.seen);
  std::vector<std::string> names = robot.getNames();
  names = robot.getInterfaceResources("LampInterface");
  names = robot.lamps.getNames();
  const std::string type = hi::internal::demangledTypeName<LampInterface>() + hi::internal::demangledTypeName(robot) +
                           hi::internal::demangleSymbol(typeid(robot).name());
  const hi::InterfaceResources resources(type, claims);
  hi::RobotHWSharedPtr shared = std::make_shared<Robot>();
  try
  {
    throw hi::HardwareInterfaceException("on purpose");
  }
  catch (const std::exception& error)
  {
    ROS_INFO_STREAM(error.what() << names.size() << resources.hardware_interface << resources.resources.size());
  }
}

template <class Handle, class Interface, class... More>
void limited(const hi::JointHandle& joint, const jl::JointLimits& limits, const More&... more)
{
  Handle handle(joint, limits, more...);
  handle.enforceLimits(ros::Duration(0.01));
  Interface interface;
  interface.registerHandle(handle);
  interface.enforceLimits(ros::Duration(0.01));
  interface.getHandle(handle.getName());
}

void limits(const hi::JointHandle& joint, const urdf::JointConstSharedPtr& description, const ros::NodeHandle& nh)
{
  jl::JointLimits l;
  l.min_position = l.max_position = l.max_velocity = l.max_acceleration = l.max_jerk = l.max_effort = 1.0;
  l.has_position_limits = l.has_velocity_limits = l.has_acceleration_limits = l.has_jerk_limits = l.has_effort_limits = true;
  l.angle_wraparound = false;
  jl::SoftJointLimits soft;
  soft.min_position = soft.max_position = soft.k_position = soft.k_velocity = 1.0;
  bool found = jl::getJointLimits(description, l) && jl::getSoftJointLimits(description, soft);
  found = jl::getJointLimits("joint", nh, l) && jl::getSoftJointLimits("joint", nh, soft) && found;
  limited<jl::PositionJointSaturationHandle, jl::PositionJointSaturationInterface>(joint, l);
  limited<jl::EffortJointSaturationHandle, jl::EffortJointSaturationInterface>(joint, l);
  limited<jl::VelocityJointSaturationHandle, jl::VelocityJointSaturationInterface>(joint, l);
  limited<jl::PositionJointSoftLimitsHandle, jl::PositionJointSoftLimitsInterface>(joint, l, soft);
  limited<jl::EffortJointSoftLimitsHandle, jl::EffortJointSoftLimitsInterface>(joint, l, soft);
  limited<jl::VelocityJointSoftLimitsHandle, jl::VelocityJointSoftLimitsInterface>(joint, l, soft);
  jl::PositionJointSaturationHandle(joint, l).reset();
  jl::PositionJointSoftLimitsHandle(joint, l, soft).reset();
  jl::PositionJointSaturationInterface().reset();
  jl::PositionJointSoftLimitsInterface().reset();
  if (!found)
    throw jl::JointLimitsInterfaceException("on purpose");
}
