#include "bench/opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "bench/json_access.h"
#include "bench/plan_targets.h"
#include "bench/solver_tables.h"
#include "bench/targets.h"
#include "runs/drawing/line_chart.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

constexpr double kLeastGap = 1e-4;
constexpr double kManyPoints = 1e4;
constexpr std::size_t kMostCurves = 9;            // that the key has room for, in the order of the solvers' turns
constexpr const char* kDrawn = "a-1024-every-4";  // whose curves are drawn, if it was measured

/// A scenario on which `auto` was measured and has a reference.
struct Place {
  std::string name;
  double points = 0.0;
  std::optional<double> seconds;  // to 1 %
  std::optional<PeerRatio> peer;
};

std::vector<Place> places_of(const Json& all) {
  std::vector<Place> places;
  for (const Json& scenario : list_of(all, "scenarios")) {
    const std::string name = text_of(scenario, "name");
    const Json run = find_run(all, name, "auto", 2);
    if (scenario.at("reference").is_null() || run.is_null() || !run.contains("reached")) continue;
    places.push_back({name, number(run, "points"), seconds_to_1_percent(run), peer_ratio(all, name)});
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.points < b.points; });
  return places;
}

std::string sentence_of_auto(const std::vector<Place>& places) {
  if (places.empty()) return "How fast `auto` solves was not measured in this run.";
  std::size_t there = 0;
  double slowest = 0.0;
  for (const Place& p : places) {
    if (!p.seconds) continue;
    ++there;
    slowest = std::max(slowest, *p.seconds);
  }
  return fmt::format(
      "The default solver `auto` comes within 1 % of the optimum on {} of {} problems of {:.0f} to {:.0f} dwell "
      "points, "
      "on two threads in at most {:.3g} s.",
      there, places.size(), places.front().points, places.back().points, slowest);
}

std::string sentence_of_peers(const std::vector<Place>& places) {
  std::size_t large = 0, compared = 0, late = 0;
  std::optional<PeerRatio> least;
  std::string where;
  for (const Place& p : places) {
    if (p.points < kManyPoints) continue;
    ++large;
    if (!p.peer) continue;
    ++compared;
    late += p.peer->peer.empty() ? 1 : 0;
    if (least && !(p.peer->ratio < least->ratio)) continue;
    least = p.peer;
    where = p.name;
  }
  if (!least) return "Other people's solvers were not compared on large problems in this run.";
  return fmt::format(
      "Other people's solvers (L-BFGS-B, SciPy, NLopt, Ceres), given the same problem, take at least {}{:.3g} times as "
      "long ({}); they were compared on {} of {} problems of {:.0f} dwell points or more, and on {} of them no such "
      "solver "
      "was there when its time was up.",
      least->exact ? "" : "more than ", least->ratio, where, compared, large, kManyPoints,
      late == 0 ? "none" : fmt::format("{}", late));
}

std::string sentence_of_plans(const Json& all) {
  const Json narrow = find_plan(all, "4096-narrow-moving"), wide = find_plan(all, "4096-wide-moving");
  if (!narrow.contains("seconds") || !wide.contains("seconds"))
    return "Whole plans of 4096 x 4096 pixels were not measured in this run.";
  return fmt::format(
      "A whole `dwell plan` of 4096 x 4096 pixels, from the map's file to the machine's program, takes {:.3g} s with a "
      "tool of sigma 17 pixels ({} dwell points) and {:.3g} s with one of 82 ({}), in at most {:.2g} GiB.",
      number(narrow, "seconds"), narrow.at("points").get<long>(), number(wide, "seconds"),
      wide.at("points").get<long>(), std::max(number(narrow, "peak_memory"), number(wide, "peak_memory")) / 0x1p30);
}

std::string sentence_of_mirror(const Json& all) {
  const Json plan = find_plan(all, "udo-default"), published = find_plan(all, "udo-published-moving");
  if (!plan.contains("residual_rms") || !published.contains("residual_rms"))
    return "The measured mirror udo-raster was not planned in this run.";
  const auto without = [](const Json& of) {
    const double rms = number(of, "without_blemishes");
    return std::isfinite(rms) ? fmt::format(" ({:.4f} nm without blemishes)", rms) : std::string();
  };
  return fmt::format(
      "On the measured mirror udo-raster the default plan leaves {:.4f} nm RMS{} in {:.1f} s of machine time, where "
      "the "
      "published dwell leaves {:.4f} nm{} in {:.1f} s.",
      number(plan, "residual_rms"), without(plan), number(plan, "total_dwell"), number(published, "residual_rms"),
      without(published), number(published, "total_dwell"));
}

