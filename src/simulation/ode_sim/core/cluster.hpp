// Links that are rigidly joined at the moment - by fixed joints, or by position drives - are one cluster: one ODE body with composite
// mass, or no body when it hangs from the world. Every link owns one dBody, created with it; a cluster uses that of its root link, so
// that the order of bodies, and with it every sum, never depends on the past.
//
// What hangs by ODE joints (or welds) on a link that position drives move is "carried". Where the world holds the cluster, that link
// has a kinematic body. Where it floats, the joints hang on the cluster's body itself: their forces act on all of it. The body of a
// carried cluster then holds its velocity without what the position drives give it (Cluster::carry_v, carry_w), in which frame the
// joints close; after the step it is moved along with the link.
#pragma once
#include <vector>

#include "math.hpp"

namespace ode_sim {

struct Link;
struct Joint;

struct Cluster {
  int at = 0;                  // in StepState::clusters
  Link* root = nullptr;        // null: anchored in the world
  std::vector<Link*> members;  // breadth first from the root
  bool moving = false;         // some position drive inside
  bool has_joints = false;
  bool carriers = false;  // some member has a kinematic body
  double mass = 0;
  Vec3 com;      // in the root frame
  Sym3 inertia;  // about the CoM, root axes
  bool uniform_gravity = true;
  double gravity_mass = 0;
  Vec3 gravity_com;
  // Sleeping.
  bool asleep = false;
  int idle_steps = 0;
  double idle_time = 0;
  // Carried: `held`, a member, hangs on `by`; pose and velocity of it in the frame of `by`, as ODE's joints have left them.
  Link *by = nullptr, *held = nullptr;
  Pose X_by_held;
  Vec3 v_by_held, w_by_held;
  Vec3 carry_v, carry_w;  // true velocity (of the CoM) less that of the body
};

// One joint of the tree in which joint positions are projected, and the cluster that follows from it.
struct Branch {
  Joint* joint;
  int cluster;
  int head;      // first cluster of a tree that floats free, -1 when the world holds it
  bool outward;  // the child's cluster follows the parent's
};

}  // namespace ode_sim
