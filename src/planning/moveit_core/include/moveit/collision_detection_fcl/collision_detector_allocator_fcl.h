// FCL, which checks all scenes here.
#pragma once

#include <moveit/collision_detection/collision_detector_allocator.h>

namespace collision_detection
{
class CollisionDetectorAllocatorFCL : public CollisionDetectorAllocator
{
public:
  static const std::string& name()
  {
    static const std::string made = "FCL";
    return made;
  }
  const std::string& getName() const override { return name(); }
  static CollisionDetectorAllocatorPtr create() { return std::make_shared<CollisionDetectorAllocatorFCL>(); }
};
}  // namespace collision_detection
