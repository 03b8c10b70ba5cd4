#include "runs/plan/program_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/removal/simulate.h"
#include "core/tif/scaled_removal.h"
#include "runs/plan/moved_program.h"

namespace dwell {

const char* name_of(UncertainCause cause) {
  constexpr std::array<const char*, kUncertainCauses> kNames{"tif-rate", "tif-width", "position",
                                                             "offset",   "rotation",  "metrology"};
  return kNames[static_cast<std::size_t>(cause)];
}

/// How things are. The numbers are those of UncertaintySpec, drawn.
struct ProgramSampler::Truth {
  double rate = 1.0, width = 1.0;
  Point shift;
  double degrees = 0.0;
  double position = 0.0, noise = 0.0;  // deviations; their signs tell the two of a pair apart
  int number = 0;                      // of the sample whose random numbers the ends and the noise have
};

namespace {

constexpr double kLeastToolFactor = 0.05;  // a tool removes, whatever is drawn

/// Random numbers of a sample, for one cause: the same whatever else is uncertain.
RandomNumbers numbers_of(unsigned seed, int sample, UncertainCause cause) {
  // Odd constants spread over 64 bits what differs in a few of them (Steele, Lea and Flood 2014).
  std::uint64_t x = (static_cast<std::uint64_t>(seed) << 32U) + static_cast<std::uint64_t>(sample);
  x = x * 8U + static_cast<std::uint64_t>(cause);
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return RandomNumbers(x ^ (x >> 31U));
}

double mean_square(const std::vector<double>& values, const std::vector<Index>& pixels) {
  double squares = 0.0;
  for (const Index pixel : pixels) squares += std::pow(values[static_cast<std::size_t>(pixel)], 2);
  return squares / static_cast<double>(pixels.size());
}

}  // namespace

ProgramSampler::ProgramSampler(const Part& part, const Program& motion, const RemovalKernel& kernel,
                               const HeightMap& left, const UncertaintySpec& unsure, unsigned seed)
    : part_(part),
      motion_(motion),
      kernel_(kernel),
      left_(left),
      unsure_(unsure),
      seed_(seed),
      pixels_(finite_pixels(left)),
      form_(left.grid, pixels_, part.form, {}, part.threads),
      removal_(simulate(motion, part.map, kernel, part.threads)),
      nominal_square_(mean_square(left.values, pixels_)) {}

ProgramSampler::Truth ProgramSampler::drawn(int number) const {
  Truth truth;
  truth.number = number;
  truth.position = unsure_.position, truth.noise = unsure_.metrology;
  const auto normal = [&](UncertainCause cause) { return numbers_of(seed_, number, cause).normal(); };
  truth.rate = std::max(kLeastToolFactor, 1.0 + unsure_.tif_rate * normal(UncertainCause::Rate));
  truth.width = std::max(kLeastToolFactor, 1.0 + unsure_.tif_width * normal(UncertainCause::Width));
  truth.degrees = unsure_.rotation * normal(UncertainCause::Rotation);
  RandomNumbers offset = numbers_of(seed_, number, UncertainCause::Offset);
  const double x = unsure_.offset * offset.normal(), y = unsure_.offset * offset.normal();
  truth.shift = {x, y};
  return truth;
}

/// What is left otherwise than is thought, form terms removed: a value a pixel of the map.
std::vector<double> ProgramSampler::changed(const Truth& truth) const {
  std::vector<double> change(left_.values.size(), std::numeric_limits<double>::quiet_NaN());
  const bool moves = truth.position != 0.0 || truth.shift != Point{} || truth.degrees != 0.0;
  HeightMap simulated;
  if (moves || truth.width != 1.0) {
    RemovalKernel kernel = kernel_;
    if (truth.width != 1.0) {
      const Grid& map = part_.map.grid;
      try {
        kernel = pixel_kernel(scaled_removal(part_.tif, 1.0, truth.width), map.pitch_x, map.pitch_y, kernel_.division);
      } catch (const InputError& error) {
        throw InputError(fmt::format("`uncertainty`: in one of its truths the tool is {:.4g} times as wide: {}",
                                     truth.width, error.what()));
      }
      kernel.coarse = kernel_.coarse;
    }
    RandomNumbers ends = numbers_of(seed_, truth.number, UncertainCause::Position);
    Program motion = jittered_program(motion_, truth.position, ends);
    if (truth.shift != Point{} || truth.degrees != 0.0)
      motion = moved_program(std::move(motion), similarity(middle_of(part_.map.grid), truth.shift, truth.degrees, 1.0));
    simulated = simulate(motion, part_.map, kernel, part_.threads);
  }
  const HeightMap& removal = simulated.values.empty() ? removal_ : simulated;
  RandomNumbers noise = numbers_of(seed_, truth.number, UncertainCause::Metrology);
  for (const Index pixel : pixels_) {
    const auto i = static_cast<std::size_t>(pixel);
    change[i] = removal_.values[i] - truth.rate * removal.values[i];
    if (truth.noise != 0.0) change[i] += truth.noise * noise.normal();
  }
  form_.remove_from(change);
  return change;
}

ProgramSamples ProgramSampler::sample(int first, int end, const Progress& progress) const {
  ProgramSamples result;
  result.deviation = HeightMap(left_.grid);
  for (const Index pixel : pixels_) result.deviation.values[static_cast<std::size_t>(pixel)] = 0.0;
  for (int number = first; number < end; ++number) {
    progress.step(fmt::format("sample {} of {} to {}", number, first, end - 1));
    const std::vector<double> change = changed(drawn(number));
    double squares = 0.0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Index pixel : pixels_) {
      const auto i = static_cast<std::size_t>(pixel);
      const double left = left_.values[i] + change[i];
      squares += left * left;
      low = std::min(low, left), high = std::max(high, left);
      result.deviation.values[i] += change[i] * change[i];
    }
    result.samples.push_back({number, std::sqrt(squares / static_cast<double>(pixels_.size())), high - low});
  }
  for (double& square : result.deviation.values)
    square = std::sqrt(square / static_cast<double>(std::max(1, end - first)));
  return result;
}

