// Occupied space that grows and shrinks with what sensors see.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "motion/shapes.hpp"

namespace motion
{
// Only occupied space is kept; what was never seen and what is free look alike. So memory grows with surfaces, not with volume.
class OccupancyMap
{
public:
  explicit OccupancyMap(double resolution);

  // What a sensor at `origin` sees at once: ends of rays on something (`occupied`), on things that are known otherwise
  // (`known`: never occupied, and made free) and on nothing (`beyond`). Rays make free what they cross.
  void insert(const Vector3& origin, const std::vector<Vector3>& occupied, const std::vector<Vector3>& known,
              const std::vector<Vector3>& beyond);
  void clear();
  void assign(const OcTreeShape& other);             // takes over resolution and contents
  std::shared_ptr<const OcTreeShape> shape() const;  // as an octree, with the log-odds of each cell
  double resolution() const;
  std::size_t cells() const;

private:
  struct Cells;
  std::shared_ptr<octomap::OcTree> grid_;  // stays empty: turns points into keys and back, and knows the sensor model
  std::shared_ptr<Cells> cells_;
};

struct PlacedShape
{
  ShapePtr shape;
  Transform pose;
  double padding;  // m that it is grown by, after it was scaled
};

enum PointLabel : std::uint8_t
{
  Unknown = 0,  // part of something new
  Inside = 1,   // of one of the shapes, or nearer to it than the padding
  Shadow = 2    // not further than `shadow` behind one of them, seen from `origin`
};
// Which points belong to shapes that are known already; planes and octrees are left out.
std::vector<std::uint8_t> labelPoints(const std::vector<PlacedShape>& shapes, const std::vector<Vector3>& points,
                                      const Vector3& origin, double scale, double shadow);
}  // namespace motion
