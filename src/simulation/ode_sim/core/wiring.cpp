#include "wiring.hpp"

#include <cmath>
#include <stdexcept>

#include "world.hpp"

namespace ode_sim {

namespace {

// Force or torque along the axis that the joint gave to its child in the last step.
double load_along_axis(const Joint& joint) {
  const Vec3 axis = rotate(joint.frame_W().q, joint.axes[0].xyz);
  return dot(axis, joint.type == JointType::Prismatic ? joint.feedback.child_force : joint.feedback.child_torque);
}

double saturated(double v, double low, double high) { return v < low ? low : v > high ? high : v; }

}  // namespace

std::pair<double, double> corridor(const CommandLimits& l, double position, double velocity, double previous, double dt) {
  const double v = l.velocity;
  switch (l.rule) {
    case CommandLimits::PositionSaturation: {
      const double step = v * dt, low = previous - step, high = previous + step;
      return {low > l.low ? low : l.low, high < l.high ? high : l.high};
    }
    case CommandLimits::PositionSoft: {
      const double slowest = l.has_position ? saturated(-l.k_position * (previous - l.soft_low), -v, v) : -v;
      const double fastest = l.has_position ? saturated(-l.k_position * (previous - l.soft_high), -v, v) : v;
      const double low = previous + slowest * dt, high = previous + fastest * dt;
      return {low > l.low ? low : l.low, high < l.high ? high : l.high};
    }
    case CommandLimits::VelocitySaturation:
    case CommandLimits::VelocitySoft: {
      double low = -v, high = v, from = previous;
      if (l.rule == CommandLimits::VelocitySoft) {
        from = velocity;
        if (l.has_position) {
          low = saturated(-l.k_position * (position - l.soft_low), -v, v);
          high = saturated(-l.k_position * (position - l.soft_high), -v, v);
        }
      }
      if (l.acceleration < kInf) {
        const double step = l.acceleration * dt;
        low = low > from - step ? low : from - step;
        high = high < from + step ? high : from + step;
      }
      return {low, high};
    }
    case CommandLimits::EffortSaturation: {
      const bool below = position < l.low || velocity<-v, above = position> l.high || velocity > v;
      return {below ? 0.0 : -l.effort, above ? 0.0 : l.effort};
    }
    case CommandLimits::EffortSoft: break;
  }
  const double slowest = l.has_position ? saturated(-l.k_position * (position - l.soft_low), -v, v) : -v;
  const double fastest = l.has_position ? saturated(-l.k_position * (position - l.soft_high), -v, v) : v;
  return {saturated(-l.k_velocity * (velocity - slowest), -l.effort, l.effort),
          saturated(-l.k_velocity * (velocity - fastest), -l.effort, l.effort)};
}

double kept_within(double command, double low, double high, double held) {
  double out = command < low ? low : command;
  out = out > high ? high : out;
  if (std::isfinite(out)) return out;
  out = saturated(held, low, high);
  return std::isfinite(out) ? out : held;  // the limits themselves may be no numbers to be at
}

int Wiring::add_joint(std::shared_ptr<Joint> joint, const Places& places) {
  if (!places.position || !places.velocity)
    throw std::invalid_argument("a wired joint needs places for its position and velocity");
  joints_.push_back({std::move(joint), places});
  return static_cast<int>(joints_.size()) - 1;
}

int Wiring::add_command(int joint, const Command& command) {
  if (joint < 0 || static_cast<size_t>(joint) >= joints_.size())
    throw std::out_of_range("a command for a joint that is not wired");
  if (!command.command) throw std::invalid_argument("a command needs a place");
  Working c;
  static_cast<Command&>(c) = command;
  c.joint = joint;
  commands_.push_back(c);
  return static_cast<int>(commands_.size()) - 1;
}

void Wiring::read() {
  for (auto& [joint, places, by_load] : joints_) {
    *places.position = joint->axes[0].q;
    *places.velocity = joint->axes[0].qd;
    if (by_load && places.effort) *places.effort = load_along_axis(*joint);
  }
}

std::vector<Wiring::Refused> Wiring::write(double dt) {
  std::vector<Refused> refused;
  for (size_t i = 0; i < commands_.size(); ++i) {
    Working& c = commands_[i];
    if (!c.working) continue;
    const Places& at = joints_[c.joint].places;
    const bool from_measured = std::isnan(c.previous);
    const double held = from_measured ? *at.position : c.previous;
    const auto [low, high] = corridor(c.limits, *at.position, *at.velocity, held, dt);
    const double wanted = *c.command, cut = wanted < low ? low : wanted;
    if (!std::isfinite(cut > high ? high : cut)) refused.push_back({static_cast<int>(i), wanted, held});
    *c.command = c.previous = kept_within(wanted, low, high, held);
    give(c, wanted);
  }
  return refused;
}

void Wiring::give(const Working& c, double wanted) {
  Joint& joint = *joints_[c.joint].joint;
  if (!joint.model->world) throw std::runtime_error("this model is no longer in the world");
  Axis& axis = joint.axes[0];
  const double allowed = *c.command;
  switch (c.limits.rule) {
    case CommandLimits::PositionSaturation:
    case CommandLimits::PositionSoft: joint.model->world->set_drive(joint, allowed); return;
    case CommandLimits::VelocitySaturation:
    case CommandLimits::VelocitySoft: set_motor(axis, allowed, std::max(c.effort_limit, 0.0)); return;
    default: break;
  }
  const double slope = c.slope ? *c.slope : 0;
  // What other limits than that of the effort made of a command is no law.
  const bool by_effort = c.effort_limit <= std::abs(allowed) && std::abs(allowed) < std::abs(wanted) && std::abs(wanted) < kInf;
  if (slope != 0 && (wanted == allowed || by_effort)) add_law(axis, wanted, slope, c.effort_limit);
  else add_force(axis, allowed);
  if (double* effort = joints_[c.joint].places.effort) *effort = axis.effort_now();
}

}  // namespace ode_sim
