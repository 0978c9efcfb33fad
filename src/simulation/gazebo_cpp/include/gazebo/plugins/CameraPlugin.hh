#pragma once
#include <string>

#include <gazebo/common/Plugin.hh>
#include <gazebo/rendering/Camera.hh>
#include <gazebo/sensors/CameraSensor.hh>

namespace gazebo
{

/// To be derived from: OnNewFrame() is called with each picture of the camera that it stands in.
class GAZEBO_VISIBLE CameraPlugin : public SensorPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override;
  virtual void OnNewFrame(const unsigned char* image, unsigned int width, unsigned int height, unsigned int depth,
                          const std::string& format);

protected:
  unsigned int width = 0, height = 0, depth = 0;
  std::string format;
  sensors::CameraSensorPtr parentSensor;
  rendering::CameraPtr camera;

private:
  event::ConnectionPtr newFrameConnection;
};

}  // namespace gazebo
