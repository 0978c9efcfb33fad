// What is drawn of a model, a link or a <visual>, as plugins ask for it: where it is. What plugins would have drawn otherwise (colours,
// lines) is left out with one line, and plugins of visuals, which only decorate, build and are not loaded.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <boost/weak_ptr.hpp>
#include <ignition/math/Color.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>
#include <sdf/sdf.hh>

#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/rendering/DynamicLines.hh>
#include <gazebo/rendering/RenderTypes.hh>
#include <gazebo/util/system.hh>
#include <gazebo/common/common.hh>

namespace gazebo
{
namespace rendering
{

class GAZEBO_VISIBLE Visual : public std::enable_shared_from_this<Visual>
{
public:
  /// \param X_EV in the frame of the entity, which it moves with
  Visual(const std::string& name, physics::EntityPtr entity, const ignition::math::Pose3d& X_EV, sdf::ElementPtr sdf);
  virtual ~Visual();
  std::string Name() const { return name_; }
  uint32_t GetId() const;
  ScenePtr GetScene() const;
  VisualPtr GetParent() const;
  VisualPtr GetRootVisual();
  unsigned int GetChildCount();
  VisualPtr GetChild(unsigned int index);
  void AttachVisual(VisualPtr visual);
  void DetachVisual(VisualPtr visual);
  sdf::ElementPtr GetSDF() const;
  void SetVisible(bool visible, bool cascade = true);
  bool GetVisible() const;
  void ToggleVisible();
  void SetVisibilityFlags(uint32_t flags);
  void SetCastShadows(bool shadows);
  void SetMaterial(const std::string& material, bool unique = true, bool cascade = true);
  std::string GetMaterialName() const;
  void SetAmbient(const ignition::math::Color& color, bool cascade = true);
  void SetDiffuse(const ignition::math::Color& color, bool cascade = true);
  void SetSpecular(const ignition::math::Color& color, bool cascade = true);
  void SetEmissive(const ignition::math::Color& color, bool cascade = true);
  void SetTransparency(float transparency, bool cascade = true);
  float GetTransparency();
  void SetScale(const ignition::math::Vector3d& scale);
  ignition::math::Vector3d Scale() const;
  void SetPose(const ignition::math::Pose3d& pose);
  ignition::math::Pose3d Pose() const;
  void SetPosition(const ignition::math::Vector3d& position);
  ignition::math::Vector3d Position() const;
  void SetRotation(const ignition::math::Quaterniond& rotation);
  ignition::math::Quaterniond Rotation() const;
  void SetWorldPose(const ignition::math::Pose3d& pose);
  ignition::math::Pose3d WorldPose() const;
  DynamicLines* CreateDynamicLine(RenderOpType type = RENDERING_LINE_STRIP);
  void DeleteDynamicLine(DynamicLines* line);

private:
  std::string name_;
  boost::weak_ptr<physics::Entity> entity_;
  ignition::math::Pose3d X_EV_;
  sdf::ElementPtr sdf_;
  std::vector<std::unique_ptr<DynamicLines>> lines_;
};

}  // namespace rendering
}  // namespace gazebo
