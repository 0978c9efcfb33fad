// Names alone, for plugins of visuals: see Visual.hh.
#pragma once
#include <cstdint>
#include <string>

#include <ignition/math/Color.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/rendering/RenderTypes.hh>

namespace gazebo
{
namespace rendering
{

class DynamicLines
{
public:
  explicit DynamicLines(RenderOpType type = RENDERING_LINE_STRIP);
  virtual ~DynamicLines();
  void AddPoint(const ignition::math::Vector3d& point, const ignition::math::Color& color = ignition::math::Color::White);
  void AddPoint(double x, double y, double z, const ignition::math::Color& color = ignition::math::Color::White);
  void SetPoint(unsigned int index, const ignition::math::Vector3d& point);
  void SetColor(unsigned int index, const ignition::math::Color& color);
  ignition::math::Vector3d Point(unsigned int index) const;
  unsigned int GetPointCount() const;
  void Clear();
  void Update();
  void setMaterial(const std::string& name);
  void setVisibilityFlags(uint32_t flags);
};

}  // namespace rendering
}  // namespace gazebo
