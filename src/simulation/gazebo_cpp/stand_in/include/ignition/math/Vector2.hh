#pragma once
#include <ignition/math/detail/Components.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

template <typename T>
class Vector2 : public detail::Components<Vector2<T>, T, 2>
{
public:
  static const Vector2 Zero, One, NaN;

  Vector2() = default;
  Vector2(const T& x, const T& y) { Set(x, y); }
  Vector2(const Vector2& v) = default;
  virtual ~Vector2() = default;

  double Distance(const Vector2& point) const { return std::sqrt(static_cast<double>((*this - point).SquaredLength())); }
  void Normalize() { *this = this->Normalized(); }
  Vector2 Round() { return *this = this->Rounded(); }
  void Set(T x, T y)
  {
    this->data_[0] = x;
    this->data_[1] = y;
  }
  Vector2& operator=(const Vector2& v) = default;
  const Vector2& operator=(T v)
  {
    this->fill(v);
    return *this;
  }
  using detail::Components<Vector2<T>, T, 2>::Equal;
  bool operator==(const Vector2& v) const { return this->Equal(v, static_cast<T>(1e-6)); }
  bool operator!=(const Vector2& v) const { return !(*this == v); }
  T X() const { return this->data_[0]; }
  T Y() const { return this->data_[1]; }
  T& X() { return this->data_[0]; }
  T& Y() { return this->data_[1]; }
  void X(const T& v) { this->data_[0] = v; }
  void Y(const T& v) { this->data_[1] = v; }
};

template <typename T>
const Vector2<T> Vector2<T>::Zero(0, 0);
template <typename T>
const Vector2<T> Vector2<T>::One(1, 1);
template <typename T>
const Vector2<T> Vector2<T>::NaN(std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::quiet_NaN());

typedef Vector2<int> Vector2i;
typedef Vector2<double> Vector2d;
typedef Vector2<float> Vector2f;

}  // namespace v6
}  // namespace math
}  // namespace ignition
