#include "tree_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bounded_rows.hpp"

namespace ode_sim::trees {

namespace {

constexpr int kMost = 6;  // rows of a joint that holds everything

// Along the axes of the world, then about them, at the CoM.
using Six = std::array<double, 6>;

Six six(const Vec3& l, const Vec3& a) { return {l.x, l.y, l.z, a.x, a.y, a.z}; }

double dot(const Six& a, const Six& b) {
  double sum = 0;
  for (int i = 0; i < 6; ++i) sum += a[i] * b[i];
  return sum;
}

void add(Six& to, const Six& what, double times) {
  for (int i = 0; i < 6; ++i) to[i] += what[i] * times;
}

// Symmetric, of at most 6 x 6.
struct Square {
  double m[kMost][kMost] = {};

  Six times(const Six& x, int n) const {
    Six out{};
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) out[i] += m[i][k] * x[k];
    return out;
  }
};

// The inverse of a positive definite one, by Cholesky's factors; a pivot that is none is taken for a direction without motion.
Square inverse(const Square& a, int n) {
  double l[kMost][kMost] = {}, inv[kMost][kMost] = {};
  for (int i = 0; i < n; ++i)
    for (int k = 0; k <= i; ++k) {
      double sum = a.m[i][k];
      for (int j = 0; j < k; ++j) sum -= l[i][j] * l[k][j];
      if (i == k) l[i][i] = sum > 1e-14 * a.m[i][i] ? std::sqrt(sum) : HUGE_VAL;
      else l[i][k] = sum / l[k][k];
    }
  for (int i = 0; i < n; ++i) {
    inv[i][i] = 1 / l[i][i];
    for (int k = 0; k < i; ++k) {
      double sum = 0;
      for (int j = k; j < i; ++j) sum -= l[i][j] * inv[j][k];
      inv[i][k] = std::isfinite(l[i][i]) ? sum / l[i][i] : 0;
    }
  }
  Square out;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      for (int j = std::max(i, k); j < n; ++j) out.m[i][k] += inv[j][i] * inv[j][k];
  return out;
}

// A body, and the joint by which it hangs on the one above it. Rows that have no bounds are all in `rows`.
struct Node {
  int body = -1, parent = -1;  // parent: another node; -1 = none, or something that no force moves
  size_t depth = 1;            // nodes on the way to the root
  int count = 0;               // rows of the joint
  size_t rows[kMost];
  Six child[kMost], above[kMost];
  Six wanted{};      // right sides of the rows, as accelerations
  Square inertia;    // of the body and all beyond it
  Square mobility;   // its inverse
  Square stiffness;  // of the joint: the inverse of what a force in it moves
};

// What a force on the bodies becomes at a node on the way to the root.
struct Step {
  int node;
  Six force, motion, gap, pull;  // the latter two: of the joint above
};
using Path = std::vector<Step>;

bool fixed(const Body& b) { return !(b.inverse_mass > 0); }

Square inertia_of(const Body& b) {
  Square out;
  const Sym3 I = gazebo_like::inverse(b.inverse_inertia);
  for (int i = 0; i < 3; ++i) out.m[i][i] = 1 / b.inverse_mass;
  const double about[3][3] = {{I.xx, I.xy, I.xz}, {I.xy, I.yy, I.yz}, {I.xz, I.yz, I.zz}};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) out.m[3 + i][3 + k] = about[i][k];
  return out;
}

class Forest {
 public:
  Forest(std::vector<Row>& rows, std::vector<Body>& bodies, const std::vector<Branch>& joints, const Settings& set)
      : rows_(rows), bodies_(bodies), set_(set), node_of_(bodies.size(), -1) {
    plant(joints);
  }

  bool solve() {
    if (rest_.size() > set_.most_rest || ways() * rest_.size() > set_.most_steps) return false;
    factor();
    std::vector<Six> forces = applied();
    const std::vector<Six> free = respond(forces);
    if (!rest_.empty()) {
      iterate(free);
      for (size_t i : rest_) press(forces, rows_[i]);
    }
    const std::vector<Six> motion = rest_.empty() ? free : respond(forces);
    for (const Node& n : nodes_) {
      Body& b = bodies_[n.body];
      const Six& a = motion[n.body];
      b.push = b.push_fully = Vec3{a[0], a[1], a[2]} - b.force * b.inverse_mass;
      b.turn = b.turn_fully = Vec3{a[3], a[4], a[5]} - b.inverse_inertia * b.torque;
    }
    return true;
  }

 private:
  std::vector<Row>& rows_;
  std::vector<Body>& bodies_;
  const Settings& set_;
  std::vector<Node> nodes_;   // each after the one that it hangs on
  std::vector<int> node_of_;  // of each body
  std::vector<size_t> rest_;  // rows that are left to the iterations

  bool moves(int body) const { return body >= 0 && !fixed(bodies_[body]); }
  bool bounded(const Row& r) const { return r.kind != gazebo_like::kBilateral || r.lo > -1e300 || r.hi < 1e300; }

