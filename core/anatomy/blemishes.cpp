#include "core/anatomy/blemishes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/anatomy/surroundings.h"
#include "core/base/errors.h"
#include "core/numerics/median.h"

namespace dwell {
namespace {

// A first look passes on what is beyond this share of the sigmas, since of few pairs the standard deviation is known to
// a third only; the height, which is known better, has to be this share of the least that counts.
constexpr double kGlance = 0.5, kGlanceHeight = 0.75;

/// A pixel of a row that the first look keeps; its height is NaN where that says nothing.
struct Kept {
  Index col;
  double height;
};

/// A pixel that belongs to a blemish, and how it lies.
struct Spot {
  Index pixel;
  Deviation deviation;
};

class Search {
 public:
  Search(const HeightMap& map, const BlemishOptions& options, int threads, const Progress& progress)
      : map_(map),
        options_(options),
        around_(map, options.width),
        threads_(std::max(threads, 1)),
        progress_(progress) {}

  std::vector<Blemish> run() {
    glance_at_all();
    look_again();
    return clusters();
  }

 private:
  bool is_beyond(const Deviation& d, double sigmas) const {
    return std::abs(d.height) > std::max(sigmas * std::max(d.sigma, least_sigma_), kBeyondStep * d.step);
  }

  /// Calls visit(row) for all rows on all threads, and shows how far it is.
  template <class Visit>
  void for_rows(const char* what, const Visit& visit) const {
    const Index rows = map_.grid.rows, at_once = std::max<Index>(64 * threads_, 1);
    for (Index first = 0; first < rows; first += at_once) {
      progress_.step(fmt::format("blemishes: {}, row {} of {}", what, first, rows));
      const Index end = std::min(first + at_once, rows);
#pragma omp parallel for num_threads(threads_) schedule(dynamic, 4)
      for (Index row = first; row < end; ++row) visit(row);
    }
  }

  /// Every pixel in the light of a few pairs. What is far from them, or has too few, is kept; so is the scatter of all.
  void glance_at_all() {
    const Index rows = map_.grid.rows, cols = map_.grid.cols;
    kept_.resize(static_cast<std::size_t>(rows));
    std::vector<std::vector<double>> scatter(static_cast<std::size_t>(rows));
    const Index every = std::max<Index>(1, map_.grid.size() / kSampled);
    for_rows("first look", [&](Index row) {
      auto& kept = kept_[static_cast<std::size_t>(row)];
      auto& sample = scatter[static_cast<std::size_t>(row)];
      std::vector<double> heights(static_cast<std::size_t>(cols)), sigmas = heights;
      around_.glance_at_row(row, heights, sigmas);
      for (Index col = 0; col < cols; ++col) {
        const auto i = static_cast<std::size_t>(col);
        const double height = std::abs(heights[i]);
        if (!(height <= kGlance * options_.sigmas * sigmas[i]))
          kept.push_back({col, height});  // also where a glance says nothing
        if (std::isfinite(height) && (row * cols + col) % every == 0) sample.push_back(height);
      }
    });
    std::vector<double> all;
    for (const auto& row : scatter) all.insert(all.end(), row.begin(), row.end());
    // Where hardly two pixels differ, the rounding of heights is no noise.
    double largest = 0.0;
    for (const double v : map_.values) largest = std::isfinite(v) ? std::max(largest, std::abs(v)) : largest;
    least_sigma_ = kRounding * largest;
    if (!all.empty())
      least_sigma_ = std::max(least_sigma_, kQuietest * kSigmaPerMedianDeviation * upper_median(std::move(all)));
  }

  /// What the first look kept, in the light of all pairs: those beyond all sigmas begin a blemish.
  void look_again() {
    std::vector<std::vector<Spot>> spots(kept_.size());
    for_rows("second look", [&](Index row) {
      for (const auto& [col, height] : kept_[static_cast<std::size_t>(row)]) {
        if (height < kGlanceHeight * options_.sigmas * least_sigma_) continue;
        const auto d = around_.deviation(row, col);
        if (d && is_beyond(*d, options_.sigmas))
          spots[static_cast<std::size_t>(row)].push_back({map_.grid.index(row, col), *d});
      }
    });
    for (const auto& row : spots) seeds_.insert(seeds_.end(), row.begin(), row.end());
  }

