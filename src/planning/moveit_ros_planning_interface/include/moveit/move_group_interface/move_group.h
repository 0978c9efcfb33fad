// The name of before Kinetic.
#pragma once

#include <moveit/move_group_interface/move_group_interface.h>

#warning \
    "moveit/move_group_interface/move_group.h is old: include move_group_interface.h and say MoveGroupInterface, not MoveGroup"

namespace moveit {
namespace planning_interface {

class MoveGroup : public MoveGroupInterface {
 public:
  using MoveGroupInterface::MoveGroupInterface;
};

typedef std::shared_ptr<MoveGroup> MoveGroupPtr;
typedef std::shared_ptr<const MoveGroup> MoveGroupConstPtr;

}  // namespace planning_interface
}  // namespace moveit

namespace move_group_interface = moveit::planning_interface;
