// Two libraries have a class of this name, each with a TWIN of its own; it fails where it is told to.
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include <gazebo/common/Events.hh>
#include <gazebo/common/Plugin.hh>
#include <ros/ros.h>

namespace gazebo
{

class Twin : public ModelPlugin
{
public:
  ~Twin() override
  {
    if (fail_in_ == "destructor")
      Fail();  // nobody can catch what a destructor throws: C++ ends the process
  }

  void Load(physics::ModelPtr, sdf::ElementPtr sdf) override
  {
    fail_in_ = sdf->Get<std::string>("fail_in");
    Say("loaded");
    if (fail_in_ == "Load")
      Fail();
    if (fail_in_ == "time")
      ros::WallDuration(5.8).sleep();
    if (fail_in_ == "thread")
      std::thread(Crash).detach();
    if (fail_in_ == "nothing, but a thread goes on")
      std::thread([] {
        while (true)
          ros::WallDuration(0.01).sleep();
      }).detach();
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) {
      if (fail_in_ == "update")
        Crash();
      if (fail_in_ == "exit")
        std::exit(3);
    });
  }

  void Init() override
  {
    if (fail_in_ == "Init")
      throw 7;
  }

private:
  static void Fail() { throw std::runtime_error("told to fail"); }
  static void Crash()
  {
    volatile int* nowhere = nullptr;
    *nowhere = 1;
  }

  virtual void Say(const char* what) { ROS_WARN("twin " TWIN " %s", what); }
  std::string fail_in_;
  event::ConnectionPtr update_;
};
GZ_REGISTER_MODEL_PLUGIN(Twin)

}  // namespace gazebo
