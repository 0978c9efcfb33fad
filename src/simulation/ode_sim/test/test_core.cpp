// The pure functions of the core, one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../core/contact_rules.hpp"
#include "../core/forces.hpp"
#include "../core/groups.hpp"
#include "../core/pile_solver.hpp"
#include "../core/separation.hpp"

using namespace ode_sim;

// ------------------------------------------------------------------------------------------------ groups

TEST(Groups, ThingsAreAloneUntilTheyAreConnected) {
  Groups groups(5);
  groups.merge(3, 1);
  groups.merge(4, 3);
  EXPECT_EQ(groups.find(4), 1);
  EXPECT_EQ(groups.find(3), 1);
  EXPECT_EQ(groups.find(0), 0);
  EXPECT_EQ(groups.find(2), 2);
}

TEST(Groups, TheLeastMemberStandsForAGroupInWhateverOrderItGrew) {
  const std::vector<std::pair<int, int>> pairs = {{7, 6}, {5, 6}, {2, 3}, {3, 7}, {0, 1}};
  Groups forth(8), back(8);
  for (size_t i = 0; i < pairs.size(); ++i) {
    forth.merge(pairs[i].first, pairs[i].second);
    back.merge(pairs[pairs.size() - 1 - i].second, pairs[pairs.size() - 1 - i].first);
  }
  const int wanted[] = {0, 0, 2, 2, 4, 2, 2, 2};
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(forth.find(i), wanted[i]);
    EXPECT_EQ(back.find(i), wanted[i]);
  }
}

TEST(Groups, TheWorldConnectsNothing) {
  Groups groups(2);
  groups.merge(-1, 0);
  groups.merge(1, -1);
  EXPECT_NE(groups.find(0), groups.find(1));
}

// ------------------------------------------------------------------------------------------------ contacts

static Touch on_floor(double depth) {
  Touch touch;
  touch.depth = depth;
  touch.inverse_mass = 1;
  touch.one_is_fixed = true;
  touch.outwards = -9.8;
  return touch;
}

TEST(ContactHardness, SpringAndDamperAreThoseOfBothSurfacesInARow) {
  Surface a, b;
  a.kp = 1e4, b.kp = 3e4, a.kd = 5, b.kd = 2;
  HardnessSettings set;
  set.softness = 0;
  const Hardness hard = contact_hardness(a, b, on_floor(0), set);
  const double kp = 7500, kd = 7;
  EXPECT_NEAR(hard.soft_erp, 0.001 * kp / (0.001 * kp + kd), 1e-12);
  EXPECT_NEAR(hard.soft_cfm, 1 / (0.001 * kp + kd), 1e-12);
}

TEST(ContactHardness, ALittleOverlapIsLeftAlone) {
  EXPECT_EQ(contact_hardness({}, {}, on_floor(1.9e-5), {}).depth, 0);
  EXPECT_GT(contact_hardness({}, {}, on_floor(3e-5), {}).depth, 0);
  Surface soft;
  soft.min_depth = 0.001;
  EXPECT_EQ(contact_hardness(soft, soft, on_floor(0.0009), {}).depth, 0);
}

TEST(ContactHardness, OverlapIsUndoneNoFasterThanTheSlowerSurfaceAllows) {
  Surface slow, fast;
  slow.max_vel = 0.05, fast.max_vel = 2;
  const HardnessSettings set;
  const Hardness hard = contact_hardness(slow, fast, on_floor(0.009), set);
  EXPECT_EQ(hard.fastest, 0.05);
  EXPECT_NEAR(hard.depth * hard.soft_erp / set.dt, 0.05, 1e-6);
}

TEST(ContactHardness, MaxVelAndMinDepthAreThoseOfWhatCanMove) {
  Surface loose, tight;
  loose.max_vel = 2, loose.min_depth = 0.005;
  for (bool like_gazebo : {false, true}) {
    HardnessSettings set;
    set.like_gazebo = like_gazebo, set.fastest = 1.5;
    Touch touch = on_floor(0.004);
    touch.corrected_a = &loose;  // b stands still
    EXPECT_EQ(contact_hardness(loose, tight, touch, set).fastest, 1.5);
    EXPECT_EQ(contact_hardness(loose, tight, touch, set).depth, 0);
    touch.corrected_a = nullptr, touch.corrected_b = &tight;
    EXPECT_EQ(contact_hardness(loose, tight, touch, set).fastest, 0.01);
    EXPECT_GT(contact_hardness(loose, tight, touch, set).depth, 0);
    touch.corrected_a = &loose;  // both move
    EXPECT_EQ(contact_hardness(loose, tight, touch, set).fastest, 0.01);
  }
}

