#pragma once

#include <cstddef>
#include <vector>

namespace dwell {

enum class ProfileQuantity { Slope, Height };

/// A line over a part, as a long-trace profiler, a NOM or an interferometer gives it. The slope is the derivative of
/// the height, in urad (= nm/mm): rad and tangent are taken for one, which is true to 0.003 urad up to 2 mrad.
struct LineProfile {
  ProfileQuantity measured = ProfileQuantity::Slope;  // the other one is made from it
  std::vector<double> x;                              // increasing [mm]
  std::vector<double> slope;                          // [urad]
  std::vector<double> height;                         // [nm]

  const std::vector<double>& values() const { return measured == ProfileQuantity::Slope ? slope : height; }
};

/// The least number of places of a profile: those of a cubic spline.
inline constexpr std::size_t kFewestPlaces = 4;

/// The profile of measured values [urad or nm]. From slopes, the heights are the integral of the cubic spline through
/// them (core/numerics/cubic_spline.h), with mean 0; from heights, the slopes are the derivative of the spline through
/// those. Throws std::invalid_argument for fewer than four places or another number of values. Cost O(places).
LineProfile line_profile(ProfileQuantity measured, std::vector<double> x, std::vector<double> values);

/// The length that each place stands for [mm]: half of the way to its neighbours, at an end the whole way to the one
/// that it has, so that places at equal distances count the same. At least two places.
std::vector<double> place_lengths(const std::vector<double>& x);

/// Figures of a profile; RMS about the mean, a place counting by the length that it stands for.
struct ProfileFigures {
  double slope_rms = 0.0, slope_pv = 0.0;    // [urad]
  double height_rms = 0.0, height_pv = 0.0;  // [nm]
};
ProfileFigures profile_figures(const LineProfile& profile);

/// RMS about the mean, a value counting by its weight.
double rms_about_mean(const std::vector<double>& values, const std::vector<double>& weights);

/// Distances between neighbours [mm].
struct ProfileSpacing {
  double least = 0.0, median = 0.0, most = 0.0;
};
ProfileSpacing profile_spacing(const LineProfile& profile);

}  // namespace dwell
