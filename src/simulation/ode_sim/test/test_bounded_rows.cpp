// Forces of rows with bounds, against statics and against the conditions that define them.
#include <gtest/gtest.h>

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
