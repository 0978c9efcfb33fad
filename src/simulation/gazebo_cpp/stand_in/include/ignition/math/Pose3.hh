#pragma once
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// A + B: where A is, when A is written in the frame B; A - B: A as B sees it; A * B: B as written in the frame A.
template <typename T>
class Pose3
{
public:
  static const Pose3 Zero;

  Pose3() : p_(0, 0, 0), q_(1, 0, 0, 0) {}
  Pose3(const Vector3<T>& position, const Quaternion<T>& rotation) : p_(position), q_(rotation) {}
  Pose3(T x, T y, T z, T roll, T pitch, T yaw) : p_(x, y, z), q_(roll, pitch, yaw) {}
  Pose3(T x, T y, T z, T qw, T qx, T qy, T qz) : p_(x, y, z), q_(qw, qx, qy, qz) {}
  Pose3(const Pose3& pose) = default;
  virtual ~Pose3() = default;
  Pose3& operator=(const Pose3& pose) = default;

  void Set(const Vector3<T>& position, const Quaternion<T>& rotation) { *this = Pose3(position, rotation); }
  void Set(const Vector3<T>& position, const Vector3<T>& rpy) { *this = Pose3(position, Quaternion<T>(rpy)); }
  void Set(T x, T y, T z, T roll, T pitch, T yaw) { *this = Pose3(x, y, z, roll, pitch, yaw); }
  void Reset() { *this = Pose3(); }
  bool IsFinite() const { return p_.IsFinite() && q_.IsFinite(); }
  void Correct()
  {
    p_.Correct();
    q_.Correct();
  }
  void Round(int digits)
  {
    p_.Round(digits);
    q_.Round(digits);
  }

  Pose3 Inverse() const
  {
    const Quaternion<T> back = q_.Inverse();
    return Pose3(back * (p_ * -1), back);
  }
  Pose3 operator+(const Pose3& b) const { return Pose3(CoordPositionAdd(b), CoordRotationAdd(b.q_)); }
  Pose3 operator-() const { return Inverse(); }
  Pose3 operator-(const Pose3& b) const { return Pose3(CoordPositionSub(b), CoordRotationSub(b.q_)); }
  Pose3 operator*(const Pose3& b) const { return Pose3(b.CoordPositionAdd(*this), q_ * b.q_); }
  const Pose3& operator+=(const Pose3& b) { return *this = *this + b; }
  const Pose3& operator-=(const Pose3& b) { return *this = *this - b; }
  const Pose3& operator*=(const Pose3& b) { return *this = *this * b; }
  bool operator==(const Pose3& b) const { return p_ == b.p_ && q_ == b.q_; }
  bool operator!=(const Pose3& b) const { return !(*this == b); }

  /// A place in this frame, outside of it.
  Vector3<T> CoordPositionAdd(const Vector3<T>& place) const { return p_ + q_.RotateVector(place); }
  Vector3<T> CoordPositionAdd(const Pose3& b) const { return b.p_ + b.q_.RotateVector(p_); }
  Vector3<T> CoordPositionSub(const Pose3& b) const { return b.q_.RotateVectorReverse(p_ - b.p_); }
  Quaternion<T> CoordRotationAdd(const Quaternion<T>& rotation) const { return rotation * q_; }
  Quaternion<T> CoordRotationSub(const Quaternion<T>& rotation) const { return (rotation.Inverse() * q_).Normalized(); }
  /// What leads from this to b.
  Pose3 CoordPoseSolve(const Pose3& b) const
  {
    const Quaternion<T> rotation = q_.Inverse() * b.q_;
    return Pose3(b.p_ - rotation.RotateVector(p_), rotation);
  }
  Pose3 RotatePositionAboutOrigin(const Quaternion<T>& q) const
  {
    const Vector3<T> x = q.XAxis(), y = q.YAxis(), z = q.ZAxis();
    return Pose3(Vector3<T>(x.Dot(p_), y.Dot(p_), z.Dot(p_)), q_);
  }

  const Vector3<T>& Pos() const { return p_; }
  Vector3<T>& Pos() { return p_; }
  const Quaternion<T>& Rot() const { return q_; }
  Quaternion<T>& Rot() { return q_; }
  T X() const { return p_.X(); }
  T Y() const { return p_.Y(); }
  T Z() const { return p_.Z(); }
  void SetX(T x) { p_.X() = x; }
  void SetY(T y) { p_.Y() = y; }
  void SetZ(T z) { p_.Z() = z; }
  T Roll() const { return q_.Roll(); }
  T Pitch() const { return q_.Pitch(); }
  T Yaw() const { return q_.Yaw(); }

  friend std::ostream& operator<<(std::ostream& out, const Pose3& pose) { return out << pose.p_ << " " << pose.q_; }
  friend std::istream& operator>>(std::istream& in, Pose3& pose)
  {
    in.setf(std::ios_base::skipws);
    return in >> pose.p_ >> pose.q_;
  }

private:
  Vector3<T> p_;
  Quaternion<T> q_;
};

template <typename T>
const Pose3<T> Pose3<T>::Zero(0, 0, 0, 0, 0, 0);

typedef Pose3<int> Pose3i;
typedef Pose3<double> Pose3d;
typedef Pose3<float> Pose3f;

}  // namespace v6
}  // namespace math
}  // namespace ignition
