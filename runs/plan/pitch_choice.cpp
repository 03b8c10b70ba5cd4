#include "runs/plan/pitch_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "paths/lines/raster.h"
#include "paths/metrics/track_overlap.h"
#include "paths/metrics/track_profile.h"
#include "runs/plan/dwell_plan.h"

namespace dwell {
namespace {

/// A raster of some pitch, and what its plan leaves.
struct TriedRaster {
  RasterOptions options;
  LaidPath laid;
  double residual = 0.0;  // RMS about zero, exact [nm]

  std::string in_words() const {
    return fmt::format("pitch {:.4g} mm, step {:.4g} mm: RMS {:.4g} nm", options.pitch,
                       options.step.value_or(options.pitch), residual);
  }
};

TriedRaster try_raster(const RasterOptions& raster, const Part& part, const PathSpec& spec, Motion motion,
                       const DwellOptions& options, const Progress& progress) {
  PathSpec fixed = spec;
  fixed.options = raster;
  const Progress of_trial = progress.of_part(fmt::format("pitch {:.4g} mm", raster.pitch));
  TriedRaster tried{raster, lay_path(part, fixed, motion, options.machine.feed_limits().max_feed, of_trial), 0.0};
  tried.residual =
      find_dwell(part, tried.laid, options, of_trial, ExactCheck::Figure).exact.statistics.rms_about_zero();
  return tried;
}

RasterOptions of_half_pitch(RasterOptions raster) {
  raster.pitch *= 0.5;
  return raster;
}

/// Weights that are searched are given their defaults.
DwellOptions with_fixed_weights(DwellOptions options) {
  if (options.smoothness.kind != GoalKind::Fixed) options.smoothness = DwellOptions{}.smoothness;
  if (options.time_price.kind != GoalKind::Fixed) options.time_price = DwellOptions{}.time_price;
  return options;
}

}  // namespace

bool pitch_is_searched(const PathSpec& spec) {
  const auto* raster = spec.get_if<RasterOptions>();
  return raster != nullptr && raster->auto_pitch;
}

LaidPath lay_searched_raster(const Part& part, const PathSpec& spec, Motion motion, const DwellOptions& options,
                             const Progress& progress) {
  // Where nothing but form is on the map, what is left goes on falling with the pitch, as the penalty on changes of
  // dwell does; below an eighth of the FWHM, where dwell has waves that no tool can follow, it is not worth its
  // points.
  const double narrowest = 0.125 * part.tif.fwhm;
  const DwellOptions fixed = with_fixed_weights(options);
  RasterOptions raster = options_of<RasterOptions>(spec);
  const AutoPitch by_ripple =
      widest_pitch(line_profile(part.tif, raster.angle_deg), 2.0 * part.tif.radius, raster.ripple);
  raster.auto_pitch = false;
  raster.pitch = by_ripple.ripple.pitch;
  TriedRaster wide = try_raster(raster, part, spec, motion, fixed, progress);
  TriedRaster half = try_raster(of_half_pitch(raster), part, spec, motion, fixed, progress);
  const auto costs = [&] { return wide.residual > (1.0 + kPitchCost) * half.residual; };
  while (costs() && half.options.pitch >= narrowest) {
    wide = std::move(half);
    half = try_raster(of_half_pitch(wide.options), part, spec, motion, fixed, progress);
  }
  wide.laid.path.notes.push_back(fmt::format(
      "pitch=auto: ripple of at most {:.3g} % of the removal would allow {:.4g} mm ({:.3g} % peak to valley, tracks "
      "overlapping by {:.3g} %)",
      100.0 * raster.ripple, by_ripple.ripple.pitch, 100.0 * by_ripple.ripple.pvn, 100.0 * by_ripple.track.overlap));
  wide.laid.path.notes.push_back(fmt::format(
      "{} with {} dwell points; {} with {}{}", wide.in_words(), wide.laid.path.size(), half.in_words(),
      half.laid.path.size(),
      costs() ? fmt::format(", more than {:.0f} % less; pitches under an eighth of the FWHM are not tried: give one",
                            100.0 * kPitchCost)
              : ""));
  return std::move(wide.laid);
}

}  // namespace dwell
