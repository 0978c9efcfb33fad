// Heights on a rectangular grid, and where a ray meets the surface over it.
#pragma once
#include <vector>

#include "math.hpp"

namespace ode_sim {

// In ODE's frame of a height field: x along a row, y up, z from row to row; centred on the origin. Each cell is two triangles
// on either side of the diagonal from (x + 1, z) to (x, z + 1), as ODE's are.
struct HeightGrid {
  std::vector<double> heights;  // m, row by row
  int columns = 0, rows = 0;
  double size_x = 0, size_z = 0;  // m
  double low = 0, high = 0;       // m, of all heights

  // Distance from `origin` along the unit vector `direction` to the surface, seen from above or below; infinity if it is not met
  // within `most`. It costs a step for each cell below the ray.
  double distance(const Vec3& origin, const Vec3& direction, double most) const;
};

}  // namespace ode_sim
