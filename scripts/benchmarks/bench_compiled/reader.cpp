#include <vector>

#include <controller_interface/controller.h>
#include <hardware_interface/joint_state_interface.h>
#include <pluginlib/class_list_macros.hpp>

namespace bench_compiled
{

class Reader : public controller_interface::Controller<hardware_interface::JointStateInterface>
{
public:
  bool init(hardware_interface::JointStateInterface* hw, ros::NodeHandle& nh) override
  {
    for (const std::string& name : hw->getNames())
      joints_.push_back(hw->getHandle(name));
    rounds_ = nh.param("rounds", 1);
    return true;
  }

  void update(const ros::Time&, const ros::Duration&) override
  {
    for (int i = 0; i < rounds_; ++i)
      for (const auto& joint : joints_)
        sum_ = sum_ + joint.getPosition() + joint.getVelocity() * joint.getEffort();
  }

private:
  std::vector<hardware_interface::JointStateHandle> joints_;
  int rounds_ = 1;
  volatile double sum_ = 0;
};

}  // namespace bench_compiled

PLUGINLIB_EXPORT_CLASS(bench_compiled::Reader, controller_interface::ControllerBase)
