#pragma once
#include <string>
#include <vector>

#include <gazebo/common/Plugin.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/rendering/Camera.hh>
#include <gazebo/sensors/MultiCameraSensor.hh>

namespace gazebo
{

/// To be derived from: called with each picture of a camera with "left" or "right" in its name, of the sensor that it stands in.
class GAZEBO_VISIBLE MultiCameraPlugin : public SensorPlugin
{
public:
  MultiCameraPlugin();
  ~MultiCameraPlugin() override;
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override;
  virtual void OnNewFrameLeft(const unsigned char* image, unsigned int width, unsigned int height, unsigned int depth,
                              const std::string& format);
  virtual void OnNewFrameRight(const unsigned char* image, unsigned int width, unsigned int height, unsigned int depth,
                               const std::string& format);

protected:
  sensors::MultiCameraSensorPtr parentSensor;
  std::vector<unsigned int> width, height, depth;
  std::vector<std::string> format;
  std::vector<rendering::CameraPtr> camera;

private:
  std::vector<event::ConnectionPtr> newFrameConnection;
};

}  // namespace gazebo