  std::vector<Blemish> clusters() {
    std::unordered_map<Index, Deviation> seeds;
    for (const Spot& s : seeds_) seeds.emplace(s.pixel, s.deviation);
    std::vector<Blemish> found;
    for (const Spot& seed : seeds_) {
      if (taken_.contains(seed.pixel)) continue;
      progress_.check();
      std::vector<Spot> cluster = grown(seed, seeds, true);
      // With its skirt it may reach into what is no blemish; then what is beyond all sigmas stands alone.
      if (!narrow(cluster)) {
        for (const Spot& s : cluster) taken_.erase(s.pixel);
        cluster = grown(seed, seeds, false);
      }
      if (narrow(cluster)) found.push_back(blemish_of(std::move(cluster)));
    }
    if (options_.of_fit) drop_halos(found);
    const auto square = [&](const Blemish& b) {
      double sum = 0.0;
      for (const Index i : b.pixels)
        sum += map_.values[static_cast<std::size_t>(i)] * map_.values[static_cast<std::size_t>(i)];
      return sum;
    };
    std::stable_sort(found.begin(), found.end(),
                     [&](const Blemish& a, const Blemish& b) { return square(a) > square(b); });
    return found;
  }

  void drop_halos(std::vector<Blemish>& found) const {
    const std::vector<Blemish> all = found;
    std::erase_if(found, [&](const Blemish& b) {
      return std::any_of(all.begin(), all.end(), [&](const Blemish& other) {
        return other.height * b.height < 0.0 && std::abs(other.height) >= kHigherThanItsHalo * std::abs(b.height) &&
               distance(other.place, b.place) < options_.width;
      });
    });
  }

  /// All pixels that touch, on the seed's side of the surroundings: those beyond all sigmas, and with `skirt` those
  /// beyond their share of them.
  std::vector<Spot> grown(const Spot& seed, const std::unordered_map<Index, Deviation>& seeds, bool skirt) {
    const bool above = seed.deviation.height > 0.0;
    std::vector<Spot> cluster{seed};
    taken_.emplace(seed.pixel, true);
    const Index cols = map_.grid.cols;
    for (std::size_t k = 0; k < cluster.size() && static_cast<Index>(k) < most_pixels(); ++k) {
      const bool core = seeds.contains(cluster[k].pixel);
      const Index row = cluster[k].pixel / cols, col = cluster[k].pixel % cols;
      for (Index r = std::max<Index>(row - 1, 0); r <= std::min(row + 1, map_.grid.rows - 1); ++r) {
        for (Index c = std::max<Index>(col - 1, 0); c <= std::min(col + 1, cols - 1); ++c) {
          const Index pixel = r * cols + c;
          if (taken_.contains(pixel)) continue;
          const auto known = seeds.find(pixel);
          std::optional<Deviation> d;
          if (known != seeds.end()) {
            d = known->second;
          } else if (skirt && core) {
            d = around_.deviation(r, c);
            if (d && !is_beyond(*d, kBlemishSkirt * options_.sigmas)) d.reset();
          }
          if (!d || (d->height > 0.0) != above) continue;
          taken_.emplace(pixel, true);
          cluster.push_back({pixel, *d});
        }
      }
    }
    return cluster;
  }

  /// A cluster of more is no speck, whatever its shape: a tenth of the map, or a hundred discs of the width.
  Index most_pixels() const {
    const Grid& g = map_.grid;
    const double discs = 100.0 * options_.width * options_.width / (g.pitch_x * g.pitch_y);
    return std::max<Index>(64, static_cast<Index>(std::min(0.1 * static_cast<double>(g.size()), discs)));
  }

  bool narrow(const std::vector<Spot>& cluster) const {
    if (static_cast<Index>(cluster.size()) >= most_pixels()) return false;
    return blemish_width(map_.grid, pixels_of(cluster)) < options_.width;
  }

  static std::vector<Index> pixels_of(const std::vector<Spot>& cluster) {
    std::vector<Index> pixels;
    pixels.reserve(cluster.size());
    for (const Spot& s : cluster) pixels.push_back(s.pixel);
    std::sort(pixels.begin(), pixels.end());
    return pixels;
  }

