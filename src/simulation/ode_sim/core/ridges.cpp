#include "ridges.hpp"

#include <algorithm>
#include <cmath>

#include "geometry.hpp"

namespace ode_sim {

namespace {

constexpr double kThin = 2e-5;      // m, the thickness of the blade that stands for an edge
constexpr double kDeep = 0.05;      // m, how far it goes down: what comes deeper within a step is lost
constexpr double kEven = 1e-6;      // of the sine of the angle between two triangles: they are one plane
constexpr double kShortest = 1e-9;  // m, of an edge
constexpr int kAtOnce = 8;          // contacts of a shape with one edge
constexpr size_t kMostAsked = 250;  // edges: of more, the highest

// The cells below the box around a shape, and its lowest point, in the map's frame.
struct Below {
  int i0, i1, j0, j1;  // columns and rows of heights, i1 and j1 included
  double low;
};

Below below(const Shape& map, const Shape& other) {
  dReal box[6];
  bounds(other, box);
  const dReal *p = dGeomGetPosition(map.geom), *R = dGeomGetRotation(map.geom);
  double low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    low[k] = high[k] = 0;
    for (int i = 0; i < 3; ++i) {
      const double a = R[4 * i + k] * (box[2 * i] - p[i]), b = R[4 * i + k] * (box[2 * i + 1] - p[i]);
      low[k] += std::min(a, b), high[k] += std::max(a, b);
    }
  }
  const HeightGrid& grid = map.grid;
  const auto cell = [](double at, double size, int count, double (*round)(double)) {
    const double place = round((at / size + 0.5) * (count - 1));
    return place > 0 ? static_cast<int>(std::min(place, count - 1.0)) : 0;
  };
  const auto down = [](double x) { return std::floor(x); };
  const auto up = [](double x) { return std::ceil(x); };
  return {cell(low[0], grid.size_x, grid.columns, down), cell(high[0], grid.size_x, grid.columns, up),
          cell(low[2], grid.size_z, grid.rows, down), cell(high[2], grid.size_z, grid.rows, up), low[1]};
}

Vec3 unit(const Vec3& v) {
  const double length = norm(v);
  return length > 0 ? v * (1 / length) : Vec3{};
}

// An edge from `p` to `q`, and how the triangles at either side of it go away from it, in the map's frame. At the border there is one, and no ridge.
struct Edge {
  Vec3 p, q, beside[2];
  int sides = 0;

  void add(const Vec3& corner) {
    const Vec3 along = unit(q - p), to = corner - p;
    beside[sides++] = unit(to - along * dot(along, to));
  }
  // They fall away on both sides: the sum of what goes away points down.
  bool ridge() const { return sides == 2 && (beside[0] + beside[1]).y < -kEven; }
  double top() const { return std::max(p.y, q.y); }
  Vec3 up() const { return unit(-(beside[0] + beside[1])); }
};

class Asking {
 public:
  Asking(const Shape& map, const Shape& other, dContactGeom* found, int most)
      : map_(map),
        geom_(other.geom),
        found_(found),
        most_(most),
        blade_(dCreateBox(nullptr, kThin, kDeep, 1)),
        below_(below(map, other)) {}

  int all() {
    for (int j = below_.j0; j <= below_.j1; ++j)
      for (int i = below_.i0; i <= below_.i1; ++i) {
        const bool right = i < below_.i1, down = j < below_.j1;
        if (right) look(i, j, i + 1, j, {{i, j + 1}, {i + 1, j - 1}});
        if (down) look(i, j, i, j + 1, {{i + 1, j}, {i - 1, j + 1}});
        if (right && down) look(i + 1, j, i, j + 1, {{i, j}, {i + 1, j + 1}});
      }
    if (ridges_.size() > kMostAsked) {  // a thing as large as the map
      std::stable_sort(ridges_.begin(), ridges_.end(), [](const Edge& a, const Edge& b) { return a.top() > b.top(); });
      ridges_.resize(kMostAsked);
    }
    for (const Edge& edge : ridges_)
      if (count_ < most_) touch(edge, norm(edge.q - edge.p));
    return count_;
  }

 private:
  struct At {
    int i, j;
  };

  bool in_map(const At& at) const { return at.i >= 0 && at.j >= 0 && at.i < map_.grid.columns && at.j < map_.grid.rows; }

  Vec3 point(int i, int j) const {
    const HeightGrid& grid = map_.grid;
    return {grid.size_x * (static_cast<double>(i) / (grid.columns - 1) - 0.5),
            grid.heights[static_cast<size_t>(j) * grid.columns + i],
            grid.size_z * (static_cast<double>(j) / (grid.rows - 1) - 0.5)};
  }

  Vec3 turned(const Vec3& v) const {
    const dReal* R = dGeomGetRotation(map_.geom);
    return {R[0] * v.x + R[1] * v.y + R[2] * v.z, R[4] * v.x + R[5] * v.y + R[6] * v.z, R[8] * v.x + R[9] * v.y + R[10] * v.z};
  }

  void look(int i, int j, int k, int l, const At (&corners)[2]) {
    Edge edge{point(i, j), point(k, l), {}};
    if (edge.top() < below_.low) return;
    for (const At& at : corners)
      if (in_map(at)) edge.add(point(at.i, at.j));
    if (edge.ridge() && norm(edge.q - edge.p) > kShortest) ridges_.push_back(edge);
  }

  void touch(const Edge& edge, double length) {
    const Vec3 along = (edge.q - edge.p) * (1 / length), up = edge.up(), across = turned(cross(up, along));
    const Vec3 axis = turned(along), upright = turned(up);
    const Vec3 middle = vec(dGeomGetPosition(map_.geom)) + turned((edge.p + edge.q) * 0.5 - up * (0.5 * kDeep));
    const dMatrix3 R = {across.x, upright.x, axis.x, 0, across.y, upright.y, axis.y, 0, across.z, upright.z, axis.z, 0};
    dGeomBoxSetLengths(blade_, kThin, kDeep, length);
    dGeomSetPosition(blade_, middle.x, middle.y, middle.z);
    dGeomSetRotation(blade_, R);
    dContactGeom here[kAtOnce];
    const int n = std::min(dCollide(geom_, blade_, kAtOnce, here, sizeof here[0]), kAtOnce);
    for (int k = 0; k < n && count_ < most_; ++k)
      if (belongs(edge, vec(here[k].normal)) && !known(here[k])) found_[count_++] = here[k];
  }

  // The nearest point is on the edge itself, not on one of its triangles, which ODE finds.
  bool belongs(const Edge& edge, const Vec3& normal) const {
    return dot(normal, turned(edge.beside[0])) <= kEven && dot(normal, turned(edge.beside[1])) <= kEven;
  }

  // At a corner several edges meet.
  bool known(const dContactGeom& c) const {
    return std::any_of(found_, found_ + count_, [&](const dContactGeom& other) {
      return norm(vec(other.pos) - vec(c.pos)) < 1e-4 && dot(vec(other.normal), vec(c.normal)) > 0.999;
    });
  }

  const Shape& map_;
  dGeomID geom_;
  dContactGeom* found_;
  int most_, count_ = 0;
  OwnedGeom blade_;
  std::vector<Edge> ridges_;
  Below below_;
};

}  // namespace

int ridge_contacts(const Shape& map, const Shape& other, dContactGeom* found, int most) {
  return Asking(map, other, found, most).all();
}

}  // namespace ode_sim
