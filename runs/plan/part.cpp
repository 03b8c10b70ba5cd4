#include "runs/plan/part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/base/errors.h"
#include "core/base/pitch.h"
#include "core/base/threads.h"
#include "core/form/robust_pv.h"

namespace dwell {
namespace {

constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();

/// Moves pixels of weight 0 from the map to what lies beside it, and keeps the weights if they differ.
void set_weights(std::vector<double> weights, Part& part) {
  if (weights.empty()) return;
  std::vector<double>& heights = part.map.values;
  if (weights.size() != heights.size()) {
    throw std::invalid_argument(
        fmt::format("make_part: {} weights for {} pixels; one each, or none", weights.size(), heights.size()));
  }
  HeightMap beside(part.map.grid);
  Index not_counted = 0;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (!(weights[i] >= 0.0 && std::isfinite(weights[i])))
      throw std::invalid_argument(fmt::format("make_part: weight {}; finite and >= 0 is required", weights[i]));
    if (!std::isfinite(heights[i])) continue;
    if (weights[i] > 0.0) {
      least = std::min(least, weights[i]);
      most = std::max(most, weights[i]);
      continue;
    }
    ++not_counted;
    beside.values[i] = std::exchange(heights[i], kNoData);
  }
  if (!(most > 0.0)) throw InputError("no pixel with data has a weight above 0: nothing counts");
  if (not_counted > 0) part.beside = std::move(beside);
  if (least < most) part.weights = std::move(weights);
}

}  // namespace

Part make_part(HeightMap map, RemovalFunction tif, const FormTerms& form, int threads, const Progress& progress,
               std::vector<double> weights) {
  check_tool_fits(tif, map.grid);
  Part part;
  part.threads = thread_count(threads);
  part.map = std::move(map);
  set_weights(std::move(weights), part);
  part.form = form;
  part.figure = without_form(part.map, form, part.threads);
  progress.check();
  part.before = with_robust_pv(map_statistics(part.figure, {}, part.threads), part.figure, part.threads);
  progress.check();
  const Grid& grid = part.map.grid;
  progress.step(fmt::format("map: {} x {} pixels of {}, {} in the aperture, RMS {:.4g} nm", grid.rows, grid.cols,
                            pitch_text(grid), part.before.valid_pixels, part.before.rms));
  part.tif = std::move(tif);
  if (const auto note = wider_than_map(part.tif, grid)) part.tif.notes.push_back(*note);
  part.kernel = pixel_kernel(part.tif, grid.pitch_x, grid.pitch_y);
  progress.check();
  part.exact = tabulate_pixel_mean(part.tif, grid);
  progress.check();
  return part;
}

Part without_pixels(Part part, const std::vector<Index>& pixels) {
  for (const Index i : pixels) part.map.values[static_cast<std::size_t>(i)] = kNoData;
  part.figure = without_form(part.map, part.form, part.threads);
  part.before = map_statistics(part.figure, {}, part.threads);
  return part;
}

void check_tool_fits(const RemovalFunction& tif, const Grid& map) {
  constexpr double kTimesTheMap = 3.0;
  if (tif.fwhm <= kTimesTheMap * std::max(map.width(), map.height())) return;
  const bool measured = tif.kind == RemovalFunction::Kind::Measured;
  throw InputError(fmt::format(
      "removal function with a FWHM of {:.4g} mm, over {:g} times the map of {:.4g} x {:.4g} mm; check {} and `map "
      "pixel` "
      "(the map has {})",
      tif.fwhm, kTimesTheMap, map.width(), map.height(),
      measured ? fmt::format("`tif pixel` (the file has {})", pitch_text(tif.samples.grid)) : "`tif` (its size)",
      pitch_text(map)));
}

std::optional<std::string> wider_than_map(const RemovalFunction& tif, const Grid& map) {
  constexpr double kReachInFwhm = 3.0;  // what is farther is the noise of a file
  const double diameter = std::min(2.0 * tif.radius, kReachInFwhm * tif.fwhm);
  if (!(diameter > map.width() && diameter > map.height())) return std::nullopt;
  return fmt::format(
      "the tool, {:.4g} mm in diameter (FWHM {:.4g} mm), is larger than the map of {:.4g} x {:.4g} mm both ways",
      diameter, tif.fwhm, map.width(), map.height());
}

}  // namespace dwell
