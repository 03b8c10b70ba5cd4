#include "core/removal/removal_once.h"

#include "core/removal/coarse_removal.h"
#include "core/removal/scattered_removal.h"

namespace dwell {

Vector removal_once(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                    const std::vector<Stroke>& strokes, const Vector& t, int threads) {
  return kernel.coarse == CoarseFactor{} ? scattered_removal_once(map, pixels, kernel, strokes, t, threads)
                                         : coarse_removal_once(map, pixels, kernel, strokes, t, threads);
}

}  // namespace dwell
