#pragma once
#include <memory>

#include <gazebo/physics/Entity.hh>
#include <gazebo/physics/SurfaceParams.hh>

namespace gazebo
{
namespace physics
{

class GAZEBO_VISIBLE Collision : public Entity
{
public:
  explicit Collision(LinkPtr link);
  const ignition::math::Pose3d& WorldPose() const override;
  void SetInitialRelativePose(const ignition::math::Pose3d& pose);  // and there it is
  ignition::math::AxisAlignedBox BoundingBox() const override;
  ignition::math::Vector3d WorldLinearVel() const override;
  ignition::math::Vector3d WorldAngularVel() const override;
  LinkPtr GetLink() const;
  ModelPtr GetModel() const;
  ShapePtr GetShape() const { return shape_; }
  void SetShape(ShapePtr shape) { shape_ = shape; }  // of one that a plugin has made; the simulator's keep theirs in the world
  unsigned int GetShapeType() const;
  SurfaceParamsPtr GetSurface() const { return surface_; }
  virtual void SetCategoryBits(unsigned int) {}
  virtual void SetCollideBits(unsigned int bits);
  void SetLaserRetro(float retro) { retro_ = retro; }
  float GetLaserRetro() const { return retro_; }
  unsigned int GetMaxContacts();
  virtual void SetMaxContacts(unsigned int most);
  bool IsPlaceable() const { return !IsStatic(); }
  virtual void FillMsg(msgs::Collision& message);
  std::shared_ptr<ode_sim::Shape> Core() const { return core_; }

protected:
  void place(const ignition::math::Pose3d& X_WC) override;

private:
  friend class Mirror;
  std::shared_ptr<ode_sim::Shape> core_;
  ShapePtr shape_;
  SurfaceParamsPtr surface_;
  float retro_ = 0;
  ignition::math::Pose3d X_LC_;  // of one that a plugin has made
};

}  // namespace physics
}  // namespace gazebo
