#include "runs/programs/pmac_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "core/base/counted.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/utf8_text.h"
#include "runs/programs/axis_words.h"
#include "runs/programs/number_text.h"
#include "runs/programs/pvt_place.h"

namespace dwell {
namespace {

constexpr double kMilli = 1e-3;
constexpr double kWrittenStep = 4.095;                           // [s]
constexpr ValueRange kPmacTimes{1.0 / 4096.0, 4095.9998, "ms"};  // of PVT
constexpr ValueRange kPmacTimeUnits{1e-3, 1e9, "ms"};            // of Isx90
constexpr std::string_view kPmacWords = "ABS, INC, PVT<ms>, X<mm>:<velocity> Y<mm>:<velocity>, OPEN PROG, CLEAR, CLOSE";

/// A line in upper case up to its comment, and the comment.
struct PmacLine {
  std::string code;
  std::optional<std::string_view> comment;
};

PmacLine pmac_line(std::string_view line) {
  const std::size_t at = std::min(line.find(';'), line.find("//"));
  PmacLine result;
  for (const char c : trim(line.substr(0, at))) result.code += c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  if (at != std::string_view::npos) result.comment = trim(line.substr(at).substr(line[at] == ';' ? 1 : 2));
  return result;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_pvt_word(std::string_view code) {
  return code.starts_with("PVT") && code.size() > 3 && (is_digit(code[3]) || code[3] == '.' || code[3] == ' ');
}

/// The number that ends where the next word begins; `rest` goes on behind it.
std::string_view take_number(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
  const std::size_t end = std::min(rest.find_first_not_of("0123456789.+-"), rest.size());
  const std::string_view number = rest.substr(0, end);
  rest.remove_prefix(end);
  return number;
}

class PmacReader {
 public:
  PmacReader(std::string_view text, const std::string& file, std::optional<Point> start, const Progress& progress,
             AxisLetters letters)
      : lines_(text), letters_(letters), start_(start), ends_with_line_(text.ends_with('\n')), poll_(progress) {
    at_.file = file;
  }

  PvtTable read() {
    while (lines_.next()) {
      poll_.step();
      at_.number = lines_.number();
      const PmacLine line = pmac_line(lines_.line());
      if (line.comment) read_comment(*line.comment);
      read_code(line.code);
    }
    at_.number = 0;
    check_end();
    return std::move(table_);
  }

 private:
  void check_end() {
    at_.check_end(table_);
    const auto steps = static_cast<double>(table_.rows.size() - 1);
    if (steps_ && (*steps_ != steps || !ends_with_line_)) {
      at_.fail(
          fmt::format("{}, but its comment says steps: {}; required the same, and the end of the last line "
                      "(truncated or edited?)",
                      counted(table_.rows.size() - 1, "step"), *steps_));
    }
  }

  void read_comment(std::string_view comment) {
    constexpr std::string_view kStart = "start:", kUnits = "units:", kSteps = "steps:";
    if (comment.starts_with(kStart)) {
      const auto stated = stated_start(comment.substr(kStart.size()));
      if (!stated) at_.fail(fmt::format("\"{}\"; required start: X<mm> Y<mm>", with_escaped_bytes(comment)));
      take_start(*stated);
    } else if (comment.starts_with(kSteps)) {
      steps_ = at_.within("steps", comment.substr(kSteps.size()), {1.0, 1e12, ""});
    } else if (const auto unit = time_unit_of(comment)) {
      take_time_unit(*unit);
    } else if (!comment.starts_with(kUnits) || trim(comment.substr(kUnits.size())) != kPvtUnits) {
      at_.check_comment(comment);
    }
  }

  void take_start(Point stated) {
    if (!table_.rows.empty()) at_.fail("start stands after the first step; required before");
    if (start_ && distance(*start_, stated) > 1e-6) {
      at_.fail(
          fmt::format("start is {}, but was said to be {}; required one", start_text(stated), start_text(*start_)));
    }
    start_ = stated;
  }

  /// The number of "Isx90 = 1000", or of "I5190=1000" of a coordinate system.
  std::optional<double> time_unit_of(std::string_view text) const {
    const std::string upper = lower_case(text);
    std::string_view rest = upper;
    if (!rest.starts_with('i')) return std::nullopt;
    const std::size_t equals = rest.find('=');
    const std::string_view name = trim(rest.substr(0, equals));
    const bool numbered = name.size() == 5 && name.ends_with("90") && is_digit(name[1]) && is_digit(name[2]);
    if (equals == std::string_view::npos || !(name == "isx90" || numbered)) return std::nullopt;
    rest = trim(rest.substr(equals + 1));
    const std::string_view number = take_number(rest);
    if (!trim(rest).empty()) return std::nullopt;
    return at_.within("Isx90", number, kPmacTimeUnits);
  }

  void take_time_unit(double unit) {
    if (time_unit_ && *time_unit_ != unit) {
      at_.fail(fmt::format("Isx90 = {}, but was {} before; required one throughout", unit, *time_unit_));
    }
    time_unit_ = unit;
  }

  void read_code(std::string_view code) {
    while (!code.empty()) {
      if (const auto unit = time_unit_of(code)) return take_time_unit(*unit);
      if (take_word(code, "ABS")) {
        incremental_ = false;
      } else if (take_word(code, "INC")) {
        incremental_ = true;
      } else if (take_word(code, "CLEAR") || take_word(code, "CLOSE")) {
        // of the buffer that holds the program
      } else if (take_word(code, "OPEN PROG")) {
        take_number(code);
      } else if (is_pvt_word(code)) {
        code.remove_prefix(3);
        milliseconds_ = at_.within("PVT", take_number(code), kPmacTimes);
      } else if (is_axis(code.front())) {
        return read_step(code);
      } else if (const std::string why = why_no_axis(code.front(), letters_); !why.empty()) {
        at_.fail(why);
      } else {
        at_.fail(fmt::format("\"{}\" is not known or not honoured; accepted: {}",
                             with_escaped_bytes(code.substr(0, 40)), kPmacWords));
      }
      code = trim(code);
    }
  }

  bool is_axis(char letter) const { return letter == letters_.x || letter == letters_.y; }

  /// Whether the code begins with a word that ends there.
  static bool take_word(std::string_view& code, std::string_view word) {
    const bool is = code.starts_with(word) && (code.size() == word.size() || code[word.size()] == ' ');
    if (is) code.remove_prefix(word.size());
    return is;
  }

  void read_step(std::string_view code) {
    if (!incremental_) at_.fail("a step before ABS or INC; required one of them, since which of the two holds is open");
    if (!milliseconds_) at_.fail("a step before PVT; required PVT<ms> before the first");
    if (!time_unit_) {
      at_.fail(
          "a step where no Isx90 says for how many ms a velocity counts; required \"Isx90 = 1000\" before, in a "
          "comment or not");
    }
    if (table_.rows.empty()) begin();
    std::optional<double> places[2], speeds[2];
    while (!code.empty()) {
      const char axis = code.front();
      const std::size_t k = axis == letters_.y ? 1 : 0;
      if (const std::string why = why_no_axis(axis, letters_); !why.empty()) at_.fail(why);
      if (!is_axis(axis))
        at_.fail(fmt::format("\"{}\"; accepted: {}", with_escaped_bytes(code.substr(0, 40)), kPmacWords));
      if (places[k]) at_.fail(fmt::format("a second {} on a line; accepted: one", axis));
      code.remove_prefix(1);
      const std::string name(1, axis);
      places[k] = at_.place(name, take_number(code));
      code = trim(code);
      speeds[k] = 0.0;
      if (code.starts_with(':')) {
        code.remove_prefix(1);
        speeds[k] = at_.speed("velocity of " + name, take_number(code));
      }
      code = trim(code);
    }
    if (!places[0] || !places[1])
      at_.fail(fmt::format("a step without {} or {}; required both", letters_.x, letters_.y));
    add(Point{*places[0], *places[1]}, (1.0 / (kMilli * *time_unit_)) * Point{*speeds[0], *speeds[1]});
  }

  void begin() {
    if (!start_) {
      at_.fail(
          "the program does not say where it begins; required the comment \"start: X<mm> Y<mm>\" before, or `start` "
          "X,Y in mm");
    }
    table_.rows.push_back({0.0, *start_, {}, true});
  }

  void add(Point place, Point speed) {
    const PvtRow& last = table_.rows.back();
    const PvtRow row{last.seconds + kMilli * *milliseconds_, *incremental_ ? last.place + place : place, speed, false};
    at_.check_within("x", row.place.x, ranges::kPlace);
    at_.check_within("y", row.place.y, ranges::kPlace);
    at_.check_within("velocity of X", speed.x, kPvtSpeeds);
    at_.check_within("velocity of Y", speed.y, kPvtSpeeds);
    at_.check_within("the time from the beginning", row.seconds, ranges::kTime);
    at_.add(table_, row);
  }

  TextLines lines_;
  AxisLetters letters_;
  std::optional<Point> start_;
  bool ends_with_line_;
  Poll poll_;
  PvtPlace at_;
  PvtTable table_;
  std::optional<bool> incremental_;
  std::optional<double> milliseconds_, time_unit_, steps_;
};

}  // namespace

std::string pmac_program_text(const PvtTable& table, std::size_t first, std::size_t last, const FeedTable& made,
                              AxisLetters letters) {
  PvtTable stretch;
  const auto begin = table.rows.begin();
  stretch.rows.assign(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last) + 1);
  stretch = with_steps_of_at_most(kWrittenStep, stretch);
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "; dwell {}\n; units: {}\n; Isx90 = 1000\n; steps: {}\n; start: {}\nABS\n", made.version,
                 kPvtUnits, stretch.rows.size() - 1, start_text(stretch.rows.front().place));
  std::string time;
  for (std::size_t i = 1; i < stretch.rows.size(); ++i) {
    const PvtRow& row = stretch.rows[i];
    // To 1e-6 ms, of which the controller makes the nearest 1/4096 ms.
    std::string now = coordinate_text((row.seconds - stretch.rows[i - 1].seconds) / kMilli);
    if (now != time) fmt::format_to(out, "PVT{}\n", now);
    time = std::move(now);
    fmt::format_to(out, "{}{}:{} {}{}:{}\n", letters.x, coordinate_text(row.place.x), coordinate_text(row.speed.x),
                   letters.y, coordinate_text(row.place.y), coordinate_text(row.speed.y));
  }
  return fmt::to_string(text);
}

bool is_pmac_program(std::string_view text) {
  for (TextLines lines(text); lines.next();) {
    const PmacLine line = pmac_line(lines.line());
    if (line.code.find("PVT") != std::string::npos && !line.code.starts_with('(')) {
      for (std::string_view rest = line.code; !rest.empty(); rest.remove_prefix(1)) {
        if (is_pvt_word(rest)) return true;
      }
    }
    const bool opens = line.code.empty() || line.code.starts_with("ABS") || line.code.starts_with("INC") ||
                       line.code.starts_with("OPEN PROG") || line.code.starts_with("CLEAR") ||
                       line.code.starts_with("CLOSE") || line.code.starts_with("I");
    if (!opens) return false;
  }
  return false;
}

PvtTable parse_pmac_program(std::string_view text, const std::string& file, std::optional<Point> start,
                            const Progress& progress, AxisLetters letters) {
  return PmacReader(text, file, start, progress, letters).read();
}

}  // namespace dwell
