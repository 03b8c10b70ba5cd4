#include "bench/targets.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "bench/report.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Json reached(double applications, double seconds) {
  const Json slot{{"iterations", 1},    {"applications", applications}, {"coarse_pairs", 15.0},
                  {"seconds", seconds}, {"fastest", seconds},           {"slowest", seconds}};
  return {{"objective", {slot, slot, slot}}, {"residual", {slot, slot, slot}}};
}

/// A line of the suite that arrived: 20 applications and 2 s to every quality, 4 s in all.
Json solve(const std::string& scenario, const std::string& solver, int threads) {
  return {{"scenario", scenario},
          {"solver", solver},
          {"threads", threads},
          {"rounds", 1},
          {"points", 20000},
          {"pixels", 1048576},
          {"operator", "lattice"},
          {"pair_seconds", 0.1},
          {"build_seconds", 1.0},
          {"max_seconds", 30.0},
          {"seconds", 4.0},
          {"applications", 20},
          {"coarse_pairs", 15.0},
          {"solve_memory", 8.0 * 1048576 * 10.0},
          {"total_dwell", 400.0},
          {"step_rms", 0.003},
          {"status", "target reached"},
          {"certificate", {{"objective", 1.0}, {"residual_rms", 0.15}, {"projected_gradient", 1e-3}}},
          {"whole", {{"seconds", 4.0}, {"fastest", 4.0}, {"slowest", 4.0}}},
          {"reached", reached(20, 2.0)}};
}

Json scenario(const std::string& name) {
  return {{"name", name},
          {"what", "made for a test"},
          {"smoothness", 0.1},
          {"price", 1e-4},
          {"peers", true},
          {"reference",
           {{"objective", 1.0},
            {"residual_rms", 0.15},
            {"total_dwell", 400.0},
            {"solver", "projected-cg"},
            {"iterations", 10},
            {"change_when_doubled", 1e-7},
            {"settled", true}}}};
}

Json never(Json run, const std::string& status) {
  run["status"] = status;
  for (const char* what : {"objective", "residual"}) run["reached"][what] = {nullptr, nullptr, nullptr};
  return run;
}

Json results(const std::vector<Json>& runs) {
  Json all{{"results", runs}, {"scenarios", Json::array()}};
  std::vector<std::string> seen;
  for (const Json& run : runs) {
    if (std::find(seen.begin(), seen.end(), run["scenario"]) != seen.end()) continue;
    seen.push_back(run["scenario"]);
    all["scenarios"].push_back(scenario(run["scenario"]));
  }
  return all;
}

TargetLine line(const Json& all, const std::string& of) {
  for (const TargetLine& l : target_lines(all)) {
    if (l.what.find(of) != std::string::npos) return l;
  }
  throw std::runtime_error("no target of " + of);
}

TEST(Targets, NanIsMissedAndNothingIsNotMeasured) {
  EXPECT_EQ(at_most(1.0, 1.0), Verdict::Met);
  EXPECT_EQ(at_most(1.1, 1.0), Verdict::Missed);
  EXPECT_EQ(at_most(kNan, 1.0), Verdict::Missed);
  EXPECT_EQ(at_most(std::nullopt, 1.0), Verdict::NotMeasured);
  EXPECT_EQ(at_least(1.0, 1.0), Verdict::Met);
  EXPECT_EQ(at_least(0.9, 1.0), Verdict::Missed);
  EXPECT_EQ(at_least(kNan, 1.0), Verdict::Missed);
  EXPECT_EQ(at_least(std::nullopt, 1.0), Verdict::NotMeasured);
}

TEST(Targets, AllAreNotMeasuredWithoutData) {
  const auto lines = target_lines(Json::object());
  EXPECT_GE(lines.size(), 10U);
  for (const TargetLine& l : lines) EXPECT_EQ(l.verdict, Verdict::NotMeasured) << l.what;
}

