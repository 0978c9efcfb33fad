#include "geometry.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ode_sim {

namespace {

// The middle of the box round all corners, and how far the furthest is from it.
void find_sphere(MeshData& mesh) {
  const std::vector<double>& v = mesh.vertices;
  Vec3 low{v[0], v[1], v[2]}, high = low;
  for (size_t i = 3; i < v.size(); i += 3) {
    low = {std::min(low.x, v[i]), std::min(low.y, v[i + 1]), std::min(low.z, v[i + 2])};
    high = {std::max(high.x, v[i]), std::max(high.y, v[i + 1]), std::max(high.z, v[i + 2])};
  }
  mesh.middle = (low + high) * 0.5;
  for (size_t i = 0; i < v.size(); i += 3)
    mesh.reach = std::max(mesh.reach, norm(Vec3{v[i], v[i + 1], v[i + 2]} - mesh.middle));
}

}  // namespace

MeshData::MeshData(std::vector<double> v, std::vector<dTriIndex> i) : vertices(std::move(v)), indices(std::move(i)) {
  const OdeScope scope;
  if (vertices.empty() || indices.empty() || vertices.size() % 3 || indices.size() % 3)
    throw std::invalid_argument("a mesh takes vertices and triangles of three numbers each, and at least one");
  if (std::max(vertices.size(), indices.size()) > std::numeric_limits<int>::max())
    throw std::invalid_argument("the mesh is too large");
  for (double v : vertices)
    if (!(std::abs(v) <= kFarthest)) throw std::invalid_argument("a corner of the mesh lies beyond " + shown(kFarthest) + " m");
  for (dTriIndex i : indices)
    if (i >= vertices.size() / 3) throw std::invalid_argument("a triangle of the mesh names a corner that there is not");
  find_sphere(*this);
  data.reset(dGeomTriMeshDataCreate());
  dGeomTriMeshDataBuildDouble(data, vertices.data(), 3 * sizeof(double), static_cast<int>(vertices.size() / 3), indices.data(),
                              static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
}

// A mesh is a wheel if what is furthest from its axis stands all round it, and is no wider than it is high.
void Shape::look_for_tread(const Vec3& axis_L, const Vec3& on_axis) {
  if (dGeomGetClass(geom) == dCylinderClass)
    wheel = std::abs(dot(axis_L, rotate(X_LC.q, Vec3{0, 0, 1}))) > 0.9999 && norm(cross(X_LC.p - on_axis, axis_L)) < 1e-4;
  if (dGeomGetClass(geom) != dTriMeshClass || !mesh) return;
  const Vec3 axis = rotate(conjugate(X_LC.q), axis_L), at = inverse(X_LC) * on_axis;
  const Vec3 x = cross(axis, std::abs(axis.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}), y = cross(axis, x);
  constexpr int kSectors = 12;
  double radius = 0, low = kInf, high = -kInf;
  bool seen[kSectors] = {};
  const auto corner = [&](size_t i) { return Vec3{mesh->vertices[i], mesh->vertices[i + 1], mesh->vertices[i + 2]} - at; };
  const auto from_axis = [&](const Vec3& d) { return norm(cross(d, axis)); };
  for (size_t i = 0; i < mesh->vertices.size(); i += 3) radius = std::max(radius, from_axis(corner(i)));
  for (size_t i = 0; i < mesh->vertices.size(); i += 3) {
    const Vec3 d = corner(i);
    if (from_axis(d) < 0.98 * radius) continue;
    const double turn = std::atan2(dot(d, y), dot(d, x)) / (2 * kPi) + 0.5;
    seen[std::min(static_cast<int>(turn * kSectors), kSectors - 1)] = true;
    low = std::min(low, dot(d, axis)), high = std::max(high, dot(d, axis));
  }
  wheel = std::all_of(std::begin(seen), std::end(seen), [](bool s) { return s; }) && high - low < 2 * radius;
  axle = axis, tread = at + axis * ((low + high) / 2);
}

void Shape::release() {
  geom.reset();
  faceted.reset();
  field.reset();
  mesh = faceted_mesh = nullptr;
}

OwnedGeom make_mesh(Shape& shape, std::shared_ptr<MeshData> data) {
  shape.mesh = std::move(data);
  return OwnedGeom(dCreateTriMesh(nullptr, shape.mesh->data, nullptr, nullptr, nullptr));
}

OwnedGeom make_cylinder(Shape& shape, double radius, double length) {
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
    const dTriIndex bottom = 2 * sides, top = bottom + 1;
    t.insert(t.end(), {i, j, sides + j, i, sides + j, sides + i, j, i, bottom, sides + i, sides + j, top});
  }
  shape.faceted_mesh = std::make_shared<MeshData>(std::move(v), std::move(t));
  shape.faceted.reset(dCreateTriMesh(nullptr, shape.faceted_mesh->data, nullptr, nullptr, nullptr));
  return OwnedGeom(dCreateCylinder(nullptr, radius, length));
}

constexpr double kGround = 1;  // m below the lowest height that is solid as well

OwnedGeom make_heightmap(Shape& shape, std::vector<double> heights, int columns, int rows, double size_x, double size_y) {
  if (columns < 2 || rows < 2) throw std::invalid_argument("a height map needs at least two rows and two columns");
  checked_size(size_x, "the width of a height map");
  checked_size(size_y, "the depth of a height map");
  for (double h : heights)
    if (!(std::abs(h) <= kFarthest))
      throw std::invalid_argument("a height of the map is not a number within " + shown(kFarthest) + " m");
  // `heights`: row-major, first row at +y. ODE wants depth samples along its z, which the y-up turn makes our -y.
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const double lowest = *low, highest = *high;
  shape.grid = {std::move(heights), columns, rows, size_x, size_y, lowest, highest};
  shape.field.reset(dGeomHeightfieldDataCreate());
  dGeomHeightfieldDataBuildDouble(shape.field, shape.grid.heights.data(), 1, size_x, size_y, columns, rows, 1, 0, kGround, 0);
  dGeomHeightfieldDataSetBounds(shape.field, lowest, highest);
  return OwnedGeom(dCreateHeightfield(nullptr, shape.field, 1));
}

void bounds(const Shape& shape, double* box) {
  if (!shape.field) {
    dGeomGetAABB(shape.geom, box);
    return;
  }
  const HeightGrid& grid = shape.grid;
  const double low[3] = {-0.5 * grid.size_x, grid.low - kGround, -0.5 * grid.size_z};
  const double high[3] = {0.5 * grid.size_x, grid.high, 0.5 * grid.size_z};
  const dReal *p = dGeomGetPosition(shape.geom), *R = dGeomGetRotation(shape.geom);
  for (int i = 0; i < 3; ++i) {
    box[2 * i] = box[2 * i + 1] = p[i];
    for (int k = 0; k < 3; ++k) {
      const double a = R[4 * i + k] * low[k], b = R[4 * i + k] * high[k];
      box[2 * i] += std::min(a, b), box[2 * i + 1] += std::max(a, b);
    }
  }
}

}  // namespace ode_sim
