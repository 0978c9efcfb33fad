#include "actuation.hpp"

#include <algorithm>
#include <stdexcept>

#include "joint.hpp"
#include "world.hpp"

namespace ode_sim {

namespace {

World& world_of(const Joint& joint) {
  if (!joint.model->world) throw std::runtime_error("this model is no longer in the world");
  return *joint.model->world;
}

}  // namespace

double joint_position(const Joint& joint) { return joint.axes[0].q; }

double joint_velocity(const Joint& joint) { return joint.axes[0].qd; }

double joint_load(const Joint& joint) {
  const Vec3 axis = rotate(joint.frame_W().q, joint.axes[0].xyz);
  return dot(axis, joint.type == JointType::Prismatic ? joint.feedback.child_force : joint.feedback.child_torque);
}

double joint_effort(const Joint& joint) { return joint.axes[0].effort_now(); }

void joint_drive(Joint& joint, double position) { world_of(joint).set_drive(joint, position); }

void joint_motor(Joint& joint, double velocity, double most_force) {
  world_of(joint);
  set_motor(joint.axes[0], velocity, std::max(most_force, 0.0));
}

void joint_push(Joint& joint, double force) {
  world_of(joint);
  add_force(joint.axes[0], force);
}

void joint_law(Joint& joint, double force, double slope, double most_force) {
  world_of(joint);
  add_law(joint.axes[0], force, slope, most_force);
}

}  // namespace ode_sim
