#include "runs/figure/store/new_run.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/errors.h"
#include "core/formats/map_io.h"
#include "runs/base/json_blocks.h"
#include "runs/drawing/picture.h"
#include "runs/figure/store/figure_state.h"
#include "runs/figure/store/kept_inputs.h"
#include "runs/figure/store/step_records.h"
#include "runs/job/job.h"
#include "runs/job/job_file.h"
#include "runs/job/planned_job.h"

namespace dwell {
namespace {

/// Refuses what a run cannot be steered by.
void check(const NewRun& run) {
  if (!run.options.log.empty() || !run.options.log_plan.empty())
    throw InputError("--log, --log-plan: a log belongs to a run that was made; give it to dwell figure measured");
  if (!run.options.removal.empty() || run.options.piston_nm)
    throw InputError(
        "--removal, --piston: a run goes from one measured map to the next, whose level no instrument "
        "measures; required --map without them");
  if (!run.options.line_profile.empty())
    throw InputError("--line-profile: a run goes from one map to the next; required --map (dwell profile --write-map)");
  if (run.target.empty()) return;
  if (run.options.time_price_nm2_per_s.kind != GoalKind::Auto || run.options.time_price_nm2_per_s.value != 0.0)
    throw InputError("--target with --time-price: the target steers the price of time; required one of the two");
}

}  // namespace

MadeRun make_run(const std::filesystem::path& folder, const NewRun& run, const Progress& progress) {
  check(run);
  const std::vector<SurfaceLimit> limits = limits_of_target(run.target, run.bands);
  check_weights(run.options);
  check_exports(run.options);
  if (!run.options.path.given())
    throw InputError("--path: required; for instance raster:pitch=1, nearest:cell=2 or file:path.csv");
  const Job job = load_job(run.options, progress);
  path_input(run.options);  // that its file is there
  const Part& part = *job.part;
  const std::vector<SurfaceVerdict> verdicts = judge_surface(part.map, part.form, limits, part.threads, progress);
  nlohmann::ordered_json content{{"target", run.target},
                                 {"bands", run.bands},
                                 {"removed", to_string(part.form)},
                                 {"before", statistics_record(part.before)},
                                 {"verdicts", verdict_records(verdicts)},
                                 {"map", grid_block(part.map.grid)},
                                 {"tool", {{"fwhm_mm", part.tif.fwhm}, {"peak_nm_per_s", part.tif.peak}}}};
  progress.step("writing");
  RunFolder made = make_run_folder(folder, [&](const OutputFolder& step) {
    JobOptions kept = keep_inputs(run.options, step);
    kept.out.clear();
    step.write("job.toml", job_file_text(kept));
    write_map(step.path("map.npy"), part.map);
    const std::string title =
        fmt::format("Before the first run: {} ({} removed)", in_words(part.before), to_string(part.form));
    step.write("before.png", map_picture(part.figure, {title, "nm", true, {}, {}}, FigureFormat::Png, progress));
    return content;
  });
  return {std::move(made), part.before, verdicts, part.tif};
}

}  // namespace dwell
