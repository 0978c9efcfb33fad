#pragma once
#include <ignition/math/Matrix4.hh>
#include <ignition/math/detail/Components.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

template <typename T>
class Vector4 : public detail::Components<Vector4<T>, T, 4>
{
  using Base = detail::Components<Vector4<T>, T, 4>;

public:
  static const Vector4 Zero, One, NaN;

  Vector4() = default;
  Vector4(const T& x, const T& y, const T& z, const T& w) { Set(x, y, z, w); }
  Vector4(const Vector4& v) = default;
  virtual ~Vector4() = default;

  T Distance(const Vector4& point) const { return (*this - point).Length(); }
  T Distance(T x, T y, T z, T w) const { return Distance(Vector4(x, y, z, w)); }
  void Normalize() { *this = this->Normalized(); }
  void Round() { *this = this->Rounded(); }
  void Set(T x = 0, T y = 0, T z = 0, T w = 0)
  {
    this->data_[0] = x;
    this->data_[1] = y;
    this->data_[2] = z;
    this->data_[3] = w;
  }
  Vector4& operator=(const Vector4& v) = default;
  Vector4& operator=(T v)
  {
    this->fill(v);
    return *this;
  }
  using Base::operator*;
  /// A row of numbers, and the matrix to its right.
  Vector4 operator*(const Matrix4<T>& m) const
  {
    Vector4 result;
    for (std::size_t column = 0; column < 4; ++column)
      for (std::size_t row = 0; row < 4; ++row)
        result[column] += this->data_[row] * m(row, column);
    return result;
  }
  bool operator==(const Vector4& v) const { return this->Equal(v, static_cast<T>(1e-6)); }
  bool operator!=(const Vector4& v) const { return !(*this == v); }
  T X() const { return this->data_[0]; }
  T Y() const { return this->data_[1]; }
  T Z() const { return this->data_[2]; }
  T W() const { return this->data_[3]; }
  T& X() { return this->data_[0]; }
  T& Y() { return this->data_[1]; }
  T& Z() { return this->data_[2]; }
  T& W() { return this->data_[3]; }
  void X(const T& v) { this->data_[0] = v; }
  void Y(const T& v) { this->data_[1] = v; }
  void Z(const T& v) { this->data_[2] = v; }
  void W(const T& v) { this->data_[3] = v; }
};

template <typename T>
const Vector4<T> Vector4<T>::Zero(0, 0, 0, 0);
template <typename T>
const Vector4<T> Vector4<T>::One(1, 1, 1, 1);
template <typename T>
const Vector4<T> Vector4<T>::NaN(std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::quiet_NaN(),
                                 std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::quiet_NaN());

typedef Vector4<int> Vector4i;
typedef Vector4<double> Vector4d;
typedef Vector4<float> Vector4f;

}  // namespace v6
}  // namespace math
}  // namespace ignition
