#include "runs/programs/recorded_option.h"

namespace dwell {

bool is_recorded_option(std::string_view key) {
  // The limit of a map's heights only refuses maps; what passes it is the same map.
  if (key == "map_max_pv_mm") return false;
  if (key == "wavelength_nm" || key == "wave_scale") return true;                     // of the map's heights
  if (key.starts_with("profile_") || key == "line_width_mm") return true;             // how it was made of a profile
  if (key == "weight" || key == "clear_aperture" || key == "piston_nm") return true;  // of what figures are of
  return key == "remove" || key == "aperture" || key.starts_with("map_") || key.starts_with("tif");
}

bool is_record(std::string_view comment) {
  constexpr std::string_view kInput = "input: ", kHash = " sha256=", kOption = "option: ", kMore = "option+: ",
                             kEquals = " = ";
  if (comment.starts_with(kInput)) return comment.find(kHash) != std::string_view::npos;
  if (!comment.starts_with(kOption) && !comment.starts_with(kMore)) return false;
  comment.remove_prefix(comment.starts_with(kOption) ? kOption.size() : kMore.size());
  const std::size_t equals = comment.find(kEquals);
  return equals != std::string_view::npos && is_recorded_option(comment.substr(0, equals));
}

}  // namespace dwell