TEST(ContactHardness, WhatBouncesIsHardForThatStep) {
  Surface lively;
  lively.restitution = 0.5, lively.bounce_threshold = 0.1;
  Touch touch = on_floor(0);
  const double at_rest = contact_hardness(lively, lively, touch, {}).soft_cfm;
  touch.leaving = -0.09;
  EXPECT_EQ(contact_hardness(lively, lively, touch, {}).soft_cfm, at_rest);
  touch.leaving = -0.11;
  EXPECT_LT(contact_hardness(lively, lively, touch, {}).soft_cfm, 0.02 * at_rest);
  EXPECT_EQ(contact_hardness(lively, {}, touch, {}).soft_cfm, at_rest);  // it takes both
}

TEST(ContactHardness, WhatWasPutDeepIntoTheFloorComesOutAsGravityWouldBringItBack) {
  const HardnessSettings set;
  const Hardness floor = contact_hardness({}, {}, on_floor(0.11), set);
  EXPECT_NEAR(floor.depth * floor.soft_erp / set.dt, 0.9 * std::sqrt(2 * 9.8 * (0.11 - 2e-5 - 0.01)), 1e-3);
  Touch wall = on_floor(0.11);
  wall.outwards = 0;
  EXPECT_NEAR(contact_hardness({}, {}, wall, set).depth, 0.01 * set.dt, 1e-4);
}

TEST(ContactHardness, ASoftSpringPutInDeeplyPushesNoFasterThanItIsTo) {
  Surface soft;
  soft.kp = 1e4, soft.max_vel = 1;
  const HardnessSettings set;
  Touch touch = on_floor(0.05);
  const double still = contact_hardness(soft, {}, touch, set).depth;
  touch.leaving = 0.5;
  const double rising = contact_hardness(soft, {}, touch, set).depth;
  touch.leaving = 5;
  const Hardness flying = contact_hardness(soft, {}, touch, set);
  EXPECT_GT(still, rising);
  EXPECT_GT(rising, flying.depth);
  EXPECT_NEAR(flying.depth * flying.soft_erp / set.dt, 0.9 * std::sqrt(2 * 9.8 * (0.05 - 2e-5 - 0.01)), 1e-3);
}

TEST(ContactHardness, ASoftSpringPutInDeeplyKeepsToThatOnItsLastCentimetre) {
  Surface soft;
  soft.kp = 1e4, soft.max_vel = 1;
  Touch touch = on_floor(0.005);
  touch.leaving = 5;
  const double falling = contact_hardness(soft, {}, touch, {}).depth;
  touch.emerging = true;
  EXPECT_LT(contact_hardness(soft, {}, touch, {}).depth, falling);
}

TEST(ContactHardness, AMergedContactIsAsHardAsThoseThatItStandsFor) {
  Touch merged = on_floor(0);
  merged.merged = 3;
  EXPECT_DOUBLE_EQ(3 * contact_hardness({}, {}, merged, {}).soft_cfm, contact_hardness({}, {}, on_floor(0), {}).soft_cfm);
}

TEST(ContactHardness, AsGazeboHasItDepthIsNotCut) {
  HardnessSettings set;
  set.like_gazebo = true;
  EXPECT_EQ(contact_hardness({}, {}, on_floor(0.3), set).depth, 0.3);
}

TEST(FrictionDirection, LiesInThePlaneOfTheContactAlongWhatIsWanted) {
  const Vec3 t = friction_direction({0, 0, 1}, {3, 4, 5});
  EXPECT_NEAR(t.x, 0.6, 1e-12);
  EXPECT_NEAR(t.y, 0.8, 1e-12);
  EXPECT_EQ(t.z, 0);
}

TEST(FrictionDirection, IsSomeTangentWhereNothingIsWanted) {
  const Vec3 n{0.6, 0, 0.8};
  for (const Vec3& wanted : {Vec3{}, n * 5.0}) {
    const Vec3 t = friction_direction(n, wanted);
    EXPECT_NEAR(norm(t), 1, 1e-12);
    EXPECT_NEAR(dot(t, n), 0, 1e-12);
  }
}

