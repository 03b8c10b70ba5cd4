#include "runs/programs/gcode_remarks.h"

#include <fmt/format.h>

#include <optional>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/utf8_text.h"
#include "core/formats/path_remark.h"
#include "core/map/unit_mention.h"
#include "core/map/value_units.h"
#include "runs/programs/frame_text.h"
#include "runs/programs/recorded_option.h"

namespace dwell {
namespace {

// What our own programs say in "(dwell: ...)" of the height of the tool, which is as any program is read.
constexpr std::string_view kAtWorkAtZero = "tool at work when Z=0";
constexpr std::string_view kLiftedAbove = "lifted when Z>0";

[[noreturn]] void refuse_comment(const GcodePlace& where, const std::string& what) {
  throw InputError(where.text() + ": " + what);
}

/// The unit of a program in millimetres that stands where a word says inches; empty if it says none.
std::string_view millimetres_for(std::string_view unit) {
  const std::string word = lower_case(unit);
  constexpr double kInch = units::kMmPerInch * units::kNmPerMm;
  const auto is_about = [](const std::optional<double>& value, double expected) {
    return value && *value > 0.999999 * expected && *value < 1.000001 * expected;
  };
  if (is_about(known_length_unit(word), kInch)) return "mm";
  if (is_about(known_rate_unit(word), kInch / units::kSecondsPerMinute) || word == "ipm") return "mm/min";
  return {};
}

/// The unit in a comment that is another than mm, mm/min and s, and whether inches were said besides.
struct UnitsSaid {
  std::optional<std::string> other;
  std::string inches;
};

UnitsSaid units_said(std::string_view comment, bool milliseconds) {
  UnitsSaid said;
  std::string text(comment);
  while ((said.other = find_other_unit(text, milliseconds))) {
    const std::string_view own = millimetres_for(*said.other);
    const std::size_t at = text.find(*said.other);
    if (own.empty() || at == std::string::npos) return said;
    if (said.inches.empty()) said.inches = *said.other;
    text.replace(at, said.other->size(), own);
  }
  return said;
}

std::string refused_unit(const std::string& unit, std::string_view comment) {
  return fmt::format(
      "\"{}\" in the comment \"{}\" looks like another unit; accepted: X, Y, Z in mm and F in mm/min, or the comment "
      "without a unit",
      with_escaped_bytes(unit), with_escaped_bytes(trim(comment)));
}

}  // namespace

void GcodeRemarks::take(std::string_view comment, const GcodePlace& where, const Reached& reached) {
  constexpr std::string_view kPrefix = "dwell:", kFrame = "zero=";
  while (comment.starts_with(' ')) comment.remove_prefix(1);
  if (!comment.starts_with(kPrefix)) return check_remark(comment, where, reached);
  comment = trim(comment.substr(kPrefix.size()));
  if (comment.starts_with(kFrame)) return take_frame(comment, where, reached);
  take_entries(comment, where);
}

/// "gcode=g93-seconds, g4=seconds, ..." states what the standard leaves to the controller.
void GcodeRemarks::take_entries(std::string_view entries, const GcodePlace& where) {
  for (const std::string_view field : split(entries, ',')) {
    const std::string_view entry = trim(field);
    if (entry.starts_with("gcode=")) {
      take_dialect(std::string(entry.substr(6)), where);
    } else if (entry.starts_with("g4=")) {
      take_halt_unit(entry, where);
    } else if (entry.find_first_of("=<>") != std::string_view::npos && entry != kAtWorkAtZero &&
               entry != kLiftedAbove) {
      refuse_comment(where, fmt::format("\"{}\" in the comment \"(dwell: ...)\"; accepted: gcode=..., g4=..., {}, {}, "
                                        "or zero=X/Y rotate=DEG swap=yes|no",
                                        entry, kAtWorkAtZero, kLiftedAbove));
    }
  }
}

void GcodeRemarks::take_halt_unit(std::string_view entry, const GcodePlace& where) {
  if (entry != "g4=seconds" && entry != "g4=milliseconds") {
    refuse_comment(where, fmt::format("{}; accepted: g4=seconds, g4=milliseconds", entry));
  }
  const HaltUnit stated = entry == "g4=seconds" ? HaltUnit::Seconds : HaltUnit::Milliseconds;
  if (reading_.halts && *reading_.halts != stated) {
    refuse_comment(where, fmt::format("the program says {}, but P of G4 is to be read as {}; required the same", entry,
                                      to_string(*reading_.halts)));
  }
  reading_.halts = stated;
}

void GcodeRemarks::take_dialect(const std::string& text, const GcodePlace& where) {
  GcodeDialect stated{};
  try {
    stated = parse_gcode_dialect(text);
  } catch (const InputError& error) {
    refuse_comment(where, error.what());
  }
  if (reading_.dialect && *reading_.dialect != stated) {
    refuse_comment(where, fmt::format("the program says gcode={}, but it is to be read as {}; required the same", text,
                                      to_string(*reading_.dialect)));
  }
  reading_.dialect = stated;
}

void GcodeRemarks::take_frame(std::string_view text, const GcodePlace& where, const Reached& reached) {
  if (says_frame_ || reached.placed) {
    refuse_comment(where, fmt::format("\"{}\" is {}; required one, before the first X, Y or Z", text,
                                      says_frame_ ? "a second frame" : "a frame after coordinates"));
  }
  try {
    frame_ = parse_frame(text);
  } catch (const InputError& error) {
    refuse_comment(where, error.what());
  }
  says_frame_ = true;
}

/// A comment that names another unit than the program is read in, or other axes, is not skipped.
void GcodeRemarks::check_remark(std::string_view comment, const GcodePlace& where, const Reached& reached) {
  if (is_record(comment)) return;
  const UnitsSaid said = units_said(comment, reading_.halts == HaltUnit::Milliseconds);
  if (said.other) refuse_comment(where, refused_unit(*said.other, comment));
  if (!said.inches.empty() && !reached.inches) {
    const std::string refusal = refused_unit(said.inches, comment) + ", or G20 for a program in inches";
    if (reached.placed) refuse_comment(where, refusal);
    if (inches_said_.empty()) inches_said_ = where.text() + ": " + refusal;
  }
  if (const auto other = find_other_axes(comment)) {
    refuse_comment(
        where,
        fmt::format("the comment \"{}\" looks like {}; accepted: X, Y as those of the map in mm, or the comment left "
                    "out",
                    with_escaped_bytes(trim(comment)), *other));
  }
}

void GcodeRemarks::check_unit(bool inches) {
  if (!inches && !inches_said_.empty()) throw InputError(inches_said_);
  inches_said_.clear();
}

}  // namespace dwell
