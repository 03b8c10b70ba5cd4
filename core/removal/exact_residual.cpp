#include "core/removal/exact_residual.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/random_draw.h"
#include "core/form/form_polynomials.h"

namespace dwell {
namespace {

// Gauss points of a check of every pixel: half a second, and for the lattice alone a twentieth.
constexpr double kCheap = 6e7, kCheapForLattice = 6e6;
constexpr double kEnough = 0.01;
constexpr Index kFirstBatch = 64, kForLattice = 256;  // at random
constexpr Index kFewestLargest = 64, kMostLargest = 256;

/// So many of the largest residuals are looked at.
Index largest_of(Index pixels, ExactCheck check) {
  return check == ExactCheck::Lattice ? kFewestLargest : std::clamp(pixels / 2000, kFewestLargest, kMostLargest);
}

/// The pixels in the order in which they are looked at: the largest residuals, then the others, at random unless all
/// are looked at in the end.
class LookOrder {
 public:
  /// residual(i), i = 0 ... count - 1.
  template <class Residual>
  LookOrder(Index count, const Residual& residual, Index largest) {
    // The smallest of those kept is on top, of equal ones the last in the list.
    std::vector<std::pair<double, Index>> kept;
    const auto after = [](const auto& a, const auto& b) {
      return a.first > b.first || (a.first == b.first && a.second < b.second);
    };
    largest_ = std::min(largest, count);
    for (Index i = 0; i < count && largest_ > 0; ++i) {
      const std::pair<double, Index> pixel{std::abs(residual(i)), i};
      if (static_cast<Index>(kept.size()) == largest_) {
        if (!after(pixel, kept.front())) continue;
        std::pop_heap(kept.begin(), kept.end(), after);
        kept.pop_back();
      }
      kept.push_back(pixel);
      std::push_heap(kept.begin(), kept.end(), after);
    }
    for (const auto& pixel : kept) places_.push_back(pixel.second);
    std::sort(places_.begin(), places_.end());
    // others_[j]: how many of the others come before the j-th of these.
    for (Index j = 0; j < largest_; ++j) others_.push_back((*this)[j] - j);
    draw_ = RandomDraw(count - largest_, 1);
    count_ = count;
  }

  Index largest() const { return largest_; }
  Index operator[](Index k) const { return places_[static_cast<std::size_t>(k)]; }
  /// Makes [k] known for all k below `end`.
  void extend_to(Index end) {
    const bool all = end == count_ && static_cast<Index>(places_.size()) == largest_;
    places_.reserve(static_cast<std::size_t>(end));
    for (auto k = static_cast<Index>(places_.size()); k < end; ++k)
      places_.push_back(other(all ? k - largest_ : draw_.next()));
  }

 private:
  /// The place of the rank-th that is none of the largest.
  Index other(Index rank) const {
    return rank + (std::upper_bound(others_.begin(), others_.end(), rank) - others_.begin());
  }

  std::vector<Index> places_, others_;
  Index largest_ = 0, count_ = 0;
  RandomDraw draw_{0, 1};
};

/// What is known of the pixels looked at so far.
class ResidualCheck {
 public:
  ResidualCheck(const RemovalProbe& probe, const HeightMap& map, const HeightMap& left, const FormTerms& form,
                int threads, ExactCheck check)
      : probe_(probe),
        map_(map),
        left_(left),
        threads_(threads),
        check_(check),
        pixels_(finite_pixels(map)),
        form_(map.grid, pixels_, form, {}, threads),
        residual_(map.grid) {
    for (const Index pixel : pixels_)
      residual_.values[static_cast<std::size_t>(pixel)] = left.values[static_cast<std::size_t>(pixel)];
    form_.remove_from(residual_.values);
    for (Index i = 0; i < pixels(); ++i) {
      sum_ += residual(i);
      squares_ += residual(i) * residual(i);
    }
    const double mean = sum_ / static_cast<double>(std::max<Index>(1, pixels()));
    order_.emplace(
        pixels(), [&](Index i) { return residual(i) - mean; }, largest_of(pixels(), check));
  }

  ExactResidual run(const Progress& progress) {
    look_at(first_look(), progress);
    ExactResidual result = estimate();
    const auto enough = [&] { return result.all || result.standard_error <= kEnough * result.statistics.rms; };
    while (check_ != ExactCheck::Lattice && !enough()) {
      look_at(order_->largest() + 2 * (looked() - order_->largest()), progress);
      result = estimate();
    }
    result.surface = surface();
    if (check_ != ExactCheck::Lattice) add_ripple(result, progress);
    return result;
  }

