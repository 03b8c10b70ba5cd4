#include "solvers/fits/spike_removal.h"

#include <cmath>
#include <utility>

#include "core/map/map_outliers.h"
#include "core/map/robust_plane.h"
#include "core/numerics/median.h"

namespace dwell {

double robust_sigma(std::vector<double> residuals) {
  for (double& v : residuals) v = std::abs(v);
  return kSigmaPerMedianDeviation * upper_median(std::move(residuals));
}

std::pair<HeightMap, Index> without_spikes(HeightMap map, int threads, const Progress& progress) {
  const std::vector<Index> pixels = finite_pixels(map);
  if (pixels.size() < 3) return {std::move(map), 0};
  const double scatter = robust_plane(map, pixels, true).scatter;
  const OutlierOptions options{kSpikeSigmas, kSpikeWindow, kLeastSpike * scatter / kSpikeSigmas};
  const Index spikes = remove_outliers(map, options, threads, progress);
  return {std::move(map), spikes};
}

}  // namespace dwell
