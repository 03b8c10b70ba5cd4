#include "runs/profile/profile_input.h"

#include <utility>

#include "core/base/whole_file.h"

namespace dwell {

ProfileInput read_profile(const std::string& file, const ProfileReadOptions& options, const ProfileForm& form) {
  const std::string bytes = read_whole_file(file);
  ProfileInput profile;
  profile.input = {"profile", file, sha256_of(bytes)};
  profile.source = parse_profile_text(bytes, options, file);
  profile.measured = line_profile(profile.source.quantity, std::exchange(profile.source.x, {}),
                                  std::exchange(profile.source.values, {}));
  profile.form = form;
  profile.rest = remove_profile_form(profile.measured, form);
  profile.before = profile_figures(profile.measured);
  profile.after = profile_figures(profile.rest.profile);
  profile.spacing = profile_spacing(profile.measured);
  return profile;
}

}  // namespace dwell
