#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/tif/models/removal_model.h"

namespace dwell {

struct RemovalFitOptions {
  std::map<std::string, double> held;  // parameters that are not varied, by name ("ratio"; also "x", "y", "peak")
  bool robust = false;  // outliers count less: soft L1, 2 k^2 (sqrt(1 + r^2 / k^2) - 1), k = 1.345 scatters
};

struct FittedParameter {
  std::string name, unit;
  double value = 0.0;
  double error = 0.0;  // standard error; NaN where the samples do not determine it; 0 if held
  bool held = false;
};

/// A model fitted to samples of a removal function.
struct RemovalFit {
  std::string model;
  std::vector<FittedParameter> parameters;  // x, y [mm from the tool axis], peak [nm/s], then the model's own
  HeightMap fitted, residual;               // the model, and samples minus model [nm/s]
  double rms = 0.0;                         // of the residual [nm/s]
  double r_squared = 0.0;                   // 1 - sum of squared residuals / that of the samples about their mean
  double aic = 0.0, bic = 0.0;              // Akaike's and Schwarz's criteria for normal noise; less is better
  int iterations = 0;
  bool converged = false;
  std::string message;
  std::string spec;  // the model about its own centre, as --tif takes it

  const FittedParameter& at(const std::string& name) const;  // throws std::out_of_range
};

/// Fits the model to the finite samples by least squares (Ceres: Levenberg-Marquardt, numeric derivatives, bounds),
/// from several starts that follow from the samples' moments; the best result is taken. Standard errors: sigma^2
/// (J'J)^-1 with sigma^2 = sum of squares / (samples - parameters), for noise that is independent from sample to
/// sample; a robust fit has Huber's correction (Huber and Ronchetti 2009, eq. 7.81). They say nothing of a model that
/// is wrong. aic = m ln(sum of squares / m) + 2 (p + 1), bic with ln m in place of 2. Throws InputError for an unknown
/// or unusable held parameter, one that must be held and is not, or fewer samples than parameters; Interrupted. Cost:
/// seconds at most for 10^5 samples.
RemovalFit fit_removal(const HeightMap& rates, const RemovalModel& model, const RemovalFitOptions& options = {},
                       const Progress& progress = {});

}  // namespace dwell
