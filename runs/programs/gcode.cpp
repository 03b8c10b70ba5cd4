#include "runs/programs/gcode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/base/units.h"
#include "runs/programs/frame_text.h"
#include "runs/programs/number_text.h"
#include "runs/programs/program_comments.h"

namespace dwell {
namespace {

/// A line that controllers take. What users give is refused before (gcode_insert.h).
const std::string& checked_line(const std::string& line) {
  if (line.size() > kLongestLine || !is_printable_ascii(line)) {
    throw std::logic_error(
        fmt::format("program line \"{}\" is longer than {} characters or not ASCII", line, kLongestLine));
  }
  return line;
}

// A place as the program names it, and where the machine then goes [mm], in the program's frame.
struct NamedPlace {
  std::string x, y;
  Point point;
};

class GcodeWriter {
 public:
  explicit GcodeWriter(const GcodeOptions& options)
      : options_(options),
        max_feed_(units::mm_per_s(options.max_feed_mm_per_min)),
        machine_(options.machine.value_or(Machine{})) {
    machine_.frame = {};  // the limits of axes are those of the program's coordinates, which the moves have here

    if (!(options.max_feed_mm_per_min > 0.0) || !std::isfinite(options.max_feed_mm_per_min)) {
      throw InputError(fmt::format("maximum feed = {} mm/min; required finite and > 0", options.max_feed_mm_per_min));
    }
    if (!(options.lift_height_mm >= 1e-6) || !std::isfinite(options.lift_height_mm)) {
      throw InputError(fmt::format("lift height = {} mm; required finite and >= 1e-6", options.lift_height_mm));
    }
    lift_height_ = length_text(options.lift_height_mm);
  }

  std::string write(const Program& program, const Progress& progress) {
    frame_ = program.frame;
    write_beginning();
    Poll poll(progress);
    for (std::size_t i = 0; i < program.steps.size(); ++i) {
      poll.step();
      const ProgramStep& step = program.steps[i];
      if (i > 0 && !(distance(program.steps[i - 1].finish, step.start) <= 1e-9)) {
        throw std::logic_error(fmt::format("program step {} does not start where step {} ends", i + 1, i));
      }
      if (i == 0) reposition(step.start);
      if (step.removes) {
        come_down();
        write_removing(step, i + 1);
      } else {
        if (!(step.seconds <= 0.0)) {
          throw std::logic_error(
              fmt::format("program step {} is lifted and takes {} s; lifted moves are rapids", i + 1, step.seconds));
        }
        reposition(step.finish);
      }
    }
    write_end();
    return fmt::to_string(text_);
  }

 private:
  /// A line of the program.
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

  void comment(const std::string& text) { line("(" + comment_text(text) + ")"); }

  void line(const std::string& text) {
    const std::string& checked = checked_line(text);
    text_.append(checked.data(), checked.data() + checked.size());
    text_.push_back('\n');
  }

  void write_beginning() {
    const GcodeStyle& style = options_.style;
    for (const std::string& text : options_.header) comment(text);
    line(fmt::format("(dwell: gcode={}, g4=seconds)", to_string(options_.dialect)));
    line("(dwell: tool at work when Z=0, lifted when Z>0)");
    if (!frame_.is_of_part()) line(fmt::format("(dwell: {})", frame_text(frame_)));
    for (const std::string& text : style.before) line(text);
    const std::string length = style.inches ? "inch" : "mm";
    const std::string f = options_.dialect == GcodeDialect::G94            ? length + "/min"
                          : options_.dialect == GcodeDialect::G93PerMinute ? "1/[minutes of the move]"
                                                                           : "seconds of the move";
    if (style.inches) block("G20");  // first, for a remark about inches is refused in millimetres
    comment(fmt::format("units: {} {} Z {}, F {}, P seconds", machine_.letters.x, machine_.letters.y, length, f));
    if (!style.inches) block("G21");
    block("G90");
    block("G17");
    block("{}", options_.dialect == GcodeDialect::G94 ? "G94" : "G93");
    if (style.path_mode) block("{}", path_mode_words(*style.path_mode));
  }

