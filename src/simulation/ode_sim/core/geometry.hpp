// ODE geoms of the shapes that need more than one ODE call. The shape keeps the data that the geom points into.
#pragma once
#include "model.hpp"

namespace ode_sim {

OwnedGeom make_mesh(Shape& shape, std::shared_ptr<MeshData> data);
OwnedGeom make_cylinder(Shape& shape, double radius, double length);
// `heights` (m): rows x columns, first row at +y; `size_x`, `size_y` in metres, centred on the origin.
OwnedGeom make_heightmap(Shape& shape, std::vector<double> heights, int columns, int rows, double size_x, double size_y);

// Box around the shape in world axes: lowest and highest x, y, z, m. It is ODE's, except for a height map that is turned, of which ODE
// leaves out the corners.
void bounds(const Shape& shape, double* box);

}  // namespace ode_sim
