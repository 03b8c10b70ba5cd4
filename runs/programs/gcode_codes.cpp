#include "runs/programs/gcode_codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace dwell {
namespace {

using Effect = GcodeEffect;

constexpr std::string_view kInches =
    "inches, whose feeds are in inches on some controllers only, are not accepted; required G20 or G21";
constexpr std::string_view kPlane = "another plane than XY is not accepted; required G17";
constexpr std::string_view kArc = "an arc is not honoured; required straight moves (G1)";
constexpr std::string_view kSpline = "a spline, or look-ahead that rounds the path, is not honoured";
constexpr std::string_view kRadius = "offset by the tool's radius, which is not honoured; required G40";
constexpr std::string_view kLength = "offset by the tool's length, which is not honoured; required G49";
constexpr std::string_view kOrigin = "moves the origin, which is not honoured";
constexpr std::string_view kHome = "goes by way of a reference point that the program does not say";
constexpr std::string_view kMachine = "machine coordinates, of which the part's place is not known, are not honoured";
constexpr std::string_view kMacro = "a macro or subprogram is not followed; required all moves in one program";
constexpr std::string_view kCycle = "a canned cycle is not honoured; required its moves (G0, G1)";
constexpr std::string_view kDiameter = "diameters for X, or look-ahead, are not honoured";
constexpr std::string_view kProbe = "a probing move is not honoured";

// In the order of their numbers.
constexpr GcodeCode kCodes[] = {
    {'G', 0, Effect::Motion, "rapid"},
    {'G', 10, Effect::Motion, "straight move at F"},
    {'G', 20, Effect::Refused, kArc},
    {'G', 30, Effect::Refused, kArc},
    {'G', 40, Effect::Halt, "halt of P"},
    {'G', 50, Effect::Refused, kSpline},
    {'G', 51, Effect::Refused, kSpline},
    {'G', 52, Effect::Refused, kSpline},
    {'G', 53, Effect::Refused, kSpline},
    {'G', 62, Effect::Refused, kSpline},
    {'G', 70, Effect::Refused, kDiameter},
    {'G', 80, Effect::Refused, kDiameter},
    {'G', 90, Effect::None, "stop exactly at the end of this move"},
    {'G', 100, Effect::Refused, "sets offsets of origin or tool, which are not honoured"},
    {'G', 120, Effect::Refused, kCycle},
    {'G', 130, Effect::Refused, kCycle},
    {'G', 150, Effect::Cancel, "no polar coordinates"},
    {'G', 160, Effect::Refused, "polar coordinates are not honoured"},
    {'G', 170, Effect::None, "XY plane"},
    {'G', 171, Effect::Refused, kPlane},
    {'G', 180, Effect::Refused, kPlane},
    {'G', 181, Effect::Refused, kPlane},
    {'G', 190, Effect::Refused, kPlane},
    {'G', 191, Effect::Refused, kPlane},
    {'G', 200, Effect::Inches, "inches, feeds too"},
    {'G', 210, Effect::Millimetres, "millimetres"},
    {'G', 270, Effect::Refused, kHome},
    {'G', 280, Effect::Refused, kHome},
    {'G', 281, Effect::Refused, "sets the reference point, which is not honoured"},
    {'G', 290, Effect::Refused, kHome},
    {'G', 300, Effect::Refused, kHome},
    {'G', 301, Effect::Refused, "sets the reference point, which is not honoured"},
    {'G', 310, Effect::Refused, kProbe},
    {'G', 330, Effect::Refused, "threading is not honoured"},
    {'G', 382, Effect::Refused, kProbe},
    {'G', 383, Effect::Refused, kProbe},
    {'G', 384, Effect::Refused, kProbe},
    {'G', 385, Effect::Refused, kProbe},
    {'G', 400, Effect::None, "no offset by the tool's radius"},
    {'G', 410, Effect::Refused, kRadius},
    {'G', 411, Effect::Refused, kRadius},
    {'G', 420, Effect::Refused, kRadius},
    {'G', 421, Effect::Refused, kRadius},
    {'G', 430, Effect::Refused, kLength},
    {'G', 431, Effect::Refused, kLength},
    {'G', 432, Effect::Refused, kLength},
    {'G', 434, Effect::Refused, kLength},
    {'G', 440, Effect::Refused, kLength},
    {'G', 490, Effect::None, "no offset by the tool's length"},
    {'G', 500, Effect::Cancel, "no scaling (with S on lathes the highest speed)"},
    {'G', 501, Effect::Cancel, "no mirror image"},
    {'G', 510, Effect::Refused, "scales the coordinates, which is not honoured"},
    {'G', 511, Effect::Refused, "mirrors the coordinates, which is not honoured"},
    {'G', 520, Effect::Refused, kOrigin},
    {'G', 530, Effect::Refused, kMachine},
    {'G', 540, Effect::WorkOffset, "the part's coordinates"},
    {'G', 541, Effect::Refused, "further offsets of the origin are not honoured; required one of G54 to G59"},
    {'G', 550, Effect::WorkOffset, "the part's coordinates"},
    {'G', 560, Effect::WorkOffset, "the part's coordinates"},
    {'G', 570, Effect::WorkOffset, "the part's coordinates"},
    {'G', 580, Effect::WorkOffset, "the part's coordinates"},
    {'G', 590, Effect::WorkOffset, "the part's coordinates"},
    {'G', 591, Effect::WorkOffset, "the part's coordinates"},
    {'G', 592, Effect::WorkOffset, "the part's coordinates"},
    {'G', 593, Effect::WorkOffset, "the part's coordinates"},
    {'G', 600, Effect::Refused, "positioning from one side, or exact stops: controllers disagree"},
    {'G', 610, Effect::PathMode, "exactly through the ends of moves"},
    {'G', 611, Effect::PathMode, "stop exactly at the ends of moves"},
    {'G', 620, Effect::Refused, "changes the feed in corners, which is not honoured"},
    {'G', 630, Effect::Refused, "tapping is not honoured"},
    {'G', 640, Effect::PathMode, "round the ends of moves"},
    {'G', 650, Effect::Refused, kMacro},
    {'G', 660, Effect::Refused, kMacro},
    {'G', 670, Effect::Cancel, "no modal macro"},
    {'G', 680, Effect::Refused, "turns the coordinates, which is not honoured"},
    {'G', 682, Effect::Refused, "tilts the coordinates, which is not honoured"},
    {'G', 690, Effect::Cancel, "no turned coordinates"},
    {'G', 700, Effect::Refused, kInches},
    {'G', 710, Effect::Millimetres, "millimetres (Sinumerik)"},
    {'G', 730, Effect::Refused, kCycle},
    {'G', 740, Effect::Refused, kCycle},
    {'G', 760, Effect::Refused, kCycle},
    {'G', 800, Effect::Cancel, "no canned cycle"},
    {'G', 810, Effect::Refused, kCycle},
    {'G', 820, Effect::Refused, kCycle},
    {'G', 830, Effect::Refused, kCycle},
    {'G', 840, Effect::Refused, kCycle},
    {'G', 850, Effect::Refused, kCycle},
    {'G', 860, Effect::Refused, kCycle},
    {'G', 870, Effect::Refused, kCycle},
    {'G', 880, Effect::Refused, kCycle},
    {'G', 890, Effect::Refused, kCycle},
    {'G', 900, Effect::Distance, "absolute coordinates"},
    {'G', 901, Effect::None, "absolute centres of arcs"},
    {'G', 910, Effect::Distance, "increments"},
    {'G', 911, Effect::None, "centres of arcs as increments"},
    {'G', 920, Effect::Refused, kOrigin},
    {'G', 921, Effect::Refused, kOrigin},
    {'G', 922, Effect::Refused, kOrigin},
    {'G', 923, Effect::Refused, kOrigin},
    {'G', 930, Effect::FeedMode, "F is of the time of each move"},
    {'G', 940, Effect::FeedMode, "F in mm/min"},
    {'G', 950, Effect::Refused, "feed per revolution is not accepted; required mm/min (G94) or G93"},
    {'G', 960, Effect::Refused, "constant surface speed changes the spindle's speed; required G97"},
    {'G', 970, Effect::None, "constant speed of the spindle"},
    {'G', 980, Effect::Cancel, "return level of canned cycles (on lathes feed per minute)"},
    {'G', 990, Effect::Refused, "return level of canned cycles, on lathes feed per revolution: controllers disagree"},
    {'G', 1530, Effect::Refused, kMachine},
    {'G', 5000, Effect::WorkOffset, "no offset of the origin (Sinumerik)"},
    {'G', 7000, Effect::Refused, kInches},
    {'G', 7100, Effect::Millimetres, "millimetres, feeds too (Sinumerik)"},
    {'M', 0, Effect::Pause, "stop"},
    {'M', 10, Effect::Pause, "stop if the operator wants it"},
    {'M', 20, Effect::End, "end"},
    {'M', 30, Effect::Spindle, "spindle clockwise"},
    {'M', 40, Effect::Spindle, "spindle counter-clockwise"},
    {'M', 50, Effect::Spindle, "spindle off"},
    {'M', 60, Effect::ToolChange, "change to the tool T"},
    {'M', 70, Effect::Coolant, "mist, or the first coolant"},
    {'M', 80, Effect::Coolant, "coolant"},
    {'M', 90, Effect::Coolant, "coolants off"},
    {'M', 170, Effect::Refused, "the end of a subprogram; required M2 or M30"},
    {'M', 300, Effect::End, "end"},
    {'M', 480, Effect::None, "the operator may change the feed"},
    {'M', 490, Effect::None, "the operator may not change the feed"},
    {'M', 520, Effect::Refused, "changes the feed while the program runs, which is not honoured"},
    {'M', 970, Effect::Refused, kMacro},
    {'M', 980, Effect::Refused, kMacro},
    {'M', 990, Effect::Refused, "the end of a subprogram, or the whole again; required M2 or M30"},
};

std::string accepted_of(char letter) {
  std::string text;
  for (const GcodeCode& code : gcode_codes()) {
    if (code.letter != letter || code.effect == Effect::Refused) continue;
    text += fmt::format("{}{}{}", text.empty() ? "" : " ", letter, code.tenths / 10.0);
  }
  return text;
}

}  // namespace

