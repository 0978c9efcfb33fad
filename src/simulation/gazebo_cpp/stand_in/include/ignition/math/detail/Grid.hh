#pragma once
#include <array>
#include <istream>

#include <ignition/math/Helpers.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{
namespace detail
{

/// What square matrices of three and of four have in common; M is the matrix.
template <class M, typename T, std::size_t N>
class Grid
{
public:
  /// Beyond the end is the last row or column.
  const T& operator()(std::size_t row, std::size_t column) const
  {
    return data_[std::min(row, N - 1) * N + std::min(column, N - 1)];
  }
  T& operator()(std::size_t row, std::size_t column) { return data_[std::min(row, N - 1) * N + std::min(column, N - 1)]; }

  M operator+(const M& m) const
  {
    M result = self();
    for (std::size_t i = 0; i < N * N; ++i)
      result.data_[i] += m.data_[i];
    return result;
  }
  M operator-(const M& m) const
  {
    M result = self();
    for (std::size_t i = 0; i < N * N; ++i)
      result.data_[i] -= m.data_[i];
    return result;
  }
  M operator*(const T& s) const
  {
    M result = self();
    for (T& a : result.data_)
      a *= s;
    return result;
  }
  M operator*(const M& m) const
  {
    M result;
    for (std::size_t row = 0; row < N; ++row)
      for (std::size_t column = 0; column < N; ++column)
      {
        T sum = (*this)(row, 0) * m(0, column);
        for (std::size_t i = 1; i < N; ++i)
          sum += (*this)(row, i) * m(i, column);
        result(row, column) = sum;
      }
    return result;
  }
  bool Equal(const M& m, const T& tolerance) const
  {
    for (std::size_t i = 0; i < N * N; ++i)
      if (!equal<T>(data_[i], m.data_[i], tolerance))
        return false;
    return true;
  }
  bool operator==(const M& m) const { return Equal(m, static_cast<T>(1e-6)); }
  bool operator!=(const M& m) const { return !(*this == m); }
  M Transposed() const
  {
    M result;
    for (std::size_t row = 0; row < N; ++row)
      for (std::size_t column = 0; column < N; ++column)
        result(column, row) = (*this)(row, column);
    return result;
  }
  void Transpose()
  {
    for (std::size_t row = 0; row < N; ++row)
      for (std::size_t column = 0; column < row; ++column)
        std::swap((*this)(row, column), (*this)(column, row));
  }

  friend std::ostream& operator<<(std::ostream& out, const M& m)
  {
    for (std::size_t i = 0; i < N * N; ++i)
      out << (i > 0 ? " " : "") << precision(m.data_[i], 6u);
    return out;
  }
  friend std::istream& operator>>(std::istream& in, M& m)
  {
    in.setf(std::ios_base::skipws);
    M read;
    for (T& a : read.data_)
      in >> a;
    if (!in.fail())
      m = read;
    return in;
  }

protected:
  Grid() { data_.fill(T(0)); }

  std::array<T, N * N> data_;

private:
  const M& self() const { return static_cast<const M&>(*this); }
};

}  // namespace detail
}  // namespace v6
}  // namespace math
}  // namespace ignition
