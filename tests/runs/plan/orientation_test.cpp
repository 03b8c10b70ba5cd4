/// The whole chain must keep its bearings: a bump at (+x, +y off-centre) is taken away where it is, by a tool without
/// symmetry, whatever format the map comes in, whichever way the raster runs and whichever dialect is written.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "core/base/whole_file.h"
#include "core/removal/simulate.h"
#include "runs/job/place_option.h"
#include "runs/job/planned_job.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"
#include "runs/reports/simulation.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

constexpr Point kPitch{0.5, 0.4};
constexpr Index kRows = 55, kCols = 60;
constexpr Point kOrigin{-9.0, 3.0};
constexpr Point kBump{12.0, 17.5};  // the middle of the map is (5.75, 13.75)

double gauss(double x, double y, double sigma) { return std::exp(-0.5 * (x * x + y * y) / (sigma * sigma)); }

/// A bump with a shoulder [nm].
double height(double x, double y) {
  return 100.0 * gauss(x - kBump.x, y - kBump.y, 1.8) + 60.0 * gauss(x - kBump.x + 3.0, y - kBump.y - 1.0, 1.8);
}

/// A spot with one lobe to +x and a smaller one to +y [nm/s], negligible 3.5 mm from the axis.
double rate(double x, double y) {
  return 10.0 * gauss(x, y, 0.75) + 6.0 * gauss(x - 1.4, y, 0.6) + 4.0 * gauss(x + 0.2, y - 1.7, 0.55);
}

std::string matrix_csv(Index rows, Index cols, Point origin, double (*value)(double, double)) {
  std::string text = fmt::format("# pitch_mm: {},{}\n# origin_mm: {},{}\n", kPitch.x, kPitch.y, origin.x, origin.y);
  for (Index r = 0; r < rows; ++r) {
    for (Index c = 0; c < cols; ++c) {
      text += fmt::format(
          "{}{:.9g}", c > 0 ? "," : "",
          value(origin.x + kPitch.x * static_cast<double>(c), origin.y + kPitch.y * static_cast<double>(r)));
    }
    text += '\n';
  }
  return text;
}

/// Column by column from the largest x down, so that the order of the lines says nothing.
std::string xyz() {
  std::string text = "x y z\n";
  for (Index c = kCols; c-- > 0;) {
    for (Index r = 0; r < kRows; ++r) {
      const double x = kOrigin.x + kPitch.x * static_cast<double>(c), y = kOrigin.y + kPitch.y * static_cast<double>(r);
      text += fmt::format("{} {} {:.9g}\n", x, y, height(x, y));
    }
  }
  return text;
}

