#include "runs/campaigns/path_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/base/value_range.h"
#include "paths/domain/widest_place.h"
#include "paths/metrics/path_coverage.h"
#include "paths/tours/spanning_tree.h"
#include "runs/job/option_flags.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"

namespace dwell {
namespace {

PsdCurve radial_spectrum(const HeightMap& map, int threads) {
  PsdOptions options;
  options.threads = threads;
  return radial_psd(areal_psd(map, options));
}

/// The ripple on a square where the part is widest; a corner of it may lie beyond the disc by the overrun of the path.
void find_ripple(const Part& part, const LaidPath& laid, ComparedPath& path, const Progress& progress) {
  const WidestPlace place = widest_place(part.figure, progress);
  PathRippleOptions options;
  options.threads = part.threads;
  options.centre = place.centre;
  options.side = std::min(8.0 * part.tif.radius, std::numbers::sqrt2 * place.radius);
  try {
    path.ripple = path_ripple(laid.path, part.tif, options, progress);
    path.ripple->removal = {};
  } catch (const InputError& error) {
    path.no_ripple = error.what();
  }
}

std::optional<RippleSpectrum> waves_of(const HeightMap& residual, int threads) {
  try {
    return ripple_spectrum(residual, {}, threads);
  } catch (const InputError&) {
    return std::nullopt;  // the map can show no part of the band
  }
}

void measure(const Part& part, const LaidPath& laid, double pitch, ComparedPath& path, const Progress& progress) {
  progress.step("path: spacing, coverage, spanning tree");
  path.kind = laid.path.kind;
  path.metrics = laid.metrics;
  path.notes = laid.path.notes;
  path.spacing = path_spacing(laid.path, {.reach = 4.0 * part.tif.radius}, progress);
  progress.check();
  path.coverage = path_coverage(laid.path, part.figure, pitch, progress).share();
  progress.check();
  path.tree_length = spanning_tree_length(laid.path.points, progress);
  progress.step("path: ripple at constant feed");
  find_ripple(part, laid, path, progress);
  progress.check();
}

void plan_one(Job job, double pitch, ComparedPath& path, const OutputFolder& folder, const Progress& progress) {
  job.options.path = parse_path_spec(path.listed.text);
  job.options.out = (std::filesystem::path(job.options.out) / path.listed.name).string();
  JobPath laid = lay_job_path(job, 0.0, progress);
  measure(*job.part, laid.laid, pitch, path, progress);
  const PlannedJob plan = plan_job(std::move(job), std::move(laid), progress);
  OutputFolder own(folder.path(path.listed.name), plan_files());
  const WrittenPlan written = write_plan(plan, own, progress);
  own.commit();
  path.limits = written.limits;
  path.residual_rms = written.exact.statistics.rms;
  path.residual_pv = written.exact.statistics.pv;
  path.residual_pvr = written.exact.statistics.pvr;
  path.spectrum = radial_spectrum(written.exact.surface, plan.part().threads);
  path.residual_ripple = waves_of(written.exact.surface, plan.part().threads);
  path.dwell_total = plan.dwell.seconds.sum();
  path.dwell_min = plan.dwell.seconds.minCoeff();
  path.dwell_max = plan.dwell.seconds.maxCoeff();
  path.step_rms = plan.dwell.step_rms;
  path.lift_time = written.travel.lifted;
  path.total_time = written.run_seconds;
  path.solver = plan.dwell.solver;
  path.program = written.program;
}

std::array<double, 3> costs(const ComparedPath& p) { return {p.residual_rms, p.mid_rms().value_or(0.0), p.total_time}; }

bool dominates(const ComparedPath& a, const ComparedPath& b) {
  const std::array<double, 3> x = costs(a), y = costs(b);
  bool better = false;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!(x[k] <= y[k])) return false;
    better = better || x[k] < y[k];
  }
  return better;
}

void collect_limits(PathComparison& comparison) {
  for (const ComparedPath& p : comparison.paths) {
    if (!p.failure.empty()) comparison.limits.push_back(fmt::format("{}: no plan: {}", p.listed.name, p.failure));
    for (const std::string& limit : p.limits) comparison.limits.push_back(fmt::format("{}: {}", p.listed.name, limit));
  }
}

}  // namespace

double default_pitch(const RemovalFunction& tif) {
  const double quarter = 0.25 * tif.fwhm;
  const double digit = std::pow(10.0, std::floor(std::log10(quarter)) - 1.0);
  return std::floor(quarter / digit) * digit;
}

void mark_front(std::vector<ComparedPath>& paths) {
  for (ComparedPath& p : paths) {
    p.on_front = p.whole() && std::none_of(paths.begin(), paths.end(), [&](const ComparedPath& other) {
                   return other.whole() && dominates(other, p);
                 });
  }
}

PathComparison plan_paths(const JobOptions& options, const std::string& list, std::optional<double> pitch,
                          const Shard& shard, const OutputFolder& folder, const Progress& progress) {
  if (pitch && !ranges::kPitch.holds(*pitch)) {
    throw InputError(fmt::format("--pitch: {}; required {}", *pitch, ranges::kPitch.text()));
  }
  check_weights(options);
  check_exports(options);
  parse_path_list(list, pitch.value_or(1.0));  // refuses a wrong list before any work is done
  const Job job = time_limit(options.max_solve_s).run(progress, [&](const Progress& limited) {
    return load_job(options, limited);
  });
  PathComparison comparison;
  comparison.sheet = sweep_sheet(job, {"path"});
  comparison.list = list;
  comparison.pitch_given = pitch.has_value();
  comparison.pitch = pitch.value_or(default_pitch(job.part->tif));
  comparison.before = radial_spectrum(job.part->figure, job.part->threads);
  for (ListedPath& listed : parse_path_list(list, comparison.pitch)) {
    comparison.paths.emplace_back().listed = std::move(listed);
  }
  for (const std::size_t task : shard.tasks_of(comparison.paths.size())) {
    ComparedPath& path = comparison.paths[task - 1];
    const std::string stage = fmt::format("path {} of {}, {}", task, comparison.paths.size(), path.listed.text);
    progress.report(stage);
    try {
      plan_one(job, comparison.pitch, path, folder, progress.of_part(stage));
    } catch (const InputError& error) {
      path.failure = with_flags(error).what();
    } catch (const TimeLimitReached& error) {
      path.failure = with_option_names(error.what(), flag_of);
      path.out_of_time = true;
    }
    if (!path.failure.empty()) progress.report(stage + ": " + path.failure);
  }
  return comparison;
}

void conclude(PathComparison& comparison) {
  const std::vector<ComparedPath>& paths = comparison.paths;
  const bool none = std::none_of(paths.begin(), paths.end(), [](const ComparedPath& p) { return p.failure.empty(); });
  const auto late = std::find_if(paths.begin(), paths.end(), [](const ComparedPath& p) { return p.out_of_time; });
  if (none && late != paths.end()) throw TimeLimitReached(late->failure);
  if (none) throw InputError("--paths: none can be planned; the first: " + paths.front().failure);
  mark_front(comparison.paths);
  collect_limits(comparison);
}

PathComparison compare_paths(const JobOptions& options, const std::string& list, std::optional<double> pitch,
                             const OutputFolder& folder, const Progress& progress) {
  PathComparison comparison = plan_paths(options, list, pitch, {}, folder, progress);
  conclude(comparison);
  return comparison;
}

}  // namespace dwell
