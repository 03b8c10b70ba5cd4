#include <fmt/format.h>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"
#include "runs/job/job_options.h"
#include "runs/job/pixel_weight_option.h"
#include "runs/job/yes_or_no.h"

namespace dwell {
namespace {

double height(const std::string& text) {
  const auto value = parse_number(text);
  if (value && ranges::kHeight.holds(*value)) return *value;
  throw InputError(fmt::format("'{}'; required {}", text, ranges::kHeight.text()));
}

}  // namespace

const std::string& surface_file(const JobOptions& o) {
  const int given = !o.map.empty() + !o.removal.empty() + !o.line_profile.empty();
  if (given == 0)
    throw InputError("--map: required; a height-error map, for instance mirror.csv (or --removal, --line-profile)");
  if (given > 1) {
    const bool removal = !o.removal.empty();
    throw InputError(fmt::format("--{} {} together with {}: both say the surface; required one of them",
                                 removal ? "removal" : "line-profile", removal ? o.removal : o.line_profile,
                                 o.map.empty() ? "--line-profile " + o.line_profile : "--map " + o.map));
  }
  return !o.removal.empty() ? o.removal : !o.line_profile.empty() ? o.line_profile : o.map;
}

FormTerms form_terms(const JobOptions& o) {
  const bool piston = o.piston_nm.has_value();
  if (o.remove_given) {
    if (piston && o.remove.piston) {
      throw InputError(
          fmt::format("--piston {} with --remove {}: where piston does not count, no level is to be kept; "
                      "required --remove without piston",
                      *o.piston_nm, to_string(o.remove)));
    }
    return o.remove;
  }
  if (!o.removal.empty()) return {};
  FormTerms terms = o.remove;
  if (piston) terms.piston = false;
  return terms;
}

std::vector<JobOptionRecord> fit_option_records() {
  using Options = JobOptions;
  std::vector<JobOptionRecord> records{
      {"removal", "removal", "FILE",
       "depth to remove, in place of --map and read with its options: a file in any map format; all of it counts "
       "unless "
       "--remove says else",
       true, false, [](Options& o, const std::string& t) { o.removal = t; },
       [](const Options& o) { return o.removal; }},
      {"piston", "piston_nm", "NM",
       "height in nm that is added to the map and removed with it: the level is not free (absolute removal), and "
       "--remove is without piston",
       false, true, [](Options& o, const std::string& t) { o.piston_nm = height(t); },
       [](const Options& o) { return o.piston_nm ? fmt::format("{}", *o.piston_nm) : std::string(); }},
      {"clear-aperture", "clear_aperture", "AREA",
       "what of the map counts, as in --aperture: what is outside has no say in path, dwell and figures, but is shown",
       false, false, [](Options& o, const std::string& t) { o.clear_aperture = parse_aperture(t); },
       [](const Options& o) {
         return o.clear_aperture.kind == Aperture::Kind::Map ? std::string() : to_string(o.clear_aperture);
       }},
      {"weight", "weight", "WEIGHT;...",
       "what a pixel's square counts in the fit, as a ratio to others': FILE (numbers >= 0 on the map's grid, 0 or "
       "NaN: "
       "does not count), edge:width=MM,weight=W (W within so many mm of the edge) or centre=W (W in the middle, "
       "falling "
       "to 1 at the edge); several are multiplied",
       false, false, [](Options& o, const std::string& t) { check_pixel_weights(t), o.weight = t; },
       [](const Options& o) { return o.weight; }, false, true},
      {"objective", "objective", "WHAT",
       "what the fit makes small: height, slope (from pixel to pixel), or mixed:SHARE with a share of slopes between 0 "
       "and 1; ,length=MM is what slopes are multiplied by, in the place of the tool's own (docs/math.md)",
       false, false, [](Options& o, const std::string& t) { o.objective = parse_fit_objective(t); },
       [](const Options& o) { return to_string(o.objective); }},
      {"uncertainty", "uncertainty", "WHAT=SIZE,...",
       "standard deviations of what may be otherwise than it is thought, each with its unit: "
       "tif-rate=5%,tif-width=2%,position=20um,offset=0.3mm,rotation=0.2deg,metrology=0.2nm, and samples=200,seed=1: "
       "the program is simulated in so many drawn truths (docs/uncertainty.md); or none",
       false, false,
       [](Options& o, const std::string& t) {
         o.uncertainty = t == "none" ? std::nullopt : std::optional(parse_sampled_uncertainty(t));
       },
       [](const Options& o) { return o.uncertainty ? to_string(*o.uncertainty) : std::string(); }},
      {"robust-plan", "robust_plan", "yes|no",
       "makes the residual that is expected under --uncertainty small, in place of that which is left if all is as it "
       "is thought; its weights are those of the plan without it, or less (docs/uncertainty.md)",
       false, false, [](Options& o, const std::string& t) { o.robust_plan = yes_or_no(t); },
       [](const Options& o) { return std::string(o.robust_plan ? "yes" : "no"); }},
  };
  for (JobOptionRecord& record : records) {
    if (record.flag == "robust-plan") record.alone = "yes";
  }
  return records;
}

}  // namespace dwell
