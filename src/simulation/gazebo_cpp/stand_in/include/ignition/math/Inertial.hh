#pragma once
#include <ignition/math/MassMatrix3.hh>
#include <ignition/math/Pose3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// A mass matrix, and where its centre and axes are.
template <typename T>
class Inertial
{
public:
  Inertial() = default;
  Inertial(const MassMatrix3<T>& m, const Pose3<T>& pose) : mass_(m), pose_(pose) {}
  Inertial(const Inertial& inertial) = default;
  virtual ~Inertial() = default;
  Inertial& operator=(const Inertial& inertial) = default;

  bool SetMassMatrix(const MassMatrix3<T>& m, const T tolerance = IGN_MASSMATRIX3_DEFAULT_TOLERANCE<T>)
  {
    mass_ = m;
    return mass_.IsValid(tolerance);
  }
  const MassMatrix3<T>& MassMatrix() const { return mass_; }
  bool SetPose(const Pose3<T>& pose)
  {
    pose_ = pose;
    return mass_.IsValid();
  }
  const Pose3<T>& Pose() const { return pose_; }
  /// In the axes of the frame in which the pose is.
  Matrix3<T> Moi() const
  {
    const Matrix3<T> m(pose_.Rot());
    return m * mass_.Moi() * m.Transposed();
  }
  Matrix3<T> MOI() const { return Moi(); }
  /// Other axes, the same body.
  bool SetInertialRotation(const Quaternion<T>& q)
  {
    const Matrix3<T> moi = Moi(), m(q);
    pose_.Rot() = q;
    return mass_.SetMoi(m.Transposed() * moi * m);
  }
  bool SetMassMatrixRotation(const Quaternion<T>& q, const T tolerance = 1e-6)
  {
    pose_.Rot() *= mass_.PrincipalAxesOffset(tolerance) * q.Inverse();
    const Vector3<T> moments = mass_.PrincipalMoments(tolerance);
    const Matrix3<T> m(q);
    return mass_.SetMoi(m * Matrix3<T>(moments[0], 0, 0, 0, moments[1], 0, 0, 0, moments[2]) * m.Transposed());
  }
  bool operator==(const Inertial& other) const { return pose_ == other.pose_ && mass_ == other.mass_; }
  bool operator!=(const Inertial& other) const { return !(*this == other); }
  /// Of both bodies together; the axes become those of the frame.
  Inertial& operator+=(const Inertial& other)
  {
    const T first = mass_.Mass(), second = other.mass_.Mass(), both = first + second;
    if (both <= 0)
      return *this;
    const Vector3<T> centre = (pose_.Pos() * first + other.pose_.Pos() * second) / both;
    const Matrix3<T> moi = Moi() + moved(first, pose_.Pos() - centre) + other.Moi() + moved(second, other.pose_.Pos() - centre);
    mass_ = MassMatrix3<T>(both, Vector3<T>(moi(0, 0), moi(1, 1), moi(2, 2)), Vector3<T>(moi(0, 1), moi(0, 2), moi(1, 2)));
    pose_ = Pose3<T>(centre, Quaternion<T>::Identity);
    return *this;
  }
  const Inertial operator+(const Inertial& other) const
  {
    Inertial result(*this);
    result += other;
    return result;
  }

private:
  /// What a mass adds that is so far away.
  static Matrix3<T> moved(T mass, const Vector3<T>& by)
  {
    const T x = by.X(), y = by.Y(), z = by.Z();
    return Matrix3<T>(y * y + z * z, -x * y, -x * z, -x * y, z * z + x * x, -y * z, -x * z, -y * z, x * x + y * y) * mass;
  }

  MassMatrix3<T> mass_;
  Pose3<T> pose_;
};

typedef Inertial<double> Inertiald;
typedef Inertial<float> Inertialf;

}  // namespace v6
}  // namespace math
}  // namespace ignition
