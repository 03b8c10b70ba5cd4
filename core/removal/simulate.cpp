#include "core/removal/simulate.h"

#include "core/motion/cubic_move.h"
#include "core/removal/inner_lattice.h"
#include "core/removal/removal_once.h"

namespace dwell {
namespace {

// A step whose speed changes is cut into so many parts if it begins or ends at rest (places_on).
constexpr double kPartsFromRest = 12.0;

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
  const auto add = [&removing](Point start, Point finish, double seconds) {
    removing.strokes.push_back({start, midpoint(start, finish), finish});
    removing.seconds.push_back(seconds);
  };
  for (const ProgramStep& step : program.steps) {
    if (!step.removes) continue;
    if (!step.speeds) {
      add(step.start, step.finish, step.seconds);
      continue;
    }
    const std::vector<Point> places =
        places_on({step.start, step.finish, step.speeds->in, step.speeds->out, step.seconds}, kPartsFromRest);
    for (std::size_t k = 1; k < places.size(); ++k)
      add(places[k - 1], places[k], step.seconds / static_cast<double>(places.size() - 1));
  }
  return removing;
}

HeightMap simulate(const Program& program, const HeightMap& map, const RemovalKernel& kernel, int threads) {
  const RemovingSteps removing = removing_steps(program);
  const std::vector<Index> pixels = finite_pixels(map);
  const Vector seconds = Vector::Map(removing.seconds.data(), static_cast<Index>(removing.seconds.size()));
  const InnerLattice lattice = divide_pixels(map.grid, pixels, kernel.division);
  return on_pixels(map.grid, pixels,
                   removal_once(lattice.grid, lattice.pixels, kernel, removing.strokes, seconds, threads));
}

HeightMap surface_after(const HeightMap& map, const HeightMap& removal) {
  HeightMap after = map;
  for (std::size_t i = 0; i < after.values.size(); ++i) after.values[i] -= removal.values[i];
  return after;
}

}  // namespace dwell
