#include "gazebo_solver.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim::gazebo_like {

namespace {

struct Work {               // of a row
  Vec3 l1, a1, l2, a2;      // scaled by the relaxation
  Vec3 pl1, pa1, pl2, pa2;  // acceleration for one unit of force
  double rhs, rhs_fully, cfm;
};

double at(const Row& r, const Vec3& v1, const Vec3& w1, const Vec3& v2, const Vec3& w2) {
  return dot(r.l1, v1) + dot(r.a1, w1) + (r.second >= 0 ? dot(r.l2, v2) + dot(r.a2, w2) : 0.0);
}

// The relaxed row, and its right side: what is wanted less what would come by itself.
Work prepare(const Row& r, const std::vector<Body>& bodies, const Settings& s) {
  static const Body world;
  const Body &b1 = bodies[r.first], &b2 = r.second >= 0 ? bodies[r.second] : world;
  const double rate = 1 / s.dt, cfm = r.cfm * rate;
  Work k;
  k.pl1 = r.l1 * b1.inverse_mass, k.pa1 = b1.inverse_inertia * r.a1;
  k.pl2 = r.l2 * b2.inverse_mass, k.pa2 = b2.inverse_inertia * r.a2;
  const double own = dot(r.l1, k.pl1) + dot(r.a1, k.pa1) + dot(r.l2, k.pl2) + dot(r.a2, k.pa2) + cfm;
  const double scale = own > 0 ? (r.kind >= 0 ? s.friction_scale : 1.0) * s.sor / own : 0;
  auto free = [&](const Body& b, bool turn) {
    return turn ? b.w * rate + b.inverse_inertia * b.torque : b.v * rate + b.force * b.inverse_mass;
  };
  const double comes = at(r, free(b1, false), free(b1, true), free(b2, false), free(b2, true));
  // Upstream's cap is positive whatever the sign of what it cuts.
  k.rhs = ((std::abs(r.c) > r.fastest ? r.fastest : r.c) * rate - comes) * scale;
  k.rhs_fully = (r.c * rate - comes) * scale;
  k.l1 = r.l1 * scale, k.a1 = r.a1 * scale, k.l2 = r.l2 * scale, k.a2 = r.a2 * scale;
  k.cfm = cfm * scale;
  return k;
}

void push(std::vector<Body>& bodies, const Row& r, const Work& k, double by, double by_fully) {
  Body& b1 = bodies[r.first];
  b1.push += k.pl1 * by, b1.turn += k.pa1 * by;
  b1.push_fully += k.pl1 * by_fully, b1.turn_fully += k.pa1 * by_fully;
  if (r.second < 0) return;
  Body& b2 = bodies[r.second];
  b2.push += k.pl2 * by, b2.turn += k.pa2 * by;
  b2.push_fully += k.pl2 * by_fully, b2.turn_fully += k.pa2 * by_fully;
}

double clamp(double v, double lo, double hi) { return v < lo ? lo : v > hi ? hi : v; }

void sweep(Row& r, const Work& k, std::vector<Row>& rows, std::vector<Body>& bodies, const Settings& s) {
  static const Body world;
  const Body &b1 = bodies[r.first], &b2 = r.second >= 0 ? bodies[r.second] : world;
  auto wanting = [&](double rhs, double old, const Vec3& p1, const Vec3& t1, const Vec3& p2, const Vec3& t2) {
    double left = rhs - old * k.cfm - dot(k.l1, p1) - dot(k.a1, t1);
    if (r.second >= 0) left -= dot(k.l2, p2) + dot(k.a2, t2);
    return old + left;
  };
  const double old = r.lambda, old_fully = r.lambda_fully;
  double lo = r.lo, hi = r.hi, lo_fully = r.lo, hi_fully = r.hi;
  if (r.kind >= 0) {
    hi = std::abs(r.hi * rows[r.kind].lambda), lo = -hi;
    hi_fully = std::abs(r.hi * rows[r.kind].lambda_fully), lo_fully = -hi_fully;
  }
  r.lambda = clamp(wanting(k.rhs, old, b1.push, b1.turn, b2.push, b2.turn), lo, hi);
  r.lambda_fully =
      clamp(wanting(k.rhs_fully, old_fully, b1.push_fully, b1.turn_fully, b2.push_fully, b2.turn_fully), lo_fully, hi_fully);
  push(bodies, r, k, r.lambda - old, r.lambda_fully - old_fully);
  // Upstream smooths the force of contacts, which bounds friction, and not what it does to the bodies.
  if (r.kind != kBilateral) r.lambda = (1 - s.smoothing) * r.lambda + s.smoothing * old;
}

}  // namespace

void solve(std::vector<Row>& rows, std::vector<Body>& bodies, const Settings& settings) {
  std::vector<Work> work;
  work.reserve(rows.size());
  for (const Row& r : rows) work.push_back(prepare(r, bodies, settings));
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].lambda *= settings.warm_start, rows[i].lambda_fully *= settings.warm_start;
    push(bodies, rows[i], work[i], rows[i].lambda, rows[i].lambda_fully);
  }
  std::vector<int> first, friction;  // joints forwards, then normals backwards; friction forwards
  for (size_t i = 0; i < rows.size(); ++i)
    if (rows[i].kind == kBilateral) first.push_back(static_cast<int>(i));
    else if (rows[i].kind >= 0) friction.push_back(static_cast<int>(i));
  for (size_t i = rows.size(); i-- > 0;)
    if (rows[i].kind == kNormal) first.push_back(static_cast<int>(i));
  for (int n = 0; n < settings.iterations; ++n) {
    for (int i : first) sweep(rows[i], work[i], rows, bodies, settings);
    for (int i : friction) sweep(rows[i], work[i], rows, bodies, settings);
  }
  for (int n = 0; n < settings.friction_iterations; ++n)
    for (int i : friction) sweep(rows[i], work[i], rows, bodies, settings);
}

