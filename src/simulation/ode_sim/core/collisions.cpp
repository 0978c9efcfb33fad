// Who touches whom, and where.
#include <algorithm>
#include <cmath>

#include "geometry.hpp"
#include "phases.hpp"
#include "ridges.hpp"

namespace ode_sim {

namespace {

constexpr double kFlat = 0.005;    // rad: a wheel that is tilted by less stands on its whole tread
constexpr double kOneEdge = 1e-5;  // m along the axis, within which contacts are those of one edge
constexpr double kFacet =
    0.2;  // of the radius: half the side of a mesh with 16 corners, the coarsest that rolls as if it were round

// ODE loses a cylinder that has come deeper into a box than the box is thick, as what falls on a floor of a centimetre does within
// two steps. It is still on the side on which its middle is. Contacts of cylinder `g` and `box` through the box's thinnest side,
// normals towards the cylinder. :returns: how many, at most 8
int contacts_through(dGeomID g, dGeomID box, dContactGeom* found) {
  dVector3 sides;
  dGeomBoxGetLengths(box, sides);
  const int k = static_cast<int>(std::min_element(sides, sides + 3) - sides);
  dReal radius, length;
  dGeomCylinderGetParams(g, &radius, &length);
  const dReal *R = dGeomGetRotation(box), *Q = dGeomGetRotation(g);
  const Vec3 middle = vec(dGeomGetPosition(g)), to_middle = middle - vec(dGeomGetPosition(box));
  Vec3 n{R[k], R[4 + k], R[8 + k]};
  if (dot(n, to_middle) < 0) n = -n;
  if (dot(n, to_middle) < 0.5 * sides[k]) return 0;
  const Vec3 axis{Q[2], Q[6], Q[10]};
  const Vec3 down = axis * dot(n, axis) - n;
  dVector3 p, q;
  const dReal along[3] = {axis.x, axis.y, axis.z};
  dPlaneSpace(along, p, q);
  std::vector<Vec3> rim;
  if (norm(down) > 0.01) rim = {down * (1 / norm(down))};
  else rim = {vec(p), -vec(p), vec(q), -vec(q)};
  int count = 0;
  for (const Vec3& out : rim)
    for (double end : {-0.5, 0.5}) {
      const Vec3 at = middle + out * radius + axis * (end * length), off = at - vec(dGeomGetPosition(box));
      const double depth = 0.5 * sides[k] - dot(n, off);
      bool beside = depth <= 0;
      for (int i = 0; i < 3; ++i)
        if (i != k) beside = beside || std::abs(dot(off, Vec3{R[i], R[4 + i], R[8 + i]})) > 0.5 * sides[i];
      if (beside) continue;
      dContactGeom& c = found[count++];
      c.pos[0] = at.x, c.pos[1] = at.y, c.pos[2] = at.z;
      c.normal[0] = n.x, c.normal[1] = n.y, c.normal[2] = n.z;
      c.depth = depth;
    }
  return count;
}

// What ODE's collider misses.
int missed_contacts(dGeomID ga, dGeomID gb, dContactGeom* found) {
  if (dGeomGetClass(ga) == dCylinderClass && dGeomGetClass(gb) == dBoxClass) return contacts_through(ga, gb, found);
  if (dGeomGetClass(gb) != dCylinderClass || dGeomGetClass(ga) != dBoxClass) return 0;
  const int n = contacts_through(gb, ga, found);
  for (int i = 0; i < n; ++i)
    for (dReal& x : found[i].normal) x = -x;
  return n;
}

bool still(const Link& l) {
  const Cluster& c = cluster_of(l);
  return !c.root ? !l.moving && !l.led && l.belt.speed == 0 : c.asleep;
}

bool may_touch(const Scene& scene, const Shape& a, const Shape& b) {
  const Link &la = *a.link, &lb = *b.link;
  if (&la == &lb) return false;
  if (!(a.surface.collide_bitmask & b.surface.collide_bitmask)) return false;
  if (still(la) && still(lb)) return false;
  if (la.model == lb.model) {
    if (!la.self_collide && !lb.self_collide) return false;
    if (la.cluster == lb.cluster && !la.moving && !lb.moving) return false;
    if (la.model->jointed.count(std::minmax(la.id, lb.id))) return false;
  }
  if (scene.bonds && scene.bonds->jointed.count(std::minmax(la.id, lb.id))) return false;
  return !welded(scene, la, lb);
}

// In the order of their ids: the sweep tells pairs in an order that depends on its history.
void find_pairs(Scene& scene, StepState& state) {
  auto& pairs = state.pairs;
  scene.broad_phase.find(pairs);
  for (auto& [a, b] : pairs)
    if (a->id > b->id) std::swap(a, b);
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [&](const auto& p) { return !may_touch(scene, *p.first, *p.second); }),
              pairs.end());
  std::sort(pairs.begin(), pairs.end(), [](auto& p, auto& q) {
    return std::make_pair(p.first->id, p.second->id) < std::make_pair(q.first->id, q.second->id);
  });
}

