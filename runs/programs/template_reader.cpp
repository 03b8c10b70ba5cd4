#include "runs/programs/template_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/units.h"
#include "core/base/utf8_text.h"
#include "core/base/value_range.h"
#include "core/map/unit_mention.h"
#include "core/motion/cubic_move.h"
#include "runs/programs/frame_text.h"
#include "runs/programs/pvt_place.h"
#include "runs/programs/recorded_option.h"

namespace dwell {
namespace {

struct TemplateTextLine {
  long number;
  std::string_view text;
};

/// The numbers of a block in a program, in mm, mm/s, mm/min and s.
using TemplateValues = std::map<std::string, double>;

class TemplateTextReader {
 public:
  TemplateTextReader(std::string_view text, const std::string& file, const ProgramTemplate& layout,
                     const Progress& progress)
      : file_(file), layout_(layout), poll_(progress) {
    const std::string_view begin = trim(layout.comment_begin), end = trim(layout.comment_end);
    for (TextLines lines(text); lines.next();) {
      poll_.step();
      std::string_view line = trim(lines.line());
      if (line.empty()) continue;
      const bool comment = line.size() >= begin.size() + end.size() && line.starts_with(begin) && line.ends_with(end);
      if (comment) {
        line.remove_prefix(begin.size());
        line.remove_suffix(end.size());
        read_comment(trim(line), lines.number());
      } else {
        lines_.push_back({lines.number(), without_block_number(line)});
      }
    }
  }

  Program read() {
    program_.file = file_;
    program_.frame = frame_;
    expect(layout_.header, "header");
    expect(layout_.begin, "begin");
    check_lifted("begin");
    while (take(layout_.travel)) {
      travel();
      check_lifted("travel");
      expect(layout_.lower, "lower");
      read_stretch();
      expect(layout_.lift, "lift");
      check_lifted("lift");
      check_end();
    }
    expect(layout_.footer, "footer");
    if (at_ < lines_.size()) fail("is after the footer", {});
    if (program_.steps.empty()) throw InputError(fmt::format("{}: holds no move and no halt", file_));
    if (program_.rapid_length > 0.0)
      program_.notes.emplace_back("read by a template: the ways up and down take their time besides");
    return std::move(program_);
  }

 private:
  std::string_view without_block_number(std::string_view line) const {
    if (!layout_.block_numbers || !line.starts_with('N')) return line;
    const std::size_t end = line.find_first_not_of("0123456789", 1);
    if (end == 1 || end == std::string_view::npos || line[end] != ' ') return line;
    return trim(line.substr(end));
  }

  /// Comments say how the program lies against the part. What contradicts the template's units is refused.
  void read_comment(std::string_view comment, long number) {
    const std::string text = lower_case(comment);
    constexpr std::string_view kFrame = "dwell: zero=";
    if (text.starts_with(kFrame)) {
      if (!frame_.is_of_part()) refuse_line(number, "says a second frame; required one");
      frame_ = parse_frame(std::string_view(text).substr(kFrame.find("zero=")));
    } else if (text.starts_with("dwell: template=")) {
      const std::string name = lower_case(text.substr(text.find('=') + 1)), expected = lower_case(layout_.name);
      if (!expected.starts_with(name) || name.empty())
        refuse_line(number,
                    fmt::format("the program is of the template \"{}\", and is read by \"{}\"; required the same",
                                with_escaped_bytes(name), layout_.name));
    } else if (!is_record(text) && layout_.number("x").per_unit == 1.0) {
      constexpr std::string_view kSpeeds = "mm/s";  // of velocities, and no unit of feeds
      std::string rest = text;
      for (std::size_t at = rest.find(kSpeeds); layout_.speeds && at != std::string::npos; at = rest.find(kSpeeds))
        rest.erase(at, kSpeeds.size());
      if (const auto other = find_other_unit(rest, true)) {
        refuse_line(number, fmt::format("{} in the comment \"{}\" looks like another unit than mm; required the "
                                        "template's units, or the comment without one",
                                        in_quotes(with_escaped_bytes(*other)), with_escaped_bytes(comment)));
      }
    }
  }

