#include "bench/targets.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/bench/made_up_run.h"

namespace dwell::bench {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

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
  const auto of = [](const Json& plan) { return line({{"plans", {plan}}}, "plan`, 4096-narrow-moving"); };
  Json plan{{"name", "4096-narrow-moving"}, {"seconds", 20.0}, {"peak_memory", 4.0 * 0x1p30}};
  EXPECT_EQ(of(plan).verdict, Verdict::Met);
  plan["peak_memory"] = 4.1 * 0x1p30;
  EXPECT_EQ(of(plan).verdict, Verdict::Missed);
  EXPECT_EQ(of({{"name", "4096-narrow-moving"}, {"failed", "not done after 60 s"}}).verdict, Verdict::Missed);
  EXPECT_EQ(of({{"name", "4096-narrow-moving"}, {"skipped", "no time left"}}).verdict, Verdict::NotMeasured);
}

TEST(Targets, ThreadsOfAPlanAreComparedByItsSolve) {
  const auto of = [](const std::vector<Json>& plans) {
    return line({{"plans", plans}}, "against 1, 4096-wide-moving");
  };
  const Json one{{"name", "4096-wide-moving-1-thread"}, {"solver_seconds", 16.0}};
  Json two{{"name", "4096-wide-moving"}, {"solver_seconds", 10.0}};
  EXPECT_EQ(of({one, two}).verdict, Verdict::Met);
  two["solver_seconds"] = 10.1;
  EXPECT_EQ(of({one, two}).verdict, Verdict::Missed);
  two["solver_seconds"] = nullptr;
  EXPECT_EQ(of({one, two}).verdict, Verdict::Missed);
  EXPECT_EQ(of({one}).verdict, Verdict::NotMeasured);
}

TEST(Targets, AnInterruptedPlanEndsAtOnce) {
  const auto of = [](const Json& plan) { return line({{"plans", {plan}}}, "after an interrupt"); };
  EXPECT_EQ(of({{"name", "4096-interrupted"}, {"to_exit_seconds", 0.5}}).verdict, Verdict::Met);
  EXPECT_EQ(of({{"name", "4096-interrupted"}, {"to_exit_seconds", 0.6}}).verdict, Verdict::Missed);
  EXPECT_EQ(of({{"name", "4096-interrupted"}, {"failed", "done before it could be interrupted"}}).verdict,
            Verdict::NotMeasured);
}

TEST(Targets, IbfestCountsPairsAndTheClock) {
  Json run = solve("e-ibfest-70x30", "auto", 2);  // 10 + 15 pairs, 20 by the clock
  EXPECT_EQ(line(results({run}), "1 %, e-ibfest").verdict, Verdict::Met);
  run["reached"]["objective"][1]["seconds"] = 8.1;  // 81 pairs
  EXPECT_EQ(line(results({run}), "1 %, e-ibfest").verdict, Verdict::Missed);
}

TEST(Targets, EveryPixelIsJudgedInSeconds) {
  Json run = solve("a-1024-every-1", "auto", 2);
  const auto verdict = [&] {
    for (const TargetLine& l : target_lines(results({run}))) {
      if (l.what == "`auto` to 1 %, a-1024-every-1") return l.verdict;
    }
    throw std::runtime_error("no such target");
  };
  run["reached"]["objective"][1]["seconds"] = 1.5;
  EXPECT_EQ(verdict(), Verdict::Met);
  run["reached"]["objective"][1]["seconds"] = 1.6;
  EXPECT_EQ(verdict(), Verdict::Missed);
}

TEST(Targets, EveryReferenceIsSettled) {
  Json all = results({solve("b-512", "auto", 2), solve("c-3000", "auto", 2)});
  EXPECT_EQ(line(all, "references settled").verdict, Verdict::Met);
  all["scenarios"][1]["reference"]["settled"] = false;
  const TargetLine open = line(all, "references settled");
  EXPECT_EQ(open.verdict, Verdict::Missed);
  EXPECT_THAT(open.seen, HasSubstr("1 of 2; not: c-3000"));
  all["scenarios"][1]["reference"] = nullptr;
  EXPECT_EQ(line(all, "references settled").verdict, Verdict::Missed);
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

}  // namespace
}  // namespace dwell::bench
