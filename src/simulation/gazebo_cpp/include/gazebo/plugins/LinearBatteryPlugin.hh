#pragma once
#include <gazebo/common/Battery.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo
{

/// The voltage of a link's battery by its charge and by the current that its consumers take:
///   u = e0 + e1 (1 - q / c) - r i;  tau di/dt = P / u - i;  dq/dt = -i, with q in A h
/// The names are Gazebo's: plugins of others derive from it, and publish what they find.
class GAZEBO_VISIBLE LinearBatteryPlugin : public ModelPlugin
{
public:
  ~LinearBatteryPlugin() override;
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override;
  void Init() override;
  void Reset() override;

protected:
  event::ConnectionPtr updateConnection;
  physics::WorldPtr world;
  physics::PhysicsEnginePtr physics;
  physics::ModelPtr model;
  physics::LinkPtr link;
  common::BatteryPtr battery;
  sdf::ElementPtr sdf;
  double e0 = 0, e1 = 0;         // V
  double q0 = 0, c = 0, q = 0;   // A h: at the start, the most, now
  double r = 0, tau = 0;         // ohm, s
  double iraw = 0, ismooth = 0;  // A: that is drawn, that flows

private:
  double voltage();
};

}  // namespace gazebo
