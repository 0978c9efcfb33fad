#include "state_stamps.hpp"

#include <cmath>

namespace state_stamps
{
Order order(const ros::Time& known, const ros::Time& stamp, const ros::Time& now)
{
  constexpr double JUMP = 0.5;  // s
  if (stamp >= known)
    return Order::NEWS;
  const bool of_now = std::abs((now - known).toSec()) <= JUMP;
  return (known - stamp).toSec() > JUMP && !of_now ? Order::JUMPED_BACK : Order::REPEATED;
}
}  // namespace state_stamps