TEST(Targets, ReadersAreJudgedByTheirFastestAtTheSizeOfTheAim) {
  const auto read = [](const std::string& name, long size, double fastest) {
    return Json{{"name", name}, {"size", size}, {"threads", 1}, {"fastest", fastest}, {"over_fft", 0.0}};
  };
  const Json all{{"micro",
                  {read("read-dat", 1024, 0.09), read("read-datx", 1024, 0.11), read("read-npy", 1024, 9.0),
                   read("read-npy", 4096, 0.3), read("read-bytes", 4096, 0.2), read("read-bytes", 1024, 0.001)}}};
  EXPECT_EQ(line(all, "read a .dat of").verdict, Verdict::Met);
  EXPECT_EQ(line(all, "read a .datx of").verdict, Verdict::Missed);
  EXPECT_EQ(line(all, "read an .npy").verdict, Verdict::Met);
  EXPECT_THAT(line(all, "read an .npy").seen, HasSubstr("1.50"));
  const Json slow{{"micro", {read("read-npy", 4096, 0.41), read("read-bytes", 4096, 0.2)}}};
  EXPECT_EQ(line(slow, "read an .npy").verdict, Verdict::Missed);
}

TEST(Targets, PairsTo1PercentCountCoarseWork) {
  Json run = solve("a-1024-every-4", "auto", 2);
  EXPECT_EQ(line(results({run}), "1 %, a-1024-every-4").verdict, Verdict::Met);  // 10 + 15
  run["reached"]["objective"][1]["coarse_pairs"] = 20.5;
  const TargetLine over = line(results({run}), "1 %, a-1024-every-4");
  EXPECT_EQ(over.verdict, Verdict::Missed);
  EXPECT_THAT(over.seen, HasSubstr("30.5 (20 by the clock)"));
  run["reached"]["objective"][1]["coarse_pairs"] = kNan;
  EXPECT_EQ(line(results({run}), "1 %, a-1024-every-4").verdict, Verdict::Missed);
}

TEST(Targets, OnePercentThatIsNeverReachedIsMissedButNotWithoutReference) {
  Json all = results({never(solve("a-1024-every-4", "auto", 2), "time limit")});
  EXPECT_EQ(line(all, "1 %, a-1024-every-4").verdict, Verdict::Missed);
  all["scenarios"][0]["reference"] = nullptr;
  EXPECT_EQ(line(all, "1 %, a-1024-every-4").verdict, Verdict::NotMeasured);
}

Json certificate(double tolerance, bool certified, double applications) {
  Json run = solve("a-1024-every-4", "auto", 2);
  run["tolerance"] = tolerance;
  run["certified"] = certified;
  run["applications"] = applications;
  return run;
}

TEST(Targets, CertificateIsJudgedByTheTightestThatWasTried) {
  const auto verdict = [](const std::vector<Json>& runs) {
    return line({{"certificates", runs}}, "certificate").verdict;
  };
  EXPECT_EQ(verdict({certificate(1e-5, true, 100), certificate(1e-6, true, 270)}), Verdict::Met);     // 135 + 15
  EXPECT_EQ(verdict({certificate(1e-5, true, 100), certificate(1e-6, true, 272)}), Verdict::Missed);  // 136 + 15
  EXPECT_EQ(verdict({certificate(1e-5, true, 100), certificate(1e-6, false, 10)}), Verdict::Missed);
  EXPECT_EQ(verdict({certificate(1e-5, true, 100)}), Verdict::NotMeasured);
  const Json skipped{
      {"scenario", "a-1024-every-4"}, {"solver", "auto"}, {"tolerance", 1e-6}, {"skipped", "no time left"}};
  EXPECT_EQ(verdict({certificate(1e-5, true, 100), skipped}), Verdict::NotMeasured);
  EXPECT_EQ(verdict({certificate(1e-5, false, 100), skipped}), Verdict::Missed);
  EXPECT_EQ(verdict({certificate(1e-6, true, kNan)}), Verdict::Missed);
}

TEST(Targets, OperatorIsTheWorstOfThoseThatTransform) {
  const auto micro = [](const std::string& name, double over) {
    return Json{{"name", name}, {"size", 1024}, {"threads", 2}, {"over_fft", over}};
  };
  const auto of = [](const std::vector<Json>& rows) { return line({{"micro", rows}}, "one operator"); };
  EXPECT_EQ(
      of({micro("lattice-apply", 1.2), micro("sparse-apply", 9.0), micro("lattice-fft-pair-single", 3.0)}).verdict,
      Verdict::Met);
  const TargetLine slow = of({micro("lattice-apply", 1.2), micro("scattered-adjoint", 1.3)});
  EXPECT_EQ(slow.verdict, Verdict::Missed);
  EXPECT_THAT(slow.seen, HasSubstr("1.30 (scattered-adjoint 1024"));
  EXPECT_EQ(of({micro("lattice-apply", kNan), micro("lattice-adjoint", 1.0)}).verdict, Verdict::Missed);
  EXPECT_EQ(of({micro("lattice-fft-pair", 0.0)}).verdict, Verdict::NotMeasured);
}

