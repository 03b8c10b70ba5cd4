#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"
#include "runs/job/job_options.h"
#include "runs/job/place_option.h"
#include "runs/job/yes_or_no.h"

namespace dwell {
namespace {

double degrees_of_turn(const std::string& text) {
  const auto value = parse_number(text);
  if (!value || !ranges::kAngle.holds(*value))
    throw InputError(fmt::format("'{}'; required {}", text, ranges::kAngle.text()));
  return *value;
}

bool is_inch(const std::string& text) {
  if (text == "mm" || text == "inch") return text == "inch";
  throw InputError(fmt::format("'{}'; accepted: mm, inch", text));
}

int step_of_numbers(const std::string& text) {
  constexpr ValueRange kSteps{0.0, 1000.0, ""};
  const auto value = parse_number(text);
  if (value && kSteps.holds(*value) && *value == std::floor(*value)) return static_cast<int>(*value);
  throw InputError(fmt::format("'{}'; required a whole number from 0 to 1000", text));
}

/// The comments and what stands before the work take some lines of each file.
int most_lines(const std::string& text) {
  constexpr ValueRange kLines{100.0, 1e9, "lines"};
  const auto value = parse_number(text);
  if (value && (*value == 0.0 || kLines.holds(*value)) && *value == std::floor(*value)) return static_cast<int>(*value);
  throw InputError(fmt::format("'{}'; required 0 or a whole number from 100 to 1000000000", text));
}

}  // namespace

std::vector<JobOptionRecord> program_option_records() {
  using Options = JobOptions;
  std::vector<JobOptionRecord> records{
      {"path-mode", "path_mode", "MODE",
       "how program.nc asks for corners: exact-stop (G61.1), exact-path (G61), blend or blend:TOL (G64, G64 P, TOL in "
       "mm), none (nothing is written: as the machine was set before), or auto: exact-path for a --machine that stops "
       "at corners, blend with its tolerance for one that blends them, else none",
       false, false, [](Options& o, const std::string& t) { o.path_mode = parse_path_mode(t); },
       [](const Options& o) { return to_string(o.path_mode); }},
      {"header", "header", "FILE",
       "lines of G-code that program.nc has as they are, after its first comments and before all else", true, false,
       [](Options& o, const std::string& t) { o.header = t; }, [](const Options& o) { return o.header; }},
      {"footer", "footer", "FILE",
       "lines of G-code that program.nc has as they are, with the tool lifted, before its end", true, false,
       [](Options& o, const std::string& t) { o.footer = t; }, [](const Options& o) { return o.footer; }},
      {"block-numbers", "block_numbers", "STEP",
       "numbers the lines of program.nc in such steps, 10: N10 N20 ...; 0: no numbers", false, true,
       [](Options& o, const std::string& t) { o.block_numbers = step_of_numbers(t); },
       [](const Options& o) { return fmt::format("{}", o.block_numbers); }},
      {"max-lines", "max_lines", "N",
       "lines that the controller takes: a longer program.nc is written in parts as well, program_001.nc and so on, "
       "with "
       "the tool lifted between; 0: any",
       false, true, [](Options& o, const std::string& t) { o.max_lines = most_lines(t); },
       [](const Options& o) { return fmt::format("{}", o.max_lines); }},
      {"zero", "zero_mm", "X,Y", "place of the part that is the origin of program.nc, in mm", false, false,
       [](Options& o, const std::string& t) { o.zero_mm = parse_point(t); },
       [](const Options& o) { return to_string(o.zero_mm); }},
      {"rotate", "rotate_deg", "DEG",
       "turns program.nc about that place against the part, counter-clockwise seen from +z, in degrees", false, true,
       [](Options& o, const std::string& t) { o.rotate_deg = degrees_of_turn(t); },
       [](const Options& o) { return fmt::format("{}", o.rotate_deg); }},
      {"swap-axes", "swap_axes", "yes|no", "exchanges X and Y of program.nc, after the turn", false, false,
       [](Options& o, const std::string& t) { o.swap_axes = yes_or_no(t); },
       [](const Options& o) { return std::string(o.swap_axes ? "yes" : "no"); }},
      {"units", "units", "UNIT", "unit of lengths and feeds in program.nc: mm (G21) or inch (G20)", false, false,
       [](Options& o, const std::string& t) { o.inches = is_inch(t); },
       [](const Options& o) { return std::string(o.inches ? "inch" : "mm"); }},
  };
  for (JobOptionRecord& record : records) {
    if (record.flag == "block-numbers") record.alone = "10";
    if (record.flag == "swap-axes") record.alone = "yes";
  }
  return records;
}

}  // namespace dwell
