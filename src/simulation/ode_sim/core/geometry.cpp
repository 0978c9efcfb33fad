#include "geometry.hpp"

#include <cmath>

namespace ode_sim {

namespace {
dGeomID trimesh(std::vector<double>& vertices, std::vector<dTriIndex>& indices, dTriMeshDataID* data) {
  *data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(*data, vertices.data(), 3 * sizeof(double), static_cast<int>(vertices.size() / 3),
                              indices.data(), static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
  return dCreateTriMesh(nullptr, *data, nullptr, nullptr, nullptr);
}
}  // namespace

dGeomID make_mesh(Shape& shape, std::vector<double> vertices, std::vector<dTriIndex> indices) {
  shape.vertices = std::move(vertices);
  shape.indices = std::move(indices);
  return trimesh(shape.vertices, shape.indices, &shape.mesh);
}

dGeomID make_cylinder(Shape& shape, double radius, double length) {
  constexpr int sides = 24;
  auto& v = shape.faceted_vertices;
  auto& t = shape.faceted_indices;
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < sides; ++i) {
      const double a = 2 * M_PI * i / sides;
      v.insert(v.end(), {radius * std::cos(a), radius * std::sin(a), (end ? 0.5 : -0.5) * length});
    }
  v.insert(v.end(), {0, 0, -0.5 * length, 0, 0, 0.5 * length});
  for (dTriIndex i = 0; i < sides; ++i) {
    const dTriIndex j = (i + 1) % sides;
    for (dTriIndex k : {i, j, sides + j, i, sides + j, sides + i, j, i, dTriIndex(2 * sides), sides + i, sides + j, dTriIndex(2 * sides + 1)})
      t.push_back(k);
  }
  shape.faceted = trimesh(v, t, &shape.faceted_mesh);
  return dCreateCylinder(nullptr, radius, length);
}

dGeomID make_heightmap(Shape& shape, std::vector<double> heights, int columns, int rows, double size_x, double size_y) {
  // `heights`: row-major, first row at +y. ODE wants depth samples along its z, which the y-up turn makes our -y.
  shape.vertices = std::move(heights);
  shape.field = dGeomHeightfieldDataCreate();
  dGeomHeightfieldDataBuildDouble(shape.field, shape.vertices.data(), 1, size_x, size_y, columns, rows, 1, 0, 1, 0);
  double low = shape.vertices[0], high = low;
  for (double h : shape.vertices) low = std::min(low, h), high = std::max(high, h);
  dGeomHeightfieldDataSetBounds(shape.field, low, high);
  return dCreateHeightfield(nullptr, shape.field, 1);
}

}  // namespace ode_sim
