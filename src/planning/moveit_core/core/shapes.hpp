// Shapes of geometric_shapes to those of the motion library and back.
#pragma once

#include <geometric_shapes/shapes.h>

#include "motion/shapes.hpp"

namespace moveit
{
namespace core
{
shapes::ShapeConstPtr toShape(const motion::ShapePtr& shape);
motion::ShapePtr fromShape(const shapes::ShapeConstPtr& shape);  // throws motion::InvalidInput
}  // namespace core
}  // namespace moveit
