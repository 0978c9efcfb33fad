// libDiffDrivePlugin.so, Gazebo's own, of its topics: ~/MODEL/vel_cmd is a pose whose x is m/s ahead and whose yaw is rad/s to the
// right. ROS robots have libgazebo_ros_diff_drive.so.
#include <mutex>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

#include "named.hpp"

namespace gazebo
{

class DiffDrivePlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    left_ = named_joint(*model, sdf, "left_joint"), right_ = named_joint(*model, sdf, "right_joint");
    node_.reset(new transport::Node);
    node_->Init(model->GetWorld()->Name());
    commands_ = node_->Subscribe("~/" + model->GetName() + "/vel_cmd", &DiffDrivePlugin::OnCommand, this);
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) { OnUpdate(); });
  }
  void Init() override
  {
    separation_ = left_->Anchor(0).Distance(right_->Anchor(0));
    const ignition::math::Vector3d size = left_->GetChild()->BoundingBox().Size();
    if (size.Max() > 0)
      radius_ = size.Max() / 2;  // a wheel is flat
  }

private:
  void OnCommand(ConstPosePtr& command)
  {
    const double ahead = command->position().x();
    const double turn = msgs::ConvertIgn(command->orientation()).Euler().Z();
    const std::lock_guard<std::mutex> lock(mutex_);
    left_speed_ = ahead + turn * separation_ / 2;
    right_speed_ = ahead - turn * separation_ / 2;
  }
  void OnUpdate()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    left_->SetVelocity(0, left_speed_ / radius_);
    right_->SetVelocity(0, right_speed_ / radius_);
  }

  physics::JointPtr left_, right_;
  std::mutex mutex_;
  double separation_ = 1, radius_ = 1, left_speed_ = 0, right_speed_ = 0;  // m, m/s
  transport::NodePtr node_;
  transport::SubscriberPtr commands_;
  event::ConnectionPtr update_;
};
GZ_REGISTER_MODEL_PLUGIN(DiffDrivePlugin)

}  // namespace gazebo