/// numpy.save of a C-ordered array of little-endian doubles.
std::string npy() {
  std::string header = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", kRows, kCols);
  while ((10 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  for (Index r = 0; r < kRows; ++r) {
    for (Index c = 0; c < kCols; ++c) {
      const double z =
          height(kOrigin.x + kPitch.x * static_cast<double>(c), kOrigin.y + kPitch.y * static_cast<double>(r));
      bytes.append(reinterpret_cast<const char*>(&z), sizeof z);
    }
  }
  return bytes;
}

struct Case {
  const char* format;
  double angle;
};

/// What a Case is called in messages.
void PrintTo(const Case& c, std::ostream* out) { *out << c.format << " at " << c.angle << " degrees"; }

class Orientation : public testing::TestWithParam<Case> {
 protected:
  test::TemporaryFolder folder;

  JobOptions options() const {
    JobOptions o;
    const std::string format = GetParam().format;
    o.map = folder
                .file("map." + format, format == "csv"   ? matrix_csv(kRows, kCols, kOrigin, height)
                                       : format == "xyz" ? xyz()
                                                         : npy())
                .string();
    if (format == "npy") {
      o.map_pixel_mm = kPitch;
      o.map_origin_mm = kOrigin;
    }
    o.tif = folder.file("tif.csv", matrix_csv(19, 15, {-3.5, -3.6}, rate)).string();
    o.tif_centre = parse_tif_centre("0,0");
    o.path = parse_path_spec(fmt::format("raster:pitch=0.5,angle={}", GetParam().angle));
    o.remove = {};
    o.max_feed_mm_per_min = 1e5;  // so fast that passing removes next to nothing
    o.smoothness = {1e-4};
    o.threads = 1;
    return o;
  }
};

double rms_difference(const HeightMap& removal, double flip_x, double flip_y) {
  const Grid& g = removal.grid;
  const Point middle{0.5 * (g.x(0) + g.x(g.cols - 1)), 0.5 * (g.y(0) + g.y(g.rows - 1))};
  double sum = 0.0;
  for (Index i = 0; i < g.size(); ++i) {
    const Point p = g.centre(i);
    const double z = height(middle.x + flip_x * (p.x - middle.x), middle.y + flip_y * (p.y - middle.y));
    sum += std::pow(removal.values[static_cast<std::size_t>(i)] - z, 2);
  }
  return std::sqrt(sum / static_cast<double>(g.size()));
}

Point centroid(const Grid& g, const std::vector<double>& weights) {
  double sum = 0.0;
  Point moment;
  for (Index i = 0; i < g.size(); ++i) {
    sum += weights[static_cast<std::size_t>(i)];
    moment = moment + weights[static_cast<std::size_t>(i)] * g.centre(i);
  }
  return (1.0 / sum) * moment;
}

void expect_removal_at_the_bump(const HeightMap& removal) {
  const Grid& g = removal.grid;
  ASSERT_EQ(g, (Grid{kRows, kCols, kPitch.x, kPitch.y, kOrigin}));
  ASSERT_EQ(removal.valid_pixels(), g.size());
  std::vector<double> bump;
  for (Index i = 0; i < g.size(); ++i) bump.push_back(height(g.centre(i).x, g.centre(i).y));
  EXPECT_LE(distance(centroid(g, removal.values), centroid(g, bump)), kPitch.x);
  const double here = rms_difference(removal, 1, 1),
               before = std::sqrt(Eigen::Map<Eigen::VectorXd>(bump.data(), g.size()).squaredNorm() /
                                  static_cast<double>(g.size()));
  EXPECT_LE(here, 0.05 * before);
  for (const auto& [fx, fy] : {std::pair{-1.0, 1.0}, {1.0, -1.0}, {-1.0, -1.0}})
    EXPECT_GT(rms_difference(removal, fx, fy), 10.0 * here);
}

struct TableRow {
  double x, y, dwell;
};

/// The points and dwells of feed.csv, read without the program's own reader.
std::vector<TableRow> table_rows(const std::string& text) {
  std::vector<TableRow> rows;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    TableRow row{};
    long sequence = 0;
    if (std::sscanf(line.c_str(), "%ld,%lf,%lf,%lf", &sequence, &row.x, &row.y, &row.dwell) == 4) rows.push_back(row);
  }
  return rows;
}

/// What the rows remove with the spot's own formula, mirrored by (fx, fy). Dwell points 0.5 mm apart stand for their
/// strokes: the spot is several times wider.
Eigen::VectorXd removal_by_formula(const Grid& grid, const std::vector<TableRow>& rows, double fx, double fy) {
  constexpr double kReach = 4.5;
  Eigen::VectorXd removal = Eigen::VectorXd::Zero(grid.size());
  for (Index i = 0; i < grid.size(); ++i) {
    const Point p = grid.centre(i);
    for (const TableRow& row : rows) {
      const double dx = fx * (p.x - row.x), dy = fy * (p.y - row.y);
      if (std::max(std::abs(dx), std::abs(dy)) < kReach) removal[i] += row.dwell * rate(dx, dy);
    }
  }
  return removal;
}

/// As it was measured first, then mirrored in x, in y and in both.
std::array<Eigen::VectorXd, 4> removals_by_formula(const Grid& grid, const std::vector<TableRow>& rows) {
  return {removal_by_formula(grid, rows, 1, 1), removal_by_formula(grid, rows, -1, 1),
          removal_by_formula(grid, rows, 1, -1), removal_by_formula(grid, rows, -1, -1)};
}

void expect_tool_as_measured(const HeightMap& removal, const std::array<Eigen::VectorXd, 4>& by_formula) {
  const Eigen::Map<const Eigen::VectorXd> simulated(removal.values.data(), removal.grid.size());
  EXPECT_LE((simulated - by_formula[0]).norm(), 0.03 * by_formula[0].norm());
  for (std::size_t mirrored = 1; mirrored < 4; ++mirrored)
    EXPECT_GT((simulated - by_formula[mirrored]).norm(), 0.12 * by_formula[mirrored].norm()) << mirrored;
}

TEST_P(Orientation, BumpIsRemovedWhereItIsByTheToolAsMeasured) {
  JobOptions o = options();
  o.out = (folder.path() / "plan").string();
  PlannedJob plan = plan_job(o, {});
  std::array<Eigen::VectorXd, 4> by_formula;
  for (const char* dialect : {"g94", "g93-per-minute", "g93-seconds"}) {
    plan.job.options.gcode = parse_gcode_dialect(dialect);
    OutputFolder out(o.out, plan_files());
    write_plan(plan, out, {});
    out.commit();
    const auto rows = table_rows(read_whole_file(std::filesystem::path(o.out) / "feed.csv"));
    ASSERT_EQ(rows.size(), plan.laid.path.size());
    if (by_formula[0].size() == 0)
      by_formula = removals_by_formula(plan.part().map.grid, rows);  // the dialect changes none
    for (const char* name : {"program.nc", "feed.csv"}) {
      SCOPED_TRACE(fmt::format("{} {}", dialect, name));
      const Simulation read_back = simulate_file(std::filesystem::path(o.out) / name, {}, o, {});
      const HeightMap removal = simulate(read_back.program, plan.part().map, plan.part().kernel, 1);
      expect_removal_at_the_bump(removal);
      EXPECT_LE(read_back.after.statistics.rms, 0.05 * read_back.before.rms);
      expect_tool_as_measured(removal, by_formula);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Chain, Orientation,
                         testing::Values(Case{"csv", 0}, Case{"csv", 37}, Case{"xyz", 0}, Case{"xyz", 37},
                                         Case{"npy", 0}, Case{"npy", 37}),
                         [](const auto& test) {
                           return fmt::format("{}_{}deg", test.param.format, static_cast<int>(test.param.angle));
                         });

}  // namespace
}  // namespace dwell
