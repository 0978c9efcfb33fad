// A model plugin: swings a joint, by forces. Its twin in Python is my_model_plugins/swing.py.
#include <cmath>
#include <functional>

#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace my_model_plugins
{

class Swing : public gazebo::ModelPlugin
{
public:
  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    const auto name = sdf->Get<std::string>("joint");
    joint_ = model->GetJoint(name);
    if (!joint_)
    {
      gzerr << "<joint>" << name << "</joint>: the model has no such joint" << std::endl;
      return;
    }
    amplitude_ = sdf->Get("amplitude", 0.5).first;
    frequency_ = sdf->Get("frequency", 0.5).first;
    update_ = gazebo::event::Events::ConnectWorldUpdateBegin(std::bind(&Swing::OnUpdate, this, std::placeholders::_1));
  }

private:
  /// In every step, before it is computed: a spring with a damper pulls the joint to where it should be.
  void OnUpdate(const gazebo::common::UpdateInfo& info)
  {
    const double target = amplitude_ * std::sin(2 * M_PI * frequency_ * info.simTime.Double());
    joint_->SetForce(0, 40.0 * (target - joint_->Position(0)) - 4.0 * joint_->GetVelocity(0));
  }

  gazebo::physics::JointPtr joint_;
  double amplitude_ = 0, frequency_ = 0;
  gazebo::event::ConnectionPtr update_;  // its end is that of the calls
};

GZ_REGISTER_MODEL_PLUGIN(Swing)

}  // namespace my_model_plugins
