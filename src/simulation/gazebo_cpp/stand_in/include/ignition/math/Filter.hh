#pragma once
#include <ignition/math/Helpers.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// fc: the frequency from which on changes are held back; fs: how often Process is called a second.
template <class T>
class Filter
{
public:
  virtual ~Filter() = default;
  virtual void Set(const T& value) { y0 = value; }
  virtual void Fc(double fc, double fs) = 0;
  virtual const T& Value() const { return y0; }

protected:
  T y0{};
};

template <class T>
class OnePole : public Filter<T>
{
public:
  OnePole() = default;
  OnePole(double fc, double fs) { Fc(fc, fs); }
  void Fc(double fc, double fs) override
  {
    b1 = std::exp(-2.0 * IGN_PI * fc / fs);
    a0 = 1.0 - b1;
  }
  const T& Process(const T& x) { return this->y0 = x * a0 + this->y0 * b1; }

protected:
  double a0 = 0, b1 = 0;
};

class OnePoleQuaternion : public OnePole<Quaterniond>
{
public:
  OnePoleQuaternion() { Set(Quaterniond(1, 0, 0, 0)); }
  OnePoleQuaternion(double fc, double fs) : OnePole<Quaterniond>(fc, fs) { Set(Quaterniond(1, 0, 0, 0)); }
  const Quaterniond& Process(const Quaterniond& x) { return y0 = Quaterniond::Slerp(a0, y0, x); }
};

class OnePoleVector3 : public OnePole<Vector3d>
{
public:
  OnePoleVector3() { Set(Vector3d(0, 0, 0)); }
  OnePoleVector3(double fc, double fs) : OnePole<Vector3d>(fc, fs) { Set(Vector3d(0, 0, 0)); }
};

/// A low pass of second order.
template <class T>
class BiQuad : public Filter<T>
{
public:
  BiQuad() = default;
  BiQuad(double fc, double fs) { Fc(fc, fs); }
  void Fc(double fc, double fs) override { Fc(fc, fs, 0.5); }
  void Fc(double fc, double fs, double q)
  {
    const double k = std::tan(IGN_PI * fc / fs), square = k * k, scale = 1 / (square * q + k + q);
    a0 = square * q * scale;
    a1 = 2 * a0;
    a2 = a0;
    b1 = 2 * q * (square - 1) * scale;
    b2 = (square * q - k + q) * scale;
  }
  void Set(const T& value) override { this->y0 = y1 = y2 = x1 = x2 = value; }
  virtual const T& Process(const T& x)
  {
    this->y0 = x * a0 + x1 * a1 + x2 * a2 - y1 * b1 - y2 * b2;
    x2 = x1;
    x1 = x;
    y2 = y1;
    y1 = this->y0;
    return this->y0;
  }

protected:
  double a0 = 0, a1 = 0, a2 = 0, b1 = 0, b2 = 0;
  T x1{}, x2{}, y1{}, y2{};
};

class BiQuadVector3 : public BiQuad<Vector3d>
{
public:
  BiQuadVector3() { Set(Vector3d(0, 0, 0)); }
  BiQuadVector3(double fc, double fs) : BiQuad<Vector3d>(fc, fs) { Set(Vector3d(0, 0, 0)); }
};

}  // namespace v6
}  // namespace math
}  // namespace ignition