std::string sentence_of_targets(const Json& all) {
  std::size_t met = 0, missed = 0, open = 0;
  for (const TargetLine& line : target_lines(all)) {
    met += line.verdict == Verdict::Met ? 1 : 0;
    missed += line.verdict == Verdict::Missed ? 1 : 0;
    open += line.verdict == Verdict::NotMeasured ? 1 : 0;
  }
  return fmt::format("Of the {} aims below {} are met, {} missed and {} not measured.", met + missed + open, met,
                     missed, open);
}

/// A dot of its own: scenarios are no curve, even if they are sorted.
ChartLine dot(const std::string& label, Colour colour, double x, double y) { return {label, colour, {{x, y}}}; }

ChartPanel time_panel(const std::vector<Place>& places) {
  constexpr Colour kOwn{214, 39, 40}, kPeer{20, 60, 160}, kNobody{127, 127, 127};
  ChartPanel panel{"dwell points", "time to within 1 % of the optimum [s]", {}};
  panel.title = "every scenario, two threads";
  for (const Place& p : places) {
    if (!p.seconds) continue;
    panel.lines.push_back(dot("auto", kOwn, p.points, *p.seconds));
    if (!p.peer) continue;
    const bool late = p.peer->peer.empty();
    panel.lines.push_back(dot(late ? "no peer there by then" : "fastest peer", late ? kNobody : kPeer, p.points,
                              p.peer->ratio * *p.seconds));
  }
  return panel;
}

Colour colour_of(std::size_t place) {
  constexpr std::array<Colour, 12> kColours{{{214, 39, 40},
                                             {31, 119, 180},
                                             {44, 160, 44},
                                             {255, 127, 14},
                                             {148, 103, 189},
                                             {140, 86, 75},
                                             {227, 119, 194},
                                             {23, 190, 207},
                                             {188, 189, 34},
                                             {127, 127, 127},
                                             {0, 0, 0},
                                             {0, 90, 50}}};
  return kColours[place % kColours.size()];
}

/// Quality against time, as steps, because a solver that is stopped between two points returns what it had at the
/// first. A gap of zero, or below the least that is drawn, lies on the lower edge.
ChartPanel gap_panel(const Json& all, const std::string& scenario, double reference) {
  ChartPanel panel{"time since the start of the solve [s]", "objective above the optimum [%]", {}};
  panel.title = scenario;
  panel.y_limits = ChartLimits{100.0 * kLeastGap, 1000.0};
  for (const Json& run : list_of(all, "results")) {
    if (text_of(run, "scenario") != scenario || run.at("threads").get<int>() != 2 || !run.contains("trace")) continue;
    ChartLine line{text_of(run, "solver"), colour_of(panel.lines.size()), {}, false};
    line.steps = true;
    for (const Json& p : run.at("trace")) {
      if (!(p.at(0).get<double>() > 0.0)) continue;  // a logarithmic axis has no place for the start
      line.points.push_back(
          {p.at(0).get<double>(), 100.0 * std::max(p.at(2).get<double>() / reference - 1.0, kLeastGap)});
    }
    if (line.points.size() > 1 && panel.lines.size() < kMostCurves) panel.lines.push_back(std::move(line));
  }
  return panel;
}

/// The scenario whose curves are drawn: that of kDrawn, or else the largest.
std::string drawn_scenario(const std::vector<Place>& places) {
  for (const Place& p : places) {
    if (p.name == kDrawn) return p.name;
  }
  return places.empty() ? "" : places.back().name;
}

}  // namespace

std::string opening_sentences(const Json& all) {
  const std::vector<Place> places = places_of(all);
  return fmt::format("{} {} {} {} {}\n", sentence_of_auto(places), sentence_of_peers(places), sentence_of_plans(all),
                     sentence_of_mirror(all), sentence_of_targets(all));
}

std::string opening_picture(const Json& all) {
  const std::vector<Place> places = places_of(all);
  std::vector<ChartPanel> panels{time_panel(places)};
  const std::string drawn = drawn_scenario(places);
  for (const Json& scenario : list_of(all, "scenarios")) {
    if (text_of(scenario, "name") == drawn && !scenario.at("reference").is_null())
      panels.push_back(gap_panel(all, drawn, number(scenario.at("reference"), "objective")));
  }
  return draw_line_charts("How long a solve takes", "", panels);
}

}  // namespace dwell::bench
