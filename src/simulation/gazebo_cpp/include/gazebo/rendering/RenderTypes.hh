#pragma once
#include <memory>

#include <boost/shared_ptr.hpp>

#define GZ_VISIBILITY_ALL 0x0FFFFFFF
#define GZ_VISIBILITY_SELECTION 0x10000000
#define GZ_VISIBILITY_GUI 0x20000000
#define GZ_VISIBILITY_SELECTABLE 0x40000000

namespace gazebo
{
namespace rendering
{
class Visual;
class Scene;
class DynamicLines;
class Camera;
class DepthCamera;
class WideAngleCamera;
class Distortion;
class UserCamera;
class GpuLaser;
class Light;
typedef std::shared_ptr<Visual> VisualPtr;
typedef std::weak_ptr<Visual> VisualWeakPtr;
typedef boost::shared_ptr<Scene> ScenePtr;
typedef std::shared_ptr<DynamicLines> DynamicLinesPtr;
typedef boost::shared_ptr<Camera> CameraPtr;
typedef boost::shared_ptr<DepthCamera> DepthCameraPtr;
typedef boost::shared_ptr<WideAngleCamera> WideAngleCameraPtr;
typedef boost::shared_ptr<Distortion> DistortionPtr;
typedef boost::shared_ptr<UserCamera> UserCameraPtr;
typedef boost::shared_ptr<GpuLaser> GpuLaserPtr;
typedef boost::shared_ptr<Light> LightPtr;

enum RenderOpType
{
  RENDERING_POINT_LIST = 0,
  RENDERING_LINE_LIST = 1,
  RENDERING_LINE_STRIP = 2,
  RENDERING_TRIANGLE_LIST = 3,
  RENDERING_TRIANGLE_STRIP = 4,
  RENDERING_TRIANGLE_FAN = 5,
  RENDERING_MESH_RESOURCE = 6
};
}  // namespace rendering
}  // namespace gazebo
