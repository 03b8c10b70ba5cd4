#include <algorithm>
#include <cmath>

#include "core/formats/sdf_text.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    const dwell::MapSource source = dwell::parse_sdf_text(bytes, "map");
    dwell::fuzz::require_sound(source);
    const auto& values = source.values;
    if (std::any_of(values.begin(), values.end(), [](double v) { return std::isinf(v); })) return;
    // What was read is written so that it reads back equal.
    const dwell::HeightMap map({source.rows, source.cols, source.header.pitch->x, source.header.pitch->y,
                                source.header.origin.value_or(dwell::Point{})},
                               values);
    const dwell::MapSource again = dwell::parse_sdf_text(dwell::sdf_text(map), "map");
    dwell::fuzz::require(again.header.pitch == source.header.pitch && again.header.origin == map.grid.origin);
    dwell::fuzz::require(std::equal(values.begin(), values.end(), again.values.begin(), again.values.end(),
                                    [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }));
  });
}
