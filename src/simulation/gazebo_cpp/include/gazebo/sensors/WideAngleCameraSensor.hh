#pragma once
#include <gazebo/rendering/WideAngleCamera.hh>
#include <gazebo/sensors/CameraSensor.hh>

namespace gazebo
{
namespace sensors
{

/// <sensor type="wideanglecamera">: its lens is not drawn, and one line says so.
class GAZEBO_VISIBLE WideAngleCameraSensor : public CameraSensor
{
public:
  ~WideAngleCameraSensor() override;

protected:
  rendering::CameraPtr made() override;
  void Measure() override;
};

}  // namespace sensors
}  // namespace gazebo
