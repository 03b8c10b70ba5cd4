#include "bench/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/json_access.h"
#include "bench/plan_targets.h"
#include "bench/solver_tables.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

constexpr double kPairsTo1Percent = 30.0, kPairsToCertificate = 150.0, kCertificate = 1e-6;
constexpr double kOverTransform = 1.25, kThreadRatio = 1.6, kPeerRatio = 10.0;
constexpr double kPeerPoints = 1e4;  // from so many dwell points on
constexpr double kPairsOfIbfest = 25.0, kWallPairsOfIbfest = 80.0;
constexpr double kEveryPixelSeconds = 1.5;
constexpr double kReadSeconds = 0.1;
constexpr double kReadRatio = 2.0;  // NPY, over its bytes: the map and its check are one more pass each
constexpr double kVectors = 16.0;
constexpr double kPlannerPoints = 5e5;  // paths with fewer points say nothing about 10^6
constexpr double kPlannerRate = 2e7, kRandomRate = 5e4, kNearestRate = 2e5;  // [points/s]
constexpr double kTourRatio = 1.08, kTourSeconds = 60.0, kTourPoints = 1e5;
constexpr double kLargeVector = 0x1p17;  // below so many numbers, 1 MiB, fixed memory counts for more than vectors

/// Of several measurements of one aim, the one farthest from it. NaN is farther than any number.
struct Worst {
  std::optional<double> value;
  std::string where;

  void see(double seen, const std::string& at, bool larger_is_worse) {
    const bool farther = !value || std::isnan(seen) || (larger_is_worse ? seen > *value : seen < *value);
    if (!farther || (value && std::isnan(*value))) return;
    value = seen;
    where = at;
  }
};

TargetLine pairs_line(const Json& all, const std::string& scenario, double most, double most_by_clock) {
  const bool clocked = most_by_clock < std::numeric_limits<double>::infinity();
  TargetLine line{fmt::format("`auto` to 1 %, {}, pairs with coarse levels", scenario),
                  fmt::format("<= {:g}", most) + (clocked ? fmt::format(", {:g} by the clock", most_by_clock) : ""), "",
                  Verdict::NotMeasured};
  const Json run = find_run(all, scenario, "auto", 2);
  if (run.is_null() || !run.contains("reached")) return line;
  const auto& scenarios = list_of(all, "scenarios");
  const bool compared = std::any_of(scenarios.begin(), scenarios.end(), [&](const Json& s) {
    return text_of(s, "name") == scenario && !s.at("reference").is_null();
  });
  if (!compared) {
    line.seen = "no reference";
    return line;
  }
  const std::optional<Pairs> pairs = pairs_to(run, 1);
  if (!pairs) {
    line.seen = "1 % not reached";
    line.verdict = Verdict::Missed;
    return line;
  }
  const double by_clock = number(run.at("reached").at("objective").at(1), "seconds") / number(run, "pair_seconds");
  line.seen = fmt::format("{:.1f} ({:.0f} by the clock)", pairs->total(), by_clock);
  line.verdict = at_most(pairs->total(), most);
  if (clocked) line.verdict = worse(line.verdict, at_most(by_clock, most_by_clock));
  return line;
}

TargetLine certificate_line(const Json& all) {
  const std::string scenario = "a-1024-every-4";
  TargetLine line{fmt::format("`auto` to certificate {:g}, {}, pairs", kCertificate, scenario),
                  fmt::format("<= {:g}", kPairsToCertificate), "", Verdict::NotMeasured};
  const Json* tightest = nullptr;
  const Json runs = list_of(all, "certificates");
  for (const Json& run : runs) {
    if (text_of(run, "scenario") != scenario || text_of(run, "solver") != "auto" || run.contains("skipped")) continue;
    if (!tightest || number(run, "tolerance") < number(*tightest, "tolerance")) tightest = &run;
  }
  if (!tightest) return line;
  const Json& run = *tightest;
  if (!run.at("certified").get<bool>()) {
    line.seen =
        run.contains("certificate")
            ? fmt::format("{:.1e} after {:.0f} pairs, not {:g}", number(run.at("certificate"), "projected_gradient"),
                          0.5 * number(run, "applications") + number(run, "coarse_pairs"), number(run, "tolerance"))
            : "no answer";
    line.verdict = Verdict::Missed;
  } else if (number(run, "tolerance") <= kCertificate) {
    const double pairs = 0.5 * number(run, "applications") + number(run, "coarse_pairs");
    line.seen = fmt::format("reached, {:.0f}", pairs);
    line.verdict = at_most(pairs, kPairsToCertificate);
  } else {
    line.seen = fmt::format("{:g} reached, no time for more", number(run, "tolerance"));
  }
  return line;
}

