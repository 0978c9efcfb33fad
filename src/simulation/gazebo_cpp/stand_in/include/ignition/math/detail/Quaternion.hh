#pragma once
#include <ignition/math/Quaternion.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

template <typename T>
Quaternion<T>::Quaternion(const Matrix3<T>& m)
{
  // From the largest of the four, so that none is divided by what is small.
  const T trace = m(0, 0) + m(1, 1) + m(2, 2);
  if (trace > 0.0000001)
  {
    const T s = 2 * static_cast<T>(std::sqrt(1 + trace));
    *this = Quaternion(s / 4, (m(2, 1) - m(1, 2)) / s, (m(0, 2) - m(2, 0)) / s, (m(1, 0) - m(0, 1)) / s);
    return;
  }
  int i = m(1, 1) > m(0, 0) ? 1 : 0;
  if (m(2, 2) > m(i, i))
    i = 2;
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const T s = 2 * static_cast<T>(std::sqrt(1 + m(i, i) - m(j, j) - m(k, k)));
  T imaginary[3];
  imaginary[i] = s / 4;
  imaginary[j] = (m(i, j) + m(j, i)) / s;
  imaginary[k] = (m(i, k) + m(k, i)) / s;
  *this = Quaternion((m(k, j) - m(j, k)) / s, imaginary[0], imaginary[1], imaginary[2]);
}

template <typename T>
void Quaternion<T>::Axis(T x, T y, T z, T angle)
{
  const T square = x * x + y * y + z * z;
  if (equal<T>(square, 0))
  {
    *this = Quaternion();
    return;
  }
  const T s = static_cast<T>(std::sin(angle / 2) / std::sqrt(square));
  *this = Quaternion(static_cast<T>(std::cos(angle / 2)), x * s, y * s, z * s);
  Normalize();
}

template <typename T>
void Quaternion<T>::ToAxis(Vector3<T>& axis, T& angle) const
{
  const T length = static_cast<T>(std::sqrt(x_ * x_ + y_ * y_ + z_ * z_));
  if (equal<T>(length, 0))
  {
    angle = 0;
    axis.Set(1, 0, 0);
    return;
  }
  angle = static_cast<T>(2 * std::acos(w_));
  axis.Set(x_ / length, y_ / length, z_ / length);
}

template <typename T>
void Quaternion<T>::Euler(T roll, T pitch, T yaw)
{
  const T cr = std::cos(roll / 2), sr = std::sin(roll / 2), cp = std::cos(pitch / 2), sp = std::sin(pitch / 2);
  const T cy = std::cos(yaw / 2), sy = std::sin(yaw / 2);
  *this = Quaternion(cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
                     cr * cp * sy - sr * sp * cy);
  Normalize();
}

template <typename T>
Vector3<T> Quaternion<T>::Euler() const
{
  const Quaternion q = Normalized();
  const T w = q.w_, x = q.x_, y = q.y_, z = q.z_;
  const T sine = -2 * (x * z - w * y);
  const T tolerance = static_cast<T>(1e-15);
  Vector3<T> rpy;
  rpy.Y(sine <= -1 ? static_cast<T>(-IGN_PI_2) : sine >= 1 ? static_cast<T>(IGN_PI_2) : static_cast<T>(std::asin(sine)));
  if (std::abs(sine - 1) < tolerance)  // straight down or up, all of the turn is roll's
    rpy.X(std::atan2(2 * (x * y - z * w), w * w - x * x + y * y - z * z));
  else if (std::abs(sine + 1) < tolerance)
    rpy.X(std::atan2(-2 * (x * y - z * w), w * w - x * x + y * y - z * z));
  else
  {
    rpy.X(std::atan2(2 * (y * z + w * x), w * w - x * x - y * y + z * z));
    rpy.Z(std::atan2(2 * (x * y + w * z), w * w + x * x - y * y - z * z));
  }
  return rpy;
}

template <typename T>
void Quaternion<T>::From2Axes(const Vector3<T>& from, const Vector3<T>& to)
{
  const T lengths = static_cast<T>(std::sqrt(from.SquaredLength() * to.SquaredLength()));
  const T cosine = lengths > 0 ? from.Dot(to) / lengths : 0;
  if (std::abs(cosine - 1) < 1e-6)
  {
    *this = Quaternion();
    return;
  }
  if (std::abs(cosine + 1) < 1e-6)  // any half turn about an axis across
  {
    Vector3<T> axis = from.Cross(Vector3<T>::UnitX);
    if (axis.SquaredLength() < 1e-12)
      axis = from.Cross(Vector3<T>::UnitY);
    axis.Normalize();
    *this = Quaternion(0, axis.X(), axis.Y(), axis.Z());
    return;
  }
  const Vector3<T> cross = from.Cross(to);
  *this = Quaternion(lengths + from.Dot(to), cross.X(), cross.Y(), cross.Z());
  Normalize();
}

template <typename T>
void Quaternion<T>::Scale(T factor)
{
  Vector3<T> axis;
  T angle;
  ToAxis(axis, angle);
  Axis(axis, angle * factor);
}

template <typename T>
void Quaternion<T>::Normalize()
{
  const T length = static_cast<T>(std::sqrt(Dot(*this)));
  if (equal<T>(length, 0))
    *this = Quaternion();
  else
    *this = Quaternion(w_ / length, x_ / length, y_ / length, z_ / length);
}

template <typename T>
Quaternion<T> Quaternion<T>::Normalized() const
{
  Quaternion result = *this;
  result.Normalize();
  return result;
}

template <typename T>
void Quaternion<T>::Invert()
{
  Normalize();
  *this = Quaternion(w_, -x_, -y_, -z_);
}

