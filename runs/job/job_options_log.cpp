#include <fmt/format.h>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"
#include "runs/job/job_options.h"
#include "runs/logs/log_columns.h"

namespace dwell {
namespace {

double positive(const std::string& text, const ValueRange& range) {
  const auto value = parse_number(text);
  if (!value || !range.holds(*value)) throw InputError(fmt::format("'{}'; required {}", text, range.text()));
  return *value;
}

}  // namespace

std::vector<JobOptionRecord> log_option_records() {
  using Options = JobOptions;
  return {
      {"log", "log", "FILE",
       "a controller's log of the run of an earlier plan of the same path (text, NPY, HDF5): the feeds are corrected "
       "for "
       "how the machine really took its strokes (docs/motion.md); with --log-plan",
       true, false, [](Options& o, const std::string& t) { o.log = t; }, [](const Options& o) { return o.log; }},
      {"log-plan", "log_plan", "FOLDER",
       "the plan whose program ran when --log was recorded; options that are not given are its own", true, false,
       [](Options& o, const std::string& t) { o.log_plan = t; }, [](const Options& o) { return o.log_plan; }},
      {"log-columns", "log_columns", "T,X,Y",
       "columns of the log that hold time, x and y, by name or number (1 = first), with their units: "
       "Time:ms,PosX:um,PosY:um; x and y alone with --log-period (default: by their names; s and mm where nothing says "
       "the unit)",
       false, false, [](Options& o, const std::string& t) { parse_log_columns(t), o.log_columns = t; },
       [](const Options& o) { return o.log_columns; }},
      {"log-period", "log_period_s", "S",
       "sampling period in s of a log without a time, or whose first column counts samples (N:samples,...)", false,
       true, [](Options& o, const std::string& t) { o.log_period_s = positive(t, ranges::kTime); },
       [](const Options& o) { return o.log_period_s ? fmt::format("{}", *o.log_period_s) : std::string(); }},
      {"log-tolerance", "log_tolerance_mm", "MM",
       "how far samples at work may lie beside the program's path in mm; a log farther off is of another path", false,
       true, [](Options& o, const std::string& t) { o.log_tolerance_mm = positive(t, ranges::kSize); },
       [](const Options& o) { return fmt::format("{}", o.log_tolerance_mm); }},
  };
}

}  // namespace dwell