TEST(Targets, ThreadsAreComparedWhereBothEndedAlike) {
  Json one = solve("a-2048-every-4", "auto", 1);
  const Json two = solve("a-2048-every-4", "auto", 2);
  one["whole"]["seconds"] = 6.8;
  EXPECT_EQ(line(results({one, two}), "2 threads").verdict, Verdict::Met);
  one["whole"]["seconds"] = 6.0;
  EXPECT_EQ(line(results({one, two}), "2 threads").verdict, Verdict::Missed);
  one["status"] = "time limit";
  EXPECT_EQ(line(results({one, two}), "2 threads").verdict, Verdict::NotMeasured);
  EXPECT_EQ(line(results({two}), "2 threads").verdict, Verdict::NotMeasured);
}

TEST(Targets, PeersAreTenTimesSlowerOrStoppedByTheClockAfterThat) {
  const Json own = solve("b-512", "auto", 2);  // 2 s to 1 %
  Json peer = solve("b-512", "lbfgsb", 2);
  peer["reached"] = reached(200, 20.0);
  EXPECT_EQ(line(results({own, peer}), "fastest peer").verdict, Verdict::Met);
  peer["reached"] = reached(200, 19.0);
  EXPECT_EQ(line(results({own, peer}), "fastest peer").verdict, Verdict::Missed);

  peer = never(peer, "time limit");
  const TargetLine bound = line(results({own, peer}), "fastest peer");
  EXPECT_EQ(bound.verdict, Verdict::Met);
  EXPECT_THAT(bound.seen, HasSubstr("> 15"));
  peer["max_seconds"] = 19.0;  // it could have come at once after that
  EXPECT_EQ(line(results({own, peer}), "fastest peer").verdict, Verdict::NotMeasured);
  EXPECT_EQ(line(results({own}), "fastest peer").verdict, Verdict::NotMeasured);
  EXPECT_EQ(line(results({never(own, "time limit"), peer}), "fastest peer").verdict, Verdict::Missed);
}

TEST(Targets, PeersDoNotCountBelowTenThousandPoints) {
  Json own = solve("c-3000", "auto", 2), peer = solve("c-3000", "lbfgsb", 2);
  own["points"] = peer["points"] = 3000;
  EXPECT_EQ(line(results({own, peer}), "fastest peer").verdict, Verdict::NotMeasured);
}

TEST(Targets, UdoHasToMeetAllFour) {
  const auto of = [](const Json& plan) { return line({{"plans", {plan}}}, "udo-raster: solve"); };
  const Json plan{{"name", "udo-raster"}, {"seconds", 1.0},       {"peak_memory", 1e8},  {"solver_seconds", 0.4},
                  {"step_rms", 0.003},    {"residual_rms", 0.14}, {"total_dwell", 420.0}};
  EXPECT_EQ(of(plan).verdict, Verdict::Met);
  for (const char* key : {"solver_seconds", "step_rms", "residual_rms", "total_dwell"}) {
    Json worse = plan;
    worse[key] = 1e3;
    EXPECT_EQ(of(worse).verdict, Verdict::Missed) << key;
    worse[key] = nullptr;  // a NaN that went through a file
    EXPECT_EQ(of(worse).verdict, Verdict::Missed) << key;
  }
}

TEST(Targets, ThreadsDoNotSpinForOneProcessor) {
  const auto of = [](const Json& one, const Json& two) {
    return line({{"plans", {one, two}}}, "2 threads over 1").verdict;
  };
  const Json one{{"name", "one-processor-1-thread"}, {"cpu_seconds", 2.0}};
  Json two{{"name", "one-processor-2-threads"}, {"cpu_seconds", 2.6}};
  EXPECT_EQ(of(one, two), Verdict::Met);
  two["cpu_seconds"] = 2.7;
  EXPECT_EQ(of(one, two), Verdict::Missed);
  EXPECT_EQ(of(one, {{"name", "one-processor-2-threads"}, {"failed", "not done"}}), Verdict::NotMeasured);
}