 private:
  Index pixels() const { return static_cast<Index>(pixels_.size()); }
  /// Of the k-th of the pixels, by the lattice, form terms removed [nm].
  double residual(Index k) const {
    return residual_.values[static_cast<std::size_t>(pixels_[static_cast<std::size_t>(k)])];
  }
  Index looked() const { return static_cast<Index>(difference_.size()); }

  /// How many pixels are looked at before the first estimate.
  Index first_look() const {
    const bool lattice = check_ == ExactCheck::Lattice;
    const double points = static_cast<double>(pixels()) * probe_.points_under_tool();
    if (check_ == ExactCheck::EveryPixel || points <= (lattice ? kCheapForLattice : kCheap)) return pixels();
    return order_->largest() + (lattice ? kForLattice : kFirstBatch);
  }

  /// Looks at pixels in order until there are so many, or all.
  void look_at(Index count, const Progress& progress) {
    const Index end = std::min(count, pixels());
    order_->extend_to(end);
    std::vector<Index> next;
    for (Index k = looked(); k < end; ++k) next.push_back(pixel_at(k));
    const Vector removal = mean_removal(probe_, map_.grid, next, threads_, progress);
    for (std::size_t k = 0; k < next.size(); ++k) {
      const auto i = static_cast<std::size_t>(next[k]);
      difference_.push_back(map_.values[i] - removal[static_cast<Index>(k)] - left_.values[i]);
    }
  }

  /// How many pixels one of those looked at stands for.
  double weight(Index k) const {
    if (k < order_->largest()) return 1.0;
    return static_cast<double>(pixels() - order_->largest()) / static_cast<double>(looked() - order_->largest());
  }

  Index pixel_at(Index k) const { return pixels_[static_cast<std::size_t>((*order_)[k])]; }

  /// The differences without the form terms that they hold, by weighted least squares over the pixels looked at.
  Vector differences_without_form() const {
    Vector d = Vector::Map(difference_.data(), looked());
    const Index terms = form_.rank();
    if (terms == 0) return d;
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(terms, terms);
    Vector moments = Vector::Zero(terms);
    for (Index k = 0; k < looked(); ++k) {
      const Vector q = form_.at(pixel_at(k));
      gram += weight(k) * q * q.transpose();
      moments += weight(k) * d[k] * q;
    }
    const Vector coefficients = gram.ldlt().solve(moments);
    for (Index k = 0; k < looked(); ++k) d[k] -= form_.at(pixel_at(k)).dot(coefficients);
    return d;
  }

  ExactResidual estimate() const {
    const Vector d = differences_without_form();
    const auto count = static_cast<double>(pixels());
    double squares = squares_, sum = sum_, errors = 0.0;
    double mean = 0.0, scatter = 0.0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (Index k = 0; k < looked(); ++k) {
      const double before = residual((*order_)[k]), after = before + d[k];
      const double change = after * after - before * before;
      squares += weight(k) * change;
      sum += weight(k) * d[k];
      errors += weight(k) * d[k] * d[k];
      low = std::min(low, after);
      high = std::max(high, after);
      if (k < order_->largest()) continue;
      const double n = static_cast<double>(k - order_->largest() + 1), step = change - mean;  // Welford
      mean += step / n;
      scatter += step * (change - mean);
    }
    ExactResidual result;
    result.checked = looked();
    result.all = looked() == pixels();
    const double about_zero = std::sqrt(std::max(0.0, squares / count));
    result.statistics.valid_pixels = pixels();
    result.statistics.mean = sum / count;
    result.statistics.rms =
        std::sqrt(std::max(0.0, about_zero * about_zero - result.statistics.mean * result.statistics.mean));
    result.statistics.pv = high - low;
    result.lattice_rms = std::sqrt(squares_ / count);
    result.lattice_error = std::sqrt(errors / count);
    if (!result.all) {
      const double others = count - static_cast<double>(order_->largest()),
                   n = static_cast<double>(looked() - order_->largest());
      const double deviation = std::sqrt(scatter / (n - 1.0) / n * (1.0 - n / others)) * others / count;
      result.standard_error = about_zero > 0.0 ? 0.5 * deviation / about_zero : deviation;
    }
    return result;
  }

  HeightMap surface() const {
    const Vector d = differences_without_form();
    HeightMap map = residual_;
    for (Index k = 0; k < looked(); ++k) map.values[static_cast<std::size_t>(pixel_at(k))] += d[k];
    return map;
  }

