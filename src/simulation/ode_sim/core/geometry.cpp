#include "geometry.hpp"

#include <cmath>

namespace ode_sim {

MeshData::MeshData(std::vector<double> v, std::vector<dTriIndex> i) : vertices(std::move(v)), indices(std::move(i)) {
  initialise_ode();
  if (vertices.empty() || indices.empty() || vertices.size() % 3 || indices.size() % 3)
    throw std::invalid_argument("a mesh takes vertices and triangles of three numbers each, and at least one");
  if (std::max(vertices.size(), indices.size()) > std::numeric_limits<int>::max())
    throw std::invalid_argument("the mesh is too large");
  for (double v : vertices)
    if (!(std::abs(v) <= kFarthest)) throw std::invalid_argument("a corner of the mesh lies beyond " + shown(kFarthest) + " m");
  for (dTriIndex i : indices)
    if (i >= vertices.size() / 3) throw std::invalid_argument("a triangle of the mesh names a corner that there is not");
  data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(data, vertices.data(), 3 * sizeof(double), static_cast<int>(vertices.size() / 3),
                              indices.data(), static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
}

MeshData::~MeshData() { dGeomTriMeshDataDestroy(data); }

dGeomID make_mesh(Shape& shape, std::shared_ptr<MeshData> data) {
  shape.mesh = std::move(data);
  return dCreateTriMesh(nullptr, shape.mesh->data, nullptr, nullptr, nullptr);
}

dGeomID make_cylinder(Shape& shape, double radius, double length) {
  constexpr int sides = 24;
  std::vector<double> v;
  std::vector<dTriIndex> t;
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
  shape.faceted_mesh = std::make_shared<MeshData>(std::move(v), std::move(t));
  shape.faceted = dCreateTriMesh(nullptr, shape.faceted_mesh->data, nullptr, nullptr, nullptr);
  return dCreateCylinder(nullptr, radius, length);
}

dGeomID make_heightmap(Shape& shape, std::vector<double> heights, int columns, int rows, double size_x, double size_y) {
  if (columns < 2 || rows < 2) throw std::invalid_argument("a height map needs at least two rows and two columns");
  checked_size(size_x, "the width of a height map");
  checked_size(size_y, "the depth of a height map");
  for (double h : heights)
    if (!(std::abs(h) <= kFarthest)) throw std::invalid_argument("a height of the map is not a number within " + shown(kFarthest) + " m");
  // `heights`: row-major, first row at +y. ODE wants depth samples along its z, which the y-up turn makes our -y.
  shape.heights = std::move(heights);
  shape.field = dGeomHeightfieldDataCreate();
  dGeomHeightfieldDataBuildDouble(shape.field, shape.heights.data(), 1, size_x, size_y, columns, rows, 1, 0, 1, 0);
  double low = shape.heights[0], high = low;
  for (double h : shape.heights) low = std::min(low, h), high = std::max(high, h);
  dGeomHeightfieldDataSetBounds(shape.field, low, high);
  return dCreateHeightfield(nullptr, shape.field, 1);
}

}  // namespace ode_sim
