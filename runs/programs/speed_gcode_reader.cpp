#include "runs/programs/speed_gcode_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/base/value_range.h"
#include "paths/feed/end_feed_blocks.h"
#include "paths/feed/machine.h"
#include "paths/feed/path_linear.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/gcode_words.h"

namespace dwell {
namespace {

constexpr ValueRange kFeeds{1e-9, 1e6, "mm/s"};
constexpr double kSameFeed = 1e-8;  // of a feed

class SpeedSteps {
 public:
  SpeedSteps(SpeedDialect dialect, const SpeedText& text, GcodeSteps read)
      : dialect_(dialect), text_(text), program_(std::move(read.program)), read_lines_(std::move(read.lines)) {
    machine_.x.max_acceleration = text.from_rest.x;
    machine_.y.max_acceleration = text.from_rest.y;
    machine_.path_acceleration = text.from_rest.path;
    machine_.frame = program_.frame;
  }

  Program take() {
    check_lines_have_steps();
    std::vector<ProgramStep> plain = std::move(program_.steps);
    program_.steps.clear();
    for (std::size_t i = 0; i < plain.size(); ++i) {
      line_ = read_lines_[i];
      if (plain[i].removes && plain[i].length() > 0.0) {
        const bool rests = i + 1 == plain.size() || is_rest(plain[i + 1]);
        add_move(plain[i], rests);
      } else {
        check_rest(plain[i].removes ? "a halt" : "the tool lifted");
        if (line().ramps && !plain[i].removes && (dialect_ == SpeedDialect::G293 || plain[i].seconds > 0.0)) {
          fail(fmt::format("{} where the tool is lifted or lowered; required G0, or G1 at one feed",
                           dialect_ == SpeedDialect::G293 ? "G293" : "FLIN"));
        }
        program_.steps.push_back(plain[i]);
      }
    }
    check_rest("the end of the program");
    join_rounded_directions(program_);
    return std::move(program_);
  }

 private:
  static bool is_rest(const ProgramStep& step) { return !step.removes || !(step.length() > 0.0); }

  const SpeedLine& line() const { return text_.lines[line_ - 1]; }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(GcodePlace{program_.file, line_}.text() + ": " + what);
  }

  /// The reader of plain G-code leaves out moves without length, whose feed counts here.
  void check_lines_have_steps() {
    if (dialect_ != SpeedDialect::G293) return;
    std::size_t i = 0;
    for (std::size_t k = 1; k <= text_.lines.size(); ++k) {
      while (i < read_lines_.size() && read_lines_[i] < k) ++i;
      line_ = k;
      if (text_.lines[k - 1].ramps && (i == read_lines_.size() || read_lines_[i] != k) &&
          (!read_lines_.empty() && k <= read_lines_.back()))
        fail("G293 without a move that has a length; required one, over which the feed changes");
    }
  }

  void check_rest(const char* before) const {
    if (speed_ == 0.0) return;
    fail(fmt::format("{} after a block that ends at F{:.9g}; required rest before it ({})", before,
                     units::mm_per_min(speed_),
                     dialect_ == SpeedDialect::G293 ? fmt::format("F{} in the block before", kFeedOfRest)
                                                    : "FNORM in the block before"));
  }

  void add_move(const ProgramStep& step, bool rest_follows) {
    const double feed = step.length() / step.seconds;
    check_within("F", feed, kFeeds);
    for (const double place : {step.start.x, step.start.y, step.finish.x, step.finish.y})
      check_within("a place", place, ranges::kPlace);
    EndFeedBlock block{step.start, step.finish};
    block.speed_in = speed_;
    if (dialect_ == SpeedDialect::G293) {
      over_time(block, feed);
    } else {
      over_path(block, feed, rest_follows || line().stops);
    }
    for (const ProgramStep& made : steps_) {
      if (!(made.seconds > 0.0 && made.seconds <= ranges::kTime.most))
        fail(fmt::format("the move takes {:.3g} s; required {}", made.seconds, ranges::kTime.text()));
      program_.steps.push_back(made);
    }
    speed_ = block.speed_out;
  }

  void check_within(const char* name, double value, const ValueRange& range) const {
    if (!range.holds(value)) fail(fmt::format("{} of {:.6g} {}; required {}", name, value, range.unit, range.text()));
  }