// `instead`, put where the shape's geom is.
dGeomID placed(dGeomID instead, const Shape& shape) {
  const dReal* p = dGeomGetPosition(shape.geom);
  dGeomSetPosition(instead, p[0], p[1], p[2]);
  dGeomSetRotation(instead, dGeomGetRotation(shape.geom));
  return instead;
}

// ODE has no collider for two cylinders, or a cylinder and a capsule: one of them goes in as a faceted mesh. Of two meshes the larger
// goes in as the piece that the other comes near, if there is one.
std::pair<dGeomID, dGeomID> geoms_of(const Shape& a, const Shape& b, const MeshPiece* piece) {
  if (piece && piece_is_of_first(a, b)) return {placed(piece->geom, a), b.geom};
  if (piece) return {a.geom, placed(piece->geom, b)};
  const int ta = dGeomGetClass(a.geom), tb = dGeomGetClass(b.geom);
  const Shape* stand_in = nullptr;
  if (ta == dCylinderClass && (tb == dCylinderClass || tb == dCapsuleClass)) stand_in = &a;
  else if (tb == dCylinderClass && ta == dCapsuleClass) stand_in = &b;
  if (!stand_in || !stand_in->faceted) return {a.geom, b.geom};
  const dGeomID faceted = placed(stand_in->faceted, *stand_in);
  if (stand_in == &a) return {faceted, b.geom};
  return {a.geom, faceted};
}

constexpr int kMostFound = 250;

// What Gazebo's broad phase sorts a model by: the power of two above its largest extent, m; links that collide with their own model alone.
int size_class(const Link& link) {
  constexpr int kLeast = -2, kMost = 8;  // of the levels of its hash space
  double low[3] = {kInf, kInf, kInf}, high[3] = {-kInf, -kInf, -kInf};
  for (auto& l : link.model->links) {
    if (l->self_collide ? l.get() != &link : link.self_collide) continue;
    for (auto& s : l->shapes) {
      dReal box[6];
      bounds(*s, box);
      for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], box[2 * i]), high[i] = std::max(high[i], box[2 * i + 1]);
    }
  }
  const double side = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  if (!std::isfinite(side)) return kMost + 1;
  int exponent = 0;
  std::frexp(side, &exponent);
  return std::min(std::max(exponent, kLeast), kMost + 1);
}

// Of two shapes, that of the smaller model comes first in Gazebo, else what is static, else the newer one (the older one until something
// has moved): contacts come in another order then, and with them the rows of the solver.
bool second_is_first_in_gazebo(const Shape& a, const Shape& b, bool nothing_has_moved) {
  const int of_a = size_class(*a.link), of_b = size_class(*b.link);
  if (of_a != of_b) return of_b < of_a;
  if (a.link->model->is_static != b.link->model->is_static) return b.link->model->is_static;
  return nothing_has_moved ? b.id < a.id : b.id > a.id;
}

