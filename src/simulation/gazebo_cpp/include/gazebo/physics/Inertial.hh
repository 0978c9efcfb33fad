#pragma once
#include <ignition/math/Inertial.hh>
#include <ignition/math/Matrix3.hh>
#include <ignition/math/Pose3.hh>
#include <sdf/sdf.hh>

#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/common/common.hh>

namespace gazebo
{
namespace physics
{

/// Mass (kg), centre of mass (m, link frame) and moments about it (kg m^2). What is set counts from Link::UpdateMass() on.
class GAZEBO_VISIBLE Inertial
{
public:
  Inertial() = default;
  explicit Inertial(double mass) : mass_(mass) {}
  Inertial(const ignition::math::Inertiald& inertial);
  void Load(sdf::ElementPtr sdf);
  void UpdateParameters(sdf::ElementPtr sdf) { Load(sdf); }
  void Reset() {}
  ignition::math::Inertiald Ign() const;
  void SetMass(double mass) { mass_ = mass; }
  double Mass() const { return mass_; }
  void SetInertiaMatrix(double ixx, double iyy, double izz, double ixy, double ixz, double iyz)
  {
    principals_.Set(ixx, iyy, izz), products_.Set(ixy, ixz, iyz);
  }
  void SetCoG(double x, double y, double z) { cog_.Pos().Set(x, y, z), com_ = cog_.Pos(); }
  void SetCoG(const ignition::math::Vector3d& center) { cog_.Pos() = com_ = center; }
  void SetCoG(double x, double y, double z, double roll, double pitch, double yaw) { SetCoG({ x, y, z, roll, pitch, yaw }); }
  void SetCoG(const ignition::math::Pose3d& pose) { cog_ = pose, com_ = pose.Pos(); }
  const ignition::math::Vector3d& CoG() const { return com_; }
  ignition::math::Pose3d Pose() const { return cog_; }
  const ignition::math::Vector3d& PrincipalMoments() const { return principals_; }
  const ignition::math::Vector3d& ProductsOfInertia() const { return products_; }
  double IXX() const { return principals_.X(); }
  double IYY() const { return principals_.Y(); }
  double IZZ() const { return principals_.Z(); }
  double IXY() const { return products_.X(); }
  double IXZ() const { return products_.Y(); }
  double IYZ() const { return products_.Z(); }
  void SetIXX(double v) { principals_.X(v); }
  void SetIYY(double v) { principals_.Y(v); }
  void SetIZZ(double v) { principals_.Z(v); }
  void SetIXY(double v) { products_.X(v); }
  void SetIXZ(double v) { products_.Y(v); }
  void SetIYZ(double v) { products_.Z(v); }
  void Rotate(const ignition::math::Quaterniond& rotation);
  ignition::math::Matrix3d MOI() const;
  ignition::math::Matrix3d MOI(const ignition::math::Pose3d& pose) const;  // about the origin of that frame, in its axes
  void SetMOI(const ignition::math::Matrix3d& moi);
  Inertial operator+(const Inertial& other) const { return Inertial(Ign() + other.Ign()); }
  const Inertial& operator+=(const Inertial& other) { return *this = *this + other; }

private:
  double mass_ = 1;
  ignition::math::Pose3d cog_;
  ignition::math::Vector3d com_, principals_{ 1, 1, 1 }, products_;
};

}  // namespace physics
}  // namespace gazebo
