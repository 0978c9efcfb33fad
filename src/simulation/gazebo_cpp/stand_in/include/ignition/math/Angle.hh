#pragma once
#include <istream>

#include <ignition/math/Helpers.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

class IGNITION_MATH_VISIBLE Angle
{
public:
  static const Angle Zero, Pi, HalfPi, TwoPi;

  Angle() = default;
  Angle(double radian) : value_(radian) {}
  Angle(const Angle& angle) = default;
  virtual ~Angle() = default;
  Angle& operator=(const Angle& angle) = default;

  void Radian(double radian) { value_ = radian; }
  void SetRadian(double radian) { value_ = radian; }
  void Degree(double degree) { value_ = IGN_DTOR(degree); }
  void SetDegree(double degree) { value_ = IGN_DTOR(degree); }
  double Radian() const { return value_; }
  double Degree() const { return IGN_RTOD(value_); }
  /// Into the turn from -pi to pi.
  void Normalize() { value_ = IGN_NORMALIZE(value_); }
  Angle Normalized() const { return Angle(IGN_NORMALIZE(value_)); }

  double operator()() const { return value_; }
  double operator*() const { return value_; }
  Angle operator-(const Angle& a) const { return Angle(value_ - a.value_); }
  Angle operator+(const Angle& a) const { return Angle(value_ + a.value_); }
  Angle operator*(const Angle& a) const { return Angle(value_ * a.value_); }
  Angle operator/(const Angle& a) const { return Angle(value_ / a.value_); }
  Angle operator-=(const Angle& a) { return *this = *this - a; }
  Angle operator+=(const Angle& a) { return *this = *this + a; }
  Angle operator*=(const Angle& a) { return *this = *this * a; }
  Angle operator/=(const Angle& a) { return *this = *this / a; }
  bool operator==(const Angle& a) const { return equal(value_, a.value_, 0.001); }
  bool operator!=(const Angle& a) const { return !(*this == a); }
  bool operator<(const Angle& a) const { return value_ < a.value_; }
  bool operator<=(const Angle& a) const { return value_ < a.value_ || equal(value_, a.value_); }
  bool operator>(const Angle& a) const { return value_ > a.value_; }
  bool operator>=(const Angle& a) const { return value_ > a.value_ || equal(value_, a.value_); }
  friend std::ostream& operator<<(std::ostream& out, const Angle& angle) { return out << angle.value_; }
  friend std::istream& operator>>(std::istream& in, Angle& angle)
  {
    in.setf(std::ios_base::skipws);
    return in >> angle.value_;
  }

private:
  double value_ = 0;
};

inline const Angle Angle::Zero(0), Angle::Pi(IGN_PI), Angle::HalfPi(IGN_PI_2), Angle::TwoPi(2 * IGN_PI);

}  // namespace v6
}  // namespace math
}  // namespace ignition
