#include "runs/plan/pitch_choice.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/counted.h"
#include "paths/lines/raster.h"
#include "paths/metrics/track_overlap.h"
#include "paths/metrics/track_profile.h"
#include "runs/plan/program_prediction.h"

namespace dwell {
namespace {

/// A raster of some pitch, and its plan.
struct TriedRaster {
  RasterOptions options;
  LaidPath laid;
  DwellPlan dwell;

  /// RMS about zero, exact [nm].
  double residual() const { return dwell.exact.statistics.rms_about_zero(); }
  double step() const { return options.step.value_or(options.pitch); }
  std::string in_words() const {
    return fmt::format("pitch {:.4g} mm, step {:.4g} mm: RMS {:.4g} nm with {}", options.pitch, step(), residual(),
                       counted(laid.path.size(), "dwell point"));
  }
};

/// Weights that are searched over plans belong to tool, path and part here. With Auto, a finer raster is smoothed as
/// much.
DwellOptions with_fixed_weights(DwellOptions options) {
  if (options.smoothness.kind != GoalKind::Fixed) options.smoothness = DwellOptions{}.smoothness;
  if (options.time_price.kind != GoalKind::Fixed) options.time_price = DwellOptions{}.time_price;
  return options;
}

RasterOptions of_half_pitch(RasterOptions raster) {
  raster.pitch *= 0.5;
  return raster;
}

/// How many times less the same smoothness weighs on a raster of half the pitch. A dwell is proportional to pitch x
/// step, its change from point to point to one step more, and there are 1 / (pitch x step) points: the sum of the
/// squares is proportional to pitch x step^3.
double weight_ratio(const RasterOptions& raster) { return raster.step ? 2.0 : 16.0; }

/// Plans rasters on a part within the time that all of them have together.
class RasterTrials {
 public:
  RasterTrials(const Part& part, const PathSpec& spec, Motion motion, const DwellOptions& options,
               const Progress& progress)
      : part_(part),
        spec_(spec),
        motion_(motion),
        options_(with_fixed_weights(options)),
        limit_(time_limit(options.max_seconds, options.used_seconds)),
        progress_(progress) {}

  /// Throws TimeLimitReached if the time is over before there is a dwell.
  TriedRaster solve(const RasterOptions& raster, double smoothness) const {
    PathSpec spec = spec_;
    spec.options = raster;
    DwellOptions options = options_;
    options.smoothness.value = smoothness;
    const Progress own = progress_.of_part(fmt::format("pitch {:.4g} mm", raster.pitch));
    TriedRaster tried{raster,
                      limit_.run(own,
                                 [&](const Progress& limited) {
                                   return lay_path(part_, spec, motion_, options.machine.feed_limits().max_feed,
                                                   limited);
                                 }),
                      {}};
    options.used_seconds = limit_.used();
    tried.dwell = find_dwell(part_, tried.laid, options, own, ExactCheck::Figure);
    return tried;
  }

  /// Nothing if the time is over before the solve ends.
  std::optional<TriedRaster> solve_in_time(const RasterOptions& raster, double smoothness) const {
    try {
      TriedRaster tried = solve(raster, smoothness);
      if (tried.dwell.solver.status == SolverStatus::TimeLimit) return std::nullopt;
      return tried;
    } catch (const TimeLimitReached&) {
      return std::nullopt;
    }
  }

  double smoothness() const { return options_.smoothness.value; }
  /// Whether a raster of half the pitch is smoothed as much by itself.
  bool smooths_alike() const { return options_.smoothness.kind == GoalKind::Auto; }
  /// Whether the narrower one leaves so much less that the exact figures can tell it, and that it is worth its points.
  bool pays(const TriedRaster& wide, const TriedRaster& narrow) const {
    return wide.residual() > (1.0 + kPitchCost) * narrow.residual() && told_apart(wide, narrow);
  }
  bool told_apart(const TriedRaster& wide, const TriedRaster& narrow) const {
    return wide.residual() - narrow.residual() > kProbeError * part_.before.rms_about_zero();
  }

