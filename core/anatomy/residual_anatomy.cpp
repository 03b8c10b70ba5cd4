#include "core/anatomy/residual_anatomy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/errors.h"
#include "core/form/form_polynomials.h"
#include "core/form/robust_pv.h"
#include "core/spectra/psd.h"

namespace dwell {
namespace {

double square(double v) { return v * v; }

/// The surface with the level of their surroundings where there are blemishes, less the form of all other pixels: what
/// blemishes add to the form terms is theirs.
HeightMap without_their_form(const HeightMap& residual, const ResidualAnatomy& a, const FormTerms& form, int threads) {
  HeightMap surface = residual;
  if (a.blemishes.empty()) return surface;
  const std::vector<Index> others = finite_pixels(without_blemishes(residual, a.blemishes));
  for (const Blemish& b : a.blemishes) {
    for (std::size_t k = 0; k < b.pixels.size(); ++k)
      surface.values[static_cast<std::size_t>(b.pixels[k])] = b.level[k];
  }
  const FormPolynomials polynomials(residual.grid, others, form, {}, threads);
  polynomials.remove_from(surface.values);
  const FormPolynomials::Polynomial theirs = polynomials.fit(residual.values);
  for (const Blemish& b : a.blemishes) {
    for (const Index i : b.pixels) surface.values[static_cast<std::size_t>(i)] -= polynomials.value_at(theirs, i);
  }
  return surface;
}

/// The interior alone.
HeightMap interior_of(HeightMap interior, const ResidualAnatomy& a) {
  for (std::size_t i = 0; i < interior.values.size(); ++i) {
    if (a.edge.holds[i] != 0) interior.values[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return interior;
}

/// Divides the interior's mean square, of which `mean` is what its own mean holds, by wavelength.
void divide_interior(HeightMap interior, double fwhm, double whole, int threads, ResidualShares& shares) {
  const Index count = interior.valid_pixels();
  if (count == 0 || whole == 0.0) return;
  double mean = 0.0;
  for (const double v : interior.values) mean += std::isfinite(v) ? v : 0.0;
  mean /= static_cast<double>(count);
  double about_mean = 0.0;
  for (double& v : interior.values) {
    v -= mean;
    about_mean += std::isfinite(v) ? v * v : 0.0;
  }
  about_mean /= static_cast<double>(count);
  // The mean would leak through the window into all waves; it is the longest of them.
  const double of_waves = whole * about_mean / (about_mean + mean * mean);
  PsdOptions options;
  options.threads = threads;
  const ArealPsd psd = areal_psd(interior, options);
  const std::vector<double> bands = band_mean_squares(psd, {1.0 / (kLongInFwhm * fwhm), 1.0 / fwhm});
  const double all = bands[0] + bands[1] + bands[2];
  if (all > 0.0) {
    shares.middle = of_waves * bands[1] / all;
    shares.shorter = of_waves * bands[2] / all;
  }
  shares.longer = whole - shares.middle - shares.shorter;
}

}  // namespace

double ResidualAnatomy::share(double part) const {
  const double whole = mean_square.whole();
  return whole > 0.0 ? part / whole : 0.0;
}

double ResidualAnatomy::edge_density() const {
  return edge_pixels > 0 ? mean_square.edge * static_cast<double>(pixels) / static_cast<double>(edge_pixels) : 0.0;
}

double ResidualAnatomy::interior_density() const {
  const Index inside = pixels - blemish_pixels - edge_pixels;
  return inside > 0 ? mean_square.interior() * static_cast<double>(pixels) / static_cast<double>(inside) : 0.0;
}

ResidualAnatomy residual_anatomy(const HeightMap& residual, double fwhm, const FormTerms& form, int threads,
                                 BlemishSearch search, const Progress& progress) {
  if (!(std::isfinite(fwhm) && fwhm > 0.0)) throw InputError("fwhm", fmt::format("{} mm", fwhm), "a finite number > 0");
  ResidualAnatomy a;
  a.fwhm = fwhm;
  a.pixels = residual.valid_pixels();
  if (a.pixels == 0) throw InputError("map has no finite pixel; what is left has no anatomy");
  a.searched = search == BlemishSearch::On;
  if (a.searched) a.blemishes = find_blemishes(residual, {.width = fwhm, .of_fit = true}, threads, progress);
  progress.step("zone at the edge");
  a.edge = edge_zone(residual, fwhm, threads);

  const double each = 1.0 / static_cast<double>(a.pixels);
  std::vector<unsigned char> blemished(residual.values.size(), 0);
  for (const Blemish& b : a.blemishes) {
    double sum = 0.0;
    for (const Index i : b.pixels) {
      blemished[static_cast<std::size_t>(i)] = 1;
      sum += square(residual.values[static_cast<std::size_t>(i)]);
    }
    a.of_blemish.push_back(sum * each);
    a.blemish_pixels += static_cast<Index>(b.pixels.size());
  }
  HeightMap surface = without_their_form(residual, a, form, threads);
  double edge = 0.0, interior = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < residual.values.size(); ++i) {
    const double v = surface.values[i];
    if (!std::isfinite(v)) continue;
    whole += square(residual.values[i]);
    if (blemished[i] != 0) continue;
    if (a.edge.holds[i] != 0) {
      edge += v * v;
      ++a.edge_pixels;
    } else {
      interior += v * v;
    }
  }
  a.mean_square.edge = edge * each;
  if (!a.blemishes.empty()) a.mean_square.blemishes = std::max(0.0, whole - edge - interior) * each;
  progress.step("waves of the interior");
  divide_interior(interior_of(std::move(surface), a), fwhm, interior * each, threads, a.mean_square);
  progress.check();
  if (a.blemish_pixels < a.pixels) {
    if (a.blemishes.empty()) {
      a.without = map_statistics(residual, {}, threads);
    } else {
      const HeightMap rest = without_form(without_blemishes(residual, a.blemishes), form, threads);
      a.without = with_robust_pv(map_statistics(rest, {}, threads), rest, threads);
    }
  }
  return a;
}

}  // namespace dwell
