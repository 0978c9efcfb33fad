// libSkidSteerDrivePlugin.so, Gazebo's own, of its topics: ~/MODEL/vel_cmd is a pose whose x is m/s ahead and whose yaw is half of
// rad/s to the left. Joints right_front, right_rear, left_front and left_rear get their speeds once, as each command comes.
#include <array>
#include <stdexcept>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo
{

class SkidSteerDrivePlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr) override
  {
    const char* const names[] = { "right_front", "right_rear", "left_front", "left_rear" };
    for (std::size_t i = 0; i < joints_.size(); ++i)
      if (joints_[i] = model->GetJoint(names[i]); !joints_[i])
        throw std::runtime_error("the model has no joint '" + std::string(names[i]) + "'");
    separation_ = joints_[0]->Anchor(0).Distance(joints_[2]->Anchor(0));
    radius_ = joints_[0]->GetChild()->BoundingBox().Size().Max() / 2;  // a wheel is flat
    if (!(separation_ > 0))
      throw std::runtime_error("joints right_front and left_front are in one place");
    if (!(radius_ > 0))
      throw std::runtime_error("the link of joint right_front has no collision, so that its radius is not known");
    node_.reset(new transport::Node);
    node_->Init(model->GetWorld()->Name());
    commands_ = node_->Subscribe("~/" + model->GetName() + "/vel_cmd", &SkidSteerDrivePlugin::OnCommand, this);
  }

private:
  void OnCommand(ConstPosePtr& command)
  {
    const double ahead = command->position().x() / radius_;
    const double turn = msgs::ConvertIgn(command->orientation()).Euler().Z() * separation_ / radius_;
    for (std::size_t i = 0; i < joints_.size(); ++i)
      joints_[i]->SetVelocity(0, i < 2 ? ahead + turn : ahead - turn);
  }

  std::array<physics::JointPtr, 4> joints_;
  double separation_ = 0, radius_ = 0;  // m
  transport::NodePtr node_;
  transport::SubscriberPtr commands_;
};
GZ_REGISTER_MODEL_PLUGIN(SkidSteerDrivePlugin)

}  // namespace gazebo
