#include "runs/reports/simulation.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/whole_file.h"
#include "core/map/part_distance.h"
#include "core/removal/simulate.h"
#include "runs/base/inputs_json.h"
#include "runs/job/job.h"
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

/// Refuses a tool at work far from the part. Lifted moves may come from anywhere.
void check_steps(const Program& program, const Part& part) {
  std::size_t number = 0;
  for (const ProgramStep& step : program.steps) {
    ++number;
    if (!step.removes) continue;
    for (const Point p : {step.start, step.finish}) {
      check_near_part(p, part.map.grid, part.tif.radius, [&] {
        return fmt::format("{}: the place of the tool at work in step {}", program.file, number);
      });
    }
  }
}

}  // namespace

Simulation simulate_file(const std::filesystem::path& program, const GcodeReading& reading, const JobOptions& options,
                         const Progress& progress, bool exact) {
  Simulation s;
  progress.report("read: program, map and removal function");
  s.program = read_program(program, reading, progress);
  s.inputs.push_back({"program", program.string(), sha256_of_file(program)});
  const Job job = load_job(options, progress);
  const Part& part = *job.part;
  s.inputs.insert(s.inputs.end(), job.inputs.begin(), job.inputs.end());
  s.terms = part.form;
  s.before = part.before;
  s.map = {options.map,        part.map.grid, part.map.history, job.map_pixels, to_string(options.aperture),
           to_string(s.terms), s.before};
  s.tif = part.tif;
  s.volume_factor = part.kernel.volume_factor;
  check_steps(s.program, part);
  progress.step(fmt::format("simulate: {} steps", s.program.steps.size()));
  s.removal = simulate(s.program, part.map, part.kernel, part.threads);
  if (exact) {
    HeightMap removal =
        simulate_exactly(s.program, part.map, part.tif, part.threads, progress.of_part("simulate exactly"));
    s.spline_error = spline_error(s.removal, removal);
    s.removal = std::move(removal);
  }
  progress.check();
  s.residual = without_form(surface_after(part.map, s.removal), s.terms, part.threads);
  s.after = map_statistics(s.residual, {}, part.threads);
  return s;
}

std::string simulation_json(const Simulation& s) {
  nlohmann::ordered_json json = json_of_command("simulate");
  json["map"] = map_block(s.map);
  json["tif"] = tif_block(s.tif, kind_of(s.tif), s.tif.samples.history, s.volume_factor);
  json["program"] = program_block(program_figures(s.program, s.after, to_string(s.terms)));
  if (s.spline_error) {
    json["spline_error"] = {{"rms_nm", s.spline_error->rms}, {"largest_nm", s.spline_error->largest}};
  }
  json["inputs"] = inputs_json(s.inputs);
  return json_text(std::move(json));
}

}  // namespace dwell
