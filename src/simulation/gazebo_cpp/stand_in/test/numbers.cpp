#include "numbers.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>

using namespace ignition::math;

namespace
{

std::string all(std::initializer_list<double> values)
{
  std::string text;
  for (const double each : values)
    text += (text.empty() ? "" : " ") + say(each);
  return text;
}

std::string escaped(const std::string& text)
{
  std::string result;
  for (const char each : text)
    result += each == '\n' ? std::string("\\n") : std::string(1, each);
  return result;
}

bool same(const std::string& expected, const std::string& value)
{
  std::istringstream left(expected), right(value);
  std::string a, b;
  while (left >> a)
  {
    if (!(right >> b))
      return false;
    char *end_a = nullptr, *end_b = nullptr;
    const double x = std::strtod(a.c_str(), &end_a), y = std::strtod(b.c_str(), &end_b);
    const bool numbers = *end_a == '\0' && *end_b == '\0';
    const bool near = x == y || (std::isnan(x) && std::isnan(y)) || std::abs(x - y) <= 1e-9 * std::max(1.0, std::abs(x));
    if (numbers ? !near : a != b)
      return false;
  }
  return !(right >> b);
}

const std::map<std::string, std::string>& expected()
{
  static const std::map<std::string, std::string> lines = [] {
    std::map<std::string, std::string> found;
    std::ifstream in(NUMBERS);
    for (std::string name, value; std::getline(in, name) && std::getline(in, value);)
      found[name] = value.substr(2);
    return found;
  }();
  return lines;
}

}  // namespace

std::string say(double value)
{
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return std::isnan(value) ? "nan" : text;
}
std::string say(const std::string& value) { return "'" + escaped(value) + "'"; }
std::string say(const char* value) { return say(std::string(value)); }
std::string say(const Vector2d& v) { return all({ v.X(), v.Y() }); }
std::string say(const Vector3d& v) { return all({ v.X(), v.Y(), v.Z() }); }
std::string say(const Vector4d& v) { return all({ v.X(), v.Y(), v.Z(), v.W() }); }
std::string say(const Quaterniond& q) { return all({ q.W(), q.X(), q.Y(), q.Z() }); }
std::string say(const Pose3d& p) { return say(p.Pos()) + " " + say(p.Rot()); }
std::string say(const Color& c) { return all({ c.R(), c.G(), c.B(), c.A() }); }
std::string say(const Angle& a) { return say(a.Radian()); }
std::string say(const Matrix3d& m)
{
  return all({ m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2) });
}
std::string say(const Matrix4d& m)
{
  std::string text;
  for (unsigned int row = 0; row < 4; ++row)
    text += (row > 0 ? " " : "") + all({ m(row, 0), m(row, 1), m(row, 2), m(row, 3) });
  return text;
}

void check(const std::string& expression, const std::string& value)
{
  static std::map<std::string, int> times;
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test.name()) + ": " + expression;
  if (const int before = times[name]++)
    name += " (" + std::to_string(before + 1) + ")";
  if (const char* const file = std::getenv("NUMBERS_WRITE"))
  {
    std::ofstream(file, std::ios::app) << name << "\n  " << value << "\n";
    return;
  }
  const auto found = expected().find(name);
  ASSERT_NE(found, expected().end()) << name << " is not in " << NUMBERS;
  EXPECT_TRUE(same(found->second, value)) << name << "\n  is        " << value << "\n  should be " << found->second;
}
