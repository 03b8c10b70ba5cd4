#include "runs/programs/speed_gcode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/base/units.h"
#include "runs/programs/frame_text.h"
#include "runs/programs/number_text.h"
#include "runs/programs/program_comments.h"

namespace dwell {
namespace {

struct NamedBlock {
  EndFeedBlock block;
  std::string x, y;  // its end, as the program names it
};

constexpr double kCrawls = 1.001 * kFeedOfRest;  // F in the place of lower ones [mm/min]
constexpr double kLessTime = 1e-2;               // of a block's time, which that may cost

/// Speeds that would read as rest are raised to the least that does not.
void raise_crawling(std::vector<EndFeedBlock>& blocks) {
  for (std::size_t i = 0; i + 1 < blocks.size(); ++i) {
    EndFeedBlock &before = blocks[i], &after = blocks[i + 1];
    const double speed = before.speed_out, raised = units::mm_per_s(kCrawls);
    if (!(speed > 0.0) || units::mm_per_min(speed) >= kCrawls) continue;
    const double slower = std::min(before.speed_in, after.speed_out);
    if (!(raised - speed <= kLessTime * (slower + speed))) {
      throw InputError(
          fmt::format("`export` = g293: a speed of {:.3g} mm/min in the motion is not more than that which stands for "
                      "rest, {} mm/min, beside one of {:.3g} mm/min; required less dwell a stroke, or another format",
                      units::mm_per_min(speed), kFeedOfRest, units::mm_per_min(slower)));
    }
    before.speed_out = after.speed_in = raised;
  }
}

class SpeedGcodeWriter {
 public:
  SpeedGcodeWriter(SpeedDialect dialect, const ProgramFrame& frame, const GcodeOptions& options)
      : g293_(dialect == SpeedDialect::G293),
        dialect_(dialect),
        frame_(frame),
        options_(options),
        machine_(options.machine.value_or(Machine{})) {
    if (!(options.max_feed_mm_per_min > 0.0) || !std::isfinite(options.max_feed_mm_per_min)) {
      throw InputError(fmt::format("maximum feed = {} mm/min; required finite and > 0", options.max_feed_mm_per_min));
    }
    if (!(options.lift_height_mm >= 1e-6) || !std::isfinite(options.lift_height_mm)) {
      throw InputError(fmt::format("lift height = {} mm; required finite and >= 1e-6", options.lift_height_mm));
    }
  }

  std::string write(const std::vector<EndFeedBlock>& blocks, const Progress& progress) {
    write_beginning();
    Poll poll(progress);
    for (const NamedBlock& named : named_blocks(blocks)) {
      poll.step();
      const EndFeedBlock& block = named.block;
      if (!placed_) reposition(named_place(block.start));
      if (!block.removes) {
        reposition({named.x, named.y});
      } else if (block.halts()) {
        come_down();
        halt(block.seconds);
      } else {
        come_down();
        write_move(named);
      }
    }
    lift();
    block("M30");
    return fmt::to_string(text_);
  }

 private:
  struct Place {
    std::string x, y;

    bool operator==(const Place&) const = default;
  };

  template <typename... Args>
  void block(fmt::format_string<Args...> format, Args&&... args) {
    if (options_.style.block_numbers > 0) {
      fmt::format_to(std::back_inserter(text_), "N{} ", block_number_);
      block_number_ += options_.style.block_numbers;
      if (block_number_ > kLastBlockNumber) block_number_ = options_.style.block_numbers;
    }
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_.push_back('\n');
  }

  void comment(const std::string& text) {
    const std::string line = g293_ ? "(" + comment_text(text) + ")" : "; " + comment_text(text);
    if (line.size() > kLongestLine)
      throw std::logic_error(fmt::format("program line \"{}\" is longer than {} characters", line, kLongestLine));
    text_.append(line.data(), line.data() + line.size());
    text_.push_back('\n');
  }

  void write_beginning() {
    for (const std::string& text : options_.header) comment(text);
    comment(fmt::format("dwell: gcode={}", to_string(dialect_)));
    comment("dwell: tool at work when Z=0, lifted when Z>0");
    if (!frame_.is_of_part()) comment("dwell: " + frame_text(frame_));
    comment(fmt::format("units: {} {} Z mm, F mm/min, halts seconds", machine_.letters.x, machine_.letters.y));
    if (g293_) {
      comment(fmt::format("dwell: F{} at the end of a block stands for rest, the least feed", kFeedOfRest));
      block("#SLOPE [TYPE=STEP]");
      block("G17 G71 G90 G94");
      return;
    }
    const RestAccelerations from_rest{machine_.x.max_acceleration, machine_.y.max_acceleration,
                                      machine_.path_acceleration};
    if (from_rest.are_said()) comment("dwell: " + rest_accelerations_text(from_rest));
    block("G17 G90 G94 G710");
    block("G64");
    block("COMPOF");
    block("FNORM");
  }