TEST(Directed, OfTwoThatAskTheOneWithLessFrictionIsHeard) {
  Surface none, a, b;
  a.fdir1 = {1, 0, 0}, b.fdir1 = {0, 1, 0};
  a.mu = 0.5, b.mu = 0.4;
  EXPECT_EQ(directed(none, none), nullptr);
  EXPECT_EQ(directed(a, none), &a);
  EXPECT_EQ(directed(none, b), &b);
  EXPECT_EQ(directed(a, b), &b);
  EXPECT_EQ(directed(b, a), &b);
}

TEST(ContactRoughness, IsThatOfTheSmootherSurfaceAndNeverNegative) {
  Surface a, b;
  a.mu = 0.3, a.mu2 = 2, b.mu = 0.7, b.mu2 = 0.1, a.slip1 = 0.1, b.slip1 = 0.2;
  const Roughness rough = contact_roughness(a, b, 0.001);
  EXPECT_EQ(rough.mu, 0.3);
  EXPECT_EQ(rough.mu2, 0.1);
  EXPECT_NEAR(rough.slip1, 0.3, 1e-12);
  EXPECT_FALSE(rough.isotropic());
  b.mu = b.mu2 = -1;
  EXPECT_EQ(contact_roughness(a, b, 0.001).mu, 0);
}

// M = 3 pi/16 c r N; of a curvature r is the root of R d, and curvatures add up.
TEST(ContactRoughness, AboutTheNormalIsThatOfThePatch) {
  Surface a, b;
  EXPECT_EQ(contact_roughness(a, b, 0.001).spin, 0);
  a.torsional_mu = 0.5, a.patch_radius = 0.05, b.patch_radius = 0.02, a.torsional_slip = 0.1, b.torsional_slip = 0.3;
  EXPECT_NEAR(contact_roughness(a, b, 0.001).spin, 3 * M_PI / 16 * 0.5 * 0.05, 1e-15);
  EXPECT_NEAR(contact_roughness(a, b, 0.001).spin_slip, 0.4, 1e-15);
  a.use_patch_radius = false, a.surface_radius = 0.1;
  EXPECT_NEAR(contact_roughness(a, b, 0.001).spin, 3 * M_PI / 16 * 0.5 * 0.01, 1e-12);  // b is flat
  b.surface_radius = 0.1;
  EXPECT_NEAR(contact_roughness(a, b, 0.008).spin, 3 * M_PI / 16 * 0.5 * 0.02, 1e-12);
  EXPECT_EQ(contact_roughness(a, b, -0.001).spin, 0);
  b.surface_radius = 0;
  EXPECT_EQ(contact_roughness(a, b, 0.001).spin, 0);
}

// ------------------------------------------------------------------------------------------------ axes

static const double kDt = 0.001;

TEST(AxisRow, AMotorGoesBeforeFrictionAndADriveBeforeAMotor) {
  Axis axis;
  axis.friction = 3;
  MotorRow row = axis_row(axis, kDt, 1, false, false, nullptr);
  EXPECT_EQ(row.speed, 0);
  EXPECT_EQ(row.most, 3);
  axis.motor_velocity = 2, axis.motor_force = 5;
  row = axis_row(axis, kDt, 1, false, false, nullptr);
  EXPECT_EQ(row.speed, 2);
  EXPECT_EQ(row.most, 5);
  const MotorRow drive{-1, 9};
  row = axis_row(axis, kDt, 1, false, false, &drive);
  EXPECT_EQ(row.speed, -1);
  EXPECT_EQ(row.most, 9);
}

TEST(AxisRow, SpringsAndDampersAreForcesUntilTheyWouldSwing) {
  Axis axis;
  axis.damping = 2, axis.qd = 3, axis.spring_stiffness = 10, axis.q = 0.5, axis.spring_reference = 0.1;
  MotorRow row = axis_row(axis, kDt, 1, false, false, nullptr);
  EXPECT_EQ(row.most, 0);
  EXPECT_NEAR(row.force, -10 * 0.4 - 2 * 3, 1e-12);
  row = axis_row(axis, kDt, 1000, false, false, nullptr);  // a light link: it would swing by the damper, but not by the spring
  EXPECT_EQ(row.most, dInfinity);
  EXPECT_NEAR(row.softness, 1 / 2.0, 1e-12);
  EXPECT_EQ(row.speed, 0);
  EXPECT_NEAR(row.force, -10 * 0.4, 1e-12);
  row = axis_row(axis, kDt, 1e5, false, false, nullptr);
  const double d = 2 + kDt * 10;
  EXPECT_EQ(row.most, dInfinity);
  EXPECT_NEAR(row.softness, 1 / d, 1e-12);
  EXPECT_NEAR(row.speed, -10 * 0.4 / d, 1e-12);
  EXPECT_EQ(row.force, 0);
}

