#pragma once
#include <ignition/math/Helpers.hh>
#include <ignition/math/Matrix3.hh>
#include <ignition/math/Vector3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

template <typename T>
class Matrix3;

/// A rotation; angles are about fixed axes: roll about x, then pitch about y, then yaw about z.
template <typename T>
class Quaternion
{
public:
  static const Quaternion Identity, Zero;

  Quaternion() = default;
  Quaternion(const T& w, const T& x, const T& y, const T& z) : w_(w), x_(x), y_(y), z_(z) {}
  Quaternion(const T& roll, const T& pitch, const T& yaw) { Euler(roll, pitch, yaw); }
  Quaternion(const Vector3<T>& axis, const T& angle) { Axis(axis, angle); }
  explicit Quaternion(const Vector3<T>& rpy) { Euler(rpy); }
  explicit Quaternion(const Matrix3<T>& m);
  Quaternion(const Quaternion& q) = default;
  Quaternion& operator=(const Quaternion& q) = default;

  void Set(T w, T x, T y, T z) { *this = Quaternion(w, x, y, z); }
  void Axis(T x, T y, T z, T angle);
  void Axis(const Vector3<T>& axis, T angle) { Axis(axis.X(), axis.Y(), axis.Z(), angle); }
  void ToAxis(Vector3<T>& axis, T& angle) const;
  void Euler(const Vector3<T>& rpy) { Euler(rpy.X(), rpy.Y(), rpy.Z()); }
  void Euler(T roll, T pitch, T yaw);
  Vector3<T> Euler() const;
  static Quaternion EulerToQuaternion(const Vector3<T>& rpy) { return Quaternion(rpy); }
  static Quaternion EulerToQuaternion(T roll, T pitch, T yaw) { return Quaternion(roll, pitch, yaw); }
  T Roll() const { return Euler().X(); }
  T Pitch() const { return Euler().Y(); }
  T Yaw() const { return Euler().Z(); }
  /// The shortest rotation that turns the first into the second.
  void From2Axes(const Vector3<T>& from, const Vector3<T>& to);
  /// The angle by a factor, the axis the same.
  void Scale(T factor);

  T Dot(const Quaternion& q) const { return w_ * q.w_ + x_ * q.x_ + y_ * q.y_ + z_ * q.z_; }
  void Normalize();
  Quaternion Normalized() const;
  void Invert();
  Quaternion Inverse() const;
  Quaternion Log() const;
  Quaternion Exp() const;

  Quaternion operator+(const Quaternion& q) const { return Quaternion(w_ + q.w_, x_ + q.x_, y_ + q.y_, z_ + q.z_); }
  Quaternion operator-(const Quaternion& q) const { return Quaternion(w_ - q.w_, x_ - q.x_, y_ - q.y_, z_ - q.z_); }
  Quaternion operator-() const { return Quaternion(-w_, -x_, -y_, -z_); }
  Quaternion operator*(const Quaternion& q) const;
  Quaternion operator*(const T& f) const { return Quaternion(w_ * f, x_ * f, y_ * f, z_ * f); }
  Vector3<T> operator*(const Vector3<T>& v) const;
  Quaternion operator+=(const Quaternion& q) { return *this = *this + q; }
  Quaternion operator-=(const Quaternion& q) { return *this = *this - q; }
  Quaternion operator*=(const Quaternion& q) { return *this = *this * q; }
  bool Equal(const Quaternion& q, const T& tolerance) const;
  bool operator==(const Quaternion& q) const { return Equal(q, static_cast<T>(0.001)); }
  bool operator!=(const Quaternion& q) const { return !(*this == q); }

  Vector3<T> RotateVector(const Vector3<T>& v) const;
  Vector3<T> RotateVectorReverse(const Vector3<T>& v) const;
  Vector3<T> XAxis() const { return column(0); }
  Vector3<T> YAxis() const { return column(1); }
  Vector3<T> ZAxis() const { return column(2); }
  bool IsFinite() const { return std::isfinite(w_) && std::isfinite(x_) && std::isfinite(y_) && std::isfinite(z_); }
  /// Numbers that are none become 0; where nothing is left, it is the identity.
  void Correct();
  void Round(int digits);
  /// Where a body is that turns so fast (in the axes outside) for a time.
  Quaternion Integrate(const Vector3<T>& velocity, const T time) const;
  static Quaternion Slerp(T t, const Quaternion& p, const Quaternion& q, bool shortest = false);
  static Quaternion Squad(T t, const Quaternion& p, const Quaternion& a, const Quaternion& b, const Quaternion& q,
                          bool shortest = false)
  {
    return Slerp(2 * t * (1 - t), Slerp(t, p, q, shortest), Slerp(t, a, b));
  }

  const T& W() const { return w_; }
  const T& X() const { return x_; }
  const T& Y() const { return y_; }
  const T& Z() const { return z_; }
  T& W() { return w_; }
  T& X() { return x_; }
  T& Y() { return y_; }
  T& Z() { return z_; }
  void W(T v) { w_ = v; }
  void X(T v) { x_ = v; }
  void Y(T v) { y_ = v; }
  void Z(T v) { z_ = v; }

  /// Text is of angles.
  friend std::ostream& operator<<(std::ostream& out, const Quaternion& q) { return out << q.Euler(); }
  friend std::istream& operator>>(std::istream& in, Quaternion& q)
  {
    Vector3<T> rpy;
    in >> rpy;
    if (!in.fail())
      q.Euler(rpy);
    return in;
  }

private:
  Vector3<T> column(int index) const;

  T w_ = 1, x_ = 0, y_ = 0, z_ = 0;
};

template <typename T>
const Quaternion<T> Quaternion<T>::Identity(1, 0, 0, 0);
template <typename T>
const Quaternion<T> Quaternion<T>::Zero(0, 0, 0, 0);

typedef Quaternion<double> Quaterniond;
typedef Quaternion<float> Quaternionf;
typedef Quaternion<int> Quaternioni;

}  // namespace v6
}  // namespace math
}  // namespace ignition

#include <ignition/math/detail/Quaternion.hh>
