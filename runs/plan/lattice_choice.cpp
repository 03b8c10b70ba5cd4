#include "runs/plan/lattice_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/random_draw.h"
#include "core/base/random_numbers.h"
#include "core/removal/inner_lattice.h"
#include "core/removal/matched_kernel.h"
#include "core/removal/removal_once.h"

namespace dwell {
namespace {

constexpr double kMostNodes = 1.0e8;  // of an inner lattice with what the tool reaches beyond it: 2.4 GB of transforms
constexpr Index kFinest = 16;         // parts of the longer side of a pixel

// Pixels so many that a coarser lattice is worth looking for, and how much it must save.
constexpr Index kManyPixels = Index{1} << 20;
constexpr Index kLeastSaving = 6;
// Pitches over the removal function's equivalent sigma that are tried, and the largest error with which one is taken.
constexpr double kCoarsePitches[] = {0.25, 0.17};
constexpr double kCoarseError = 3e-3;

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

bool worth_it(const Part& part, CoarseFactor factor) {
  return part.map.grid.size() >= kManyPixels && factor.x * factor.y >= kLeastSaving;
}

LatticeChoice lattice_of(const Part& part, Index parts) {
  LatticeChoice choice;
  const Grid& map = part.map.grid;
  const PixelDivision division = division_of(map, parts);
  choice.kernel =
      division == PixelDivision{} ? part.kernel : pixel_kernel(part.tif, map.pitch_x, map.pitch_y, division);
  choice.finest = 2 * parts > kFinest || !fits(part, division_of(map, 2 * parts));
  return choice;
}

/// The map's own samples, with operators on a lattice of every factor-th pixel.
LatticeChoice coarse_lattice(const Part& part, CoarseFactor factor) {
  LatticeChoice choice;
  choice.kernel = part.kernel;
  choice.kernel.coarse = factor;
  return choice;
}

/// Pixels at random, the same every time.
std::vector<Index> some_pixels(const HeightMap& map) {
  constexpr std::size_t kPixels = 96;
  RandomDraw draw(map.grid.size(), 2);
  std::vector<Index> pixels;
  while (pixels.size() < kPixels && draw.left() > 0) {
    const Index pixel = draw.next();
    if (std::isfinite(map.values[static_cast<std::size_t>(pixel)])) pixels.push_back(pixel);
  }
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

/// Random dwell on the strokes, what it truly removes at some pixels, and what lattices make of it.
class LatticeTrial {
 public:
  LatticeTrial(const Part& part, const std::vector<Stroke>& strokes, const Progress& progress)
      : part_(part), strokes_(strokes), progress_(progress), pixels_(some_pixels(part.map)) {
    const std::vector<double> seconds = random_dwell(strokes);
    const RemovalProbe probe(part.map.grid, part.exact, strokes, seconds);
    exact_ = mean_removal(probe, part.map.grid, pixels_, part.threads, progress);
    dwell_ = Vector::Map(seconds.data(), static_cast<Index>(seconds.size()));
  }

  /// |removal - exact| at the pixels.
  double error(const RemovalKernel& kernel) const {
    const InnerLattice inner = divide_pixels(part_.map.grid, pixels_, kernel.division);
    progress_.step(fmt::format("the lattice of {} x {} nodes", inner.grid.rows / kernel.coarse.y,
                               inner.grid.cols / kernel.coarse.x));
    return (removal_once(inner.grid, inner.pixels, kernel, strokes_, dwell_, part_.threads) - exact_).norm();
  }

  double norm() const { return exact_.norm(); }
  /// Of what is not the same at all pixels. Random dwell has all waves, and the error of a pitch too coarse is in the
  /// shortest ones that the tool removes; the mean, which any lattice holds, would hide it.
  double deviation() const { return (exact_.array() - exact_.mean()).matrix().norm(); }

 private:
  const Part& part_;
  const std::vector<Stroke>& strokes_;
  const Progress& progress_;
  std::vector<Index> pixels_;
  Vector exact_, dwell_;
};

std::optional<LatticeChoice> choose_coarse(const Part& part, const LatticeTrial& trial) {
  for (const double pitch : kCoarsePitches) {
    const CoarseFactor factor = coarse_factor(part.kernel, pitch);
    if (!worth_it(part, factor)) break;
    LatticeChoice choice = coarse_lattice(part, factor);
    const double error = trial.error(choice.kernel);
    choice.error = trial.norm() > 0.0 ? error / trial.norm() : 0.0;
    if (error <= kCoarseError * trial.deviation()) return choice;
  }
  return std::nullopt;
}

}  // namespace

LatticeChoice choose_lattice(const Part& part, const std::vector<Stroke>& strokes, const Progress& progress) {
  const LatticeTrial trial(part, strokes, progress);
  if (auto coarse = choose_coarse(part, trial)) return *coarse;
  for (Index parts = 1;;) {
    LatticeChoice choice = lattice_of(part, parts);
    choice.error = trial.norm() > 0.0 ? trial.error(choice.kernel) / trial.norm() : 0.0;
    if (choice.error <= kLatticeError || choice.finest) return choice;
    parts = parts < 4 ? parts + 1 : 2 * parts;
  }
}

std::string lattice_words(const RemovalKernel& kernel) {
  const CoarseFactor coarse = kernel.coarse;
  if (coarse == CoarseFactor{}) return fmt::format("{} x {} cells a pixel", kernel.division.x, kernel.division.y);
  return fmt::format("one node in {} x {} pixels", coarse.x, coarse.y);
}

LatticeChoice finer_lattice(const Part& part, const LatticeChoice& lattice) {
  if (lattice.finest) return lattice;
  const CoarseFactor half{lattice.kernel.coarse.x / 2, lattice.kernel.coarse.y / 2};
  if (worth_it(part, half)) return coarse_lattice(part, half);
  if (lattice.kernel.coarse != CoarseFactor{}) return lattice_of(part, 1);
  return lattice_of(part, 2 * parts_of(lattice.kernel.division));
}

}  // namespace dwell
