#include "core/point_grid.h"
#include "core/xyz_text.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    dwell::names_xyz_columns(bytes);
    const dwell::XyzText xyz = dwell::parse_xyz_text(bytes, "map");
    const dwell::HeightMap map = dwell::grid_points(xyz.points, xyz.header.pitch, xyz.header.origin, "map", "map");
    // Points may be far apart, but what is made of them is bounded by their number.
    constexpr std::size_t kMostPixels = 1000000;
    dwell::fuzz::require(map.values.size() <= kMostPixels);
  });
}
