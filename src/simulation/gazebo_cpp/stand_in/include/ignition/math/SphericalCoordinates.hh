#pragma once
#include <string>

#include <ignition/math/Angle.hh>
#include <ignition/math/Matrix3.hh>
#include <ignition/math/Vector3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// Places on the earth, as the ellipsoid WGS84 has it, and around a reference that stands on it. Spherical coordinates of positions are
/// latitude and longitude (degrees outside, radians inside of PositionTransform) and height; local axes are turned by the heading.
class IGNITION_MATH_VISIBLE SphericalCoordinates
{
public:
  enum SurfaceType
  {
    EARTH_WGS84 = 1
  };
  enum CoordinateType
  {
    SPHERICAL = 1,
    ECEF = 2,
    GLOBAL = 3,
    LOCAL = 4,
    LOCAL2 = 5
  };

  SphericalCoordinates() : SphericalCoordinates(EARTH_WGS84) {}
  explicit SphericalCoordinates(SurfaceType type) : surface_(type) { UpdateTransformationMatrix(); }
  SphericalCoordinates(SurfaceType type, const Angle& latitude, const Angle& longitude, double elevation, const Angle& heading)
    : surface_(type)
    , latitude_(latitude)
    , longitude_(longitude)
    , heading_(heading)
    , elevation_(elevation)
  {
    UpdateTransformationMatrix();
  }
  SphericalCoordinates(const SphericalCoordinates& other) = default;
  ~SphericalCoordinates() = default;
  SphericalCoordinates& operator=(const SphericalCoordinates& other) = default;

  Vector3d SphericalFromLocalPosition(const Vector3d& xyz) const;
  Vector3d GlobalFromLocalVelocity(const Vector3d& xyz) const { return VelocityTransform(xyz, LOCAL, GLOBAL); }
  Vector3d LocalFromSphericalPosition(const Vector3d& place) const;
  Vector3d LocalFromGlobalVelocity(const Vector3d& xyz) const { return VelocityTransform(xyz, GLOBAL, LOCAL); }
  Vector3d PositionTransform(const Vector3d& position, const CoordinateType& in, const CoordinateType& out) const;
  Vector3d VelocityTransform(const Vector3d& velocity, const CoordinateType& in, const CoordinateType& out) const;
  void UpdateTransformationMatrix();
  static SurfaceType Convert(const std::string& text);
  static std::string Convert(SurfaceType type);
  /// Along the ground, as on a ball.
  static double Distance(const Angle& latA, const Angle& lonA, const Angle& latB, const Angle& lonB);

  SurfaceType Surface() const { return surface_; }
  Angle LatitudeReference() const { return latitude_; }
  Angle LongitudeReference() const { return longitude_; }
  double ElevationReference() const { return elevation_; }
  Angle HeadingOffset() const { return heading_; }
  void SetSurface(const SurfaceType& type) { surface_ = type; }
  void SetLatitudeReference(const Angle& angle)
  {
    latitude_ = angle;
    UpdateTransformationMatrix();
  }
  void SetLongitudeReference(const Angle& angle)
  {
    longitude_ = angle;
    UpdateTransformationMatrix();
  }
  void SetElevationReference(double elevation)
  {
    elevation_ = elevation;
    UpdateTransformationMatrix();
  }
  void SetHeadingOffset(const Angle& angle)
  {
    heading_ = angle;
    UpdateTransformationMatrix();
  }
  bool operator==(const SphericalCoordinates& other) const;
  bool operator!=(const SphericalCoordinates& other) const { return !(*this == other); }

private:
  SurfaceType surface_ = EARTH_WGS84;
  Angle latitude_, longitude_, heading_;
  double elevation_ = 0;
  Matrix3d to_global_;  // from earth-centred axes to east, north, up
  Vector3d origin_;     // the reference, earth-centred
};

}  // namespace v6
}  // namespace math
}  // namespace ignition
