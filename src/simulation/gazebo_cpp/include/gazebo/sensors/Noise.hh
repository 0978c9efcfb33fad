// Noise of sensors, as <noise> describes it: the same values in each run.
#pragma once
#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include <sdf/sdf.hh>

#include <gazebo/sensors/SensorTypes.hh>
#include <gazebo/common/common.hh>

namespace gazebo
{
namespace sensors
{

/// value + bias + N(mean, stddev); the bias is drawn once, and wanders where <dynamic_bias_stddev> says so.
class GAZEBO_VISIBLE Noise
{
public:
  enum NoiseType
  {
    NONE,
    CUSTOM,
    GAUSSIAN,
    GAUSSIAN_QUANTIZED
  };

  explicit Noise(NoiseType type) : type_(type) {}
  virtual ~Noise() = default;
  virtual void Load(sdf::ElementPtr sdf);
  double Apply(double value, double dt = 0);  // dt: s since the last value
  virtual double ApplyImpl(double value, double dt);
  NoiseType GetNoiseType() const { return type_; }
  virtual void SetCustomNoiseCallback(std::function<double(double)> callback);
  virtual void Fini() {}
  void Seed(const std::string& name);  // of the sensor and the value

protected:
  double draw() { return normal_(random_); }
  double mean_ = 0, stddev_ = 0, bias_ = 0, precision_ = 0;

private:
  friend class NoiseFactory;
  NoiseType type_;
  std::function<double(double)> custom_;
  double bias_mean_ = 0, bias_stddev_ = 0, walk_stddev_ = 0, walk_time_ = 0;
  bool drawn_ = false;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

class GAZEBO_VISIBLE GaussianNoiseModel : public Noise
{
public:
  GaussianNoiseModel() : Noise(GAUSSIAN) {}
  double GetMean() const { return mean_; }
  double GetStdDev() const { return stddev_; }
  double GetBias() const { return bias_; }
};

class GAZEBO_VISIBLE NoiseFactory
{
public:
  /// \param sdf <noise>; none: values stay as they are
  static NoisePtr NewNoiseModel(sdf::ElementPtr sdf, const std::string& sensor_type = "");
};

}  // namespace sensors
}  // namespace gazebo
