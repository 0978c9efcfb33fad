#pragma once
#include <istream>

#include <ignition/math/Helpers.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// In kelvin, as far as nothing else is said.
class IGNITION_MATH_VISIBLE Temperature
{
public:
  Temperature(double kelvin = 0) : kelvin_(kelvin) {}
  Temperature(const Temperature& other) = default;
  virtual ~Temperature() = default;
  Temperature& operator=(const Temperature& other) = default;
  Temperature& operator=(double kelvin)
  {
    kelvin_ = kelvin;
    return *this;
  }

  static double KelvinToCelsius(double t) { return t - 273.15; }
  static double KelvinToFahrenheit(double t) { return t * 1.8 - 459.67; }
  static double CelsiusToFahrenheit(double t) { return t * 1.8 + 32.0; }
  static double CelsiusToKelvin(double t) { return t + 273.15; }
  static double FahrenheitToCelsius(double t) { return (t - 32.0) / 1.8; }
  static double FahrenheitToKelvin(double t) { return (t + 459.67) / 1.8; }
  void SetKelvin(double t) { kelvin_ = t; }
  void SetCelsius(double t) { kelvin_ = CelsiusToKelvin(t); }
  void SetFahrenheit(double t) { kelvin_ = FahrenheitToKelvin(t); }
  double Kelvin() const { return kelvin_; }
  double Celsius() const { return KelvinToCelsius(kelvin_); }
  double Fahrenheit() const { return KelvinToFahrenheit(kelvin_); }
  double operator()() const { return kelvin_; }
#define NOETIC_TEMPERATURE_OPERATOR(sign)                                                                            \
  Temperature operator sign(double t) const { return Temperature(kelvin_ sign t); }                                  \
  Temperature operator sign(const Temperature& t) const { return Temperature(kelvin_ sign t.kelvin_); }              \
  friend Temperature operator sign(double t, const Temperature& other) { return Temperature(t sign other.kelvin_); } \
  const Temperature& operator sign##=(double t) { return *this = *this sign t; }                                     \
  const Temperature& operator sign##=(const Temperature& t) { return *this = *this sign t; }
  NOETIC_TEMPERATURE_OPERATOR(+)
  NOETIC_TEMPERATURE_OPERATOR(-)
  NOETIC_TEMPERATURE_OPERATOR(*)
  NOETIC_TEMPERATURE_OPERATOR(/)
#undef NOETIC_TEMPERATURE_OPERATOR
  bool operator==(const Temperature& t) const { return equal(kelvin_, t.kelvin_); }
  bool operator!=(const Temperature& t) const { return !(*this == t); }
  bool operator<(const Temperature& t) const { return kelvin_ < t.kelvin_; }
  bool operator<=(const Temperature& t) const { return kelvin_ <= t.kelvin_; }
  bool operator>(const Temperature& t) const { return kelvin_ > t.kelvin_; }
  bool operator>=(const Temperature& t) const { return kelvin_ >= t.kelvin_; }
  friend std::ostream& operator<<(std::ostream& out, const Temperature& t) { return out << t.kelvin_; }
  friend std::istream& operator>>(std::istream& in, Temperature& t)
  {
    in.setf(std::ios_base::skipws);
    return in >> t.kelvin_;
  }

private:
  double kelvin_ = 0;
};

}  // namespace v6
}  // namespace math
}  // namespace ignition
