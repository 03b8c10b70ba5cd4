#include "runs/plan/program_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/grid_limit.h"
#include "core/form/map_statistics.h"
#include "core/map/map_arithmetic.h"
#include "core/removal/removal_probe.h"
#include "core/removal/simulate.h"
#include "core/tif/scaled_removal.h"
#include "runs/figure/run_uncertainty.h"
#include "runs/plan/moved_program.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

/// The small part under a meander of uneven speed, and what that leaves.
struct Sampled {
  Part part = make_part(test::small_map(), gaussian_removal(10.0, 2.5, 4.0), {true, true}, 1);
  Program motion;
  HeightMap left;

  Sampled() {
    for (int line = 0; line < 11; ++line) {
      for (int k = 0; k < 17; ++k) {
        const bool back = line % 2 == 1;
        const auto at = [&](int i) { return Point{-5.0 + static_cast<double>(back ? 17 - i : i), 1.5 + line}; };
        motion.steps.push_back({at(k), at(k + 1), 0.4 + 0.3 * std::sin(0.7 * k + line) + 0.05 * k});
      }
      const Point end = motion.steps.back().finish;
      motion.steps.push_back({end, end + Point{0.0, 1.0}, 0.2});
    }
    left = without_form(surface_after(part.map, simulate(motion, part.map, part.kernel, 1)), part.form);
  }

  ProgramSampler sampler(const UncertaintySpec& unsure, unsigned seed = 3) const {
    return {part, motion, part.kernel, left, unsure, seed};
  }
  /// Nothing is left if all is as it is thought: then what is left is what an error makes, and its square alone.
  HeightMap nothing_left() const {
    HeightMap none = left;
    for (double& value : none.values) value *= 0.0;
    return none;
  }
  /// What a program removes, from the removal function itself, without a lattice.
  HeightMap probed(const Program& program, double width = 1.0) const {
    const RemovalFunction tool = scaled_removal(part.tif, 1.0, width);
    const PixelMeanTable table = tabulate_pixel_mean(tool, part.map.grid);
    const RemovingSteps steps = removing_steps(program);
    const RemovalProbe probe(part.map.grid, table, steps.strokes, steps.seconds);
    const std::vector<Index> pixels = finite_pixels(part.map);
    const Vector removal = mean_removal(probe, part.map.grid, pixels, 1);
    HeightMap map(part.map.grid);
    for (std::size_t i = 0; i < pixels.size(); ++i)
      map.values[static_cast<std::size_t>(pixels[i])] = removal[static_cast<Index>(i)];
    return map;
  }
  double square_of(const HeightMap& map) const { return std::pow(map_statistics(map, part.form).rms_about_zero(), 2); }
};

double of(const std::array<double, kUncertainCauses>& alone, UncertainCause cause) {
  return alone[static_cast<std::size_t>(cause)];
}

UncertaintySpec one(double UncertaintySpec::*which, double size) {
  UncertaintySpec unsure;
  unsure.*which = size;
  return unsure;
}

TEST(ProgramSamples, OfTheRateAloneLieOnItsClosedForm) {
  const Sampled s;
  const auto sampler = s.sampler(one(&UncertaintySpec::tif_rate, 0.05));
  const HeightMap removal = without_form(s.probed(s.motion), s.part.form);
  const std::vector<Index> pixels = finite_pixels(s.left);
  double a = 0.0, b = 0.0, d = 0.0;
  for (const Index pixel : pixels) {
    const auto i = static_cast<std::size_t>(pixel);
    a += s.left.values[i] * s.left.values[i], b += s.left.values[i] * removal.values[i];
    d += removal.values[i] * removal.values[i];
  }
  const auto count = static_cast<double>(pixels.size());
  double squares = 0.0;
  const ProgramSamples drawn = sampler.sample(1, 401);
  for (const ProgramSample& sample : drawn.samples) {
    // The rate is off by one of the roots of |left + e removal|^2 = its square; the PV then must be that of the same e.
    const double c = a - sample.rms * sample.rms * count, root = std::sqrt(std::max(0.0, b * b - d * c));
    double nearest = 1e9, error = 0.0;
    for (const double e : {(-b + root) / d, (-b - root) / d}) {
      double low = 1e9, high = -1e9;
      for (const Index pixel : pixels) {
        const auto i = static_cast<std::size_t>(pixel);
        const double value = s.left.values[i] + e * removal.values[i];
        low = std::min(low, value), high = std::max(high, value);
      }
      if (std::abs(high - low - sample.pv) < nearest) nearest = std::abs(high - low - sample.pv), error = e;
    }
    EXPECT_LE(nearest, 2e-3 * sample.pv) << sample.number;
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(squares / 400.0), 0.05, 0.006);
  EXPECT_NEAR(of(sampler.alone(), UncertainCause::Rate), 0.0025 * d / count, 1e-3 * 0.0025 * d / count);
}

