#include "runs/reports/tif_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/spec_text.h"
#include "core/base/threads.h"
#include "core/base/units.h"
#include "core/tif/models/removal_models.h"
#include "core/tif/removal_orientation.h"
#include "runs/job/input_files.h"
#include "runs/job/place_option.h"

namespace dwell {
namespace {

/// Options that mean nothing for the kind of input given are refused, not ignored.
void refuse_unused(const TifJob& job) {
  const bool spot = !job.spot.empty(), trench = !job.trench.empty(), measured = spot || trench;
  if (spot + trench + !job.job.tif.empty() != 1) {
    throw InputError(
        "give one of: a removal function (a file of rates, or a model), --spot FILE with --dwell-time, or --trench "
        "FILE with "
        "--feed");
  }
  const auto only = [](bool given, bool accepted, const char* option, const char* with) {
    if (given && !accepted) throw InputError(fmt::format("{}: accepted only with {}", option, with));
  };
  only(!job.before.empty(), measured, "--before", "--spot or --trench");
  only(job.dwell_time_s.has_value(), spot, "--dwell-time", "--spot (a trench needs --feed)");
  only(job.feed_mm_per_min.has_value(), trench, "--feed", "--trench (a spot needs --dwell-time)");
  only(job.direction_deg.has_value(), trench, "--direction", "--trench");
  only(!job.at.empty(), spot, "--at", "--spot");
  only(job.radius_mm.has_value(), measured, "--radius", "--spot or --trench");
  only(job.noise_cut.has_value(), measured, "--noise-cut", "--spot or --trench");
  only(job.noise_sigmas.has_value(), spot, "--noise-sigmas", "--spot");
  only(!job.centre.empty(), spot, "--centre", "--spot (for a file of rates: --tif-centre)");
  only(!job.baseline.empty(), spot, "--baseline", "--spot");
  only(!job.registration.empty(), spot, "--register", "--spot");
  const JobOptions& o = job.job;
  only(o.map_pixel_mm || o.map_origin_mm || !o.map_unit.empty() || !o.map_steps.empty(), measured,
       "--map-pixel, --map-origin, --map-unit or --map-steps",
       "--spot or --trench (for a file of rates: --tif-pixel, --tif-unit)");
  only(o.wavelength_nm || o.wave_scale, measured, "--wavelength or --wave-scale",
       "--spot or --trench (a file of rates is in a length per time)");
  only(o.map_no_data || o.map_max_pv_mm || o.map_table || o.map_rows || o.map_grid, measured,
       "--map-no-data, --map-max-pv, --map-table, --map-rows or --map-grid",
       "--spot or --trench (for a file of rates: --tif-no-data, --tif-table, --tif-rows, --tif-grid)");
  only(o.tif_pixel_mm || !o.tif_unit.empty() || o.tif_centre, !measured, "--tif-pixel, --tif-unit or --tif-centre",
       "a file of rates (for --spot and --trench: --map-pixel, --map-unit, --centre)");
  only(!o.tif_steps.empty() || o.tif_pedestal, !measured, "--tif-steps or --tif-pedestal",
       "a file of rates (for --spot and --trench: --map-steps, --baseline)");
  only(o.tif_no_data || o.tif_table || o.tif_rows || o.tif_grid, !measured,
       "--tif-no-data, --tif-table, --tif-rows or --tif-grid",
       "a file of rates (for --spot and --trench: --map-no-data, --map-table, --map-rows, --map-grid)");
}

/// What a calibration lacks, all at once: its own option, and the pitch of a map that says none.
void require_all(const TifJob& job) {
  JobOptions options = job.job;
  options.map = job.spot.empty() ? job.trench : job.spot;
  std::vector<std::string> missing = missing_pitches(options);
  if (!job.spot.empty() && !job.dwell_time_s) missing.emplace_back("--dwell-time");
  if (!job.trench.empty() && !job.feed_mm_per_min) missing.emplace_back("--feed");
  if (missing.size() < 2) return;
  throw InputError(fmt::format("{}: required; --help says what each is", fmt::join(missing, ", ")));
}

HeightMap read_heights(const std::string& file, const TifJob& job, const char* role, std::vector<InputFile>& inputs,
                       const Progress& progress) {
  JobOptions options = job.job;
  options.map = file;
  HeightMap map = load_map(options, inputs, progress);
  inputs.back().role = role;
  return map;
}

HeightMap read_depth(const std::string& file, const TifJob& job, std::vector<InputFile>& inputs,
                     const Progress& progress) {
  HeightMap after = read_heights(file, job, "after", inputs, progress);
  if (!job.before.empty()) {
    HeightMap depth = removed_depth(read_heights(job.before, job, "before", inputs, progress), after);
    depth.history.push_back(fmt::format("tif: {} minus {}", job.before, file));
    return depth;
  }
  for (double& v : after.values) v = -v;
  after.history.push_back(fmt::format("tif: {} below its surroundings", file));
  return after;
}

SpotOptions spot_options(const TifJob& job) {
  if (!job.dwell_time_s)
    throw InputError("--dwell-time: required with --spot; the time that the tool stood on a spot [s]");
  SpotOptions options;
  options.dwell_time = *job.dwell_time_s;
  for (const std::string& text : job.at) {
    try {
      options.at.push_back(parse_point(text));
    } catch (const InputError& error) {
      throw InputError(fmt::format("--at: {}", error.what()));
    }
  }
  options.radius = job.radius_mm;
  options.noise_cut = job.noise_cut.value_or(options.noise_cut);
  options.noise_sigmas = job.noise_sigmas.value_or(options.noise_sigmas);
  const auto word = [](const char* option, const std::string& text, auto parse, auto& into) {
    if (text.empty()) return;
    try {
      into = parse(text);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", option, error.what()));
    }
  };
  word("--centre", job.centre, parse_spot_centre, options.centre);
  word("--baseline", job.baseline, parse_spot_baseline, options.baseline);
  word("--register", job.registration, parse_spot_registration, options.registration);
  if (job.before.empty() && options.baseline == SpotBaseline::None) {
    throw InputError(
        "--baseline none: without --before the level of the surroundings is needed; plane and constant are accepted");
  }
  return options;
}

TrenchOptions trench_options(const TifJob& job) {
  if (!job.feed_mm_per_min) throw InputError("--feed: required with --trench; the speed along the track [mm/min]");
  TrenchOptions options;
  options.feed = units::mm_per_s(*job.feed_mm_per_min);
  options.direction = job.direction_deg;
  options.radius = job.radius_mm;
  options.noise_cut = job.noise_cut.value_or(options.noise_cut);
  return options;
}

/// The rates of the job, before it is turned.
RemovalFunction find_removal(const TifJob& job, TifResult& result, const Progress& progress) {
  const bool lacks = job.spot.empty() ? !job.feed_mm_per_min : !job.dwell_time_s;
  if (lacks) require_all(job);
  if (!job.spot.empty()) {
    const HeightMap depth = read_depth(job.spot, job, result.inputs, progress);
    result.source = "spot";
    progress.step("spots: finding, aligning and averaging");
    try {
      result.spots = calibrate_spots(depth, spot_options(job));
      return measured_removal(result.spots->rates, {TifCentre::Kind::Given, {}});
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", job.spot, error.what()));
    }
  }
  const HeightMap depth = read_depth(job.trench, job, result.inputs, progress);
  result.source = "trench";
  progress.step("trench: inverting its section");
  try {
    result.trench = calibrate_trench(depth, trench_options(job));
    return measured_removal(result.trench->rates, {TifCentre::Kind::Given, {}});
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", job.trench, error.what()));
  }
}

}  // namespace

std::vector<FitRequest> parse_fits(const std::vector<std::string>& texts, bool robust) {
  std::vector<FitRequest> requests;
  for (const std::string& text : texts) {
    if (text.find(':') != std::string::npos) {
      const SpecText spec = parse_spec_text(text, "--fit");
      FitRequest request{removal_model(spec.kind).name, {{}, robust}};
      for (const auto& [key, value] : spec.entries) request.options.held[key] = spec.number(key);
      requests.push_back(std::move(request));
      continue;
    }
    for (const std::string_view name : split(text, ',')) {
      if (trim(name) == "all") {
        for (const RemovalModel& model : removal_models()) {
          if (model.fits_alone()) requests.push_back({model.name, {{}, robust}});
        }
        continue;
      }
      try {
        requests.push_back({removal_model(std::string(trim(name))).name, {{}, robust}});
      } catch (const InputError& error) {
        throw InputError(fmt::format("--fit: {}", error.what()));
      }
    }
  }
  return requests;
}

std::vector<std::string> unfinished_fits(const TifResult& result) {
  std::vector<std::string> limits;
  for (const RemovalFit& f : result.fits) {
    if (!f.converged) limits.push_back(fmt::format("the fit of {} did not converge: {}", f.model, f.message));
  }
  return limits;
}

TifResult make_tif(const TifJob& job, const Progress& progress) {
  refuse_unused(job);
  const std::vector<FitRequest> requests = parse_fits(job.fits, job.robust);
  if (job.robust && requests.empty()) throw InputError("--robust: accepted only with --fit");
  TifResult result;
  if (job.job.tif.empty()) {
    const RemovalFunction tif = find_removal(job, result, progress);
    result.tif = oriented(tif, {job.job.tif_angle_deg, job.job.tif_flip});
    result.rates = result.tif.samples;
  } else {
    result.tif = load_removal_function(job.job, result.inputs, progress);
    result.source = kind_of(result.tif);
    result.rates = removal_samples(result.tif);
  }
  result.rates.quantity = MapQuantity::Rate;
  progress.step("analysing the removal function");
  result.analysis = with_exact_figures(analyse_removal(result.rates, thread_count(job.job.threads)), result.tif);
  for (const FitRequest& request : requests) {
    const Progress own = progress.of_part("fit of " + request.model);
    own.step("starting");
    result.fits.push_back(fit_removal(result.rates, removal_model(request.model), request.options, own));
  }
  std::stable_sort(result.fits.begin(), result.fits.end(),
                   [](const RemovalFit& a, const RemovalFit& b) { return a.bic < b.bic; });
  auto& history = result.rates.history;
  if (std::find(history.begin(), history.end(), kToolAxisAtOrigin) == history.end())
    history.emplace_back(kToolAxisAtOrigin);
  return result;
}

}  // namespace dwell