TEST(AxisRow, AStiffLawIsARowThatNeverGivesMoreThanTheEffort) {
  Axis axis;
  axis.slope = 50, axis.law = 100, axis.law_bound = 40, axis.effort = 30;
  axis.force = axis.lawful();
  EXPECT_EQ(axis.force, 30);
  const MotorRow row = axis_row(axis, kDt, 1000, false, false, nullptr);
  EXPECT_EQ(row.force, 0);
  EXPECT_EQ(row.most, 30);
  EXPECT_NEAR(row.speed, 2, 1e-12);
  EXPECT_NEAR(row.softness, 1 / 50.0, 1e-12);
  EXPECT_EQ(axis_row(axis, kDt, 1, false, false, nullptr).force, 30);  // a heavy link: the force as it is
}

TEST(AxisRow, AtAStopNothingIsARow) {
  Axis axis;
  axis.slope = 50, axis.law = 100, axis.law_bound = 40, axis.upper = 1, axis.q = 1;
  axis.force = axis.lawful();
  const MotorRow row = axis_row(axis, kDt, 1000, false, false, nullptr);
  EXPECT_EQ(row.most, 0);
  EXPECT_EQ(row.force, 40);
}

TEST(SpeedByLaw, FrictionIsTakenOffAndNeverTurnsTheSpeedRound) {
  Axis axis;
  axis.slope = 10, axis.law = 20, axis.law_bound = kInf, axis.friction = 5;
  EXPECT_NEAR(speed_by_law(axis, kDt, 1), 2 - 0.5, 1e-12);
  axis.law = -20;
  EXPECT_NEAR(speed_by_law(axis, kDt, 1), -2 + 0.5, 1e-12);
  axis.law = 1;
  EXPECT_EQ(speed_by_law(axis, kDt, 1), 0);
}

TEST(SpeedByLaw, ALimitOfSpeedIsPassedByWhatOneStepGives) {
  Axis axis;
  axis.slope = 10, axis.law = 100, axis.law_bound = 8, axis.velocity = 3;
  EXPECT_NEAR(speed_by_law(axis, kDt, 100), 3 + kDt * 100 * 8, 1e-12);
}

// ------------------------------------------------------------------------------------------------ piles

namespace {

constexpr double kG = 9.8;  // m/s^2

// Balls of 2 kg in a column, each at rest on the one below, the lowest on the floor; pushed along x by `pushed` N at the top.
struct Column {
  std::vector<piles::Body> bodies;
  std::vector<piles::Row> rows;  // of each contact: normal, friction along x

  Column(int count, double mu, double pushed) {
    for (int i = 0; i < count; ++i) {
      piles::Body b;
      b.inverse_mass = 0.5, b.inverse_inertia = {5, 5, 5};
      b.force = {i == count - 1 ? pushed : 0.0, 0, -2 * kG};
      bodies.push_back(b);
      piles::Row normal;
      normal.first = i, normal.second = i - 1;
      normal.l1 = {0, 0, 1}, normal.l2 = i ? Vec3{0, 0, -1} : Vec3{};
      normal.lo = 0, normal.kind = gazebo_like::kNormal;
      piles::Row friction = normal;
      friction.l1 = {1, 0, 0}, friction.l2 = i ? Vec3{-1, 0, 0} : Vec3{};
      friction.hi = mu, friction.kind = static_cast<int>(rows.size());
      rows.push_back(normal);
      rows.push_back(friction);
    }
  }

  void solve(int iterations, uint64_t seed = 1) {
    piles::Settings settings;
    settings.iterations = iterations, settings.seed = seed;
    piles::solve(rows, bodies, settings);
  }
};

}  // namespace

TEST(Pile, EachContactBearsAllThatLiesOnIt) {
  Column column(5, 0, 0);
  column.solve(400);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(column.rows[2 * i].lambda, (5 - i) * 2 * kG, 1e-6);
    EXPECT_NEAR(column.bodies[i].push.z, kG, 1e-6);  // less gravity nothing is left
    EXPECT_EQ(column.bodies[i].push_fully.z, column.bodies[i].push.z);
  }
}

