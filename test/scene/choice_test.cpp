#include "cloth_sim/scene/choice.h"

#include <cmath>

#include "scene/scene_text.h"
#include "support.h"

namespace cloth
{
namespace
{

Choice some_choice()
{
  return { { "wind", "flex springs" }, "rk4", 1.25e-3, 1e-4, 7, 3e-5, 0.02 };
}

std::string text_of(const Choice& choice)
{
  YAML::Emitter emitter;
  write_choice(emitter, choice);
  return emitter.c_str();
}

std::string fault_of(const std::string& yaml)
{
  try
  {
    read_choice(YAML::Load(yaml));
  }
  catch (const SceneError& error)
  {
    return error.what();
  }
  return "none";
}

TEST(Choice, IsReadAsItWasWritten)
{
  const Choice choice = some_choice();
  const Choice read = read_choice(YAML::Load(text_of(choice)));
  EXPECT_EQ(read.method, choice.method);
  EXPECT_EQ(read.left_out, choice.left_out);
  EXPECT_EQ(read.time_step, choice.time_step);
  EXPECT_EQ(read.tolerance, choice.tolerance);
  EXPECT_EQ(read.iterations, choice.iterations);
  EXPECT_EQ(read.error, choice.error);
  EXPECT_EQ(read.cost, choice.cost);
}

TEST(Choice, IsFoundInASummary)
{
  EXPECT_EQ(read_choice(YAML::Load("{status: ok, choice: {method: rk4, time_step: 0.5}}")).time_step, 0.5);
}

TEST(Choice, WithoutEstimatesHasNone)
{
  Choice choice = some_choice();
  choice.error = choice.cost = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(text_of(choice).find("error"), std::string::npos);
  EXPECT_TRUE(std::isnan(read_choice(YAML::Load(text_of(choice))).error));
}

TEST(Choice, OfWhatThereIsNoneOfIsRefusedWithTheKey)
{
  EXPECT_TRUE(has(fault_of("{method: euler}"), { "choice.method is euler; allowed: one of ", "velocity_verlet" }));
  EXPECT_TRUE(
      has(fault_of("{method: rk4, left_out: [gravity]}"), { "choice.left_out is [gravity]; allowed: ", "wind" }));
  EXPECT_TRUE(has(fault_of("{method: rk4, time_step: -1}"), { "choice.time_step is -1; allowed: " }));
  EXPECT_TRUE(has(fault_of("{method: rk4, step: 1}"), { "choice.step is not a key" }));
  EXPECT_TRUE(has(fault_of("{time_step: 0}"), { "choice has no method; allowed: " }));
  EXPECT_TRUE(has(fault_of("[1]"), { "choice is [1]" }));
}

}  // namespace
}  // namespace cloth
