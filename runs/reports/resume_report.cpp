#include "runs/reports/resume_report.h"

#include <fmt/format.h>

#include "core/base/duration_text.h"

namespace dwell {

std::string resume_lines(const ResumedRun& r) {
  return fmt::format("resume    {} stopped by {}: in step {} of {}, at ({:.6g}, {:.6g}) mm\n", r.plan, r.by, r.step,
                     r.steps, r.place.x, r.place.y) +
         fmt::format("          at work for {} of {}, {:.4g} % of {:.6g} mm with removal\n", duration_text(r.seconds),
                     duration_text(r.whole_seconds), 100.0 * r.way / r.whole_way, r.whole_way) +
         fmt::format("          removed so far: {:.4g} nm in the mean, RMS {:.4g} nm about it, PV {:.4g} nm\n",
                     r.removed.mean, r.removed.rms, r.removed.pv) +
         fmt::format("          measured {}, now {}\n", in_words(r.measured), in_words(r.remaining)) +
         "          the rest keeps its dwell; nothing is solved, and what is predicted is left by both parts\n";
}

nlohmann::ordered_json resume_block(const ResumedRun& r) {
  return {{"plan", r.plan},
          {"by", r.by},
          {"step", r.step},
          {"steps", r.steps},
          {"place_mm", {r.place.x, r.place.y}},
          {"run_s", r.seconds},
          {"whole_s", r.whole_seconds},
          {"run_mm", r.way},
          {"whole_mm", r.whole_way},
          {"removed_mean_nm", r.removed.mean},
          {"removed_rms_nm", r.removed.rms},
          {"removed_pv_nm", r.removed.pv},
          {"measured_rms_nm", r.measured.rms},
          {"remaining_rms_nm", r.remaining.rms},
          {"block_s", r.block_seconds},
          {"block_depth_nm", r.block_depth}};
}

}  // namespace dwell
