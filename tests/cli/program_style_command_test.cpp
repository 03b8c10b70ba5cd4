#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;
using test::with;
using test::Words;

/// A plan on pixels that are not square, by a tool without symmetry.
struct LaidInputs : SmallInputs {
  LaidInputs() {
    std::string tif;
    for (int r = -6; r <= 6; ++r) {
      for (int c = -6; c <= 6; ++c)
        tif += std::to_string(10.0 * std::exp(-0.09 * (r * r + c * c)) +
                              4.0 * std::exp(-0.3 * ((r - 2) * (r - 2) + (c + 3) * (c + 3)))) +
               (c < 6 ? "," : "\n");
    }
    folder.file("tif.csv", tif);
    folder.file("uneven.toml",
                "path_acceleration_mm_per_s2 = 60\n[x]\nlowest_mm = -30\nhighest_mm = 40\n"
                "max_acceleration_mm_per_s2 = 50\n[y]\nmax_acceleration_mm_per_s2 = 20\nmax_speed_mm_per_s = 9\n");
  }

  static Words laid(const Words& more) { return plan(with({"--map-pixel", "0.5,0.4", "--max-feed", "900"}, more)); }

  json planned(const Words& more) const {
    const ProgramResult result = run(laid(more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(read_whole_file(*this / "plan/summary.json"));
  }

  json simulated(const Words& words) const {
    const ProgramResult result = run(with(with({"simulate"}, words), {"--threads", "1", "--json"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }

  json simulated_alone(const std::string& file, const Words& more = {}) const {
    return simulated(with(
        {"--program", file, "--map", "map.csv", "--map-pixel", "0.5,0.4", "--tif", "tif.csv", "--tif-pixel", "0.5"},
        more));
  }

  void refused(const Words& more, const Words& parts) const {
    const ProgramResult result = run(laid(more));
    EXPECT_EQ(result.exit_code, 2) << result.out;
    for (const std::string& part : parts) expect_has(result.err, part);
    EXPECT_FALSE(std::filesystem::exists(*this / "plan"));
  }
};

void expect_lines_for_controllers(const std::string& program) {
  std::size_t from = 0;
  for (std::size_t end = 0; (end = program.find('\n', from)) != std::string::npos; from = end + 1) {
    EXPECT_LE(end - from, 80u) << program.substr(from, end - from);
  }
  EXPECT_TRUE(std::all_of(program.begin(), program.end(), [](char c) { return c == '\n' || (c >= 0x20 && c < 0x7f); }));
}

TEST(ProgramStyle, LeavesTheSameResidualInEveryFrameUnitAndDialect) {
  const LaidInputs inputs;
  const double rms = inputs.planned({})["program"]["residual_rms_nm"];
  const std::string plain = read_whole_file(inputs / "plan/program.nc");
  for (const Words& style : std::initializer_list<Words>{{"--zero", "7.25,-3.5"},
                                                         {"--rotate", "180", "--gcode", "g93-seconds"},
                                                         {"--rotate", "270", "--units", "inch"},
                                                         {"--rotate", "-37.5", "--zero", "1,2"},
                                                         {"--swap-axes", "yes", "--rotate", "12", "--units", "inch"},
                                                         {"--units", "inch", "--gcode", "g93-per-minute"},
                                                         {"--block-numbers", "--path-mode", "blend:0.05"}}) {
    SCOPED_TRACE(style[0] + " " + (style.size() > 1 ? style[1] : ""));
    const json plan = inputs.planned(style);
    EXPECT_NEAR(plan["program"]["residual_rms_nm"].get<double>(), rms, 1e-6 * rms);
    EXPECT_EQ(plan["program"]["feed_table"], "same steps");
    const std::string program = read_whole_file(inputs / "plan/program.nc");
    EXPECT_NE(program, plain);
    expect_lines_for_controllers(program);
    for (const json& s : {inputs.simulated_alone("plan/program.nc"), inputs.simulated_alone("plan/feed.csv")}) {
      EXPECT_NEAR(s["program"]["residual_rms_nm"].get<double>(), rms, 1e-6 * rms);
      EXPECT_TRUE(s["differences"].empty());
    }
    // The frame is what keeps it so.
    const std::size_t frame = program.find("(dwell: zero=");
    if (frame == std::string::npos) continue;
    std::string without = program;
    without.erase(frame, program.find('\n', frame) + 1 - frame);
    inputs.folder.file("without.nc", without);
    const ProgramResult other = inputs.run({"simulate", "--program", "without.nc", "--map", "map.csv", "--map-pixel",
                                            "0.5,0.4", "--tif", "tif.csv", "--tif-pixel", "0.5", "--json"});
    EXPECT_TRUE(other.exit_code == 2 || json::parse(other.out)["program"]["residual_rms_nm"].get<double>() > 1.2 * rms);
  }
}

TEST(ProgramStyle, HoldsLongNamesThatAreNotAsciiAndStillComparesThem) {
  const LaidInputs inputs;
  std::filesystem::path far = inputs.folder.path();
  for (int k = 0; k < 4; ++k) far /= "Spiegel f\xC3\xBCr M\xC3\xA4rz (alt) " + std::string(60, 'm');
  std::filesystem::create_directories(far);
  for (const char* name : {"map.csv", "tif.csv"}) std::filesystem::copy_file(inputs / name, far / name);
  const std::string map = (far / "map.csv").string(), tif = (far / "tif.csv").string();
  const std::string steps = "average:" + map + "," + map;
  const json plan = inputs.planned({"--map", map, "--tif", tif, "--map-steps", steps});
  const std::string program = read_whole_file(inputs / "plan/program.nc");
  expect_lines_for_controllers(program);
  expect_has(program, "(input: map ...");
  expect_has(program, "/map.csv sha256=");
  expect_has(program, "(option+: map_steps = ");
  expect_has(read_whole_file(inputs / "plan/feed.csv"), "# input: map " + map + " sha256=");
  EXPECT_EQ(plan["inputs"][0]["file"], map);
  const Words same{"--map", map, "--map-pixel", "0.5,0.4", "--tif", tif, "--tif-pixel", "0.5", "--map-steps", steps};
  for (const char* file : {"plan/program.nc", "plan/feed.csv"}) {
    EXPECT_TRUE(inputs.simulated(with({"--program", file}, same))["differences"].empty()) << file;
  }
  EXPECT_TRUE(inputs.simulated({"plan"})["differences"].empty());
  // Another map, another option, a header that was changed.
  const ProgramResult refused = inputs.run({"simulate", "--program", "plan/program.nc", "--map", "tif.csv",
                                            "--map-pixel", "0.5,0.4", "--tif", tif, "--tif-pixel", "0.5"});
  EXPECT_EQ(refused.exit_code, 2);
  expect_has(refused.err, "was made with the map ...");
  expect_has(refused.err, "--other-map");
  const json turned = inputs.simulated(with(with({"--program", "plan/program.nc"}, same), {"--tif-angle", "3"}));
  ASSERT_EQ(turned["differences"].size(), 1u);
  EXPECT_EQ(turned["differences"][0], "--tif-angle is 3, but was 0 when the program was made");
  std::string changed = program;
  const std::size_t line = changed.find("(option: tif_flip");
  ASSERT_NE(line, std::string::npos);
  inputs.folder.file("changed.nc", changed.erase(line, changed.find('\n', line) + 1 - line));
  expect_has(inputs.simulated(with({"--program", "changed.nc"}, same))["differences"][0],
             "the comments of the program that say how it was made have changed since");
}

TEST(ProgramStyle, PutsLinesOfTheUserIntoTheProgram) {
  const LaidInputs inputs;
  inputs.folder.file("start.nc", "(PAD 6)\nM3 S900\nM8\n");
  inputs.folder.file("end.nc", "G0 X-60 Y-40\nM9\nM5\n");
  const Words both{"--header", "start.nc", "--footer", "end.nc", "--block-numbers", "10"};
  const double rms = inputs.planned({})["program"]["residual_rms_nm"];
  const json plan = inputs.planned(both);
  EXPECT_NEAR(plan["program"]["residual_rms_nm"].get<double>(), rms, 1e-6 * rms);
  const std::string program = read_whole_file(inputs / "plan/program.nc");
  expect_has(program, "Z>0)\n(PAD 6)\nM3 S900\nM8\n(units: X Y Z mm, F mm/min, P seconds)\nN10 G21\n");
  expect_has(program, "G0 Z10.000000\nG0 X-60 Y-40\nM9\nM5\nN");
  EXPECT_EQ(plan["inputs"][0]["role"], "header");
  // The files are of the program alone: without them it is simulated all the same.
  std::filesystem::remove(inputs / "start.nc");
  EXPECT_TRUE(inputs.simulated({"plan"})["differences"].empty());
  EXPECT_TRUE(inputs.simulated_alone("plan/program.nc")["differences"].empty());
}

TEST(ProgramStyle, RefusesLinesBeforeAnythingIsComputed) {
  const LaidInputs inputs;
  inputs.folder.file("bad.nc", "M8\nG92 X0 Y0\n");
  inputs.folder.file("long.nc", "(" + std::string(90, 'x') + ")\n");
  inputs.folder.file("umlaut.nc", "M8\n(K\xC3\xBChlung)\n");
  inputs.folder.file("end.nc", "M30\n");
  inputs.folder.file("down.nc", "M9\nG0 Z0\n");
  inputs.folder.file("corners.nc", "G64 P0.1\n");
  inputs.refused({"--header", "bad.nc"}, {"bad.nc, line 2: \"G92\": moves the origin"});
  inputs.refused({"--footer", "bad.nc"}, {"bad.nc, line 2: \"G92\": moves the origin"});
  inputs.refused({"--header", "long.nc"}, {"long.nc, line 1: 92 characters", "at most 80"});
  inputs.refused({"--footer", "umlaut.nc"}, {"umlaut.nc, line 2: ", "required printable ASCII"});
  inputs.refused({"--footer", "end.nc"}, {"end.nc, line 1: \"M30\" ends the program"});
  inputs.refused({"--footer", "down.nc"}, {"down.nc: leaves the tool at work"});
  inputs.refused({"--header", "none.nc"}, {"none.nc"});
  inputs.folder.file("free.toml", "path_acceleration_mm_per_s2 = 500\n[corner]\nrule = \"free\"\n");
  inputs.refused({"--header", "corners.nc", "--machine", "free.toml"},
                 {"corners.nc: sets how the machine takes corners"});
  inputs.refused({"--zero", "1"}, {"--zero", "required X,Y in mm"});
  inputs.refused({"--rotate", "400"}, {"--rotate", "400"});
  inputs.refused({"--swap-axes", "maybe"}, {"--swap-axes", "accepted: yes, no"});
  inputs.refused({"--units", "um"}, {"--units", "accepted: mm, inch"});
  inputs.refused({"--block-numbers", "0.5"}, {"--block-numbers", "whole number from 0 to 1000"});
  inputs.refused({"--path-mode", "smooth"}, {"--path-mode", "accepted: auto, none, exact-stop"});
}

TEST(ProgramStyle, TakesCornersAsThePlanDoes) {
  const LaidInputs inputs;
  inputs.folder.file("stops.toml", "path_acceleration_mm_per_s2 = 60\n");
  inputs.folder.file("junction.toml", "path_acceleration_mm_per_s2 = 60\n[corner]\nrule = \"junction-deviation\"\n");
  inputs.folder.file(
      "blends.toml",
      "path_acceleration_mm_per_s2 = 60\n[corner]\nrule = \"blend\"\narcs = \"as-needed\"\ntolerance_mm = "
      "0.1\nalong_share = 0.5\n");
  inputs.refused({"--machine", "stops.toml", "--path-mode", "blend"},
                 {"--path-mode blend with --machine", "required --path-mode blend:TOLERANCE_MM"});
  inputs.refused({"--machine", "blends.toml", "--schedule", "linear", "--export", "pvt-csv"}, {"corner rule blend"});
  inputs.refused({"--machine", "stops.toml", "--path-mode", "exact-stop"}, {"--path-mode exact-stop with --machine"});
  const Words turning{"--path", "random:pitch=1.5,seed=2", "--smoothness", "0.1"};
  const auto said = [&](const Words& style, bool g61, bool g64 = false) {
    const Words words = with(turning, style);
    const json plan = inputs.planned(words);
    const std::string program = read_whole_file(inputs / "plan/program.nc");
    EXPECT_EQ(program.find("\nG61\n") != std::string::npos, g61);
    EXPECT_EQ(program.find("\nG64 P0.100000 Q0.000000\n") != std::string::npos, g64);
    const json again = inputs.simulated({"plan"});
    EXPECT_NEAR(again["program"]["residual_rms_nm"].get<double>(), plan["program"]["residual_rms_nm"].get<double>(),
                1e-9);
    EXPECT_NEAR(plan["program"]["residual_rms_nm"].get<double>(), plan["motion"]["executed_rms_nm"].get<double>(),
                0.05 * plan["motion"]["executed_rms_nm"].get<double>());
    return plan["total_s"].get<double>();
  };
  const double stops = said({"--machine", "stops.toml"}, true);
  EXPECT_NEAR(said({"--machine", "stops.toml", "--path-mode", "none"}, false), stops, 1e-6 * stops);
  said({"--machine", "junction.toml"}, false);
  // G61 makes every machine stop, and the plan knows it.
  EXPECT_NEAR(said({"--machine", "junction.toml", "--path-mode", "exact-path"}, true), stops, 1e-3 * stops);
  EXPECT_NEAR(said({"--machine", "blends.toml", "--path-mode", "exact-path"}, true), stops, 1e-3 * stops);
  // And G64 makes every machine blend.
  const double blends = said({"--machine", "blends.toml"}, false, true);
  EXPECT_LT(blends, 0.99 * stops);
  EXPECT_LT(said({"--machine", "stops.toml", "--path-mode", "blend:0.1"}, false, true), 0.99 * stops);
}

// Its axes are those of the program: turned by a quarter, the quick axis runs along the other side of the part.
TEST(ProgramStyle, PlansForTheAxesOfTheMachine) {
  const LaidInputs inputs;
  const Words machine{"--machine", "uneven.toml", "--smoothness", "0.1", "--rounds", "1"};
  const auto executed = [&](const Words& style) {
    const json plan = inputs.planned(with(machine, style)), again = inputs.simulated({"plan"});
    EXPECT_TRUE(plan["limits"].empty());
    EXPECT_NEAR(again["executed"]["total_s"].get<double>(), plan["total_s"].get<double>(), 1e-6);
    EXPECT_NEAR(again["program"]["residual_rms_nm"].get<double>(), plan["program"]["residual_rms_nm"].get<double>(),
                1e-9);
    // The table knows the axes as well.
    const json table = inputs.simulated_alone("plan/feed.csv", {"--machine", "uneven.toml"});
    EXPECT_NEAR(table["program"]["residual_rms_nm"].get<double>(), plan["program"]["residual_rms_nm"].get<double>(),
                1e-4 * plan["program"]["residual_rms_nm"].get<double>());
    return plan["total_s"].get<double>();
  };
  const double plain = executed({}), turned = executed({"--rotate", "90"}), half = executed({"--rotate", "180"}),
               swapped = executed({"--swap-axes"});
  EXPECT_GT(std::abs(turned - plain), 1e-3 * plain);
  EXPECT_NEAR(half, plain, 1e-6 * plain);
  EXPECT_NEAR(swapped, turned, 1e-6 * turned);
  // Travel: the part from 0 to 14.5 mm lies beyond 40 mm if its zero is so far off.
  const ProgramResult beyond = inputs.run(LaidInputs::laid(with(machine, {"--zero", "-35,0"})));
  EXPECT_EQ(beyond.exit_code, 3);
  expect_has(beyond.err, "leave the machine's travel of x from -30 to 40 mm");
}

}  // namespace
}  // namespace dwell
