#include "bench/planner_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "bench/json_access.h"
#include "core/base/random_numbers.h"
#include "paths/metrics/path_metrics.h"
#include "paths/path_catalogue.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

constexpr Index kPixels = 512;
constexpr int kRepetitions = 3;

/// What makes about one point a pitch^2. Every planner of the catalogue that takes a pitch has a case; that of
/// cross-hatch is wider, because it covers the part twice.
std::vector<std::string> cases(double pitch) {
  std::vector<std::string> texts;
  for (const PathRecord& record : path_catalogue()) {
    if (record.spacing != "pitch") continue;  // cells of nearest neighbours: run_planners
    const bool crosses = record.name == "cross-hatch";
    texts.push_back(fmt::format("{}:pitch={}", record.name, crosses ? std::sqrt(2.0) * pitch : pitch));
    if (record.name == "raster") texts.push_back(fmt::format("raster:pitch={},turn=arc", pitch));
  }
  texts.push_back(fmt::format("multi-pitch:pitches={}/{}/{},step={}", 1.5 * pitch, pitch, 0.75 * pitch, pitch));
  return texts;
}

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

/// A map of n x n pixels of 1 mm, correlated over some two of them.
HeightMap kept_cells(Index n) {
  constexpr int kReach = 6;
  RandomNumbers random(7);
  HeightMap noise(Grid{n + 2 * kReach, n + 2 * kReach, 1.0, 1.0, {}});
  for (double& v : noise.values) v = random.uniform() - 0.5;
  std::vector<double> bell;
  for (int k = -kReach; k <= kReach; ++k) bell.push_back(std::exp(-k * k / 8.0));
  HeightMap along(Grid{n + 2 * kReach, n, 1.0, 1.0, {}}), map(Grid{n, n, 1.0, 1.0, {}});
  for (Index r = 0; r < along.grid.rows; ++r) {
    for (Index c = 0; c < n; ++c) {
      double sum = 0.0;
      for (int k = 0; k <= 2 * kReach; ++k) sum += bell[static_cast<std::size_t>(k)] * noise.at(r, c + k);
      along.at(r, c) = sum;
    }
  }
  for (Index r = 0; r < n; ++r) {
    for (Index c = 0; c < n; ++c) {
      double sum = 0.0;
      for (int k = 0; k <= 2 * kReach; ++k) sum += bell[static_cast<std::size_t>(k)] * along.at(r + k, c);
      map.at(r, c) = sum;
    }
  }
  return map;
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
  const auto add = [&](const std::string& text, const PathJob& on, double spacing) {
    if (budget.left(share) > 0.0) {
      results.push_back(run_case(text, on, spacing));
    } else {
      results.push_back({{"path", text}, {"skipped", "no time left"}});
    }
  };
  for (const std::string& text : cases(pitch)) add(text, job, pitch);
  // Its cells are no smaller than the pixels.
  const HeightMap cells = kept_cells(quick ? 316 : 1000);
  add("nearest:cell=1,critical=-inf", {cells, tif, 50.0}, 1.0);
  // Half of the cells lie above zero, in islands of all sizes.
  const HeightMap waves = kept_cells(quick ? 140 : 447);
  add("nearest:cell=1", {waves, tif, 50.0}, 1.0);
  add("nearest:cell=1,improve=2opt", {waves, tif, 50.0}, 1.0);
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
