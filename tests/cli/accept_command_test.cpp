/// --accept judges what a map is and what a program leaves, in every command by the same grammar.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;

const std::vector<std::string> kJudgedMap{"map", "map.csv", "--map-pixel", "0.5", "--accept"};

ProgramResult judge(const SmallInputs& inputs, std::vector<std::string> words, const std::string& limits) {
  words.push_back(limits);
  return inputs.run(words);
}

TEST(AcceptCommand, JudgesAMap) {
  const SmallInputs inputs;
  const ProgramResult good = judge(inputs, kJudgedMap, "rms<=1um, slope<=1mrad");
  EXPECT_EQ(good.exit_code, 0) << good.err;
  expect_has(good.out, "accept    rms               at most 1000 nm");
  expect_has(good.out, "to spare: passes");
  const ProgramResult bad = judge(inputs, kJudgedMap, "rms<=1um, pv<=1pm");
  EXPECT_EQ(bad.exit_code, 3);
  expect_has(bad.out, "too much: FAILS");
  expect_has(bad.err, "limit reached: accepted is pv<=0.001 nm, the surface has ");
  const ProgramResult wrong = judge(inputs, kJudgedMap, "rms<1");
  EXPECT_EQ(wrong.exit_code, 2);
  expect_has(wrong.err, "--accept: \"rms<1\"");
  expect_has(wrong.err, "QUANTITY<=NUMBER[UNIT]");
}

TEST(AcceptCommand, JudgesWhatTheProgramLeavesAndASimulationTheSame) {
  const SmallInputs inputs;
  const ProgramResult plan = inputs.run(SmallInputs::plan({"--accept", "rms<=1e-6, pv<=1mm, mid<=1mm, slope<=1mrad"}));
  ASSERT_EQ(plan.exit_code, 3) << plan.err;
  expect_has(plan.err, "limit reached: accepted is rms<=1e-06 nm");
  const json summary = json::parse(read_whole_file(inputs / "plan/summary.json"));
  const json& block = summary["acceptance"];
  EXPECT_EQ(block["passes"], false);
  ASSERT_EQ(block["limits"].size(), 4U);
  const double left = summary["program"]["residual_rms_nm"];
  EXPECT_EQ(block["limits"][0]["value"], left);
  EXPECT_EQ(block["limits"][0]["passes"], false);
  EXPECT_EQ(block["limits"][1]["value"], summary["program"]["residual_pv_nm"]);
  EXPECT_EQ(block["limits"][2]["wavelengths_mm"][1], summary["surface"]["after"]["bands"][1]["longest_mm"]);
  EXPECT_NEAR(block["limits"][2]["value"].get<double>(),
              summary["surface"]["after"]["bands"][1]["rms_nm"].get<double>(), 1e-9 * left);
  EXPECT_EQ(block["limits"][3]["value"], summary["surface"]["after"]["slope_rms_urad"]["total"]);

  const ProgramResult simulated = inputs.run({"simulate", "plan", "--json"});
  EXPECT_EQ(simulated.exit_code, 3);
  const json again = json::parse(simulated.out)["acceptance"];
  ASSERT_EQ(again["limits"].size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(again["limits"][k]["value"].get<double>(), block["limits"][k]["value"].get<double>(), 1e-6 * left);
    EXPECT_EQ(again["limits"][k]["passes"], block["limits"][k]["passes"]);
  }
  const ProgramResult none = inputs.run({"simulate", "plan", "--accept", "none", "--json"});
  EXPECT_EQ(none.exit_code, 0) << none.err;
  EXPECT_FALSE(json::parse(none.out).contains("acceptance"));
  EXPECT_EQ(inputs.run({"simulate", "plan", "--accept", "rms<=1mm"}).exit_code, 0);
}

TEST(AcceptCommand, RefusesWrongTextBeforeThePlan) {
  const SmallInputs inputs;
  const ProgramResult wrong = inputs.run(SmallInputs::plan({"--accept", "rms<=1, rms<=2", "--out", "none"}));
  EXPECT_EQ(wrong.exit_code, 2);
  expect_has(wrong.err, "--accept: ");
  expect_has(wrong.err, "limited twice");
  EXPECT_FALSE(std::filesystem::exists(inputs / "none"));
}

}  // namespace
}  // namespace dwell
