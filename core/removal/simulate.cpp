#include "core/removal/simulate.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/removal/exact_removal.h"
#include "core/removal/scattered_removal.h"

namespace dwell {
namespace {

/// A map from the values of its finite pixels, NaN elsewhere.
HeightMap on_pixels(const Grid& grid, const std::vector<Index>& pixels, const Vector& values) {
  HeightMap result(grid);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    result.values[static_cast<std::size_t>(pixels[i])] = values[static_cast<Index>(i)];
  return result;
}

}  // namespace

RemovingSteps removing_steps(const Program& program) {
  RemovingSteps removing;
  for (const ProgramStep& step : program.steps) {
    if (!step.removes) continue;
    removing.strokes.push_back({step.start, midpoint(step.start, step.finish), step.finish});
    removing.seconds.push_back(step.seconds);
  }
  return removing;
}

HeightMap simulate(const Program& program, const HeightMap& map, const RemovalKernel& kernel, int threads) {
  const RemovingSteps removing = removing_steps(program);
  const std::vector<Index> pixels = finite_pixels(map);
  const Vector seconds = Vector::Map(removing.seconds.data(), static_cast<Index>(removing.seconds.size()));
  return on_pixels(map.grid, pixels, removal_once(map.grid, pixels, kernel, removing.strokes, seconds, threads));
}

HeightMap simulate_exactly(const Program& program, const HeightMap& map, const RemovalFunction& tif, int threads,
                           const Progress& progress) {
  constexpr std::size_t kRun = 500;  // steps between two reports
  const RemovingSteps removing = removing_steps(program);
  const std::vector<Index> pixels = finite_pixels(map);
  Vector removal = Vector::Zero(static_cast<Index>(pixels.size()));
  const std::size_t count = removing.strokes.size();
  for (std::size_t first = 0; first < count; first += kRun) {
    progress.step(fmt::format("{:.0f} %", 100.0 * static_cast<double>(first) / static_cast<double>(count)));
    const std::size_t size = std::min(kRun, count - first);
    const std::vector<Stroke> run(removing.strokes.begin() + static_cast<std::ptrdiff_t>(first),
                                  removing.strokes.begin() + static_cast<std::ptrdiff_t>(first + size));
    const Vector seconds = Vector::Map(removing.seconds.data() + first, static_cast<Index>(size));
    removal += exact_removal_once(map.grid, pixels, tif, run, seconds, threads);
  }
  return on_pixels(map.grid, pixels, removal);
}

HeightMap surface_after(const HeightMap& map, const HeightMap& removal) {
  HeightMap after = map;
  for (std::size_t i = 0; i < after.values.size(); ++i) after.values[i] -= removal.values[i];
  return after;
}

}  // namespace dwell