  /// RMS within pixels of the removal less the parabolic surface that has the means of the pixels around, over pixels
  /// at random: until it is known to kEnoughRipple, or so many are looked at as are cheap.
  void add_ripple(ExactResidual& result, const Progress& progress) const {
    constexpr Index kFirst = 24;
    constexpr double kEnoughRipple = 0.02, kCheapRipple = 4e7, kPointsOfAPixel = 57.0;
    const double cheap = kCheapRipple / (kPointsOfAPixel * std::max(1.0, probe_.points_under_tool()));
    const Index most =
        std::min(std::max(kFirst, static_cast<Index>(std::min(cheap, 1e5))), static_cast<Index>(pixels_.size()));
    RandomDraw draw(pixels(), 2);
    std::vector<Index> places;
    std::vector<double> squares;
    for (Index next = kFirst; static_cast<Index>(squares.size()) < most; next *= 2) {
      progress.check();
      const auto first = static_cast<Index>(squares.size()), last = std::min(next, most);
      squares.resize(static_cast<std::size_t>(last));
      for (Index k = first; k < last; ++k) places.push_back(pixels_[static_cast<std::size_t>(draw.next())]);
#pragma omp parallel for num_threads(threads_) schedule(dynamic, 1)
      for (Index k = first; k < last; ++k) {
        const auto i = static_cast<std::size_t>(k);
        squares[i] = ripple_in(map_.grid.centre(places[i]), k);
      }
      set_ripple(result, squares);
      if (result.ripple_error <= kEnoughRipple * result.ripple) return;
    }
  }

  static void set_ripple(ExactResidual& result, const std::vector<double>& squares) {
    const auto n = static_cast<double>(squares.size());
    const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / n;
    double scatter = 0.0;
    for (const double square : squares) scatter += (square - mean) * (square - mean);
    result.ripple = std::sqrt(mean);
    const double deviation = n > 1.0 ? std::sqrt(scatter / (n - 1.0) / n) : mean;
    result.ripple_error = mean > 0.0 ? 0.5 * deviation / result.ripple : 0.0;
  }

  /// Mean square of the ripple in a pixel, at one random place in each of 4 x 4 parts of it.
  double ripple_in(Point centre, Index seed) const {
    constexpr int kParts = 4;
    const Grid& g = map_.grid;
    std::array<std::array<double, 3>, 3> means{};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        const Point beside{(static_cast<double>(c) - 1.0) * g.pitch_x, (static_cast<double>(r) - 1.0) * g.pitch_y};
        means[r][c] = probe_.mean_over_pixel(centre + beside);
      }
    }
    RandomNumbers random(static_cast<std::uint64_t>(seed));
    double sum = 0.0;
    for (int i = 0; i < kParts; ++i) {
      for (int j = 0; j < kParts; ++j) {
        const double u = (j + random.uniform()) / kParts - 0.5, v = (i + random.uniform()) / kParts - 0.5;
        const auto wx = parabola_weights(u), wy = parabola_weights(v);
        double smooth = 0.0;
        for (std::size_t r = 0; r < 3; ++r)
          smooth += wy[r] * (wx[0] * means[r][0] + wx[1] * means[r][1] + wx[2] * means[r][2]);
        const double d = probe_.at(centre + Point{u * g.pitch_x, v * g.pitch_y}) - smooth;
        sum += d * d;
      }
    }
    return sum / (kParts * kParts);
  }

  /// The value, at u pixels from the middle, of the parabola whose means over three pixels these weights multiply.
  static std::array<double, 3> parabola_weights(double u) {
    const double q = u * u - 1.0 / 12.0;
    return {0.5 * (q - u), 1.0 - q, 0.5 * (q + u)};
  }

  const RemovalProbe& probe_;
  const HeightMap& map_;
  const HeightMap& left_;
  int threads_;
  ExactCheck check_;
  std::vector<Index> pixels_;
  FormPolynomials form_;
  HeightMap residual_;                // by the lattice, form terms removed
  double sum_ = 0.0, squares_ = 0.0;  // of the residual
  std::optional<LookOrder> order_;
  std::vector<double> difference_;  // exact less lattice, of the pixels looked at
};

}  // namespace

double ExactResidual::total() const { return std::hypot(statistics.rms_about_zero(), ripple); }

ExactResidual exact_residual(const RemovalProbe& probe, const HeightMap& map, const HeightMap& left,
                             const FormTerms& form, int threads, const Progress& progress, ExactCheck check) {
  return ResidualCheck(probe, map, left, form, threads, check).run(progress);
}

}  // namespace dwell
