// Forces of rows with bounds, against statics and against the conditions that define them.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>
#include <vector>

#include "../core/bounded_rows.hpp"

using namespace ode_sim;

namespace {

const double kNone = std::numeric_limits<double>::infinity();

// What a row would still move by, unlike it is told.
double residual(bounded::Rows& rows, size_t i, double wanted) {
  for (size_t k = 0; k < rows.count(); ++k) wanted -= rows.coupling(i, k) * rows.force(k);
  return wanted;
}

}  // namespace

TEST(BoundedRows, EachContactOfAStackBearsAllThatIsAboveIt) {
  const size_t n = 80;  // Gauss-Seidel alone would need some thousand rounds
  const double mass = 2, g = 9.81;
  bounded::Rows rows(n);
  for (size_t i = 0; i < n; ++i) {
    rows.coupling(i, i) = (i ? 2 : 1) / mass;
    if (i) rows.coupling(i, i - 1) = rows.coupling(i - 1, i) = -1 / mass;
    rows.set(i, {0, kNone, -1}, i ? 0 : g);
  }
  rows.solve(200, 1e-12);
  for (size_t i = 0; i < n; ++i) EXPECT_NEAR(rows.force(i), static_cast<double>(n - i) * mass * g, 1e-6) << i;
}

TEST(BoundedRows, FrictionSlipsAtItsShareOfTheNormalForceAndHoldsBelow) {
  for (const double pull : {100.0, -100.0, 1.0}) {
    bounded::Rows rows(2);
    rows.coupling(0, 0) = rows.coupling(1, 1) = 0.5;
    rows.coupling(0, 1) = rows.coupling(1, 0) = 0.1;  // it pulls up, too
    rows.set(0, {0, kNone, -1}, 9.81);
    rows.set(1, {-0.5, 0.5, 0}, pull);
    rows.solve(100, 1e-12);
    const double share = pull == 1.0 ? 0 : pull > 0 ? 0.5 : -0.5;
    if (share == 0) {  // both as told: two equations
      EXPECT_NEAR(rows.force(0), (9.81 * 0.5 - 1.0 * 0.1) / 0.24, 1e-9);
      EXPECT_NEAR(rows.force(1), (1.0 * 0.5 - 9.81 * 0.1) / 0.24, 1e-9);
    } else {
      EXPECT_NEAR(rows.force(0), 9.81 / (0.5 + 0.1 * share), 1e-9);
      EXPECT_NEAR(rows.force(1), share * rows.force(0), 1e-9);
    }
  }
}

// A box that slides on its four corners: how they share its weight is left open but for a little compliance, so that Gauss-Seidel
// alone goes on for ever, and each friction follows a normal force that still moves. Law: mu m g against the motion, nothing aside.
TEST(BoundedRows, ABoxSlidesOnFourCornersAsOnOne) {
  const double mass = 10, mu = 0.5, g = 9.81, half = 0.2, height = 0.1, inertia = 0.3, soft = 1e-6;
  bounded::Rows rows(12);
  std::vector<std::array<double, 6>> jacobian;  // of each row, by the box's velocity and turning
  for (int corner = 0; corner < 4; ++corner) {
    const double x = corner % 2 ? half : -half, y = corner / 2 ? half : -half, z = -height;
    jacobian.push_back({0, 0, 1, y, -x, 0});
    jacobian.push_back({1, 0, 0, 0, z, -y});
    jacobian.push_back({0, 1, 0, -z, 0, x});
  }
  for (size_t i = 0; i < 12; ++i) {
    for (size_t k = 0; k < 12; ++k)
      for (int axis = 0; axis < 6; ++axis)
        rows.coupling(i, k) += jacobian[i][axis] * jacobian[k][axis] / (axis < 3 ? mass : inertia);
    rows.coupling(i, i) += soft;
    if (i % 3 == 0) rows.set(i, {0, kNone, -1}, g);
    else rows.set(i, {-mu, mu, static_cast<int>(i - i % 3)}, i % 3 == 1 ? -20 : 0);
  }
  rows.solve(60, 1e-12);
  double weight = 0, ahead = 0, aside = 0, tilt = 0;
  for (size_t i = 0; i < 12; ++i) {
    (i % 3 == 0 ? weight : i % 3 == 1 ? ahead : aside) += rows.force(i);
    tilt += jacobian[i][4] * rows.force(i);
    if (i % 3 == 1) EXPECT_NEAR(rows.force(i), -mu * rows.force(i - 1), 1e-9) << i;
  }
  EXPECT_NEAR(weight, mass * g, 1e-3);
  EXPECT_NEAR(ahead, -mu * mass * g, 1e-3);
  EXPECT_NEAR(aside, 0, 1e-6);
  EXPECT_NEAR(tilt, 0, 1e-3);  // it does not turn over
}

TEST(BoundedRows, EachMovesAsToldOrIsAtItsBoundAndWouldGoBeyond) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int turn = 0; turn < 200; ++turn) {
    const size_t n = 2 + turn % 40, rank = turn % 3 ? n : 1 + n / 2;  // with rows that depend on each other, and without
    std::vector<double> root(n * rank), wanted(n);
    for (double& x : root) x = normal(random);
    bounded::Rows rows(n);
    for (size_t i = 0; i < n; ++i) {
      for (size_t k = 0; k < n; ++k)
        for (size_t j = 0; j < rank; ++j) rows.coupling(i, k) += root[i * rank + j] * root[k * rank + j];
      rows.coupling(i, i) += 1e-6;
      wanted[i] = 5 * normal(random);
      rows.set(i, {i % 3 ? -0.5 : 0, i % 3 == 1 ? 0.5 : kNone, -1}, wanted[i]);
    }
    rows.solve(3000, 1e-9);
    for (size_t i = 0; i < n; ++i) {
      const double lo = i % 3 ? -0.5 : 0, hi = i % 3 == 1 ? 0.5 : kNone, f = rows.force(i), left = residual(rows, i, wanted[i]);
      EXPECT_GE(f, lo) << turn;
      EXPECT_LE(f, hi) << turn;
      if (f > lo) EXPECT_GT(left, -1e-4) << turn << ' ' << i;
      if (f < hi) EXPECT_LT(left, 1e-4) << turn << ' ' << i;
    }
  }
}

TEST(BoundedRows, ARowThatNothingMovesGetsNoForce) {
  bounded::Rows rows(2);
  rows.coupling(0, 0) = 1;
  rows.set(0, {-kNone, kNone, -1}, 3), rows.set(1, {-kNone, kNone, -1}, 4);
  rows.solve(50, 1e-12);
  EXPECT_EQ(rows.force(0), 3);
  EXPECT_EQ(rows.force(1), 0);
}