  /// Takes the lines of a block if they come next; its numbers are then in values_.
  bool take(const TemplateBlock& block) {
    if (block.empty() || block.size() > lines_.size() - at_) return false;
    TemplateValues values;
    for (std::size_t k = 0; k < block.size(); ++k) {
      const auto texts = block[k].match(lines_[at_ + k].text);
      if (!texts || !set(values, block[k].fields(), *texts, lines_[at_ + k].number)) return false;
    }
    first_line_ = lines_[at_].number;
    at_ += block.size();
    values_ = std::move(values);
    return true;
  }

  /// A field that stands in two lines of a block has one value.
  bool set(TemplateValues& values, const std::vector<std::string>& names, const std::vector<std::string_view>& texts,
           long line) const {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto value = finite_number(texts[k]);
      if (!value) return false;
      const double scaled = *value / layout_.number(names[k]).per_unit;
      const bool time = names[k] == "t" || names[k] == "time", count = names[k] == "n";
      const ValueRange range{time ? 0.0 : ranges::kPlace.least, time ? ranges::kTime.most : ranges::kPlace.most,
                             time ? "s" : "mm or mm/s"};
      if (!count && names[k] != "f" && !range.holds(scaled))
        refuse_line(line, fmt::format("{} = {} {}; required {}", names[k], scaled, time ? "s" : "", range.text()));
      const auto [place, is_new] = values.emplace(names[k], scaled);
      if (!is_new && place->second != scaled) return false;
    }
    return true;
  }

  void expect(const TemplateBlock& block, std::string_view name) {
    if (block.empty()) {
      values_.clear();
    } else if (!take(block)) {
      fail(fmt::format("is where the block `{}` must begin", name), block);
    }
  }

  [[noreturn]] void fail(const std::string& place, const TemplateBlock& block) const {
    std::string accepted;
    for (const TemplateLine& line : block)
      accepted += (accepted.empty() ? "; accepted: '" : ", then '") + line.text() + "'";
    if (at_ >= lines_.size())
      throw InputError(
          fmt::format("{}: its end {}{} of the template {} (truncated?)", file_, place, accepted, layout_.file));
    throw InputError(fmt::format("{}, line {}: '{}' {}{} of the template {}", file_, lines_[at_].number,
                                 with_escaped_bytes(lines_[at_].text), place, accepted, layout_.file));
  }

  [[noreturn]] void refuse_line(long number, std::string_view why) const {
    throw InputError(fmt::format("{}, line {}: {}", file_, number, why));
  }

  void check_lifted(std::string_view block) const {
    const auto z = values_.find("z");
    if (z == values_.end() || z->second > 0.0) return;
    refuse_line(first_line_,
                fmt::format("z = {} in the block `{}`; required > 0: the tool is lifted there", z->second, block));
  }

  void travel() {
    const Point to = frame_.to_part({values_.at("x"), values_.at("y")});
    if (!program_.steps.empty()) {
      program_.steps.push_back({place_, to, 0.0, false});
      program_.rapid_length += distance(place_, to);
    }
    place_ = to;
    in_file_ = {values_.at("x"), values_.at("y")};
    speed_ = {};
    time_ = 0.0;
  }

  void read_stretch() {
    std::size_t steps = 0;
    bool started = layout_.start.empty();
    for (;;) {
      poll_.step();
      const std::size_t before = at_;
      if (take(layout_.lift)) {  // first, for its lines may look like a move that takes no time
        at_ = before;
        if (steps == 0) fail("stands where the first move or halt must", layout_.move);
        if (!started) fail("stands where the block `start` must", layout_.start);
        return;
      }
      if (!started && take(layout_.start)) {
        started = true;
      } else if (take(layout_.group_begin) || take(layout_.group_end)) {
        continue;
      } else if (take(layout_.move)) {
        add_move();
        ++steps;
      } else if (take(layout_.halt)) {
        add_halt();
        ++steps;
      } else {
        fail("is no move", layout_.move);
      }
    }
  }

