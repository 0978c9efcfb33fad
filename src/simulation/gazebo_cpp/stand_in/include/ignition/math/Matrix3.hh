#pragma once
#include <ignition/math/Helpers.hh>
#include <ignition/math/Vector3.hh>
#include <ignition/math/detail/Grid.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

template <typename T>
class Quaternion;

template <typename T>
class Matrix3 : public detail::Grid<Matrix3<T>, T, 3>
{
  using Base = detail::Grid<Matrix3<T>, T, 3>;

public:
  static const Matrix3 Identity, Zero;

  Matrix3() = default;
  Matrix3(const Matrix3& m) = default;
  Matrix3(T v00, T v01, T v02, T v10, T v11, T v12, T v20, T v21, T v22) { Set(v00, v01, v02, v10, v11, v12, v20, v21, v22); }
  explicit Matrix3(const Quaternion<T>& q) { *this = q; }
  virtual ~Matrix3() = default;
  Matrix3& operator=(const Matrix3& m) = default;
  Matrix3& operator=(const Quaternion<T>& q);

  void Set(T v00, T v01, T v02, T v10, T v11, T v12, T v20, T v21, T v22)
  {
    this->data_ = { v00, v01, v02, v10, v11, v12, v20, v21, v22 };
  }
  void Axes(const Vector3<T>& x, const Vector3<T>& y, const Vector3<T>& z)
  {
    Col(0, x);
    Col(1, y);
    Col(2, z);
  }
  void Axis(const Vector3<T>& axis, T angle);
  /// The shortest rotation that turns the first into the second.
  void From2Axes(const Vector3<T>& from, const Vector3<T>& to);
  void Col(unsigned int column, const Vector3<T>& v)
  {
    for (unsigned int row = 0; row < 3; ++row)
      (*this)(row, std::min(column, 2u)) = v[row];
  }

  using Base::operator*;
  Vector3<T> operator*(const Vector3<T>& v) const
  {
    Vector3<T> result;
    for (unsigned int row = 0; row < 3; ++row)
      result[row] = (*this)(row, 0) * v.X() + (*this)(row, 1) * v.Y() + (*this)(row, 2) * v.Z();
    return result;
  }
  friend Matrix3 operator*(T s, const Matrix3& m) { return m * s; }
  friend Vector3<T> operator*(const Vector3<T>& v, const Matrix3& m) { return m.Transposed() * v; }

  T Determinant() const { return minor(0, 0) * (*this)(0, 0) - minor(0, 1) * (*this)(0, 1) + minor(0, 2) * (*this)(0, 2); }
  Matrix3 Inverse() const
  {
    const T scale = 1 / Determinant();
    Matrix3 result;
    for (unsigned int row = 0; row < 3; ++row)
      for (unsigned int column = 0; column < 3; ++column)
        result(column, row) = ((row + column) % 2 ? -1 : 1) * minor(row, column) * scale;
    return result;
  }

private:
  T minor(unsigned int row, unsigned int column) const
  {
    const unsigned int r0 = row == 0 ? 1 : 0, r1 = row == 2 ? 1 : 2, c0 = column == 0 ? 1 : 0, c1 = column == 2 ? 1 : 2;
    return (*this)(r0, c0) * (*this)(r1, c1) - (*this)(r0, c1) * (*this)(r1, c0);
  }
};

template <typename T>
const Matrix3<T> Matrix3<T>::Identity(1, 0, 0, 0, 1, 0, 0, 0, 1);
template <typename T>
const Matrix3<T> Matrix3<T>::Zero(0, 0, 0, 0, 0, 0, 0, 0, 0);

typedef Matrix3<int> Matrix3i;
typedef Matrix3<double> Matrix3d;
typedef Matrix3<float> Matrix3f;

}  // namespace v6
}  // namespace math
}  // namespace ignition

#include <ignition/math/Quaternion.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

template <typename T>
Matrix3<T>& Matrix3<T>::operator=(const Quaternion<T>& q)
{
  const Quaternion<T> unit = q.Normalized();
  Axes(unit.XAxis(), unit.YAxis(), unit.ZAxis());
  return *this;
}

template <typename T>
void Matrix3<T>::Axis(const Vector3<T>& axis, T angle)
{
  const T c = static_cast<T>(std::cos(angle)), s = static_cast<T>(std::sin(angle)), rest = 1 - c;
  const T x = axis.X(), y = axis.Y(), z = axis.Z();
  Set(x * x * rest + c, x * y * rest - z * s, x * z * rest + y * s, x * y * rest + z * s, y * y * rest + c,
      y * z * rest - x * s, x * z * rest - y * s, y * z * rest + x * s, z * z * rest + c);
}

template <typename T>
void Matrix3<T>::From2Axes(const Vector3<T>& from, const Vector3<T>& to)
{
  Vector3<T> a = from.Normalized(), b = to.Normalized();
  const Vector3<T> cross = a.Cross(b);
  const T cosine = a.Dot(b);
  if (cross == Vector3<T>::Zero)  // along each other
  {
    *this = Identity;
    if (cosine < 0)
      *this = *this * static_cast<T>(-1);
    return;
  }
  const Matrix3 skew(0, -cross.Z(), cross.Y(), cross.Z(), 0, -cross.X(), -cross.Y(), cross.X(), 0);
  *this = Identity + skew + skew * skew * ((1 - cosine) / cross.SquaredLength());
}

}  // namespace v6
}  // namespace math
}  // namespace ignition
