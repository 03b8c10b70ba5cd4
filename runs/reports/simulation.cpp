#include "runs/reports/simulation.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/threads.h"
#include "core/base/whole_file.h"
#include "core/map/aperture.h"
#include "core/removal/simulate.h"
#include "core/tif/removal_kernel.h"
#include "runs/base/inputs_json.h"
#include "runs/programs/program_reader.h"

namespace dwell {
namespace {

SplineError spline_error(const HeightMap& spline, const HeightMap& exact) {
  SplineError error;
  const std::vector<Index> pixels = finite_pixels(exact);
  for (const Index i : pixels) {
    const double d = spline.values[static_cast<std::size_t>(i)] - exact.values[static_cast<std::size_t>(i)];
    error.rms += d * d / static_cast<double>(pixels.size());
    error.largest = std::max(error.largest, std::abs(d));
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

}  // namespace

Simulation simulate_file(const std::filesystem::path& program, std::optional<GcodeDialect> dialect,
                         const JobOptions& options, const Progress& progress, bool exact) {
  Simulation s;
  progress.report("read: program, map and removal function");
  s.program = read_program(program, dialect);
  s.inputs.push_back({"program", program.string(), sha256_of_file(program)});
  HeightMap whole = load_map(options, s.inputs, progress);
  const Index valid_pixels = whole.valid_pixels();
  const HeightMap map = within(std::move(whole), parse_aperture(options.aperture));
  const RemovalFunction tif = load_removal_function(options, s.inputs);
  check_tool_fits(tif, map.grid);
  const RemovalKernel kernel = removal_kernel(tif, map.grid.pitch_x, map.grid.pitch_y);
  s.terms = parse_form_terms(options.remove);
  s.before = map_statistics(map, s.terms, thread_count(options.threads));
  s.map = {options.map, map.grid, map.history, valid_pixels, options.aperture, to_string(s.terms), s.before};
  s.tif = tif;
  s.volume_factor = kernel.volume_factor;
  progress.check();
  progress.report(fmt::format("simulate: {} steps", s.program.steps.size()));
  s.removal = simulate(s.program, map, kernel, thread_count(options.threads));
  if (exact) {
    HeightMap removal =
        simulate_exactly(s.program, map, tif, thread_count(options.threads), progress.of_part("simulate exactly"));
    s.spline_error = spline_error(s.removal, removal);
    s.removal = std::move(removal);
  }
  progress.check();
  s.residual = without_form(surface_after(map, s.removal), s.terms, thread_count(options.threads));
  s.after = map_statistics(s.residual, {}, thread_count(options.threads));
  return s;
}

std::string simulation_json(const Simulation& s) {
  nlohmann::ordered_json json = json_of_command("simulate");
  json["map"] = map_block(s.map);
  json["tif"] = tif_block(s.tif, kind_of(s.tif), s.tif.samples.history, s.volume_factor);
  json["program"] = program_block(program_figures(s.program, s.after));
  if (s.spline_error) {
    json["spline_error"] = {{"rms_nm", s.spline_error->rms}, {"largest_nm", s.spline_error->largest}};
  }
  json["inputs"] = inputs_json(s.inputs);
  return json.dump(2) + "\n";
}

}  // namespace dwell
