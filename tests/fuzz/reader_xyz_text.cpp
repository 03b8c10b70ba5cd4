#include <cmath>

#include "core/formats/no_data.h"
#include "core/formats/point_grid.h"
#include "core/formats/xyz_text.h"
#include "core/map/scattered_surface.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

/// A surface fitted to the points, on a grid of few pixels: finite wherever it has data.
void fit(const dwell::XyzText& xyz) {
  std::vector<dwell::HeightPoint> points;
  for (const dwell::XyzPoint& point : xyz.points) {
    if (std::abs(point.height) < dwell::kLeastMarker) points.push_back({point.position, point.height});
  }
  if (points.empty()) return;
  const dwell::Grid all = dwell::grid_over(points, 1e11, {});
  const dwell::Grid grid{4, 5, 0.3, 0.7, all.origin};
  dwell::ScatterSummary summary;
  const dwell::HeightMap map = dwell::scattered_surface(points, grid, {}, summary, 1);
  for (const double value : map.values) dwell::fuzz::require(!std::isinf(value));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [data, size](std::string_view bytes) {
    dwell::names_xyz_columns(bytes);
    const dwell::XyzText xyz = dwell::parse_xyz_text(bytes, "map");
    dwell::fuzz::read(data, size, [&](std::string_view) { fit(xyz); });
    const dwell::HeightMap map = dwell::grid_points(xyz.points, xyz.header.pitch, xyz.header.origin, "map", "map");
    // Points may be far apart, but what is made of them is bounded by their number.
    constexpr std::size_t kMostPixels = 1000000;
    dwell::fuzz::require(map.values.size() <= kMostPixels);
    dwell::Index with_height = 0;
    for (const dwell::XyzPoint& point : xyz.points) {
      const double col = std::round((point.position.x - map.grid.origin.x) / map.grid.pitch_x);
      const double row = std::round((point.position.y - map.grid.origin.y) / map.grid.pitch_y);
      dwell::fuzz::require(col >= 0 && col < static_cast<double>(map.grid.cols));
      dwell::fuzz::require(row >= 0 && row < static_cast<double>(map.grid.rows));
      const double height = map.at(static_cast<dwell::Index>(row), static_cast<dwell::Index>(col));
      dwell::fuzz::require(height == point.height || (std::isnan(height) && std::isnan(point.height)));
      if (!std::isnan(point.height)) ++with_height;
    }
    dwell::fuzz::require(map.valid_pixels() == with_height);
  });
}
