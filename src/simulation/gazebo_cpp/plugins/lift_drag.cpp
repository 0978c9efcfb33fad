// libLiftDragPlugin.so: a link's wing or fin. The law is that of Gazebo 11.1 to its last step, its quirks included: lift and drag go by
// the part of the velocity that the plugin takes for the one in the plane of lift and drag, and moments are none.
#include <algorithm>
#include <cmath>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

#include "named.hpp"

namespace gazebo
{

using ignition::math::Vector3d;

namespace
{

double folded(double angle)  // to within a quarter turn
{
  return std::isfinite(angle) ? angle - M_PI * std::round(angle / M_PI) : 0;
}

}  // namespace

class LiftDragPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    const auto number = [&sdf](const char* tag, double& value) {
      if (sdf->HasElement(tag))
        value = sdf->Get<double>(tag);
    };
    number("a0", alpha0_), number("cla", cla_), number("cda", cda_), number("alpha_stall", stall_);
    number("cla_stall", cla_stalled_), number("cda_stall", cda_stalled_);
    number("area", area_), number("air_density", density_), number("control_joint_rad_to_cl", flap_to_cl_);
    const auto vector = [&sdf](const char* tag, Vector3d& value) {
      if (sdf->HasElement(tag))
        value = sdf->Get<Vector3d>(tag);
    };
    vector("cp", centre_), vector("forward", forward_), vector("upward", upward_);
    forward_.Normalize(), upward_.Normalize();
    radial_ = sdf->HasElement("radial_symmetry") && sdf->Get<bool>("radial_symmetry");
    link_ = named_link(*model, sdf, "link_name");
    if (sdf->HasElement("control_joint_name"))
    {
      const std::string flap = sdf->Get<std::string>("control_joint_name");
      flap_ = model->GetJoint(flap);
      if (!flap_)
        gzerr << "<control_joint_name>: the model has no joint '" << flap << "'; the wing is without it\n";
    }
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) { OnUpdate(); });
  }

private:
  void OnUpdate()
  {
    const Vector3d velocity = link_->WorldLinearVel(centre_);
    if (!(velocity.Length() > 0.01))
      return;
    const Vector3d along = Vector3d(velocity).Normalize();
    const ignition::math::Quaterniond q = link_->WorldPose().Rot();
    const Vector3d forward = q.RotateVector(forward_);
    const Vector3d upward = radial_ ? forward.Cross(forward.Cross(along)).Normalize() : q.RotateVector(upward_);
    const Vector3d span = forward.Cross(upward).Normalize();
    const double sine = std::clamp(span.Dot(along), -1.0, 1.0), swept = 1 - sine * sine;
    const Vector3d in_plane = velocity - velocity.Dot(span) * along;
    const Vector3d drag = (-in_plane).Normalize(), lift = span.Cross(in_plane).Normalize();
    const double turn = std::acos(std::clamp(lift.Dot(upward), -1.0, 1.0));
    const double alpha = folded(lift.Dot(forward) >= 0 ? alpha0_ + turn : alpha0_ - turn);
    const double pressure = 0.5 * density_ * in_plane.SquaredLength();
    double cl = beyond(alpha, cla_, cla_stalled_) * swept;
    if (alpha > stall_)
      cl = std::max(0.0, cl);
    else if (alpha < -stall_)
      cl = std::min(0.0, cl);
    if (flap_)
      cl += flap_to_cl_ * flap_->Position(0);
    const double cd = std::abs(beyond(alpha, cda_, cda_stalled_) * swept);
    const Vector3d force = pressure * area_ * (cl * lift + cd * drag);
    if (force.IsFinite())
      link_->AddForceAtRelativePosition(force, centre_);
  }

  // A coefficient that grows by one slope up to the stall and by another beyond it.
  double beyond(double alpha, double slope, double stalled) const
  {
    const double within = std::clamp(alpha, -stall_, stall_);
    return slope * within + stalled * (alpha - within);
  }

  physics::LinkPtr link_;
  physics::JointPtr flap_;
  event::ConnectionPtr update_;
  Vector3d centre_{ 0, 0, 0 }, forward_{ 1, 0, 0 }, upward_{ 0, 0, 1 };
  double alpha0_ = 0, cla_ = 1, cda_ = 0.01, stall_ = 0.5 * M_PI, cla_stalled_ = 0, cda_stalled_ = 1;
  double area_ = 1, density_ = 1.2041, flap_to_cl_ = 4;
  bool radial_ = false;
};
GZ_REGISTER_MODEL_PLUGIN(LiftDragPlugin)

}  // namespace gazebo
