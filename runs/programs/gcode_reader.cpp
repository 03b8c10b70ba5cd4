#include "runs/programs/gcode_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/units.h"
#include "core/base/value_range.h"
#include "runs/programs/frame_text.h"
#include "runs/programs/gcode_block.h"
#include "runs/programs/gcode_remarks.h"
#include "runs/programs/gcode_tool.h"
#include "runs/programs/gcode_words.h"

namespace dwell {
namespace {

class GcodeInterpreter {
 public:
  GcodeInterpreter(std::string file, const GcodeReading& reading) : file_(std::move(file)), remarks_(reading) {
    program_.file = file_;
  }

  GcodeSteps run(std::string_view text, const Progress& progress) {
    Poll poll(progress);
    bool ended = false;
    while (!ended && !text.empty()) {
      poll.step();
      const std::size_t newline = text.find('\n');
      ++line_number_;
      ended = run_line(text.substr(0, newline));
      text.remove_prefix(newline == std::string_view::npos ? text.size() : newline + 1);
    }
    if (!ended) {
      throw InputError(fmt::format("{}: ends at line {} without M2 or M30{}; the program is truncated", file_,
                                   line_number_, framed_ ? ", or the % after it" : ""));
    }
    if (program_.steps.empty()) throw InputError(fmt::format("{}: holds no move and no halt", file_));
    program_.frame = remarks_.frame();
    add_notes();
    return {std::move(program_), std::move(lines_)};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(GcodePlace{file_, line_number_}.text() + ": " + what);
  }

  bool run_line(std::string_view line) {
    if (is_tape_mark(line)) return take_tape_mark();
    const GcodePlace where{file_, line_number_};
    split_gcode_line(line, where, parts_);
    for (const std::string_view comment : parts_.comments) {
      remarks_.take(comment, where, {inches_, x_ || y_ || z_});
    }
    if (parts_.words.empty()) return false;
    const GcodeBlock block = collect_gcode_block(parts_, where, remarks_.reading().letters);
    if (block.numbered && begun_)
      fail("O: another program begins before the end of this one; required M2 or M30 first");
    begun_ = true;
    tool_.take(block);
    if (block.inches) set_unit(*block.inches);
    if (block.path_mode) set_path_mode(*block.path_mode);
    if (block.feed_mode) set_feed_mode(*block.feed_mode);
    if (block.f) set_feed(*block.f);
    if (block.work_offset) set_work_offset(*block.work_offset);
    if (block.halt) halt(block);
    if (block.incremental) incremental_ = *block.incremental;
    if (block.motion) motion_ = block.motion;
    if (block.has_axes() && !block.halt) move(block);
    if (block.pause || block.change_tool) wait_for_operator(block);
    return block.end;
  }

  // A % before the program and one after it; the second ends it.
  bool take_tape_mark() {
    if (framed_) return true;
    if (begun_) fail("% after a program that does not begin with one; its beginning may be missing");
    framed_ = true;
    return false;
  }

  // What F meant in the other unit is said anew. Places that were read keep their place.
  void set_unit(bool inches) {
    if (inches != inches_) feed_.reset();
    inches_ = inches;
    says_unit_ = true;
  }

  double millimetres(double length) const { return inches_ ? units::kMmPerInch * length : length; }

  void set_feed_mode(int mode) {
    const bool inverse = mode == 93;
    const std::optional<GcodeDialect>& dialect = remarks_.reading().dialect;
    if (inverse && !dialect) {
      fail(
          "G93: controllers disagree on whether F is then seconds or 1/minutes; required the dialect g93-per-minute or "
          "g93-seconds, given or in a comment \"(dwell: gcode=...)\"");
    }
    if (inverse && dialect == GcodeDialect::G94) fail("G93 in a program read as g94; accepted: G94");
    if (inverse != inverse_time_) feed_.reset();
    inverse_time_ = inverse;
  }

  void set_feed(double f) {
    if (!(f > 0.0)) fail(fmt::format("F = {}; required > 0", f));
    feed_ = inverse_time_ ? f : millimetres(f);
  }

  // The part's coordinates are those of one offset of the origin; of how far apart two are the program says nothing.
  void set_work_offset(int offset) {
    constexpr int kUsual = 540;
    // Before the tool is brought anywhere but up, no place hangs on an offset.
    const bool placed = x_ || y_ || (z_ && at_work(*z_));
    if (!work_offset_ && placed) work_offset_ = kUsual;
    if (placed && *work_offset_ != offset) {
      fail(
          fmt::format("G{} after moves with G{}: where the one lies in the other the program does not say; required "
                      "one of them throughout",
                      offset / 10.0, *work_offset_ / 10.0));
    }
    work_offset_ = offset;
    says_work_offset_ = true;
  }