 private:
  const Part& part_;
  const PathSpec& spec_;
  Motion motion_;
  DwellOptions options_;
  TimeLimit limit_;
  Progress progress_;
};

/// The pitch that was found, what it was compared with, and why the search ended.
struct PitchSearch {
  TriedRaster wide;
  std::optional<TriedRaster> half, equal;  // of half the pitch, with the same weights and smoothed as much as `wide`
  bool out_of_time = false;
};

double points_of_half(const TriedRaster& raster) {
  return (raster.options.step ? 2.0 : 4.0) * static_cast<double>(raster.laid.path.size());
}

PitchSearch search_pitch(const RasterTrials& trials, const RasterOptions& widest, double narrowest) {
  PitchSearch search{trials.solve(widest, trials.smoothness()), {}, {}, false};
  TriedRaster& wide = search.wide;
  search.out_of_time = wide.dwell.solver.status == SolverStatus::TimeLimit;
  while (!search.out_of_time && points_of_half(wide) <= kMostTriedPoints) {
    const RasterOptions raster = of_half_pitch(wide.options);
    search.half = trials.solve_in_time(raster, trials.smoothness());
    search.out_of_time = !search.half;
    if (search.out_of_time || !trials.pays(wide, *search.half)) break;
    if (raster.pitch < narrowest && trials.smooths_alike()) break;  // what it gains below is the solver's scatter
    if (raster.pitch < narrowest && trials.smoothness() > 0.0) {
      search.equal = trials.solve_in_time(raster, weight_ratio(raster) * trials.smoothness());
      search.out_of_time = !search.equal;
      if (search.out_of_time || !trials.pays(wide, *search.equal)) break;
    }
    wide = std::move(*search.half);
    search.half.reset();
    search.equal.reset();
  }
  return search;
}

/// What was compared, and why no narrower pitch was taken.
std::string comparison_note(const PitchSearch& search, const RasterTrials& trials) {
  const TriedRaster& wide = search.wide;
  std::string note = wide.in_words();
  if (search.half) note += "; " + search.half->in_words();
  if (search.out_of_time) return note + "; there was no time to compare narrower ones";
  if (!search.half) {
    return note +
           fmt::format("; half the pitch would take more than {:.0f} dwell points, which is not tried: give a pitch",
                       kMostTriedPoints);
  }
  if (search.equal) {
    const double ratio = weight_ratio(wide.options), smoothness = trials.smoothness();
    return note +
           fmt::format(
               ", since a smoothness of {:.4g} weighs 1/{:.0f} there of what it does here; with {:.4g}, which weighs "
               "the same, RMS {:.4g} nm. What a narrower pitch would gain, a lower `smoothness` gains as well",
               smoothness, ratio, ratio * smoothness, search.equal->residual());
  }
  if (wide.residual() > (1.0 + kPitchCost) * search.half->residual())
    note += "; the difference is less than exact figures can tell";
  return note;
}

/// Says in the plan that the time ended the search of its pitch.
void add_time_limit(PitchSearch& search, const DwellOptions& options) {
  DwellPlan& plan = search.wide.dwell;
  std::string limit =
      fmt::format("`max solve` of {} s was over before raster:pitch=auto had compared narrower pitches than {:.4g} mm",
                  options.max_seconds, search.wide.options.pitch);
  if (weights_are_searched(options)) {
    limit += fmt::format(", and before a search of the weights: smoothness {:.4g} and time price {:.4g} nm^2/s instead",
                         plan.weights.smoothness, plan.weights.time_price);
  }
  plan.limits.push_back(std::move(limit));
}

}  // namespace

bool pitch_is_searched(const PathSpec& spec) {
  const auto* raster = spec.get_if<RasterOptions>();
  return raster != nullptr && raster->auto_pitch;
}

SearchedRaster lay_searched_raster(const Part& part, const PathSpec& spec, Motion motion, const DwellOptions& options,
                                   const Progress& progress) {
  constexpr double kWidestOfFwhm = 0.125;  // whose gain by weights alone is not taken
  RasterOptions raster = options_of<RasterOptions>(spec);
  const AutoPitch by_ripple =
      widest_pitch(line_profile(part.tif, raster.angle_deg), 2.0 * part.tif.radius, raster.ripple);
  raster.auto_pitch = false;
  raster.pitch = by_ripple.ripple.pitch;
  const RasterTrials trials(part, spec, motion, options, progress);
  PitchSearch search = search_pitch(trials, raster, kWidestOfFwhm * part.tif.fwhm);
  if (search.out_of_time) add_time_limit(search, options);
  std::vector<std::string>& notes = search.wide.laid.path.notes;
  notes.push_back(fmt::format(
      "pitch=auto: ripple of at most {:.3g} % of the removal would allow {:.4g} mm ({:.3g} % peak to valley, tracks "
      "overlapping by {:.3g} %)",
      100.0 * raster.ripple, by_ripple.ripple.pitch, 100.0 * by_ripple.ripple.pvn, 100.0 * by_ripple.track.overlap));
  notes.push_back(comparison_note(search, trials));
  SearchedRaster found{std::move(search.wide.laid), std::nullopt};
  if (search.out_of_time || !weights_are_searched(options)) found.dwell = std::move(search.wide.dwell);
  return found;
}

}  // namespace dwell
