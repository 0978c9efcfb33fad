// Two libraries have a class of this name, each with a TWIN of its own; it fails where it is told to.
#include <stdexcept>

#include <gazebo/common/Plugin.hh>
#include <ros/ros.h>

namespace gazebo
{

class Twin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr, sdf::ElementPtr sdf) override
  {
    fail_in_ = sdf->Get<std::string>("fail_in");
    Say("loaded");
    if (fail_in_ == "Load")
      throw std::runtime_error("told to fail");
    if (fail_in_ == "time")
      ros::WallDuration(5.8).sleep();
  }

  void Init() override
  {
    if (fail_in_ == "Init")
      throw 7;
  }

private:
  virtual void Say(const char* what) { ROS_WARN("twin " TWIN " %s", what); }
  std::string fail_in_;
};
GZ_REGISTER_MODEL_PLUGIN(Twin)

}  // namespace gazebo
