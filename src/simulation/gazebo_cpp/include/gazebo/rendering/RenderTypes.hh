// Names alone: nothing of rendering can be called from plugins here.
#pragma once
#include <memory>

#include <boost/shared_ptr.hpp>

namespace gazebo
{
namespace rendering
{
class Visual;
class Scene;
class Camera;
class DepthCamera;
typedef std::shared_ptr<Visual> VisualPtr;
typedef boost::shared_ptr<Scene> ScenePtr;
typedef boost::shared_ptr<Camera> CameraPtr;
typedef boost::shared_ptr<DepthCamera> DepthCameraPtr;
}  // namespace rendering
}  // namespace gazebo
