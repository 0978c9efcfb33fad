// Islands of many jointed bodies: trees of joints exactly, in a time that grows with their number, and the rest by iterations.
//
// Iterations over all rows of a long tree do not get round it in a step: a rover on sixty rollers creeps. Here each joint is eliminated
// between its child and its parent, from the leaves to the root (as Featherstone's articulated bodies, or Baraff's sparse factors), so
// that what is left is small and dense: contacts, stops, motors with a limit, and the joints that close loops (bounded_rows.hpp).
#pragma once
#include <vector>

#include "gazebo_solver.hpp"

namespace ode_sim::trees {

using gazebo_like::Body;
using gazebo_like::Row;

// A joint: its rows. One of them that has bounds is left to the iterations.
struct Branch {
  size_t from = 0, to = 0;
};

struct Settings {
  double dt = 0.001;
  int iterations = 50;          // at least
  size_t most_rest = 400;       // rows that are left to the iterations; their time grows with the square
  size_t most_steps = 2000000;  // of all their ways to the root together, times their number
  double work = 4e6;            // products that the iterations may take
  double close_enough = 1e-7;   // m/s^2 or rad/s^2: what a further iteration changes
};

// The forces of all rows (Row::lambda), and what they make of the bodies (Body::push, turn). False if too many rows are left: nothing
// is changed then.
bool solve(std::vector<Row>& rows, std::vector<Body>& bodies, const std::vector<Branch>& joints, const Settings& settings);

}  // namespace ode_sim::trees
