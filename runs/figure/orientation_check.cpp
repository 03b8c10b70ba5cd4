#include "runs/figure/orientation_check.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/errors.h"
#include "core/map/map_sampler.h"
#include "core/numerics/plane_transform.h"
#include "solvers/fits/spike_removal.h"

namespace dwell {
namespace {

/// A way in which a part can lie without being rotated by a crooked angle.
struct Lie {
  double xx, xy, yx, yy;
  const char* words;  // what it does to the places
  const char* step;   // the step of a map that does it
};

constexpr std::array<Lie, 8> kLies{
    {{1, 0, 0, 1, "as thought", ""},
     {-1, 0, 0, 1, "flipped left for right (x to -x)", "flip:x"},
     {1, 0, 0, -1, "flipped top for bottom (y to -y)", "flip:y"},
     {-1, 0, 0, -1, "turned by 180 degrees", "rotate:180"},
     {0, -1, 1, 0, "turned by 90 degrees counter-clockwise", "rotate:90"},
     {0, 1, -1, 0, "turned by 90 degrees clockwise", "rotate:270"},
     {0, 1, 1, 0, "with x and y exchanged", "transpose"},
     {0, -1, -1, 0, "with x and y exchanged and turned by 180 degrees", "transpose; rotate:180"}}};

PlaneTransform about(const Lie& lie, Point middle) {
  PlaneTransform transform{lie.xx, lie.xy, lie.yx, lie.yy, {}};
  transform.shift = middle - transform(middle);
  return transform;
}

Point middle_of_part(const HeightMap& map) {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}, high = -1.0 * low;
  for (const Index i : finite_pixels(map)) {
    const Point p = map.grid.centre(i);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return midpoint(low, high);
}

/// A pixel at which removals are compared.
struct ComparedPlace {
  Point place;
  double before = 0.0;
  double removed = 0.0;  // as measured, lone spikes left out
};

/// Some pixels of a map of what was removed, evenly chosen.
std::vector<ComparedPlace> some_places(const HeightMap& before, const HeightMap& removed, Index most) {
  const Grid& g = removed.grid;
  const double per_place = static_cast<double>(removed.valid_pixels()) / static_cast<double>(most);
  const Index stride = std::max<Index>(1, static_cast<Index>(std::ceil(std::sqrt(per_place))));
  std::vector<ComparedPlace> places;
  for (Index r = (g.rows - 1) % stride / 2; r < g.rows; r += stride) {
    for (Index c = (g.cols - 1) % stride / 2; c < g.cols; c += stride) {
      if (std::isfinite(removed.at(r, c))) places.push_back({g.centre(r, c), before.at(r, c), removed.at(r, c)});
    }
  }
  return places;
}

Eigen::Index form_row(const FormTerms& form, Point p, Eigen::Ref<Eigen::RowVectorXd> row) {
  Eigen::Index k = 0;
  if (form.piston) row[k++] = 1.0;
  if (form.tilt) row[k++] = p.x, row[k++] = p.y;
  if (form.power) row[k++] = p.x * p.x + p.y * p.y;
  if (form.astigmatism) row[k++] = p.x * p.x - p.y * p.y, row[k++] = 2.0 * p.x * p.y;
  return k;
}

/// A fit of measured removals by rate times predicted ones and form terms.
class RateFit {
 public:
  RateFit(const FormTerms& form, Point middle, double scale) : form_(form), middle_(middle), scale_(scale) {}

  /// RMS of what is left [nm]; infinite where fewer than half of the places have both values.
  template <class Measured, class Predicted>
  double left(const std::vector<ComparedPlace>& places, const Measured& measured, const Predicted& predicted) const {
    constexpr Eigen::Index kMostTerms = 6;
    const auto all = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXd basis(all, kMostTerms);
    Eigen::VectorXd d(all), p(all);
    Eigen::Index rows = 0, terms = 0;
    for (const ComparedPlace& at : places) {
      d[rows] = measured(at), p[rows] = predicted(at);
      if (!std::isfinite(d[rows]) || !std::isfinite(p[rows])) continue;
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(kMostTerms);
      terms = form_row(form_, (1.0 / scale_) * (at.place - middle_), row);
      basis.row(rows++) = row;
    }
    if (2 * rows < all || rows <= terms + 1) return std::numeric_limits<double>::infinity();
    const Eigen::MatrixXd q = basis.topLeftCorner(rows, terms);
    const Eigen::VectorXd md = without(q, d.head(rows)), mp = without(q, p.head(rows));
    const double square = mp.squaredNorm();
    const double rate = square > 0.0 ? std::max(0.0, md.dot(mp) / square) : 0.0;  // a tool does not add
    return std::sqrt((md - rate * mp).squaredNorm() / static_cast<double>(rows));
  }

