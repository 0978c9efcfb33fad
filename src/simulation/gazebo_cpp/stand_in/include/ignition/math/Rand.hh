#pragma once
#include <cstdint>
#include <random>

#include <ignition/math/config.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

typedef std::mt19937 GeneratorType;

/// One generator for the whole process.
class IGNITION_MATH_VISIBLE Rand
{
public:
  static void Seed(unsigned int seed);
  static unsigned int Seed();
  static double DblUniform(double min = 0, double max = 1);
  static double DblNormal(double mean = 0, double sigma = 1);
  static std::int32_t IntUniform(int min, int max);
  static std::int32_t IntNormal(int mean, int sigma);
};

}  // namespace v6
}  // namespace math
}  // namespace ignition
