#pragma once
#include <cstdint>
#include <istream>

#include <ignition/math/Helpers.hh>
#include <ignition/math/Vector3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// Parts from 0 to 1; larger ones are taken for those from 0 to 255.
class IGNITION_MATH_VISIBLE Color
{
public:
  static const Color White, Black, Red, Green, Blue, Yellow, Magenta, Cyan;
  typedef unsigned int RGBA, BGRA, ARGB, ABGR;

  Color() = default;
  Color(float r, float g, float b, float a = 1.0f) { Set(r, g, b, a); }
  Color(const Color& color) = default;
  virtual ~Color() = default;
  Color& operator=(const Color& color) = default;

  void Reset() { *this = Color(0, 0, 0, 1); }
  void Set(float r = 1, float g = 1, float b = 1, float a = 1);
  Vector3f HSV() const;
  void SetFromHSV(float h, float s, float v);
  Vector3f YUV() const;
  void SetFromYUV(float y, float u, float v);
  float operator[](unsigned int index) { return index < 4 ? part(index) : NAN_F; }
  RGBA AsRGBA() const { return packed(0, 1, 2, 3); }
  BGRA AsBGRA() const { return packed(2, 1, 0, 3); }
  ARGB AsARGB() const { return packed(3, 0, 1, 2); }
  ABGR AsABGR() const { return packed(3, 2, 1, 0); }
  void SetFromRGBA(RGBA v) { unpack(v, 0, 1, 2, 3); }
  void SetFromBGRA(BGRA v) { unpack(v, 2, 1, 0, 3); }
  void SetFromARGB(ARGB v) { unpack(v, 3, 0, 1, 2); }
  void SetFromABGR(ABGR v) { unpack(v, 3, 2, 1, 0); }

  Color operator+(const Color& c) const { return Color(r_ + c.r_, g_ + c.g_, b_ + c.b_, a_ + c.a_); }
  Color operator-(const Color& c) const { return Color(r_ - c.r_, g_ - c.g_, b_ - c.b_, a_ - c.a_); }
  const Color operator*(const Color& c) const { return Color(r_ * c.r_, g_ * c.g_, b_ * c.b_, a_ * c.a_); }
  const Color operator/(const Color& c) const { return Color(r_ / c.r_, g_ / c.g_, b_ / c.b_, a_ / c.a_); }
  Color operator+(const float& v) const { return Color(r_ + v, g_ + v, b_ + v, a_ + v); }
  Color operator-(const float& v) const { return Color(r_ - v, g_ - v, b_ - v, a_ - v); }
  const Color operator*(const float& v) const { return Color(r_ * v, g_ * v, b_ * v, a_ * v); }
  const Color operator/(const float& v) const { return Color(r_ / v, g_ / v, b_ / v, a_ / v); }
  const Color& operator+=(const Color& c) { return *this = *this + c; }
  const Color& operator-=(const Color& c) { return *this = *this - c; }
  const Color& operator*=(const Color& c) { return *this = *this * c; }
  const Color& operator/=(const Color& c) { return *this = *this / c; }
  bool operator==(const Color& c) const { return equal(r_, c.r_) && equal(g_, c.g_) && equal(b_, c.b_) && equal(a_, c.a_); }
  bool operator!=(const Color& c) const { return !(*this == c); }
  friend std::ostream& operator<<(std::ostream& out, const Color& c)
  {
    return out << c.r_ << " " << c.g_ << " " << c.b_ << " " << c.a_;
  }
  friend std::istream& operator>>(std::istream& in, Color& c);

  float R() const { return r_; }
  float G() const { return g_; }
  float B() const { return b_; }
  float A() const { return a_; }
  float& R() { return r_; }
  float& G() { return g_; }
  float& B() { return b_; }
  float& A() { return a_; }
  void R(float v) { r_ = v; }
  void G(float v) { g_ = v; }
  void B(float v) { b_ = v; }
  void A(float v) { a_ = v; }

private:
  const float& part(unsigned int index) const { return index == 0 ? r_ : index == 1 ? g_ : index == 2 ? b_ : a_; }
  unsigned int packed(unsigned int first, unsigned int second, unsigned int third, unsigned int last) const;
  void unpack(unsigned int v, unsigned int first, unsigned int second, unsigned int third, unsigned int last);

  float r_ = 0, g_ = 0, b_ = 0, a_ = 1;
};

inline const Color Color::White(1, 1, 1, 1), Color::Black(0, 0, 0, 1), Color::Red(1, 0, 0, 1), Color::Green(0, 1, 0, 1);
inline const Color Color::Blue(0, 0, 1, 1), Color::Yellow(1, 1, 0, 1), Color::Magenta(1, 0, 1, 1), Color::Cyan(0, 1, 1, 1);

}  // namespace v6
}  // namespace math
}  // namespace ignition
