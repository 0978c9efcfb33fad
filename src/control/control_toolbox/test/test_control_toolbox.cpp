// The PID and the small things in C++, without a ROS master.
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <control_toolbox/dither.h>
#include <control_toolbox/filters.h>
#include <control_toolbox/limited_proxy.h>
#include <control_toolbox/pid.h>
#include <control_toolbox/sine_sweep.h>
#include <control_toolbox/sinusoid.h>

using control_toolbox::Pid;

namespace
{
const ros::Duration second(1.0);
}

TEST(Pid, IsTheSumOfItsTerms)
{
  Pid pid(1.0, 1.0, 1.0, 5.0, -5.0);
  EXPECT_DOUBLE_EQ(-1.5, pid.computeCommand(-0.5, second));  // -0.5 of each
  EXPECT_DOUBLE_EQ(-1.5, pid.computeCommand(-0.5, second));  // -0.5 - 1 + 0
  EXPECT_DOUBLE_EQ(-3.5, pid.computeCommand(-1.0, second));  // -1 - 2 - 0.5
}

TEST(Pid, TheIntegralTermIsClamped)
{
  Pid pid(0.0, 2.0, 0.0, 1.0, -1.0);
  EXPECT_DOUBLE_EQ(-1.0, pid.computeCommand(-1.0, second));
  EXPECT_DOUBLE_EQ(-1.0, pid.computeCommand(-1.0, second));
  EXPECT_DOUBLE_EQ(-1.0, pid.computeCommand(0.5, second)) << "wound up";
  Pid clean(0.0, 2.0, 0.0, 1.0, -1.0, true);
  clean.computeCommand(-1.0, second);
  clean.computeCommand(-1.0, second);
  EXPECT_DOUBLE_EQ(0.0, clean.computeCommand(0.5, second)) << "not wound up";
}

TEST(Pid, WhatIsNoNumberCommandsNothing)
{
  Pid pid(1.0, 1.0, 1.0, 5.0, -5.0);
  EXPECT_EQ(0.0, pid.computeCommand(std::numeric_limits<double>::quiet_NaN(), second));
  EXPECT_EQ(0.0, pid.computeCommand(std::numeric_limits<double>::infinity(), second));
  EXPECT_EQ(0.0, pid.computeCommand(1.0, std::numeric_limits<double>::quiet_NaN(), second));
  EXPECT_EQ(0.0, pid.computeCommand(1.0, ros::Duration(0.0)));
  double p, i, d;
  pid.getCurrentPIDErrors(&p, &i, &d);
  EXPECT_EQ(0.0, i);
}

TEST(Pid, CopiesHaveTheGainsAndNoPast)
{
  Pid pid(1.0, 2.0, 3.0, 4.0, -5.0, true);
  pid.computeCommand(1.0, second);
  Pid copy(pid), assigned;
  assigned = pid;
  for (Pid* one : { &copy, &assigned })
  {
    const Pid::Gains gains = one->getGains();
    EXPECT_EQ(1.0, gains.p_gain_);
    EXPECT_EQ(-5.0, gains.i_min_);
    EXPECT_TRUE(gains.antiwindup_);
    EXPECT_EQ(0.0, one->getCurrentCmd());
  }
}

TEST(Pid, TheFirstStepMayHaveADerivativeOfItsOwn)
{
  Pid pid(0.0, 0.0, 1.0);
  EXPECT_DOUBLE_EQ(2.0, pid.computeCommand(2.0, second)) << "from 0";
  pid.reset(7.0, 0.0);
  EXPECT_DOUBLE_EQ(7.0, pid.computeCommand(2.0, second));
}

TEST(Signals, AreWhatTheySay)
{
  double qd, qdd;
  control_toolbox::Sinusoid sine(1.0, 2.0, 0.25, 0.0);
  EXPECT_NEAR(3.0, sine.update(1.0, qd, qdd), 1e-12);
  EXPECT_NEAR(0.0, qd, 1e-12);
  control_toolbox::SineSweep sweep;
  EXPECT_FALSE(sweep.init(2.0, 1.0, 1.0, 1.0));
  ASSERT_TRUE(sweep.init(1.0, 2.0, 1.0, 3.0));
  EXPECT_EQ(0.0, sweep.update(ros::Duration(0.0)));
  EXPECT_EQ(0.0, sweep.update(ros::Duration(1.5)));
  control_toolbox::Dither one, other;
  one.init(1.0, 5.0);
  other.init(1.0, 5.0);
  EXPECT_EQ(one.update(), other.update());
  EXPECT_EQ(2, filters::clamp(5, 0, 2));
  EXPECT_DOUBLE_EQ(1.5, filters::exponentialSmoothing(2.0, 1.0, 0.5));
}

