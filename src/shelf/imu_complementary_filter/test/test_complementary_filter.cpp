#include <cmath>

#include <gtest/gtest.h>
#include <imu_complementary_filter/complementary_filter.h>

namespace {
const double kGravity = 9.81;

struct Angles {
  double roll, pitch, yaw;
};

Angles anglesOf(const imu_tools::ComplementaryFilter& filter) {
  double w, x, y, z;
  filter.getOrientation(w, x, y, z);
  return Angles{std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)), std::asin(2 * (w * y - z * x)),
                std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))};
}

/// What a sensor at rest reads that is rolled by this angle.
void rest(imu_tools::ComplementaryFilter& filter, double roll, double wz = 0.0, int count = 1) {
  for (int i = 0; i < count; ++i) filter.update(0.0, kGravity * std::sin(roll), kGravity * std::cos(roll), 0.0, 0.0, wz, 0.01);
}
}  // namespace

TEST(ComplementaryFilter, FirstReadingSetsTheOrientation) {
  imu_tools::ComplementaryFilter filter;
  rest(filter, 0.4);
  EXPECT_NEAR(anglesOf(filter).roll, 0.4, 1e-9);
  filter.reset();
  rest(filter, M_PI);  // upside down
  EXPECT_NEAR(std::abs(anglesOf(filter).roll) + std::abs(anglesOf(filter).pitch), M_PI, 1e-6);
}

TEST(ComplementaryFilter, TurnsWithTheRatesAndIsPulledUpright) {
  imu_tools::ComplementaryFilter filter;
  filter.setDoBiasEstimation(false);
  rest(filter, 0.0);
  rest(filter, 0.0, 1.0, 100);
  EXPECT_NEAR(anglesOf(filter).yaw, 1.0, 1e-6);
  filter.setGainAcc(0.05);
  filter.setOrientation(std::cos(0.25), std::sin(0.25), 0.0, 0.0);
  rest(filter, 0.0, 0.0, 10);
  EXPECT_NEAR(anglesOf(filter).roll, 0.5 * std::pow(0.95, 10), 1e-6);
}

TEST(ComplementaryFilter, FindsTheBiasAtRest) {
  imu_tools::ComplementaryFilter filter;
  rest(filter, 0.0, 0.05);
  rest(filter, 0.0, 0.05, 1000);
  EXPECT_TRUE(filter.getSteadyState());
  EXPECT_NEAR(filter.getAngularVelocityBiasZ(), 0.05, 1e-4);
  rest(filter, 0.0, 0.5);
  EXPECT_FALSE(filter.getSteadyState());
}

TEST(ComplementaryFilter, FieldTellsNorth) {
  imu_tools::ComplementaryFilter filter;
  filter.setGainMag(0.1);
  filter.update(0, 0, kGravity, 0, 0, 0, std::cos(0.7), -std::sin(0.7), -1.0,
                0.01);  // x of the sensor is 0.7 rad left of north
  EXPECT_NEAR(anglesOf(filter).yaw, 0.7, 1e-9);
  for (int i = 0; i < 10; ++i) filter.update(0, 0, kGravity, 0, 0, 0, 1.0, 0.0, -1.0, 0.01);
  EXPECT_NEAR(anglesOf(filter).yaw, 0.7 * std::pow(0.9, 10), 1e-6);
}

TEST(ComplementaryFilter, AdaptiveGainLeavesOutWhatIsNotGravity) {
  imu_tools::ComplementaryFilter filter;
  filter.setDoAdaptiveGain(true);
  filter.setDoBiasEstimation(false);
  rest(filter, 0.3);
  filter.update(0, 0, 1.3 * kGravity, 0, 0, 0, 0.01);
  EXPECT_NEAR(anglesOf(filter).roll, 0.3, 1e-9);
  filter.update(0, 0, 1.15 * kGravity, 0, 0, 0, 0.01);
  EXPECT_NEAR(anglesOf(filter).roll, 0.3 * (1 - 0.005), 1e-6);
}

TEST(ComplementaryFilter, RefusesGainsAndReadingsThatAreNone) {
  imu_tools::ComplementaryFilter filter;
  EXPECT_FALSE(filter.setGainAcc(1.5));
  EXPECT_FALSE(filter.setGainMag(-0.1));
  EXPECT_FALSE(filter.setBiasAlpha(NAN));
  EXPECT_EQ(filter.getGainAcc(), 0.01);
  filter.update(0, 0, 0, 0, 0, 0, 0.01);  // in free fall: nothing to begin with
  rest(filter, 0.2);
  EXPECT_NEAR(anglesOf(filter).roll, 0.2, 1e-9);
  filter.update(NAN, 0, 0, 0, 0, 0, 0.01);
  EXPECT_NEAR(anglesOf(filter).roll, 0.2, 1e-9);
  filter.update(0, 0, kGravity, INFINITY, 0, 0, 0.01);
  EXPECT_TRUE(std::isfinite(anglesOf(filter).roll));
}
