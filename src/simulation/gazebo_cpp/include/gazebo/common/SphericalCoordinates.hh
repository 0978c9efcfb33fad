#pragma once
#include <string>

#include <ignition/math/Angle.hh>
#include <ignition/math/SphericalCoordinates.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/common/CommonTypes.hh>

namespace gazebo
{
namespace common
{

/// The world's place on the earth: that of ignition::math, under the names of Gazebo.
class GAZEBO_VISIBLE SphericalCoordinates
{
  using Ign = ignition::math::SphericalCoordinates;

public:
  enum SurfaceType
  {
    EARTH_WGS84 = 1
  };
  enum CoordinateType
  {
    SPHERICAL = 1,
    ECEF,
    GLOBAL,
    LOCAL
  };

  SphericalCoordinates() : ign_(Ign::EARTH_WGS84) {}
  explicit SphericalCoordinates(SurfaceType) : SphericalCoordinates() {}
  SphericalCoordinates(SurfaceType, const ignition::math::Angle& latitude, const ignition::math::Angle& longitude,
                       double elevation, const ignition::math::Angle& heading)
    : ign_(Ign::EARTH_WGS84, latitude, longitude, elevation, heading)
  {
  }
  ignition::math::Vector3d SphericalFromLocal(const ignition::math::Vector3d& p) const
  {
    return ign_.SphericalFromLocalPosition(p);
  }
  ignition::math::Vector3d GlobalFromLocal(const ignition::math::Vector3d& v) const { return ign_.GlobalFromLocalVelocity(v); }
  ignition::math::Vector3d LocalFromSpherical(const ignition::math::Vector3d& p) const
  {
    return ign_.LocalFromSphericalPosition(p);
  }
  ignition::math::Vector3d LocalFromGlobal(const ignition::math::Vector3d& v) const { return ign_.LocalFromGlobalVelocity(v); }
  static SurfaceType Convert(const std::string&) { return EARTH_WGS84; }
  static double Distance(const ignition::math::Angle& latA, const ignition::math::Angle& lonA,
                         const ignition::math::Angle& latB, const ignition::math::Angle& lonB)
  {
    return Ign::Distance(latA, lonA, latB, lonB);
  }
  SurfaceType GetSurfaceType() const { return EARTH_WGS84; }
  ignition::math::Angle LatitudeReference() const { return ign_.LatitudeReference(); }
  ignition::math::Angle LongitudeReference() const { return ign_.LongitudeReference(); }
  double GetElevationReference() const { return ign_.ElevationReference(); }
  ignition::math::Angle HeadingOffset() const { return ign_.HeadingOffset(); }
  void SetSurfaceType(const SurfaceType&) {}
  void SetLatitudeReference(const ignition::math::Angle& angle) { ign_.SetLatitudeReference(angle); }
  void SetLongitudeReference(const ignition::math::Angle& angle) { ign_.SetLongitudeReference(angle); }
  void SetElevationReference(double elevation) { ign_.SetElevationReference(elevation); }
  void SetHeadingOffset(const ignition::math::Angle& angle) { ign_.SetHeadingOffset(angle); }
  void UpdateTransformationMatrix() { ign_.UpdateTransformationMatrix(); }
  ignition::math::Vector3d PositionTransform(const ignition::math::Vector3d& p, const CoordinateType& in,
                                             const CoordinateType& out) const
  {
    return ign_.PositionTransform(p, static_cast<Ign::CoordinateType>(in), static_cast<Ign::CoordinateType>(out));
  }
  ignition::math::Vector3d VelocityTransform(const ignition::math::Vector3d& v, const CoordinateType& in,
                                             const CoordinateType& out) const
  {
    return ign_.VelocityTransform(v, static_cast<Ign::CoordinateType>(in), static_cast<Ign::CoordinateType>(out));
  }

private:
  Ign ign_;
};

}  // namespace common
}  // namespace gazebo
