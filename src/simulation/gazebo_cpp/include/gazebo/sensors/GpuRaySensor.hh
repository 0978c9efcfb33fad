#pragma once
#include <functional>
#include <string>

#include <gazebo/sensors/RaySensor.hh>

namespace gazebo
{
namespace sensors
{

/// The same rays as RaySensor's: there is no graphics card in it.
class GAZEBO_VISIBLE GpuRaySensor : public RaySensor
{
public:
  using Frame = void(const float* data, unsigned int width, unsigned int height, unsigned int depth, const std::string& format);
  ignition::math::Angle HorzFOV() const { return AngleMax() - AngleMin(); }
  ignition::math::Angle VertFOV() const { return VerticalAngleMax() - VerticalAngleMin(); }
  bool IsHorizontal() const { return true; }
  /// data: of each ray range (m), intensity and 0
  event::ConnectionPtr ConnectNewLaserFrame(std::function<Frame> subscriber) { return frames_.Connect(subscriber); }
  bool IsActive() const override { return RaySensor::IsActive() || frames_.ConnectionCount(); }

protected:
  bool UpdateImpl(bool force) override;

private:
  event::EventT<Frame> frames_;
};

}  // namespace sensors
}  // namespace gazebo
