// Forces of rows that have bounds and act on each other, each on each: contacts with friction, stops, motors with a limit.
//
// Wanted are forces f so that each row either moves as it is told, (A f)_i = b_i, or is at a bound and would go beyond it. A bound may be
// a multiple of another row's force (friction). Gauss-Seidel to and fro finds out which rows are at their bounds, soon; to find the
// forces themselves may take it hundreds of rounds. So from time to time what it says of the bounds is believed, the linear equations of
// the other rows are solved exactly, and the result is taken if it contradicts no bound (the active-set method of quadratic programs;
// Hintermueller, Ito, Kunisch, "The primal-dual active set strategy as a semismooth Newton method", 2002).
#pragma once
#include <cstddef>
#include <vector>

namespace ode_sim::bounded {

struct Bound {
  double lo = 0, hi = 0;
  int normal = -1;  // the row whose force times hi bounds this one to both sides; -1 = lo and hi are the bounds
};

// All numbers are per unit of force: A[i * stride + k] is what a force in row k makes of row i, m/s^2 or rad/s^2.
class Rows {
 public:
  explicit Rows(size_t count);

  size_t count() const { return n_; }
  double& coupling(size_t i, size_t k) { return couplings_[i * stride_ + k]; }
  void set(size_t i, const Bound& bound, double wanted);

  // :param rounds: of Gauss-Seidel, at most.
  // :param close_enough: it ends when a round changes no row's acceleration by more.
  void solve(int rounds, double close_enough);
  double force(size_t i) const { return force_[i]; }

 private:
  enum class At : char { kFree, kLow, kHigh };

  void limits(size_t i, const std::vector<double>& force, double* lo, double* hi) const;
  double round(bool back);
  bool solve_exactly();
  bool contradicts(const std::vector<double>& force, const std::vector<At>& at) const;
  void reduce(const std::vector<At>& at, const std::vector<int>& place, std::vector<double>& matrix,
              std::vector<double>& right) const;

  size_t n_, stride_;
  std::vector<double> couplings_, wanted_, left_, force_;
  std::vector<Bound> bounds_;
};

}  // namespace ode_sim::bounded
