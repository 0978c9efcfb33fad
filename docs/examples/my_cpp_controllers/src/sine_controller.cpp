// Swings one joint like a sine around the position where it was when the controller started. Its twin in Python:
// ../my_controllers/src/my_controllers/sine.py
#include <cmath>
#include <string>

#include <controller_interface/controller.h>
#include <hardware_interface/joint_command_interface.h>
#include <pluginlib/class_list_macros.hpp>
#include <realtime_tools/realtime_buffer.h>
#include <std_msgs/Float64.h>

namespace my_cpp_controllers
{

class SineController : public controller_interface::Controller<hardware_interface::PositionJointInterface>
{
public:
  bool init(hardware_interface::PositionJointInterface* hw, ros::NodeHandle& controller_nh) override
  {
    std::string joint;
    if (!controller_nh.getParam("joint", joint))
    {
      ROS_ERROR("parameter %s/joint is not set: it names the joint to swing", controller_nh.getNamespace().c_str());
      return false;
    }
    joint_ = hw->getHandle(joint);  // throws, and says which joints there are, if there is none of that name
    amplitude_.initRT(controller_nh.param("amplitude", 0.5));  // rad
    frequency_ = controller_nh.param("frequency", 1.0);        // Hz
    subscriber_ = controller_nh.subscribe("amplitude", 1, &SineController::changeAmplitude, this);
    return true;
  }

  void starting(const ros::Time& time) override
  {
    start_ = time;
    centre_ = joint_.getPosition();
  }

  void update(const ros::Time& time, const ros::Duration& /*period*/) override
  {
    joint_.setCommand(centre_ + *amplitude_.readFromRT() * std::sin(2.0 * M_PI * frequency_ * (time - start_).toSec()));
  }

private:
  // In another thread than update(): the buffer hands the value over.
  void changeAmplitude(const std_msgs::Float64ConstPtr& message) { amplitude_.writeFromNonRT(message->data); }

  hardware_interface::JointHandle joint_;
  realtime_tools::RealtimeBuffer<double> amplitude_;
  double frequency_ = 1.0;
  double centre_ = 0.0;
  ros::Time start_;
  ros::Subscriber subscriber_;
};

}  // namespace my_cpp_controllers

PLUGINLIB_EXPORT_CLASS(my_cpp_controllers::SineController, controller_interface::ControllerBase)
