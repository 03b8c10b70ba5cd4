#include "runs/programs/speed_gcode_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/utf8_text.h"
#include "core/base/value_range.h"
#include "runs/programs/gcode_words.h"
#include "runs/programs/number_text.h"

namespace dwell {
namespace {

constexpr std::string_view kRestComment = "from rest at ";
constexpr std::string_view kAccelerationUnit = " mm/s^2";
constexpr ValueRange kAccelerations{1e-6, 1e9, "mm/s^2"};

bool is_letter_of_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_part_of_number(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; }
bool is_space_in_line(char c) { return c == ' ' || c == '\t' || c == '\r'; }
char in_upper_case(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// In upper case, without blanks.
std::string bare(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (!is_space_in_line(c)) result += in_upper_case(c);
  }
  return result;
}

/// A part of a line: a comment with its signs, a word (a letter and its number), letters alone, or the rest from # on.
struct LinePart {
  enum class Kind { Comment, Word, Letters, Command, Other };
  Kind kind = Kind::Other;
  std::string_view text;
  char letter = ' ';          // of a word, upper case
  std::string_view number{};  // of a word
};

/// Walks the parts of a line.
class LineParts {
 public:
  explicit LineParts(std::string_view line) : line_(line) {}

  bool next() {
    if (at_ >= line_.size()) return false;
    const std::size_t start = at_;
    part_ = {};
    const char c = line_[at_];
    if (c == ';' || c == '(') {
      const std::size_t close = c == ';' ? std::string_view::npos : line_.find(')', at_);
      at_ = close == std::string_view::npos ? line_.size() : close + 1;
      part_.kind = LinePart::Kind::Comment;
    } else if (c == '#') {
      at_ = std::min(line_.find_first_of(";(", at_), line_.size());
      part_.kind = LinePart::Kind::Command;
    } else if (is_letter_of_word(c)) {
      take_word(start);
    } else {
      ++at_;
    }
    part_.text = line_.substr(start, at_ - start);
    return true;
  }

  const LinePart& part() const { return part_; }

 private:
  void take_word(std::size_t start) {
    while (at_ < line_.size() && is_letter_of_word(line_[at_])) ++at_;
    if (at_ - start > 1) {
      part_.kind = LinePart::Kind::Letters;
      return;
    }
    part_.letter = in_upper_case(line_[start]);
    std::size_t number = at_;
    while (number < line_.size() && is_space_in_line(line_[number])) ++number;
    std::size_t end = number;
    while (end < line_.size() && is_part_of_number(line_[end])) ++end;
    if (end == number) {
      part_.kind = LinePart::Kind::Letters;
      return;
    }
    part_.kind = LinePart::Kind::Word;
    part_.number = line_.substr(number, end - number);
    at_ = end;
  }

  std::string_view line_;
  std::size_t at_ = 0;
  LinePart part_;
};

/// The text of a comment without its signs.
std::string_view text_of_comment(std::string_view part) {
  part.remove_prefix(1);
  if (part.ends_with(')')) part.remove_suffix(1);
  return trim(part);
}

/// The dialect that our comment "dwell: gcode=WORD, ..." says; empty if it says none.
std::string_view stated_dialect(std::string_view comment) {
  constexpr std::string_view kOurs = "dwell:", kKey = "gcode=";
  if (!comment.starts_with(kOurs)) return {};
  comment = trim(comment.substr(kOurs.size()));
  return comment.starts_with(kKey) ? trim(comment.substr(kKey.size(), comment.find(',') - kKey.size()))
                                   : std::string_view{};
}

/// Why a G code of plain G-code is none of a dialect's controllers; empty if it is, or if none knows it.
std::string_view why_refused(SpeedDialect dialect, double code) {
  const auto is = [code](double number) { return std::abs(code - number) < 1e-9; };
  if (dialect == SpeedDialect::G293) {
    if (is(20) || is(21)) return "switches mirroring on these controllers; required G71 for millimetres";
    if (is(70)) return "inches, whose feeds are not known to be in inches, are not accepted; required G71";
    if (is(9)) return "changes where the feed of the next block is reached, and stands in no block with G293";
    if (is(61) || is(61.1) || is(64)) return "rounds corners by polynomials on these controllers, or is unknown there";
    if (is(193)) return "the feed linear over the path is not honoured; required G293";
    return {};
  }
  if (is(20) || is(21)) return "is no word of this controller; required G710";
  if (is(60)) return "stops at the end of every block, where no feed of FLIN is reached; required G64";
  if (is(61) || is(61.1)) return "is no word of this controller; required G64";
  return {};
}

class PlainText {
 public:
  PlainText(const std::string& file, SpeedDialect dialect, AxisLetters letters)
      : file_(file), dialect_(dialect), letters_(letters) {}