double ProgramSampler::square_in(const Truth& truth) const {
  const std::vector<double> change = changed(truth);
  double squares = 0.0;
  for (const Index pixel : pixels_) {
    const auto i = static_cast<std::size_t>(pixel);
    squares += std::pow(left_.values[i] + change[i], 2);
  }
  return squares / static_cast<double>(pixels_.size());
}

/// Half of what two truths of opposite sign leave more than is thought, together.
double ProgramSampler::added_by_pair(const Truth& one, const Truth& other) const {
  return 0.5 * (square_in(one) + square_in(other)) - nominal_square_;
}

std::array<double, kUncertainCauses> ProgramSampler::alone(const Progress& progress) const {
  constexpr int kPairsOfEnds = 8;
  // The rule has its outer points at sqrt(3) standard deviations and weights of a sixth for each.
  constexpr double kFar = std::numbers::sqrt3, kOfPair = 1.0 / 3.0;
  std::array<double, kUncertainCauses> added{};
  const auto at = [&added](UncertainCause cause) -> double& { return added[static_cast<std::size_t>(cause)]; };
  const auto say = [&progress](UncertainCause cause) { progress.step(fmt::format("{} alone", name_of(cause))); };
  if (unsure_.tif_rate > 0.0) {
    std::vector<double> removal = removal_.values;
    form_.remove_from(removal);
    at(UncertainCause::Rate) = unsure_.tif_rate * unsure_.tif_rate * mean_square(removal, pixels_);
  }
  const auto by_rule = [&](UncertainCause cause, const auto& set) {
    say(cause);
    Truth more, less;
    set(more, kFar), set(less, -kFar);
    at(cause) += kOfPair * added_by_pair(more, less);
  };
  if (unsure_.tif_width > 0.0) {
    by_rule(UncertainCause::Width,
            [&](Truth& t, double far) { t.width = std::max(kLeastToolFactor, 1.0 + far * unsure_.tif_width); });
  }
  if (unsure_.offset > 0.0) {
    by_rule(UncertainCause::Offset, [&](Truth& t, double far) { t.shift.x = far * unsure_.offset; });
    by_rule(UncertainCause::Offset, [&](Truth& t, double far) { t.shift.y = far * unsure_.offset; });
  }
  if (unsure_.rotation > 0.0)
    by_rule(UncertainCause::Rotation, [&](Truth& t, double far) { t.degrees = far * unsure_.rotation; });
  for (int pair = 1; pair <= kPairsOfEnds && unsure_.position > 0.0; ++pair) {
    say(UncertainCause::Position);
    Truth one, other;
    one.number = other.number = pair;
    one.position = unsure_.position, other.position = -unsure_.position;
    at(UncertainCause::Position) += added_by_pair(one, other) / kPairsOfEnds;
  }
  if (unsure_.metrology > 0.0) {
    const double free = static_cast<double>(form_.rank()) / static_cast<double>(pixels_.size());
    at(UncertainCause::Metrology) = unsure_.metrology * unsure_.metrology * (1.0 - free);
  }
  return added;
}

}  // namespace dwell
