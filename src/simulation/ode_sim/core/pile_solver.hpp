// Islands of contacts alone: what lies and leans on each other.
//
// Projected Gauss-Seidel in the manner of ODE's quickStep (over-relaxed, rows in an order that is shuffled every eight rounds, friction
// bounded by the normal force of the moment), with each row packed for the processor's vectors. The same bits on every x86-64 machine:
// sums are grouped alike whatever vectors there are, and no product is fused with a sum.
#pragma once
#include <cstdint>
#include <vector>

#include "gazebo_solver.hpp"

namespace ode_sim::piles {

using gazebo_like::Body;
using gazebo_like::Row;

struct Settings {
  double dt = 0.001, sor = 1.3;
  int iterations = 50;
  uint64_t seed = 0;  // of the order
};

// The forces of all rows (Row::lambda, N or N m), and what they make of the bodies (Body::push, m/s^2; turn, rad/s^2).
void solve(std::vector<Row>& rows, std::vector<Body>& bodies, const Settings& settings);

}  // namespace ode_sim::piles