template <typename T>
Quaternion<T> Quaternion<T>::Inverse() const
{
  const T square = Dot(*this);
  return equal<T>(square, 0) ? Quaternion() : Quaternion(w_ / square, -x_ / square, -y_ / square, -z_ / square);
}

template <typename T>
Quaternion<T> Quaternion<T>::Log() const
{
  T factor = 1;
  if (std::abs(w_) < 1)
  {
    const T angle = static_cast<T>(std::acos(w_)), sine = static_cast<T>(std::sin(angle));
    if (std::abs(sine) >= 1e-3)
      factor = angle / sine;
  }
  return Quaternion(0, factor * x_, factor * y_, factor * z_);
}

template <typename T>
Quaternion<T> Quaternion<T>::Exp() const
{
  const T angle = static_cast<T>(std::sqrt(x_ * x_ + y_ * y_ + z_ * z_)), sine = static_cast<T>(std::sin(angle));
  const T factor = std::abs(sine) >= 1e-3 ? sine / angle : 1;
  return Quaternion(static_cast<T>(std::cos(angle)), factor * x_, factor * y_, factor * z_);
}

template <typename T>
Quaternion<T> Quaternion<T>::operator*(const Quaternion& q) const
{
  return Quaternion(w_ * q.w_ - x_ * q.x_ - y_ * q.y_ - z_ * q.z_, w_ * q.x_ + x_ * q.w_ + y_ * q.z_ - z_ * q.y_,
                    w_ * q.y_ - x_ * q.z_ + y_ * q.w_ + z_ * q.x_, w_ * q.z_ + x_ * q.y_ - y_ * q.x_ + z_ * q.w_);
}

template <typename T>
Vector3<T> Quaternion<T>::operator*(const Vector3<T>& v) const
{
  const Vector3<T> axis(x_, y_, z_), once = axis.Cross(v), twice = axis.Cross(once);
  return v + once * (2 * w_) + twice * static_cast<T>(2);
}

template <typename T>
bool Quaternion<T>::Equal(const Quaternion& q, const T& tolerance) const
{
  return equal(w_, q.w_, tolerance) && equal(x_, q.x_, tolerance) && equal(y_, q.y_, tolerance) && equal(z_, q.z_, tolerance);
}

template <typename T>
Vector3<T> Quaternion<T>::RotateVector(const Vector3<T>& v) const
{
  const Quaternion turned = *this * (Quaternion(0, v.X(), v.Y(), v.Z()) * Inverse());
  return Vector3<T>(turned.x_, turned.y_, turned.z_);
}

template <typename T>
Vector3<T> Quaternion<T>::RotateVectorReverse(const Vector3<T>& v) const
{
  const Quaternion turned = Inverse() * (Quaternion(0, v.X(), v.Y(), v.Z()) * *this);
  return Vector3<T>(turned.x_, turned.y_, turned.z_);
}

template <typename T>
Vector3<T> Quaternion<T>::column(int index) const
{
  switch (index)
  {
    case 0:
      return Vector3<T>(1 - 2 * (y_ * y_ + z_ * z_), 2 * (x_ * y_ + z_ * w_), 2 * (x_ * z_ - y_ * w_));
    case 1:
      return Vector3<T>(2 * (x_ * y_ - z_ * w_), 1 - 2 * (x_ * x_ + z_ * z_), 2 * (y_ * z_ + x_ * w_));
    default:
      return Vector3<T>(2 * (x_ * z_ + y_ * w_), 2 * (y_ * z_ - x_ * w_), 1 - 2 * (x_ * x_ + y_ * y_));
  }
}

template <typename T>
void Quaternion<T>::Correct()
{
  if (!std::isfinite(w_))
    w_ = 1;
  for (T* each : { &x_, &y_, &z_ })
    if (!std::isfinite(*each))
      *each = 0;
  if (equal<T>(w_, 0) && equal<T>(x_, 0) && equal<T>(y_, 0) && equal<T>(z_, 0))
    w_ = 1;
}

template <typename T>
void Quaternion<T>::Round(int digits)
{
  for (T* each : { &w_, &x_, &y_, &z_ })
    *each = precision(*each, static_cast<unsigned int>(digits));
}

template <typename T>
Quaternion<T> Quaternion<T>::Integrate(const Vector3<T>& velocity, const T time) const
{
  const Vector3<T> half = velocity * (time / 2);
  const T square = half.SquaredLength(), angle = static_cast<T>(std::sqrt(square));
  const bool tiny = square * square / 24 < std::numeric_limits<T>::min();
  const T w = tiny ? 1 - square / 2 : static_cast<T>(std::cos(angle)),
          s = tiny ? 1 - square / 6 : static_cast<T>(std::sin(angle) / angle);
  return Quaternion(w, half.X() * s, half.Y() * s, half.Z() * s) * *this;
}

template <typename T>
Quaternion<T> Quaternion<T>::Slerp(T t, const Quaternion& p, const Quaternion& q, bool shortest)
{
  const bool turn = shortest && p.Dot(q) < 0;
  const Quaternion to = turn ? -q : q;
  const T cosine = turn ? -p.Dot(q) : p.Dot(q);
  if (std::abs(cosine) < 1 - 1e-3)
  {
    const T sine = static_cast<T>(std::sqrt(1 - cosine * cosine)), angle = static_cast<T>(std::atan2(sine, cosine));
    return p * static_cast<T>(std::sin((1 - t) * angle) / sine) + to * static_cast<T>(std::sin(t * angle) / sine);
  }
  return (p * (1 - t) + to * t).Normalized();  // too near for the arc
}

}  // namespace v6
}  // namespace math
}  // namespace ignition
