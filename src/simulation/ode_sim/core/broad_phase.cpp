#include "broad_phase.hpp"

#include <algorithm>

#include "geometry.hpp"
#include "model.hpp"

namespace ode_sim {

void BroadPhase::add(Shape* shape) {
  Box box{};
  box.shape = shape;
  const bool still = shape->link->model->is_static;
  (still ? static_ : moving_).push_back(box);
  stale_ = stale_ || still;
}

void BroadPhase::remove(const Shape* shape) {
  auto& boxes = shape->link->model->is_static ? static_ : moving_;
  boxes.erase(std::remove_if(boxes.begin(), boxes.end(), [&](const Box& b) { return b.shape == shape; }), boxes.end());
}

void BroadPhase::refresh(std::vector<Box>& boxes) {
  for (Box& b : boxes) {
    dReal aabb[6];
    bounds(*b.shape, aabb);
    for (int i = 0; i < 3; ++i) b.low[i] = aabb[2 * i], b.high[i] = aabb[2 * i + 1];
  }
  for (size_t i = 1; i < boxes.size(); ++i) {
    if (!(boxes[i].low[0] < boxes[i - 1].low[0])) continue;
    const Box moved = boxes[i];
    size_t k = i;
    for (; k > 0 && moved.low[0] < boxes[k - 1].low[0]; --k) boxes[k] = boxes[k - 1];
    boxes[k] = moved;
  }
}

bool BroadPhase::overlap_beside_x(const Box& a, const Box& b) {
  return !(a.low[1] > b.high[1] || a.high[1] < b.low[1] || a.low[2] > b.high[2] || a.high[2] < b.low[2]) &&
         !a.shape->out_of_reach && !b.shape->out_of_reach;
}

void BroadPhase::find(std::vector<std::pair<Shape*, Shape*>>& out) {
  if (stale_) refresh(static_);
  stale_ = false;
  refresh(moving_);
  const auto sweep = [&](const Box& box, const std::vector<Box>& others, size_t from) {
    for (size_t k = from; k < others.size() && others[k].low[0] <= box.high[0]; ++k)
      if (overlap_beside_x(box, others[k])) out.push_back({box.shape, others[k].shape});
  };
  for (size_t i = 0; i < moving_.size(); ++i) sweep(moving_[i], moving_, i + 1);
  // Of a moving and a static box that overlap along x, one begins within the other.
  for (size_t m = 0, s = 0; m < moving_.size() && s < static_.size();) {
    if (moving_[m].low[0] <= static_[s].low[0]) sweep(moving_[m++], static_, s);
    else sweep(static_[s++], moving_, m);
  }
}

}  // namespace ode_sim
