// Hardware of a robot as its users write it: the default one, with a joint's command halved, and what can go wrong in it.
#include <stdexcept>

#include <gazebo_ros_control/default_robot_hw_sim.h>
#include <pluginlib/class_list_macros.h>

namespace gazebo_ros_control_test
{

class HalvedHWSim : public gazebo_ros_control::DefaultRobotHWSim
{
public:
  bool initSim(const std::string& robot_namespace, ros::NodeHandle model_nh, gazebo::physics::ModelPtr model,
               const urdf::Model* const urdf_model,
               std::vector<transmission_interface::TransmissionInfo> transmissions) override
  {
    model_nh_ = model_nh;
    if (model_nh.param("fail_in", std::string()) == "initSim")
      throw std::logic_error("told to fail in initSim");
    return DefaultRobotHWSim::initSim(robot_namespace, model_nh, model, urdf_model, transmissions);
  }

  void writeSim(ros::Time time, ros::Duration period) override
  {
    for (double& command : joint_velocity_command_)
      command /= 2;
    DefaultRobotHWSim::writeSim(time, period);
    for (double& command : joint_velocity_command_)
      command *= 2;
    for (const double effort : joint_effort_command_)
      if (effort > 40)
        throw std::runtime_error("told to fail in writeSim");
    if (ros::Time::now() != time)
      throw std::runtime_error("the clock is not that of the step");
  }

private:
  ros::NodeHandle model_nh_;
};

}  // namespace gazebo_ros_control_test

PLUGINLIB_EXPORT_CLASS(gazebo_ros_control_test::HalvedHWSim, gazebo_ros_control::RobotHWSim)