TargetLine operator_line(const Json& all) {
  Worst worst;
  for (const Json& r : list_of(all, "micro")) {
    const std::string name = text_of(r, "name");
    // The sparse matrix is meant for other problems than the transform, and the bare pairs are what all others are
    // compared with.
    const bool convolves = name.starts_with("lattice-") || name.starts_with("scattered-");
    if (!convolves || name.find("fft-pair") != std::string::npos) continue;
    const double over = number(r, "over_fft");
    if (over != 0.0)
      worst.see(over, fmt::format("{} {}, {} threads", name, r.at("size").get<long>(), r.at("threads").get<int>()),
                true);
  }
  return {"one operator application over the bare transform pair, worst of all", fmt::format("<= {:g}", kOverTransform),
          worst.value ? fmt::format("{:.2f} ({})", *worst.value, worst.where) : "",
          at_most(worst.value, kOverTransform)};
}

TargetLine thread_line(const Json& all) {
  const std::string scenario = "a-2048-every-4";
  const std::optional<double> ratio = thread_ratio(all, scenario);
  return {fmt::format("2 threads against 1, {}, whole solve of `auto`", scenario), fmt::format(">= {:g}", kThreadRatio),
          ratio ? fmt::format("{:.2f}", *ratio) : "", at_least(ratio, kThreadRatio)};
}

/// Dwell at every pixel.
TargetLine every_pixel_line(const Json& all) {
  TargetLine line{"`auto` to 1 %, a-1024-every-1", fmt::format("<= {:g} s", kEveryPixelSeconds), "",
                  Verdict::NotMeasured};
  const Json run = find_run(all, "a-1024-every-1", "auto", 2);
  if (run.is_null() || !run.contains("reached")) return line;
  const std::optional<double> seconds = seconds_to_1_percent(run);
  line.seen = seconds ? fmt::format("{:.2f} s", *seconds) : "1 % not reached";
  line.verdict = seconds ? at_most(seconds, kEveryPixelSeconds) : Verdict::Missed;
  return line;
}

TargetLine reference_line(const Json& all) {
  TargetLine line{"references settled", "all", "", Verdict::NotMeasured};
  const Json scenarios = list_of(all, "scenarios");
  std::size_t settled = 0;
  std::string open;
  for (const Json& s : scenarios) {
    const Json& reference = s.at("reference");
    const bool is = !reference.is_null() && reference.at("settled").get<bool>();
    settled += is ? 1 : 0;
    if (!is) open += (open.empty() ? "" : ", ") + text_of(s, "name");
  }
  if (scenarios.empty()) return line;
  line.seen = fmt::format("{} of {}{}", settled, scenarios.size(), open.empty() ? "" : "; not: " + open);
  line.verdict = open.empty() ? Verdict::Met : Verdict::Missed;
  return line;
}

TargetLine peer_line(const Json& all) {
  TargetLine line{fmt::format("fastest peer to 1 % over `auto`, every scenario with {:g} points or more", kPeerPoints),
                  fmt::format(">= {:g}", kPeerRatio), "", Verdict::NotMeasured};
  Worst worst;
  std::string open, lost;
  bool exact = true;
  for (const Json& scenario : list_of(all, "scenarios")) {
    const std::string name = text_of(scenario, "name");
    const Json run = find_run(all, name, "auto", 2);
    if (!run.is_null() && run.contains("points") && !(number(run, "points") >= kPeerPoints)) continue;
    if (!run.is_null() && run.contains("reached") && !seconds_to_1_percent(run) &&
        !scenario.at("reference").is_null()) {
      lost += (lost.empty() ? "" : ", ") + name;
      continue;
    }
    const std::optional<PeerRatio> ratio = peer_ratio(all, name);
    // A lower bound below the aim decides nothing.
    if (!ratio || (!ratio->exact && !(ratio->ratio >= kPeerRatio))) {
      open += (open.empty() ? "" : ", ") + name;
      continue;
    }
    worst.see(ratio->ratio, name, false);
    if (worst.where == name) exact = ratio->exact;
  }
  if (worst.value) line.seen = fmt::format("least {}{:.3g} ({})", exact ? "" : "> ", *worst.value, worst.where);
  if (!open.empty()) line.seen += fmt::format("{}open: {}", line.seen.empty() ? "" : "; ", open);
  if (!lost.empty()) line.seen += fmt::format("{}`auto` too late: {}", line.seen.empty() ? "" : "; ", lost);
  line.verdict = at_least(worst.value, kPeerRatio);
  if (!open.empty()) line.verdict = worse(line.verdict, Verdict::NotMeasured);
  if (!lost.empty()) line.verdict = Verdict::Missed;
  return line;
}

/// Fastest repetition of a micro benchmark [s].
std::optional<double> fastest(const Json& all, const std::string& name, long size) {
  for (const Json& r : list_of(all, "micro")) {
    if (text_of(r, "name") == name && r.at("size").get<long>() == size) return number(r, "fastest");
  }
  return std::nullopt;
}

