// Vehicles on tracks: from commands to belts.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gazebo/gazebo.hh>
#include <gazebo/plugins/SimpleTrackedVehiclePlugin.hh>

#include "convert.hpp"

namespace gazebo
{

using ignition::math::Vector3d;

namespace
{

double within(double value, double most) { return std::isfinite(value) ? std::min(std::max(value, -most), most) : 0; }

double positive(const sdf::ElementPtr& sdf, const char* tag, double otherwise)
{
  const double value = sdf->Get<double>(tag, otherwise).first;
  if (!(value > 0) || !std::isfinite(value))
    throw std::runtime_error(std::string("<") + tag + "> has to be a positive number");
  return value;
}

}  // namespace

TrackedVehiclePlugin::TrackedVehiclePlugin() : trackNames{ { Tracks::LEFT, "left" }, { Tracks::RIGHT, "right" } } {}
TrackedVehiclePlugin::~TrackedVehiclePlugin() = default;

void TrackedVehiclePlugin::Load(physics::ModelPtr model, sdf::ElementPtr sdf)
{
  model_ = model;
  namespace_ = sdf->Get<std::string>("robot_namespace", model->GetName()).first;
  efficiency_ = positive(sdf, "steering_efficiency", 0.5);
  separation_ = positive(sdf, "tracks_separation", 0.4);
  fastest_ = positive(sdf, "max_linear_speed", 1.0);
  fastest_turn_ = std::abs(within(sdf->Get<double>("max_angular_speed", 1.0).first, 1e6));
  if (sdf->HasElement("track_mu"))
    mu_ = sdf->Get<double>("track_mu");
  if (sdf->HasElement("track_mu2"))
    mu2_ = sdf->Get<double>("track_mu2");
}

void TrackedVehiclePlugin::Init()
{
  std::string space = GetRobotNamespace();
  if (!space.empty() && space[0] != '/')
    space = model_->GetWorld()->Name() + "/" + space;
  node_.reset(new transport::Node);
  node_->Init(space);
  poses_ = node_->Subscribe<msgs::Pose, TrackedVehiclePlugin>("~/cmd_vel", &TrackedVehiclePlugin::OnVelMsg, this);
  twists_ = node_->Subscribe<msgs::Twist, TrackedVehiclePlugin>("~/cmd_vel_twist", &TrackedVehiclePlugin::OnVelMsg, this);
  speeds_ = node_->Advertise<msgs::Vector2d>("~/tracks_speed", 1000);
}

void TrackedVehiclePlugin::Reset() { SetBodyVelocity(0, 0); }

void TrackedVehiclePlugin::SetTrackVelocity(double left, double right)
{
  left = within(left, fastest_), right = within(right, fastest_);
  SetTrackVelocityImpl(left, right);
  if (!speeds_)
    return;
  msgs::Vector2d message;
  message.set_x(left);
  message.set_y(right);
  speeds_->Publish(message);
}

// To the right where z is positive: Gazebo has it so, and those who command it know.
void TrackedVehiclePlugin::SetBodyVelocity(double linear, double angular)
{
  const std::lock_guard<std::mutex> lock(mutex);
  const double ahead = within(linear, fastest_);
  const double aside = within(angular, fastest_turn_) * GetTracksSeparation() / 2 / GetSteeringEfficiency();
  SetTrackVelocity(ahead + aside, ahead - aside);
}

void TrackedVehiclePlugin::OnVelMsg(ConstPosePtr& message)
{
  SetBodyVelocity(message->position().x(), msgs::ConvertIgn(message->orientation()).Euler().Z());
}

void TrackedVehiclePlugin::OnVelMsg(ConstTwistPtr& message) { SetBodyVelocity(message->linear().x(), message->angular().z()); }

void TrackedVehiclePlugin::SetLinkMu(const physics::LinkPtr& link)
{
  for (const auto& collision : link->GetCollisions())
  {
    const auto friction = collision->GetSurface()->FrictionPyramid();
    if (const auto mu = GetTrackMu())
      friction->SetMuPrimary(*mu);
    if (const auto mu2 = GetTrackMu2())
      friction->SetMuSecondary(*mu2);
  }
}

// ------------------------------------------------------------------------------------------------ simple ones

namespace
{

physics::LinkPtr link_of(const physics::ModelPtr& model, const std::string& tag, const std::string& name)
{
  const physics::LinkPtr link = model->GetLink(name);
  if (link)
    return link;
  std::string links;
  for (const auto& each : model->GetLinks())
    links += (links.empty() ? "" : ", ") + each->GetName();
  throw std::runtime_error("<" + tag + ">: model " + model->GetName() + " has no link '" + name + "', but " + links +
                           " (fixed joints of a URDF are merged; <disableFixedJointLumping> or an SDF file keeps their links)");
}

}  // namespace

void SimpleTrackedVehiclePlugin::Load(physics::ModelPtr model, sdf::ElementPtr sdf)
{
  TrackedVehiclePlugin::Load(model, sdf);
  for (const char* tag : { "body", "left_track", "right_track" })
    if (!sdf->HasElement(tag))
      throw std::runtime_error(std::string("<") + tag + "> is not there: the name of a link");
  body = link_of(model, "body", sdf->Get<std::string>("body"));
  for (const auto& [side, name] : trackNames)
  {
    const std::string track = name + "_track", flipper = name + "_flipper";
    tracks[side] = link_of(model, track, sdf->Get<std::string>(track));
    links_[side] = { tracks[side] };
    for (sdf::ElementPtr each = sdf->HasElement(flipper) ? sdf->GetElement(flipper) : nullptr; each;
         each = each->GetNextElement(flipper))
      links_[side].push_back(link_of(model, flipper, each->Get<std::string>()));
    trackVelocity[side] = 0;
  }
}

void SimpleTrackedVehiclePlugin::Init()
{
  TrackedVehiclePlugin::Init();
  UpdateTrackSurface();
  update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo& info) { DriveTracks(info); });
}

void SimpleTrackedVehiclePlugin::SetTrackVelocityImpl(double left, double right)
{
  trackVelocity[Tracks::LEFT] = left;
  trackVelocity[Tracks::RIGHT] = right;
}

void SimpleTrackedVehiclePlugin::UpdateTrackSurface()
{
  for (const auto& [side, links] : links_)
    for (const auto& link : links)
      SetLinkMu(link);
}

// What the speeds of the tracks mean for the body gives friction its first direction, as far as it has two coefficients.
void SimpleTrackedVehiclePlugin::DriveTracks(const common::UpdateInfo&)
{
  std::map<Tracks, double> speeds;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    speeds = trackVelocity;
  }
  const double left = speeds[Tracks::LEFT], right = speeds[Tracks::RIGHT];
  const ode_sim::Link& core = *body->Core();
  const auto turned = [&](const ode_sim::Vec3& v) { return ode_sim::rotate(core.X_WL.q, v); };
  ode_sim::Belt belt;
  belt.told = true;
  belt.left = turned({ 0, 1, 0 });
  belt.v = turned({ (left + right) / 2, 0, 0 });
  belt.w = turned({ 0, 0, (right - left) * GetSteeringEfficiency() / GetTracksSeparation() });
  belt.at = core.X_WL.p;
  for (const auto& [side, links] : links_)
    for (const auto& link : links)
    {
      belt.speed = speeds[side];
      link->Core()->belt = belt;
    }
}

}  // namespace gazebo
