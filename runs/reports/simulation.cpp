#include "runs/reports/simulation.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

#include "core/base/counted.h"
#include "core/base/whole_file.h"
#include "core/form/robust_pv.h"
#include "core/map/part_distance.h"
#include "core/removal/simulate.h"
#include "runs/base/inputs_json.h"
#include "runs/job/job.h"
#include "runs/plan/program_prediction.h"
#include "runs/programs/program_reader.h"
#include "runs/reports/anatomy_lines.h"
#include "runs/reports/exact_lines.h"
#include "runs/reports/residual_advice.h"
#include "runs/reports/tool_sheet.h"

namespace dwell {
namespace {

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
                         const Progress& progress, bool every_pixel, const SimulationSource& source) {
  Simulation s;
  progress.report("read: program, map and removal function");
  s.program = read_program(program, reading, progress);
  s.inputs.push_back({"program", program.string(), sha256_of_file(program)});
  const Job job = load_job(options, progress);
  const Part& part = *job.part;
  s.plan = source.plan;
  if (!s.plan.empty()) s.max_feed = dwell_options(options).machine.feed_limits().max_feed;
  s.differences = source.given;
  for (std::string& difference :
       differences_from_record(read_program_record(program), program.string(), job, source.other, s.plan.empty())) {
    s.differences.push_back(std::move(difference));
  }
  s.inputs.insert(s.inputs.end(), job.inputs.begin(), job.inputs.end());
  s.terms = part.form;
  s.before = part.before;
  s.map = {options.map,        part.map.grid, part.map.history, job.map_pixels, to_string(options.aperture),
           to_string(s.terms), s.before};
  s.tif = part.tif;
  s.volume_factor = part.kernel.volume_factor;
  check_steps(s.program, part);
  const Progress simulating = progress.of_part(fmt::format("simulate {}", counted(s.program.steps.size(), "step")));
  LatticeChoice lattice = choose_lattice(part, removing_steps(s.program).strokes, simulating);
  s.after = predict_program(part, s.program, lattice.kernel, simulating,
                            every_pixel ? ExactCheck::EveryPixel : ExactCheck::Figure);
  while (!s.after.all && lattice_too_coarse(s.after, part.before) && !lattice.finest) {
    lattice = finer_lattice(part, lattice);
    s.after = predict_program(part, s.program, lattice.kernel, simulating);
  }
  s.after.statistics = with_robust_pv(s.after.statistics, s.after.surface, part.threads);
  s.anatomy = residual_anatomy(s.after.surface, part.tif.fwhm, part.form, part.threads, BlemishSearch::On,
                               progress.of_part("what is left"));
  AdviceFacts facts;
  facts.blemishes_left_out = !s.plan.empty() && options.blemishes == BlemishHandling::LeaveOut;
  s.advice = residual_advice(s.anatomy, facts);
  if (auto limit = more_than_before(s.after, s.before)) s.limits.push_back(std::move(*limit));
  return s;
}

std::string simulation_json(const Simulation& s) {
  nlohmann::ordered_json json = json_of_command("simulate");
  json["map"] = map_block(s.map);
  json["tif"] = tif_block(s.tif, kind_of(s.tif), s.tif.samples.history, s.volume_factor);
  json["tool"] = tool_block(tool_sheet(s.tif));
  json["program"] = program_block(program_figures(s.program, s.after, to_string(s.terms), s.max_feed));
  json["anatomy"] = anatomy_block(s.anatomy, s.advice);
  if (!s.plan.empty()) json["plan"] = s.plan;
  json["differences"] = s.differences;
  json["limits"] = s.limits;
  json["inputs"] = inputs_json(s.inputs);
  return json_text(std::move(json));
}

}  // namespace dwell
