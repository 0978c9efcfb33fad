// The triangles of a mesh beside a box, without FCL: objects of a scene are boxes more than anything else.
#pragma once

#include "collision_shape.hpp"

namespace motion
{
// A lower bound of the distance of a mesh's triangles and a solid box, m: the least of the widest gaps between the shadows of a triangle
// and of the box, on the box's axes, the triangle's normal, and what is at right angles to an edge of each (Gottschalk, Lin and Manocha,
// OBBTree, 1996). Negative: so deep, by its shadows, some triangle reaches into the box, though none may reach deeper. Once it is more
// than `enough`, nothing better is looked for. NaN where the two are not a mesh and a box.
double gapOfTriangles(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b,
                      double enough);

enum class Touch
{
  No,
  Yes,
  Unsure  // FCL's to say
};
// Whether two shapes touch, where that is known without FCL, which would say the same.
Touch knownTouch(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b);
}  // namespace motion
