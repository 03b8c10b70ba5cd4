#include "runs/programs/gcode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/base/units.h"
#include "core/base/utf8_text.h"
#include "runs/programs/number_text.h"

namespace dwell {
namespace {

std::string comment(std::string text) {
  for (char& c : text) {
    if (c == '(') c = '[';
    if (c == ')') c = ']';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return "(" + with_escaped_bytes(text) + ")\n";
}

// A point as the program names it, and where the machine then goes.
struct Position {
  std::string x, y;
  Point point;

  explicit Position(Point p) : x(coordinate_text(p.x)), y(coordinate_text(p.y)), point{number_of(x), number_of(y)} {}
};

class GcodeWriter {
 public:
  explicit GcodeWriter(const GcodeOptions& options)
      : options_(options), max_feed_(units::mm_per_s(options.max_feed_mm_per_min)) {
    if (!(options.max_feed_mm_per_min > 0.0) || !std::isfinite(options.max_feed_mm_per_min)) {
      throw InputError(fmt::format("maximum feed = {} mm/min; required finite and > 0", options.max_feed_mm_per_min));
    }
    if (!(options.lift_height_mm >= 1e-6) || !std::isfinite(options.lift_height_mm)) {
      throw InputError(fmt::format("lift height = {} mm; required finite and >= 1e-6", options.lift_height_mm));
    }
    lift_height_ = coordinate_text(options.lift_height_mm);
  }

  std::string write(const Program& program, const Progress& progress) {
    write_header();
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
    lift();
    add("M2\n");
    return fmt::to_string(text_);
  }

 private:
  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  void write_header() {
    for (const std::string& line : options_.header) add("{}", comment(line));
    const char* f = options_.dialect == GcodeDialect::G94            ? "mm/min"
                    : options_.dialect == GcodeDialect::G93PerMinute ? "1/(minutes of the move)"
                                                                     : "seconds of the move";
    add("{}", comment(fmt::format("units: X Y Z mm, F {}, P seconds", f)));
    add("(dwell: gcode={}, g4=seconds, tool at work when Z=0, lifted when Z>0)\n", to_string(options_.dialect));
    add("G21\nG90\nG17\n{}\n", options_.dialect == GcodeDialect::G94 ? "G94" : "G93");
  }

  void lift() {
    if (!lifted_) add("G0 Z{}\n", lift_height_);
    lifted_ = true;
  }

  void reposition(Point to) {
    lift();
    at_ = Position(to);
    add("G0 X{} Y{}\n", at_.x, at_.y);
  }

  void come_down() {
    if (!lifted_) return;
    add("G1 Z0 F{}\n", feed_word(number_of(lift_height_), 0.0));
    lifted_ = false;
  }

  // F of a move of `length` [mm] that should take `seconds`: never faster than that, nor than maximum feed.
  std::string feed_word(double length, double seconds) const {
    const double slowest = std::max(seconds, length / max_feed_);
    switch (options_.dialect) {
      case GcodeDialect::G93PerMinute:
        return digits_not_above(units::kSecondsPerMinute / slowest);
      case GcodeDialect::G93Seconds:
        return digits_not_below(slowest);
      case GcodeDialect::G94:
        break;
    }
    return digits_not_above(std::min(units::mm_per_min(length / slowest), options_.max_feed_mm_per_min));
  }

  void write_removing(const ProgramStep& step, std::size_t number) {
    if (step.length() > 0.0 && !(step.seconds * max_feed_ >= step.length() * (1.0 - 1e-6) - 4e-6)) {
      throw std::logic_error(fmt::format("program step {} takes {} s for {} mm; that is above maximum feed {} mm/min",
                                         number, step.seconds, step.length(), options_.max_feed_mm_per_min));
    }
    const Position to(step.finish);
    const double length = distance(at_.point, to.point);
    if (length > 0.0) {
      add("G1 X{} Y{} F{}\n", to.x, to.y, feed_word(length, step.seconds));
    } else {
      add("G4 P{}\n", digits_nearest(step.seconds));
    }
    at_ = to;
  }

  const GcodeOptions& options_;
  double max_feed_;
  std::string lift_height_;
  fmt::memory_buffer text_;
  bool lifted_ = false;
  Position at_{Point{}};
};

}  // namespace

std::string gcode_text(const Program& program, const GcodeOptions& options, const Progress& progress) {
  return GcodeWriter(options).write(program, progress);
}

}  // namespace dwell
