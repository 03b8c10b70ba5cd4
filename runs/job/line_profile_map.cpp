#include "runs/job/line_profile_map.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/errors.h"
#include "core/base/threads.h"
#include "runs/map_steps/map_steps.h"
#include "runs/profile/profile_strip.h"

namespace dwell {
namespace {

bool says_how_to_read_a_map(const std::string& flag) {
  return flag == "map" || (flag.starts_with("map-") && flag != "map-steps") || flag == "wavelength" ||
         flag == "wave-scale" || flag == "removal" || flag == "piston";
}

bool is_of_a_line_profile(const std::string& flag) { return flag.starts_with("profile-") || flag == "line-width"; }

/// A profile whose own names of options become those of a job.
ProfileInput read_named(const JobOptions& options) {
  try {
    return read_profile(options.line_profile, {options.profile_columns, options.profile_unit},
                        parse_profile_form(options.profile_remove));
  } catch (const InputError& error) {
    throw InputError(with_option_names(error.what(), [](const std::string& name) { return "`profile " + name + "`"; }));
  }
}

}  // namespace

void check_profile_options(const JobOptions& options) {
  const bool profile = !options.line_profile.empty();
  const JobOptions defaults;
  for (const JobOptionRecord& record : job_option_table()) {
    const std::string value = record.get(options);
    if (value == record.get(defaults)) continue;
    if (profile && says_how_to_read_a_map(record.flag)) {
      throw InputError(
          fmt::format("--{} {}: beside --line-profile {}, which takes the place of a map; required one "
                      "of the two",
                      record.flag, value, options.line_profile));
    }
    if (!profile && is_of_a_line_profile(record.flag))
      throw InputError(fmt::format("--{} {}: of --line-profile, which is not given", record.flag, value));
  }
}

HeightMap load_line_profile(const JobOptions& options, std::vector<InputFile>& inputs, std::vector<std::string>& notes,
                            const Progress& progress) {
  progress.step("reading the line profile");
  ProfileInput profile = read_named(options);
  inputs.push_back(profile.input);
  for (std::string& hint : profile.rest.hints) notes.push_back(options.line_profile + ": " + std::move(hint));
  HeightMap map = profile_strip(profile, options.line_width_mm.value_or(0.0));
  MapReadOptions read;
  read.limit = {options.max_pixels};
  read.threads = thread_count(options.threads);
  MapStepContext context{read, &inputs, read.threads, progress.of_part("line profile")};
  apply_map_steps(map, parse_map_steps(options.map_steps), context);
  return map;
}

void forget_line_profile(JobOptions& options) {
  const JobOptions none;
  options.line_profile = none.line_profile;
  options.profile_columns = none.profile_columns;
  options.profile_unit = none.profile_unit;
  options.profile_remove = none.profile_remove;
  options.line_width_mm = none.line_width_mm;
}

void forget_map(JobOptions& options) {
  const JobOptions none;
  options.map = none.map;
  options.map_pixel_mm = none.map_pixel_mm;
  options.map_unit = none.map_unit;
  options.wavelength_nm = none.wavelength_nm;
  options.wave_scale = none.wave_scale;
  options.map_origin_mm = none.map_origin_mm;
  options.map_no_data = none.map_no_data;
  options.map_max_pv_mm = none.map_max_pv_mm;
  options.map_table = none.map_table;
  options.map_rows = none.map_rows;
  options.map_grid = none.map_grid;
}

}  // namespace dwell
