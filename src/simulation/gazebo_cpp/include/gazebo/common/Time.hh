#pragma once
#include <cstdint>
#include <ctime>
#include <iosfwd>
#include <string>
#include <sys/time.h>

#include <gazebo/util/system.hh>

namespace gazebo
{
namespace common
{

/// Seconds and nanoseconds, of one sign; what ros::Time is made from.
class GAZEBO_VISIBLE Time
{
public:
  static const Time Zero;
  static const Time Second;
  static const Time Hour;
  enum FormatOption
  {
    DAYS = 0,
    HOURS = 1,
    MINUTES = 2,
    SECONDS = 3,
    MILLISECONDS = 4
  };

  Time() = default;
  Time(const timeval& time);
  Time(const timespec& time);
  Time(int32_t seconds, int32_t nanoseconds);
  Time(double seconds);
  Time(const Time&) = default;

  static const Time& GetWallTime();
  static const std::string& GetWallTimeAsISOString();
  void SetToWallTime();
  double Double() const { return sec + nsec * 1e-9; }
  float Float() const { return static_cast<float>(Double()); }
  void Set(int32_t seconds, int32_t nanoseconds);
  void Set(double seconds);
  std::string FormattedString(FormatOption start = FormatOption::DAYS, FormatOption end = FormatOption::MILLISECONDS) const;
  static Time Sleep(const Time& time);  // wall time; returns what was slept
  static Time MSleep(unsigned int milliseconds);
  static Time NSleep(unsigned int nanoseconds);
  static double SecToNano(double seconds) { return seconds * 1e9; }
  static double MilToNano(double milliseconds) { return milliseconds * 1e6; }
  static double MicToNano(double microseconds) { return microseconds * 1e3; }

  Time& operator=(const Time&) = default;
  Time& operator=(const timeval& time) { return *this = Time(time); }
  Time& operator=(const timespec& time) { return *this = Time(time); }

#define GZ_TIME_ARITHMETIC(op)                                                              \
  Time operator op(const Time& other) const;                                                \
  const Time& operator op##=(const Time& other) { return *this = *this op other; }          \
  Time operator op(const timeval& other) const { return *this op Time(other); }             \
  Time operator op(const timespec& other) const { return *this op Time(other); }            \
  const Time& operator op##=(const timeval& other) { return *this = *this op Time(other); } \
  const Time& operator op##=(const timespec& other) { return *this = *this op Time(other); }
  GZ_TIME_ARITHMETIC(+)
  GZ_TIME_ARITHMETIC(-)
  GZ_TIME_ARITHMETIC(*)
  GZ_TIME_ARITHMETIC(/)
#undef GZ_TIME_ARITHMETIC

#define GZ_TIME_COMPARISON(op, expression)                                       \
  bool operator op(const Time& other) const { return expression; }               \
  bool operator op(const timeval& other) const { return *this op Time(other); }  \
  bool operator op(const timespec& other) const { return *this op Time(other); } \
  bool operator op(double other) const { return *this op Time(other); }
  GZ_TIME_COMPARISON(==, sec == other.sec && nsec == other.nsec)
  GZ_TIME_COMPARISON(!=, sec != other.sec || nsec != other.nsec)
  GZ_TIME_COMPARISON(<, sec < other.sec || (sec == other.sec && nsec < other.nsec))
  GZ_TIME_COMPARISON(>, sec > other.sec || (sec == other.sec && nsec > other.nsec))
  GZ_TIME_COMPARISON(<=, !(*this > other))
  GZ_TIME_COMPARISON(>=, !(*this < other))
#undef GZ_TIME_COMPARISON

  friend std::ostream& operator<<(std::ostream& out, const Time& time);
  friend std::istream& operator>>(std::istream& in, Time& time);

  int32_t sec = 0;
  int32_t nsec = 0;
  static const int32_t nsInSec = 1000000000;
  static const int32_t nsInMs = 1000000;
};

GAZEBO_VISIBLE std::ostream& operator<<(std::ostream& out, const Time& time);
GAZEBO_VISIBLE std::istream& operator>>(std::istream& in, Time& time);

}  // namespace common
}  // namespace gazebo
