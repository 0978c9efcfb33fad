// Bullet's name. There is no Bullet here: a scene that is asked for it says so, and FCL goes on checking.
#pragma once

#include <moveit/collision_detection/collision_detector_allocator.h>

namespace collision_detection
{
class CollisionDetectorAllocatorBullet : public CollisionDetectorAllocator
{
public:
  static const std::string& name()
  {
    static const std::string made = "Bullet";
    return made;
  }
  const std::string& getName() const override { return name(); }
  static CollisionDetectorAllocatorPtr create() { return std::make_shared<CollisionDetectorAllocatorBullet>(); }
};
}  // namespace collision_detection
