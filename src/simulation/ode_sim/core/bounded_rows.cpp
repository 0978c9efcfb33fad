#include "bounded_rows.hpp"

#include <algorithm>
#include <cmath>

#include "wide.hpp"

namespace ode_sim::bounded {

namespace {

constexpr size_t kAtOnce = 4;

// left -= row * by; the same bits on each machine, as nothing is summed up.
ODE_SIM_ALSO_AVX2
void take(double* left, const double* row, double by, size_t stride) {
  for (size_t k = 0; k < stride; k += kAtOnce) {
    Four& l = *reinterpret_cast<Four*>(left + k);
    l -= *reinterpret_cast<const Four*>(row + k) * by;
  }
}

// x of M x = r by elimination with row pivots; M and r are used up. False if M is singular.
bool eliminate(std::vector<double>& M, std::vector<double>& r, size_t n) {
  for (size_t c = 0; c < n; ++c) {
    size_t best = c;
    double size = 0;
    for (size_t i = c; i < n; ++i) {
      if (std::abs(M[i * n + c]) > std::abs(M[best * n + c])) best = i;
      size = std::max(size, std::abs(M[c * n + i]));
    }
    const double pivot = M[best * n + c];
    if (!(std::abs(pivot) > 1e-12 * size) || pivot == 0) return false;
    if (best != c) {
      std::swap_ranges(&M[c * n], &M[c * n] + n, &M[best * n]);
      std::swap(r[c], r[best]);
    }
    for (size_t i = c + 1; i < n; ++i) {
      const double by = M[i * n + c] / pivot;
      if (by == 0) continue;
      for (size_t k = c; k < n; ++k) M[i * n + k] -= by * M[c * n + k];
      r[i] -= by * r[c];
    }
  }
  for (size_t c = n; c-- > 0;) {
    for (size_t k = c + 1; k < n; ++k) r[c] -= M[c * n + k] * r[k];
    r[c] /= M[c * n + c];
  }
  return std::all_of(r.begin(), r.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

Rows::Rows(size_t count)
    : n_(count),
      stride_((count + kAtOnce - 1) / kAtOnce * kAtOnce),
      couplings_(n_ * stride_, 0.0),
      wanted_(stride_, 0.0),
      left_(stride_, 0.0),
      force_(n_, 0.0),
      bounds_(n_) {}

void Rows::set(size_t i, const Bound& bound, double wanted) { bounds_[i] = bound, wanted_[i] = wanted; }

void Rows::limits(size_t i, const std::vector<double>& force, double* lo, double* hi) const {
  const Bound& b = bounds_[i];
  *lo = b.lo, *hi = b.hi;
  if (b.normal >= 0) *hi = std::abs(b.hi * force[b.normal]), *lo = -*hi;
}

void Rows::solve(int rounds, double close_enough) {
  left_ = wanted_;
  std::fill(force_.begin(), force_.end(), 0.0);
  int exactly = std::max(8, static_cast<int>(n_ / 3));  // an exact try costs as much as that many rounds
  for (int done = 0; done < rounds; ++done) {
    if (round(done % 2 != 0) < close_enough) return;
    if (done + 1 < exactly) continue;
    if (solve_exactly()) return;
    exactly *= 2;
  }
}

// How much the acceleration of a row changed, at most.
double Rows::round(bool back) {
  double most = 0;
  for (size_t k = 0; k < n_; ++k) {
    const size_t i = back ? n_ - 1 - k : k;
    const double* row = &couplings_[i * stride_];
    const double own = row[i];
    if (!(own > 0)) continue;
    double lo, hi;
    limits(i, force_, &lo, &hi);
    const double now = std::min(std::max(force_[i] + left_[i] / own, lo), hi), by = now - force_[i];
    if (by == 0) continue;
    force_[i] = now;
    take(left_.data(), row, by, stride_);
    most = std::max(most, std::abs(by) * own);
  }
  return most;
}

// The equations of the rows that are at no bound, in their forces alone: place[i] is where row i's stands in them, or -1.
void Rows::reduce(const std::vector<At>& at, const std::vector<int>& place, std::vector<double>& matrix,
                  std::vector<double>& right) const {
  const size_t m = right.size();
  for (size_t i = 0; i < n_; ++i) {
    if (place[i] < 0) continue;
    double* row = &matrix[place[i] * m];
    right[place[i]] = wanted_[i];
    for (size_t k = 0; k < n_; ++k) {
      const double coupling = couplings_[i * stride_ + k];
      const Bound& b = bounds_[k];
      if (place[k] >= 0) row[place[k]] += coupling;
      else if (b.normal < 0) right[place[i]] -= coupling * (at[k] == At::kLow ? b.lo : b.hi);
      else if (place[b.normal] >= 0) row[place[b.normal]] += coupling * (at[k] == At::kLow ? -b.hi : b.hi);
    }
  }
}

// Whether a force is beyond its bounds, or a row at a bound wants to come back from it.
bool Rows::contradicts(const std::vector<double>& force, const std::vector<At>& at) const {
  for (size_t i = 0; i < n_; ++i) {
    double lo, hi;
    limits(i, force, &lo, &hi);
    if (at[i] == At::kFree) {
      if (force[i] < lo || force[i] > hi) return true;
      continue;
    }
    double left = wanted_[i];
    for (size_t k = 0; k < n_; ++k) left -= couplings_[i * stride_ + k] * force[k];
    if (lo < hi && (at[i] == At::kHigh ? left < 0 : left > 0)) return true;
  }
  return false;
}

bool Rows::solve_exactly() {
  std::vector<At> at(n_, At::kFree);
  std::vector<int> place(n_, -1);
  size_t m = 0;
  for (size_t i = 0; i < n_; ++i) {
    double lo, hi;
    limits(i, force_, &lo, &hi);
    const double own = couplings_[i * stride_ + i];
    if (!(own > 0) && lo < hi) return false;
    // Where the row would go by itself. The force alone may stand a little within a bound that has moved since with the row that it
    // is a multiple of.
    const double towards = own > 0 ? force_[i] + left_[i] / own : force_[i];
    if (towards <= lo) at[i] = At::kLow;
    else if (towards >= hi) at[i] = At::kHigh;
    else place[i] = static_cast<int>(m++);
  }
  std::vector<double> matrix(m * m, 0.0), right(m, 0.0);
  reduce(at, place, matrix, right);
  if (!eliminate(matrix, right, m)) return false;
  std::vector<double> force(n_);
  for (size_t i = 0; i < n_; ++i)
    if (place[i] >= 0) force[i] = right[place[i]];
    else if (bounds_[i].normal < 0) force[i] = at[i] == At::kLow ? bounds_[i].lo : bounds_[i].hi;
  for (size_t i = 0; i < n_; ++i)
    if (place[i] < 0 && bounds_[i].normal >= 0)
      force[i] = (at[i] == At::kLow ? -1 : 1) * bounds_[i].hi * force[bounds_[i].normal];
  if (contradicts(force, at)) return false;
  force_ = force;
  return true;
}

}  // namespace ode_sim::bounded
