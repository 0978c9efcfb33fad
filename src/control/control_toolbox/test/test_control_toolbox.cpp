// The PID and the small things in C++, without a ROS master.
#include <cmath>
#include <limits>

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

TEST(LimitedProxy, ReachesItsTargetWithinItsEffort)
{
  control_toolbox::LimitedProxy proxy;
  proxy.mass_ = 1.0;
  proxy.Kp_ = 100.0;
  proxy.Kd_ = 20.0;
  proxy.effort_limit_ = 5.0;
  proxy.vel_limit_ = 1.0;
  proxy.lambda_proxy_ = 5.0;
  proxy.acc_converge_ = 3.0;
  double position = 0.0, velocity = 0.0;
  proxy.reset(position, velocity);
  for (int i = 0; i < 5000; ++i)
  {
    const double effort = proxy.update(1.0, 0.0, 0.0, position, velocity, 0.001);
    ASSERT_LE(std::abs(effort), 5.0);
    velocity += effort * 0.001;
    position += velocity * 0.001;
  }
  EXPECT_NEAR(1.0, position, 1e-3);
}
