#include "cli/log_arguments.h"

#include <fmt/format.h>

#include "cli/number_option.h"
#include "core/base/value_range.h"

namespace dwell::cli {

void LogArguments::add_to(CLI::App& command) {
  command
      .add_option("--log-columns", columns_,
                  "columns of the log that hold time, x and y, by name or number (1 = first), with their units: "
                  "Time:ms,PosX:um,PosY:um; x and y alone with --log-period (default: by their names; s and mm where "
                  "nothing says the unit)")
      ->type_name("T,X,Y");
  add_number(command, "--log-period", period_, ranges::kTime,
             "sampling period of a log without a time, or whose first column counts samples (N:samples,...) [s]");
  tolerance_option_ = add_number(command, "--log-tolerance", tolerance_, ranges::kSize,
                                 fmt::format("how far samples at work may lie beside the program's path; a log "
                                             "farther off is of another path (default {:g}) [mm]",
                                             kLogTolerance));
}

LogReading LogArguments::reading() const {
  LogReading reading;
  if (!columns_.empty()) reading.columns = parse_log_columns(columns_);
  reading.period = period_;
  return reading;
}

std::string LogArguments::given() const {
  if (!columns_.empty()) return "--log-columns";
  if (period_) return "--log-period";
  return tolerance_option_ != nullptr && tolerance_option_->count() > 0 ? "--log-tolerance" : "";
}

}  // namespace dwell::cli
