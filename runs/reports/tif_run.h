#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/tif/calibration/spot_calibration.h"
#include "core/tif/calibration/trench_calibration.h"
#include "core/tif/removal_analysis.h"
#include "runs/base/input_file.h"
#include "runs/job/job_options.h"
#include "solvers/fits/ceres_removal_fit.h"

namespace dwell {

/// The options of `dwell tif`, in the user's own words and units. Exactly one of job.tif, spot and trench is given.
struct TifJob {
  JobOptions job;      // tif and how to read it; map_pixel_mm, map_unit, map_origin_mm for spot, before and trench
  std::string spot;    // map after the tool stood on it
  std::string trench;  // map after the tool ran through
  std::string before;  // map before; empty: it was flat
  std::optional<double> dwell_time_s;
  std::optional<double> feed_mm_per_min;
  std::optional<double> direction_deg;  // of the trench; default: fitted
  std::vector<std::string> at;          // X,Y [mm], for each spot
  std::optional<double> radius_mm;
  std::optional<double> noise_cut, noise_sigmas;
  std::string centre, baseline, registration;  // empty: not given
  std::vector<std::string> fits;  // names, separated by commas, or one model with held parameters: "bonnet:cap=40"
  bool robust = false;
};

/// A removal function and its analysis.
struct TifResult {
  std::string source;   // "measured", "spot", "trench", or the name of a model
  RemovalFunction tif;  // turned as the job says
  HeightMap rates;      // its samples [nm/s], origin relative to the tool axis
  RemovalAnalysis analysis;
  std::optional<SpotCalibration> spots;
  std::optional<TrenchCalibration> trench;
  std::vector<RemovalFit> fits;  // least BIC first
  std::vector<InputFile> inputs;
};

/// Reads, calibrates, orients, analyses and fits. Throws InputError naming the option or file, Interrupted.
TifResult make_tif(const TifJob& job, const Progress& progress = {});

/// A sentence for each fit that ended before it converged; not empty = exit code 3.
std::vector<std::string> unfinished_fits(const TifResult& result);

/// A fit as the user writes it: the model, and the parameters held.
struct FitRequest {
  std::string model;
  RemovalFitOptions options;
};

/// "gaussian,planetary" or "planetary:ratio=-1,eccentricity=0.8" or "all", several in a row. Throws InputError.
std::vector<FitRequest> parse_fits(const std::vector<std::string>& texts, bool robust);

}  // namespace dwell
