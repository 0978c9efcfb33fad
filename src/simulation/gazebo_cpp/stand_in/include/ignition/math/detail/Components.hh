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

/// What vectors of two, three and four numbers have in common; V is the vector.
template <class V, typename T, std::size_t N>
class Components
{
public:
  T Sum() const
  {
    T sum = data_[0];
    for (std::size_t i = 1; i < N; ++i)
      sum += data_[i];
    return sum;
  }
  T SquaredLength() const { return self().Dot(self()); }
  T Length() const { return static_cast<T>(std::sqrt(SquaredLength())); }
  T Dot(const V& v) const
  {
    T sum = data_[0] * v.data_[0];
    for (std::size_t i = 1; i < N; ++i)
      sum += data_[i] * v.data_[i];
    return sum;
  }
  T AbsDot(const V& v) const
  {
    T sum = 0;
    for (std::size_t i = 0; i < N; ++i)
      sum += std::abs(data_[i] * v.data_[i]);
    return sum;
  }
  V Abs() const
  {
    return each([](T a) { return static_cast<T>(std::abs(a)); });
  }
  V Rounded() const
  {
    return each([](T a) { return static_cast<T>(std::nearbyint(a)); });
  }
  /// A vector without length stays as it is.
  V Normalized() const
  {
    V result = self();
    const T length = Length();
    if (!equal<T>(length, 0, static_cast<T>(1e-6)))
      result /= length;
    return result;
  }
  void Max(const V& v)
  {
    for (std::size_t i = 0; i < N; ++i)
      data_[i] = std::max(data_[i], v.data_[i]);
  }
  void Min(const V& v)
  {
    for (std::size_t i = 0; i < N; ++i)
      data_[i] = std::min(data_[i], v.data_[i]);
  }
  T Max() const { return *std::max_element(data_.begin(), data_.end()); }
  T Min() const { return *std::min_element(data_.begin(), data_.end()); }
  bool IsFinite() const
  {
    return std::all_of(data_.begin(), data_.end(), [](T a) { return std::isfinite(static_cast<double>(a)); });
  }
  /// Numbers that are none become 0.
  void Correct()
  {
    for (T& a : data_)
      if (!std::isfinite(static_cast<double>(a)))
        a = 0;
  }
  bool Equal(const V& v, const T& tolerance) const
  {
    for (std::size_t i = 0; i < N; ++i)
      if (!equal<T>(data_[i], v.data_[i], tolerance))
        return false;
    return true;
  }
  /// Beyond the end is the last one.
  T& operator[](std::size_t index) { return data_[std::min(index, N - 1)]; }
  T operator[](std::size_t index) const { return data_[std::min(index, N - 1)]; }
  bool operator<(const V& v) const
  {
    for (std::size_t i = 0; i < N; ++i)
      if (data_[i] < v.data_[i])
        return true;
    return false;
  }

  V operator-() const
  {
    return each([](T a) { return -a; });
  }
#define NOETIC_COMPONENTS_OPERATOR(sign)                        \
  const V& operator sign##=(const V& v)                         \
  {                                                             \
    for (std::size_t i = 0; i < N; ++i)                         \
      data_[i] sign## = v.data_[i];                             \
    return self();                                              \
  }                                                             \
  const V& operator sign##=(T s)                                \
  {                                                             \
    for (T & a : data_)                                         \
      a sign## = s;                                             \
    return self();                                              \
  }                                                             \
  V operator sign(const V& v) const                             \
  {                                                             \
    V result = self();                                          \
    result sign## = v;                                          \
    return result;                                              \
  }                                                             \
  V operator sign(T s) const                                    \
  {                                                             \
    return each([s](T a) { return static_cast<T>(a sign s); }); \
  }
  NOETIC_COMPONENTS_OPERATOR(+)
  NOETIC_COMPONENTS_OPERATOR(-)
  NOETIC_COMPONENTS_OPERATOR(*)
  NOETIC_COMPONENTS_OPERATOR(/)
#undef NOETIC_COMPONENTS_OPERATOR
  friend V operator+(T s, const V& v) { return v + s; }
  friend V operator*(T s, const V& v) { return v * s; }
  friend V operator-(T s, const V& v) { return -v + s; }

  friend std::ostream& operator<<(std::ostream& out, const V& v)
  {
    for (std::size_t i = 0; i < N; ++i)
    {
      if (i > 0)
        out << " ";
      out << (N == 3 ? precision(v.data_[i], 6u) : v.data_[i]);  // only those of three are rounded in text
    }
    return out;
  }
  friend std::istream& operator>>(std::istream& in, V& v)
  {
    in.setf(std::ios_base::skipws);
    V read;
    for (T& a : read.data_)
      in >> a;
    if (!in.fail())
      v = read;
    return in;
  }

protected:
  Components() { data_.fill(T(0)); }

  template <typename F>
  V each(F change) const
  {
    V result;
    for (std::size_t i = 0; i < N; ++i)
      result.data_[i] = change(data_[i]);
    return result;
  }
  void fill(T value) { data_.fill(value); }

  std::array<T, N> data_;

private:
  const V& self() const { return static_cast<const V&>(*this); }
};

}  // namespace detail
}  // namespace v6
}  // namespace math
}  // namespace ignition
