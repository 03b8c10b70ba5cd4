#pragma once

#include <vector>

#include "core/motion/tool_path.h"
#include "core/removal/sparse_removal.h"
#include "core/tif/removal_function.h"

namespace dwell {

/// The removal operator of the removal function as it was given, sampled at the pixels' centres: its entries are those
/// of StrokeAverage. The fast operators approximate it by a spline on the map's pitch; the difference is their error
/// (docs/math.md, "Exact averages"). Measured and model functions are given by the spline through their own samples.
/// Cost and memory: a StrokeAverage and about 60 bytes for every pixel under every stroke, so for small problems.
SparseRemoval exact_removal(const Grid& map, const std::vector<Index>& pixels, const RemovalFunction& tif,
                            const std::vector<Stroke>& strokes, int threads);

/// The removal [nm] that one apply of this operator gives for the times t [s], in the order of the pixels, without
/// keeping the matrix. Throws std::invalid_argument unless there is one time a stroke. The same bytes for any number of
/// threads.
Vector exact_removal_once(const Grid& map, const std::vector<Index>& pixels, const RemovalFunction& tif,
                          const std::vector<Stroke>& strokes, const Vector& t, int threads);

}  // namespace dwell
