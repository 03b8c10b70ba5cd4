#include "core/form/map_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "core/form/form_polynomials.h"

namespace dwell {
namespace {

/// Of some pixels.
struct Sums {
  Index count = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double mean = 0.0;
  double square = 0.0;  // of the deviations from the mean

  /// Together with those of other pixels (Chan, Golub and LeVeque 1983).
  void add(const Sums& other) {
    if (other.count == 0) return;
    const auto mine = static_cast<double>(count), theirs = static_cast<double>(other.count), all = mine + theirs;
    const double apart = other.mean - mean;
    square += other.square + apart * apart * (mine * theirs / all);
    mean += apart * (theirs / all);
    count += other.count;
    low = std::min(low, other.low), high = std::max(high, other.high);
  }
};

Sums sums_of_row(const HeightMap& map, Index row) {
  Sums sums;
  double total = 0.0;
  for (Index col = 0; col < map.grid.cols; ++col) {
    const double v = map.at(row, col);
    if (!std::isfinite(v)) continue;
    ++sums.count;
    sums.low = std::min(sums.low, v), sums.high = std::max(sums.high, v), total += v;
  }
  if (sums.count == 0) return sums;
  sums.mean = total / static_cast<double>(sums.count);
  for (Index col = 0; col < map.grid.cols; ++col) {
    const double d = map.at(row, col) - sums.mean;
    if (std::isfinite(d)) sums.square += d * d;
  }
  return sums;
}

}  // namespace

double MapStatistics::rms_about_zero() const { return std::hypot(rms, mean); }

namespace {

/// What is left of a piston that was removed is no mean.
bool has_mean(const MapStatistics& s) {
  constexpr double kNone = 1e-6;  // of the PV
  return std::abs(s.mean) > kNone * s.pv;
}

}  // namespace

const char* about_zero_in_words(const MapStatistics& s) { return has_mean(s) ? " about zero" : ""; }

std::string mean_in_words(const MapStatistics& s) {
  return has_mean(s) ? fmt::format(", mean {:.4g} nm (RMS about it; {:.4g} nm about zero)", s.mean, s.rms_about_zero())
                     : "";
}

std::string in_words(const MapStatistics& s) {
  return fmt::format("RMS {:.4g} nm, PV {:.4g} nm{}{}", s.rms, s.pv,
                     s.pvr ? fmt::format(", PVr {:.4g} nm", *s.pvr) : "", mean_in_words(s));
}

std::string rms_in_words(const MapStatistics& s) { return fmt::format("RMS {:.4g} nm{}", s.rms, mean_in_words(s)); }

MapStatistics map_statistics(const HeightMap& map, const FormTerms& terms, int threads) {
  if (terms.any()) return map_statistics(without_form(map, terms, threads), {}, threads);
  std::vector<Sums> rows(static_cast<std::size_t>(map.grid.rows));
  [[maybe_unused]] const int count = std::max(threads, 1);
#pragma omp parallel for num_threads(count) schedule(static)
  for (Index row = 0; row < map.grid.rows; ++row) rows[static_cast<std::size_t>(row)] = sums_of_row(map, row);
  Sums all;
  for (const Sums& row : rows) all.add(row);
  if (all.count == 0) throw InputError("map has no finite pixel; PV and RMS need at least one");
  return {all.count, all.high - all.low, std::sqrt(all.square / static_cast<double>(all.count)), all.mean};
}

HeightMap without_form(const HeightMap& map, const FormTerms& terms, int threads) {
  HeightMap result = map;
  if (!terms.any()) return result;
  const std::vector<Index> pixels = finite_pixels(map);
  FormPolynomials(map.grid, pixels, terms, {}, threads).remove_from(result.values);
  return result;
}

}  // namespace dwell
