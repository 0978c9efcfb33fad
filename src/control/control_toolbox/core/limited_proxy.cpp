// The law is upstream's. The proxy at p (position), v, a follows the target by
//
//   a = a_des - 2 lambda (v - v_des) - lambda^2 e,  e = p - p_des, nearby (|lambda^2 e| <= 3 acc), farther off
//   a = a_des - 2 lambda (v - v_des) -+ (sqrt(8 acc (|lambda^2 e| - acc)) - acc),  which brakes with acc and never overshoots,
//
// integrated by trapezoids: the equation is linear in a about a = 0. Bounds of the speed are approached at the rate lambda. The force is
// m a - Kd (v_act - v) - Kp (x_act - p) - clamp(Ki integral(x_act - p), Ficl); where it is beyond its limit, the proxy is moved as far as it
// takes to make it the limit: by its acceleration, without a mass by its velocity, without damping by its position.
//
// A limit or a lambda of 0 means none; with lambda = 0 the proxy is where the target is. Signs of parameters do not count.
#include <control_toolbox/limited_proxy.h>

#include <algorithm>
#include <cmath>

namespace control_toolbox
{
namespace
{

double bounded(double value, double bound) { return std::min(std::max(value, -bound), bound); }

/// Of an acceleration: its value, and how it changes with position and velocity.
struct Linear
{
  double value, by_position, by_velocity;
  /// What it is at the end of a step in which it acts.
  double implicit(double dt, double ahead = 0.0) const
  {
    return (ahead + value) / (1.0 - by_velocity * dt / 2 - by_position * dt * dt / 4);
  }
};

Linear approach(double error, double velocity, double lambda, double acceleration)
{
  const double stiffness = lambda * lambda, far = std::abs(stiffness * error) - acceleration;
  if (far <= 2 * acceleration)
    return { -2 * lambda * velocity - stiffness * error, -stiffness, -2 * lambda };
  const double braking = std::copysign(std::sqrt(8 * acceleration * far) - acceleration, error);
  return { -2 * lambda * velocity - braking, -stiffness * std::sqrt(2 * acceleration / far), -2 * lambda };
}

/// Of the speed, to a bound that is so far off.
Linear slowing(double beyond, double lambda) { return { -lambda * beyond, 0.0, -lambda }; }

}  // namespace

void LimitedProxy::reset(double pos_act, double vel_act)
{
  position_ = pos_act;
  velocity_ = vel_act;
  acceleration_ = position_error_ = integral_ = 0.0;
}

void LimitedProxy::follow(double pos_des, double vel_des, double acc_des, double dt)
{
  const double lambda = dt > 0.0 ? std::min(std::abs(lambda_proxy_), 2.0 / dt) : std::abs(lambda_proxy_);
  if (!(lambda > 0.0))
  {
    position_ = pos_des, velocity_ = vel_des, acceleration_ = acc_des;
    return;
  }
  const double fastest = std::abs(vel_limit_);
  const double v = velocity_ + dt / 2 * acceleration_, p = position_ + dt / 2 * (velocity_ + v);  // with an acceleration of 0
  double a = approach(p - pos_des, v - vel_des, lambda, std::abs(acc_converge_)).implicit(dt, acc_des);
  if (fastest > 0.0)
    a = std::min(std::max(a, slowing(v + fastest, lambda).implicit(dt)), slowing(v - fastest, lambda).implicit(dt));
  position_ = p + dt * dt / 4 * a;
  velocity_ = v + dt / 2 * a;
  acceleration_ = a;
}

double LimitedProxy::update(double pos_des, double vel_des, double acc_des, double pos_act, double vel_act, double dt)
{
  dt = dt > 0.0 ? dt : 0.0;
  const double mass = std::abs(mass_), kd = std::abs(Kd_), kp = std::abs(Kp_), ki = std::abs(Ki_), clamp = std::abs(Ficl_);
  follow(pos_des, vel_des, acc_des, dt);
  double error = pos_act - position_, sum = integral_ + dt / 2 * (position_error_ + error);
  const double coupling = mass * acceleration_ - kd * (vel_act - velocity_) - kp * error;
  double force = coupling - bounded(ki * sum, clamp);
  const double limit = std::abs(effort_limit_);
  if (limit > 0.0)
  {
    force = bounded(force, limit);
    // By how much acceleration, velocity, position and the errors' sum of the proxy change with what is moved.
    const double half = dt / 2, by_a = mass > 0.0 ? 1.0 : 0.0, by_v = mass > 0.0 ? half : kd > 0.0 ? 1.0 : 0.0;
    const double by_p = mass > 0.0 || kd > 0.0 ? half * by_v : 1.0, by_sum = half * by_p;
    const double stiff = mass * by_a + kd * by_v + kp * by_p, integral = -ki * sum;
    if (stiff > 0.0)
    {
      double moved = (force - coupling - integral) / (stiff + ki * by_sum);
      if (std::abs(integral + moved * ki * by_sum) > clamp)
        moved = (force - coupling - std::copysign(clamp, integral + moved * ki * by_sum)) / stiff;
      acceleration_ += moved * by_a, velocity_ += moved * by_v, position_ += moved * by_p;
      error -= moved * by_p, sum -= moved * by_sum;
    }
  }
  position_error_ = error;
  integral_ = ki > 0.0 ? bounded(sum, clamp / ki) : sum;
  return force;
}

}  // namespace control_toolbox