TEST(ProgramSamples, NoiseOfTheMapAddsItsSquareLessTheForm) {
  const Sampled s;
  const auto sampler = s.sampler(one(&UncertaintySpec::metrology, 2.0));
  const auto pixels = static_cast<double>(s.part.map.valid_pixels());
  EXPECT_NEAR(of(sampler.alone(), UncertainCause::Metrology), 4.0 * (1.0 - 3.0 / pixels), 1e-9);
  const ProgramSamples drawn = sampler.sample(1, 301);
  double mean = 0.0;
  for (const ProgramSample& sample : drawn.samples) mean += sample.rms * sample.rms / 300.0;
  // Of 300 samples the mean of noise^2 is known to 4 sqrt(2 / 300 / pixels), and the product with what is left to
  // 2 * 2 rms / sqrt(300 pixels).
  const double known = 4.0 * std::sqrt(2.0 / 300.0 / pixels) + 4.0 * std::sqrt(s.square_of(s.left) / 300.0 / pixels);
  EXPECT_NEAR(mean - sampler.nominal_square(), 4.0 * (1.0 - 3.0 / pixels), 3.0 * known);
  const HeightMap& off = drawn.deviation;
  EXPECT_NEAR(off.at(12, 15), 2.0, 0.3);
  EXPECT_TRUE(std::isnan(off.at(0, 0)));
}

TEST(ProgramSamples, OffsetAndRotationAddWhatTheirFirstOrderSurfacesHave) {
  const Sampled s;
  UncertaintySpec unsure;
  unsure.offset = 0.01, unsure.rotation = 0.02;
  const HeightMap none = s.nothing_left();
  const ProgramSampler sampler(s.part, s.motion, s.part.kernel, none, unsure, 1);
  RunUncertainty first_order;
  first_order.shift = unsure.offset, first_order.rotation = unsure.rotation * 1000.0 * std::numbers::pi / 180.0;
  const auto surfaces = uncertain_surfaces(s.part, ToolRemoval(s.part, s.part.kernel), s.motion, first_order);
  ASSERT_EQ(surfaces.size(), 3U);
  const double shift = s.square_of(surfaces[0].change) + s.square_of(surfaces[1].change);
  const auto alone = sampler.alone();
  EXPECT_NEAR(of(alone, UncertainCause::Offset), shift, 0.01 * shift);
  EXPECT_NEAR(of(alone, UncertainCause::Rotation), s.square_of(surfaces[2].change),
              0.01 * s.square_of(surfaces[2].change));
  EXPECT_EQ(of(alone, UncertainCause::Rate), 0.0);
}

TEST(ProgramSamples, WidthAddsWhatTwoToolsOfOtherWidthsDo) {
  const Sampled s;
  const double far = 0.04 * std::numbers::sqrt3;
  double expected = -s.square_of(s.left) / 3.0;
  for (const double width : {1.0 - far, 1.0 + far}) {
    const HeightMap wide = surface_after(s.part.map, s.probed(s.motion, width));
    const HeightMap narrow = surface_after(s.part.map, s.probed(s.motion));
    HeightMap left = s.left;
    for (std::size_t i = 0; i < left.values.size(); ++i) left.values[i] += wide.values[i] - narrow.values[i];
    expected += s.square_of(left) / 6.0;
  }
  const auto alone = s.sampler(one(&UncertaintySpec::tif_width, 0.04)).alone();
  EXPECT_NEAR(of(alone, UncertainCause::Width), expected, 0.01 * std::abs(expected));
}

