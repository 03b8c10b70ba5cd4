/// dwell plan --tool: several tools on one surface.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "tests/cli/documented_runs.h"
#include "tests/cli/json_documentation.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::names_in;
using test::ProgramResult;
using test::SmallInputs;
using test::with;
using test::Words;

/// A map with waves of which a small tool takes some, and two tools.
struct SeveralTools : SmallInputs {
  SeveralTools() {
    HeightMap waves(Grid{30, 40, 0.4, 0.4, {-8.0, -5.0}});
    for (Index i = 0; i < waves.grid.size(); ++i) {
      const Point p = waves.grid.centre(i);
      waves.values[static_cast<std::size_t>(i)] = 20.0 * std::sin(0.3 * p.x) * std::cos(0.25 * p.y + 0.4) +
                                                  4.0 * std::sin(1.4 * p.x + 0.2 * p.y) + 0.02 * p.x * p.x * p.y;
    }
    write_map(*this / "waves.npy", waves);
  }

  static Words plan(const Words& more = {}, const char* price = "0.001", const char* out = "tools") {
    return with({"plan", "--map", "waves.npy", "--time-price", price, "--threads", "1", "--out", out, "--tool",
                 "small;tif=gaussian:peak=4,fwhm=1.6,radius=2.5;path=raster:pitch=0.8,overrun=1;change-over=9s",
                 "--tool", "large;tif=gaussian:peak=10,fwhm=5,radius=7;path=raster:pitch=2,overrun=3,angle=90"},
                more);
  }
};

