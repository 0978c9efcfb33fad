#pragma once
#include <string>
#include <vector>

#include <gazebo/rendering/Camera.hh>
#include <gazebo/sensors/PictureSensor.hh>

namespace gazebo
{
namespace sensors
{

/// <sensor type="multicamera">: the pictures of all its cameras are of one moment.
class GAZEBO_VISIBLE MultiCameraSensor : public PictureSensor
{
public:
  MultiCameraSensor();
  ~MultiCameraSensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  unsigned int CameraCount() const { return static_cast<unsigned int>(cameraCount()); }
  rendering::CameraPtr Camera(unsigned int index) const { return camera(index); }  // null beyond their number
  unsigned int ImageWidth(unsigned int index) const;
  unsigned int ImageHeight(unsigned int index) const;
  const unsigned char* ImageData(unsigned int index);
  bool SaveFrame(const std::vector<std::string>& files);

protected:
  void publish(int64_t time_ns) override;
};

}  // namespace sensors
}  // namespace gazebo
