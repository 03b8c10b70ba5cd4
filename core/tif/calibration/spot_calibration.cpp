#include "core/tif/calibration/spot_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/base/value_range.h"
#include "core/tif/calibration/spot_finder.h"
#include "core/tif/removal_apex.h"

namespace dwell {
namespace {

constexpr double kRadiusInExtents = 2.25;      // of 30 % of the peak: 3.5 sigma of a Gaussian
constexpr double kLeastRadiusInExtents = 1.2;  // room that an edge or a neighbour must leave

void check(const SpotOptions& o) {
  check_range("dwell time", o.dwell_time, ranges::kTime);
  if (o.radius) check_range("radius", *o.radius, ranges::kSize);
  if (!(o.noise_cut >= 0.0 && o.noise_cut <= 0.5)) {
    throw InputError("noise cut", fmt::format("{}", o.noise_cut), "a share of the peak from 0 to 0.5");
  }
  check_range("noise sigmas", o.noise_sigmas, {0.0, 1e6, ""});
  if (o.centre == SpotCentre::Given && o.at.empty()) {
    throw InputError("`centre` at: give the positions that the tool was sent to, `at` X,Y for each spot");
  }
}

/// The spots to calibrate: those at the given places, or all found.
std::vector<FoundSpot> spots_of(const HeightMap& depth, const SpotOptions& options) {
  std::vector<FoundSpot> chosen;
  if (!options.at.empty() && options.radius) {
    for (const Point p : options.at) chosen.push_back({p, *options.radius / kRadiusInExtents});
    return chosen;
  }
  std::vector<FoundSpot> found = find_spots(depth);
  if (options.at.empty()) return found;
  for (const Point p : options.at) {
    const auto nearest = std::min_element(found.begin(), found.end(), [&](const FoundSpot& a, const FoundSpot& b) {
      return distance(a.centre, p) < distance(b.centre, p);
    });
    if (distance(nearest->centre, p) > 2.0 * nearest->extent) {
      throw InputError(
          fmt::format("`at` {},{}: no spot there; the nearest one found is at ({:.4g}, {:.4g}) mm (with "
                      "`radius` the search starts at the place given)",
                      p.x, p.y, nearest->centre.x, nearest->centre.y));
    }
    chosen.push_back(*nearest);
  }
  return chosen;
}

/// How far spots reach if the user does not say: neither into a neighbour nor over the edge.
double radius_of(const HeightMap& depth, const std::vector<FoundSpot>& spots) {
  const Grid& g = depth.grid;
  double extent = 0.0, room = HUGE_VAL;
  for (const FoundSpot& s : spots) extent = std::max(extent, s.extent);
  for (std::size_t a = 0; a < spots.size(); ++a) {
    const Point p = spots[a].centre;
    room = std::min({room, p.x - g.x(0), g.x(g.cols - 1) - p.x, p.y - g.y(0), g.y(g.rows - 1) - p.y});
    for (std::size_t b = 0; b < a; ++b) room = std::min(room, 0.5 * distance(p, spots[b].centre));
    if (room < kLeastRadiusInExtents * extent) {
      throw InputError(fmt::format(
          "spot at ({:.4g}, {:.4g}) mm: it reaches at least {:.4g} mm, but the edge of the map or another spot "
          "is {:.4g} mm away; choose others with `at`, or give `radius`",
          p.x, p.y, extent, room));
    }
  }
  return std::min(kRadiusInExtents * extent, room);
}

struct Sums {
  double peak = 0.0, volume = 0.0;
};

/// Largest value and volume within the radius about `centre`, in the units of the values.
Sums sums_of(const HeightMap& map, Point centre, double radius) {
  Sums sums;
  for (Index i = 0; i < map.grid.size(); ++i) {
    if (distance(map.grid.centre(i), centre) > radius) continue;
    const double v = map.values[static_cast<std::size_t>(i)];
    sums.peak = std::max(sums.peak, v);
    sums.volume += v * map.grid.pitch_x * map.grid.pitch_y;
  }
  return sums;
}

/// Diameter of the disc of the area above half the peak within the radius about the patch's centre.
double half_width(const SpotPatch& patch, double radius) {
  const Grid& g = patch.depth.grid;
  const double half = 0.5 * sums_of(patch.depth, patch.centre, radius).peak;
  Index above = 0;
  for (Index i = 0; i < g.size(); ++i) {
    above += distance(g.centre(i), patch.centre) <= radius && patch.depth.values[static_cast<std::size_t>(i)] >= half;
  }
  return 2.0 * std::sqrt(static_cast<double>(above) * g.pitch_x * g.pitch_y / std::numbers::pi);
}

/// Refuses a spot that was registered away from the place given for it: then it is another spot, or noise.
void refuse_jumps(const std::vector<SpotPatch>& patches, double radius, const std::vector<Point>& at) {
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Point found = patches[k].centre;
    const double width = half_width(patches[k], radius), away = distance(found, at[k]);
    const double reach = 0.5 * width + std::max(patches[k].depth.grid.pitch_x, patches[k].depth.grid.pitch_y);
    if (away <= reach) continue;
    throw InputError(fmt::format(
        "`at` {},{} (spot {} of {}): the spot near there is at ({:.4g}, {:.4g}) mm, {:.4g} mm away; at most {:.4g} mm, "
        "half of its width at half height and a pixel, is accepted: is this its place, in the coordinates of the map?",
        at[k].x, at[k].y, k + 1, at.size(), found.x, found.y, away, reach));
  }
}

Point apex_of_spot(const HeightMap& map, double peak, double radius) {
  if (const auto apex = rounded_apex(map, peak, {}, radius)) return *apex;
  throw InputError(
      "`centre` peak: the top of the spot is not rounded (a ring, several peaks, or noise), or has fewer than 9 pixels "
      "above 70 %; use centroid or at");
}

Point axis_of(const SpotPatch& mean, const std::vector<SpotPatch>& patches, double peak, double radius,
              const SpotOptions& options) {
  if (options.centre == SpotCentre::Peak) return apex_of_spot(mean.depth, peak, radius);
  if (options.centre == SpotCentre::Centroid) return spot_centroid(mean, {}, radius, 0.1);
  Point sum;
  for (std::size_t k = 0; k < patches.size(); ++k) sum = sum + options.at[k] - patches[k].centre;
  return (1.0 / static_cast<double>(patches.size())) * sum;
}

const char* word(SpotCentre centre) {
  return centre == SpotCentre::Centroid ? "its centroid"
         : centre == SpotCentre::Peak   ? "its peak"
                                        : "the given position";
}

const char* word(SpotBaseline baseline) {
  return baseline == SpotBaseline::Plane ? "plane" : baseline == SpotBaseline::Constant ? "constant" : "no baseline";
}

/// Sets what is beyond the radius about the spot's own middle, or below the noise, to zero.
double cut_noise(HeightMap& rates, double radius, double level) {
  double before = 0.0, after = 0.0;
  for (Index i = 0; i < rates.grid.size(); ++i) {
    double& v = rates.values[static_cast<std::size_t>(i)];
    if (length(rates.grid.centre(i)) > radius) {
      v = 0.0;
      continue;
    }
    before += v;
    if (v < level) v = 0.0;
    after += v;
  }
  return (before - after) / before;
}

/// Cuts out all spots. Refuses one where the surface has risen.
std::vector<SpotPatch> cut_spots(const HeightMap& depth, const std::vector<FoundSpot>& spots, double radius,
                                 SpotBaseline baseline) {
  std::vector<Point> centres;
  centres.reserve(spots.size());
  for (const FoundSpot& s : spots) centres.push_back(s.centre);
  std::vector<SpotPatch> patches;
  for (const Point p : centres) {
    patches.push_back(cut_spot(depth, p, radius, centres, baseline));
    const Sums sums = sums_of(patches.back().depth, p, radius);
    if (sums.volume > 0.0) continue;
    double rise = 0.0;
    for (const double v : patches.back().depth.values) rise = std::max(rise, -v);
    refuse_rise(rise, sums.peak);
  }
  return patches;
}

void append_history(std::vector<std::string>& history, const SpotOptions& options, std::size_t spots, double radius,
                    double level) {
  history.push_back(fmt::format("tif: {} spot{} of {} s, baseline {} from {:.4g} to {:.4g} mm around", spots,
                                spots > 1 ? "s averaged" : "", options.dwell_time, word(options.baseline), radius,
                                1.6 * radius));
  history.push_back(fmt::format("tif: rates below {:.4g} nm/s and beyond {:.4g} mm set to 0, tool axis at {}", level,
                                radius, word(options.centre)));
}

}  // namespace

