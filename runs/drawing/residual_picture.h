#pragma once

#include <string>

#include "core/anatomy/residual_anatomy.h"
#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "runs/drawing/figure_format.h"

namespace dwell {

/// Colours of residual_picture end at so many robust standard deviations: 1.4826 times the median of |residual|.
inline constexpr double kColourSigmas = 4.0;

/// A figure of a residual [nm] on a scale that its extreme pixels do not set: colours end at kColourSigmas, which the
/// title says. Blemishes are ringed and numbered in the order of the anatomy, kRinged at most; the inner border of the
/// zone at the edge is drawn as a line, and its outer one against pixels that do not count. `counted`: the map of those
/// that do, from which the deviations are; null: all. As map_picture in all else.
std::string residual_picture(const HeightMap& residual, const ResidualAnatomy& anatomy, const std::string& title,
                             FigureFormat format = FigureFormat::Png, const Progress& progress = {},
                             const HeightMap* counted = nullptr);

inline constexpr std::size_t kRinged = 50;

}  // namespace dwell
