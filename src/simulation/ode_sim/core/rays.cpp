// Batched ray casts: a slab test against the bounding boxes of all shapes, then the exact test, nearest box first: ODE's, but for height
// maps, of which ODE looks at every cell below the ray, and takes a ray that is below all of them for one that meets them.
#include <algorithm>
#include <cmath>

#include "geometry.hpp"
#include "ode.hpp"
#include "world.hpp"

namespace ode_sim {

namespace {
struct Candidate {
  Shape* shape;
  double box[6];
};
// Distance at which the ray enters the box, infinity if it misses it.
double entry(const double* box, const double* origin, const double* inverse, double most) {
  double from = 0, to = most;
  for (int i = 0; i < 3; ++i) {
    double t0 = (box[2 * i] - origin[i]) * inverse[i], t1 = (box[2 * i + 1] - origin[i]) * inverse[i];
    if (t0 > t1) std::swap(t0, t1);
    if (std::isnan(t0) || std::isnan(t1)) continue;  // parallel to the face and on it
    from = std::max(from, t0);
    to = std::min(to, t1);
  }
  return from <= to ? from : kInf;
}

std::vector<Candidate> candidates(const Scene& scene, const std::vector<int>& ignore) {
  std::vector<Candidate> all;
  all.reserve(scene.shapes.size());
  for (auto& [id, shape] : scene.shapes) {
    if (shape->out_of_reach || std::find(ignore.begin(), ignore.end(), id) != ignore.end()) continue;
    Candidate c{shape, {-kInf, kInf, -kInf, kInf, -kInf, kInf}};
    if (!shape->infinite) bounds(*shape, c.box);
    all.push_back(c);
  }
  return all;
}

OwnedGeom make_ray(double length) {
  OwnedGeom ray(dCreateRay(nullptr, length));
  dGeomRaySetFirstContact(ray, 0);
  dGeomRaySetClosestHit(ray, 1);
  return ray;
}

struct Hit {
  double range = kInf;
  int shape = -1;
};

double distance_to_ground(dGeomID geom, const HeightGrid& grid, const Vec3& origin, const Vec3& direction, double most) {
  const dReal *p = dGeomGetPosition(geom), *R = dGeomGetRotation(geom);
  const auto in_grid = [R](const Vec3& v) {
    return Vec3{R[0] * v.x + R[4] * v.y + R[8] * v.z, R[1] * v.x + R[5] * v.y + R[9] * v.z,
                R[2] * v.x + R[6] * v.y + R[10] * v.z};
  };
  return grid.distance(in_grid(origin - Vec3{p[0], p[1], p[2]}), in_grid(direction), most);
}

// Takes the hit on the shape if it is nearer.
void look_at(dGeomID ray, const Shape& shape, Hit& hit) {
  dContactGeom g[8];
  int k = 0;
  try {
    k = dCollide(ray, shape.geom, 8, g, sizeof g[0]);
  } catch (const OdeFailure&) {
    return;  // nothing is hit
  }
  for (int m = 0; m < k; ++m)
    if (g[m].depth < hit.range) hit = {g[m].depth, shape.id};
}

}  // namespace

int cast_rays(const Scene& scene, const double* origins, const double* directions, int n, double max_range,
              const std::vector<int>& ignore, double* ranges, int32_t* hits) {
  const OdeScope scope;
  const auto all = candidates(scene, ignore);
  if (!std::isfinite(max_range)) max_range = 1e6;
  max_range = std::min(std::max(max_range, 0.0), kOutOfReach);
  const OwnedGeom ray = make_ray(max_range);
  std::vector<std::pair<double, Shape*>> near;
  int count = 0;
  for (int i = 0; i < n; ++i) {
    const double* o = origins + 3 * i;
    Vec3 d{directions[3 * i], directions[3 * i + 1], directions[3 * i + 2]};
    ranges[i] = kInf;
    hits[i] = -1;
    const double length = norm(d);
    if (!(length > 0) || !std::isfinite(length) || !within(Vec3{o[0], o[1], o[2]}, kOutOfReach)) continue;
    d = d * (1 / length);
    const double inverse[3] = {1 / d.x, 1 / d.y, 1 / d.z};
    near.clear();
    for (auto& c : all) {
      const double at = entry(c.box, o, inverse, max_range);
      if (at < kInf) near.push_back({at, c.shape});
    }
    std::sort(near.begin(), near.end(),
              [](auto& a, auto& b) { return a.first != b.first ? a.first < b.first : a.second->id < b.second->id; });
    dGeomRaySetLength(ray, max_range);
    dGeomRaySet(ray, o[0], o[1], o[2], d.x, d.y, d.z);
    Hit hit;
    for (auto& [at, shape] : near) {
      if (at >= hit.range) break;
      if (!shape->field) {
        look_at(ray, *shape, hit);
        continue;
      }
      const double range = distance_to_ground(shape->geom, shape->grid, {o[0], o[1], o[2]}, d, max_range);
      if (range < hit.range) hit = {range, shape->id};
    }
    ranges[i] = hit.range;
    hits[i] = hit.shape;
    count += hit.shape >= 0;
  }
  return count;
}

}  // namespace ode_sim