TEST(Targets, PlansKeepTimeAndMemory) {
  const auto of = [](const Json& plan) { return line({{"plans", {plan}}}, "4096-every-4-stop"); };
  Json plan{{"name", "4096-every-4-stop"}, {"seconds", 20.0}, {"peak_memory", 6.0 * 0x1p30}};
  EXPECT_EQ(of(plan).verdict, Verdict::Met);
  plan["peak_memory"] = 6.1 * 0x1p30;
  EXPECT_EQ(of(plan).verdict, Verdict::Missed);
  EXPECT_EQ(of({{"name", "4096-every-4-stop"}, {"failed", "not done after 60 s"}}).verdict, Verdict::Missed);
  EXPECT_EQ(of({{"name", "4096-every-4-stop"}, {"skipped", "no time left"}}).verdict, Verdict::NotMeasured);
}

TEST(Targets, MemoryIsThatOfLargeProblems) {
  Json small = solve("a-64-every-4", "auto", 2), large = solve("a-1024-every-4", "auto", 2);
  small["points"] = small["pixels"] = 4096;
  EXPECT_EQ(line(results({small}), "memory").verdict, Verdict::NotMeasured);
  EXPECT_EQ(line(results({small, large}), "memory").verdict, Verdict::Met);
  large["solve_memory"] = 8.0 * 1048576 * 16.5;
  EXPECT_EQ(line(results({small, large}), "memory").verdict, Verdict::Missed);
}

TEST(Targets, PlannersAreJudgedByTheSlowestAtAMillionPoints) {
  const auto run = [](const std::string& path, double points, double seconds) {
    return Json{
        {"path", path}, {"points", points}, {"seconds", 1.2 * seconds}, {"fastest", seconds}, {"length_ratio", 1.05}};
  };
  Json all{{"planners",
            {run("raster:pitch=1", 1e6, 0.02), run("raster:pitch=1,turn=arc", 1e6, 0.04),
             run("spiral:pitch=1", 1e6, 0.03), run("hilbert:pitch=1", 1e6, 0.03)}}};
  EXPECT_EQ(line(all, "points a second, raster").verdict, Verdict::NotMeasured);  // one of the four is missing
  all["planners"].push_back(run("multi-pitch:pitches=1", 1e6, 0.03));
  EXPECT_EQ(line(all, "points a second, raster").verdict, Verdict::Met);
  all["planners"][1]["fastest"] = 0.06;
  EXPECT_EQ(line(all, "points a second, raster").verdict, Verdict::Missed);
  EXPECT_EQ(line(all, "points a second, random").verdict, Verdict::NotMeasured);  // not random-raster, nor raster
  all["planners"].push_back(run("random:pitch=1", 1e5, 1e-3));
  EXPECT_EQ(line(all, "points a second, random").verdict, Verdict::NotMeasured);  // too few points to say
  all["planners"].push_back(run("nearest:cell=1,critical=0,improve=2opt", 1e5, 30.0));
  EXPECT_EQ(line(all, "2-opt").verdict, Verdict::Met);
  all["planners"].back()["length_ratio"] = 1.09;
  EXPECT_EQ(line(all, "2-opt").verdict, Verdict::Missed);
}

TEST(Report, ShowsWhatWasSkippedAsSuch) {
  Json all = results({solve("b-512", "auto", 2),
                      {{"scenario", "b-512"},
                       {"solver", "lbfgsb"},
                       {"threads", 2},
                       {"rounds", 0},
                       {"skipped", "no time left in the budget"}}});
  all["machine"] = {{"processor", "p"}, {"cores", 2},       {"memory_gib", 1.0}, {"compiler", "c"},
                    {"flags", "f"},     {"commit", "none"}, {"fftw", "w"},       {"date", "d"}};
  all["certificates"] = {{{"scenario", "b-512"}, {"solver", "auto"}, {"tolerance", 1e-3}, {"skipped", "no time left"}}};
  all["plans"] = {{{"name", "p"}, {"what", "w"}, {"skipped", "no time left"}}};
  all["seconds"] = {{"all", 10.0}};
  all["budget"] = 10.0;
  const std::string text = markdown_report(all, "picture.png");
  EXPECT_THAT(text, HasSubstr("| lbfgsb | 2 | skipped: no time left in the budget |"));
  EXPECT_THAT(text, HasSubstr("skipped: 3 measurements"));
  EXPECT_THAT(text, HasSubstr("| 10 + 15 = 25 (20) |"));
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace dwell::bench
