// A collision detector by its name, for PlanningScene::setActiveCollisionDetector.
#pragma once

#include <memory>
#include <string>

#include <moveit/macros/class_forward.h>

namespace collision_detection
{
MOVEIT_CLASS_FORWARD(CollisionDetectorAllocator);

class CollisionDetectorAllocator
{
public:
  virtual ~CollisionDetectorAllocator() {}
  virtual const std::string& getName() const = 0;
};
}  // namespace collision_detection
