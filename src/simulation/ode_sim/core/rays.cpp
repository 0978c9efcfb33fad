// Batched ray casts: a slab test against the bounding boxes of all shapes, then ODE's exact test, nearest box first.
#include <algorithm>
#include <cmath>

#include "ode_access.hpp"

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
// One ray of ODE's, for as long as it lives.
struct Ray {
  explicit Ray(double length) : geom(dCreateRay(nullptr, length)) {
    dGeomRaySetFirstContact(geom, 0);
    dGeomRaySetClosestHit(geom, 1);
  }
  ~Ray() { dGeomDestroy(geom); }
  Ray(const Ray&) = delete;
  Ray& operator=(const Ray&) = delete;
  const dGeomID geom;
};
}  // namespace

// `origins`, `directions`: n x 3, world frame; directions are normalised here. `ranges`: metres, infinity = no hit within
// `max_range`; `hits`: shape ids, -1 = none. Returns how many rays hit.
int World::cast_rays(const double* origins, const double* directions, int n, double max_range,
                     const std::vector<int>& ignore, double* ranges, int32_t* hits) {
  initialise_ode();
  std::vector<Candidate> all;
  all.reserve(shapes_.size());
  for (auto& [id, shape] : shapes_) {
    if (shape->out_of_reach || std::find(ignore.begin(), ignore.end(), id) != ignore.end()) continue;
    Candidate c{shape, {-kInf, kInf, -kInf, kInf, -kInf, kInf}};
    if (!shape->infinite) dGeomGetAABB(shape->geom, c.box);
    all.push_back(c);
  }
  if (!std::isfinite(max_range)) max_range = 1e6;
  max_range = std::min(std::max(max_range, 0.0), kOutOfReach);
  const Ray ray(max_range);
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
    dGeomRaySetLength(ray.geom, max_range);
    dGeomRaySet(ray.geom, o[0], o[1], o[2], d.x, d.y, d.z);
    for (auto& [at, shape] : near) {
      if (at >= ranges[i]) break;
      dContactGeom g[8];
      int k = 0;
      try {
        k = dCollide(ray.geom, shape->geom, 8, g, sizeof g[0]);
      } catch (const OdeFailure&) {
        continue;  // nothing is hit
      }
      for (int m = 0; m < k; ++m)
        if (g[m].depth < ranges[i]) {
          ranges[i] = g[m].depth;
          hits[i] = shape->id;
        }
    }
    count += hits[i] >= 0;
  }
  return count;
}

}  // namespace ode_sim
