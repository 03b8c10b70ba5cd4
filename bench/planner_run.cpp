#include "bench/planner_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "bench/json_access.h"
#include "bench/mirror.h"
#include "paths/path_metrics.h"
#include "paths/path_spec.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

constexpr Index kPixels = 512;
constexpr int kRepetitions = 3;

/// The path that makes about `points` points of a square part of 512 mm.
struct PlannerCase {
  const char* kind;
  const char* options;  // {0} = pitch
};

constexpr PlannerCase kCases[] = {{"raster", "pitch={0}"}, {"nearest", "cell={0},critical=-inf"}};

Json run_case(const std::string& text, const PathJob& job, double pitch) {
  const PathSpec spec = parse_path_spec(text);
  std::vector<double> seconds;
  ToolPath path;
  for (int k = 0; k < kRepetitions && (k == 0 || seconds.front() < 10.0); ++k) {
    const auto begin = std::chrono::steady_clock::now();
    path = plan_path(spec, job);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(seconds.begin(), seconds.end());
  const PathMetrics metrics = path_metrics(path);
  const double steps = static_cast<double>(std::max<Index>(metrics.points - 1, 1));
  return {{"path", text},
          {"points", metrics.points},
          {"repetitions", seconds.size()},
          {"seconds", seconds[seconds.size() / 2]},
          {"fastest", seconds.front()},
          {"slowest", seconds.back()},
          {"lifts", metrics.lifts},
          {"length_ratio", metrics.point_length / (steps * pitch)},
          {"notes", path.notes}};
}

}  // namespace

Json run_planners(bool quick, const Budget& budget, double share) {
  HeightMap map(Grid{kPixels, kPixels, 1.0, 1.0, {}});
  for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = static_cast<double>(i % kPixels);
  const RemovalFunction tif = gaussian_removal(5.0, 8.0, 12.0);
  const PathJob job{map, tif, 50.0};
  const double points = quick ? 1e5 : 1e6;
  const double pitch = static_cast<double>(kPixels) / std::sqrt(points);
  Json results = Json::array();
  for (const PlannerCase& c : kCases) {
    const std::string text = fmt::format("{}:{}", c.kind, fmt::format(fmt::runtime(c.options), pitch));
    if (budget.left(share) > 0.0) {
      results.push_back(run_case(text, job, pitch));
    } else {
      results.push_back({{"path", text}, {"skipped", "no time left"}});
    }
  }
  return results;
}

std::string planner_table(const Json& planners) {
  std::string text =
      "| path | points | median s | band s | points a second | lifts | length over (N - 1) pitch |\n"
      "|---|---:|---:|---:|---:|---:|---:|\n";
  for (const Json& r : planners) {
    text += fmt::format("| `{}` |", text_of(r, "path"));
    if (r.contains("skipped")) {
      text += fmt::format(" skipped: {} | | | | | |\n", text_of(r, "skipped"));
      continue;
    }
    text += fmt::format(" {} | {:.3g} | {:.3g} to {:.3g} | {:.2g} | {} | {:.3f} |\n", r.at("points").get<long>(),
                        number(r, "seconds"), number(r, "fastest"), number(r, "slowest"),
                        static_cast<double>(r.at("points").get<long>()) / number(r, "fastest"),
                        r.at("lifts").get<long>(), number(r, "length_ratio"));
  }
  return text;
}

}  // namespace dwell::bench
