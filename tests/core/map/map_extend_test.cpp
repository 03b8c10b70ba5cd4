#include "core/map/map_extend.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/base/expect_error.h"
#include "tests/core/map/uneven_map.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::kNoData;
using test::map_of;
using test::uneven_map;

constexpr double kPi = std::numbers::pi;

struct Nearest {
  double away = 1e300, height = 0.0;
};

Nearest nearest_by_search(const HeightMap& map, Point p) {
  Nearest best;
  for (const Index i : finite_pixels(map)) {
    const double away = distance(map.grid.centre(i), p);
    if (away < best.away - 1e-12) best = {away, map.values[static_cast<std::size_t>(i)]};
  }
  return best;
}

ExtendOptions options_of(Extension how, double width) {
  ExtendOptions options;
  options.how = how, options.width = width, options.shortest = 2.0;
  return options;
}

TEST(Extend, KeepsTheDataToTheBitAndReachesAsFarAsTheWidth) {
  const HeightMap map = uneven_map();
  for (const Extension how :
       {Extension::Zero, Extension::Nearest, Extension::Decay, Extension::Harmonic, Extension::Gerchberg}) {
    ExtendSummary summary;
    const HeightMap wide = extend_map(map, options_of(how, 0.65), summary);
    EXPECT_EQ(wide.grid.cols, 14 + 2 * 3);
    EXPECT_EQ(wide.grid.rows, 9 + 2 * 4);
    EXPECT_LE(distance(wide.grid.centre(4, 3), map.grid.origin), 1e-12);
    EXPECT_EQ(wide.history, map.history);
    Index filled = 0;
    for (Index r = 0; r < wide.grid.rows; ++r) {
      for (Index c = 0; c < wide.grid.cols; ++c) {
        const bool in = r >= 4 && c >= 3 && r < 13 && c < 17;
        if (in && std::isfinite(map.at(r - 4, c - 3))) {
          EXPECT_EQ(wide.at(r, c), map.at(r - 4, c - 3));
          continue;
        }
        const double away = nearest_by_search(map, wide.grid.centre(r, c)).away;
        EXPECT_EQ(std::isfinite(wide.at(r, c)), away <= 0.65 + 1e-9) << r << " " << c;
        filled += std::isfinite(wide.at(r, c)) ? 1 : 0;
      }
    }
    EXPECT_EQ(summary.pixels, filled);
    EXPECT_GT(filled, 50);
  }
}

TEST(Extend, NearestDecayAndZeroAreTheirFormulas) {
  // Heights that no two pixels share, so that a tie between nearest ones cannot hide.
  const HeightMap map =
      map_of({5, 7, 0.31, 0.2, {-1.0, 2.0}}, [](double x, double y) { return 5.0 + x * x + 3.0 * y; });
  ExtendSummary summary;
  const HeightMap zero = extend_map(map, options_of(Extension::Zero, 0.7), summary);
  const HeightMap nearest = extend_map(map, options_of(Extension::Nearest, 0.7), summary);
  const HeightMap decay = extend_map(map, options_of(Extension::Decay, 0.7), summary);
  for (Index i = 0; i < zero.grid.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Nearest near = nearest_by_search(map, zero.grid.centre(i));
    if (near.away < 1e-9 || near.away > 0.7) continue;
    EXPECT_EQ(zero.values[k], 0.0);
    EXPECT_EQ(nearest.values[k], near.height);
    EXPECT_NEAR(decay.values[k], near.height * std::pow(std::cos(0.5 * kPi * near.away / 0.7), 2), 1e-12);
  }
}