  Blemish blemish_of(std::vector<Spot> cluster) const {
    std::sort(cluster.begin(), cluster.end(), [](const Spot& a, const Spot& b) { return a.pixel < b.pixel; });
    const Grid& g = map_.grid;
    Blemish b;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const Spot& s : cluster) {
      b.pixels.push_back(s.pixel);
      b.level.push_back(s.deviation.middle);
      b.place = b.place + g.centre(s.pixel);
      if (std::abs(s.deviation.height) > std::abs(b.height)) b.height = s.deviation.height;
    }
    b.place = (1.0 / static_cast<double>(cluster.size())) * b.place;
    for (const Spot& s : cluster) {
      const Point d = g.centre(s.pixel) - b.place;
      xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y;
    }
    const double along = 0.5 * std::atan2(2.0 * xy, xx - yy), c = std::cos(along), s = std::sin(along);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Index i : b.pixels) {
      const Point p = g.centre(i) - b.place;
      low = std::min(low, c * p.x + s * p.y), high = std::max(high, c * p.x + s * p.y);
    }
    b.length = high - low + std::abs(c) * g.pitch_x + std::abs(s) * g.pitch_y;
    b.width = blemish_width(g, b.pixels);
    return b;
  }

  static constexpr Index kSampled = 500000;  // pixels of which the scatter of the map is taken
  static constexpr double kRounding = 1e-9;

  const HeightMap& map_;
  const BlemishOptions& options_;
  Surroundings around_;
  int threads_;
  const Progress& progress_;
  double least_sigma_ = 0.0;
  std::vector<std::vector<Kept>> kept_;  // a row each
  std::vector<Spot> seeds_;
  std::unordered_map<Index, bool> taken_;
};

void check(const BlemishOptions& o) {
  if (!(std::isfinite(o.width) && o.width > 0.0)) {
    throw InputError("width", fmt::format("{} mm", o.width), "a finite number > 0");
  }
  if (!(std::isfinite(o.sigmas) && o.sigmas > 0.0)) {
    throw InputError("sigmas", fmt::format("{}", o.sigmas), "a finite number > 0");
  }
}

}  // namespace

std::vector<Blemish> find_blemishes(const HeightMap& map, const BlemishOptions& options, int threads,
                                    const Progress& progress) {
  check(options);
  return Search(map, options, threads, progress).run();
}

double blemish_width(const Grid& grid, const std::vector<Index>& pixels) {
  if (pixels.empty()) return 0.0;
  Index left = grid.cols, right = -1;
  for (const Index i : pixels) left = std::min(left, i % grid.cols), right = std::max(right, i % grid.cols);
  // A box with a rim of one pixel, in which every pixel of the cluster knows how many lie in a run up to it.
  const Index top = pixels.front() / grid.cols, rows = pixels.back() / grid.cols - top + 3, cols = right - left + 3;
  const auto at = [&](Index i) { return (i / grid.cols - top + 1) * cols + i % grid.cols - left + 1; };
  const double diagonal = std::hypot(grid.pitch_x, grid.pitch_y);
  struct Direction {
    Index back;    // to the pixel before in the run
    double pitch;  // [mm]
  };
  const std::array<Direction, 4> directions{
      {{1, grid.pitch_x}, {cols, grid.pitch_y}, {cols + 1, diagonal}, {cols - 1, diagonal}}};
  std::vector<double> thickness(pixels.size(), std::numeric_limits<double>::infinity());
  for (const Direction& d : directions) {
    std::vector<Index> before(static_cast<std::size_t>(rows * cols), 0), after = before;
    const auto run = [&](std::vector<Index>& length, Index place, Index step) {
      length[static_cast<std::size_t>(place)] = 1 + length[static_cast<std::size_t>(place + step)];
    };
    for (auto i = pixels.begin(); i != pixels.end(); ++i) run(before, at(*i), -d.back);
    for (auto i = pixels.rbegin(); i != pixels.rend(); ++i) run(after, at(*i), d.back);
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const auto place = static_cast<std::size_t>(at(pixels[k]));
      thickness[k] = std::min(thickness[k], d.pitch * static_cast<double>(before[place] + after[place] - 1));
    }
  }
  return *std::max_element(thickness.begin(), thickness.end());
}

HeightMap without_blemishes(HeightMap map, const std::vector<Blemish>& blemishes) {
  for (const Blemish& b : blemishes) {
    for (const Index i : b.pixels) map.values[static_cast<std::size_t>(i)] = std::numeric_limits<double>::quiet_NaN();
  }
  return map;
}

}  // namespace dwell
