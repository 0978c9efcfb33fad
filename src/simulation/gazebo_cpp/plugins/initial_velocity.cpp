// libInitialVelocityPlugin.so: a model that moves from the start, and again after a reset. m/s and rad/s, world axes.
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo
{

class InitialVelocityPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    model_ = model;
    sdf_ = sdf;
    Reset();
  }
  void Reset() override
  {
    if (sdf_->HasElement("linear"))
      model_->SetLinearVel(sdf_->Get<ignition::math::Vector3d>("linear"));
    if (sdf_->HasElement("angular"))
      model_->SetAngularVel(sdf_->Get<ignition::math::Vector3d>("angular"));
  }

private:
  physics::ModelPtr model_;
  sdf::ElementPtr sdf_;
};
GZ_REGISTER_MODEL_PLUGIN(InitialVelocityPlugin)

}  // namespace gazebo
