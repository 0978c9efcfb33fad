// Base class of robot hardware that lives in the simulator.
#pragma once

#include <string>
#include <vector>

#include <gazebo/physics/physics.hh>
#include <hardware_interface/robot_hw.h>
#include <ros/ros.h>
#include <transmission_interface/transmission_info.h>
#include <urdf/model.h>

namespace gazebo_ros_control
{

/// Derive, register interfaces in initSim(), and export the class as a plugin of this package. Runs in the thread of physics.
class RobotHWSim : public hardware_interface::RobotHW
{
public:
  virtual ~RobotHWSim() = default;

  /// Set up. \param urdf_model null where there is no description \return false to refuse
  virtual bool initSim(const std::string& robot_namespace, ros::NodeHandle model_nh, gazebo::physics::ModelPtr parent_model,
                       const urdf::Model* const urdf_model,
                       std::vector<transmission_interface::TransmissionInfo> transmissions) = 0;

  /// Joint states from the simulation to where the handles point.
  virtual void readSim(ros::Time time, ros::Duration period) = 0;

  /// What the handles command into the simulation; in every step, also between two control periods.
  virtual void writeSim(ros::Time time, ros::Duration period) = 0;

  /// Told in every step whether the emergency stop is pressed.
  virtual void eStopActive(const bool /*active*/) {}
};

}  // namespace gazebo_ros_control
