// Parts of large meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "../core/geometry.hpp"
#include "../core/mesh_piece.hpp"

using namespace ode_sim;

namespace {

constexpr int kSide = 100;       // squares of a lawn
constexpr double kSquare = 0.1;  // m
double height(double x, double y) { return 0.05 * std::sin(1.3 * x) * std::cos(0.9 * y); }

// Square hills of 10 x 10 m round the origin.
std::shared_ptr<MeshData> lawn() {
  std::vector<double> v;
  std::vector<dTriIndex> t;
  for (int i = 0; i <= kSide; ++i)
    for (int k = 0; k <= kSide; ++k) {
      const double x = kSquare * (i - kSide / 2), y = kSquare * (k - kSide / 2);
      v.insert(v.end(), {x, y, height(x, y)});
    }
  for (dTriIndex i = 0; i < kSide; ++i)
    for (dTriIndex k = 0; k < kSide; ++k) {
      const dTriIndex a = i * (kSide + 1) + k, b = a + kSide + 1;
      t.insert(t.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  return std::make_shared<MeshData>(v, t);
}

// A ball of mesh.
std::shared_ptr<MeshData> pebble(double radius) {
  constexpr int kRings = 16, kAround = 24;
  std::vector<double> v;
  std::vector<dTriIndex> t;
  for (int i = 0; i <= kRings; ++i)
    for (int k = 0; k < kAround; ++k) {
      const double a = kPi * i / kRings, b = 2 * kPi * k / kAround;
      v.insert(v.end(), {radius * std::sin(a) * std::cos(b), radius * std::sin(a) * std::sin(b), radius * std::cos(a)});
    }
  for (dTriIndex i = 0; i < kRings; ++i)
    for (dTriIndex k = 0; k < kAround; ++k) {
      const dTriIndex next = (k + 1) % kAround, a = i * kAround, b = a + kAround;
      if (i > 0) t.insert(t.end(), {a + k, b + next, a + next});
      if (i < kRings - 1) t.insert(t.end(), {a + k, b + k, b + next});
    }
  return std::make_shared<MeshData>(v, t);
}

using Triangle = std::array<double, 9>;

std::set<Triangle> triangles_of(const MeshData& mesh) {
  std::set<Triangle> out;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    Triangle t;
    for (int k = 0; k < 9; ++k) t[k] = mesh.vertices[3 * mesh.indices[i + k / 3] + k % 3];
    out.insert(t);
  }
  return out;
}

// Whether some of a hundred points spread over the triangle lie in the ball.
bool touches(const Triangle& t, const Vec3& middle, double radius) {
  const Vec3 a{t[0], t[1], t[2]}, b{t[3], t[4], t[5]}, c{t[6], t[7], t[8]};
  for (int i = 0; i <= 12; ++i)
    for (int k = 0; i + k <= 12; ++k)
      if (norm(a + (b - a) * (i / 12.0) + (c - a) * (k / 12.0) - middle) < radius) return true;
  return false;
}

struct Chance {
  std::mt19937 engine{1};
  double number(double most) { return std::uniform_real_distribution<double>(-most, most)(engine); }
};

}  // namespace

TEST(MeshPieces, HoldEveryTriangleThatTheBallTouches) {
  const OdeScope scope;
  const auto whole = lawn();
  const std::set<Triangle> all = triangles_of(*whole);
  MeshPieces pieces;
  Chance chance;
  int touched = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3 middle{chance.number(5.2), chance.number(5.2), chance.number(0.2)};
    const double radius = 0.02 + 0.15 * std::abs(chance.number(1));
    const MeshPiece* piece = pieces.near(whole, middle, radius);
    ASSERT_TRUE(piece);
    const std::set<Triangle> held = piece->mesh ? triangles_of(*piece->mesh) : std::set<Triangle>{};
    EXPECT_LT(held.size(), 600u);
    for (const Triangle& t : held) EXPECT_TRUE(all.count(t));
    for (const Triangle& t : all)
      if (touches(t, middle, radius)) {
        ++touched;
        EXPECT_TRUE(held.count(t)) << i;
      }
  }
  EXPECT_GT(touched, 300);
}

