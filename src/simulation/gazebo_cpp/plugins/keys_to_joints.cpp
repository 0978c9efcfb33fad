// libKeysToJointsPlugin.so: keys of ~/keyboard/keypress (gazebo.msgs.Any, an int) move joints: <map key="" type="" scale=""> with <joint>.
// position: by scale from where it is (rad, m); velocity: at scale; force: scale for one step. kp, ki, kd: gains of the first two.
#include <stdexcept>
#include <string>
#include <vector>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

#include "named.hpp"

namespace gazebo
{

class KeysToJointsPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    controller_ = model->GetJointController();
    for (sdf::ElementPtr each = sdf->HasElement("map") ? sdf->GetElement("map") : nullptr; each;
         each = each->GetNextElement("map"))
      read(*model, each);
    node_.reset(new transport::Node);
    node_->Init();
    pressed_ = node_->Subscribe("~/keyboard/keypress", &KeysToJointsPlugin::OnKey, this, true);
  }

private:
  struct Key
  {
    int code = 0;
    std::string type;
    physics::JointPtr joint;
    double scale = 0;
  };

  void read(physics::Model& model, const sdf::ElementPtr& sdf)
  {
    for (const char* name : { "key", "scale", "type" })
      if (!sdf->HasAttribute(name))
        throw std::runtime_error("<map> without " + std::string(name) + "=\"\"");
    const Key key{ sdf->Get<int>("key"), sdf->Get<std::string>("type"), named_joint(model, sdf, "joint"),
                   sdf->Get<double>("scale") };
    if (key.type != "position" && key.type != "velocity" && key.type != "force")
      throw std::runtime_error("<map type='" + key.type + "'>: the type has to be position, velocity or force");
    if (key.type != "force")
    {
      const auto gain = [&sdf](const char* name) { return sdf->HasAttribute(name) ? sdf->Get<double>(name) : 0.0; };
      const common::PID pid(gain("kp"), gain("ki"), gain("kd"));
      if (key.type == "position")
        controller_->SetPositionPID(key.joint->GetScopedName(), pid);
      else
        controller_->SetVelocityPID(key.joint->GetScopedName(), pid);
    }
    keys_.push_back(key);
  }

  void OnKey(ConstAnyPtr& message)
  {
    for (const Key& key : keys_)
    {
      if (message->int_value() != key.code)
        continue;
      if (key.type == "position")
        controller_->SetPositionTarget(key.joint->GetScopedName(), key.joint->Position(0) + key.scale);
      else if (key.type == "velocity")
        controller_->SetVelocityTarget(key.joint->GetScopedName(), key.scale);
      else
        key.joint->SetForce(0, key.scale);
    }
  }

  physics::JointControllerPtr controller_;
  std::vector<Key> keys_;
  transport::NodePtr node_;
  transport::SubscriberPtr pressed_;
};
GZ_REGISTER_MODEL_PLUGIN(KeysToJointsPlugin)

}  // namespace gazebo
