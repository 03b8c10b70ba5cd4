#include "runs/programs/gcode_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/units.h"
#include "core/base/utf8_text.h"
#include "core/base/value_range.h"
#include "core/formats/path_remark.h"
#include "core/map/unit_mention.h"
#include "runs/programs/gcode_block.h"
#include "runs/programs/gcode_tool.h"
#include "runs/programs/gcode_words.h"
#include "runs/programs/recorded_option.h"

namespace dwell {
namespace {

// What our own programs say in "(dwell: ...)" of the height of the tool, which is as any program is read.
constexpr std::string_view kAtWorkAtZero = "tool at work when Z=0";
constexpr std::string_view kLiftedAbove = "lifted when Z>0";

class GcodeInterpreter {
 public:
  GcodeInterpreter(std::string file, const GcodeReading& reading) : file_(std::move(file)), reading_(reading) {
    program_.file = file_;
  }

  Program run(std::string_view text, const Progress& progress) {
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
    add_notes();
    return std::move(program_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(GcodePlace{file_, line_number_}.text() + ": " + what);
  }

  bool run_line(std::string_view line) {
    if (is_tape_mark(line)) return take_tape_mark();
    const GcodePlace where{file_, line_number_};
    split_gcode_line(line, where, parts_);
    for (const std::string_view comment : parts_.comments) read_comment(comment);
    if (parts_.words.empty()) return false;
    const GcodeBlock block = collect_gcode_block(parts_, where);
    if (block.numbered && begun_)
      fail("O: another program begins before the end of this one; required M2 or M30 first");
    begun_ = true;
    tool_.take(block);
    if (block.millimetres) says_millimetres_ = true;
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

  // "(dwell: gcode=g93-seconds, g4=seconds, ...)" states what the standard leaves to the controller.
  void read_comment(std::string_view comment) {
    constexpr std::string_view kPrefix = "dwell:";
    while (comment.starts_with(' ')) comment.remove_prefix(1);
    if (!comment.starts_with(kPrefix)) return check_remark(comment);
    comment.remove_prefix(kPrefix.size());
    while (!comment.empty()) {
      const std::size_t comma = comment.find(',');
      std::string_view entry = comment.substr(0, comma);
      comment.remove_prefix(comma == std::string_view::npos ? comment.size() : comma + 1);
      while (entry.starts_with(' ')) entry.remove_prefix(1);
      while (!entry.empty() && (entry.back() == ' ' || entry.back() == '\r')) entry.remove_suffix(1);
      read_entry(entry);
    }
  }

  /// A comment that names another unit than the program is read in, or other axes, is not skipped.
  void check_remark(std::string_view comment) const {
    if (is_record(comment)) return;
    if (const auto unit = find_other_unit(comment, reading_.halts == HaltUnit::Milliseconds)) {
      fail(fmt::format(
          "\"{}\" in the comment \"{}\" looks like another unit; accepted: X, Y, Z in mm and F in mm/min, or "
          "the comment without a unit",
          with_escaped_bytes(*unit), with_escaped_bytes(trim(comment))));
    }
    if (const auto other = find_other_axes(comment)) {
      fail(
          fmt::format("the comment \"{}\" looks like {}; accepted: X, Y as those of the map in mm, or the comment left "
                      "out",
                      with_escaped_bytes(trim(comment)), *other));
    }
  }

  void read_entry(std::string_view entry) {
    if (entry.starts_with("gcode=")) {
      read_dialect(std::string(entry.substr(6)));
    } else if (entry.starts_with("g4=")) {
      read_halt_unit(entry);
    } else if (entry.find_first_of("=<>") != std::string_view::npos && entry != kAtWorkAtZero &&
               entry != kLiftedAbove) {
      fail(fmt::format("\"{}\" in the comment \"(dwell: ...)\"; accepted: gcode=..., g4=..., {}, {}", entry,
                       kAtWorkAtZero, kLiftedAbove));
    }
  }

  void read_halt_unit(std::string_view entry) {
    if (entry != "g4=seconds" && entry != "g4=milliseconds") {
      fail(fmt::format("{}; accepted: g4=seconds, g4=milliseconds", entry));
    }
    const HaltUnit stated = entry == "g4=seconds" ? HaltUnit::Seconds : HaltUnit::Milliseconds;
    if (reading_.halts && *reading_.halts != stated) {
      fail(fmt::format("the program says {}, but P of G4 is to be read as {}; required the same", entry,
                       to_string(*reading_.halts)));
    }
    reading_.halts = stated;
  }

  void read_dialect(const std::string& text) {
    GcodeDialect stated{};
    try {
      stated = parse_gcode_dialect(text);
    } catch (const InputError& error) {
      fail(error.what());
    }
    if (reading_.dialect && *reading_.dialect != stated) {
      fail(fmt::format("the program says gcode={}, but it is to be read as {}; required the same", text,
                       to_string(*reading_.dialect)));
    }
    reading_.dialect = stated;
  }

  void set_feed_mode(int mode) {
    const bool inverse = mode == 93;
    if (inverse && !reading_.dialect) {
      fail(
          "G93: controllers disagree on whether F is then seconds or 1/minutes; required the dialect g93-per-minute or "
          "g93-seconds, given or in a comment \"(dwell: gcode=...)\"");
    }
    if (inverse && reading_.dialect == GcodeDialect::G94) fail("G93 in a program read as g94; accepted: G94");
    if (inverse != inverse_time_) feed_.reset();
    inverse_time_ = inverse;
  }

  void set_feed(double f) {
    if (!(f > 0.0)) fail(fmt::format("F = {}; required > 0", f));
    feed_ = f;
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
  void set_path_mode(const PathMode& mode) {
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
    if (p.value == 0.0) return 0.0;
    if (!reading_.halts && !has_point) {
      fail(
          fmt::format("G4 {}: a whole number is seconds on some controllers (RS274/NGC, LinuxCNC) and milliseconds "
                      "on others (Fanuc, Haas); required --g4 s or --g4 ms, or a decimal point, which means "
                      "seconds",
                      p.text));
    }
    if (reading_.halts == HaltUnit::Milliseconds) {
      if (has_point) {
        fail(
            fmt::format("G4 {}: milliseconds with a decimal point, which such controllers read as seconds or refuse; "
                        "required a whole number",
                        p.text));
      }
      return p.value / kPerSecond;
    }
    if (!reading_.halts) reads_halts_as_seconds_ = true;
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

  void add_step(const ProgramStep& step) {
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
  }

  static bool at_work(double z) { return std::abs(z) < 1e-9; }

  std::optional<double> target(std::optional<double> word, std::optional<double> now, char axis) const {
    if (!word) return now;
    if (!incremental_) return word;
    if (!now)
      fail(fmt::format("{}{} after G91 from an unknown position; required an absolute (G90) {} first", axis, *word,
                       axis));
    const double sum = *now + *word;
    if (!std::isfinite(sum)) fail(fmt::format("{}{} leads beyond any position; required a finite one", axis, *word));
    return sum;
  }

  void move(const GcodeBlock& block) {
    if (!motion_) fail("X, Y or Z before any G0 or G1; required one of them");
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
    return reading_.dialect == GcodeDialect::G93Seconds ? *feed_ : units::kSecondsPerMinute / *feed_;
  }

  // What the program left to its controller and how it was read.
  void add_notes() {
    if (!says_millimetres_) program_.notes.emplace_back("the program names no unit (G21): read as millimetres");
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
  GcodeReading reading_;
  Program program_;
  std::size_t line_number_ = 0;
  GcodeLine parts_;                      // of the line
  bool begun_ = false, framed_ = false;  // by a word, by a %
  bool says_millimetres_ = false, says_work_offset_ = false, reads_halts_as_seconds_ = false;
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
  return GcodeInterpreter(file, reading).run(without_byte_order_mark(text), progress);
}

}  // namespace dwell