std::span<const GcodeCode> gcode_codes() { return kCodes; }

const GcodeCode* gcode_code(char letter, double number) {
  constexpr double kLargest = 1e6;
  const double tenths = 10.0 * number;
  if (!(std::abs(tenths) <= kLargest) || std::abs(tenths - std::round(tenths)) > 1e-8) return nullptr;
  const long whole = std::lround(tenths);
  const auto* const found = std::find_if(std::begin(kCodes), std::end(kCodes), [&](const GcodeCode& code) {
    return code.letter == letter && code.tenths == whole;
  });
  return found == std::end(kCodes) ? nullptr : found;
}

std::string_view refused_letter(char letter) {
  switch (letter) {
    case 'A':
    case 'B':
    case 'C':
      return "a rotary axis, or an angle, is not honoured";
    case 'D':
      return "the number of a tool's radius, or of its offsets, is not honoured";
    case 'E':
      return "a further axis, or an exponent, is not honoured";
    case 'H':
      return "the number of a tool's length is not honoured";
    case 'I':
    case 'J':
    case 'K':
    case 'R':
      return "of an arc or a cycle, which are not honoured; required straight moves (G1)";
    case 'L':
      return "a number of repetitions is not honoured";
    case 'U':
    case 'V':
    case 'W':
      return "a further axis, or an increment, is not honoured; required X, Y or Z";
    default:
      return {};
  }
}

const std::string& accepted_gcode() {
  static const std::string kAccepted =
      fmt::format("accepted: {}, {}, and F N O P Q S T X Y Z", accepted_of('G'), accepted_of('M'));
  return kAccepted;
}

}  // namespace dwell
