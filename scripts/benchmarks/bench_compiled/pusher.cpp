#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

/// Reads the pose of a link and pushes it a little, in every step.
class Pusher : public gazebo::ModelPlugin
{
public:
  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr) override
  {
    link_ = model->GetLinks().back();
    update_ = gazebo::event::Events::ConnectWorldUpdateBegin([this](const gazebo::common::UpdateInfo&) {
      const ignition::math::Pose3d pose = link_->WorldPose();
      link_->AddForce({ 1e-9 * pose.Pos().X(), 0, 0 });
    });
  }

private:
  gazebo::physics::LinkPtr link_;
  gazebo::event::ConnectionPtr update_;
};

GZ_REGISTER_MODEL_PLUGIN(Pusher)
