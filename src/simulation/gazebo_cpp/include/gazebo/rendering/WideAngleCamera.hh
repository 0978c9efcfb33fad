#pragma once
#include <gazebo/rendering/Camera.hh>

namespace gazebo
{
namespace rendering
{

/// Its lens is not drawn: its pictures are those of a camera without one.
class GAZEBO_VISIBLE WideAngleCamera : public Camera
{
public:
  using Camera::Camera;
};

}  // namespace rendering
}  // namespace gazebo
