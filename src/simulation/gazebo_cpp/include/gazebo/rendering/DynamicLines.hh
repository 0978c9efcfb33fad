// For plugins that draw: see Visual.hh.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <ignition/math/Color.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/rendering/RenderTypes.hh>
#include <gazebo/util/system.hh>

namespace gazebo
{
namespace rendering
{

/// Keeps its points; nothing draws them.
class GAZEBO_VISIBLE DynamicLines
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

private:
  std::vector<ignition::math::Vector3d> points_;
};

}  // namespace rendering
}  // namespace gazebo
