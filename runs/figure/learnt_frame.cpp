#include "runs/figure/learnt_frame.h"

#include <fmt/format.h>

#include <cmath>

#include "core/numerics/plane_transform.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/shipped_templates.h"

namespace dwell {

JobOptions with_learnt(JobOptions options, const ToolLesson& lesson, Point about) {
  options.tif_rate *= lesson.rate;
  options.tif_width *= lesson.width;
  const PlaneTransform removes_at = similarity(about, lesson.shift, lesson.degrees, 1.0);
  options.zero_mm = removes_at(options.zero_mm);
  options.rotate_deg = std::remainder(options.rotate_deg - lesson.degrees, 360.0);
  return options;
}

std::string why_frame_is_fixed(const JobOptions& options) {
  const std::string word = export_without_frame(options.exports);
  if (!word.empty()) return fmt::format("programs of `export` = {} say places of the part", word);
  if (!options.program_template.empty() && find_program_template(options.program_template).speeds)
    return fmt::format("programs of `template` = {} say places of the part", options.program_template);
  return "";
}

}  // namespace dwell
