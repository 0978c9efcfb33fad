// Compiled controllers for the tests: one that works, and some that go wrong where their parameter ``fault`` says.
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>

#include <controller_interface/controller.h>
#include <controller_interface/multi_interface_controller.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <pluginlib/class_list_macros.h>
#include <std_msgs/Float64.h>

#include "lamp.h"

namespace controller_manager_tests
{

/// Pushes its joint with what the topic says, or 2 Nm; reports the time of its last update on a topic.
class CompiledController : public controller_interface::Controller<hardware_interface::EffortJointInterface>
{
public:
  bool init(hardware_interface::EffortJointInterface* hw, ros::NodeHandle& nh) override
  {
    joint_ = hw->getHandle(nh.param<std::string>("joint", "hiDOF_joint1"));
    subscriber_ = nh.subscribe("effort", 1, &CompiledController::receive, this);
    publisher_ = nh.advertise<std_msgs::Float64>("time", 1);
    return true;
  }

  void update(const ros::Time& time, const ros::Duration&) override
  {
    joint_.setCommand(effort_);
    std_msgs::Float64 message;
    message.data = (ros::Time::now() - time).toSec();
    publisher_.publish(message);
  }

  void stopping(const ros::Time&) override { joint_.setCommand(0.0); }

private:
  void receive(const std_msgs::Float64ConstPtr& message) { effort_ = message->data; }

  hardware_interface::JointHandle joint_;
  ros::Subscriber subscriber_;
  ros::Publisher publisher_;
  double effort_ = 2.0;
};

/// Reads one interface, commands by another.
class CompiledMulti : public controller_interface::MultiInterfaceController<hardware_interface::JointStateInterface,
                                                                            hardware_interface::VelocityJointInterface>
{
public:
  bool init(hardware_interface::RobotHW* robot, ros::NodeHandle& nh) override
  {
    const std::string name = nh.param<std::string>("joint", "test_joint1");
    state_ = robot->get<hardware_interface::JointStateInterface>()->getHandle(name);
    joint_ = robot->get<hardware_interface::VelocityJointInterface>()->getHandle(name);
    return true;
  }

  void update(const ros::Time&, const ros::Duration&) override { joint_.setCommand(state_.getPosition() + 1.0); }

private:
  hardware_interface::JointStateHandle state_;
  hardware_interface::JointHandle joint_;
};

/// On an interface of a third party, beside a standard one.
class CompiledLamp
  : public controller_interface::MultiInterfaceController<hardware_interface::EffortJointInterface, LampInterface>
{
public:
  bool init(hardware_interface::RobotHW* robot, ros::NodeHandle&) override
  {
    joint_ = robot->get<hardware_interface::EffortJointInterface>()->getHandle("right");
    lamp_ = robot->get<LampInterface>()->getHandle("lamp");
    return true;
  }

  void update(const ros::Time&, const ros::Duration&) override
  {
    joint_.setCommand(4.0);
    lamp_.shine(0.5);
  }

private:
  hardware_interface::JointHandle joint_;
  LampHandle lamp_;
};

class CompiledFault : public controller_interface::Controller<hardware_interface::JointStateInterface>
{
public:
  ~CompiledFault() override { fail("destructor"); }

  bool init(hardware_interface::JointStateInterface*, ros::NodeHandle& nh) override
  {
    nh.getParam("fault", fault_);
    fail("init");
    return fault_ != "refuse";
  }

  void starting(const ros::Time&) override { fail("starting"); }
  void stopping(const ros::Time&) override { fail("stopping"); }

  void update(const ros::Time&, const ros::Duration&) override
  {
    fail("update");
    if (fault_ == "number")
      throw 42;
    if (fault_ == "stop")
      state_ = ControllerState::STOPPED;
    if (fault_ == "segmentation fault")
      *volatile_null() = 1.0;
    if (fault_ == "exit")
      std::exit(3);
    if (fault_ == "abort")
      std::abort();
    if (fault_ == "block")
    {
      fault_.clear();
      std::this_thread::sleep_for(std::chrono::seconds(6));
    }
    if (fault_ == "thread")
      std::thread([] { *volatile_null() = 1.0; }).join();
  }

private:
  static volatile double* volatile_null()  // the compiler would leave out what it knows to be impossible
  {
    volatile double* volatile nowhere = nullptr;
    return nowhere;
  }

  void fail(const std::string& place)
  {
    if (fault_ == place)
      throw std::runtime_error("on purpose in " + place);
  }

  std::string fault_;
};

/// Its constructor throws.
class CompiledConstructor : public CompiledController
{
public:
  CompiledConstructor() { throw std::runtime_error("on purpose in the constructor"); }
};

/// Exported, but as something else.
class NoController
{
public:
  virtual ~NoController() = default;
};
class CompiledOther : public NoController
{
};

}  // namespace controller_manager_tests

PLUGINLIB_EXPORT_CLASS(controller_manager_tests::CompiledController, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(controller_manager_tests::CompiledMulti, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(controller_manager_tests::CompiledLamp, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(controller_manager_tests::CompiledFault, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(controller_manager_tests::CompiledConstructor, controller_interface::ControllerBase)
PLUGINLIB_EXPORT_CLASS(controller_manager_tests::CompiledOther, controller_manager_tests::NoController)
