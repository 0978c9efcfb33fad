#include "pile_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wide.hpp"

namespace ode_sim::piles {

namespace {

// Six numbers, along the axes and about them, and two of no use.
struct Six {
  Four along_and_x = {}, yz = {};
};

Six six(const Vec3& l, const Vec3& a) {
  Six out;
  out.along_and_x[0] = l.x, out.along_and_x[1] = l.y, out.along_and_x[2] = l.z, out.along_and_x[3] = a.x;
  out.yz[0] = a.y, out.yz[1] = a.z;
  return out;
}

// A row: what it measures of the accelerations of its bodies, relaxed, and what one unit of its force makes of them.
struct Packed {
  Six measures1, measures2, moves1, moves2;
  double wanted, cfm, lo, hi;
  int first, second;
  int normal;  // the row whose force bounds this one, times hi; -1 = none
};

Packed pack(const Row& r, const std::vector<Body>& bodies, const Settings& s) {
  static const Body world;
  const Body &b1 = bodies[r.first], &b2 = r.second >= 0 ? bodies[r.second] : world;
  const double rate = 1 / s.dt, cfm = r.cfm * rate;
  const Vec3 l1 = r.l1 * b1.inverse_mass, a1 = b1.inverse_inertia * r.a1, l2 = r.l2 * b2.inverse_mass,
             a2 = b2.inverse_inertia * r.a2;
  const double own = dot(r.l1, l1) + dot(r.a1, a1) + dot(r.l2, l2) + dot(r.a2, a2) + cfm;
  const double scale = own > 0 ? s.sor / own : 0;
  auto comes = [&](const Body& b, const Vec3& l, const Vec3& a) {
    return dot(l, b.v * rate + b.force * b.inverse_mass) + dot(a, b.w * rate + b.inverse_inertia * b.torque);
  };
  const double free = comes(b1, r.l1, r.a1) + (r.second >= 0 ? comes(b2, r.l2, r.a2) : 0.0);
  Packed p;
  p.measures1 = six(r.l1 * scale, r.a1 * scale), p.measures2 = six(r.l2 * scale, r.a2 * scale);
  p.moves1 = six(l1, a1), p.moves2 = six(l2, a2);
  p.wanted = (r.c * rate - free) * scale, p.cfm = cfm * scale, p.lo = r.lo, p.hi = r.hi;
  p.first = r.first, p.second = r.second >= 0 ? r.second : static_cast<int>(bodies.size());
  p.normal = r.kind >= 0 ? r.kind : -1;
  return p;
}

ODE_SIM_ALSO_AVX2
void sweep(const Packed* rows, const int* order, size_t count, double* lambda, Six* accelerations) {
  for (size_t k = 0; k < count; ++k) {
    const int i = order[k];
    const Packed& r = rows[i];
    Six &b1 = accelerations[r.first], &b2 = accelerations[r.second];
    const Four sums = (r.measures1.along_and_x * b1.along_and_x + r.measures1.yz * b1.yz) +
                      (r.measures2.along_and_x * b2.along_and_x + r.measures2.yz * b2.yz);
    const double there = (sums[0] + sums[2]) + (sums[1] + sums[3]);
    double lo = r.lo, hi = r.hi;
    if (r.normal >= 0) hi = std::abs(hi * lambda[r.normal]), lo = -hi;
    const double old = lambda[i], now = std::min(std::max(old + (r.wanted - old * r.cfm - there), lo), hi), by = now - old;
    lambda[i] = now;
    b1.along_and_x += r.moves1.along_and_x * by, b1.yz += r.moves1.yz * by;
    b2.along_and_x += r.moves2.along_and_x * by, b2.yz += r.moves2.yz * by;
  }
}

// Numbers that depend on the seed alone.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed ? seed : 0x9e3779b97f4a7c15ull) {}
  size_t below(size_t n) {
    state_ ^= state_ << 13, state_ ^= state_ >> 7, state_ ^= state_ << 17;
    return static_cast<size_t>(((state_ >> 32) * n) >> 32);
  }

 private:
  uint64_t state_;
};

}  // namespace

void solve(std::vector<Row>& rows, std::vector<Body>& bodies, const Settings& settings) {
  constexpr int kRoundsOfAnOrder = 8;
  std::vector<Packed> packed;
  packed.reserve(rows.size());
  for (const Row& r : rows) packed.push_back(pack(r, bodies, settings));
  std::vector<Six> accelerations(bodies.size() + 1);  // the last is the world's, which nothing moves
  std::vector<double> lambda(rows.size(), 0.0);
  std::vector<int> order(rows.size());
  std::iota(order.begin(), order.end(), 0);
  Random random(settings.seed);
  for (int round = 0; round < settings.iterations; ++round) {
    if (round % kRoundsOfAnOrder == 0)
      for (size_t i = order.size(); i-- > 1;) std::swap(order[i], order[random.below(i + 1)]);
    sweep(packed.data(), order.data(), order.size(), lambda.data(), accelerations.data());
  }
  for (size_t i = 0; i < rows.size(); ++i) rows[i].lambda = lambda[i];
  for (size_t i = 0; i < bodies.size(); ++i) {
    const Six& a = accelerations[i];
    bodies[i].push = bodies[i].push_fully = {a.along_and_x[0], a.along_and_x[1], a.along_and_x[2]};
    bodies[i].turn = bodies[i].turn_fully = {a.along_and_x[3], a.yz[0], a.yz[1]};
  }
}

}  // namespace ode_sim::piles
