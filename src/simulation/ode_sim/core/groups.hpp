// Union-find: which of n things are connected.
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

namespace ode_sim {

class Groups {
 public:
  explicit Groups(size_t n) : above_(n) { std::iota(above_.begin(), above_.end(), 0); }

  // The least member of the group that i belongs to.
  int find(int i) {
    while (above_[i] != i) i = above_[i] = above_[above_[i]];
    return i;
  }
  // Connects two; a negative one is nothing to connect with.
  void merge(int a, int b) {
    if (a < 0 || b < 0) return;
    a = find(a), b = find(b);
    if (a != b) above_[std::max(a, b)] = std::min(a, b);
  }
  size_t size() const { return above_.size(); }

 private:
  std::vector<int> above_;
};

}  // namespace ode_sim
