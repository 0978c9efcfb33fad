#pragma once
#include <gazebo/rendering/DepthCamera.hh>
#include <gazebo/sensors/CameraSensor.hh>

namespace gazebo
{
namespace sensors
{

/// <sensor type="depth">.
class GAZEBO_VISIBLE DepthCameraSensor : public CameraSensor
{
public:
  ~DepthCameraSensor() override;
  virtual rendering::DepthCameraPtr DepthCamera() const
  {
    return boost::dynamic_pointer_cast<rendering::DepthCamera>(Camera());
  }
  virtual const float* DepthData() const { return DepthCamera()->DepthData(); }

protected:
  rendering::CameraPtr made() override;
};

}  // namespace sensors
}  // namespace gazebo