Sym3 inverse(const Sym3& m) {
  const double a = m.yy * m.zz - m.yz * m.yz, b = m.xz * m.yz - m.xy * m.zz, c = m.xy * m.yz - m.xz * m.yy;
  const double s = 1 / (m.xx * a + m.xy * b + m.xz * c);
  return {a * s, (m.xx * m.zz - m.xz * m.xz) * s, (m.xx * m.yy - m.xy * m.xy) * s, b * s,
          c * s, (m.xy * m.xz - m.xx * m.yz) * s};
}

// ------------------------------------------------------------------------------------------------ rows

Row point_row(const Pair& pair, const Vec3& at, const Vec3& direction) {
  Row r;
  r.first = pair.first, r.second = pair.second;
  r.l1 = direction, r.a1 = cross(at - pair.p1, direction);
  if (r.second >= 0) r.l2 = -direction, r.a2 = -cross(at - pair.p2, direction);
  r.cfm = pair.cfm, r.fastest = pair.fastest;
  return r;
}

void add_point(std::vector<Row>& rows, const Pair& pair) {
  const Vec3 apart = pair.X_W2.p - pair.X_W1.p;
  for (const Vec3& e : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    Row r = point_row(pair, pair.X_W1.p, e);
    if (r.second >= 0) r.a2 = -cross(pair.X_W2.p - pair.p2, e);
    r.c = pair.erp_rate * dot(apart, e);
    rows.push_back(r);
  }
}

void add_turn(std::vector<Row>& rows, const Pair& pair, const Vec3& axis_W, double speed) {
  Row r = along(pair, axis_W, false);
  r.c = speed;
  rows.push_back(r);
}

void add_alignment(std::vector<Row>& rows, const Pair& pair) {
  const Quat q = pair.X_W2.q * conjugate(pair.X_W1.q);
  const Vec3 off = Vec3{q.x, q.y, q.z} * (q.w < 0 ? -2.0 : 2.0);
  for (const Vec3& e : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) add_turn(rows, pair, e, pair.erp_rate * dot(off, e));
}

namespace {

void across(const Vec3& n, Vec3& p, Vec3& q) {
  p = std::abs(n.z) > std::sqrt(0.5) ? Vec3{0, -n.z, n.y} : Vec3{-n.y, n.x, 0};
  p = p * (1 / norm(p));
  q = cross(n, p);
}

}  // namespace

void add_hinge(std::vector<Row>& rows, const Pair& pair, const Vec3& axis1_W, const Vec3& axis2_W) {
  Vec3 p, q;
  across(axis1_W, p, q);
  const Vec3 off = cross(axis1_W, axis2_W);
  add_turn(rows, pair, p, pair.erp_rate * dot(off, p));
  add_turn(rows, pair, q, pair.erp_rate * dot(off, q));
}

void add_slide(std::vector<Row>& rows, const Pair& pair, const Vec3& axis_W) {
  Vec3 p, q;
  across(axis_W, p, q);
  const Vec3 apart = pair.X_W2.p - pair.X_W1.p;
  for (const Vec3& e : {p, q}) {
    Row r = along(pair, e, true);
    if (r.second < 0) r.a1 = cross(pair.X_W1.p - pair.p1, e);
    r.c = pair.erp_rate * dot(apart, e);
    rows.push_back(r);
  }
}

// Two rows keep the origin of the first body on the axis, the third turns it as it goes. off: m, how far it is beyond where its angle has it.
void add_thread(std::vector<Row>& rows, const Pair& pair, const Vec3& axis_W, double pitch, double off) {
  Vec3 p, q;
  across(axis_W, p, q);
  const Vec3 apart = pair.X_W2.p - pair.X_W1.p;
  for (const Vec3& e : {p, q}) {
    Row r = point_row(pair, pair.X_W1.p, e);
    r.c = pair.erp_rate * dot(apart, e);
    rows.push_back(r);
  }
  Row thread = point_row(pair, pair.X_W1.p, axis_W);
  thread.a1 += axis_W * (1 / pitch);
  if (pair.second >= 0) thread.a2 += axis_W * (-1 / pitch);
  thread.c = -pair.erp_rate * off;
  rows.push_back(thread);
}

// Forces along a line act halfway between the bodies, so that they make no couple.
Row along(const Pair& pair, const Vec3& axis_W, bool linear) {
  Row r;
  r.first = pair.first, r.second = pair.second;
  r.cfm = pair.cfm, r.fastest = pair.fastest;
  if (linear) {
    r.l1 = axis_W;
    if (r.second >= 0) {
      r.l2 = -axis_W;
      r.a1 = r.a2 = cross((pair.p2 - pair.p1) * 0.5, axis_W);
    }
  } else {
    r.a1 = axis_W;
    if (r.second >= 0) r.a2 = -axis_W;
  }
  return r;
}

}  // namespace ode_sim::gazebo_like
