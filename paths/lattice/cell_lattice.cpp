#include "paths/lattice/cell_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/base/numbers.h"
#include "core/base/point.h"
#include "core/base/poll.h"
#include "paths/domain/feed_direction.h"
#include "paths/domain/point_limit.h"
#include "paths/domain/rounding.h"

namespace dwell {
namespace {

void check(const LatticeOptions& o, double overrun, const char* planner) {
  const auto refuse = [&](const char* option, double value, const char* unit, const char* required) {
    throw InputError(fmt::format("{}: {} = {}{}; required {}", planner, option, value, unit, required));
  };
  if (!(o.pitch > 0.0)) refuse("pitch", o.pitch, " mm", "> 0");
  if (!std::isfinite(o.pitch)) refuse("pitch", o.pitch, " mm", "finite");
  if (!(overrun >= 0.0)) refuse("overrun", overrun, " mm", ">= 0");
  if (!std::isfinite(overrun)) refuse("overrun", overrun, " mm", "finite");
  if (!std::isfinite(o.angle_deg)) refuse("angle", o.angle_deg, " degrees", "finite");
}

/// Bounding box of the valid pixel centres in the frame (along, across).
Box turned_box(const HeightMap& map, const CellLattice& lattice, const char* planner, const Progress& progress) {
  Box box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (Index row = 0; row < map.grid.rows; ++row) {
    progress.check();
    for (Index col = 0; col < map.grid.cols; ++col) {
      if (!std::isfinite(map.at(row, col))) continue;
      const Point p = map.grid.centre(row, col);
      const Point q{dot(p, lattice.along), dot(p, lattice.across)};
      box.low = {std::min(box.low.x, q.x), std::min(box.low.y, q.y)};
      box.high = {std::max(box.high.x, q.x), std::max(box.high.y, q.y)};
    }
  }
  if (box.low.x <= box.high.x) return box;
  throw InputError(fmt::format("{}: the map has no finite pixel; at least one is required", planner));
}

void lay_out(CellLattice& lattice, const Box& box, double overrun, const char* planner) {
  lattice.middle = midpoint(box.low, box.high);
  const auto fit = [&](double extent) {
    return std::floor((extent + 2.0 * overrun) / lattice.pitch + kRounding) + 1.0;
  };
  const double cols = fit(box.high.x - box.low.x);
  const double rows = fit(box.high.y - box.low.y);
  if (!(rows * cols <= kMaxPathPoints)) {
    throw InputError(fmt::format(
        "{}: pitch = {} mm makes a lattice of {:.6g} x {:.6g} points, {:.3g} in all; at most {:.0e} accepted, make "
        "pitch larger",
        planner, lattice.pitch, rows, cols, rows * cols, kMaxPathPoints));
  }
  lattice.rows = static_cast<Index>(rows);
  lattice.cols = static_cast<Index>(cols);
}

/// Whether a point lies in the rectangle of a valid pixel.
class PixelUnder {
 public:
  explicit PixelUnder(const HeightMap& map)
      : map_(map), per_x_(1.0 / map.grid.pitch_x), per_y_(1.0 / map.grid.pitch_y) {}

  bool valid(Point p) const {
    const double col = (p.x - map_.grid.origin.x) * per_x_ + 0.5, row = (p.y - map_.grid.origin.y) * per_y_ + 0.5;
    if (!(col >= 0.0 && row >= 0.0)) return false;
    if (!(col < static_cast<double>(map_.grid.cols) && row < static_cast<double>(map_.grid.rows))) return false;
    return std::isfinite(map_.at(static_cast<Index>(row), static_cast<Index>(col)));
  }

 private:
  const HeightMap& map_;
  double per_x_, per_y_;
};

/// The reach is at least half a pixel's diagonal, so that points on valid pixels need no distances; these are made when
/// the first other point comes.
void keep_within_reach(CellLattice& lattice, const HeightMap& map, const char* planner, const Progress& progress) {
  Poll poll(progress);
  lattice.kept.resize(static_cast<std::size_t>(lattice.rows * lattice.cols));
  const PixelUnder pixel_under(map);
  std::size_t cell = 0;
  for (Index row = 0; row < lattice.rows; ++row) {
    for (Index col = 0; col < lattice.cols; ++col, ++cell) {
      poll.step();
      const Point p = lattice.at(row, col);
      if (!pixel_under.valid(p)) {
        if (!lattice.domain) lattice.domain.emplace(map, lattice.reach, planner, "overrun", progress);
        if (!lattice.domain->contains(p)) continue;
      }
      lattice.kept[cell] = 1;
      ++lattice.kept_cells;
    }
  }
}

}  // namespace

std::vector<std::string> lattice_keys(std::initializer_list<std::string_view> others) {
  std::vector<std::string> keys{"pitch", "overrun", "angle"};
  for (const std::string_view key : others) keys.emplace_back(key);
  return keys;
}

LatticeOptions parse_lattice_options(const SpecText& spec) {
  LatticeOptions options;
  options.pitch = spec.number("pitch");
  options.overrun = spec.optional_number("overrun");
  options.angle_deg = spec.number("angle", options.angle_deg);
  return options;
}

std::vector<PathDistance> lattice_distances(const LatticeOptions& options) { return {{"pitch", options.pitch}}; }

CellLattice cell_lattice(const HeightMap& map, const LatticeOptions& options, const char* planner,
                         const Progress& progress) {
  const double overrun = options.overrun.value_or(0.0);
  check(options, overrun, planner);
  CellLattice lattice;
  lattice.pitch = options.pitch;
  lattice.along = feed_direction(options.angle_deg);
  lattice.across = {-lattice.along.y, lattice.along.x};
  lay_out(lattice, turned_box(map, lattice, planner, progress), overrun, planner);
  const double between_pixels = 0.5 * std::hypot(map.grid.pitch_x, map.grid.pitch_y);
  lattice.reach = std::max({overrun, options.pitch / std::numbers::sqrt2, between_pixels});
  keep_within_reach(lattice, map, planner, progress);
  return lattice;
}

}  // namespace dwell
