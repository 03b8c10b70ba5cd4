#include "runs/programs/template_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/base/units.h"
#include "core/motion/cubic_move.h"
#include "runs/programs/frame_text.h"
#include "runs/programs/program_comments.h"
#include "runs/programs/pvt_table.h"

namespace dwell {
namespace {

/// A value in whole units of a field's last decimal.
double in_last_decimals(double value, const TemplateNumber& number) {
  const double scaled = value * number.per_unit * std::pow(10.0, number.decimals);
  switch (number.rounding) {
    case TemplateNumber::Rounding::Down:
      return std::floor(scaled);
    case TemplateNumber::Rounding::Up:
      return std::ceil(scaled);
    case TemplateNumber::Rounding::Nearest:
      break;
  }
  return std::round(scaled);
}

std::string text_of_last_decimals(double last_decimals, int decimals) {
  std::string text = fmt::format("{:.{}f}", last_decimals / std::pow(10.0, decimals), decimals);
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

/// Whether any line of a block has a field.
bool block_says(const TemplateBlock& block, std::string_view field) {
  for (const TemplateLine& line : block) {
    for (const std::string& name : line.fields()) {
      if (name == field) return true;
    }
  }
  return false;
}

class TemplateTextWriter {
 public:
  TemplateTextWriter(const ProgramTemplate& layout, const TemplateWriting& writing)
      : layout_(layout), writing_(writing), says_feeds_(block_says(layout.move, "f")) {
    if (!(writing.max_feed_mm_per_min > 0.0) || !std::isfinite(writing.max_feed_mm_per_min))
      throw InputError(fmt::format("maximum feed = {} mm/min; required finite and > 0", writing.max_feed_mm_per_min));
  }

  std::string write(const Program& program, const Progress& progress) {
    frame_ = program.frame;
    values_["z"] = writing_.lift_height_mm;
    set_place(program.steps.empty() ? Point{} : program.steps.front().start);
    check_lift_height();
    numbered_ = false;
    add(layout_.header);
    for (const std::string& comment : writing_.comments) add_comment(comment);
    add_comment("dwell: template=" + layout_.name);
    if (!frame_.is_of_part()) add_comment("dwell: " + frame_text(frame_));
    numbered_ = true;
    add(layout_.begin);
    Poll poll(progress);
    for (std::size_t i = 0; i < program.steps.size(); ++i) {
      poll.step();
      const ProgramStep& step = program.steps[i];
      if (i > 0 && !(distance(program.steps[i - 1].finish, step.start) <= 1e-9))
        throw std::logic_error(fmt::format("program step {} does not start where step {} ends", i + 1, i));
      if (step.removes) {
        if (!down_) come_down(step.start);
        write_step(step, i + 1);
      } else {
        lift();
      }
    }
    lift();
    numbered_ = false;
    add(layout_.footer);
    return std::move(text_);
  }

 private:
  void check_lift_height() const {
    for (const TemplateBlock* block : {&layout_.begin, &layout_.travel, &layout_.lift}) {
      if (!block_says(*block, "z") || in_last_decimals(writing_.lift_height_mm, layout_.number("z")) > 0.0) continue;
      throw InputError(
          fmt::format("`lift height` = {} mm: is 0 in the decimals of numbers.z of the template {}; required "
                      "more",
                      writing_.lift_height_mm, layout_.file));
    }
  }

  void set_place(Point of_part) {
    const Point place = frame_.to_program(of_part);
    values_["x"] = place.x, values_["y"] = place.y;
  }

  void come_down(Point at) {
    set_place(at);
    add(layout_.travel);
    add(layout_.lower);
    down_ = true;
    at_ = frame_.to_program(at);
    time_ = 0.0;
    in_group_ = 0;
    in_stretch_ = 0;
  }

  void lift() {
    if (!down_) return;
    end_group();
    if (layout_.start_after && in_stretch_ < *layout_.start_after) add(layout_.start);
    add(layout_.lift);
    down_ = false;
  }

  void begin_group() {
    if (layout_.every && in_group_ == 0) add(layout_.group_begin);
    ++in_group_;
  }

  void end_group() {
    if (layout_.every && in_group_ > 0) add(layout_.group_end);
    in_group_ = 0;
  }

  void check_kind(const ProgramStep& step) const {
    if (!(step.length() > 0.0) || step.speeds.has_value() == layout_.speeds) return;
    throw InputError(layout_.speeds
                         ? fmt::format("{}: its moves say velocities, and this program has feeds alone; required "
                                       "a `machine`, whose motion is then written",
                                       layout_.file)
                         : fmt::format("{}: its moves say no velocities, and this plan has a schedule of speeds; "
                                       "required `schedule` = constant",
                                       layout_.file));
  }

  Point rounded(Point place) const {
    const TemplateNumber x = layout_.number(block_says(layout_.move, "x") ? "x" : "dx"),
                         y = layout_.number(block_says(layout_.move, "y") ? "y" : "dy");
    return {in_last_decimals(place.x, x) * x.step(), in_last_decimals(place.y, y) * y.step()};
  }

  void write_step(const ProgramStep& step, std::size_t number) {
    check_kind(step);
    const Point to = frame_.to_program(step.finish);
    const double length = distance(rounded(at_), rounded(to));
    const bool moves = layout_.speeds ? step.length() > 0.0 : length > 0.0;
    const TemplateBlock& block = moves ? layout_.move : layout_.halt;
    if (block.empty())
      throw InputError(fmt::format("{}: has no block `halt`, and step {} of the program is one", layout_.file, number));
    const double before = time_;
    if (!moves || !says_feeds_) time_ += step.seconds;
    const TemplateNumber time = layout_.number(block_says(block, "time") ? "time" : "t");
    if (!moves && in_last_decimals(time_, time) == in_last_decimals(before, time)) {
      at_ = to;
      return;
    }
    values_["n"] = static_cast<double>(++number_);
    begin_group();
    const Point velocity = step.speeds ? step.speeds->out : Point{};
    values_["x"] = to.x, values_["y"] = to.y;
    values_["vx"] = velocity.x, values_["vy"] = velocity.y;
    const double max_feed = writing_.max_feed_mm_per_min;
    values_["f"] = moves ? std::min(units::mm_per_min(length / step.seconds), max_feed) : max_feed;
    differences_["dx"] = {at_.x, to.x};
    differences_["dy"] = {at_.y, to.y};
    differences_["t"] = {before, time_};
    values_["time"] = time_;
    at_ = to;
    add(block);
    if (layout_.every && in_group_ == *layout_.every) end_group();
    if (layout_.start_after && ++in_stretch_ == *layout_.start_after) add(layout_.start);
  }

  std::string feed_text() const {
    const TemplateNumber number = layout_.number("f");
    const double scale = number.per_unit * std::pow(10.0, number.decimals);
    const double most = std::floor(writing_.max_feed_mm_per_min * scale * (1.0 + 1e-12));
    const double feed = std::min(in_last_decimals(values_.at("f"), number), most);
    if (!(feed > 0.0)) {
      throw InputError(fmt::format("{}: a feed of {:.6g} mm/min is 0 in the {} decimals of numbers.f; required more",
                                   layout_.file, values_.at("f"), number.decimals));
    }
    return text_of_last_decimals(feed, number.decimals);
  }

  std::string field_text(const std::string& field) const {
    if (field == "f") return feed_text();
    const TemplateNumber number = layout_.number(field);
    if (const auto change = differences_.find(field); change != differences_.end()) {
      const auto [from, to] = change->second;
      return text_of_last_decimals(in_last_decimals(to, number) - in_last_decimals(from, number), number.decimals);
    }
    return text_of_last_decimals(in_last_decimals(values_.at(field), number), number.decimals);
  }

  void add(const TemplateBlock& block) {
    for (const TemplateLine& line : block) {
      std::vector<std::string> texts;
      for (const std::string& field : line.fields()) texts.push_back(field_text(field));
      add_line(line.fill(texts));
    }
  }

  void add_line(std::string line) {
    if (numbered_ && layout_.block_numbers) {
      block_number_ += layout_.block_numbers->step;
      if (block_number_ > layout_.block_numbers->last) block_number_ = layout_.block_numbers->step;
      line.insert(0, fmt::format("N{} ", block_number_));
    }
    if (line.size() > static_cast<std::size_t>(layout_.longest_line)) {
      throw InputError(fmt::format("{}: the line '{}' has {} characters; the template allows {}", layout_.file, line,
                                   line.size(), layout_.longest_line));
    }
    if (layout_.most_lines && ++lines_ > *layout_.most_lines) {
      throw InputError(
          fmt::format("{}: the program has more than the {} lines that the template allows (most_lines); "
                      "required a coarser path, or a plan of a part of the map",
                      layout_.file, *layout_.most_lines));
    }
    text_ += line + layout_.line_end;
  }

  /// Comments hold only what every controller reads, and not what would end them.
  void add_comment(const std::string& comment) {
    std::string text = comment_text(comment);
    const auto longest = static_cast<std::size_t>(layout_.longest_line);
    const std::size_t around = layout_.comment_begin.size() + layout_.comment_end.size();
    if (around >= longest) return;
    text.resize(std::min(text.size(), longest - around));
    for (char& c : text) {
      if (layout_.comment_end.find(c) != std::string::npos && c != ' ') c = '?';
      if (layout_.upper_case && c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    add_line(layout_.comment_begin + text + layout_.comment_end);
  }

  const ProgramTemplate& layout_;
  const TemplateWriting& writing_;
  bool says_feeds_;
  ProgramFrame frame_;
  std::string text_;
  std::map<std::string, double> values_;
  std::map<std::string, std::pair<double, double>> differences_;
  Point at_;           // in the program's frame
  double time_ = 0.0;  // since the tool came down, of feeds that of halts alone [s]
  int in_group_ = 0, in_stretch_ = 0, block_number_ = 0, lines_ = 0;
  std::size_t number_ = 0;
  bool down_ = false, numbered_ = false;
};

/// A table whose times are whole steps of a grid.
PvtTable table_in_steps_of(double step, const PvtTable& table) {
  PvtTable moved = table;
  std::int64_t last = -1;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const PvtRow& row = table.rows[i];
    const std::int64_t ticks = std::max<std::int64_t>(last + 1, std::llround(row.seconds / step));
    const double seconds = static_cast<double>(ticks) * step;
    last = ticks;
    moved.rows[i].seconds = seconds;
    const bool rests = row.speed == Point{};
    if (rests || i == 0 || i + 1 == table.rows.size()) continue;
    const PvtRow &from = table.rows[seconds < row.seconds ? i - 1 : i],
                 &to = table.rows[seconds < row.seconds ? i : i + 1];
    const CubicMove move{from.place, to.place, from.speed, to.speed, to.seconds - from.seconds};
    const double at = std::clamp(seconds - from.seconds, 0.0, move.seconds);
    moved.rows[i].place = move.place(at);
    moved.rows[i].speed = move.speed(at);
  }
  return moved;
}

}  // namespace

std::string text_by_template(const Program& program, const ProgramTemplate& layout, const TemplateWriting& writing,
                             const Progress& progress) {
  return TemplateTextWriter(layout, writing).write(program, progress);
}

Program motion_for_template(const Program& motion, const ProgramTemplate& layout, const Progress& progress) {
  constexpr double kTableStep = 1e-9;  // [s] of the table's times
  PvtTable table = pvt_table_of(motion, progress);
  const double step = layout.number(block_says(layout.move, "time") ? "time" : "t").step();
  if (layout.longest_step) table = with_steps_of_at_most(*layout.longest_step, table);
  if (step > 1.5 * kTableStep) table = table_in_steps_of(step, table);
  return program_of(table, "");
}

}  // namespace dwell
