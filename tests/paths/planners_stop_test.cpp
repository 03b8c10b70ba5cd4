// Every planner of the catalogue, and every measure of a path, asks whether to stop often enough and ends when told to.
// Counts of questions are compared, not times: a machine may be busy.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "core/base/errors.h"
#include "paths/feed/depth_feed.h"
#include "paths/metrics/path_coverage.h"
#include "paths/metrics/path_metrics.h"
#include "paths/metrics/path_ripple.h"
#include "paths/metrics/path_spacing.h"
#include "paths/path_catalogue.h"
#include "paths/tours/spanning_tree.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using Work = std::function<void(const Progress&)>;

constexpr Index kSide = 500;  // pixels of 1 mm

/// A disc with waves, so that multi-pitch has regions and nearest has islands.
HeightMap big_part() {
  HeightMap map = test::full_map(kSide, kSide);
  for (Index row = 0; row < kSide; ++row) {
    for (Index col = 0; col < kSide; ++col) {
      const double x = static_cast<double>(col) - 0.5 * kSide, y = static_cast<double>(row) - 0.5 * kSide;
      map.at(row, col) =
          std::hypot(x, y) < 0.48 * kSide ? 10.0 * std::sin(0.05 * x) * std::cos(0.03 * y) + 8.0 : std::nan("");
    }
  }
  return map;
}

/// How often the work asks when it is never told to stop.
std::size_t questions(const Work& work) {
  std::size_t asked = 0;
  Progress progress;
  progress.stop = [&] {
    ++asked;
    return false;
  };
  work(progress);
  return asked;
}

/// Told to stop at its n-th question, the work throws and asks no more.
void expect_ends_at(std::size_t n, const Work& work, const std::string& what) {
  std::size_t asked = 0;
  Progress progress;
  progress.stop = [&] { return ++asked >= n; };
  EXPECT_THROW(work(progress), Interrupted) << what << ", question " << n;
  EXPECT_EQ(asked, n) << what;
}

void expect_stops(const Work& work, std::size_t least, const std::string& what) {
  const std::size_t asked = questions(work);
  EXPECT_GE(asked, least) << what;
  for (const std::size_t n : {std::size_t{1}, asked / 2, asked})
    expect_ends_at(std::max<std::size_t>(n, 1), work, what);
}

/// A path of about a point a pixel.
std::string text_for(const PathRecord& record, const std::string& file) {
  if (record.one_value) return record.name + ":" + file;
  if (record.name == "nearest") return "nearest:cell=1,improve=2opt,critical=14";
  if (record.name == "line") return "line:step=0.002,y=250";
  if (record.spacing.empty()) return record.name + ":pitches=2/1,step=1";
  return record.name + ":" + record.spacing + "=1";
}

class PlannersStop : public ::testing::Test {
 protected:
  PlannersStop() : map_(big_part()), tif_(gaussian_removal(5.0, 8.0, 12.0)) {}

  ToolPath raster() const { return plan_path(parse_path_spec("raster:pitch=1"), {map_, tif_, 50.0}); }

  HeightMap map_;
  RemovalFunction tif_;
};

TEST_F(PlannersStop, EveryPlannerOfTheCatalogue) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "dwell_planners_stop.csv";
  {
    std::ofstream out(file);
    out << "x_mm,y_mm\n";
    for (const Point p : raster().points) out << p.x << ',' << p.y << '\n';
  }
  for (const PathRecord& record : path_catalogue()) {
    const std::string text = text_for(record, file.string());
    const PathSpec spec = parse_path_spec(text);
    const auto plan = [&](const Progress& progress) {
      EXPECT_GT(plan_path(spec, {map_, tif_, 50.0, true, progress}).size(), 20'000u);
    };
    expect_stops(plan, record.one_value ? 20u : 30u, text);
  }
  std::filesystem::remove(file);
}

TEST_F(PlannersStop, RoundingCornersToo) {
  const PathSpec sharp = parse_path_spec("raster:pitch=1"), round = parse_path_spec("raster:pitch=1,corner=0.4");
  const auto asked = [&](const PathSpec& spec) {
    return questions([&](const Progress& progress) { plan_path(spec, {map_, tif_, 50.0, false, progress}); });
  };
  EXPECT_GT(asked(round), asked(sharp) + 3);
}

TEST_F(PlannersStop, EveryMeasureOfAPath) {
  const ToolPath path = raster();
  ASSERT_GT(path.size(), 190'000u);
  expect_stops([&](const Progress& p) { path_metrics(path, p); }, 5, "metrics");
  expect_stops([&](const Progress& p) { path_spacing(path, {.reach = 5.0}, p); }, 150, "spacing");
  expect_stops([&](const Progress& p) { path_coverage(path, map_, 0.5, p); }, 150, "coverage");
  expect_stops([&](const Progress& p) { spanning_tree_length(path.points, p); }, 100, "spanning tree");
  expect_stops([&](const Progress& p) { path_ripple(path, tif_, {}, p); }, 5, "ripple");
  const std::vector<double> pitch(path.size(), 1.0);
  expect_stops([&](const Progress& p) { depth_feed(map_, path, pitch, {1.0}, p); }, 500, "depth feed");
}

}  // namespace
}  // namespace dwell
