// A model plugin that moves its model by an animation of two seconds, and lifts it when that has ended.
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo
{

class Mover : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr) override
  {
    const common::PoseAnimationPtr way(new common::PoseAnimation("way", 2.0, false));
    const double yaw[] = { 0, 0.5, 1 };
    for (int i = 0; i < 3; ++i)
    {
      common::PoseKeyFrame* const key = way->CreateKeyFrame(i);
      key->Translation({ 1.0 * i, 0, 1 });
      key->Rotation({ 0, 0, yaw[i] });
    }
    model->SetAnimation(way, [model] { model->SetWorldPose({ 2, 0, 5, 0, 0, 0 }); });
  }
};

GZ_REGISTER_MODEL_PLUGIN(Mover)

}  // namespace gazebo
