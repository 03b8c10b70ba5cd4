#include <fmt/format.h>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"
#include "core/profile/profile_form.h"
#include "runs/job/job_options.h"

namespace dwell {

std::vector<JobOptionRecord> profile_option_records() {
  using Options = JobOptions;
  return {
      {"line-profile", "line_profile", "FILE",
       "in place of --map: slope or height along a line of the part, as dwell profile reads it; heights without its "
       "form are corrected along y = 0",
       true, false, [](Options& o, const std::string& t) { o.line_profile = t; },
       [](const Options& o) { return o.line_profile; }},
      {"profile-columns", "profile_columns", "PLACE,VALUE",
       "columns of place and value in --line-profile, by name or by number from 1, as x,slope (default as its header "
       "names them)",
       false, false, [](Options& o, const std::string& t) { o.profile_columns = t; },
       [](const Options& o) { return o.profile_columns; }},
      {"profile-unit", "profile_unit", "PLACE,VALUE",
       "units of place and value in --line-profile, as mm,urad or mm,nm; mm,-urad turns the sign of the values "
       "(default "
       "as its header says)",
       false, false, [](Options& o, const std::string& t) { o.profile_unit = t; },
       [](const Options& o) { return o.profile_unit; }},
      {"profile-remove", "profile_remove", "FORM",
       "form of the mirror in --line-profile, which is no error: none; piston; piston,tilt; polynomial:N; "
       "sphere[:radius=MM]; ellipse:p=MM,q=MM,angle=DEG[,...] (default piston,tilt; docs/formats.md, Line profiles)",
       false, false, [](Options& o, const std::string& t) { o.profile_remove = parse_profile_form(t).text; },
       // Nothing for the default, so that the programs of maps do not speak of profiles.
       [](const Options& o) { return o.profile_remove == Options().profile_remove ? "" : o.profile_remove; }},
      {"line-width", "line_width_mm", "MM",
       "width of the part in mm, over which --line-profile is the same in every row of pixels (default: one row, the "
       "line alone)",
       false, true,
       [](Options& o, const std::string& t) {
         constexpr ValueRange kWidths{1e-6, 1e6, "mm"};
         const auto value = parse_number(t);
         if (!value || !kWidths.holds(*value)) throw InputError(fmt::format("'{}'; required {}", t, kWidths.text()));
         o.line_width_mm = *value;
       },
       [](const Options& o) { return o.line_width_mm ? fmt::format("{}", *o.line_width_mm) : std::string(); }},
  };
}

}  // namespace dwell