 private:
  static Eigen::VectorXd without(const Eigen::MatrixXd& basis, const Eigen::VectorXd& v) {
    if (basis.cols() == 0) return v;
    return v - basis * basis.colPivHouseholderQr().solve(v);
  }

  FormTerms form_;
  Point middle_;
  double scale_;
};

struct Trial {
  std::size_t lie = 0;
  bool of_map = false;
  Point shift;
  double left = std::numeric_limits<double>::infinity();
};

/// The maps of a run, at the places where they are compared.
class LyingMaps {
 public:
  LyingMaps(const HeightMap& before, const HeightMap& after, const HeightMap& predicted, const FormTerms& form,
            int threads, const Progress& progress)
      : predicted_(predicted, progress),
        after_(without_spikes(after, threads, progress).first, progress),
        middle_(middle_of_part(before)),
        fit_(form, middle_, std::max(before.grid.width(), before.grid.height())) {
    HeightMap removed = before;
    for (std::size_t i = 0; i < removed.values.size(); ++i) removed.values[i] -= after.values[i];
    if (removed.valid_pixels() == 0) throw InputError("orientation: the maps before and after have no pixel in common");
    removed = without_spikes(std::move(removed), threads, progress).first;
    fine_ = some_places(before, removed, 4000);
    coarse_ = some_places(before, removed, 500);
  }

  /// How well what was removed fits, lying so and shifted as it fits best, by steps up to the reach [mm].
  Trial removal(std::size_t lie, double reach, double step) const {
    const PlaneTransform back = about(kLies[lie], middle_).inverse();
    const auto left = [&](const std::vector<ComparedPlace>& places, Point shift) {
      return fit_.left(
          places, [](const ComparedPlace& at) { return at.removed; },
          [&](const ComparedPlace& at) { return predicted_(back(at.place - shift)); });
    };
    Trial trial{lie, false, {}, left(fine_, {})};
    const Point shift = best_shift(reach, step, [&](Point s) { return left(coarse_, s); });
    const double shifted = left(fine_, shift);
    if (shifted < kOrientationShare * trial.left) trial.shift = shift, trial.left = shifted;
    return trial;
  }

  /// How well the removal fits if the map after the run is turned so.
  Trial map(std::size_t lie) const {
    const PlaneTransform back = about(kLies[lie], middle_).inverse();
    const double left = fit_.left(
        fine_, [&](const ComparedPlace& at) { return at.before - after_(back(at.place)); },
        [&](const ComparedPlace& at) { return predicted_(at.place); });
    return {lie, true, {}, left};
  }

 private:
  /// Of all shifts by whole steps up to the reach each way, the one that leaves least.
  template <class Left>
  static Point best_shift(double reach, double step, const Left& left) {
    const int steps = static_cast<int>(std::ceil(reach / step - 1e-9));
    Point best;
    double least = left(best);
    for (int y = -steps; y <= steps; ++y) {
      for (int x = -steps; x <= steps; ++x) {
        const Point shift{step * x, step * y};
        const double here = left(shift);
        if (here < least) least = here, best = shift;
      }
    }
    return best;
  }

  MapSampler predicted_, after_;
  Point middle_;
  RateFit fit_;
  std::vector<ComparedPlace> fine_, coarse_;
};

std::string fault_of(const Trial& best, double as_thought) {
  const Lie& lie = kLies[best.lie];
  const std::string fits = fmt::format(
      "it leaves {:.4g} nm RMS of the measured removal unexplained, and {:.4g} as thought", best.left, as_thought);
  if (best.of_map) {
    return fmt::format(
        "the map after the run lies otherwise than the one before: taken as {}, {}; give it with --step '{}', once it "
        "is known to lie so",
        lie.words, fits, lie.step);
  }
  return fmt::format(
      "what was removed lies {}: {}; the part, the map before the run or the machine's axes lie otherwise than the "
      "plan "
      "took them to",
      lie.words, fits);
}

}  // namespace

OrientationCheck check_orientation(const HeightMap& before, const HeightMap& after, const HeightMap& predicted,
                                   const FormTerms& form, const OrientationReach& reach, int threads,
                                   const Progress& progress) {
  const Progress here = progress.of_part("orientation");
  here.step("as thought");
  const LyingMaps maps(before, after, predicted, form, threads, here);
  const Trial thought = maps.removal(0, reach.shift, reach.step);
  Trial best = thought;
  for (std::size_t lie = 1; lie < kLies.size(); ++lie) {
    here.step(kLies[lie].words);
    for (const Trial& trial : {maps.removal(lie, reach.shift, reach.step), maps.map(lie)}) {
      if (trial.left < best.left) best = trial;
    }
  }
  OrientationCheck check{thought.shift, thought.left, best.left, {}};
  if (best.lie != 0 && best.left < kOrientationShare * thought.left) check.fault = fault_of(best, thought.left);
  return check;
}

}  // namespace dwell
