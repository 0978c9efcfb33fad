#include <gazebo/sensors/Noise.hh>

#include <random>

#include "sensor_noise.hpp"

namespace gazebo
{
namespace sensors
{

namespace
{

double number(const sdf::ElementPtr& sdf, const char* tag) { return sdf->HasElement(tag) ? sdf->Get<double>(tag) : 0.0; }

}  // namespace

NoisePtr NoiseFactory::NewNoiseModel(sdf::ElementPtr sdf, const std::string&)
{
  // An attribute, or for rays an element.
  const std::string type =
      sdf && (sdf->HasAttribute("type") || sdf->HasElement("type")) ? sdf->Get<std::string>("type") : "none";
  NoisePtr noise;
  if (type == "gaussian" || type == "gaussian_quantized")
    noise.reset(new GaussianNoiseModel);
  else
    noise.reset(new Noise(type == "custom" ? Noise::CUSTOM : Noise::NONE));
  if (type == "gaussian_quantized")
    noise->type_ = Noise::GAUSSIAN_QUANTIZED;
  if (sdf)
    noise->Load(sdf);
  return noise;
}

void Noise::Load(sdf::ElementPtr sdf)
{
  mean_ = number(sdf, "mean"), stddev_ = number(sdf, "stddev");
  bias_mean_ = number(sdf, "bias_mean"), bias_stddev_ = number(sdf, "bias_stddev");
  walk_stddev_ = number(sdf, "dynamic_bias_stddev"), walk_time_ = number(sdf, "dynamic_bias_correlation_time");
  precision_ = number(sdf, "precision");
}

void Noise::Seed(const std::string& name)
{
  uint64_t seed = 1469598103934665603ull;  // FNV-1a: the same on each machine
  for (const unsigned char c : name)
    seed = (seed ^ c) * 1099511628211ull;
  random_.seed(seed);
}

void Noise::SetCustomNoiseCallback(std::function<double(double)> callback)
{
  custom_ = std::move(callback);
  type_ = CUSTOM;
}

double Noise::Apply(double value, double dt)
{
  if (type_ == NONE)
    return value;
  if (type_ == CUSTOM)
    return custom_ ? custom_(value) : value;
  return ApplyImpl(value, dt);
}

double Noise::ApplyImpl(double value, double dt)
{
  namespace law = ode_sim::noise;
  if (!drawn_)
  {
    drawn_ = true;
    if (bias_mean_ != 0 || bias_stddev_ != 0)
      bias_ = law::drawn_bias(bias_mean_, bias_stddev_, draw(), std::generate_canonical<double, 53>(random_));
  }
  if (law::wanders(walk_stddev_, walk_time_, dt))
    bias_ = law::wandered_bias(bias_, walk_stddev_, walk_time_, dt, draw());
  return law::measured(value, bias_, mean_, stddev_, precision_, stddev_ != 0 ? draw() : 0);
}

}  // namespace sensors
}  // namespace gazebo
