#pragma once
#include <map>
#include <vector>

#include <gazebo/plugins/TrackedVehiclePlugin.hh>

namespace gazebo
{

/// Tracks as links that do not deform, whose surface runs round them: <left_track>, <right_track>, any number of <left_flipper> and
/// <right_flipper>, and the <body> whose y axis points across them.
class GAZEBO_VISIBLE SimpleTrackedVehiclePlugin : public TrackedVehiclePlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override;
  void Init() override;
  size_t GetNumTracks(Tracks side) const { return links_.at(side).size(); }

protected:
  void SetTrackVelocityImpl(double left, double right) override;
  void UpdateTrackSurface() override;
  void DriveTracks(const common::UpdateInfo&);

  physics::LinkPtr body;
  std::map<Tracks, physics::LinkPtr> tracks;
  std::map<Tracks, double> trackVelocity;

private:
  std::map<Tracks, std::vector<physics::LinkPtr>> links_;  // tracks and flippers
  event::ConnectionPtr update_;
};

}  // namespace gazebo
