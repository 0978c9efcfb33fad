// libJointControlPlugin.so: what the joints of a model are to do from the start: <controller type="position|velocity|force"> with <target>
// (rad, m, rad/s, m/s, N m, N), <pid_gains> and <joint>, a name or a regular expression of names.
#include <regex>
#include <stdexcept>
#include <string>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

#include "../core/convert.hpp"

namespace gazebo
{

class JointControlPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    for (sdf::ElementPtr each = sdf->GetFirstElement(); each; each = each->GetNextElement())
      if (each->GetName() == "controller")
        read(*model, each);
      else
        physics::refused("<" + each->GetName() + "> means nothing here");
  }

private:
  static void read(physics::Model& model, const sdf::ElementPtr& sdf)
  {
    const std::string type = sdf->HasAttribute("type") ? sdf->Get<std::string>("type") : "";
    if (type != "force" && type != "position" && type != "velocity")
      throw std::runtime_error("<controller type='" + type + "'>: the type has to be force, position or velocity");
    if (type == "force" && sdf->HasElement("pid_gains"))
      physics::refused("<pid_gains> of a force mean nothing");
    for (sdf::ElementPtr each = sdf->HasElement("joint") ? sdf->GetElement("joint") : nullptr; each;
         each = each->GetNextElement("joint"))
    {
      const auto wanted = each->Get<std::string>();
      const std::regex names(model.GetScopedName() + "::" + wanted);
      bool any = false;
      for (const physics::JointPtr& joint : model.GetJoints())
        if (std::regex_match(joint->GetScopedName(), names))
          any = true, order(*model.GetJointController(), joint->GetScopedName(), type, sdf);
      if (!any)
        physics::refused("no joint of model " + model.GetName() + " is called '" + wanted + "'");
    }
  }

  static void order(physics::JointController& controller, const std::string& joint, const std::string& type,
                    const sdf::ElementPtr& sdf)
  {
    const bool of_position = type == "position";
    if (type != "force" && sdf->HasElement("pid_gains"))
    {
      const auto gains = sdf->Get<ignition::math::Vector3d>("pid_gains");
      common::PID pid = of_position ? controller.GetPositionPIDs()[joint] : controller.GetVelocityPIDs()[joint];
      pid.SetPGain(gains.X()), pid.SetIGain(gains.Y()), pid.SetDGain(gains.Z());
      of_position ? controller.SetPositionPID(joint, pid) : controller.SetVelocityPID(joint, pid);
    }
    if (!sdf->HasElement("target"))
      return;
    const auto target = sdf->Get<double>("target");
    if (type == "force")
      controller.SetForce(joint, target);
    else if (of_position)
      controller.SetPositionTarget(joint, target);
    else
      controller.SetVelocityTarget(joint, target);
  }
};
GZ_REGISTER_MODEL_PLUGIN(JointControlPlugin)

}  // namespace gazebo
