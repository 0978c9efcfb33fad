// Which of the joint states that come are news: what both state monitors (C++, Python) hold of stamps. Nothing is kept and no node is
// needed: any thread may call this.
#pragma once

#include <ros/time.h>

namespace state_stamps
{
enum class Order
{
  NEWS,         // as new as what is known of the joint, or newer
  REPEATED,     // older: somebody repeats what another publisher has said since
  JUMPED_BACK,  // time goes on from before: a simulation was reset, a bag began again; all that is known is forgotten
};

// MoveIt 1 takes every older stamp for a bag that began again, and two publishers of one joint then undo each other. Here that is so
// where the stamp goes back by more than 0.5 s and what is known is not of now (by 0.5 s): a robot that is heard of does not go back.
Order order(const ros::Time& known, const ros::Time& stamp, const ros::Time& now);
}  // namespace state_stamps
