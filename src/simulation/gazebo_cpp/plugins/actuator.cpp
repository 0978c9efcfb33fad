// libActuatorPlugin.so: limits of joints' efforts (N m, or N) by their speeds (rad/s, or m/s), as motors have them.
#include <stdexcept>
#include <vector>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

#include "named.hpp"

namespace gazebo
{

class ActuatorPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    if (!sdf->HasElement("actuator"))
      return;
    for (sdf::ElementPtr each = sdf->GetElement("actuator"); each; each = each->GetNextElement("actuator"))
      read(*model, each);
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) {
      for (const Actuator& actuator : actuators_)
        if (const double most = limit(actuator); most != actuator.joint->GetEffortLimit(actuator.index))
          actuator.joint->SetEffortLimit(actuator.index, most);  // a change of a joint is looked at by the whole model
    });
  }

private:
  enum class Law
  {
    NONE,  // no effort at all
    ELECTRIC_MOTOR,
    VELOCITY_LIMITER
  };
  struct Actuator
  {
    physics::JointPtr joint;
    unsigned int index = 0;
    Law law = Law::NONE;
    double power = 0, speed = 0, effort = 0;  // W; the largest ones
  };

  void read(physics::Model& model, const sdf::ElementPtr& sdf)
  {
    Actuator made;
    const auto number = [&sdf](const char* tag) {
      if (!sdf->HasElement(tag))
        throw std::runtime_error("<actuator> without <" + std::string(tag) + ">");
      return sdf->Get<double>(tag);
    };
    made.joint = named_joint(model, sdf, "joint");
    const std::string type = sdf->HasElement("type") ? sdf->Get<std::string>("type") : "null";
    if (type == "electric_motor" || type == "velocity_limiter")
    {
      made.law = type == "electric_motor" ? Law::ELECTRIC_MOTOR : Law::VELOCITY_LIMITER;
      made.speed = number("max_velocity"), made.effort = number("max_torque");
      made.power = made.law == Law::ELECTRIC_MOTOR ? number("power") : 0;
    }
    else if (type != "null")
      gzwarn << "<actuator> of joint '" << made.joint->GetName() << "': the type '" << type
             << "' is none of electric_motor, velocity_limiter and null, and counts as null: no effort\n";
    if (sdf->HasElement("index"))
      made.index = sdf->Get<unsigned int>("index");
    made.joint->SetEffortLimit(made.index, made.effort);
    actuators_.push_back(made);
  }

  static double limit(const Actuator& actuator)
  {
    const double speed = actuator.joint->GetVelocity(actuator.index);
    if (actuator.law == Law::VELOCITY_LIMITER)
      return speed > actuator.speed ? actuator.effort : actuator.joint->GetForce(actuator.index);
    if (actuator.law == Law::NONE)
      return 0;
    if (speed > actuator.speed)
      return actuator.power / actuator.speed;
    // Gazebo's: at speed 0 there is the infinite quotient, and backwards a negative one, which is no limit.
    const double effort = actuator.power / speed;
    return effort > actuator.effort ? actuator.effort : effort;
  }

  std::vector<Actuator> actuators_;
  event::ConnectionPtr update_;
};
GZ_REGISTER_MODEL_PLUGIN(ActuatorPlugin)

}  // namespace gazebo
