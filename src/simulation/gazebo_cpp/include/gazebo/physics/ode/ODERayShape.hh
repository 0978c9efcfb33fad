#pragma once
#include <gazebo/ode/common.h>
#include <gazebo/physics/RayShape.hh>
#include <gazebo/physics/ode/ODETypes.hh>

namespace gazebo
{
namespace physics
{

/// A ray as a geom of ODE, in the space of its collision; Update() puts it where that is now.
class GAZEBO_VISIBLE ODERayShape : public RayShape
{
public:
  explicit ODERayShape(CollisionPtr collision);
  ~ODERayShape() override;
  void Update() override;
  void SetPoints(const ignition::math::Vector3d& start, const ignition::math::Vector3d& end) override;
  dGeomID ODEGeomId() const { return geomId; }

private:
  dGeomID geomId;
};

}  // namespace physics
}  // namespace gazebo
