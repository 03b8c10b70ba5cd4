#include "runs/programs/gcode_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/units.h"
#include "runs/programs/gcode_words.h"

namespace dwell {
namespace {

constexpr const char* kAccepted =
    "accepted: G0 G1 G4 G17 G21 G90 G91 G93 G94, M2 M30 M3 M5 M7 M8 M9, and F N P S X Y Z";

// What the words of one line ask for.
struct Block {
  std::optional<double> x, y, z, f, p;
  std::optional<int> motion;  // 0 or 1
  std::optional<bool> incremental;
  std::optional<int> feed_mode;  // 93 or 94
  bool halt = false;
  bool end = false;

  bool has_axes() const { return x || y || z; }
};

class GcodeInterpreter {
 public:
  GcodeInterpreter(std::string file, std::optional<GcodeDialect> dialect) : file_(std::move(file)), dialect_(dialect) {
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
      throw InputError(
          fmt::format("{}: ends at line {} without M2 or M30; the program is truncated", file_, line_number_));
    }
    if (program_.steps.empty()) throw InputError(fmt::format("{}: holds no move and no halt", file_));
    return std::move(program_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(GcodePlace{file_, line_number_}.text() + ": " + what);
  }

  bool run_line(std::string_view line) {
    split_gcode_line(line, {file_, line_number_}, parts_);
    for (const std::string_view comment : parts_.comments) read_comment(comment);
    const Block block = collect(parts_);
    if (block.feed_mode) set_feed_mode(*block.feed_mode);
    if (block.f) set_feed(*block.f);
    if (block.halt) halt(block);
    if (block.incremental) incremental_ = *block.incremental;
    if (block.motion) motion_ = block.motion;
    if (block.has_axes() && !block.halt) move(block);
    return block.end;
  }

  // "(dwell: gcode=g93-seconds, g4=seconds, ...)" states what the standard leaves to the controller.
  void read_comment(std::string_view comment) {
    constexpr std::string_view kPrefix = "dwell:";
    while (comment.starts_with(' ')) comment.remove_prefix(1);
    if (!comment.starts_with(kPrefix)) return;
    comment.remove_prefix(kPrefix.size());
    while (!comment.empty()) {
      const std::size_t comma = comment.find(',');
      std::string_view entry = comment.substr(0, comma);
      comment.remove_prefix(comma == std::string_view::npos ? comment.size() : comma + 1);
      while (entry.starts_with(' ')) entry.remove_prefix(1);
      while (!entry.empty() && (entry.back() == ' ' || entry.back() == '\r')) entry.remove_suffix(1);
      if (entry.starts_with("gcode=")) read_dialect(std::string(entry.substr(6)));
      if (entry.starts_with("g4=") && entry != "g4=seconds") fail(fmt::format("{}; accepted: g4=seconds", entry));
    }
  }

  void read_dialect(const std::string& text) {
    GcodeDialect stated{};
    try {
      stated = parse_gcode_dialect(text);
    } catch (const InputError& error) {
      fail(error.what());
    }
    if (dialect_ && *dialect_ != stated) {
      fail(fmt::format("the program says gcode={}, but it is to be read as {}; required the same", text,
                       to_string(*dialect_)));
    }
    dialect_ = stated;
  }

  Block collect(const GcodeLine& line) const {
    Block block;
    for (const GcodeWord& word : line.words) {
      switch (word.letter) {
        case 'G':
          collect_g(block, word);
          break;
        case 'M':
          collect_m(block, word);
          break;
        case 'X':
          once(block.x, word.value, word);
          break;
        case 'Y':
          once(block.y, word.value, word);
          break;
        case 'Z':
          once(block.z, word.value, word);
          break;
        case 'F':
          once(block.f, word.value, word);
          break;
        case 'P':
          once(block.p, word.value, word);
          break;
        case 'N':
        case 'S':
          break;
        default:
          fail(fmt::format("word \"{}\"; {}", word.text, kAccepted));
      }
    }
    if (block.p && !block.halt) fail("P without G4; accepted only as the seconds of a halt, as G4 P0.5");
    if (block.halt && (block.has_axes() || block.motion))
      fail("G4 together with a move; required on a line of its own");
    return block;
  }

  template <typename Value>
  void once(std::optional<Value>& slot, Value value, const GcodeWord& word) const {
    if (slot) fail(fmt::format("\"{}\" is the second word of its kind on this line; accepted: one", word.text));
    slot = value;
  }

