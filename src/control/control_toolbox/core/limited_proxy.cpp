#include <control_toolbox/limited_proxy.h>

#include <algorithm>
#include <cmath>

namespace control_toolbox
{
namespace
{

double bounded(double value, double bound) { return std::min(std::max(value, -bound), bound); }

/// Velocity with which the proxy closes an error: linear nearby, that of a constant deceleration far away.
double approach(double error, double acceleration, double lambda)
{
  const double knee = acceleration / (lambda * lambda);
  if (!(lambda > 0.0) || std::abs(error) <= knee)
    return lambda * error;
  return std::copysign(std::sqrt(acceleration * (2.0 * std::abs(error) - knee)), error);
}

}  // namespace

void LimitedProxy::reset(double pos_act, double vel_act)
{
  position_ = pos_act;
  velocity_ = vel_act;
  integral_ = 0.0;
}

double LimitedProxy::update(double pos_des, double vel_des, double acc_des, double pos_act, double vel_act, double dt)
{
  if (!(dt > 0.0))
    return 0.0;
  if (pos_lower_limit_ < pos_upper_limit_)
    pos_des = std::min(std::max(pos_des, pos_lower_limit_), pos_upper_limit_);
  const double wanted = bounded(vel_des + approach(pos_des - position_, acc_converge_, lambda_proxy_), vel_limit_);
  double velocity = bounded(velocity_ + (acc_des + (wanted - velocity_) / dt) * dt, vel_limit_);
  const double integral = bounded(integral_ + Ki_ * (position_ - pos_act) * dt, Ficl_);
  // The effort is linear in the proxy's velocity.
  const double slope = Kp_ * dt + Kd_ + mass_ / dt;
  const double rest = Kp_ * (position_ - pos_act) + integral - Kd_ * vel_act - mass_ * velocity_ / dt;
  const double unlimited = slope * velocity + rest;
  const double effort = bounded(unlimited, effort_limit_);
  if (effort == unlimited)
    integral_ = integral;
  else if (slope > 0.0)
    velocity = (effort - rest) / slope;  // the joint cannot follow: the proxy waits where it pulls enough
  velocity_ = velocity;
  position_ += velocity * dt;
  return effort;
}

}  // namespace control_toolbox