  void over_time(EndFeedBlock& block, double feed) {
    const bool rest = units::mm_per_min(feed) <= kFeedOfRest * (1.0 + kSameFeed);
    if (!line().ramps && !(std::abs(feed - speed_) <= kSameFeed * feed)) {
      fail(
          fmt::format("a move at F{:.9g} without G293 where the block before ends at F{:.9g}: how the feed changes is "
                      "not said; required G293, or that feed",
                      units::mm_per_min(feed), units::mm_per_min(speed_)));
    }
    block.speed_out = line().ramps && rest ? 0.0 : feed;
    if (block.speed_in + block.speed_out == 0.0)
      fail(fmt::format("G293 from rest to F{}, which stands for rest: it never arrives; required more than F{}",
                       kFeedOfRest, kFeedOfRest));
    if (line().stops && block.speed_out > 0.0)
      fail(fmt::format("G60 stops the move, whose F says another speed; required F{}", kFeedOfRest));
    steps_ = {accelerated_step(block.start, block.finish, block.speed_in, block.speed_out)};
  }

  void over_path(EndFeedBlock& block, double feed, bool rests) {
    block.even = !line().ramps;
    block.speed_out = rests ? 0.0 : feed;
    if (!block.even) {
      if (rests || speed_ == 0.0) {
        fail(fmt::format("FLIN {} rest, which linearly over the path takes forever; required FNORM in this block",
                         rests ? "to" : "from"));
      }
      steps_ = steps_over_path(block, 0.0);
      return;
    }
    if (speed_ > 0.0 && !(std::abs(feed - speed_) <= kSameFeed * feed)) {
      fail(
          fmt::format("FNORM at F{:.9g} where the block before ends at F{:.9g}: how the feed changes is not said; "
                      "required that feed, or FLIN",
                      units::mm_per_min(feed), units::mm_per_min(speed_)));
    }
    if (speed_ > 0.0 && !rests) {
      steps_ = {accelerated_step(block.start, block.finish, feed, feed)};
      return;
    }
    if (speed_ == 0.0 && rests) return from_rest_to_rest(block, feed);
    const double acceleration = said_acceleration(block);
    if (!has_room(block, acceleration)) fail_for_room(feed);
    steps_ = steps_over_path(block, acceleration);
  }

  /// Two even blocks, whose middle is run at the feed.
  void from_rest_to_rest(const EndFeedBlock& block, double feed) {
    const double acceleration = said_acceleration(block);
    EndFeedBlock first = block, second = block;
    first.finish = second.start = midpoint(block.start, block.finish);
    first.speed_out = second.speed_in = feed;
    if (!has_room(first, acceleration)) fail_for_room(feed);
    steps_ = steps_over_path(first, acceleration);
    for (const ProgramStep& step : steps_over_path(second, acceleration)) steps_.push_back(step);
  }

  [[noreturn]] void fail_for_room(double feed) const {
    fail(
        fmt::format("a move from or to rest that is too short to reach its F{:.9g} at the accelerations that the "
                    "program says; required a lower F",
                    units::mm_per_min(feed)));
  }

  double said_acceleration(const EndFeedBlock& block) const {
    const double acceleration = acceleration_limit(machine_, block.finish - block.start);
    if (!std::isfinite(acceleration)) {
      fail(
          "FNORM from or to rest: how fast the machine accelerates there is not said; required the comment \"; dwell: "
          "from rest at x A, y B, path C mm/s^2\", with those that the machine has");
    }
    return acceleration;
  }

  SpeedDialect dialect_;
  const SpeedText& text_;
  Program program_;
  std::vector<std::size_t> read_lines_;
  Machine machine_;  // of which the accelerations are known
  std::size_t line_ = 0;
  double speed_ = 0.0;              // at which the tool is [mm/s]
  std::vector<ProgramStep> steps_;  // of the move
};

}  // namespace

Program read_speed_gcode(std::string_view text, const std::string& file, SpeedDialect dialect,
                         const GcodeReading& reading, const Progress& progress) {
  GcodeReading plain = reading;
  plain.dialect = GcodeDialect::G94;
  plain.halts = HaltUnit::Seconds;
  const SpeedText words = plain_gcode_of(text, file, dialect, reading.letters, progress);
  return SpeedSteps(dialect, words, read_gcode_steps(words.plain, file, plain, progress)).take();
}

}  // namespace dwell
