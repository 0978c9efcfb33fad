// A robot whose main program is C++, as robots of others are written: joints that go where they are told, and an interface of its own.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <controller_interface/controller.h>
#include <controller_manager/controller_manager.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <hardware_interface/robot_hw.h>
#include <ros/ros.h>
#include <std_msgs/Float64MultiArray.h>

#include "lamp.h"

// What programs have from controller_manager.h alone, with upstream's values.
static_assert(controller_manager_msgs::SwitchControllerRequest::STRICT == 2, "the services are declared");
static_assert(controller_manager::ControllerManager::INFINITE_TIMEOUT == 0.0, "a switch waits for ever");
static_assert(!controller_manager::ControllerManager::WAIT_FOR_ALL_RESOURCES, "a switch starts all at once");

namespace
{

class Robot : public hardware_interface::RobotHW
{
public:
  Robot()
  {
    const char* const names[] = { "left", "right" };
    for (int i = 0; i < 2; ++i)
    {
      const hardware_interface::JointStateHandle state(names[i], &position_[i], &velocity_[i], &effort_[i]);
      states_.registerHandle(state);
      positions_.registerHandle(hardware_interface::JointHandle(state, &position_command_[i]));
      efforts_.registerHandle(hardware_interface::JointHandle(state, &effort_command_[i]));
    }
    lamps_.registerHandle(controller_manager_tests::LampHandle("lamp", &lamp_));
    registerInterface(&states_);
    registerInterface(&positions_);
    registerInterface(&efforts_);
    registerInterface(&lamps_);
  }

  void read(const ros::Time&, const ros::Duration&) override
  {
    for (int i = 0; i < 2; ++i)
    {
      position_[i] = position_command_[i];
      effort_[i] = effort_command_[i];
      velocity_[i] = lamp_;
    }
  }

  bool prepareSwitch(const std::list<hardware_interface::ControllerInfo>& start,
                     const std::list<hardware_interface::ControllerInfo>&) override
  {
    return std::none_of(start.begin(), start.end(),
                        [](const hardware_interface::ControllerInfo& one) { return one.name == "unwanted"; });
  }

private:
  double position_[2] = {}, velocity_[2] = {}, effort_[2] = {}, position_command_[2] = {}, effort_command_[2] = {}, lamp_ = 0.0;
  hardware_interface::JointStateInterface states_;
  hardware_interface::PositionJointInterface positions_;
  hardware_interface::EffortJointInterface efforts_;
  controller_manager_tests::LampInterface lamps_;
};

/// A controller that no package exports. Its parameter loader_asked says how often its loader was asked what there is.
class Own : public controller_interface::Controller<hardware_interface::PositionJointInterface>
{
public:
  explicit Own(int asked) : asked_(asked) {}
  bool init(hardware_interface::PositionJointInterface*, ros::NodeHandle& nh) override
  {
    nh.setParam("loader_asked", asked_);
    return true;
  }
  void update(const ros::Time&, const ros::Duration&) override {}

private:
  const int asked_;
};

class Loader : public controller_manager::ControllerLoaderInterface
{
public:
  Loader() : ControllerLoaderInterface("controller_interface::ControllerBase") {}
  controller_interface::ControllerBaseSharedPtr createInstance(const std::string&) override
  {
    return std::make_shared<Own>(asked_);
  }
  std::vector<std::string> getDeclaredClasses() override
  {
    ++asked_;
    return { "Own" };
  }
  void reload() override {}

private:
  int asked_ = 0;
};

}  // namespace

int main(int argc, char** argv)
{
  ros::init(argc, argv, "cpp_robot");
  ros::NodeHandle nh;
  Robot robot;
  controller_manager::ControllerManager(&robot, ros::NodeHandle("before"));  // gone at once: it must not take ROS along
  controller_manager::ControllerManager manager(&robot, nh);
  manager.registerControllerLoader(std::make_shared<Loader>());
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ros::Publisher lateness = nh.advertise<std_msgs::Float64MultiArray>("lateness", 1, true);
  const int cycles = ros::NodeHandle("~").param("measured_cycles", 0);
  std::vector<double> late;
  ros::Rate rate(1000.0);
  ros::Time last = ros::Time::now();
  while (ros::ok())
  {
    const ros::Time now = ros::Time::now();
    const ros::Duration period = now - last;
    last = now;
    robot.read(now, period);
    manager.update(now, period);
    robot.write(now, period);
    if (cycles > 0 && static_cast<int>(late.size()) < cycles)
    {
      late.push_back(period.toSec());
      if (static_cast<int>(late.size()) == cycles)
      {
        std::sort(late.begin(), late.end());
        std_msgs::Float64MultiArray message;
        message.data = { late[cycles / 2], late[cycles * 99 / 100], late.back() };
        lateness.publish(message);
      }
    }
    rate.sleep();
  }
  return 0;
}