TargetLine reading_line(const Json& all, const std::string& format) {
  constexpr long kSize = 1024;
  const std::optional<double> seconds = fastest(all, "read-" + format, kSize);
  return {fmt::format("read a .{} of {}^2", format, kSize), fmt::format("<= {:g} s", kReadSeconds),
          seconds ? fmt::format("{:.3f} s", *seconds) : "", at_most(seconds, kReadSeconds)};
}

TargetLine npy_line(const Json& all) {
  constexpr long kSize = 4096;
  const std::optional<double> map = fastest(all, "read-npy", kSize), bytes = fastest(all, "read-bytes", kSize);
  std::optional<double> ratio;
  if (map && bytes) ratio = *map / *bytes;
  return {fmt::format("read an .npy of {}^2, over its bytes alone", kSize), fmt::format("<= {:g}", kReadRatio),
          ratio ? fmt::format("{:.2f} ({:.3f} s)", *ratio, *map) : "", at_most(ratio, kReadRatio)};
}

/// The slowest of these planners [points/s]. A planner's path begins with its kind and a colon.
TargetLine planner_line(const Json& all, const std::string& what, const std::vector<std::string>& kinds,
                        double target) {
  Worst worst;
  bool whole = true;
  for (const std::string& kind : kinds) {
    bool seen = false;
    for (const Json& r : list_of(all, "planners")) {
      if (!text_of(r, "path").starts_with(kind + ":") || !r.contains("points")) continue;
      seen = true;
      if (r.at("points").get<double>() < kPlannerPoints) continue;
      worst.see(r.at("points").get<double>() / number(r, "fastest"), text_of(r, "path"), false);
    }
    whole = whole && seen;
  }
  if (!whole) worst.value.reset();
  return {"points a second, " + what, fmt::format(">= {:.0e}", target),
          worst.value ? fmt::format("{:.1e} ({})", *worst.value, worst.where) : "", at_least(worst.value, target)};
}

TargetLine shortening_line(const Json& all) {
  TargetLine line{"2-opt and Or-opt on 10^5 cells, length over (N - 1) pitch in 60 s",
                  fmt::format("<= {:g}", kTourRatio), "", Verdict::NotMeasured};
  for (const Json& r : list_of(all, "planners")) {
    if (!text_of(r, "path").ends_with("improve=2opt") || !r.contains("points")) continue;
    if (r.at("points").get<double>() < 0.5 * kTourPoints) continue;
    const double ratio = number(r, "length_ratio"), seconds = number(r, "seconds");
    line.seen = fmt::format("{:.3f}, {:.1f} s", ratio, seconds);
    line.verdict = worse(at_most(ratio, kTourRatio), at_most(seconds, kTourSeconds));
  }
  return line;
}

TargetLine memory_line(const Json& all) {
  Worst worst;
  for (const Json& run : list_of(all, "results")) {
    if (text_of(run, "solver") != "auto" || !run.contains("solve_memory")) continue;
    const double longest = std::max(number(run, "points"), number(run, "pixels"));
    if (longest < kLargeVector) continue;
    worst.see(number(run, "solve_memory") / (8.0 * longest), text_of(run, "scenario"), true);
  }
  return {"memory of a solve of `auto`, in vectors of 1 MiB or more", fmt::format("<= {:g}", kVectors),
          worst.value ? fmt::format("{:.1f} ({})", *worst.value, worst.where) : "", at_most(worst.value, kVectors)};
}

}  // namespace

std::vector<TargetLine> target_lines(const Json& all) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  std::vector<TargetLine> lines{pairs_line(all, "a-1024-every-4", kPairsTo1Percent, kAny),
                                pairs_line(all, "a-1024-every-1", kPairsTo1Percent, kAny),
                                every_pixel_line(all),
                                pairs_line(all, "e-ibfest-70x30", kPairsOfIbfest, kWallPairsOfIbfest),
                                certificate_line(all),
                                operator_line(all),
                                thread_line(all),
                                reference_line(all),
                                peer_line(all),
                                memory_line(all),
                                planner_line(all, "raster, spiral, hilbert, multi-pitch",
                                             {"raster", "spiral", "hilbert", "multi-pitch"}, kPlannerRate),
                                planner_line(all, "random", {"random"}, kRandomRate),
                                planner_line(all, "nearest", {"nearest"}, kNearestRate),
                                shortening_line(all),
                                reading_line(all, "dat"),
                                reading_line(all, "datx"),
                                npy_line(all)};
  const std::vector<TargetLine> plans = plan_target_lines(all);
  lines.insert(lines.end(), plans.begin(), plans.end());
  return lines;
}

std::string target_table(const Json& all) {
  std::string text = "| what | target | seen | |\n|---|---:|---:|---|\n";
  for (const TargetLine& line : target_lines(all))
    text += fmt::format("| {} | {} | {} | {} |\n", line.what, line.target, line.seen, to_string(line.verdict));
  return text;
}

}  // namespace dwell::bench
