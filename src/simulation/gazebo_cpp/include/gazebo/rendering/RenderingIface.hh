#pragma once
#include <string>

#include <gazebo/rendering/RenderTypes.hh>
#include <gazebo/util/system.hh>

namespace gazebo
{
namespace rendering
{

/// What cameras see of the world; null before there is a world.
GAZEBO_VISIBLE ScenePtr get_scene(const std::string& name = "");

}  // namespace rendering
}  // namespace gazebo
