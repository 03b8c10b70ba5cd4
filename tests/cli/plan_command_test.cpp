#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

#include "core/base/whole_file.h"
#include "runs/programs/program_formats.h"
#include "runs/reports/plan_files.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::names_in;
using test::ProgramResult;
using test::SmallInputs;

json summary_of(const SmallInputs& inputs) { return json::parse(read_whole_file(inputs / "plan/summary.json")); }

std::set<std::string> figures_without_machine() {
  std::set<std::string> figures(plan_files().figures.begin(), plan_files().figures.end());
  figures.erase("limits");
  figures.erase("motion");
  figures.erase("uncertainty");
  return figures;
}

TEST(PlanCommand, WritesEveryFileAndPrintsWhatItDid) {
  const SmallInputs inputs;
  const ProgramResult result = inputs.run(SmallInputs::plan());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> files{std::string(plan_files().always)};
  files.insert(plan_files().others.begin(), plan_files().others.end());
  EXPECT_EQ(files.erase("search.csv"), 1u) << "of plans whose weights were searched";
  for (const ProgramFormat& format : program_formats()) {
    if (!format.word.empty()) files.erase(format.file);  // of plans with --export
  }
  for (const char* file : {"learnt.csv", "learnt_removal.npy", "learnt_removal.npy.json"}) files.erase(file);  // --log
  for (const char* file : {"remaining.npy", "remaining.npy.json"}) files.erase(file);  // --resume
  for (const char* file : {"surface.npy", "surface.npy.json"}) files.erase(file);      // --tool
  files.erase("program_parts.csv");                                                    // --max-lines
  for (const std::string& figure : figures_without_machine()) files.insert(figure + ".png");
  EXPECT_EQ(names_in(inputs / "plan"), files);
  for (const char* name : {"summary.json", "feed.csv", "program.nc"}) EXPECT_TRUE(files.contains(name)) << name;
  EXPECT_EQ(names_in(inputs.folder.path()), (std::set<std::string>{"map.csv", "tif.csv", "plan"}));
  for (const char* line : {"map ", "before ", "tool ", "path ", "solver ", "dwell ", "feed ", "predicted ", "program ",
                           "written   plan\n"}) {
    expect_has(result.out, line);
  }
  for (const char* unit : {" nm", " mm", " s", " nm/s", " mm/min"}) expect_has(result.out, unit);
  EXPECT_EQ(read_whole_file(inputs / "plan/before.png").substr(1, 3), "PNG");
}

TEST(PlanCommand, SaysWhatItsProgramMayLeave) {
  const SmallInputs inputs;
  const test::Words unsure{"--uncertainty", "tif-rate=5%,position=50um,metrology=0.1nm,samples=20,seed=4"};
  const ProgramResult result = inputs.run(SmallInputs::plan(unsure));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_has(result.out, "uncertain tif-rate=5%,position=0.05mm,metrology=0.1nm, 20 samples, seed 4\n");
  expect_has(result.out, "each alone adds, in squares: tif-rate ");
  EXPECT_TRUE(names_in(inputs / "plan").contains("uncertainty.png"));
  const json summary = summary_of(inputs);
  const json& rms = summary["uncertainty"]["rms_nm"];
  EXPECT_NEAR(rms["nominal"].get<double>(), summary["program"]["residual_rms_nm"].get<double>(),
              1e-6 * rms["nominal"].get<double>());
  EXPECT_LE(rms["p5"], rms["median"]);
  EXPECT_LE(rms["median"], rms["p95"]);
  EXPECT_EQ(inputs.run(SmallInputs::plan(unsure)).exit_code, 0);
  EXPECT_EQ(summary_of(inputs)["uncertainty"], summary["uncertainty"]);
  const ProgramResult drifts = inputs.run(SmallInputs::plan({"--uncertainty", "drift=2%"}));
  EXPECT_EQ(drifts.exit_code, 2);
  expect_has(drifts.err, "--uncertainty");
  expect_has(drifts.err, "from run to run");
}

