#include "core/removal/exact_removal.h"

#include <stdexcept>

#include "core/motion/touched_pixels.h"
#include "core/removal/stroke_average.h"

namespace dwell {
namespace {

/// For every pixel of the map its place among `pixels`, or -1.
std::vector<Index> rows_of_pixels(const Grid& map, const std::vector<Index>& pixels) {
  std::vector<Index> row_of(static_cast<std::size_t>(map.size()), -1);
  for (std::size_t i = 0; i < pixels.size(); ++i) row_of[static_cast<std::size_t>(pixels[i])] = static_cast<Index>(i);
  return row_of;
}

}  // namespace

SparseRemoval exact_removal(const Grid& map, const std::vector<Index>& pixels, const RemovalFunction& tif,
                            const std::vector<Stroke>& strokes, int threads) {
  const StrokeAverage average(tif);
  const std::vector<Index> row_of = rows_of_pixels(map, pixels);
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    const PixelRange range = touched_pixels(map, strokes[j], average.low(), average.high());
    for (Index r = range.first_row; r <= range.last_row; ++r) {
      for (Index c = range.first_col; c <= range.last_col; ++c) {
        const Index row = row_of[static_cast<std::size_t>(map.index(r, c))];
        if (row < 0) continue;
        const double rate = average(strokes[j], map.centre(r, c));
        if (rate != 0.0) entries.emplace_back(row, static_cast<Index>(j), rate);
      }
    }
  }
  SparseRemoval::Matrix a(static_cast<Index>(pixels.size()), static_cast<Index>(strokes.size()));
  a.setFromTriplets(entries.begin(), entries.end());
  return {a, threads};
}

Vector exact_removal_once(const Grid& map, const std::vector<Index>& pixels, const RemovalFunction& tif,
                          const std::vector<Stroke>& strokes, const Vector& t, int threads) {
  if (t.size() != static_cast<Index>(strokes.size())) {
    throw std::invalid_argument("exact_removal_once: one time a stroke is required");
  }
  const StrokeAverage average(tif);
  const std::vector<Index> row_of = rows_of_pixels(map, pixels);
  std::vector<PixelRange> ranges;
  ranges.reserve(strokes.size());
  for (const Stroke& s : strokes) ranges.push_back(touched_pixels(map, s, average.low(), average.high()));
  Vector removal = Vector::Zero(static_cast<Index>(pixels.size()));
  const Index map_rows = map.rows;
#pragma omp parallel for num_threads(threads) schedule(dynamic)
  for (Index r = 0; r < map_rows; ++r) {  // a pixel belongs to one thread, which adds its strokes in path order
    for (std::size_t j = 0; j < strokes.size(); ++j) {
      const PixelRange& range = ranges[j];
      if (r < range.first_row || r > range.last_row) continue;
      for (Index c = range.first_col; c <= range.last_col; ++c) {
        const Index row = row_of[static_cast<std::size_t>(map.index(r, c))];
        if (row >= 0) removal[row] += average(strokes[j], map.centre(r, c)) * t[static_cast<Index>(j)];
      }
    }
  }
  return removal;
}

}  // namespace dwell
