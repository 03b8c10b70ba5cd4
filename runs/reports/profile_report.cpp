#include "runs/reports/profile_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <utility>

#include "core/base/numbers.h"
#include "core/base/version.h"
#include "runs/base/inputs_json.h"
#include "runs/base/json_blocks.h"
#include "runs/drawing/line_chart.h"

namespace dwell {
namespace {

constexpr double kDegreesPerRadian = 180.0 / kPi;

std::string figures_text(const char* name, const ProfileFigures& figures) {
  return fmt::format("{:<10}slope {:.6g} urad RMS, {:.6g} urad PV; height {:.6g} nm RMS, {:.6g} nm PV\n", name,
                     figures.slope_rms, figures.slope_pv, figures.height_rms, figures.height_pv);
}

nlohmann::ordered_json figures_block(const ProfileFigures& figures) {
  return {{"slope_rms_urad", figures.slope_rms},
          {"slope_pv_urad", figures.slope_pv},
          {"height_rms_nm", figures.height_rms},
          {"height_pv_nm", figures.height_pv}};
}

std::string spacing_text(const ProfileSpacing& spacing) {
  constexpr double kEven = 1e-6;
  if (spacing.most - spacing.least <= kEven * spacing.most) return fmt::format("{:.6g} mm apart", spacing.median);
  return fmt::format("{:.6g} to {:.6g} mm apart (median {:.6g} mm)", spacing.least, spacing.most, spacing.median);
}

std::string removed_text(const ProfileInput& profile) {
  const ProfileRest& rest = profile.rest;
  std::string text = fmt::format("removed   {}", profile.form.text);
  if (rest.pole)
    text += fmt::format(", pole at x = {:.6g} mm{}", *rest.pole, profile.form.fit_position ? " (fitted)" : "");
  if (rest.angle) {
    text += fmt::format(", grazing angle {:.6g} degrees{}", *rest.angle * kDegreesPerRadian,
                        profile.form.fit_angle ? " (fitted)" : "");
  }
  if (rest.radius) text += fmt::format(", radius {:.6g} mm{}", *rest.radius, profile.form.radius ? "" : " (fitted)");
  if (rest.tilt) text += fmt::format(", tilt {:.6g} urad", *rest.tilt);
  return text + "\n";
}

std::string source_text(const ProfileInput& profile) {
  const ProfileText& source = profile.source;
  return fmt::format("columns   {} in {}, {} in {}{}\n", source.place_column, source.place_unit, source.value_column,
                     source.value_unit, source.turned ? "; places decrease in the file" : "");
}

ChartPanel rest_panel(const LineProfile& rest, const std::vector<double>& values, const std::string& label) {
  ChartPanel panel{"x [mm]", label, {}, AxisScale::Linear, AxisScale::Linear};
  ChartLine line{"", {33, 102, 172}, {}, false, false};
  for (std::size_t i = 0; i < rest.x.size(); ++i) line.points.push_back({rest.x[i], values[i], false});
  panel.lines.push_back(std::move(line));
  return panel;
}

}  // namespace

std::string profile_text(const ProfileInput& profile) {
  const std::vector<double>& x = profile.measured.x;
  std::string text = fmt::format("file      {} (sha256 {})\n", profile.input.file, profile.input.sha256);
  text += source_text(profile);
  text += fmt::format("places    {} from {:.9g} to {:.9g} mm, {:.9g} mm long, {}\n", x.size(), x.front(), x.back(),
                      x.back() - x.front(), spacing_text(profile.spacing));
  text += figures_text("before", profile.before) + removed_text(profile) + figures_text("after", profile.after);
  for (const std::string& hint : profile.rest.hints) text += fmt::format("hint      {}\n", hint);
  return text;
}

std::string profile_json(const ProfileInput& profile) {
  const std::vector<double>& x = profile.measured.x;
  const ProfileText& source = profile.source;
  nlohmann::ordered_json json = json_of_command("profile");
  json["profile"] = {{"file", profile.input.file},
                     {"quantity", source.quantity == ProfileQuantity::Slope ? "slope" : "height"},
                     {"place_column", source.place_column},
                     {"place_unit", source.place_unit},
                     {"value_column", source.value_column},
                     {"value_unit", source.value_unit},
                     {"decreasing", source.turned},
                     {"places", x.size()},
                     {"from_mm", x.front()},
                     {"to_mm", x.back()},
                     {"length_mm", x.back() - x.front()},
                     {"least_spacing_mm", profile.spacing.least},
                     {"median_spacing_mm", profile.spacing.median},
                     {"largest_spacing_mm", profile.spacing.most}};
  json["before"] = figures_block(profile.before);
  const ProfileRest& rest = profile.rest;
  json["removed"] = {{"form", profile.form.text},
                     {"tilt_urad", finite_or_null(rest.tilt)},
                     {"radius_mm", finite_or_null(rest.radius)},
                     {"pole_mm", finite_or_null(rest.pole)},
                     {"angle_deg", rest.angle ? finite_or_null(*rest.angle * kDegreesPerRadian) : nullptr}};
  json["after"] = figures_block(profile.after);
  json["hints"] = rest.hints;
  json["inputs"] = inputs_json({profile.input});
  return json_text(json);
}

std::string profile_rest_csv(const ProfileInput& profile) {
  return profile_csv(profile.rest.profile, fmt::format("dwell {} profile, without {}", version(), profile.form.text));
}

std::string profile_rest_picture(const ProfileInput& profile, FigureFormat format) {
  const LineProfile& rest = profile.rest.profile;
  const std::string title = fmt::format("{}: slope {:.4g} urad RMS, height {:.4g} nm RMS ({} removed)",
                                        std::filesystem::path(profile.input.file).filename().string(),
                                        profile.after.slope_rms, profile.after.height_rms, profile.form.text);
  return draw_line_charts(
      title, "", {rest_panel(rest, rest.slope, "slope [urad]"), rest_panel(rest, rest.height, "height [nm]")}, format);
}

}  // namespace dwell
