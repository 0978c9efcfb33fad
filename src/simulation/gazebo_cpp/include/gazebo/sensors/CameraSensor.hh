#pragma once
#include <string>

#include <gazebo/rendering/Camera.hh>
#include <gazebo/sensors/PictureSensor.hh>

namespace gazebo
{
namespace sensors
{

/// <sensor type="camera">.
class GAZEBO_VISIBLE CameraSensor : public PictureSensor
{
public:
  CameraSensor();
  ~CameraSensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  virtual rendering::CameraPtr Camera() const { return camera(0); }
  unsigned int ImageWidth() const { return Camera()->ImageWidth(); }
  unsigned int ImageHeight() const { return Camera()->ImageHeight(); }
  virtual const unsigned char* ImageData() { return Camera()->ImageData(0); }
  bool SaveFrame(const std::string& file) { return Camera()->SaveFrame(file); }
  bool Rendered() const { return LastMeasurementTime() != common::Time::Zero; }

protected:
  virtual rendering::CameraPtr made();
  void publish(int64_t time_ns) override;
};

}  // namespace sensors
}  // namespace gazebo