TEST(Pile, FrictionHoldsUpToItsShareOfTheNormalForce) {
  Column held(1, 0.5, 9.0), slides(1, 0.5, 12.0);
  held.solve(400), slides.solve(400);
  EXPECT_NEAR(held.rows[1].lambda, -9.0, 1e-9);
  EXPECT_NEAR(slides.rows[1].lambda, -0.5 * 2 * kG, 1e-9);
  EXPECT_NEAR(slides.bodies[0].push.x, -0.5 * kG, 1e-9);
}

TEST(Pile, AContactDoesNotPull) {
  Column lifted(1, 0.5, 0);
  lifted.bodies[0].force.z = 5;
  lifted.solve(50);
  EXPECT_EQ(lifted.rows[0].lambda, 0);
  EXPECT_EQ(lifted.bodies[0].push.z, 0);
}

TEST(Pile, TheSeedAloneDecidesTheOrder) {
  Column one(6, 0.5, 3), same(6, 0.5, 3), other(6, 0.5, 3);
  one.solve(20, 7), same.solve(20, 7), other.solve(20, 8);
  for (size_t i = 0; i < one.rows.size(); ++i) EXPECT_EQ(one.rows[i].lambda, same.rows[i].lambda);
  EXPECT_NE(one.rows[0].lambda, other.rows[0].lambda);
}

// ------------------------------------------------------------------------------------------------ meshes that are apart

namespace {

// A box as a mesh, and as what it is.
struct Block {
  std::vector<double> corners;
  Vec3 half;
  explicit Block(const Vec3& h) : half(h) {
    for (int i = 0; i < 8; ++i) corners.insert(corners.end(), {i & 1 ? h.x : -h.x, i & 2 ? h.y : -h.y, i & 4 ? h.z : -h.z});
  }
  std::vector<dTriIndex> sides() const {
    return {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  }
  Vec3 nearest(const Vec3& p) const {
    return {std::clamp(p.x, -half.x, half.x), std::clamp(p.y, -half.y, half.y), std::clamp(p.z, -half.z, half.z)};
  }
};

// m between two: going to and fro between the nearest points of convex sets ends at those that are nearest of all.
double distance_of(const Block& a, const Block& b, const Pose& X_AB) {
  Vec3 p, q;
  for (int i = 0; i < 3000; ++i) q = X_AB * b.nearest(inverse(X_AB) * p), p = a.nearest(q);
  return norm(p - q);
}

struct Randoms {
  std::mt19937 engine{1};
  double number(double most) { return std::uniform_real_distribution<double>(-most, most)(engine); }
  Vec3 vector(double most) { return {number(most), number(most), number(most)}; }
  Vec3 sides() { return {0.5 + number(0.45), 0.5 + number(0.45), 0.5 + number(0.45)}; }
  Pose pose(double most) { return {vector(most), normalized(Quat{number(1), number(1), number(1), number(1)})}; }
};

}  // namespace

TEST(HullsApart, IsABoundOfTheDistanceAndMostlyAGoodOne) {
  const OdeScope scope;
  Randoms random;
  int far = 0, found = 0;
  for (int i = 0; i < 500; ++i) {
    const Block a(random.sides()), b(random.sides());
    const Pose X = random.pose(2);
    Vec3 n{1, 0, 0};
    const double bound = hulls_apart({a.corners, a.sides()}, {b.corners, b.sides()}, X, n), distance = distance_of(a, b, X);
    EXPECT_LT(bound, distance + 1e-9) << i;
    EXPECT_NEAR(norm(n), 1, 1e-12);
    far += distance > 0.05, found += distance > 0.05 && bound > 0.5 * distance;
  }
  EXPECT_GT(far, 150);
  EXPECT_GT(found, 0.95 * far);
}

TEST(MostMoved, NoPointMovesByMore) {
  Randoms random;
  for (int i = 0; i < 1000; ++i) {
    const Pose X = random.pose(1),
               Y = i % 2 ? random.pose(1) : X * Pose{random.vector(0.01), normalized(Quat{0.01, 0, 0.02, 1})};
    const Vec3 middle = random.vector(1), off = random.vector(1);
    const Vec3 p = middle + off;
    EXPECT_LE(norm(Y * p - X * p), most_moved(X, Y, middle, norm(off)) + 1e-12);
  }
  const Vec3 middle{1, 0, 0};
  EXPECT_NEAR(most_moved({}, {{0, 0, 0}, axis_angle({0, 0, 1}, kPi)}, middle, 0.5), 2 + 2 * 0.5, 1e-12);
}
