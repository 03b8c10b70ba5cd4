#include <gtest/gtest.h>

#include <ostream>

#include "core/form/map_statistics.h"
#include "core/formats/map_io.h"
#include "paths/metrics/path_metrics.h"
#include "paths/tours/nearest_neighbour.h"
#include "paths/tours/spanning_tree.h"

namespace dwell {
namespace {

/// Xie et al. 2022, section 3.1: the share of length that the nearest-neighbour path saves against a raster over all
/// cells, with the critical value 0 on a map of mean 0. Theirs is 41.15 % on a map that is not published; these are the
/// figures of docs/papers.md, "S1", on the demo map of data/. The greedy path is compared to the last digit printed
/// there (it depends on nothing but the map), the improved one may be shorter.
struct Saving {
  double cell;
  Index cells, kept;
  double raster, greedy, longest, improved, lower;

  friend std::ostream& operator<<(std::ostream& out, const Saving& s) { return out << "cell " << s.cell << " mm"; }
};

class ImprovedPrim : public ::testing::TestWithParam<Saving> {};

TEST_P(ImprovedPrim, SavesOnTheDemoMapWhatThePageSays) {
  const Saving& expected = GetParam();
  const HeightMap map = without_form(read_map(DWELL_SOURCE_DIR "/data/mirror.csv"), {true, false, false});
  NearestOptions options;
  options.cell = expected.cell;
  const NearestPath greedy = nearest_path(map, options);
  const PathMetrics before = path_metrics(greedy.path);
  EXPECT_EQ(greedy.cells_total, expected.cells);
  EXPECT_EQ(before.points, expected.kept);
  EXPECT_DOUBLE_EQ(static_cast<double>(greedy.cells_total - 1) * expected.cell, expected.raster);
  EXPECT_NEAR(before.point_length, expected.greedy, 0.06);
  EXPECT_NEAR(before.longest_jump, expected.longest, 0.006);
  EXPECT_NEAR(spanning_tree_length(greedy.path.points), expected.lower, 0.06);
  options.improve = true;
  const double after = path_metrics(nearest_path(map, options).path).point_length;
  EXPECT_LE(after, 1.005 * expected.improved);
  EXPECT_GE(after, expected.lower - 0.06);
}

INSTANTIATE_TEST_SUITE_P(Cells, ImprovedPrim,
                         ::testing::Values(Saving{10.0, 88, 41, 870.0, 523.6, 67.08, 438.2, 421.6},
                                           Saving{2.0, 2032, 931, 4062.0, 2291.5, 45.12, 1926.8, 1908.3},
                                           Saving{1.0, 7960, 3595, 7959.0, 4272.7, 60.73, 3667.3, 3636.4}));

}  // namespace
}  // namespace dwell
