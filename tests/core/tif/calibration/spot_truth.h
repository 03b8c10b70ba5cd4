#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/map/height_map.h"

namespace dwell::test {

/// Normal noise that is the same everywhere: sums of twelve uniform numbers of a specified engine.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}
  double operator()() {
    double sum = -6.0;
    for (int k = 0; k < 12; ++k) sum += static_cast<double>(engine_() >> 11U) * 0x1p-53;
    return sum;
  }

 private:
  std::mt19937_64 engine_;
};

/// A tool without any symmetry [nm/s]: a lobe to +x, a smaller one to +y; nothing beyond 3.2 mm.
inline double tool_rate(Point d) {
  const auto gauss = [](double x, double y, double s) { return std::exp(-0.5 * (x * x + y * y) / (s * s)); };
  return 8.0 * gauss(d.x, d.y, 0.7) + 5.0 * gauss(d.x - 1.1, d.y + 0.1, 0.5) + 2.5 * gauss(d.x + 0.2, d.y - 1.2, 0.45);
}

/// A part with tilt [nm].
inline double tilted(Point p) { return 30.0 + 4.0 * p.x - 2.5 * p.y; }

/// The surface after the tool stood at each place for `seconds`.
inline HeightMap after_spots(const Grid& grid, const std::vector<Point>& places, double seconds, double noise,
                             std::uint64_t seed) {
  HeightMap map(grid);
  Noise random(seed);
  for (Index i = 0; i < grid.size(); ++i) {
    const Point p = grid.centre(i);
    double z = tilted(p) + noise * random();
    for (const Point q : places) z -= seconds * tool_rate(p - q);
    map.values[static_cast<std::size_t>(i)] = z;
  }
  return map;
}

}  // namespace dwell::test
