// The ridges of a height map, at which ODE's collider finds nothing.
#pragma once
#include "model.hpp"

namespace ode_sim {

// ODE asks each triangle of a height map for the deepest point of the other shape below the triangle's plane, and drops what is beside
// the triangle. Over a ridge that point is beside both triangles: a ball falls through the ground. Here the edges between triangles that
// rise above both are asked, as thin blades that stand in the ground.
// Contacts of `other` with such edges of `map`, normals towards `other`.
// :returns: how many, at most `most`.
int ridge_contacts(const Shape& map, const Shape& other, dContactGeom* found, int most);

}  // namespace ode_sim