  double wanted(const Row& r) const {
    const Body& a = bodies_[r.first];
    double speed = ode_sim::dot(r.l1, a.v) + ode_sim::dot(r.a1, a.w);
    if (r.second >= 0) speed += ode_sim::dot(r.l2, bodies_[r.second].v) + ode_sim::dot(r.a2, bodies_[r.second].w);
    return (r.c - speed) / set_.dt;
  }

  size_t ways() const {
    size_t sum = 0;
    for (size_t i : rest_)
      for (int b : {rows_[i].first, rows_[i].second})
        if (moves(b)) sum += nodes_[node_of_[b]].depth;
    return sum;
  }

  // Breadth first, so that ways to the root are short; first what hangs on something that does not move.
  void plant(const std::vector<Branch>& joints) {
    std::vector<std::vector<size_t>> at(bodies_.size());
    std::vector<bool> used(joints.size(), false), of_joint(rows_.size(), false);
    std::vector<size_t> grounded;
    for (size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].from == joints[j].to) continue;
      const Row& r = rows_[joints[j].from];
      for (int b : {r.first, r.second})
        if (moves(b)) at[b].push_back(j);
      if (moves(r.first) != moves(r.second)) grounded.push_back(j);
    }
    size_t next = 0;
    auto grow = [&] {
      for (; next < nodes_.size(); ++next)
        for (size_t j : at[nodes_[next].body]) {
          const Row& r = rows_[joints[j].from];
          const int other = r.first == nodes_[next].body ? r.second : r.first;
          if (used[j] || !moves(other) || node_of_[other] >= 0) continue;
          used[j] = true;
          hang(other, static_cast<int>(next), joints[j], of_joint);
        }
    };
    for (size_t j : grounded) {
      const Row& r = rows_[joints[j].from];
      const int body = moves(r.first) ? r.first : r.second;
      if (node_of_[body] >= 0) continue;
      used[j] = true;
      hang(body, -1, joints[j], of_joint);
      grow();
    }
    for (size_t b = 0; b < bodies_.size(); ++b)
      if (moves(static_cast<int>(b)) && node_of_[b] < 0) {
        hang(static_cast<int>(b), -1, {}, of_joint);
        grow();
      }
    for (size_t i = 0; i < rows_.size(); ++i)
      if (!of_joint[i] && (moves(rows_[i].first) || moves(rows_[i].second))) rest_.push_back(i);
  }

  void hang(int body, int parent, const Branch& joint, std::vector<bool>& of_joint) {
    Node n;
    n.body = body, n.parent = parent;
    if (parent >= 0) n.depth = nodes_[parent].depth + 1;
    for (size_t i = joint.from; i < joint.to; ++i) {
      const Row& r = rows_[i];
      if (bounded(r) || n.count == kMost) continue;
      const Six first = six(r.l1, r.a1), second = six(r.l2, r.a2);
      n.rows[n.count] = i;
      n.child[n.count] = r.first == body ? first : second;
      n.above[n.count] = parent < 0 ? Six{} : r.first == body ? second : first;
      n.wanted[n.count] = wanted(r);
      ++n.count;
      of_joint[i] = true;
    }
    node_of_[body] = static_cast<int>(nodes_.size());
    nodes_.push_back(n);
  }

  // From the leaves to the root: what hangs on a joint adds to the inertia above it, as far as the joint hands it on.
  void factor() {
    for (Node& n : nodes_) n.inertia = inertia_of(bodies_[n.body]);
    for (size_t at = nodes_.size(); at-- > 0;) {
      Node& n = nodes_[at];
      n.mobility = inverse(n.inertia, 6);
      if (!n.count) continue;
      Square gives;
      for (int i = 0; i < n.count; ++i) {
        const Six moved = n.mobility.times(n.child[i], 6);
        for (int k = 0; k < n.count; ++k) gives.m[i][k] = dot(moved, n.child[k]);
        gives.m[i][i] += rows_[n.rows[i]].cfm / set_.dt;
      }
      n.stiffness = inverse(gives, n.count);
      if (n.parent < 0) continue;
      Square& above = nodes_[n.parent].inertia;
      for (int i = 0; i < n.count; ++i) {
        Six pulled{};
        for (int k = 0; k < n.count; ++k) add(pulled, n.above[k], n.stiffness.m[i][k]);
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c) above.m[r][c] += n.above[i][r] * pulled[c];
      }
    }
  }

  std::vector<Six> applied() const {
    std::vector<Six> out(bodies_.size(), Six{});
    for (const Node& n : nodes_) out[n.body] = six(bodies_[n.body].force, bodies_[n.body].torque);
    return out;
  }

  void press(std::vector<Six>& forces, const Row& r) const {
    if (moves(r.first)) add(forces[r.first], six(r.l1, r.a1), r.lambda);
    if (moves(r.second)) add(forces[r.second], six(r.l2, r.a2), r.lambda);
  }

  // Accelerations under these forces, all joints kept; and what these bear.
  std::vector<Six> respond(const std::vector<Six>& forces) {
    std::vector<Six> total = forces, motion(bodies_.size(), Six{}), pulls(nodes_.size(), Six{});
    for (size_t at = nodes_.size(); at-- > 0;) {
      const Node& n = nodes_[at];
      if (!n.count) continue;
      const Six moved = n.mobility.times(total[n.body], 6);
      Six gap{};
      for (int i = 0; i < n.count; ++i) gap[i] = n.wanted[i] - dot(n.child[i], moved);
      pulls[at] = n.stiffness.times(gap, n.count);
      if (n.parent >= 0)
        for (int i = 0; i < n.count; ++i) add(total[nodes_[n.parent].body], n.above[i], pulls[at][i]);
    }
    for (size_t at = 0; at < nodes_.size(); ++at) {
      const Node& n = nodes_[at];
      Six force = total[n.body];
      if (n.count) {
        Six more{};
        if (n.parent >= 0)
          for (int i = 0; i < n.count; ++i) more[i] = dot(n.above[i], motion[nodes_[n.parent].body]);
        const Six less = n.stiffness.times(more, n.count);
        for (int i = 0; i < n.count; ++i) {
          rows_[n.rows[i]].lambda = pulls[at][i] - less[i];
          add(force, n.child[i], rows_[n.rows[i]].lambda);
        }
      }
      motion[n.body] = n.mobility.times(force, 6);
    }
    return motion;
  }

  // A unit force of the row on its way to the root.
  Path path(const Row& r) const {
    std::vector<int> way;
    for (int b : {r.first, r.second})
      for (int at = moves(b) ? node_of_[b] : -1; at >= 0; at = nodes_[at].parent) way.push_back(at);
    std::sort(way.begin(), way.end(), std::greater<int>());
    way.erase(std::unique(way.begin(), way.end()), way.end());
    Path out;
    for (int at : way) out.push_back({at, {}, {}, {}, {}});
    auto step = [&](int node) {
      return std::lower_bound(out.begin(), out.end(), node, [](const Step& s, int n) { return s.node > n; });
    };
    if (moves(r.first)) add(step(node_of_[r.first])->force, six(r.l1, r.a1), 1);
    if (moves(r.second)) add(step(node_of_[r.second])->force, six(r.l2, r.a2), 1);
    for (Step& s : out) {
      const Node& n = nodes_[s.node];
      s.motion = n.mobility.times(s.force, 6);
      for (int i = 0; i < n.count; ++i) s.gap[i] = dot(n.child[i], s.motion);
      s.pull = n.stiffness.times(s.gap, n.count);
      if (n.parent >= 0 && n.count) {
        Six& above = step(n.parent)->force;
        for (int i = 0; i < n.count; ++i) add(above, n.above[i], -s.pull[i]);
      }
    }
    return out;
  }

  // How much a force in one row accelerates another.
  static double coupling(const Path& a, const Path& b) {
    double sum = 0;
    for (auto i = a.begin(), k = b.begin(); i != a.end() && k != b.end();)
      if (i->node > k->node) ++i;
      else if (k->node > i->node) ++k;
      else {
        sum += dot(i->force, k->motion) - dot(i->gap, k->pull);
        ++i, ++k;
      }
    return sum;
  }

  // The rows that are left, as if there were no joints: what these hand on is in the couplings.
  bounded::Rows rest(const std::vector<Six>& free) const {
    std::vector<Path> paths;
    std::vector<int> place(rows_.size(), -1);
    for (size_t i : rest_) {
      place[i] = static_cast<int>(paths.size());
      paths.push_back(path(rows_[i]));
    }
    bounded::Rows out(rest_.size());
    for (size_t i = 0; i < rest_.size(); ++i) {
      const Row& r = rows_[rest_[i]];
      for (size_t k = 0; k <= i; ++k) out.coupling(i, k) = out.coupling(k, i) = coupling(paths[i], paths[k]);
      out.coupling(i, i) += r.cfm / set_.dt;
      double wish = wanted(r);
      if (moves(r.first)) wish -= dot(six(r.l1, r.a1), free[r.first]);
      if (moves(r.second)) wish -= dot(six(r.l2, r.a2), free[r.second]);
      out.set(i, {r.lo, r.hi, r.kind >= 0 ? place[r.kind] : -1}, wish);
    }
    return out;
  }

  void iterate(const std::vector<Six>& free) {
    bounded::Rows rows = rest(free);
    const double squared = static_cast<double>(rows.count()) * rows.count();
    rows.solve(std::max(set_.iterations, static_cast<int>(std::min(1000.0, set_.work / squared))), set_.close_enough);
    for (size_t i = 0; i < rest_.size(); ++i) rows_[rest_[i]].lambda = rows.force(i);
  }
};

}  // namespace

bool solve(std::vector<Row>& rows, std::vector<Body>& bodies, const std::vector<Branch>& joints, const Settings& settings) {
  return Forest(rows, bodies, joints, settings).solve();
}

}  // namespace ode_sim::trees