SpotCentre parse_spot_centre(const std::string& text) {
  if (text == "centroid") return SpotCentre::Centroid;
  if (text == "peak") return SpotCentre::Peak;
  if (text == "at") return SpotCentre::Given;
  throw InputError(fmt::format("'{}'; accepted: centroid, peak, at", text));
}

SpotBaseline parse_spot_baseline(const std::string& text) {
  if (text == "plane") return SpotBaseline::Plane;
  if (text == "constant") return SpotBaseline::Constant;
  if (text == "none") return SpotBaseline::None;
  throw InputError(fmt::format("'{}'; accepted: plane, constant, none", text));
}

SpotRegistration parse_spot_registration(const std::string& text) {
  if (text == "centroid") return SpotRegistration::Centroid;
  if (text == "least-squares") return SpotRegistration::LeastSquares;
  throw InputError(fmt::format("'{}'; accepted: centroid, least-squares", text));
}

HeightMap removed_depth(const HeightMap& before, const HeightMap& after) {
  const Grid &a = before.grid, &b = after.grid;
  const bool same = a.rows == b.rows && a.cols == b.cols && std::abs(a.pitch_x - b.pitch_x) <= 1e-6 * b.pitch_x &&
                    std::abs(a.pitch_y - b.pitch_y) <= 1e-6 * b.pitch_y &&
                    std::abs(a.origin.x - b.origin.x) <= 0.01 * b.pitch_x &&
                    std::abs(a.origin.y - b.origin.y) <= 0.01 * b.pitch_y;
  if (!same) {
    throw InputError(
        fmt::format("`before` has {} x {} pixels of {:.6g} x {:.6g} mm from ({:.6g}, {:.6g}) mm, the map after {} x {} "
                    "of {:.6g} x {:.6g} mm "
                    "from ({:.6g}, {:.6g}) mm; the same grid is required",
                    a.rows, a.cols, a.pitch_x, a.pitch_y, a.origin.x, a.origin.y, b.rows, b.cols, b.pitch_x, b.pitch_y,
                    b.origin.x, b.origin.y));
  }
  HeightMap depth = after;
  for (std::size_t i = 0; i < depth.values.size(); ++i) depth.values[i] = before.values[i] - after.values[i];
  return depth;
}