TEST(Extend, HarmonicIsTheMeanOfItsNeighboursEverywhere) {
  const HeightMap map = uneven_map();
  ExtendSummary summary;
  const HeightMap wide = extend_map(map, options_of(Extension::Harmonic, 1.1), summary);
  const Grid& g = wide.grid;
  for (Index r = 0; r < g.rows; ++r) {
    for (Index c = 0; c < g.cols; ++c) {
      const Index mr = r - 6, mc = c - 4;
      const bool data = mr >= 0 && mc >= 0 && mr < 9 && mc < 14 && std::isfinite(map.at(mr, mc));
      if (data || std::isnan(wide.at(r, c))) continue;
      double flow = 0.0;
      for (const auto& [dr, dc, weight] :
           {std::tuple<Index, Index, double>{0, 1, 1 / 0.09}, {0, -1, 1 / 0.09}, {1, 0, 1 / 0.04}, {-1, 0, 1 / 0.04}}) {
        if (r + dr < 0 || c + dc < 0 || r + dr >= g.rows || c + dc >= g.cols) continue;
        if (std::isfinite(wide.at(r + dr, c + dc))) flow += weight * (wide.at(r + dr, c + dc) - wide.at(r, c));
      }
      EXPECT_NEAR(flow, 0.0, 1e-7) << r << " " << c;
    }
  }
}

TEST(Extend, GerchbergContinuesABandLimitedSurface) {
  // Waves of whole periods over the 75 x 70 pixels of the transform: 60 x 48 and at least 6 mm between the data.
  const double span_x = 75 * 0.3, span_y = 70 * 0.2;
  const auto height = [&](double x, double y) {
    return 2000.0 + 30.0 * std::cos(2 * kPi * x / span_x + 0.3) +
           20.0 * std::sin(2 * kPi * (2 * x / span_x + y / span_y)) +
           10.0 * std::cos(2 * kPi * (x / span_x - y / span_y) + 1.0);
  };
  // Three pixels wider in x (0.9 mm), five in y: 38 + 10 rows, 54 + 6 columns.
  HeightMap map = map_of({38, 54, 0.3, 0.2, {-3.0, 7.0}}, height);
  map.at(20, 30) = kNoData;
  ExtendOptions options = options_of(Extension::Gerchberg, 0.9);
  options.shortest = 6.0;
  options.iterations = 20000;
  options.tolerance = 1e-9;
  ExtendSummary summary;
  const HeightMap wide = extend_map(map, options, summary);
  EXPECT_EQ(wide.grid.rows, 48);
  EXPECT_EQ(wide.grid.cols, 60);
  double worst = 0.0, by_nearest = 0.0;
  for (const Index i : finite_pixels(wide)) {
    const Point p = wide.grid.centre(i);
    worst = std::max(worst, std::abs(wide.values[static_cast<std::size_t>(i)] - height(p.x, p.y)));
    by_nearest = std::max(by_nearest, std::abs(nearest_by_search(map, p).height - height(p.x, p.y)));
  }
  EXPECT_LE(worst, 1e-3);
  EXPECT_GT(by_nearest, 1.0);
  EXPECT_LE(summary.change, 1e-9);
  EXPECT_LT(summary.iterations, 20000);
}

TEST(Extend, GerchbergEndsAtItsLimitAndSaysSo) {
  ExtendOptions options = options_of(Extension::Gerchberg, 0.65);
  options.iterations = 3;
  options.tolerance = 0.0;
  ExtendSummary summary;
  extend_map(uneven_map(), options, summary);
  EXPECT_EQ(summary.iterations, 3);
  EXPECT_GT(summary.change, 0.0);
  EXPECT_THROW(extend_map(uneven_map(), options, summary, 1, Progress{{}, [] { return true; }}), Interrupted);
}

TEST(Extend, RefusesOptionsOutOfRange) {
  ExtendSummary summary;
  const HeightMap map = uneven_map();
  const auto refused = [&](ExtendOptions options, std::initializer_list<std::string> words) {
    expect_input_error([&] { extend_map(map, options, summary); }, words);
  };
  for (const double width : {0.0, -1.0, kNoData, 1.0 / 0.0}) refused(options_of(Extension::Zero, width), {"width"});
  refused(options_of(Extension::Zero, 1e9), {"width = 1000000000 mm", "pixels are accepted"});
  ExtendOptions options = options_of(Extension::Gerchberg, 1.0);
  options.shortest = 0.0;
  refused(options, {"shortest = 0 mm"});
  options.shortest = 1.0, options.iterations = 0;
  refused(options, {"iterations = 0"});
  options.iterations = 1, options.tolerance = kNoData;
  refused(options, {"tolerance"});
  expect_input_error([] { parse_extension("flat"); }, {"'flat'", "zero, nearest, decay, harmonic or gerchberg"});
}

}  // namespace
}  // namespace dwell
