#include "imu_complementary_filter/complementary_filter.h"

#include <algorithm>
#include <cmath>

namespace {
const double kGravity = 9.81;                                    // m/s^2
const double kOffGravity = 0.1, kChange = 0.01, kOffBias = 0.2;  // m/s^2, rad/s, rad/s: less than these is standing still

struct Vector {
  double x, y, z;
};

struct Quaternion {
  double w, x, y, z;
};

double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vector cross(const Vector& a, const Vector& b) {
  return Vector{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// False, and v as before, where v is not longer than least, or no number.
bool normalize(Vector& v, double least = 0.0) {
  const double length = std::sqrt(dot(v, v));
  if (!std::isfinite(length) || !(length > least)) return false;
  v = Vector{v.x / length, v.y / length, v.z / length};
  return true;
}

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return Quaternion{a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                    a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Quaternion conjugate(const Quaternion& q) { return Quaternion{q.w, -q.x, -q.y, -q.z}; }

Vector turned(const Quaternion& q, const Vector& v) {
  const Quaternion r = product(product(q, Quaternion{0.0, v.x, v.y, v.z}), conjugate(q));
  return Vector{r.x, r.y, r.z};
}

Quaternion about(const Vector& axis, double angle) {
  const double sine = std::sin(angle / 2);
  return Quaternion{std::cos(angle / 2), axis.x * sine, axis.y * sine, axis.z * sine};
}

/// The smallest turn that brings the reading of gravity upright.
Quaternion towards(const Vector& seen, const Vector& expected, double share) {
  Vector axis = cross(seen, expected);
  const double sine = std::sqrt(dot(axis, axis));
  if (!normalize(axis, 1e-12))
    axis = std::abs(seen.x) < 0.9 ? cross(seen, Vector{1, 0, 0}) : cross(seen, Vector{0, 1, 0}), normalize(axis);
  return about(axis, share * std::atan2(sine, dot(seen, expected)));
}
}  // namespace

namespace imu_tools {
ComplementaryFilter::ComplementaryFilter()
    : gain_acc_(0.01), gain_mag_(0.01), bias_alpha_(0.01), do_bias_estimation_(true), do_adaptive_gain_(false) {
  reset();
}

ComplementaryFilter::~ComplementaryFilter() {}

namespace {
bool setShare(double& share, double value) {
  if (!(value >= 0.0 && value <= 1.0)) return false;
  share = value;
  return true;
}
}  // namespace

bool ComplementaryFilter::setGainAcc(double gain) { return setShare(gain_acc_, gain); }

bool ComplementaryFilter::setGainMag(double gain) { return setShare(gain_mag_, gain); }

bool ComplementaryFilter::setBiasAlpha(double bias_alpha) { return setShare(bias_alpha_, bias_alpha); }

double ComplementaryFilter::getGainAcc() const { return gain_acc_; }

double ComplementaryFilter::getGainMag() const { return gain_mag_; }

double ComplementaryFilter::getBiasAlpha() const { return bias_alpha_; }

void ComplementaryFilter::setDoBiasEstimation(bool do_bias_estimation) { do_bias_estimation_ = do_bias_estimation; }

bool ComplementaryFilter::getDoBiasEstimation() const { return do_bias_estimation_; }

void ComplementaryFilter::setDoAdaptiveGain(bool do_adaptive_gain) { do_adaptive_gain_ = do_adaptive_gain; }

bool ComplementaryFilter::getDoAdaptiveGain() const { return do_adaptive_gain_; }

bool ComplementaryFilter::getSteadyState() const { return steady_state_; }

double ComplementaryFilter::getAngularVelocityBiasX() const { return bias_[0]; }

double ComplementaryFilter::getAngularVelocityBiasY() const { return bias_[1]; }

double ComplementaryFilter::getAngularVelocityBiasZ() const { return bias_[2]; }

void ComplementaryFilter::setOrientation(double q0, double q1, double q2, double q3) {
  const double q[4] = {q0, q1, q2, q3};
  std::copy(q, q + 4, orientation_);
}

void ComplementaryFilter::getOrientation(double& q0, double& q1, double& q2, double& q3) const {
  q0 = orientation_[0], q1 = orientation_[1], q2 = orientation_[2], q3 = orientation_[3];
}

void ComplementaryFilter::update(double ax, double ay, double az, double wx, double wy, double wz, double dt) {
  const double acceleration[3] = {ax, ay, az}, rate[3] = {wx, wy, wz};
  take(acceleration, rate, nullptr, dt);
}

void ComplementaryFilter::update(double ax, double ay, double az, double wx, double wy, double wz, double mx, double my,
                                 double mz, double dt) {
  const double acceleration[3] = {ax, ay, az}, rate[3] = {wx, wy, wz}, field[3] = {mx, my, mz};
  take(acceleration, rate, field, dt);
}

void ComplementaryFilter::reset() {
  initialized_ = steady_state_ = false;
  setOrientation(1.0, 0.0, 0.0, 0.0);
  std::fill(bias_, bias_ + 3, 0.0);
  std::fill(before_, before_ + 3, 0.0);
}

void ComplementaryFilter::take(const double acceleration[3], const double rate[3], const double* field, double dt) {
  const Vector up = {0.0, 0.0, 1.0};
  Quaternion q = {orientation_[0], orientation_[1], orientation_[2], orientation_[3]};
  double share = 1.0, share_of_yaw = 1.0;  // the first reading counts in full
  if (initialized_) {
    if (do_bias_estimation_) lookForBias(acceleration, rate);
    const Vector w = {rate[0] - bias_[0], rate[1] - bias_[1], rate[2] - bias_[2]};
    const double speed = std::sqrt(dot(w, w));
    if (speed * std::abs(dt) > 1e-12) q = product(q, about(Vector{w.x / speed, w.y / speed, w.z / speed}, speed * dt));
    share = trust(acceleration), share_of_yaw = gain_mag_;
  } else q = Quaternion{1.0, 0.0, 0.0, 0.0};
  Vector seen = {acceleration[0], acceleration[1], acceleration[2]};
  const bool weighed = normalize(seen, initialized_ ? 0.0 : 1e-3);
  if (weighed) q = product(q, towards(seen, turned(conjugate(q), up), share));
  if (field != nullptr) {
    const Vector flux = turned(q, Vector{field[0], field[1], field[2]});
    if (flux.x != 0.0 || flux.y != 0.0) q = product(about(up, -share_of_yaw * std::atan2(flux.y, flux.x)), q);
  }
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (std::isfinite(length) && length > 0.0 && (initialized_ || weighed)) {
    setOrientation(q.w / length, q.x / length, q.y / length, q.z / length);
    initialized_ = true;
  }
  std::copy(rate, rate + 3, before_);
}

void ComplementaryFilter::lookForBias(const double acceleration[3], const double rate[3]) {
  const Vector a = {acceleration[0], acceleration[1], acceleration[2]};
  steady_state_ = std::abs(std::sqrt(dot(a, a)) - kGravity) <= kOffGravity;
  for (int i = 0; i < 3; ++i)
    steady_state_ = steady_state_ && std::abs(rate[i] - before_[i]) <= kChange && std::abs(rate[i] - bias_[i]) <= kOffBias;
  if (steady_state_)
    for (int i = 0; i < 3; ++i) bias_[i] += bias_alpha_ * (rate[i] - bias_[i]);
}

double ComplementaryFilter::trust(const double acceleration[3]) const {
  if (!do_adaptive_gain_) return gain_acc_;
  const Vector a = {acceleration[0], acceleration[1], acceleration[2]};
  const double off = std::abs(std::sqrt(dot(a, a)) - kGravity) / kGravity;
  return gain_acc_ * std::min(std::max(2.0 - 10.0 * off, 0.0), 1.0);
}
}  // namespace imu_tools