TEST(MeshPieces, DependOnTheCellsAndNotOnTheWayThere) {
  const OdeScope scope;
  const auto whole = lawn();
  MeshPieces wandered, fresh;
  Chance chance;
  for (int i = 0; i < 200; ++i) wandered.near(whole, {chance.number(5), chance.number(5), chance.number(0.1)}, 0.03);
  for (int i = 0; i < 50; ++i) {
    const Vec3 at{chance.number(5), chance.number(5), chance.number(0.1)};
    const MeshPiece *one = wandered.near(whole, at, 0.03), *other = fresh.near(whole, at, 0.03);
    ASSERT_EQ(!one->mesh, !other->mesh);
    if (!one->mesh) continue;
    EXPECT_EQ(one->mesh->vertices, other->mesh->vertices);
    EXPECT_EQ(one->mesh->indices, other->mesh->indices);
    fresh.forget();
  }
}

TEST(MeshPieces, WhereNothingIsTheyAreEmptyAndWhereTheyWouldSpareNothingTheyAreNone) {
  const OdeScope scope;
  const auto whole = lawn();
  MeshPieces pieces;
  EXPECT_FALSE(pieces.near(whole, {0, 0, 3}, 0.05)->mesh);
  EXPECT_FALSE(pieces.near(whole, {30, 0, 0}, 0.05)->mesh);
  EXPECT_EQ(pieces.near(whole, {0, 0, 0}, 6), nullptr);       // as large as the lawn
  EXPECT_EQ(pieces.near(pebble(5), {0, 0, 0}, 0), nullptr);   // a point
  EXPECT_EQ(pieces.near(whole, {1e6, 0, 0}, 1e-9), nullptr);  // more cells than can be counted
  const auto slab =
      std::make_shared<MeshData>(std::vector<double>{-9, -9, 0, 9, -9, 0, 0, 9, 0}, std::vector<dTriIndex>{0, 1, 2});
  EXPECT_EQ(pieces.near(slab, {0, 0, 0}, 0.05), nullptr);  // a few triangles
}

// ODE joins contacts that lie close together in the order in which it meets them, which is another one in a piece.
TEST(MeshPieces, TouchAsTheWholeDoes) {
  const OdeScope scope;
  const auto whole = lawn(), small = pebble(0.04);
  const OwnedGeom all(dCreateTriMesh(nullptr, whole->data, nullptr, nullptr, nullptr));
  const OwnedGeom stone(dCreateTriMesh(nullptr, small->data, nullptr, nullptr, nullptr));
  MeshPieces pieces;
  Chance chance;
  int touching = 0, as_many = 0;
  for (int i = 0; i < 200; ++i) {
    const double x = chance.number(4.8), y = chance.number(4.8), z = height(x, y) + 0.04 + chance.number(0.003);
    dGeomSetPosition(stone, x, y, z);
    dContactGeom a[250], b[250];
    const int n = std::min(dCollide(stone, all, 250, a, sizeof a[0]), 250);
    const MeshPiece* piece = pieces.near(whole, {x, y, z}, 0.04);
    ASSERT_TRUE(piece);
    const int m = piece->mesh ? std::min(dCollide(stone, piece->geom, 250, b, sizeof b[0]), 250) : 0;
    EXPECT_EQ(n == 0, m == 0) << i;
    double deepest[2] = {};
    for (int k = 0; k < n; ++k) deepest[0] = std::max(deepest[0], a[k].depth);
    for (int k = 0; k < m; ++k) deepest[1] = std::max(deepest[1], b[k].depth);
    EXPECT_NEAR(deepest[0], deepest[1], 1e-4);
    touching += n > 0, as_many += n > 0 && n == m;
  }
  EXPECT_GT(touching, 60);
  EXPECT_GT(as_many, 0.9 * touching);
}
