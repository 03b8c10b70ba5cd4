#include "runs/plan/plan_output.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/units.h"
#include "core/base/version.h"
#include "core/formats/map_io.h"
#include "core/formats/npy.h"
#include "core/removal/simulate.h"
#include "runs/drawing/path_picture.h"
#include "runs/drawing/picture.h"
#include "runs/plan/plan_summary.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/program_reader.h"

namespace dwell {
namespace {

void write_program(Plan& plan, const OutputFolder& folder) {
  plan.table.version = version();
  std::vector<std::string> header = {fmt::format("dwell {}", version())};
  for (const InputFile& input : plan.inputs) {
    plan.table.inputs.emplace_back(input.role + " " + input.file, input.sha256);
    header.push_back(fmt::format("input: {} {} sha256={}", input.role, input.file, input.sha256));
  }
  const ProgramWriting writing{parse_gcode_dialect(plan.options.gcode), plan.options.lift_height_mm, header};
  for (const WrittenProgram& program : written_programs(plan.table, writing)) folder.write(program.file, program.bytes);
}

void write_pictures(const Plan& plan, const HeightMap& after, const MapStatistics& left, const OutputFolder& folder) {
  const std::string removed = to_string(plan.terms);
  folder.write("before.png", map_picture(plan.figure, {fmt::format("Before: RMS {:.4g} nm, PV {:.4g} nm ({} removed)",
                                                                   plan.before.rms, plan.before.pv, removed),
                                                       "nm",
                                                       true,
                                                       {},
                                                       {}}));
  folder.write("after.png",
               map_picture(after, {fmt::format("After (simulated program): RMS {:.4g} nm, PV {:.4g} nm ({} removed)",
                                               left.rms, left.pv, removed),
                                   "nm",
                                   true,
                                   {},
                                   {}}));
  folder.write(
      "dwell.png",
      dwell_picture(
          plan.path, plan.table.dwell_s,
          {fmt::format("Dwell: {} points, total {:.4g} s", plan.path.size(), plan.dwell.sum()), "s", false, {}, {}}));
  const std::string path = fmt::format("Path: {}, {} points, {:.4g} mm, {} lifts", plan.path.kind, plan.path.size(),
                                       plan.metrics.length, plan.metrics.lifts);
  folder.write("path.png", path_picture(plan.figure, plan.path, path));
  folder.write("path_detail.png", path_detail_picture(plan.figure, plan.path, "Path, detail: " + plan.path.kind));
}

bool differs(double a, double b, double tolerance) {
  return !(std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b)));
}

/// feed.csv and program.nc are two writings of one program: they must remove the same. Where their steps differ by more
/// than rounding, what the table removes is simulated as well.
bool compare_with_table(Plan& plan, const Program& program, const MapStatistics& simulated, const Program& table) {
  if (same_removing_steps(program, table, units::mm_per_s(plan.options.max_feed_mm_per_min))) return true;
  const MapStatistics from_table = map_statistics(
      surface_after(plan.map, simulate(table, plan.map, plan.kernel, plan.threads)), plan.terms, plan.threads);
  if (differs(simulated.rms, from_table.rms, 1e-3)) {
    plan.limits.push_back(
        fmt::format("program.nc leaves {:.6g} nm RMS but feed.csv {:.6g} nm", simulated.rms, from_table.rms));
  }
  return false;
}

}  // namespace

WrittenPlan write_plan(Plan& plan, const OutputFolder& folder, const Progress& progress) {
  progress.report("write: feed table and program");
  write_program(plan, folder);
  progress.check();

  progress.report("simulate: the program as read back from disk");
  const Program program = read_program(folder.path("program.nc"));
  WrittenPlan written;
  written.residual = without_form(surface_after(plan.map, simulate(program, plan.map, plan.kernel, plan.threads)),
                                  plan.terms, plan.threads);
  written.simulated = map_statistics(written.residual, {}, plan.threads);
  written.program_seconds = program.total_seconds();
  if (differs(written.simulated.rms, plan.residual.rms, kSimulationTolerance)) {
    plan.limits.push_back(fmt::format("the simulated program leaves {:.4g} nm RMS, the solver expected {:.4g} nm",
                                      written.simulated.rms, plan.residual.rms));
  }
  if (!(written.simulated.rms <= plan.before.rms)) {
    plan.limits.push_back(fmt::format("the program leaves more than there was: {:.4g} nm RMS, before {:.4g} nm",
                                      written.simulated.rms, plan.before.rms));
  }
  written.table_has_same_steps =
      compare_with_table(plan, program, written.simulated, program_of(read_feed_table(folder.path("feed.csv"))));
  progress.check();

  progress.report("write: pictures and arrays");
  write_pictures(plan, written.residual, written.simulated, folder);
  write_map(folder.path("residual.npy"), written.residual);
  folder.write("dwell.npy", npy_bytes(std::span<const double>(plan.table.dwell_s)));
  if (plan.search) folder.write("search.csv", search_table_text(*plan.search));
  written.summary = plan_summary_text(plan, written);
  folder.write("summary.json", written.summary);
  progress.check();
  return written;
}

}  // namespace dwell
