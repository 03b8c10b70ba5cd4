#include "runs/reports/aim.h"

#include <fmt/format.h>

namespace dwell {

CorrectionAim correction_aim(const Job& job) {
  const double fraction = job.options.fraction;
  const char* const about = *about_zero_in_words(job.part->before) != '\0' ? " about the mean" : "";
  return {fraction, (1.0 - fraction) * job.part->before.rms, about};
}

std::string aim_line(const CorrectionAim& aim) {
  if (aim.fraction == 1.0) return "";
  return fmt::format("aim       {:.6g} % of the error: RMS {:.4g} nm{} would remain\n", 100.0 * aim.fraction,
                     aim.would_remain_rms, aim.about);
}

nlohmann::ordered_json aim_block(const CorrectionAim& aim) {
  return {{"fraction", aim.fraction}, {"would_remain_rms_nm", aim.would_remain_rms}};
}

}  // namespace dwell
