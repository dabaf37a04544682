#include "draw.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace cloth
{
namespace
{

/// Of the 64 bits of the engine those that a double has room for.
constexpr int bits_beyond_a_double = 11;

/// splitmix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014): neighbouring numbers
/// become seeds that have nothing in common.
std::uint64_t mixed(std::uint64_t number)
{
  number += 0x9e3779b97f4a7c15U;
  number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
  number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
  return number ^ (number >> 31U);
}

/// Logarithms may differ in their last bit from one machine to another: three digits hide it.
double to_three_digits(double number)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", number);
  return std::strtod(text, nullptr);
}

}  // namespace

Draw::Draw(std::uint64_t seed, std::uint64_t number, std::uint64_t attempt)
  : engine_(mixed(mixed(mixed(seed) + number) + attempt))
{
}

double Draw::part()
{
  return std::ldexp(static_cast<double>(engine_() >> bits_beyond_a_double), -53);
}

int Draw::whole(int low, int high)
{
  return low + static_cast<int>(part() * (high - low + 1));
}

bool Draw::once_in(int chances, int of)
{
  return whole(1, of) <= chances;
}

double Draw::even(double low, double high)
{
  return std::clamp(to_three_digits(low + part() * (high - low)), low, high);
}

double Draw::logarithmic(double low, double high)
{
  return std::clamp(to_three_digits(low * std::exp(part() * std::log(high / low))), low, high);
}

}  // namespace cloth
