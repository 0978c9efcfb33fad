#pragma once
#include <string>

#include <gtest/gtest.h>

#include <ignition/math.hh>

// What an expression gives, against what Debian 12's libraries gave (numbers.txt): numbers to 1e-9, all else letter by letter.
// `NUMBERS_WRITE=FILE test_sdformat_debian` writes them anew.
#define CHECK(...) check(#__VA_ARGS__, say(__VA_ARGS__))

std::string say(double value);
std::string say(const std::string& value);
std::string say(const char* value);
std::string say(const ignition::math::Vector2d& v);
std::string say(const ignition::math::Vector3d& v);
std::string say(const ignition::math::Vector4d& v);
std::string say(const ignition::math::Quaterniond& q);
std::string say(const ignition::math::Pose3d& p);
std::string say(const ignition::math::Matrix3d& m);
std::string say(const ignition::math::Matrix4d& m);
std::string say(const ignition::math::Color& c);
std::string say(const ignition::math::Angle& a);

/// As it stands in a stream.
template <typename T>
std::string shown(const T& value)
{
  std::ostringstream out;
  out << value;
  return out.str();
}

template <typename T>
T read(const std::string& text)
{
  std::istringstream in(text);
  T value{};
  in >> value;
  return value;
}

void check(const std::string& expression, const std::string& value);
