// Which shapes may touch: those whose bounding boxes overlap.
#pragma once
#include <utility>
#include <vector>

namespace ode_sim {

struct Shape;

// Sorts the boxes along x and sweeps. The order is kept from step to step, in which it hardly changes. Shapes of static models stand
// in a list of their own: they never meet each other, and their boxes are looked at only when one of them was moved.
class BroadPhase {
 public:
  void add(Shape* shape);
  void remove(const Shape* shape);
  void static_moved() { stale_ = true; }
  // Appends each pair whose boxes overlap or touch, in no order to rely on; never two shapes of static models.
  void find(std::vector<std::pair<Shape*, Shape*>>& out);

 private:
  struct Box {
    double low[3], high[3];  // world axes, m
    Shape* shape;
  };
  static void refresh(std::vector<Box>& boxes);
  static bool overlap_beside_x(const Box& a, const Box& b);

  std::vector<Box> moving_, static_;
  bool stale_ = false;
};

}  // namespace ode_sim