/// A mass of 1 kg that the proxy brings to 1 m: places (m) and efforts (N) after 1, 301, 601 ... steps of 1 ms.
std::vector<std::pair<double, double>> brought(control_toolbox::LimitedProxy proxy)
{
  std::vector<std::pair<double, double>> out;
  double position = 0.0, velocity = 0.0;
  proxy.reset(position, velocity);
  for (int i = 0; i < 3000; ++i)
  {
    const double effort = proxy.update(1.0, 0.0, 0.0, position, velocity, 0.001);
    velocity += effort * 0.001;
    position += velocity * 0.001;
    if (i % 300 == 0)
      out.emplace_back(position, effort);
  }
  return out;
}

control_toolbox::LimitedProxy proxyOf(double effort, double fastest, double lambda)
{
  control_toolbox::LimitedProxy proxy;
  proxy.mass_ = 1, proxy.Kd_ = 20, proxy.Kp_ = 100, proxy.Ki_ = 10, proxy.Ficl_ = 5, proxy.acc_converge_ = 10;
  proxy.effort_limit_ = effort, proxy.vel_limit_ = fastest, proxy.lambda_proxy_ = lambda;
  return proxy;
}

// Of upstream's class, for the same numbers.
TEST(LimitedProxy, MovesAsUpstreams)
{
  const auto went = brought(proxyOf(10, 1, 5));
  for (const auto& [step, position, effort] :
       { std::make_tuple(0, 0.000, 5.038), std::make_tuple(300, 0.146, 1.109), std::make_tuple(600, 0.411, 0.249),
         std::make_tuple(900, 0.700, -1.468), std::make_tuple(1200, 0.893, -1.337), std::make_tuple(2700, 1.000, -0.004) })
  {
    EXPECT_NEAR(position, went.at(step / 300).first, 6e-4) << step;
    EXPECT_NEAR(effort, went.at(step / 300).second, 6e-4) << step;
  }
}

TEST(LimitedProxy, ALimitOfZeroIsNone)
{
  const auto arrives = [](double effort, double fastest, double lambda) {
    control_toolbox::LimitedProxy proxy = proxyOf(effort, fastest, lambda);
    proxy.Ki_ = 0;
    return brought(proxy).back().first;
  };
  EXPECT_NEAR(1.0, arrives(0, 1, 5), 1e-3);
  EXPECT_NEAR(1.0, arrives(10, 0, 5), 1e-3);
  EXPECT_NEAR(1.0, arrives(10, 1, 0), 1e-3);
  EXPECT_NEAR(1.0, arrives(0, 0, 5), 1e-3);
  EXPECT_NEAR(1.0, arrives(-10, -1, -5), 1e-3);  // signs do not count
}

TEST(LimitedProxy, KeepsItsEffortAndWaitsWhereAJointIsBlocked)
{
  control_toolbox::LimitedProxy proxy = proxyOf(5, 1, 5);
  proxy.reset(0.0, 0.0);
  for (int i = 0; i < 5000; ++i)
    ASSERT_LE(std::abs(proxy.update(1.0, 0.0, 0.0, 0.0, 0.0, 0.001)), 5.0 + 1e-12);
  // Released, it comes back without a jump: with all of its effort, and no more.
  EXPECT_NEAR(5.0, proxy.update(1.0, 0.0, 0.0, 0.0, 0.0, 0.001), 1e-9);
}

TEST(LimitedProxy, TakesTimesThatAreNone)
{
  for (const double dt : { 0.0, -1.0, std::nan("") })
  {
    control_toolbox::LimitedProxy proxy = proxyOf(10, 1, 5);
    proxy.reset(0.5, 0.0);
    EXPECT_TRUE(std::isfinite(proxy.update(1.0, 0.0, 0.0, 0.5, 0.0, dt))) << dt;
  }
}
