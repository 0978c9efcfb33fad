// Names alone, for plugins of visuals: see Visual.hh.
#pragma once
#include <cstdint>
#include <string>

#include <gazebo/common/Time.hh>
#include <gazebo/rendering/RenderTypes.hh>

namespace gazebo
{
namespace rendering
{

class Scene
{
public:
  virtual ~Scene();
  std::string Name() const;
  common::Time SimTime() const;
  VisualPtr WorldVisual() const;
  VisualPtr GetVisual(const std::string& name) const;
  VisualPtr GetVisual(uint32_t id) const;
  uint32_t VisualCount() const;
  void AddVisual(VisualPtr visual);
  void RemoveVisual(VisualPtr visual);
};

}  // namespace rendering
}  // namespace gazebo