  SpeedText read(std::string_view text, const Progress& progress) {
    Poll poll(progress);
    text = without_byte_order_mark(text);
    while (!text.empty()) {
      poll.step();
      const std::size_t newline = text.find('\n');
      take_line(text.substr(0, newline));
      text.remove_prefix(newline == std::string_view::npos ? text.size() : newline + 1);
      if (newline != std::string_view::npos) result_.plain += '\n';
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(GcodePlace{file_, result_.lines.size()}.text() + ": " + what);
  }

  void take_line(std::string_view line) {
    result_.lines.emplace_back();
    halts_ = false;
    LineParts parts(line);
    while (parts.next()) {
      switch (parts.part().kind) {
        case LinePart::Kind::Comment:
          take_comment(parts.part().text);
          break;
        case LinePart::Kind::Command:
          take_command(parts.part().text);
          break;
        case LinePart::Kind::Letters:
          take_letters(parts.part().text);
          break;
        case LinePart::Kind::Word:
          take_word(parts.part());
          break;
        case LinePart::Kind::Other:
          result_.plain += parts.part().text;
          break;
      }
    }
    if (dialect_ == SpeedDialect::Flin) result_.lines.back().ramps = linear_;
  }

  void take_comment(std::string_view part) {
    if (dialect_ == SpeedDialect::Flin && part.front() == '(') {
      fail(fmt::format("\"{}\": comments stand behind ; on this controller, and parentheses are none",
                       with_escaped_bytes(part)));
    }
    const std::string_view comment = text_of_comment(part), word = stated_dialect(comment);
    if (!word.empty() && word != to_string(dialect_)) {
      fail(fmt::format("the program says gcode={}, and has words of {}; required the same", with_escaped_bytes(word),
                       to_string(dialect_)));
    }
    if (!word.empty()) {  // what follows is for the reader of plain G-code
      const std::size_t at = static_cast<std::size_t>(word.data() - part.data()) + word.size();
      result_.plain += part.front();
      result_.plain += "dwell: ";
      result_.plain += part.substr(at);
      return;
    }
    constexpr std::string_view kOurs = "dwell:";
    const std::string_view rest = comment.starts_with(kOurs) ? trim(comment.substr(kOurs.size())) : "";
    if (dialect_ == SpeedDialect::Flin && rest.starts_with(kRestComment)) {
      if (result_.from_rest.are_said()) fail("a second comment of the accelerations from rest; accepted: one");
      take_accelerations(rest.substr(kRestComment.size()));
    }
    result_.plain += part;
  }

  void take_accelerations(std::string_view text) {
    const std::string_view whole = text;
    if (text.ends_with(kAccelerationUnit)) {
      text.remove_suffix(kAccelerationUnit.size());
    } else {
      text = {};
    }
    for (std::string_view field : split(text, ',')) {
      field = trim(field);
      const std::size_t blank = field.find(' ');
      const std::string_view name = field.substr(0, blank);
      double* slot = name == "x"      ? &result_.from_rest.x
                     : name == "y"    ? &result_.from_rest.y
                     : name == "path" ? &result_.from_rest.path
                                      : nullptr;
      std::optional<double> value;
      if (slot != nullptr && blank != std::string_view::npos) value = finite_number(field.substr(blank));
      if (!value || !kAccelerations.holds(*value) || std::isfinite(*slot)) {
        fail(fmt::format(
            "\"{}\" in the comment \"dwell: {}...\"; accepted: x, y or path, each once, with {} after it, as x 450, "
            "path 500{}",
            with_escaped_bytes(whole), kRestComment, kAccelerations.text(), kAccelerationUnit));
      }
      *slot = *value;
    }
  }

  void take_command(std::string_view text) {
    constexpr std::string_view kSlope = "#SLOPE", kTime = "#TIME";
    const std::string command = bare(text);
    const bool knows_it = dialect_ == SpeedDialect::G293;
    if (knows_it && command.starts_with(kSlope)) {
      if (command != "#SLOPE[TYPE=STEP]") {
        fail(
            fmt::format("\"{}\"; accepted: #SLOPE [TYPE=STEP], with which G293 works", with_escaped_bytes(trim(text))));
      }
      prepared_ = true;
    } else if (knows_it && command.starts_with(kTime)) {
      result_.plain += "G4 P";
      result_.plain += trim(text).substr(kTime.size());
    } else {
      result_.plain += text;
    }
  }

  void take_letters(std::string_view text) {
    const std::string word = bare(text);
    const bool knows_it = dialect_ == SpeedDialect::Flin;
    if (knows_it && word == "FLIN") {
      if (!uncompressed_)
        fail("FLIN: a group of blocks that is compressed takes its last F alone; required COMPOF before");
      if (!prepared_) fail("FLIN: with exact stops at the end of blocks no feed is reached there; required G64 before");
      linear_ = true;
    } else if (knows_it && word == "FNORM") {
      linear_ = false;
    } else if (knows_it && word == "COMPOF") {
      uncompressed_ = true;
    } else {
      result_.plain += text;
    }
  }

  void take_word(const LinePart& part) {
    const auto value = finite_number(part.number);
    if (part.letter == 'G' && value) return take_code(part, *value);
    if (part.letter == 'P') {
      fail(fmt::format("\"{}\": P is a parameter on this controller, and no time; required {}",
                       with_escaped_bytes(part.text), dialect_ == SpeedDialect::G293 ? "#TIME SECONDS" : "G4 F"));
    }
    const char time = dialect_ == SpeedDialect::G293 ? letters_.x : 'F';
    if (halts_ && part.letter == time) {
      result_.plain += 'P';
      result_.plain += part.number;
      return;
    }
    result_.plain += part.text;
  }

  void take_code(const LinePart& part, double code) {
    constexpr double kDwell = 4, kExactStop = 9, kExactStopOfIsg = 60, kContinuous = 64, kLinear = 293;
    const bool isg = dialect_ == SpeedDialect::G293;
    if (isg && code == kLinear) {
      if (!prepared_) fail("G293 before #SLOPE [TYPE=STEP], with which alone it works; required that before");
      result_.lines.back().ramps = true;
    } else if (code == (isg ? kExactStopOfIsg : kExactStop)) {
      result_.lines.back().stops = true;
    } else if (!isg && code == kContinuous) {
      prepared_ = true;
    } else if (const std::string_view why = why_refused(dialect_, code); !why.empty()) {
      fail(fmt::format("\"{}\": {}", with_escaped_bytes(part.text), why));
    } else {
      halts_ = halts_ || code == kDwell;
      result_.plain += part.text;
    }
  }

  const std::string& file_;
  SpeedDialect dialect_;
  AxisLetters letters_;
  SpeedText result_;
  bool prepared_ = false;      // by #SLOPE, or G64
  bool uncompressed_ = false;  // by COMPOF
  bool linear_ = false;        // FLIN is in force
  bool halts_ = false;         // G4 on the line
};

/// Whether a text holds letters, in any case.
bool holds(std::string_view text, std::string_view letters) {
  return std::search(text.begin(), text.end(), letters.begin(), letters.end(),
                     [](char a, char b) { return in_upper_case(a) == b; }) != text.end();
}

bool says_dialect(std::string_view line, SpeedDialect dialect) {
  LineParts parts(line);
  while (parts.next()) {
    const LinePart& part = parts.part();
    if (part.kind == LinePart::Kind::Comment && stated_dialect(text_of_comment(part.text)) == to_string(dialect))
      return true;
    if (dialect == SpeedDialect::Flin) {
      if (part.kind == LinePart::Kind::Letters && bare(part.text) == "FLIN") return true;
      continue;
    }
    if (part.kind == LinePart::Kind::Word && part.letter == 'G' && finite_number(part.number) == 293.0) return true;
    if (part.kind == LinePart::Kind::Command && bare(part.text).starts_with("#SLOPE")) return true;
  }
  return false;
}

}  // namespace

std::string_view to_string(SpeedDialect dialect) { return dialect == SpeedDialect::G293 ? "g293" : "flin"; }

bool is_speed_gcode(std::string_view text, SpeedDialect dialect) {
  if (text.empty() || (text.front() == '#' && !bare(text.substr(0, 16)).starts_with("#SLOPE"))) return false;
  if (!is_letter_of_word(text.front()) && std::string_view("%(;#").find(text.front()) == std::string_view::npos)
    return false;
  const bool may_be = dialect == SpeedDialect::Flin ? holds(text, "FLIN") : holds(text, "293") || holds(text, "SLOPE");
  if (!may_be) return false;
  for (TextLines lines(text); lines.next();) {
    if (says_dialect(lines.line(), dialect)) return true;
  }
  return false;
}

SpeedText plain_gcode_of(std::string_view text, const std::string& file, SpeedDialect dialect, AxisLetters letters,
                         const Progress& progress) {
  return PlainText(file, dialect, letters).read(text, progress);
}

std::string rest_accelerations_text(const RestAccelerations& accelerations) {
  std::string text;
  const auto add = [&text](const char* name, double value) {
    if (std::isfinite(value)) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, digits_not_above(value));
  };
  add("x", accelerations.x);
  add("y", accelerations.y);
  add("path", accelerations.path);
  return fmt::format("{}{}{}", kRestComment, text, kAccelerationUnit);
}

}  // namespace dwell