int collide_as_gazebo(const Scene& scene, const Shape& a, const Shape& b, dGeomID ga, dGeomID gb, dContactGeom* found) {
  if (!second_is_first_in_gazebo(a, b, scene.iterations == 0)) return dCollide(ga, gb, kMostFound, found, sizeof found[0]);
  const int n = std::min(dCollide(gb, ga, kMostFound, found, sizeof found[0]), kMostFound);
  for (int i = 0; i < n; ++i)
    for (dReal& x : found[i].normal) x = -x;
  return n;
}

// Of a height map and what stands on it, normals towards `a`. :returns: how many
int contacts_on_ridges(const Shape& a, const Shape& b, dContactGeom* found, int most) {
  const Shape &map = a.field ? a : b, &other = a.field ? b : a;
  if (!map.field || other.field || other.infinite) return 0;
  const int n = ridge_contacts(map, other, found, most);
  if (&map == &a)
    for (int i = 0; i < n; ++i)
      for (dReal& x : found[i].normal) x = -x;
  return n;
}

int find_contacts(Scene& scene, const Shape& a, const Shape& b, dContactGeom* found) {
  try {
    // The order of contacts is Gazebo's where the whole meshes are searched.
    const MeshPiece* piece = scene.settings.like_gazebo ? nullptr : scene.mesh_pieces.between(a, b);
    if (scene.separations.apart(a, b, piece)) return 0;
    const auto [ga, gb] = geoms_of(a, b, piece);
    if (scene.settings.like_gazebo) return std::min(collide_as_gazebo(scene, a, b, ga, gb, found), kMostFound);
    int n = std::min(dCollide(ga, gb, kMostFound, found, sizeof found[0]), kMostFound);
    if (n == 0) n = missed_contacts(ga, gb, found);
    return n + contacts_on_ridges(a, b, found + n, kMostFound - n);
  } catch (const OdeFailure& failure) {
    const Model &ma = *a.link->model, &mb = *b.link->model;
    scene.messages.report(std::string(failure.what()) + "; they do not touch in this step",
                          &ma == &mb ? ma.name : ma.name + " and " + mb.name);
    return 0;
  }
}

// How deep a point lies in a shape with flat sides, m; far outside of any other shape.
double depth_in(dGeomID g, const Vec3& p) {
  switch (dGeomGetClass(g)) {
    case dPlaneClass: return dGeomPlanePointDepth(g, p.x, p.y, p.z);
    case dBoxClass: return dGeomBoxPointDepth(g, p.x, p.y, p.z);
    default: return -kInf;
  }
}

// A description that says 3.14 or 1.57 tilts its wheels by a milliradian: no tyre stands on one edge for that. And which rings of a
// mesh touch depends on the corners that happen to be lowest: the round wheel that it stands for touches with its whole tread.
void lay_flat(const Shape& wheel, const Vec3& axis, bool on_one_edge, Contact& c) {
  const double off = dot(axis, wheel.link->X_WL * (wheel.X_LC * wheel.tread) - c.pos), tilt = std::abs(dot(axis, c.normal));
  const Shape& other = c.a == &wheel ? *c.b : *c.a;
  const Vec3 middle = c.pos + axis * off;
  if (tilt >= kFlat || depth_in(other.geom, middle) < -2 * tilt * std::abs(off) - kOneEdge) return;
  c.pos = middle;
  if (on_one_edge) c.depth = std::max(c.depth - tilt * std::abs(off), 0.0);
  c.merged = std::max(c.merged, 2);  // both edges
}

// A mesh has corners where the wheel that it stands for is round. On a corner before or behind the axle the load would turn the
// wheel to and fro, and two wheels on which a robot turns would drag each other sideways by as much as their corners differ.
void stand_below_axle(const Shape& wheel, const Vec3& axis, Contact& c) {
  const Vec3 to_axle = wheel.link->X_WL * (wheel.X_LC * wheel.tread) - c.pos, along = cross(axis, c.normal);
  const double off = dot(along, to_axle);
  const Shape& other = c.a == &wheel ? *c.b : *c.a;
  const Vec3 below = c.pos + along * off;
  if (std::abs(off) <= kFacet * std::abs(dot(c.normal, to_axle)) && depth_in(other.geom, below) > -kOneEdge) c.pos = below;
}

