#include "runs/plan/lattice_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/random_numbers.h"
#include "core/removal/inner_lattice.h"
#include "core/removal/scattered_removal.h"

namespace dwell {
namespace {

constexpr double kMostNodes = 1.0e8;  // of an inner lattice with what the tool reaches beyond it: 2.4 GB of transforms
constexpr Index kFinest = 16;         // parts of the longer side of a pixel

/// Divides pixels into about square cells, `parts` along their longer side.
PixelDivision division_of(const Grid& map, Index parts) {
  const double pitch = std::max(map.pitch_x, map.pitch_y) / static_cast<double>(parts);
  const auto count = [&](double side) {
    return std::max<Index>(1, static_cast<Index>(std::ceil(side / pitch - 1e-9)));
  };
  return parts == 1 ? PixelDivision{} : PixelDivision{count(map.pitch_x), count(map.pitch_y)};
}

bool fits(const Part& part, PixelDivision division) {
  const Grid& map = part.map.grid;
  const auto nodes = [&](Index pixels, double pitch, Index parts) {
    return static_cast<double>(parts) * (static_cast<double>(pixels) + 2.0 * part.tif.radius / pitch);
  };
  return nodes(map.rows, map.pitch_y, division.y) * nodes(map.cols, map.pitch_x, division.x) <= kMostNodes;
}

Index parts_of(PixelDivision division) { return std::max(division.x, division.y); }

LatticeChoice lattice_of(const Part& part, Index parts) {
  LatticeChoice choice;
  const Grid& map = part.map.grid;
  const PixelDivision division = division_of(map, parts);
  choice.kernel =
      division == PixelDivision{} ? part.kernel : pixel_kernel(part.tif, map.pitch_x, map.pitch_y, division);
  choice.finest = 2 * parts > kFinest || !fits(part, division_of(map, 2 * parts));
  return choice;
}

/// Pixels at random, the same every time.
std::vector<Index> some_pixels(const HeightMap& map) {
  constexpr std::size_t kPixels = 96;
  std::vector<Index> pixels = finite_pixels(map);
  RandomNumbers random(2);
  const std::size_t count = std::min(kPixels, pixels.size());
  for (std::size_t k = 0; k < count; ++k) random.draw(pixels, k);
  pixels.resize(count);
  std::sort(pixels.begin(), pixels.end());
  return pixels;
}

/// A dwell that a solver might find where the tool's reach ends: a time a length between nothing and twice its mean, at
/// random.
std::vector<double> random_dwell(const std::vector<Stroke>& strokes) {
  RandomNumbers random(3);
  std::vector<double> seconds;
  seconds.reserve(strokes.size());
  for (const Stroke& s : strokes) {
    const double length = s.length();
    seconds.push_back((length > 0.0 ? length : 1.0) * random.uniform());
  }
  return seconds;
}

}  // namespace

LatticeChoice choose_lattice(const Part& part, const std::vector<Stroke>& strokes, const Progress& progress) {
  const std::vector<Index> pixels = some_pixels(part.map);
  const std::vector<double> seconds = random_dwell(strokes);
  const RemovalProbe probe(part.map.grid, part.exact, strokes, seconds);
  const Vector exact = mean_removal(probe, part.map.grid, pixels, part.threads, progress);
  const Vector dwell = Vector::Map(seconds.data(), static_cast<Index>(seconds.size()));
  for (Index parts = 1;;) {
    LatticeChoice choice = lattice_of(part, parts);
    const InnerLattice inner = divide_pixels(part.map.grid, pixels, choice.kernel.division);
    progress.step(fmt::format("the lattice of {} x {} nodes", inner.grid.rows, inner.grid.cols));
    const Vector removal = removal_once(inner.grid, inner.pixels, choice.kernel, strokes, dwell, part.threads);
    const double norm = exact.norm();
    choice.error = norm > 0.0 ? (removal - exact).norm() / norm : 0.0;
    if (choice.error <= kLatticeError || choice.finest) return choice;
    parts = parts < 4 ? parts + 1 : 2 * parts;
  }
}

LatticeChoice finer_lattice(const Part& part, const LatticeChoice& lattice) {
  if (lattice.finest) return lattice;
  return lattice_of(part, 2 * parts_of(lattice.kernel.division));
}

}  // namespace dwell