TEST(JointPlanCommand, WritesAPlanForEachToolAndSaysWhichPay) {
  const SeveralTools inputs;
  const ProgramResult result = inputs.run(SeveralTools::plan({"--accept", "rms<=10um"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in(inputs / "tools"), (std::set<std::string>{"1-large", "2-small", "tools.json"}));
  for (const char* text :
       {"* large + small", "large pays: without it ", "small pays: without it ", "runs      1-large: RMS ",
        "2-small: RMS ", "after all programs", "accept    rms ", "with 9.00 s of change-over", "written   tools\n"}) {
    expect_has(result.out, text);
  }
  for (const char* folder : {"tools/1-large", "tools/2-small"}) {
    const json summary = json::parse(read_whole_file(inputs / folder / "summary.json"));
    const ProgramResult simulated = inputs.run({"simulate", folder, "--json"});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    EXPECT_NEAR(json::parse(simulated.out)["program"]["residual_rms_nm"].get<double>(),
                summary["program"]["residual_rms_nm"].get<double>(), 1e-6);
  }
  const json tools = json::parse(read_whole_file(inputs / "tools/tools.json"));
  const json last = json::parse(read_whole_file(inputs / "tools/2-small/summary.json"));
  EXPECT_EQ(tools["runs"][1]["residual"]["rms_nm"], last["program"]["residual_rms_nm"]);
  EXPECT_EQ(tools["runs"][1]["before"]["rms_nm"], tools["runs"][0]["residual"]["rms_nm"]);
  // It may be moved, and holds its own plans alone.
  std::filesystem::rename(inputs / "tools", inputs / "moved");
  EXPECT_EQ(inputs.run({"simulate", "moved/2-small"}).exit_code, 0);
  std::filesystem::rename(inputs / "moved", inputs / "tools");
  EXPECT_EQ(inputs.run(SmallInputs::plan({"--out", "tools/3-other"})).exit_code, 2);
  EXPECT_EQ(inputs.run(SmallInputs::plan({"--out", "tools/2-small"})).exit_code, 2);
  // It replaces itself, and nothing else does.
  EXPECT_EQ(inputs.run(SeveralTools::plan({}, "total<=100")).exit_code, 0);
  EXPECT_EQ(inputs.run(SmallInputs::plan({"--out", "tools"})).exit_code, 2);
}

TEST(JointPlanCommand, PrintsTheJsonThatIsDocumented) {
  const SeveralTools inputs;
  const test::JsonDocumentation documentation(DWELL_SOURCE_DIR "/docs/json.md");
  ASSERT_TRUE(documentation.commands().contains("plan --tool"));
  test::expect_documented(inputs, "plan --tool", documentation.commands().at("plan --tool"),
                          {SeveralTools::plan({"--accept", "rms<=1pm, mid<=9nm"})});
}

TEST(JointPlanCommand, TakesItsToolsFromAJobFile) {
  const SeveralTools inputs;
  inputs.folder.file("job.toml",
                     "schema = 2\nmap = \"waves.npy\"\nthreads = 1\ntime_price_nm2_per_s = 0.001\nout = \"tools\"\n"
                     "[[tool]]\nname = \"small\"\ntif = \"gaussian:peak=4,fwhm=1.6,radius=2.5\"\n"
                     "path = \"raster:pitch=0.8,overrun=1\"\nchange_over = \"9s\"\n"
                     "[[tool]]\nname = \"large\"\ntif = \"gaussian:peak=10,fwhm=5,radius=7\"\n"
                     "path = \"raster:pitch=2,overrun=3,angle=90\"\n");
  ASSERT_EQ(inputs.run({"plan", "--job", "job.toml"}).exit_code, 0);
  const std::string of_job = read_whole_file(inputs / "tools/2-small/program.nc");
  ASSERT_EQ(inputs.run(SeveralTools::plan({}, "0.001", "other")).exit_code, 0);
  const std::string of_words = read_whole_file(inputs / "other/2-small/program.nc");
  EXPECT_EQ(of_job.substr(of_job.find("\nG")), of_words.substr(of_words.find("\nG")));
  for (const Words& words : {Words{"pareto", "--job", "job.toml", "--out", "p"},
                             Words{"paths", "--job", "job.toml", "--paths", "raster:pitch=2", "--out", "p"},
                             Words{"figure", "new", "run", "--job", "job.toml"}}) {
    const ProgramResult refused = inputs.run(words);
    EXPECT_EQ(refused.exit_code, 2) << words[0];
    expect_has(refused.err, "for one tool");
  }
}

TEST(JointPlanCommand, RefusesWithTheToolAndTheOption) {
  const SeveralTools inputs;
  const auto refused = [&](const Words& more, const Words& parts, const char* price = "0.001") {
    const ProgramResult result = inputs.run(SeveralTools::plan(more, price));
    EXPECT_EQ(result.exit_code, 2) << result.out;
    for (const std::string& part : parts) expect_has(result.err, part);
    EXPECT_FALSE(std::filesystem::exists(inputs / "tools"));
  };
  refused({"--tool", "small;tif=x"}, {"--tool", "'small' is given twice"});
  refused({"--tool", "third;path=raster:pitch=1"}, {"'third'", "tif: required", "--tif"});
  refused({"--tool", "third;tif=none.csv;path=raster:pitch=1"}, {"'third'", "none.csv"});
  refused({"--tool", "third;tif=gaussian:peak=1,fwhm=3,radius=4;path=raster:pitch=1;schedule=pvt"},
          {"'third'", "schedule"});
  refused({"--schedule", "pvt"}, {"--schedule"});
  refused({"--fraction", "0.8"}, {"--fraction = 0.8", "--tool"});
  refused({"--smoothness", "corner"}, {"--smoothness = corner", "--tool"});
  refused({"--tool", "third;tif=gaussian:peak=10,fwhm=5,radius=7;path=raster:pitch=2,overrun=3,angle=90"},
          {"'large' and 'third' are the same"});
  refused({"--tool", "third;tif=gaussian:peak=9,fwhm=5,radius=7;path=raster:pitch=2;price=2"},
          {"'third'", "price: 2", "total<=100"}, "total<=100");
  refused({"--certify", "1%"}, {"--certify", "--tool"});
  refused({"--solver", "fourier"}, {"--solver = fourier", "--tool"});
  refused({}, {"--time-price", "total<=1 s", "no set of tools fits"}, "total<=1");
}

}  // namespace
}  // namespace dwell
