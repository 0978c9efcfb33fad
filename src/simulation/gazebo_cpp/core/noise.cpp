#include <gazebo/sensors/Noise.hh>

#include <cmath>

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
  const std::string type = sdf && sdf->HasAttribute("type") ? sdf->Get<std::string>("type") : "none";
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
  precision_ = type_ == GAUSSIAN_QUANTIZED ? number(sdf, "precision") : 0;
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
  if (!drawn_)
  {
    drawn_ = true;
    if (bias_stddev_ > 0)
      bias_ = (bias_mean_ + bias_stddev_ * draw()) * (draw() < 0 ? -1 : 1);
  }
  if (walk_stddev_ > 0 && walk_time_ > 0 && dt > 0)  // first-order Gauss-Markov process
  {
    const double sigma = walk_stddev_ * std::sqrt(-walk_time_ / 2 * std::expm1(-2 * dt / walk_time_));
    bias_ = std::exp(-dt / walk_time_) * bias_ + sigma * draw();
  }
  value += bias_ + mean_;
  if (stddev_ > 0)
    value += stddev_ * draw();
  return precision_ > 0 ? std::round(value / precision_) * precision_ : value;
}

}  // namespace sensors
}  // namespace gazebo