  // Two changes before the same step: the second holds.
  void set_path_mode(PathMode mode) {
    for (std::optional<double>* length : {&mode.tolerance_mm, &mode.merging_mm}) {
      if (*length) *length = millimetres(**length);
    }
    std::vector<PathModeChange>& modes = program_.path_modes;
    const std::size_t first = program_.steps.size();
    if (!modes.empty() && modes.back().first_step == first) modes.pop_back();
    modes.push_back({first, mode});
  }

  // Stops, and changes of the tool, take a time that the program does not say.
  void wait_for_operator(const GcodeBlock& block) const {
    if (z_ ? !at_work(*z_) : !x_ && !y_) return;
    fail(
        fmt::format("{} while the tool may be at work, for a time that the program does not say; required Z > 0 "
                    "before it",
                    block.change_tool ? "M6" : "M0 or M1"));
  }

  double halt_seconds(const GcodeWord& p) {
    constexpr double kPerSecond = 1000.0;
    if (!(p.value >= 0.0)) fail("G4 needs P, the time of the halt, >= 0, as G4 P0.5");
    const bool has_point = p.text.find('.') != std::string_view::npos;
    const std::optional<HaltUnit>& halts = remarks_.reading().halts;
    if (p.value == 0.0) return 0.0;
    if (!halts && !has_point) {
      fail(
          fmt::format("G4 {}: a whole number is seconds on some controllers (RS274/NGC, LinuxCNC) and milliseconds "
                      "on others (Fanuc, Haas); required --g4 s or --g4 ms, or a decimal point, which means "
                      "seconds",
                      p.text));
    }
    if (halts == HaltUnit::Milliseconds) {
      if (has_point) {
        fail(
            fmt::format("G4 {}: milliseconds with a decimal point, which such controllers read as seconds or refuse; "
                        "required a whole number",
                        p.text));
      }
      return p.value / kPerSecond;
    }
    if (!halts) reads_halts_as_seconds_ = true;
    return p.value;
  }

  void halt(const GcodeBlock& block) {
    if (!block.p) fail("G4 needs P, the time of the halt, as G4 P0.5");
    const double seconds = halt_seconds(*block.p);
    if (!(seconds <= ranges::kTime.most)) {
      fail(fmt::format("G4 {}: a halt of {:.3g} s; required at most {} s", block.p->text, seconds, ranges::kTime.most));
    }
    if (!x_ || !y_ || !z_) fail("G4 at an unknown position; required X, Y and Z before it, as G0 Z10 and G0 X0 Y0");
    const Point at{*x_, *y_};
    if (seconds > 0.0) add_step({at, at, seconds, at_work(*z_)});
  }

  void add_step(ProgramStep step) {
    step.start = remarks_.frame().to_part(step.start);
    step.finish = remarks_.frame().to_part(step.finish);
    if (step.seconds > 0.0) program_.rapid_length += std::exchange(rapid_length_, 0.0);
    if (step.removes) {
      if (!at_work_) at_work_ = tool_;
      const std::string difference = tool_difference(*at_work_, tool_);
      if (!difference.empty()) {
        fail(
            fmt::format("{} than where the tool was first at work: another removal function, and one is given; "
                        "required the same throughout",
                        difference));
      }
    }
    program_.steps.push_back(step);
    lines_.push_back(line_number_);
  }

  static bool at_work(double z) { return std::abs(z) < 1e-9; }

  std::optional<double> target(std::optional<double> word, std::optional<double> now, char axis) const {
    if (!word) return now;
    const double length = millimetres(*word);
    if (!incremental_ && std::isfinite(length)) return length;
    if (incremental_ && !now)
      fail(fmt::format("{}{} after G91 from an unknown position; required an absolute (G90) {} first", axis, *word,
                       axis));
    const double sum = now.value_or(0.0) + length;
    if (!std::isfinite(sum)) fail(fmt::format("{}{} leads beyond any position; required a finite one", axis, *word));
    return sum;
  }

  void move(const GcodeBlock& block) {
    if (!motion_) fail("X, Y or Z before any G0 or G1; required one of them");
    remarks_.check_unit(inches_);
    const std::optional<double> x = target(block.x, x_, 'X');
    const std::optional<double> y = target(block.y, y_, 'Y');
    const std::optional<double> z = target(block.z, z_, 'Z');
    if (z && !at_work(*z) && !(*z > 0.0)) {
      fail(fmt::format("Z = {} mm is below the working height; accepted: 0 (at work) and above (lifted)", *z));
    }
    if (*motion_ == 0) {
      rapid(x, y, z);
    } else {
      feed_move(block, x, y, z);
    }
    x_ = x;
    y_ = y;
    z_ = z;
  }

