#include <cmath>

#include "core/formats/point_grid.h"
#include "core/formats/xyz_text.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    dwell::names_xyz_columns(bytes);
    const dwell::XyzText xyz = dwell::parse_xyz_text(bytes, "map");
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