TEST(ProgramSamples, EndsOfMovesAddWhatErrorsDrawnOneByOneDo) {
  const Sampled s;
  const HeightMap none = s.nothing_left();
  const ProgramSampler sampler(s.part, s.motion, s.part.kernel, none, one(&UncertaintySpec::position, 0.05), 1);
  RandomNumbers random(99);
  const HeightMap meant = s.probed(s.motion);
  double mean = 0.0;
  constexpr int kDraws = 20;
  for (int draw = 0; draw < kDraws; ++draw) {
    Program motion = s.motion;
    for (std::size_t k = 0; k <= motion.steps.size(); ++k) {
      const Point beside{0.05 * random.normal(), 0.05 * random.normal()};
      if (k > 0) motion.steps[k - 1].finish = motion.steps[k - 1].finish + beside;
      if (k < motion.steps.size()) motion.steps[k].start = motion.steps[k].start + beside;
    }
    mean += s.square_of(difference(s.probed(motion), meant)) / kDraws;
  }
  EXPECT_NEAR(of(sampler.alone(), UncertainCause::Position), mean, 0.15 * mean);
}

TEST(ProgramSamples, AreDrawnEachOnItsOwn) {
  const Sampled s;
  UncertaintySpec all;
  all.tif_rate = 0.05, all.tif_width = 0.02, all.position = 0.05, all.offset = 0.1, all.rotation = 0.2,
  all.metrology = 0.5;
  const auto sampler = s.sampler(all);
  const ProgramSamples whole = sampler.sample(1, 9), head = sampler.sample(1, 4), tail = sampler.sample(4, 9);
  std::vector<ProgramSample> joined = head.samples;
  joined.insert(joined.end(), tail.samples.begin(), tail.samples.end());
  EXPECT_EQ(whole.samples, joined);
  EXPECT_EQ(s.sampler(all).sample(5, 6).samples.front(), whole.samples[4]);
  EXPECT_NE(s.sampler(all, 4).sample(5, 6).samples.front().rms, whole.samples[4].rms);
  EXPECT_NE(whole.samples[0].rms, whole.samples[1].rms);
}

TEST(ProgramSamples, ExpectTogetherWhatTheCausesAddAlone) {
  const Sampled s;
  UncertaintySpec all;
  all.tif_rate = 0.01, all.tif_width = 0.01, all.position = 0.02, all.offset = 0.02, all.metrology = 0.2;
  const HeightMap none = s.nothing_left();
  const ProgramSampler sampler(s.part, s.motion, s.part.kernel, none, all, 8);
  double together = 0.0, mean = 0.0;
  for (const double square : sampler.alone()) together += square;
  constexpr int kSamples = 600;
  for (const ProgramSample& sample : sampler.sample(1, kSamples + 1).samples)
    mean += sample.rms * sample.rms / kSamples;
  EXPECT_NEAR(mean, together, 0.15 * together);
}

TEST(ProgramSamples, SayWhichToolIsTooNarrowForThePixels) {
  const Sampled s;
  const auto sampler = s.sampler(one(&UncertaintySpec::tif_width, 0.5));
  test::expect_input_error([&] { sampler.sample(1, 200); }, {"`uncertainty`", "times as wide"});
}

TEST(ProgramSamples, StopWhenAskedTo) {
  const Sampled s;
  Progress progress;
  progress.stop = [] { return true; };
  EXPECT_THROW(s.sampler(one(&UncertaintySpec::position, 0.05)).sample(1, 3, progress), Interrupted);
  EXPECT_THROW(s.sampler(one(&UncertaintySpec::position, 0.05)).alone(progress), Interrupted);
}

}  // namespace
}  // namespace dwell
