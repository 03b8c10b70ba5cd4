#include "bench/scenario.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/form/form.h"
#include "core/removal/removal_geometry.h"
#include "runs/plan/usual_smoothness.h"
#include "solvers/matched/time_price.h"

namespace dwell::bench {

const Scenario& find_scenario(const std::vector<Scenario>& all, const std::string& name) {
  std::string known;
  for (const Scenario& s : all) {
    if (s.name == name) return s;
    known += (known.empty() ? "" : ", ") + s.name;
  }
  throw InputError(fmt::format("--scenario = '{}'; accepted: {}", name, known));
}

Instance make_instance(const Scenario& scenario, int threads) {
  Part part;
  LaidPath laid;
  double least = 0.0;
  {
    Parts parts = scenario.make();
    laid.strokes = parts.moving ? moving_strokes(parts.path) : halting_strokes(parts.path);
    laid.path = std::move(parts.path);
    part.map = std::move(parts.map);
    part.tif = std::move(parts.tif);
    least = parts.least;
  }
  const Grid& grid = part.map.grid;
  part.kernel = removal_kernel(part.tif, grid.pitch_x, grid.pitch_y);
  auto geometry = std::make_shared<RemovalGeometry>();
  geometry->lattice = grid;
  geometry->pixels = finite_pixels(part.map);
  geometry->kernel = part.kernel;
  geometry->strokes = laid.strokes;
  geometry->threads = threads;
  Instance i;
  i.map = grid;
  i.energy = part.kernel.energy;
  i.usual_smoothness = usual_smoothness(part, laid);
  i.removal = make_removal_operator(*geometry);
  DwellProblem& p = i.problem;
  p.removal = i.removal.get();
  p.target.resize(static_cast<Index>(geometry->pixels.size()));
  for (std::size_t k = 0; k < geometry->pixels.size(); ++k)
    p.target[static_cast<Index>(k)] = part.map.values[static_cast<std::size_t>(geometry->pixels[k])];
  p.form = form_basis(grid, geometry->pixels, {true, true, false});
  remove_form(p.form, p.target);
  p.lower = Vector::Constant(i.removal->cols(), least);
  PathSmoothness smoothness = path_smoothness(laid.path, geometry->strokes, threads);
  p.parts = {{std::move(geometry), std::move(smoothness)}};
  return i;
}

void set_weights(Instance& instance, const ScenarioWeights& weights) {
  DwellProblem& p = instance.problem;
  p.alpha = weights.smoothness * instance.energy;
  p.gamma = weights.time_price * static_cast<double>(p.pixels());
}

FoundWeights find_usual_weights(Instance& instance) {
  FoundWeights found;
  found.weights.smoothness = instance.usual_smoothness;
  set_weights(instance, found.weights);
  const TimePrice price = find_time_price(instance.problem, TimeWorth{}, {});
  found.weights.time_price = price.price;
  found.price_rule = price.rule == PriceRule::Share ? "share" : "average";
  set_weights(instance, found.weights);
  return found;
}

}  // namespace dwell::bench
