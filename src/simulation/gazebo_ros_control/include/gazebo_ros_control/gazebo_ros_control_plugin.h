// A model plugin with a controller manager on the joints of its model, for plugins in C++ that derive from it.
#pragma once

#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>
#include <boost/thread.hpp>
#include <controller_manager/controller_manager.h>
#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo_ros_control/robot_hw_sim.h>
#include <pluginlib/class_loader.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <transmission_interface/transmission_parser.h>

namespace gazebo_ros_control
{

/// Elements as those of libgazebo_ros_control.so, which is Python's: robotNamespace, robotParam, robotSimType, controlPeriod (s),
/// eStopTopic (std_msgs/Bool). Where the robot's description comes later than the model, the world goes on meanwhile.
class GazeboRosControlPlugin : public gazebo::ModelPlugin
{
public:
  ~GazeboRosControlPlugin() override;

  void Load(gazebo::physics::ModelPtr parent, sdf::ElementPtr sdf) override;
  void Reset() override;

  /// What is done in every step.
  void Update();

  /// The closest parameter of that name above the robot's namespace; waits until it is there.
  std::string getURDF(std::string param_name) const;

  /// Into transmissions_.
  bool parseTransmissionsFromURDF(const std::string& urdf_string);

protected:
  void eStopCB(const std_msgs::BoolConstPtr& e_stop_active);

  ros::NodeHandle model_nh_;
  gazebo::physics::ModelPtr parent_model_;
  sdf::ElementPtr sdf_;
  boost::thread deferred_load_thread_;
  gazebo::event::ConnectionPtr update_connection_;
  // The loader outlives what it made, the robot the manager of its controllers.
  boost::shared_ptr<pluginlib::ClassLoader<RobotHWSim>> robot_hw_sim_loader_;
  std::string robot_namespace_;
  std::string robot_description_;  // name of the parameter
  std::vector<transmission_interface::TransmissionInfo> transmissions_;
  std::string robot_hw_sim_type_str_;
  urdf::Model urdf_model_;
  boost::shared_ptr<RobotHWSim> robot_hw_sim_;
  boost::shared_ptr<controller_manager::ControllerManager> controller_manager_;
  ros::Duration control_period_;
  ros::Time last_update_sim_time_ros_;
  ros::Time last_write_sim_time_ros_;
  bool e_stop_active_ = false, last_e_stop_active_ = false;
  ros::Subscriber e_stop_sub_;

private:
  void readElements();
  bool findURDF(const std::string& param_name, std::string& urdf) const;
  void waitForURDF();
  void start(const std::string& urdf);
  boost::shared_ptr<RobotHWSim> makeRobot();

  ros::WallTime next_look_;
};

}  // namespace gazebo_ros_control
