#include "core/tif/tif_pedestal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/tif/rate_rim.h"

namespace dwell {
namespace {

std::string taper_rim(HeightMap& rates) {
  constexpr Index kPartOfSide = 8;
  const Index width = std::max<Index>(2, std::min(rates.grid.rows, rates.grid.cols) / kPartOfSide);
  const std::vector<Index> steps = steps_from_rim(rates);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i] < 0 || steps[i] >= width) continue;
    const double place = static_cast<double>(steps[i]) / static_cast<double>(width);
    rates.values[i] *= 0.5 * (1.0 - std::cos(std::numbers::pi * place));
  }
  return fmt::format("the outer {} ({:.4g} mm along x, {:.4g} mm along y) taken to zero by a cosine",
                     counted(width, "sample"), rates.grid.pitch_x * static_cast<double>(width),
                     rates.grid.pitch_y * static_cast<double>(width));
}

}  // namespace

TifPedestal parse_tif_pedestal(const std::string& text) {
  for (const TifPedestal how : {TifPedestal::Subtract, TifPedestal::Taper, TifPedestal::Accept}) {
    if (text == to_string(how)) return how;
  }
  throw InputError(fmt::format("'{}'; accepted: subtract, taper or accept", text));
}

std::string to_string(TifPedestal how) {
  switch (how) {
    case TifPedestal::Subtract:
      return "subtract";
    case TifPedestal::Taper:
      return "taper";
    default:
      return "accept";
  }
}

void mend_pedestal(HeightMap& rates, TifPedestal how) {
  const RateRim rim = rate_rim(rates);
  std::string done = "rates left as they are";
  if (how == TifPedestal::Subtract) {
    for (double& v : rates.values) v -= rim.mean;
    done = "that mean taken off all samples";
  } else if (how == TifPedestal::Taper) {
    done = taper_rim(rates);
  }
  rates.history.push_back(
      fmt::format("tif: pedestal {}: mean rate at the rim {:.4g} nm/s, {}", to_string(how), rim.mean, done));
}

}  // namespace dwell