// A wheel touches with the middle of its tread. ODE gives a contact at either edge; a robot that turns would then pivot on
// one of them (two rings under dry friction leave it open on which), and its effective track be off by the tread's width.
// contacts: those from `first` on are the wheel's.
void merge_tread(const Shape& wheel, std::vector<Contact>& contacts, size_t first) {
  const Vec3 axis = rotate(wheel.link->X_WL.q * wheel.X_LC.q, wheel.axle);
  size_t kept = first;
  for (size_t i = first; i < contacts.size(); ++i) {
    Contact c = contacts[i];
    if (std::abs(dot(c.normal, axis)) < 0.1) {
      double low = dot(axis, c.pos), high = low;
      for (size_t k = contacts.size() - 1; k > i; --k) {
        const Contact& other = contacts[k];
        if (dot(other.normal, c.normal) < 0.999) continue;
        const double at = dot(axis, other.pos);
        low = std::min(low, at);
        high = std::max(high, at);
        if (other.depth > c.depth) c.depth = other.depth, c.pos = other.pos;
        c.merged += other.merged;
        contacts.erase(contacts.begin() + k);
      }
      c.pos += axis * ((low + high) / 2 - dot(axis, c.pos));
      if (wheel.mesh) c.merged = std::min(c.merged, 2);
      const bool on_one_edge = high - low < kOneEdge;
      if (on_one_edge || wheel.mesh) lay_flat(wheel, axis, on_one_edge, c);
      if (wheel.mesh) stand_below_axle(wheel, axis, c);
    }
    contacts[kept++] = c;
  }
  contacts.resize(kept);
}

// The deepest of what was found, as contacts of the two.
void add_contacts(const Settings& set, Shape& a, Shape& b, dContactGeom* found, int n, std::vector<Contact>& contacts) {
  const int most = std::min({set.max_contacts, a.max_contacts, b.max_contacts});
  if (n > most) {
    std::stable_sort(found, found + n, [](auto& p, auto& q) { return p.depth > q.depth; });
    n = std::max(most, 0);
  }
  const size_t first = contacts.size();
  for (int i = 0; i < n; ++i) {
    Contact c;
    c.a = &a;
    c.b = &b;
    c.pos = vec(found[i].pos);
    c.normal = vec(found[i].normal);
    c.depth = found[i].depth;
    const double length = norm(c.normal);
    if (!finite(c.pos) || !std::isfinite(c.depth) || !(length > 0.5)) continue;
    c.normal = c.normal * (1 / length);
    contacts.push_back(c);
  }
  for (const Shape* wheel : {&a, &b})
    if (wheel->wheel && !set.like_gazebo) merge_tread(*wheel, contacts, first);
  const int kept = static_cast<int>(contacts.size() - first);
  for (size_t i = first; i < contacts.size(); ++i) contacts[i].count = kept;
}

}  // namespace

bool touching(Scene& scene, const Shape& a, const Shape& b) {
  if (a.out_of_reach || b.out_of_reach) return false;
  dReal p[6], q[6];
  bounds(a, p), bounds(b, q);
  for (int i = 0; i < 6; i += 2)
    if (p[i] > q[i + 1] || p[i + 1] < q[i]) return false;
  dContactGeom found[kMostFound];
  return a.id < b.id ? find_contacts(scene, a, b, found) > 0 : find_contacts(scene, b, a, found) > 0;
}

void collide(Scene& scene, StepState& state) {
  find_pairs(scene, state);
  dContactGeom found[kMostFound];
  for (auto& [a, b] : state.pairs) {
    const int n = find_contacts(scene, *a, *b, found);
    add_contacts(scene.settings, *a, *b, found, n, state.contacts);
  }
  scene.counters.contacts = state.contacts.size();
}

}  // namespace ode_sim
