// The ray is followed from cell to cell (Amanatides and Woo, A Fast Voxel Traversal Algorithm, 1987), in units of cells.
#include "height_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_sim {

namespace {
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kMargin = 1e-6;  // m beyond all heights: what is met lies between two places of the ray
constexpr double kBorder = 1e-9;  // cells beyond the border, for a ray along it

// One coordinate of the ray: at + by * t.
struct Line {
  double at, by;
  double operator()(double t) const { return at + by * t; }
  // Leaves of [from, to] what lies between `low` and `high`.
  void cut(double low, double high, double& from, double& to) const {
    if (by == 0) {
      if (at < low || at > high) to = -kNever;
      return;
    }
    const double a = (low - at) / by, b = (high - at) / by;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
};

// How far the ray stands above the surface, from piece to piece along it; where that changes its sign they meet.
struct Above {
  bool known = false;
  double last = 0;

  // Between t0 and t1 it goes from h0 to h1. Where the ray meets the surface, or infinity.
  double meets(double t0, double h0, double t1, double h1) {
    const bool before = known && std::signbit(last) != std::signbit(h0);  // between two pieces, by rounding
    known = true;
    last = h1;
    if (before || h0 == 0) return t0;
    if (h1 == 0) return t1;
    return std::signbit(h0) != std::signbit(h1) ? t0 + (t1 - t0) * h0 / (h0 - h1) : kNever;
  }
};

struct Ray {
  Line x, y, z;  // x and z in cells from the first height

  // The part [from, to] of it over the cell in column i and row j.
  double meets(const HeightGrid& grid, int i, int j, double from, double to, Above& above) const {
    const double* row = &grid.heights[static_cast<size_t>(j) * grid.columns + i];
    const double a = row[0], b = row[1], c = row[grid.columns], d = row[grid.columns + 1];
    const auto height = [&](double t) {
      const double u = x(t) - i, v = z(t) - j;
      return y(t) - (u + v <= 1 ? a + u * (b - a) + v * (c - a) : d + (1 - u) * (c - d) + (1 - v) * (b - d));
    };
    const double across = x.by + z.by;
    const double diagonal = across != 0 ? (i + j + 1 - x.at - z.at) / across : kNever;
    if (!(diagonal > from && diagonal < to)) return above.meets(from, height(from), to, height(to));
    const double middle = height(diagonal), first = above.meets(from, height(from), diagonal, middle);
    return first < kNever ? first : above.meets(diagonal, middle, to, height(to));
  }
};

// Where the ray crosses into the next cell along one coordinate.
struct Walk {
  int cell, step;
  double next, every;

  Walk(const Line& line, double from, int cells) {
    cell = std::clamp(static_cast<int>(std::floor(line(from))), 0, cells - 1);
    step = line.by > 0 ? 1 : -1;
    next = line.by == 0 ? kNever : (cell + (step > 0) - line.at) / line.by;
    every = line.by == 0 ? kNever : std::abs(1 / line.by);
    if (next <= from) go();  // it starts on the border
  }
  void go() {
    cell += step;
    next += every;
  }
};
}  // namespace

double HeightGrid::distance(const Vec3& origin, const Vec3& direction, double most) const {
  const double cell_x = size_x / (columns - 1), cell_z = size_z / (rows - 1);
  const Ray ray{{(origin.x + 0.5 * size_x) / cell_x, direction.x / cell_x},
                {origin.y, direction.y},
                {(origin.z + 0.5 * size_z) / cell_z, direction.z / cell_z}};
  double from = 0, to = most;
  ray.x.cut(-kBorder, columns - 1 + kBorder, from, to);
  ray.z.cut(-kBorder, rows - 1 + kBorder, from, to);
  ray.y.cut(low - kMargin * (1 + std::abs(low)), high + kMargin * (1 + std::abs(high)), from, to);
  if (!(from <= to)) return kNever;
  Walk x(ray.x, from, columns - 1), z(ray.z, from, rows - 1);
  Above above;
  while (x.cell >= 0 && x.cell < columns - 1 && z.cell >= 0 && z.cell < rows - 1) {
    const double end = std::min({x.next, z.next, to});
    const double hit = ray.meets(*this, x.cell, z.cell, from, end, above);
    if (hit < kNever) return std::min(hit, most);
    if (end >= to) break;
    from = end;
    (x.next <= z.next ? x : z).go();
  }
  return kNever;
}

}  // namespace ode_sim
