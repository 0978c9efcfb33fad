#pragma once
#include <ignition/math/detail/Components.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

template <typename T>
class Vector3 : public detail::Components<Vector3<T>, T, 3>
{
  using Base = detail::Components<Vector3<T>, T, 3>;

public:
  static const Vector3 Zero, One, UnitX, UnitY, UnitZ, NaN;

  Vector3() = default;
  Vector3(const T& x, const T& y, const T& z) { Set(x, y, z); }
  Vector3(const Vector3& v) = default;
  virtual ~Vector3() = default;

  T Distance(const Vector3& point) const { return (*this - point).Length(); }
  T Distance(T x, T y, T z) const { return Distance(Vector3(x, y, z)); }
  Vector3 Normalize() { return *this = this->Normalized(); }
  Vector3 Round() { return *this = this->Rounded(); }
  void Round(int digits)
  {
    for (T& a : this->data_)
      a = precision(a, static_cast<unsigned int>(digits));
  }
  void Set(T x = 0, T y = 0, T z = 0)
  {
    this->data_[0] = x;
    this->data_[1] = y;
    this->data_[2] = z;
  }
  Vector3 Cross(const Vector3& v) const
  {
    return Vector3(Y() * v.Z() - Z() * v.Y(), Z() * v.X() - X() * v.Z(), X() * v.Y() - Y() * v.X());
  }
  /// Some vector across this one.
  Vector3 Perpendicular() const
  {
    Vector3 across = Cross(UnitX);
    return across.SquaredLength() < 1e-12 ? Cross(UnitY) : across;
  }
  /// Of the triangle of three points, seen against the clock.
  static Vector3 Normal(const Vector3& a, const Vector3& b, const Vector3& c) { return (b - a).Cross(c - a).Normalize(); }
  T DistToLine(const Vector3& a, const Vector3& b) const { return (*this - a).Cross(*this - b).Length() / (b - a).Length(); }

  Vector3& operator=(const Vector3& v) = default;
  Vector3& operator=(T v)
  {
    this->fill(v);
    return *this;
  }
  using Base::Equal;
  bool Equal(const Vector3& v) const { return *this == v; }
  bool operator==(const Vector3& v) const { return this->Equal(v, static_cast<T>(1e-3)); }
  bool operator!=(const Vector3& v) const { return !(*this == v); }
  T X() const { return this->data_[0]; }
  T Y() const { return this->data_[1]; }
  T Z() const { return this->data_[2]; }
  T& X() { return this->data_[0]; }
  T& Y() { return this->data_[1]; }
  T& Z() { return this->data_[2]; }
  void X(const T& v) { this->data_[0] = v; }
  void Y(const T& v) { this->data_[1] = v; }
  void Z(const T& v) { this->data_[2] = v; }
};

template <typename T>
const Vector3<T> Vector3<T>::Zero(0, 0, 0);
template <typename T>
const Vector3<T> Vector3<T>::One(1, 1, 1);
template <typename T>
const Vector3<T> Vector3<T>::UnitX(1, 0, 0);
template <typename T>
const Vector3<T> Vector3<T>::UnitY(0, 1, 0);
template <typename T>
const Vector3<T> Vector3<T>::UnitZ(0, 0, 1);
template <typename T>
const Vector3<T> Vector3<T>::NaN(std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::quiet_NaN(),
                                 std::numeric_limits<T>::quiet_NaN());

typedef Vector3<int> Vector3i;
typedef Vector3<double> Vector3d;
typedef Vector3<float> Vector3f;

}  // namespace v6
}  // namespace math
}  // namespace ignition
