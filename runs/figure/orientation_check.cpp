#include "runs/figure/orientation_check.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/grid_limit.h"
#include "core/map/map_crop.h"
#include "core/map/map_sampler.h"
#include "core/numerics/median.h"
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

/// What is measured and what is predicted at the places, NaN where there is none.
struct RemovalValues {
  Eigen::VectorXd measured, predicted;
};

std::vector<double> finite_values(const Eigen::VectorXd& v) {
  std::vector<double> values;
  for (const double value : v) {
    if (std::isfinite(value)) values.push_back(value);
  }
  return values;
}

/// Robust standard deviation about the median; infinite of no values.
double robust_spread(const Eigen::VectorXd& v) {
  std::vector<double> values = finite_values(v);
  if (values.empty()) return std::numeric_limits<double>::infinity();
  const double middle = upper_median(values);
  for (double& value : values) value = std::abs(value - middle);
  return kSigmaPerMedianDeviation * upper_median(std::move(values));
}

double standard_deviation(const Eigen::VectorXd& v) {
  const std::vector<double> values = finite_values(v);
  const auto finite = Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return values.empty() ? 0.0 : std::sqrt((finite - finite.mean()).square().mean());
}

/// Holds values that no removal makes (dust, clamps) to what the others span, or the predicted ones: where most of a
/// part is left alone, what is removed is itself far from the median.
void hold_outliers(Eigen::VectorXd& v, const Eigen::VectorXd& predicted) {
  constexpr double kSpan = 4.0;  // standard deviations
  const double most = kSpan * std::max(robust_spread(v), standard_deviation(predicted));
  if (!std::isfinite(most)) return;
  const double middle = upper_median(finite_values(v));
  for (double& value : v) {
    if (std::isfinite(value)) value = std::clamp(value, middle - most, middle + most);
  }
}

/// A fit of measured removals by rate times predicted ones and form terms.
class RateFit {
 public:
  RateFit(const FormTerms& form, Point middle, double scale) : form_(form), middle_(middle), scale_(scale) {}

  /// What is left counts up to this size [nm]: a clamp or an edge that no fit explains shall not decide.
  void limit_sizes(double most) { most_ = most; }

  /// RMS of what is left [nm] at the places where `both` also has values; infinite where these are fewer than half.
  double left(const std::vector<ComparedPlace>& places, const RemovalValues& values, const RemovalValues& both) const {
    constexpr Eigen::Index kMostTerms = 6;
    const auto all = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXd basis(all, kMostTerms);
    Eigen::VectorXd d(all), p(all);
    Eigen::Index rows = 0, terms = 0;
    for (Eigen::Index k = 0; k < all; ++k) {
      const double others = both.measured[k] + both.predicted[k];
      if (!std::isfinite(values.measured[k] + values.predicted[k] + others)) continue;
      d[rows] = values.measured[k], p[rows] = values.predicted[k];
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(kMostTerms);
      terms = form_row(form_, (1.0 / scale_) * (places[static_cast<std::size_t>(k)].place - middle_), row);
      basis.row(rows++) = row;
    }
    if (2 * rows < all || rows <= terms + 1) return std::numeric_limits<double>::infinity();
    const Eigen::MatrixXd q = basis.topLeftCorner(rows, terms);
    // Fitted to what a removal may be, judged by what was measured.
    Eigen::VectorXd held = d.head(rows);
    hold_outliers(held, p.head(rows));
    const Eigen::VectorXd level = level_of(q, held), mp = p.head(rows) - level_of(q, p.head(rows));
    const double square = mp.squaredNorm();
    const double rate = square > 0.0 ? std::max(0.0, (held - level).dot(mp) / square) : 0.0;  // a tool does not add
    const Eigen::ArrayXd sizes = (d.head(rows) - level - rate * mp).array().abs().min(most_);
    return std::sqrt(sizes.square().mean());
  }

 private:
  static Eigen::VectorXd level_of(const Eigen::MatrixXd& basis, const Eigen::VectorXd& v) {
    if (basis.cols() == 0) return Eigen::VectorXd::Zero(v.size());
    return basis * basis.colPivHouseholderQr().solve(v);
  }

  FormTerms form_;
  Point middle_;
  double scale_;
  double most_ = std::numeric_limits<double>::infinity();
};

/// A way in which part or map may lie, and what it explains.
struct Trial {
  std::size_t lie = 0;
  bool of_map = false;
  Point shift;
  double left = std::numeric_limits<double>::infinity();          // over its own places [nm]
  double thought_left = std::numeric_limits<double>::infinity();  // of the maps as thought, at the same places [nm]
  Point from, to;                                                 // of a map: its middle, and where that belongs

  double ratio() const { return thought_left > 0.0 ? left / thought_left : 1.0; }
};

/// The maps of a run, at the places where they are compared.
class LyingMaps {
 public:
  LyingMaps(const HeightMap& before, const HeightMap& after, const HeightMap& removed, const HeightMap& predicted,
            const FormTerms& form, int threads, const Progress& progress)
      : predicted_(predicted, progress),
        after_(without_spikes(after, threads, progress).first, progress),
        middle_(middle_of_data(before)),
        middle_of_after_(middle_of_data(after)),
        fit_(form, middle_, std::max(before.grid.width(), before.grid.height())) {
    const HeightMap clear = without_spikes(removed, threads, progress).first;
    fine_ = some_places(before, clear, 4000);
    coarse_ = some_places(before, clear, 500);
    thought_ = removal_values(fine_, {}, {});
    fit_.limit_sizes(0.5 * std::max(robust_spread(thought_.measured), standard_deviation(thought_.predicted)));
  }