SpotCalibration calibrate_spots(const HeightMap& depth, const SpotOptions& options) {
  check(options);
  const std::vector<FoundSpot> spots = spots_of(depth, options);
  SpotCalibration result;
  result.radius = options.radius ? *options.radius : radius_of(depth, spots);
  const double radius = result.radius, per_second = 1.0 / options.dwell_time;
  std::vector<SpotPatch> patches = cut_spots(depth, spots, radius, options.baseline);
  for (const SpotPatch& patch : patches) result.filled_pixels += patch.filled_inside;
  register_spots(patches, radius, options.registration);
  refuse_jumps(patches, radius, options.at);
  SpotMean mean = average_spots(patches);
  double scatter = 0.0;
  for (const SpotPatch& patch : patches) {
    const Sums sums = sums_of(patch.depth, patch.centre, radius);
    result.spots.push_back(
        {patch.centre, per_second * sums.peak, per_second * sums.volume, per_second * patch.scatter});
    scatter += per_second * patch.scatter / static_cast<double>(patches.size());
  }
  const double peak = sums_of(mean.mean, {}, radius).peak;
  SpotPatch for_axis;
  for_axis.depth = mean.mean;
  const Point axis = axis_of(for_axis, patches, peak, radius, options);
  for (HeightMap* map : {&mean.mean, &mean.deviation}) {
    for (double& v : map->values) v *= per_second;
    map->quantity = MapQuantity::Rate;
  }
  const double of_mean = scatter / std::sqrt(static_cast<double>(patches.size()));
  const double level = std::max(options.noise_cut * peak * per_second, options.noise_sigmas * of_mean);
  result.volume_cut = cut_noise(mean.mean, radius, level);
  result.rates = std::move(mean.mean);
  result.deviation = std::move(mean.deviation);
  result.rates.grid.origin = result.rates.grid.origin - axis;
  result.deviation.grid.origin = result.rates.grid.origin;
  result.rates.history = depth.history;
  append_history(result.rates.history, options, patches.size(), radius, level);
  return result;
}

}  // namespace dwell
