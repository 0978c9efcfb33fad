// Contacts as plain data.
#pragma once
#include <cstdint>

#include "math.hpp"
#include "ode.hpp"

namespace ode_sim {

struct Shape;

struct Contact {
  Shape *a = nullptr, *b = nullptr;
  Vec3 pos, normal;  // world axes; the normal points into a
  double depth = 0;  // m
  int count = 1;     // contacts of this pair
  int merged = 1;    // how many it stands for, side by side
  dJointID joint = nullptr;
  bool swapped = false;  // ODE's first body is that of b
  int feedback = -1;     // in StepState::feedback
  bool told = false;     // who asks for forces is told this one
  int row = -1;          // in StepState::ode_contacts
  double fastest = 0;    // m/s, of pushing apart
  double spin_slip = 0;  // rad/s for one N m of torsional friction
};

// What a contact of the last step bore, from which the next one's greatest friction follows.
struct Borne {
  int a = 0, b = 0;  // shapes
  Vec3 pos;
  double normal = 0;  // N
};

#pragma pack(push, 1)
struct ContactRecord {
  int32_t collision1, collision2;
  double position[3], normal[3], depth, force[3], torque[3];
};
#pragma pack(pop)

}  // namespace ode_sim
