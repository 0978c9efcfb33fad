// Bases of plugins of one kind of sensor, and their libraries' entry points: alone they do nothing but keep the sensor measuring.
#include <stdexcept>

#include <gazebo/physics/physics.hh>
#include <gazebo/plugins/CameraPlugin.hh>
#include <gazebo/plugins/ContactPlugin.hh>
#include <gazebo/plugins/DepthCameraPlugin.hh>
#include <gazebo/plugins/GpuRayPlugin.hh>
#include <gazebo/plugins/ImuSensorPlugin.hh>
#include <gazebo/plugins/RayPlugin.hh>

namespace gazebo
{
namespace
{

template <class Kind>
std::shared_ptr<Kind> as(const sensors::SensorPtr& sensor, const char* plugin, const char* kind)
{
  const auto found = std::dynamic_pointer_cast<Kind>(sensor);
  if (!found)
    throw std::runtime_error(std::string("a ") + plugin + " belongs into a sensor of type " + kind + "; " + sensor->Name() +
                             " is of type " + sensor->Type());
  return found;
}

}  // namespace

void RayPlugin::Load(sensors::SensorPtr sensor, sdf::ElementPtr)
{
  parentSensor = as<sensors::RaySensor>(sensor, "RayPlugin", "ray");
  world = physics::get_world(sensor->WorldName());
  connection_ = parentSensor->LaserShape()->ConnectNewLaserScans([this] { OnNewLaserScans(); });
}

void GpuRayPlugin::Load(sensors::SensorPtr sensor, sdf::ElementPtr)
{
  parentSensor = as<sensors::GpuRaySensor>(sensor, "GpuRayPlugin", "gpu_ray");
  width = static_cast<unsigned int>(parentSensor->RangeCount()),
  height = static_cast<unsigned int>(parentSensor->VerticalRangeCount());
  depth = 3, format = "FLOAT32";
  connection_ = parentSensor->ConnectNewLaserFrame([this](const float* data, unsigned int w, unsigned int h, unsigned int d,
                                                          const std::string& f) { OnNewLaserFrame(data, w, h, d, f); });
  parentSensor->SetActive(true);
}

void GpuRayPlugin::OnNewLaserFrame(const float*, unsigned int, unsigned int, unsigned int, const std::string&) {}

void ContactPlugin::Load(sensors::SensorPtr sensor, sdf::ElementPtr)
{
  parentSensor = as<sensors::ContactSensor>(sensor, "ContactPlugin", "contact");
  connection_ = parentSensor->ConnectUpdated([this] { OnUpdate(); });
}

void ImuSensorPlugin::Load(sensors::SensorPtr sensor, sdf::ElementPtr)
{
  parentSensor = as<sensors::ImuSensor>(sensor, "ImuSensorPlugin", "imu");
  connection_ = parentSensor->ConnectUpdated([this] { OnUpdate(parentSensor); });
}

void CameraPlugin::Load(sensors::SensorPtr sensor, sdf::ElementPtr)
{
  parentSensor = as<sensors::CameraSensor>(sensor, "CameraPlugin", "camera");
  camera = parentSensor->Camera();
  width = camera->ImageWidth(), height = camera->ImageHeight(), depth = camera->ImageDepth(), format = camera->ImageFormat();
  newFrameConnection =
      camera->ConnectNewImageFrame([this](const unsigned char* image, unsigned int w, unsigned int h, unsigned int d,
                                          const std::string& f) { OnNewFrame(image, w, h, d, f); });
  parentSensor->SetActive(true);
}

void CameraPlugin::OnNewFrame(const unsigned char*, unsigned int, unsigned int, unsigned int, const std::string&) {}

void DepthCameraPlugin::Load(sensors::SensorPtr sensor, sdf::ElementPtr)
{
  parentSensor = as<sensors::DepthCameraSensor>(sensor, "DepthCameraPlugin", "depth");
  depthCamera = parentSensor->DepthCamera();
  width = depthCamera->ImageWidth(), height = depthCamera->ImageHeight();
  depth = depthCamera->ImageDepth(), format = depthCamera->ImageFormat();
  newDepthFrameConnection = depthCamera->ConnectNewDepthFrame([this](const auto&... all) { OnNewDepthFrame(all...); });
  newRGBPointCloudConnection = depthCamera->ConnectNewRGBPointCloud([this](const auto&... all) { OnNewRGBPointCloud(all...); });
  newImageFrameConnection = depthCamera->ConnectNewImageFrame([this](const auto&... all) { OnNewImageFrame(all...); });
  newReflectanceFrameConnection =
      depthCamera->ConnectNewReflectanceFrame([this](const auto&... all) { OnNewReflectanceFrame(all...); });
  newNormalsFrameConnection =
      depthCamera->ConnectNewNormalsPointCloud([this](const auto&... all) { OnNewNormalsFrame(all...); });
  parentSensor->SetActive(true);
}

#define GZ_NOTHING(Method, Pixel) \
  void DepthCameraPlugin::Method(const Pixel*, unsigned int, unsigned int, unsigned int, const std::string&) {}
GZ_NOTHING(OnNewDepthFrame, float)
GZ_NOTHING(OnNewRGBPointCloud, float)
GZ_NOTHING(OnNewImageFrame, unsigned char)
GZ_NOTHING(OnNewReflectanceFrame, float)
GZ_NOTHING(OnNewNormalsFrame, float)
#undef GZ_NOTHING

}  // namespace gazebo
