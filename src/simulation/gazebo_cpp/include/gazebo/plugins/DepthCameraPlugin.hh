#pragma once
#include <string>

#include <gazebo/common/Plugin.hh>
#include <gazebo/rendering/DepthCamera.hh>
#include <gazebo/sensors/DepthCameraSensor.hh>

namespace gazebo
{

/// To be derived from: called with the depths, then with the picture, of each measurement of the depth camera that it stands in; with
/// points in place of depths where its <output> says so. Reflectances and normals are never drawn.
class GAZEBO_VISIBLE DepthCameraPlugin : public SensorPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override;
  virtual void OnNewDepthFrame(const float* depths, unsigned int width, unsigned int height, unsigned int depth,
                               const std::string& format);
  virtual void OnNewRGBPointCloud(const float* points, unsigned int width, unsigned int height, unsigned int depth,
                                  const std::string& format);
  virtual void OnNewImageFrame(const unsigned char* image, unsigned int width, unsigned int height, unsigned int depth,
                               const std::string& format);
  virtual void OnNewReflectanceFrame(const float* image, unsigned int width, unsigned int height, unsigned int depth,
                                     const std::string& format);
  virtual void OnNewNormalsFrame(const float* normals, unsigned int width, unsigned int height, unsigned int depth,
                                 const std::string& format);

protected:
  unsigned int width = 0, height = 0, depth = 0;
  std::string format;
  sensors::DepthCameraSensorPtr parentSensor;
  rendering::DepthCameraPtr depthCamera;
  event::ConnectionPtr newDepthFrameConnection, newRGBPointCloudConnection, newImageFrameConnection,
      newReflectanceFrameConnection, newNormalsFrameConnection;
};

}  // namespace gazebo
