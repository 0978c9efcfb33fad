// libWheelTrackedVehiclePlugin.so: tracks made of wheels, <left_joint> and <right_joint>, two at least on each side, that all turn at the
// track's speed with at most <max_torque> (5 N m). Commands and topics as of SimpleTrackedVehiclePlugin.
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gazebo/gazebo.hh>
#include <gazebo/plugins/TrackedVehiclePlugin.hh>

namespace gazebo
{

class WheelTrackedVehiclePlugin : public TrackedVehiclePlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    TrackedVehiclePlugin::Load(model, sdf);
    LoadParam(sdf, "max_torque", torque_, 5.0);
    double radius = 0;
    LoadParam(sdf, "default_wheel_radius", radius, 0.5);
    for (const auto& [side, name] : trackNames)
    {
      const std::string tag = name + "_joint";
      for (sdf::ElementPtr each = sdf->HasElement(tag) ? sdf->GetElement(tag) : nullptr; each; each = each->GetNextElement(tag))
        add(*model, side, tag, each->Get<std::string>(), radius);
      if (wheels_[side].size() < 2)
        throw std::runtime_error("<" + tag +
                                 ">: a track needs two wheels at least, each the child of a joint that is named so");
    }
  }
  void Init() override
  {
    TrackedVehiclePlugin::Init();
    for (const auto& [side, wheels] : wheels_)
      for (const Wheel& wheel : wheels)
        wheel.joint->SetParam("fmax", 0, torque_);
    UpdateTrackSurface();
  }

protected:
  void SetTrackVelocityImpl(double left, double right) override
  {
    for (const auto& [side, wheels] : wheels_)
      for (const Wheel& wheel : wheels)
        wheel.joint->SetParam("vel", 0, (side == Tracks::LEFT ? left : right) / wheel.radius);
  }
  void UpdateTrackSurface() override
  {
    for (const auto& [side, wheels] : wheels_)
      for (const Wheel& wheel : wheels)
        SetLinkMu(wheel.joint->GetChild());
  }

private:
  struct Wheel
  {
    physics::JointPtr joint;
    double radius;  // m
  };

  // Its radius is that of its one cylinder, else half the widest side of all that it collides with.
  void add(physics::Model& model, Tracks side, const std::string& tag, const std::string& name, double otherwise)
  {
    const physics::JointPtr joint = model.GetJoint(name);
    if (!joint || !joint->HasType(physics::Base::HINGE_JOINT))
      throw std::runtime_error("<" + tag + ">: the model has no revolute joint '" + name + "'");
    const auto collisions = joint->GetChild()->GetCollisions();
    const auto cylinder = collisions.size() == 1
                              ? boost::dynamic_pointer_cast<physics::CylinderShape>(collisions[0]->GetShape())
                              : physics::CylinderShapePtr();
    const double radius = collisions.empty() ? otherwise
                          : cylinder         ? cylinder->GetRadius()
                                             : joint->GetChild()->BoundingBox().Size().Max() / 2;
    if (!(radius > 0))
      throw std::runtime_error("<" + tag + ">: the wheel of joint '" + name + "' has no radius");
    wheels_[side].push_back({ joint, radius });
  }

  std::map<Tracks, std::vector<Wheel>> wheels_;
  double torque_ = 5;  // N m
};
GZ_REGISTER_MODEL_PLUGIN(WheelTrackedVehiclePlugin)

}  // namespace gazebo