TEST(PlanCommand, ShowsBothPitchesOfPixelsThatAreNotSquare) {
  const SmallInputs inputs;
  const ProgramResult result = inputs.run(SmallInputs::plan({"--map-pixel", "0.5,0.4", "--tif-pixel", "0.5,0.625"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_has(result.out, "22 rows x 30 columns of 0.5 x 0.4 mm");
  const json summary = summary_of(inputs);
  EXPECT_EQ(summary["map"]["pixel_mm"], json({0.5, 0.4}));
  EXPECT_EQ(summary["options"]["map_pixel_mm"], "0.5,0.4");
  const ProgramResult simulated = inputs.run({"simulate", "plan", "--json"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  EXPECT_EQ(json::parse(simulated.out)["map"]["pixel_mm"], json({0.5, 0.4}));
  expect_has(inputs.run({"simulate", "plan"}).out, "of 0.5 x 0.4 mm");
  const ProgramResult map = inputs.run({"map", "map.csv", "--map-pixel", "0.5,0.4"});
  expect_has(map.out, "0.5 mm in x, 0.4 mm in y");
  const ProgramResult tif = inputs.run({"tif", "tif.csv", "--tif-pixel", "0.5,0.625"});
  expect_has(tif.out, "pitch 0.5 x 0.625 mm");
}

TEST(PlanCommand, SaysWhatAPartialCorrectionAimsAt) {
  const SmallInputs inputs;
  const ProgramResult result = inputs.run(SmallInputs::plan({"--fraction", "0.8"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json summary = summary_of(inputs);
  const double before = summary["map"]["rms_nm"], left = summary["program"]["residual_rms_nm"];
  EXPECT_NEAR(left, 0.2 * before, 0.1 * before);
  expect_has(result.out, "aim       80 % of the error: RMS ");
  const ProgramResult simulated = inputs.run({"simulate", "plan", "--json"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  EXPECT_NEAR(json::parse(simulated.out)["program"]["residual_rms_nm"].get<double>(), left, 1e-9 * before);
  for (const char* wrong : {"0", "-0.5", "1.0001", "80", "nan"}) {
    const ProgramResult refused = inputs.run(SmallInputs::plan({"--fraction", wrong}));
    EXPECT_EQ(refused.exit_code, 2);
    expect_has(refused.err, std::string("--fraction: '") + wrong + "'; required a number from 0.01 to 1");
  }
  EXPECT_EQ(inputs.run({"simulate", "plan", "--fraction", "0.5"}).exit_code, 2) << "has no say in what is removed";
}

// n-fold by hand: a wave of 500 nm is 250 nm of height on a mirror.
TEST(PlanCommand, ReadsWavesWithWavelengthAndScale) {
  const SmallInputs inputs;
  inputs.folder.file("opd.csv", "1,2,4\n3,5,9\n");
  const std::vector<std::string> map{"map", "opd.csv", "--map-pixel", "0.5", "--remove", "none", "--write", "nm.csv"};
  const auto refused = [&](const std::vector<std::string>& more, std::initializer_list<const char*> words) {
    const ProgramResult result = inputs.run(test::with(map, more));
    EXPECT_EQ(result.exit_code, 2) << result.out;
    for (const char* word : words) expect_has(result.err, word);
  };
  refused({}, {"opd.csv", "path difference", "give --wave-scale", "0.5 for a mirror"});
  refused({"--map-unit", "waves", "--wave-scale", "0.5"}, {"opd.csv", "--map-unit says waves", "--wavelength [nm]"});
  refused({"--map-unit", "waves", "--wave-scale", "0.5", "--wavelength", "0.6328"},
          {"--wavelength: '0.6328'", "from 100 to 20000 (nm)"});
  refused({"--wave-scale", "0"}, {"--wave-scale: '0'", "from 0.01 to 100"});
  refused({"--wave-scale", "0.5", "--wavelength", "632.8"}, {"--wavelength is 632.8 nm", "not in waves"});
  refused({"--map-unit", "radians"}, {"--map-unit: 'radians'", "nm, um, mm, m, waves"});
  const ProgramResult read =
      inputs.run(test::with(map, {"--map-unit", "waves", "--wavelength", "500", "--wave-scale", "0.5"}));
  ASSERT_EQ(read.exit_code, 0) << read.err;
  expect_has(read.out, "made      wave scale 0.5: the values were waves of 500 nm");
  expect_has(read_whole_file(inputs / "nm.csv"), "750,1250,2250");
  EXPECT_EQ(inputs.run({"map", "nm.csv"}).exit_code, 0);
  const ProgramResult plan = inputs.run(
      SmallInputs::plan({"--map-unit", "waves", "--wavelength", "500", "--wave-scale", "0.5", "--map-max-pv", "100"}));
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  const json options = summary_of(inputs)["options"];
  EXPECT_EQ(options["wavelength_nm"], "500");
  EXPECT_EQ(options["wave_scale"], "0.5");
  EXPECT_EQ(inputs.run({"simulate", "plan"}).exit_code, 0);
  const ProgramResult alone = inputs.run({"simulate", "--program", "plan/program.nc", "--map", "map.csv", "--map-pixel",
                                          "0.5", "--tif", "tif.csv", "--tif-pixel", "0.5"});
  expect_has(alone.out, "--wave-scale is not given, but was 0.5 when the program was made");
}

TEST(PlanCommand, WritesFiguresInTheFormatsAskedForAndReplacesThem) {
  const SmallInputs inputs;
  std::vector<std::string> vectors = SmallInputs::plan();
  for (const char* word : {"--figures", "svg,pdf", "--figure-range", "own"}) vectors.push_back(word);
  const ProgramResult result = inputs.run(vectors);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::set<std::string> names = names_in(inputs / "plan");
  for (const std::string& name : figures_without_machine()) {
    EXPECT_TRUE(names.contains(name + ".svg") && names.contains(name + ".pdf")) << name;
    EXPECT_FALSE(names.contains(name + ".png")) << name;
  }
  const std::string svg = read_whole_file(inputs / "plan/before.svg");
  for (const char* words : {"Before: RMS", "x [mm]", ">nm<"}) expect_has(svg, words);
  EXPECT_EQ(read_whole_file(inputs / "plan/dwell.pdf").substr(0, 5), "%PDF-");
  EXPECT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0) << "an earlier plan with figures of another format";
  EXPECT_FALSE(names_in(inputs / "plan").contains("before.svg"));
}

TEST(PlanCommand, SummaryHasEveryDocumentedKeyWithItsType) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  const json s = summary_of(inputs);
  EXPECT_EQ(s.at("schema"), 2);
  const auto of_type = [&s](const char* path, auto is_type) {
    const json::json_pointer pointer(path);
    ASSERT_TRUE(s.contains(pointer)) << path;
    EXPECT_TRUE(is_type(s[pointer])) << path << " is " << s[pointer].dump();
  };
  for (const char* path : {"/map/file", "/tif/kind", "/path/kind", "/solve/solver", "/solve/status",
                           "/residual/removed", "/program/file", "/version", "/inputs/0/file", "/inputs/0/sha256"}) {
    of_type(path, [](const json& j) { return j.is_string() && !j.get<std::string>().empty(); });
  }
  for (const char* path : {"/map/rows", "/map/columns", "/map/valid_pixels", "/path/points", "/solve/iterations",
                           "/solve/operator_applications", "/feed/segments_limited"}) {
    of_type(path, [](const json& j) { return j.is_number_integer() && j >= 0; });
  }
  for (const char* path : {"/map/pixel_mm/0",
                           "/map/pixel_mm/1",
                           "/map/pv_nm",
                           "/map/rms_nm",
                           "/tif/peak_nm_per_s",
                           "/tif/volume_nm_mm2_per_s",
                           "/tif/radius_mm",
                           "/path/length_mm",
                           "/solve/wall_s",
                           "/dwell/total_s",
                           "/dwell/min_s",
                           "/dwell/max_s",
                           "/dwell/step_rms_s",
                           "/residual/rms_nm",
                           "/residual/pv_nm",
                           "/feed/min_mm_per_min",
                           "/feed/max_mm_per_min",
                           "/program/total_s",
                           "/program/residual_rms_nm",
                           "/solve/certificate/projected_gradient_relative"}) {
    of_type(path, [](const json& j) { return j.is_number() && j >= 0; });
  }
  for (const char* path : {"/options", "/solve/certificate"})
    of_type(path, [](const json& j) { return j.is_object(); });
  EXPECT_EQ(s["map"]["rows"], 22);
  EXPECT_EQ(s["map"]["columns"], 30);
  EXPECT_EQ(s["inputs"].size(), 2u);
  EXPECT_EQ(s["inputs"][0]["sha256"], sha256_of_file(inputs / "map.csv"));
  EXPECT_EQ(s["options"]["path"], "raster:pitch=1,overrun=2");
  EXPECT_LT(s["residual"]["rms_nm"], s["map"]["rms_nm"]);
}

TEST(PlanCommand, JsonPrintsTheSummaryAndNothingElse) {
  const SmallInputs inputs;
  const ProgramResult result = inputs.run(SmallInputs::plan({"--json"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, read_whole_file(inputs / "plan/summary.json"));
}

TEST(PlanCommand, CommandLineComesOverTheJobFile) {
  const SmallInputs inputs;
  inputs.folder.file("job.toml",
                     "map = 'map.csv'\nmap_pixel_mm = 0.5\ntif = 'tif.csv'\ntif_pixel_mm = 0.5\nthreads = 1\n"
                     "path = 'raster:pitch=1,overrun=2'\nmin_dwell_s = 0.01\nsmoothness = 1.5\nout = 'plan'\n");
  ASSERT_EQ(inputs.run({"plan", "--job", "job.toml", "--min-dwell", "0.03"}).exit_code, 0);
  const json s = summary_of(inputs);
  EXPECT_EQ(s["options"]["min_dwell_s"], "0.03");
  EXPECT_EQ(s["options"]["smoothness"], "1.5");
  EXPECT_GE(s["dwell"]["min_s"], 0.03);
}

TEST(PlanCommand, FindsTheWeightThatMeetsATargetAndSaysWhich) {
  const SmallInputs inputs;
  const ProgramResult usual = inputs.run(SmallInputs::plan({"--time-price", "auto"}));
  ASSERT_EQ(usual.exit_code, 0);
  const json own = summary_of(inputs)["weights"];
  EXPECT_EQ(own["smoothness_from"], "auto");
  EXPECT_EQ(own["time_price_from"], "auto");
  EXPECT_EQ(own["worth"]["rule"], "share");
  expect_has(usual.out, " (auto), time price ");
  expect_has(usual.out, "one per cent more time would lower the mean square left by 0.3 %");
  expect_has(usual.out, "the least that this tool leaves on this path at this smoothness is about ");
  // What the estimates compare with is the plan itself.
  const json estimates = own["worth"]["estimates"], of_plan = summary_of(inputs);
  const double left = of_plan["residual"]["rms_nm"], total = of_plan["dwell"]["total_s"];
  EXPECT_LE(estimates["half_price"]["residual_rms_nm"], left);
  EXPECT_GE(estimates["half_price"]["total_s"], total);
  EXPECT_GE(estimates["twice_price"]["residual_rms_nm"], left);
  EXPECT_LE(estimates["twice_price"]["total_s"], total);
  EXPECT_LE(estimates["least_rms_nm"], left);
  expect_has(usual.out, "optimum   this plan's objective is at most ");
  const double limit = 0.9 * summary_of(inputs)["dwell"]["total_s"].get<double>();
  const ProgramResult result =
      inputs.run(SmallInputs::plan({"--time-price", "total <= " + std::to_string(limit) + " s"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_has(result.out, "weights   smoothness ");
  expect_has(result.out, " (auto), time price ");
  expect_has(result.out, "nm^2/s (target), chosen from ");
  const json s = summary_of(inputs);
  EXPECT_LE(s["dwell"]["total_s"], limit);
  EXPECT_GT(s["weights"]["time_price_nm2_per_s"], 0.0);
  EXPECT_TRUE(names_in(inputs / "plan").contains("search.csv"));
  // Of another smoothness than the price was found with, the estimates would say nothing of this plan.
  const ProgramResult smooth = inputs.run(SmallInputs::plan({"--smoothness", "step<=0.05", "--time-price", "auto"}));
  ASSERT_EQ(smooth.exit_code, 0) << smooth.err;
  expect_has(smooth.out, "found with the smoothness ");
  EXPECT_EQ(smooth.out.find("half of it"), std::string::npos);
  EXPECT_EQ(smooth.out.find("cost      "), std::string::npos);
  EXPECT_FALSE(summary_of(inputs)["weights"]["worth"].contains("estimates"));
  // The next plan replaces this one whole, and has no search.
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  EXPECT_FALSE(names_in(inputs / "plan").contains("search.csv"));
}

TEST(PlanCommand, GoesOnUntilTheOptimumIsProvenOrSaysThatItIsNot) {
  const SmallInputs inputs;
  const ProgramResult proven = inputs.run(SmallInputs::plan({"--time-price", "auto", "--certify", "0.1%"}));
  ASSERT_EQ(proven.exit_code, 0) << proven.err;
  const json certificate = summary_of(inputs)["solve"]["certificate"];
  EXPECT_LE(certificate["gap_relative"], 0.001);
  EXPECT_EQ(summary_of(inputs)["options"]["certify"], "0.1%");
  // At a price of 0 the optimum is not determined, and nothing is proven.
  const ProgramResult rough = inputs.run(SmallInputs::plan({"--smoothness", "0", "--certify", "0.1%"}));
  EXPECT_EQ(rough.exit_code, 3) << rough.err;
  expect_has(rough.err, "limit reached: --certify is 0.1 %, but ");
  for (const char* text : {"1", "0.01", "-1%", "%", "1 percent"}) {
    const ProgramResult refused = inputs.run(SmallInputs::plan({"--certify", text}));
    EXPECT_EQ(refused.exit_code, 2) << text;
    expect_has(refused.err, "--certify: '" + std::string(text) + "'; required ");
  }
}

TEST(PlanCommand, ATargetOutOfReachStillPlansWithExitCode3) {
  const SmallInputs inputs;
  const ProgramResult result = inputs.run(SmallInputs::plan({"--time-price", "total<=0.001"}));
  EXPECT_EQ(result.exit_code, 3) << result.err;
  expect_has(result.err, "limit reached: --time-price 'total<=0.001' is not met");
  expect_has(result.err, "the nearest has total dwell ");
  EXPECT_TRUE(std::filesystem::exists(inputs / "plan/program.nc"));
}

TEST(PlanCommand, TwoTargetsInConflictAreSaidToBeWithTheFrontBetweenThem) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan({"--smoothness", "10"})).exit_code, 0);
  const json known = summary_of(inputs);
  const auto target = [](const char* quantity, const json& value) {
    return std::string(quantity) + "<=" + std::to_string(0.8 * value.get<double>());
  };
  const ProgramResult result =
      inputs.run(SmallInputs::plan({"--smoothness", target("step", known["dwell"]["step_rms_s"]), "--time-price",
                                    target("residual", known["residual"]["rms_nm"])}));
  EXPECT_EQ(result.exit_code, 3) << result.err;
  expect_has(result.err, "are in conflict: each can be met, but no weights meet both");
  expect_has(result.out, "\nfront     step RMS ");
  expect_has(result.out, ", this plan\n");
  const json search = summary_of(inputs)["weights"]["search"];
  EXPECT_EQ(search["outcome"], "conflict");
  EXPECT_GE(search["front"].size(), 3u);
  const std::string table = read_whole_file(inputs / "plan/search.csv");
  expect_has(table, ",operator_applications,chosen,front\n");
  EXPECT_NE(table.find(",1,1\n"), std::string::npos) << "the plan's own row is on the front:\n" << table;
}

TEST(PlanCommand, WrittenJobPlansTheSame) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  const std::string feed = read_whole_file(inputs / "plan/feed.csv");
  const ProgramResult written = inputs.run(SmallInputs::plan({"--write-job"}));
  ASSERT_EQ(written.exit_code, 0);
  inputs.folder.file("job.toml", written.out);
  const ProgramResult again = inputs.run({"plan", "--job", "job.toml"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read_whole_file(inputs / "plan/feed.csv"), feed);
}

TEST(PlanCommand, TimeLimitStillWritesAndSaysWhyWithExitCode3) {
  const SmallInputs inputs;
  const ProgramResult result = inputs.run(SmallInputs::plan({"--max-solve", "1e-9"}));
  EXPECT_EQ(result.exit_code, 3) << result.err;
  expect_has(result.err, "limit reached");
  expect_has(result.err, "time limit");
  expect_has(result.err, "--max-solve is 1e-09 s, of which ");
  const json s = summary_of(inputs);
  ASSERT_FALSE(s["limits"].empty());
  expect_has(s["limits"][0], "time limit");
  EXPECT_TRUE(std::filesystem::exists(inputs / "plan/program.nc"));
}

TEST(PlanCommand, TimeLimitOverBeforeTheSolveIsSaidAndLeavesNothing) {
  const SmallInputs inputs;
  const auto before = names_in(inputs.folder.path());
  // Seconds of resampling, before anything can be solved.
  const ProgramResult result =
      inputs.run(SmallInputs::plan({"--max-solve", "0.5", "--map-steps", "resample:pitch=0.0025"}));
  EXPECT_EQ(result.exit_code, 3) << result.err;
  expect_has(result.err,
             "limit reached: --max-solve of 0.5 s (what comes before a solve has 1 s in any case) was over before");
  expect_has(result.err, "nothing was written");
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(names_in(inputs.folder.path()), before);
}

TEST(PlanCommand, InterruptedLeavesTheEarlierResultAndNothingElse) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  const std::string earlier = read_whole_file(inputs / "plan/summary.json");
  const auto before = names_in(inputs.folder.path());
  const auto run = inputs.start_long_plan();
  ASSERT_FALSE(run->ended()) << run->err();
  run->interrupt();
  const ProgramResult result = run->wait();
  EXPECT_EQ(result.exit_code, 130) << result.err;
  expect_has(result.err, "interrupted");
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(read_whole_file(inputs / "plan/summary.json"), earlier);
  inputs.remove_long_plan();
  EXPECT_EQ(names_in(inputs.folder.path()), before);
}

}  // namespace
}  // namespace dwell
