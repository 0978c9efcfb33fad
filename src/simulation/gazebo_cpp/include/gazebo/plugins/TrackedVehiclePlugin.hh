#pragma once
#include <map>
#include <mutex>
#include <string>

#include <boost/optional.hpp>

#include <gazebo/common/Plugin.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo
{

enum class Tracks : bool
{
  LEFT,
  RIGHT
};

/// What all tracked vehicles share: commands on Gazebo's transport become speeds of two tracks, and those are told.
/// ~/<model>/cmd_vel_twist (gazebo.msgs.Twist: x ahead in m/s, z in rad/s, positive to the **right** as in Gazebo), ~/<model>/cmd_vel
/// (gazebo.msgs.Pose, deprecated), ~/<model>/tracks_speed (gazebo.msgs.Vector2d: left and right, m/s).
class GAZEBO_VISIBLE TrackedVehiclePlugin : public ModelPlugin
{
public:
  TrackedVehiclePlugin();
  ~TrackedVehiclePlugin() override;
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override;
  void Init() override;
  void Reset() override;

protected:
  void SetTrackVelocity(double left, double right);  // m/s, within <max_linear_speed>
  virtual void SetTrackVelocityImpl(double left, double right) = 0;
  void SetBodyVelocity(double linear, double angular);
  virtual void OnVelMsg(ConstPosePtr& message);
  virtual void OnVelMsg(ConstTwistPtr& message);
  virtual std::string GetRobotNamespace() { return namespace_; }
  virtual double GetSteeringEfficiency() { return efficiency_; }
  virtual void SetSteeringEfficiency(double efficiency) { efficiency_ = efficiency; }
  virtual double GetTracksSeparation() { return separation_; }
  virtual boost::optional<double> GetTrackMu() { return mu_; }
  virtual void SetTrackMu(double mu) { mu_ = mu, UpdateTrackSurface(); }
  virtual boost::optional<double> GetTrackMu2() { return mu2_; }
  virtual void SetTrackMu2(double mu2) { mu2_ = mu2, UpdateTrackSurface(); }
  virtual void UpdateTrackSurface() = 0;
  void SetLinkMu(const physics::LinkPtr& link);

  template <typename T>
  void LoadParam(sdf::ElementPtr sdf, const std::string& name, T& target, T otherwise) const
  {
    target = sdf->Get<T>(name, otherwise).first;
  }

  std::map<Tracks, std::string> trackNames;
  std::mutex mutex;

private:
  physics::ModelPtr model_;
  transport::NodePtr node_;
  transport::SubscriberPtr poses_, twists_;
  transport::PublisherPtr speeds_;
  std::string namespace_;
  double efficiency_ = 0.5, separation_ = 0.4, fastest_ = 1, fastest_turn_ = 1;
  boost::optional<double> mu_, mu2_;
};

}  // namespace gazebo
