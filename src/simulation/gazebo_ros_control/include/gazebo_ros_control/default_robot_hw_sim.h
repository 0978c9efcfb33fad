// The joints of a model that have a transmission, as hardware of ros_control; for classes of others that add to it.
#pragma once

#include <string>
#include <vector>

#include <angles/angles.h>
#include <boost/shared_ptr.hpp>
#include <control_toolbox/pid.h>
#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo_ros_control/robot_hw_sim.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <joint_limits_interface/joint_limits.h>
#include <joint_limits_interface/joint_limits_interface.h>
#include <joint_limits_interface/joint_limits_rosparam.h>
#include <joint_limits_interface/joint_limits_urdf.h>
#include <pluginlib/class_list_macros.h>  // derived classes export themselves without including it
#include <ros/ros.h>

namespace gazebo_ros_control
{

/// One command interface for each joint: the first that its transmission names. Positions without gains (pid_gains/JOINT) are set,
/// velocities without gains are those of a motor; with gains, a PID gives the effort.
class DefaultRobotHWSim : public RobotHWSim
{
public:
  bool initSim(const std::string& robot_namespace, ros::NodeHandle model_nh, gazebo::physics::ModelPtr parent_model,
               const urdf::Model* const urdf_model,
               std::vector<transmission_interface::TransmissionInfo> transmissions) override;
  void readSim(ros::Time time, ros::Duration period) override;
  void writeSim(ros::Time time, ros::Duration period) override;
  void eStopActive(const bool active) override;

protected:
  enum ControlMethod
  {
    EFFORT,
    POSITION,
    POSITION_PID,
    VELOCITY,
    VELOCITY_PID
  };

  /// What the description and the parameters say of a joint; its handle is limited from then on.
  void registerJointLimits(const std::string& joint_name, const hardware_interface::JointHandle& joint_handle,
                           const ControlMethod ctrl_method, const ros::NodeHandle& joint_limit_nh,
                           const urdf::Model* const urdf_model, int* const joint_type, double* const lower_limit,
                           double* const upper_limit, double* const effort_limit);

  unsigned int n_dof_ = 0;

  hardware_interface::JointStateInterface js_interface_;
  hardware_interface::EffortJointInterface ej_interface_;
  hardware_interface::PositionJointInterface pj_interface_;
  hardware_interface::VelocityJointInterface vj_interface_;

  joint_limits_interface::EffortJointSaturationInterface ej_sat_interface_;
  joint_limits_interface::EffortJointSoftLimitsInterface ej_limits_interface_;
  joint_limits_interface::PositionJointSaturationInterface pj_sat_interface_;
  joint_limits_interface::PositionJointSoftLimitsInterface pj_limits_interface_;
  joint_limits_interface::VelocityJointSaturationInterface vj_sat_interface_;
  joint_limits_interface::VelocityJointSoftLimitsInterface vj_limits_interface_;

  // One entry each for every joint; none of them grows after initSim(): handles point into them.
  std::vector<std::string> joint_names_;
  std::vector<int> joint_types_;
  std::vector<double> joint_lower_limits_;
  std::vector<double> joint_upper_limits_;
  std::vector<double> joint_effort_limits_;
  std::vector<ControlMethod> joint_control_methods_;
  std::vector<control_toolbox::Pid> pid_controllers_;
  std::vector<double> joint_position_;
  std::vector<double> joint_velocity_;
  std::vector<double> joint_effort_;
  std::vector<double> joint_effort_command_;
  std::vector<double> joint_position_command_;
  std::vector<double> last_joint_position_command_;
  std::vector<double> joint_velocity_command_;
  std::vector<gazebo::physics::JointPtr> sim_joints_;

  std::string physics_type_;
  bool e_stop_active_ = false, last_e_stop_active_ = false;

private:
  bool addJoint(const transmission_interface::TransmissionInfo& transmission, const ros::NodeHandle& nh,
                const gazebo::physics::ModelPtr& model, const urdf::Model* urdf_model);
  double positionError(unsigned int joint) const;
};

typedef boost::shared_ptr<DefaultRobotHWSim> DefaultRobotHWSimPtr;

}  // namespace gazebo_ros_control