  double coordinate(const char* absolute, const char* relative, double before) const {
    if (const auto found = values_.find(absolute); found != values_.end()) return found->second;
    if (const auto found = values_.find(relative); found != values_.end()) return before + found->second;
    return before;  // of a halt
  }

  double duration(double length) {
    double seconds = 0.0;
    if (const auto t = values_.find("t"); t != values_.end()) {
      seconds = t->second;
      time_ += seconds;
    } else if (const auto time = values_.find("time"); time != values_.end()) {
      seconds = time->second - std::exchange(time_, time->second);
    } else {
      const double feed = units::mm_per_s(values_.at("f"));
      if (!(feed > 0.0)) refuse_line(first_line_, "a feed of 0 or less; required > 0");
      program_.fastest_feed = std::max(program_.fastest_feed, feed);
      seconds = length / feed;
    }
    if (!ranges::kTime.holds(seconds))
      refuse_line(first_line_, fmt::format("a time of {} s; required {}", seconds, ranges::kTime.text()));
    return seconds;
  }

  Point target() const { return {coordinate("x", "dx", in_file_.x), coordinate("y", "dy", in_file_.y)}; }

  void add_halt() {
    if (distance(target(), in_file_) > part_of_a_step())
      refuse_line(first_line_, "a halt at another place than that of the step before; required the same");
    if (speed_ != Point{})
      refuse_line(first_line_, "a halt that is reached at a speed; required velocities of 0 before it");
    check_velocity_of_halt();
    program_.steps.push_back({place_, place_, duration(0.0), true});
  }

  void check_velocity_of_halt() const {
    for (const char* name : {"vx", "vy"}) {
      const auto found = values_.find(name);
      if (found != values_.end() && found->second != 0.0)
        refuse_line(first_line_, fmt::format("a halt with {} = {} mm/s at its end; required 0", name, found->second));
    }
  }

  /// Less than any move that the template can write [mm].
  double part_of_a_step() const { return 0.25 * std::min(layout_.number("x").step(), layout_.number("y").step()); }

  void add_move() {
    const Point in_file = target();
    const bool rests = speed_ == Point{} && (!layout_.speeds || (values_.at("vx") == 0.0 && values_.at("vy") == 0.0));
    if (distance(in_file, in_file_) <= part_of_a_step() && rests && !values_.contains("f")) return add_halt();
    const Point to = frame_.to_part(in_file);
    if (!ranges::kPlace.holds(in_file.x) || !ranges::kPlace.holds(in_file.y))
      refuse_line(first_line_,
                  fmt::format("the place ({}, {}) mm; required {}", in_file.x, in_file.y, ranges::kPlace.text()));
    ProgramStep step{place_, to, duration(distance(in_file_, in_file)), true};
    if (layout_.speeds) {
      const Point out{values_.at("vx"), values_.at("vy")};
      step.speeds = EndSpeeds{std::exchange(speed_, out), out};
      const CubicMove move{step.start, step.finish, step.speeds->in, step.speeds->out, step.seconds};
      program_.fastest_feed = std::max(program_.fastest_feed, length(largest_speed(move)));
    }
    program_.steps.push_back(step);
    place_ = to;
    in_file_ = in_file;
  }

  void check_end() const {
    if (speed_ == Point{}) return;
    refuse_line(first_line_,
                fmt::format("the tool is lifted at a velocity of ({}, {}) mm/s; required 0,0", speed_.x, speed_.y));
  }

  const std::string& file_;
  const ProgramTemplate& layout_;
  Poll poll_;
  std::vector<TemplateTextLine> lines_;
  std::size_t at_ = 0;
  long first_line_ = 0;
  TemplateValues values_;
  Program program_;
  ProgramFrame frame_;
  Point place_, speed_;  // of the part
  Point in_file_;        // the same place in the program's frame
  double time_ = 0.0;
};

}  // namespace

Program read_by_template(std::string_view text, const std::string& file, const ProgramTemplate& layout,
                         const Progress& progress) {
  return TemplateTextReader(text, file, layout, progress).read();
}

}  // namespace dwell
