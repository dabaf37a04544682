#include "cloth_sim/scene/yaml_text.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <regex>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

std::uint64_t bits_of(double value)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// Doubles of every size, drawn by their bits, and the special ones.
std::vector<double> doubles()
{
  using Limits = std::numeric_limits<double>;
  std::vector<double> values{ 0.0,
                              -0.0,
                              1.0,
                              -1.0,
                              10.0,
                              0.1,
                              1.0 / 3.0,
                              1e-3,
                              1e-5,
                              1e5,
                              1e15,
                              1e16,
                              1e17,
                              1e21,
                              1e22,
                              123456789.0,
                              0.30000000000000004,
                              Limits::min(),
                              Limits::max(),
                              Limits::lowest(),
                              Limits::denorm_min(),
                              -Limits::denorm_min(),
                              Limits::epsilon() };
  std::mt19937_64 generator(7);
  while (values.size() < 20000)
  {
    const std::uint64_t bits = generator();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value))
    {
      values.push_back(value);
    }
    values.push_back(std::ldexp(static_cast<double>(bits >> 11), static_cast<int>(bits % 60) - 80));
  }
  return values;
}

TEST(FormatNumber, ReadsBackTheSameToTheLastBit)
{
  for (const double value : doubles())
  {
    const std::string text = format_number(value);
    EXPECT_EQ(bits_of(std::strtod(text.c_str(), nullptr)), bits_of(value)) << text;
    EXPECT_EQ(bits_of(YAML::Load(text).as<double>()), bits_of(value)) << text;
  }
}

TEST(FormatNumber, IsAFloatToEveryYamlReader)
{
  // YAML 1.1 as most readers resolve it: without point or exponent sign it would be an integer or text.
  const std::regex yaml_float("[-+]?[0-9]+\\.[0-9]+([eE][-+][0-9]+)?");
  for (const double value : doubles())
  {
    const std::string text = format_number(value);
    EXPECT_TRUE(std::regex_match(text, yaml_float)) << text;
  }
}

TEST(FormatNumber, IsTheShortestForm)
{
  EXPECT_EQ(format_number(1e-5), "1.0e-05");
  EXPECT_EQ(format_number(-2.5e300), "-2.5e+300");
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(-9.81), "-9.81");
  EXPECT_EQ(format_number(30.0), "30.0");
  EXPECT_EQ(format_number(-0.0), "-0.0");
}

TEST(FormatNumber, WritesWhatIsNotFiniteAsYamlDoes)
{
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(format_number(infinity), ".inf");
  EXPECT_EQ(format_number(-infinity), "-.inf");
  EXPECT_EQ(format_number(std::nan("")), ".nan");
  EXPECT_EQ(YAML::Load(".inf").as<double>(), infinity);
  EXPECT_TRUE(std::isnan(YAML::Load(".nan").as<double>()));
}

TEST(Shown, PutsAValueOnOneLine)
{
  EXPECT_EQ(shown(YAML::Load("a:\n  - 1\n  - {b: [2, 3]}\n")), "{a: [1, {b: [2, 3]}]}");
  EXPECT_EQ(shown(YAML::Load("heavy")), "heavy");
  EXPECT_EQ(shown(YAML::Load("")), "~");
  EXPECT_EQ(shown(YAML::Load("''")), "\"\"");
  EXPECT_EQ(shown(YAML::Load("\"two\\nlines\"")).find('\n'), std::string::npos);
}

TEST(Shown, CutsWhatIsVeryLong)
{
  EXPECT_EQ(shown(YAML::Node(std::string(80, 'x'))), std::string(80, 'x'));
  EXPECT_EQ(shown(YAML::Node(std::string(81, 'x'))), std::string(80, 'x') + "...");
}

TEST(Joined, PutsTheSeparatorBetweenWordsOnly)
{
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({ "a" }), "a");
  EXPECT_EQ(joined({ "a", "a", "b" }), "a, a, b");
  EXPECT_EQ(joined({ "a", "b" }, "\n"), "a\nb");
}

}  // namespace
}  // namespace cloth
