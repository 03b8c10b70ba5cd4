#include "cli/out_of_memory.h"

#include <fmt/format.h>

#include "cli/progress_line.h"
#include "core/base/memory.h"

namespace dwell::cli {

std::string out_of_memory_message() {
  const std::string step = latest_news();
  return fmt::format(
      "out of memory{}{}; {:.2f} GiB are to be had. A coarser map (the step resample:), fewer dwell points "
      "or fewer threads take less",
      step.empty() ? "" : ", at: ", step, static_cast<double>(memory_to_be_had()) / 0x1p30);
}

}  // namespace dwell::cli
