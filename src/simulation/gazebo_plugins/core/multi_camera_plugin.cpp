#include <gazebo_plugins/MultiCameraPlugin.h>

#include <stdexcept>

namespace gazebo
{

MultiCameraPlugin::MultiCameraPlugin() = default;
MultiCameraPlugin::~MultiCameraPlugin() = default;

void MultiCameraPlugin::Load(sensors::SensorPtr sensor, sdf::ElementPtr)
{
  parentSensor = std::dynamic_pointer_cast<sensors::MultiCameraSensor>(sensor);
  if (!parentSensor)
    throw std::runtime_error("a MultiCameraPlugin belongs into a sensor of type multicamera; " + sensor->Name() +
                             " is of type " + sensor->Type());
  for (unsigned int i = 0; i < parentSensor->CameraCount(); ++i)
  {
    const rendering::CameraPtr each = parentSensor->Camera(i);
    camera.push_back(each);
    width.push_back(each->ImageWidth()), height.push_back(each->ImageHeight());
    depth.push_back(each->ImageDepth()), format.push_back(each->ImageFormat());
    if (each->Name().find("left") != std::string::npos)
      newFrameConnection.push_back(each->ConnectNewImageFrame([this](const auto&... all) { OnNewFrameLeft(all...); }));
    else if (each->Name().find("right") != std::string::npos)
      newFrameConnection.push_back(each->ConnectNewImageFrame([this](const auto&... all) { OnNewFrameRight(all...); }));
  }
  parentSensor->SetActive(true);
}

void MultiCameraPlugin::OnNewFrameLeft(const unsigned char*, unsigned int, unsigned int, unsigned int, const std::string&) {}
void MultiCameraPlugin::OnNewFrameRight(const unsigned char*, unsigned int, unsigned int, unsigned int, const std::string&) {}

GZ_REGISTER_SENSOR_PLUGIN(MultiCameraPlugin)

}  // namespace gazebo