  void collect_g(Block& block, const GcodeWord& word) const {
    if (word.value == 0.0 || word.value == 1.0) {
      once(block.motion, word.value == 1.0 ? 1 : 0, word);
    } else if (word.value == 4.0) {
      block.halt = true;
    } else if (word.value == 90.0 || word.value == 91.0) {
      once(block.incremental, word.value == 91.0, word);
    } else if (word.value == 93.0 || word.value == 94.0) {
      once(block.feed_mode, word.value == 93.0 ? 93 : 94, word);
    } else if (word.value == 20.0) {
      fail(fmt::format("\"{}\": inches are not accepted; required millimetres (G21)", word.text));
    } else if (word.value != 17.0 && word.value != 21.0) {
      fail(fmt::format("word \"{}\"; {}", word.text, kAccepted));
    }
  }

  void collect_m(Block& block, const GcodeWord& word) const {
    if (word.value == 2.0 || word.value == 30.0) {
      block.end = true;
      return;
    }
    for (const double ignored : {3.0, 5.0, 7.0, 8.0, 9.0}) {
      if (word.value == ignored) return;
    }
    fail(fmt::format("word \"{}\"; {}", word.text, kAccepted));
  }

  void set_feed_mode(int mode) {
    const bool inverse = mode == 93;
    if (inverse && !dialect_) {
      fail(
          "G93: controllers disagree on whether F is then seconds or 1/minutes; required the dialect g93-per-minute or "
          "g93-seconds, given or in a comment \"(dwell: gcode=...)\"");
    }
    if (inverse && dialect_ == GcodeDialect::G94) fail("G93 in a program read as g94; accepted: G94");
    if (inverse != inverse_time_) feed_.reset();
    inverse_time_ = inverse;
  }

  void set_feed(double f) {
    if (!(f > 0.0)) fail(fmt::format("F = {}; required > 0", f));
    feed_ = f;
  }

  void halt(const Block& block) {
    if (!block.p || !(*block.p >= 0.0)) fail("G4 needs P, the seconds of the halt, >= 0, as G4 P0.5");
    if (!x_ || !y_ || !z_) fail("G4 at an unknown position; required X, Y and Z before it, as G0 Z10 and G0 X0 Y0");
    const Point at{*x_, *y_};
    if (*block.p > 0.0) program_.steps.push_back({at, at, *block.p, at_work(*z_)});
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

  void move(const Block& block) {
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
    if (x == x_ && y == y_) return;
    const bool arrives = !x_ && !y_ && !z_;  // from where the machine stood before the program
    const bool lifted = z_ && z && !at_work(*z_) && !at_work(*z);
    if (!arrives && !lifted) {
      fail(
          "G0 over the part while the tool is not known to be lifted, at a speed that the program does not say; "
          "required Z > "
          "0 before it, or G1 with F");
    }
    if (x_ && y_) program_.steps.push_back({{*x_, *y_}, {*x, *y}, 0.0, false});
  }

  void feed_move(const Block& block, std::optional<double> x, std::optional<double> y, std::optional<double> z) {
    if (!x_ || !y_ || !z_) {
      fail("G1 from an unknown position; required X, Y and Z before it, as G0 Z10 and G0 X0 Y0");
    }
    if (inverse_time_ && !block.f) fail("G1 without F; after G93 each move needs its own");
    if (!feed_) fail("G1 without F; required F > 0 on this line or one before it");
    const Point start{*x_, *y_};
    const Point finish{*x, *y};
    const double length = std::hypot(finish.x - start.x, finish.y - start.y, *z - *z_);
    if (!(length > 0.0)) return;
    const double seconds = seconds_of(length);
    if (!std::isfinite(seconds))
      fail(fmt::format("a move of {} mm with F{} never ends; required a larger F", length, *feed_));
    program_.steps.push_back({start, finish, seconds, at_work(*z_) && at_work(*z)});
  }

  double seconds_of(double length) const {
    if (!inverse_time_) return length / *feed_ * units::kSecondsPerMinute;
    return dialect_ == GcodeDialect::G93Seconds ? *feed_ : units::kSecondsPerMinute / *feed_;
  }

  std::string file_;
  std::optional<GcodeDialect> dialect_;
  Program program_;
  std::size_t line_number_ = 0;
  GcodeLine parts_;  // of the line
  std::optional<double> x_, y_, z_;
  std::optional<int> motion_;
  std::optional<double> feed_;
  bool incremental_ = false;
  bool inverse_time_ = false;
};

}  // namespace

Program read_gcode(std::string_view text, const std::string& file, std::optional<GcodeDialect> dialect,
                   const Progress& progress) {
  return GcodeInterpreter(file, dialect).run(without_byte_order_mark(text), progress);
}

}  // namespace dwell