  /// How well what was removed fits, lying so and shifted as it fits best, by steps up to the reach [mm].
  Trial removal(std::size_t lie, double reach, double step) const {
    const PlaneTransform back = about(kLies[lie], middle_).inverse();
    Trial trial;
    trial.lie = lie;
    const auto judge = [&](Point shift) {
      const RemovalValues values = removal_values(fine_, back, shift);
      return std::pair(fit_.left(fine_, values, thought_), fit_.left(fine_, thought_, values));
    };
    std::tie(trial.left, trial.thought_left) = judge({});
    const Point shift = best_shift(reach, step, [&](Point s) {
      const RemovalValues values = removal_values(coarse_, back, s);
      return fit_.left(coarse_, values, values);
    });
    const auto [left, thought_left] = judge(shift);
    if (left < kOrientationShare * trial.left)
      trial.shift = shift, trial.left = left, trial.thought_left = thought_left;
    return trial;
  }

  /// How well the removal fits if the map after the run is turned so, its middle on that of the part.
  Trial map(std::size_t lie) const {
    PlaneTransform turn = about(kLies[lie], middle_of_after_);
    turn.shift = turn.shift + middle_ - middle_of_after_;
    const PlaneTransform back = turn.inverse();
    RemovalValues values = thought_;
    for (std::size_t k = 0; k < fine_.size(); ++k)
      values.measured[static_cast<Eigen::Index>(k)] = fine_[k].before - after_(back(fine_[k].place));
    Trial trial;
    trial.lie = lie, trial.of_map = true, trial.from = middle_of_after_, trial.to = middle_;
    trial.left = fit_.left(fine_, values, thought_);
    trial.thought_left = fit_.left(fine_, thought_, values);
    return trial;
  }

 private:
  /// With the predicted removal moved: `back` leads from places on the part to those where it was predicted.
  RemovalValues removal_values(const std::vector<ComparedPlace>& places, const PlaneTransform& back,
                               Point shift) const {
    const auto size = static_cast<Eigen::Index>(places.size());
    RemovalValues values{Eigen::VectorXd(size), Eigen::VectorXd(size)};
    for (Eigen::Index k = 0; k < size; ++k) {
      const ComparedPlace& at = places[static_cast<std::size_t>(k)];
      values.measured[k] = at.removed;
      values.predicted[k] = predicted_(back(at.place - shift));
    }
    return values;
  }

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
  Point middle_, middle_of_after_;
  RateFit fit_;
  std::vector<ComparedPlace> fine_, coarse_;
  RemovalValues thought_;
};

/// The steps that bring a map to lie so, with its middle where it belongs.
std::string steps_of(const Trial& trial, const Grid& after, double pixel) {
  std::string turn = kLies[trial.lie].step;
  if (distance(trial.from, middle_of(after)) > 0.5 * pixel) {
    const std::string about = fmt::format(",about={:.6g}/{:.6g}", trial.from.x, trial.from.y);
    const std::size_t second = turn.find(';');
    turn = second == std::string::npos ? (turn == "transpose" ? "transpose:" + about.substr(1) : turn + about)
                                       : "transpose:" + about.substr(1) + turn.substr(second) + about;
  }
  if (distance(trial.from, trial.to) < 0.5 * pixel) return turn;
  return fmt::format("{}; fiducials:shift,from={:.6g}/{:.6g},to={:.6g}/{:.6g}", turn, trial.from.x, trial.from.y,
                     trial.to.x, trial.to.y);
}

std::string fault_of(const Trial& best, const Grid& after, double pixel) {
  const Lie& lie = kLies[best.lie];
  const std::string fits =
      fmt::format("that leaves {:.4g} nm RMS of the measured removal unexplained, and {:.4g} as thought", best.left,
                  best.thought_left);
  if (best.of_map) {
    return fmt::format(
        "the map after the run lies otherwise than the one before: taken as {}, {}; give it with --step '{}', once it "
        "is known to lie so",
        lie.words, fits, steps_of(best, after, pixel));
  }
  return fmt::format(
      "what was removed lies {}: {}; the part, the map before the run or the machine's axes lie otherwise than the "
      "plan "
      "took them to",
      lie.words, fits);
}

}  // namespace

OrientationCheck check_orientation(const HeightMap& before, const HeightMap& after, const HeightMap& removed,
                                   const HeightMap& predicted, const FormTerms& form, const OrientationReach& reach,
                                   int threads, const Progress& progress) {
  const Progress here = progress.of_part("orientation");
  here.step("as thought");
  const LyingMaps maps(before, after, removed, predicted, form, threads, here);
  const Trial thought = maps.removal(0, reach.shift, reach.step);
  OrientationCheck check{thought.shift, thought.left, thought.left, {}};
  Trial best = thought;
  double least = kOrientationShare;
  for (std::size_t lie = 1; lie < kLies.size(); ++lie) {
    here.step(kLies[lie].words);
    for (const Trial& trial : {maps.removal(lie, reach.shift, reach.step), maps.map(lie)}) {
      check.best = std::min(check.best, trial.left);
      // Against the maps as thought at the same places, and, shifted as they may be, against them at all.
      const double ratio = std::max(trial.ratio(), trial.left / thought.left);
      if (ratio < least) least = ratio, best = trial;
    }
  }
  if (best.lie != 0) check.fault = fault_of(best, after.grid, std::min(before.grid.pitch_x, before.grid.pitch_y));
  return check;
}

}  // namespace dwell
