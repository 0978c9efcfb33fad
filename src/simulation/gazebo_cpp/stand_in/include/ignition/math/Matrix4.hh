#pragma once
#include <ignition/math/Matrix3.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>
#include <ignition/math/detail/Grid.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

template <typename T>
class Matrix4 : public detail::Grid<Matrix4<T>, T, 4>
{
  using Base = detail::Grid<Matrix4<T>, T, 4>;

public:
  static const Matrix4 Identity, Zero;

  Matrix4() = default;
  Matrix4(const Matrix4& m) = default;
  Matrix4(T v00, T v01, T v02, T v03, T v10, T v11, T v12, T v13, T v20, T v21, T v22, T v23, T v30, T v31, T v32, T v33)
  {
    Set(v00, v01, v02, v03, v10, v11, v12, v13, v20, v21, v22, v23, v30, v31, v32, v33);
  }
  explicit Matrix4(const Quaternion<T>& q) : Matrix4()
  {
    (*this)(3, 3) = 1;
    turn(Matrix3<T>(q));
  }
  explicit Matrix4(const Pose3<T>& pose) : Matrix4(pose.Rot()) { SetTranslation(pose.Pos()); }
  virtual ~Matrix4() = default;
  Matrix4& operator=(const Matrix4& m) = default;
  const Matrix4& operator=(const Matrix3<T>& m)
  {
    turn(m);
    return *this;
  }

  void Set(T v00, T v01, T v02, T v03, T v10, T v11, T v12, T v13, T v20, T v21, T v22, T v23, T v30, T v31, T v32, T v33)
  {
    this->data_ = { v00, v01, v02, v03, v10, v11, v12, v13, v20, v21, v22, v23, v30, v31, v32, v33 };
  }
  void Axis(const Vector3<T>& axis, T angle)
  {
    Matrix3<T> m;
    m.Axis(axis, angle);
    turn(m);
  }
  void SetTranslation(const Vector3<T>& t) { SetTranslation(t.X(), t.Y(), t.Z()); }
  void SetTranslation(T x, T y, T z)
  {
    (*this)(0, 3) = x;
    (*this)(1, 3) = y;
    (*this)(2, 3) = z;
  }
  Vector3<T> Translation() const { return Vector3<T>((*this)(0, 3), (*this)(1, 3), (*this)(2, 3)); }
  Vector3<T> Scale() const { return Vector3<T>((*this)(0, 0), (*this)(1, 1), (*this)(2, 2)); }
  /// A matrix that scales, and nothing else.
  void Scale(const Vector3<T>& s) { Scale(s.X(), s.Y(), s.Z()); }
  void Scale(T x, T y, T z)
  {
    *this = Zero;
    (*this)(0, 0) = x;
    (*this)(1, 1) = y;
    (*this)(2, 2) = z;
    (*this)(3, 3) = 1;
  }
  Quaternion<T> Rotation() const { return Quaternion<T>(upper()); }
  /// One of the two sets of angles.
  Vector3<T> EulerRotation(bool first) const;
  Pose3<T> Pose() const { return Pose3<T>(Translation(), Rotation()); }
  bool IsAffine() const
  {
    return equal((*this)(3, 0), static_cast<T>(0)) && equal((*this)(3, 1), static_cast<T>(0)) &&
           equal((*this)(3, 2), static_cast<T>(0)) && equal((*this)(3, 3), static_cast<T>(1));
  }
  bool TransformAffine(const Vector3<T>& v, Vector3<T>& result) const
  {
    if (!IsAffine())
      return false;
    result = *this * v;
    return true;
  }

  T Determinant() const
  {
    T sum = 0;
    for (unsigned int column = 0; column < 4; ++column)
      sum += (column % 2 ? -1 : 1) * (*this)(0, column) * without(0, column).Determinant();
    return sum;
  }
  Matrix4 Inverse() const
  {
    const T scale = 1 / Determinant();
    Matrix4 result;
    for (unsigned int row = 0; row < 4; ++row)
      for (unsigned int column = 0; column < 4; ++column)
        result(column, row) = ((row + column) % 2 ? -1 : 1) * without(row, column).Determinant() * scale;
    return result;
  }

  using Base::operator*;
  Matrix4 operator*=(const Matrix4& m) { return *this = *this * m; }
  Vector3<T> operator*(const Vector3<T>& v) const { return upper() * v + Translation(); }

  /// Where a camera is that stands at the eye, its x axis towards the target.
  static Matrix4 LookAt(const Vector3<T>& eye, const Vector3<T>& target, const Vector3<T>& up = Vector3<T>::UnitZ);

private:
  Matrix3<T> upper() const { return without(3, 3); }
  Matrix3<T> without(unsigned int row, unsigned int column) const
  {
    Matrix3<T> result;
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = 0; c < 3; ++c)
        result(r, c) = (*this)(r < row ? r : r + 1, c < column ? c : c + 1);
    return result;
  }
  void turn(const Matrix3<T>& m)
  {
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = 0; c < 3; ++c)
        (*this)(r, c) = m(r, c);
  }
};

template <typename T>
const Matrix4<T> Matrix4<T>::Identity(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
template <typename T>
const Matrix4<T> Matrix4<T>::Zero(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);

template <typename T>
Vector3<T> Matrix4<T>::EulerRotation(bool first) const
{
  const Matrix4& m = *this;
  Vector3<T> rpy;
  if (std::abs(m(2, 0)) >= 1)  // straight up or down, all of the turn is roll's
  {
    rpy.Z(0);
    const bool up = m(2, 0) < 0;
    rpy.Y(static_cast<T>(up ? IGN_PI_2 : -IGN_PI_2));
    rpy.X(static_cast<T>(up ? std::atan2(m(0, 1), m(0, 2)) : std::atan2(-m(0, 1), -m(0, 2))));
    return rpy;
  }
  const T pitch = static_cast<T>(-std::asin(m(2, 0)));
  rpy.Y(first ? pitch : static_cast<T>(IGN_PI - pitch));
  const T cosine = static_cast<T>(std::cos(rpy.Y()));
  rpy.X(static_cast<T>(std::atan2(m(2, 1) / cosine, m(2, 2) / cosine)));
  rpy.Z(static_cast<T>(std::atan2(m(1, 0) / cosine, m(0, 0) / cosine)));
  return rpy;
}

template <typename T>
Matrix4<T> Matrix4<T>::LookAt(const Vector3<T>& eye, const Vector3<T>& target, const Vector3<T>& up)
{
  Vector3<T> front = target == eye ? Vector3<T>::UnitX : (target - eye).Normalized();
  const Vector3<T> above = up == Vector3<T>::Zero ? Vector3<T>::UnitZ : up.Normalized();
  Vector3<T> left = above.Cross(front);
  if (left == Vector3<T>::Zero)  // looking along "up"
    left = Vector3<T>::UnitY;
  else
    left.Normalize();
  const Vector3<T> top = front.Cross(left).Normalized();
  return Matrix4(front.X(), left.X(), top.X(), eye.X(), front.Y(), left.Y(), top.Y(), eye.Y(), front.Z(), left.Z(), top.Z(),
                 eye.Z(), 0, 0, 0, 1);
}

typedef Matrix4<int> Matrix4i;
typedef Matrix4<double> Matrix4d;
typedef Matrix4<float> Matrix4f;

}  // namespace v6
}  // namespace math
}  // namespace ignition
