#include "bench/scenario.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/form/form.h"
#include "core/removal/removal_geometry.h"

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
  const Parts parts = scenario.make();
  const Grid& grid = parts.map.grid;
  auto geometry = std::make_shared<RemovalGeometry>();
  geometry->lattice = grid;
  geometry->pixels = finite_pixels(parts.map);
  geometry->kernel = removal_kernel(parts.tif, grid.pitch_x, grid.pitch_y);
  geometry->strokes = parts.moving ? moving_strokes(parts.path) : halting_strokes(parts.path);
  geometry->threads = threads;
  Instance i;
  i.removal = make_removal_operator(*geometry);
  DwellProblem& p = i.problem;
  p.removal = i.removal.get();
  p.target.resize(static_cast<Index>(geometry->pixels.size()));
  for (std::size_t k = 0; k < geometry->pixels.size(); ++k)
    p.target[static_cast<Index>(k)] = parts.map.values[static_cast<std::size_t>(geometry->pixels[k])];
  p.form = form_basis(grid, geometry->pixels, {true, true, false});
  remove_form(p.form, p.target);
  p.lower = Vector::Constant(i.removal->cols(), parts.least);
  const double rms = std::sqrt(p.target.squaredNorm() / static_cast<double>(p.target.size()));
  p.alpha = scenario.smoothness * geometry->kernel.energy;
  p.gamma = scenario.price * rms * parts.tif.volume / (grid.pitch_x * grid.pitch_y);
  PathSmoothness smoothness = path_smoothness(parts.path, geometry->strokes, threads);
  p.parts = {{std::move(geometry), std::move(smoothness)}};
  return i;
}

}  // namespace dwell::bench
