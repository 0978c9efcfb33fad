#pragma once
#include <memory>

#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/common/common.hh>

namespace gazebo
{
namespace physics
{

class GAZEBO_VISIBLE FrictionPyramid
{
public:
  explicit FrictionPyramid(std::shared_ptr<ode_sim::Shape> core) : core_(std::move(core)) {}
  double MuPrimary();
  double MuSecondary();
  void SetMuPrimary(double mu);
  void SetMuSecondary(double mu);
  // Torsional friction, about the normal of a contact.
  double MuTorsion();
  bool UsePatchRadius();
  double PatchRadius();    // m
  double SurfaceRadius();  // m
  void SetMuTorsion(double mu);
  void SetUsePatchRadius(bool use);
  void SetPatchRadius(double radius);
  void SetSurfaceRadius(double radius);

private:
  std::shared_ptr<ode_sim::Shape> core_;
};

class GAZEBO_VISIBLE SurfaceParams
{
public:
  explicit SurfaceParams(std::shared_ptr<ode_sim::Shape> core);
  virtual ~SurfaceParams() = default;
  virtual FrictionPyramidPtr FrictionPyramid() const { return pyramid_; }
  bool collideWithoutContact = false;
  unsigned int collideWithoutContactBitmask = 1;
  unsigned int collideBitmask = 0xFFFF;

private:
  FrictionPyramidPtr pyramid_;
};

}  // namespace physics
}  // namespace gazebo
