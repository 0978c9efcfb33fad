// Joints as other libraries move and read them in every step: nobody else needs to know how a joint lies in memory, so that whatever
// stands on this alone need not be built again when the core's structures change. First axis; rad or m, and per s; N m or N.
#pragma once

namespace ode_sim {

struct Joint;

double joint_position(const Joint& joint);
double joint_velocity(const Joint& joint);
// Force or torque along the axis that the joint gave to its child in the last step. The joint must be watched.
double joint_load(const Joint& joint);
// The forces added since the last step; those of the step when none were.
double joint_effort(const Joint& joint);

// What is asked of a joint for the next step. Each refuses NaN by std::invalid_argument, and a model that is no longer in the world by
// std::runtime_error.
void joint_drive(Joint& joint, double position);                              // be there, exactly
void joint_motor(Joint& joint, double velocity, double most_force);           // until it is changed
void joint_push(Joint& joint, double force);                                  // add
void joint_law(Joint& joint, double force, double slope, double most_force);  // add that of a controller: see Axis::law

}  // namespace ode_sim
