#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"
#include "tests/core/tif/measured_tool.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::measured_tool;
using test::ProgramResult;
using test::SmallInputs;

/// The words of a plan with tool.csv and `more`.
std::vector<std::string> plan_with(std::vector<std::string> more) {
  more.insert(more.begin(), {"--tif", "tool.csv", "--tif-pixel", "0.25"});
  return SmallInputs::plan(more);
}

struct ToolInputs : SmallInputs {
  void write_tool(const HeightMap& rates) const {
    HeightMap square(Grid{rates.grid.rows, rates.grid.cols, 0.25, 0.25, rates.grid.origin}, rates.values);
    square.quantity = MapQuantity::Rate;
    write_map(*this / "tool.csv", square);
  }
};

HeightMap with_offset(double offset) {
  HeightMap rates = measured_tool();
  for (double& v : rates.values) v += offset;
  return rates;
}

TEST(ToolQuestions, RefuseByTheNamesOfTheOptions) {
  const ToolInputs inputs;
  HeightMap rates = measured_tool({1.1, 0.3});
  rates.at(24, 30) = std::nan("");
  for (double& v : rates.values) v += 0.4;
  inputs.write_tool(rates);
  const ProgramResult result = inputs.run(plan_with({}));
  EXPECT_EQ(result.exit_code, 2);
  for (const char* part :
       {"tool.csv", "row 25, column 31", "--tif-steps fill:harmonic", "--tif-pedestal subtract", "--tif-centre middle"})
    expect_has(result.err, part);
  EXPECT_FALSE(std::filesystem::exists(inputs / "plan"));
  const ProgramResult answered =
      inputs.run(plan_with({"--tif-steps", "fill:harmonic", "--tif-pedestal", "subtract", "--tif-centre", "centroid"}));
  ASSERT_EQ(answered.exit_code, 0) << answered.err;
  expect_has(answered.out, "centroid at (0, 0) mm");
  expect_has(answered.out, "--tif-centre centroid; rate at the rim 0 % of the peak, at most ");
  expect_has(answered.out, "; in the file, before its pedestal was mended, 9.");
  expect_has(answered.out, "taken off all samples");
  const json summary = json::parse(read_whole_file(inputs / "plan" / "summary.json"));
  EXPECT_NEAR(summary["tool"]["rim_share_of_peak"].get<double>(), 0.4 / 4.4, 0.002);
  EXPECT_NEAR(summary["tool"]["rim_share_of_peak_used"].get<double>(), 0.0, 1e-12);
  EXPECT_LT(summary["tool"]["rim_largest_share_of_peak_used"].get<double>(), 0.01);
  EXPECT_NEAR(summary["tool"]["peak_nm_per_s"].get<double>(), 4.0, 0.03);
  EXPECT_EQ(summary["tool"]["notes"].size(), 1U);
  EXPECT_EQ(summary["tif"]["history"].size(), 2U);
  EXPECT_EQ(summary["options"]["tif_pedestal"], "subtract");
}

TEST(ToolQuestions, SayWhatIsDoubtfulInTheTableAndEndWithZero) {
  const ToolInputs inputs;
  inputs.write_tool(with_offset(0.08));
  const ProgramResult result = inputs.run(plan_with({}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_has(result.out, "1.96 % of the peak, where it should remove nothing (--tif-pedestal)");
  inputs.write_tool(measured_tool());
  const ProgramResult sound = inputs.run(plan_with({"--json"}));
  ASSERT_EQ(sound.exit_code, 0) << sound.err;
  const json tool = json::parse(sound.out)["tool"];
  EXPECT_TRUE(tool["notes"].empty()) << tool;
  EXPECT_EQ(tool["axis_from"], "the middle of its grid");
}

TEST(ToolQuestions, RefuseAnAxisOffTheFileAndOptionsOfAFileForAFormula) {
  const SmallInputs inputs;
  const auto refused = [&inputs](const std::vector<std::string>& more, const std::vector<std::string>& parts) {
    const ProgramResult result = inputs.run(SmallInputs::plan(more));
    EXPECT_EQ(result.exit_code, 2) << more[1];
    for (const std::string& part : parts) expect_has(result.err, part);
  };
  refused({"--tif-centre", "100,100"}, {"--tif-centre 100,100", "tif.csv", "x from 0 to 6 mm"});
  refused({"--tif", "gaussian:peak=10,fwhm=2", "--tif-centre", "peak"}, {"--tif-centre peak", "formula gaussian"});
  refused({"--tif", "gaussian:peak=10,fwhm=2", "--tif-rows", "top"}, {"--tif-rows top", "formula gaussian"});
  const ProgramResult accepted = inputs.run(SmallInputs::plan({"--tif-centre", "3.1,3"}));
  EXPECT_EQ(accepted.exit_code, 0) << accepted.err;
}

TEST(ToolQuestions, SayThatAFileWithoutAUnitIsTakenAsNanometresASecond) {
  const SmallInputs inputs;
  const std::string note = "no unit in the file: taken as nm/s; --tif-unit states it";
  expect_has(inputs.run({"tif", "tif.csv", "--tif-pixel", "0.5"}).out, note);
  EXPECT_EQ(inputs.run({"tif", "tif.csv", "--tif-pixel", "0.5", "--tif-unit", "nm/s"}).out.find(note),
            std::string::npos);
  expect_has(inputs.run(SmallInputs::plan()).out, note);
}

TEST(ToolQuestions, AcceptAToolThatIsLargerThanThePart) {
  const ToolInputs inputs;
  const ProgramResult result = inputs.run(
      SmallInputs::plan({"--tif", "gaussian:peak=4,fwhm=9,radius=13", "--path", "raster:pitch=2,overrun=6"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_has(result.out, "the tool, 26 mm in diameter (FWHM 9 mm), is larger than the map of 15 x 11 mm both ways");
}

TEST(ToolQuestions, TheDirectionOfATrenchIsFitted) {
  const ToolInputs inputs;
  HeightMap after(Grid{90, 120, 0.2, 0.2, {-12.0, -9.0}});
  for (Index i = 0; i < after.grid.size(); ++i) {
    const Point p = after.grid.centre(i);
    const double across = -0.42262 * p.x + 0.90631 * p.y;  // along 25 degrees
    after.values[static_cast<std::size_t>(i)] = -80.0 * std::exp(-0.4 * across * across);
  }
  write_map(inputs / "trench.csv", after);
  const ProgramResult fitted = inputs.run({"tif", "--trench", "trench.csv", "--feed", "30", "--json"});
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  EXPECT_NEAR(json::parse(fitted.out)["trench"]["direction_deg"].get<double>(), 25.0, 0.05);
  const ProgramResult wrong = inputs.run({"tif", "--trench", "trench.csv", "--feed", "30", "--direction", "0"});
  EXPECT_EQ(wrong.exit_code, 2);
  for (const char* part : {"trench.csv", "--direction = 0 deg", "runs at 25", "at most"}) expect_has(wrong.err, part);
}

}  // namespace
}  // namespace dwell