  void rapid(std::optional<double> x, std::optional<double> y, std::optional<double> z) {
    if (x_ && y_ && z_) rapid_length_ += std::hypot(*x - *x_, *y - *y_, *z - *z_);
    if (x == x_ && y == y_) return;
    const bool arrives = !x_ && !y_ && !z_;  // from where the machine stood before the program
    const bool lifted = z_ && z && !at_work(*z_) && !at_work(*z);
    if (!arrives && !lifted) {
      fail(
          "G0 over the part while the tool is not known to be lifted, at a speed that the program does not say; "
          "required Z > "
          "0 before it, or G1 with F");
    }
    if (x_ && y_) add_step({{*x_, *y_}, {*x, *y}, 0.0, false});
  }

  void feed_move(const GcodeBlock& block, std::optional<double> x, std::optional<double> y, std::optional<double> z) {
    if (!x_ || !y_ || !z_) {
      fail("G1 from an unknown position; required X, Y and Z before it, as G0 Z10 and G0 X0 Y0");
    }
    if (inverse_time_ && !block.f) fail("G1 without F; after G93 each move needs its own");
    if (!feed_) fail("G1 without F; required F > 0 on this line or one before it");
    const Point start{*x_, *y_};
    const Point finish{*x, *y};
    const double length = std::hypot(finish.x - start.x, finish.y - start.y, *z - *z_);
    if (!(length > 0.0)) {
      if (!inverse_time_) return;
      fail(
          fmt::format("a move of no length with F{} after G93: a halt on some controllers and nothing on others; "
                      "required a move, or for a halt G4",
                      *feed_));
    }
    const double seconds = seconds_of(length);
    if (!(seconds <= ranges::kTime.most)) {
      fail(fmt::format("a move of {} mm with F{} takes {:.3g} s; required at most {} s", length, *feed_, seconds,
                       ranges::kTime.most));
    }
    program_.fastest_feed = std::max(program_.fastest_feed, length / seconds);
    add_step({start, finish, seconds, at_work(*z_) && at_work(*z)});
  }

  double seconds_of(double length) const {
    if (!inverse_time_) return length / *feed_ * units::kSecondsPerMinute;
    return remarks_.reading().dialect == GcodeDialect::G93Seconds ? *feed_ : units::kSecondsPerMinute / *feed_;
  }

  // What the program left to its controller and how it was read.
  void add_notes() {
    if (!says_unit_) program_.notes.emplace_back("the program names no unit (G21): read as millimetres");
    if (!program_.frame.is_of_part()) {
      program_.notes.push_back(fmt::format(
          "the program says how it lies against the part ({}): its places are taken back to those of the part",
          frame_text(program_.frame)));
    }
    if (reads_halts_as_seconds_) program_.notes.emplace_back("P of G4, with a decimal point, read as seconds");
    if (says_work_offset_) {
      program_.notes.push_back(fmt::format(
          "G{}: the offset of its origin, which the program does not say, is taken as zero: X and Y are the "
          "map's",
          *work_offset_ / 10.0));
    }
    if (tool_.number || tool_.changes > 0) {
      program_.notes.emplace_back("T, M6: the tool's offset is taken as zero, and the removal function as this tool's");
    }
    if (!program_.path_modes.empty()) {
      program_.notes.emplace_back(
          "G61, G61.1, G64: kept; without a machine (--machine) moves are taken as written, their corners neither "
          "rounded "
          "nor slowed down");
    }
  }

  std::string file_;
  GcodeRemarks remarks_;
  Program program_;
  std::vector<std::size_t> lines_;  // of its steps
  std::size_t line_number_ = 0;
  GcodeLine parts_;                      // of the line
  bool begun_ = false, framed_ = false;  // by a word, by a %
  bool inches_ = false, says_unit_ = false, says_work_offset_ = false, reads_halts_as_seconds_ = false;
  GcodeTool tool_;
  std::optional<GcodeTool> at_work_;  // the tool when it was first at work
  std::optional<double> x_, y_, z_;
  double rapid_length_ = 0.0;  // since the last of the work [mm]
  std::optional<int> motion_;
  std::optional<int> work_offset_;
  std::optional<double> feed_;
  bool incremental_ = false;
  bool inverse_time_ = false;
};

}  // namespace

Program read_gcode(std::string_view text, const std::string& file, const GcodeReading& reading,
                   const Progress& progress) {
  return read_gcode_steps(text, file, reading, progress).program;
}

GcodeSteps read_gcode_steps(std::string_view text, const std::string& file, const GcodeReading& reading,
                            const Progress& progress) {
  return GcodeInterpreter(file, reading).run(without_byte_order_mark(text), progress);
}

}  // namespace dwell
