#include "solvers/fits/removal_fit_starts.h"

#include "core/tif/removal_moments.h"

namespace dwell {

std::vector<std::vector<double>> removal_fit_starts(const HeightMap& rates, const RemovalModel& model) {
  const RemovalMoments moments = removal_moments(rates);
  std::vector<std::vector<double>> starts;
  for (const ModelStart& start : model.starts(moments)) {
    std::vector<double>& whole = starts.emplace_back();
    whole = {start.centre.x, start.centre.y, moments.peak};
    whole.insert(whole.end(), start.values.begin(), start.values.end());
  }
  return starts;
}

}  // namespace dwell