  Place named_place(Point of_part) const {
    Point place = frame_.to_program(of_part);
    if (const double step = machine_.controller.position_resolution; step > 0.0)
      place = {std::round(place.x / step) * step, std::round(place.y / step) * step};
    return {coordinate_text(place.x), coordinate_text(place.y)};
  }

  /// With their ends as text; moves that rounding leaves without length go to those before them.
  std::vector<NamedBlock> named_blocks(const std::vector<EndFeedBlock>& blocks) const {
    std::vector<NamedBlock> result;
    result.reserve(blocks.size());
    Place at;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const EndFeedBlock& block = blocks[i];
      if (i == 0) at = named_place(block.start);
      if (i > 0 && !(distance(blocks[i - 1].finish, block.start) <= 1e-9))
        throw std::logic_error(fmt::format("program block {} does not start where block {} ends", i + 1, i));
      const Place to = named_place(block.finish);
      const bool moves = block.removes && !block.halts();
      if (moves && to == at) {
        const bool after_move = !result.empty() && result.back().block.removes && !result.back().block.halts();
        if (after_move) result.back().block.speed_out = block.speed_out;
        continue;
      }
      result.push_back({block, to.x, to.y});
      at = to;
    }
    return result;
  }

  void lift() {
    if (!lifted_) block("G0 Z{}", coordinate_text(options_.lift_height_mm));
    lifted_ = true;
  }

  void reposition(const Place& to) {
    if (lifted_ && !placed_) block("G0 Z{}", coordinate_text(options_.lift_height_mm));
    lift();
    block("G0 {}{} {}{}", machine_.letters.x, to.x, machine_.letters.y, to.y);
    placed_ = true;
  }

  // At rest at its end, from which the next block starts.
  void come_down() {
    if (!lifted_) return;
    set_linear(false);
    const double most = std::min(options_.max_feed_mm_per_min, units::mm_per_min(machine_.max_feed));
    block("G1 {} Z0 F{}", g293_ ? "G60" : "G9", digits_not_above(most));
    lifted_ = false;
  }

  void set_linear(bool linear) {
    if (linear_ == linear || g293_) return;
    block("{}", linear ? "FLIN" : "FNORM");
    linear_ = linear;
  }

  // What a clock takes or gives by its steps is made up for by the next halt.
  void halt(double seconds) {
    if (const double step = machine_.controller.time_resolution; step > 0.0) {
      halts_ += seconds;
      seconds = step * std::max(1.0, std::round((halts_ - halted_) / step));
      halted_ += seconds;
    }
    block("{} {}", g293_ ? "#TIME" : "G4", (g293_ ? "" : "F") + digits_nearest(seconds));
  }

  std::string feed_word(double speed) const {
    if (g293_ && !(speed > 0.0)) return fmt::format("{}", kFeedOfRest);
    return digits_not_above(std::min(units::mm_per_min(speed), options_.max_feed_mm_per_min));
  }

  void write_move(const NamedBlock& named) {
    const EndFeedBlock& move = named.block;
    if (g293_) {
      if (move.even) throw std::logic_error("an even block among those of G293");
      return block("G1 G293 {}{} {}{} F{}", machine_.letters.x, named.x, machine_.letters.y, named.y,
                   feed_word(move.speed_out));
    }
    set_linear(!move.even);
    const double speed = move.even ? std::max(move.speed_in, move.speed_out) : move.speed_out;
    block("G1 {}{}{} {}{} F{}", move.speed_out > 0.0 ? "" : "G9 ", machine_.letters.x, named.x, machine_.letters.y,
          named.y, feed_word(speed));
  }

  static constexpr int kLastBlockNumber = 99999;

  bool g293_;
  SpeedDialect dialect_;
  ProgramFrame frame_;
  const GcodeOptions& options_;
  Machine machine_;  // without limits where none is given
  fmt::memory_buffer text_;
  int block_number_ = options_.style.block_numbers;
  bool lifted_ = true, placed_ = false, linear_ = false;
  double halts_ = 0.0, halted_ = 0.0;  // sums of the halts, as they should be and as they were written [s]
};

}  // namespace

std::string speed_gcode_text(SpeedDialect dialect, const std::vector<EndFeedBlock>& blocks, const ProgramFrame& frame,
                             const GcodeOptions& options, const Progress& progress) {
  if (dialect == SpeedDialect::Flin) return SpeedGcodeWriter(dialect, frame, options).write(blocks, progress);
  std::vector<EndFeedBlock> raised = blocks;
  raise_crawling(raised);
  return SpeedGcodeWriter(dialect, frame, options).write(raised, progress);
}

}  // namespace dwell
