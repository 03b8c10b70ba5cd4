#pragma once

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

struct OutlierOptions {
  double sigmas = 5.0;  // > 0
  Index window = 5;     // side of the window [pixels], odd, from 3 to kMaxOutlierWindow
  double floor = 0.0;   // least standard deviation assumed [nm], >= 0: for quantised or very smooth maps
};
inline constexpr Index kMaxOutlierWindow = 101;
inline constexpr Index kLeastInOutlierWindow = 5;

/// Sets to NaN every pixel that differs from the median of the finite pixels in the window around it (itself included,
/// cut off at the map's edge) by more than `sigmas` standard deviations, taken as 1.4826 times the median of the
/// absolute differences from that median (Hampel's test; Davies and Gather 1993), but at least `floor`. All pixels are
/// judged on the map as it was. A pixel with fewer than kLeastInOutlierWindow finite ones in its window is kept.
/// Returns how many were removed. Throws InputError for options out of range or if nothing is left. Cost O(pixels
/// window^2).
Index remove_outliers(HeightMap& map, const OutlierOptions& options, int threads = 1, const Progress& progress = {});

struct LimitOptions {
  double height = 0.0;  // [nm]; 0 = no limit
  double slope = 0.0;   // [nm/mm]; 0 = no limit
};

/// Sets to NaN every pixel farther than `height` from the median of the map, and every pixel with a slope above
/// `slope`: the root of the sum of squares of the steeper of its two one-sided differences in x and in y, to finite
/// neighbours. A lone spike therefore takes its four neighbours with it. All are judged on the map as it was. Returns
/// how many were removed. Throws InputError if a limit is negative, both are zero, or nothing is left.
Index remove_beyond(HeightMap& map, const LimitOptions& options);

}  // namespace dwell