  std::string path_mode_words(const PathMode& mode) const {
    if (mode.kind == PathMode::Kind::ExactPath) return "G61";
    if (mode.kind == PathMode::Kind::ExactStop) return "G61.1";
    std::string words = mode.tolerance_mm ? "G64 P" + length_text(*mode.tolerance_mm) : "G64";
    if (mode.merging_mm) words += " Q" + length_text(*mode.merging_mm);
    return words;
  }

  /// A user's lines find G94 after the work, whatever the dialect.
  void write_end() {
    lift();
    if (!options_.style.after.empty() && options_.dialect != GcodeDialect::G94) block("G94");
    for (const std::string& text : options_.style.after) line(text);
    block("M2");
  }

  std::string length_text(double mm) const { return options_.style.inches ? inches_text(mm) : coordinate_text(mm); }
  double unit() const { return options_.style.inches ? units::kMmPerInch : 1.0; }

  NamedPlace named(Point of_part) const {
    Point place = frame_.to_program(of_part);
    if (const double step = machine_.controller.position_resolution; step > 0.0)
      place = {std::round(place.x / step) * step, std::round(place.y / step) * step};
    NamedPlace result{length_text(place.x), length_text(place.y), {}};
    result.point = {unit() * number_of(result.x), unit() * number_of(result.y)};
    return result;
  }

  void lift() {
    if (!lifted_) block("G0 Z{}", lift_height_);
    lifted_ = true;
  }

  void reposition(Point to) {
    lift();
    at_ = named(to);
    block("G0 {}{} {}{}", machine_.letters.x, at_.x, machine_.letters.y, at_.y);
  }

  void come_down() {
    if (!lifted_) return;
    block("G1 Z0 F{}", feed_word(unit() * number_of(lift_height_), 0.0, max_feed_));
    lifted_ = false;
  }

  // F of a move of `length` [mm] that should take `seconds`: never faster than that, nor than `most` [mm/s].
  std::string feed_word(double length, double seconds, double most) const {
    const double slowest = std::max(seconds, length / most);
    switch (options_.dialect) {
      case GcodeDialect::G93PerMinute:
        return digits_not_above(units::kSecondsPerMinute / slowest);
      case GcodeDialect::G93Seconds:
        return digits_not_below(slowest);
      case GcodeDialect::G94:
        break;
    }
    return digits_not_above(std::min(units::mm_per_min(length / slowest), options_.max_feed_mm_per_min) / unit());
  }

  void write_removing(const ProgramStep& step, std::size_t number) {
    if (step.length() > 0.0 && !(step.seconds * max_feed_ >= step.length() * (1.0 - 1e-6) - 4e-6)) {
      throw std::logic_error(fmt::format("program step {} takes {} s for {} mm; that is above maximum feed {} mm/min",
                                         number, step.seconds, step.length(), options_.max_feed_mm_per_min));
    }
    const NamedPlace to = named(step.finish);
    const double length = distance(at_.point, to.point);
    if (length > 0.0) {
      const double most = std::min(max_feed_, speed_limit(machine_, to.point - at_.point));
      block("G1 {}{} {}{} F{}", machine_.letters.x, to.x, machine_.letters.y, to.y,
            feed_word(length, step.seconds, most));
    } else {
      halt(step.seconds);
    }
    at_ = to;
  }

  // What a clock takes or gives by its steps is made up for by the next halt.
  void halt(double seconds) {
    const double step = machine_.controller.time_resolution;
    if (!(step > 0.0)) return block("G4 P{}", digits_nearest(seconds));
    halts_ += seconds;
    const double steps = std::max(1.0, std::round((halts_ - halted_) / step));
    halted_ += steps * step;
    block("G4 P{}", digits_nearest(steps * step));
  }

  static constexpr int kLastBlockNumber = 99999;  // of RS274/NGC; numbers need not be different

  const GcodeOptions& options_;
  double max_feed_;
  Machine machine_;  // without limits where none is given
  std::string lift_height_;
  fmt::memory_buffer text_;
  ProgramFrame frame_;
  int block_number_ = options_.style.block_numbers;
  bool lifted_ = false;
  NamedPlace at_;
  double halts_ = 0.0, halted_ = 0.0;  // sums of the halts, as they should be and as they were written [s]
};

}  // namespace

std::string gcode_text(const Program& program, const GcodeOptions& options, const Progress& progress) {
  return GcodeWriter(options).write(program, progress);
}

}  // namespace dwell
