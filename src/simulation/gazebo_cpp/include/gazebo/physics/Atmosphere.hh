#pragma once
#include <string>

#include <sdf/sdf.hh>

#include <gazebo/util/system.hh>

namespace gazebo
{
namespace physics
{
class World;

/// The air of a world: K, Pa and kg/m^3 at an altitude in m. It presses on nothing by itself: plugins do.
class GAZEBO_VISIBLE Atmosphere
{
public:
  Atmosphere(class World& world, const sdf::ElementPtr& sdf);  // <atmosphere>, or null
  virtual ~Atmosphere() = default;
  virtual std::string Type() const = 0;
  virtual void SetTemperature(double temperature) { temperature_ = temperature; }
  virtual void SetPressure(double pressure) { pressure_ = pressure; }
  virtual void SetTemperatureGradient(double gradient) { gradient_ = gradient; }  // K/m
  virtual double Temperature(double altitude = 0.0) const;
  virtual double Pressure(double altitude = 0.0) const;
  virtual double MassDensity(double altitude = 0.0) const;
  double TemperatureGradient() const { return gradient_; }
  static const double MOLAR_MASS, IDEAL_GAS_CONSTANT_R;

private:
  class World& world_;
  double temperature_ = 288.15, gradient_ = -0.0065, pressure_ = 101325;
};

class GAZEBO_VISIBLE AdiabaticAtmosphere : public Atmosphere
{
public:
  using Atmosphere::Atmosphere;
  std::string Type() const override { return "adiabatic"; }
};

}  // namespace physics
}  // namespace gazebo
