// The bodies, joints and contacts of a pass as rows, for the solvers that are not ODE's.
#pragma once
#include <vector>

#include "gazebo_solver.hpp"
#include "phases.hpp"

namespace ode_sim {

// Whose rows these are, and who is to be told what they bear.
struct RowOwner {
  dJointFeedback* feedback;
  Joint* joint;  // null: a weld or a contact
  size_t from, to;
};

// All joints and contacts of the scene, as Gazebo's ODE walks through them: from the newest body on, of each body the newest joint first,
// contacts before what the model was made with.
struct RowOrder {
  std::vector<Joint*> joints;
  std::vector<const Contact*> contacts;
};
RowOrder gazebo_order(Scene& scene, const StepState& state);

struct PassRows {
  PassRows(Scene& scene, StepState& state, const Pass& pass);
  std::vector<dBodyID> ids;
  std::vector<gazebo_like::Body> bodies;
  std::vector<gazebo_like::Row> rows;
  std::vector<RowOwner> owners;  // joints, welds, contacts
  size_t joints = 0;             // of the owners, those before the contacts

  void tell() const;
  void move(double dt) const;  // a step of the bodies by what the solver made of them
};

}  // namespace ode_sim
