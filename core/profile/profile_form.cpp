#include "core/profile/profile_form.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/numbers.h"
#include "core/base/spec_text.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

constexpr double kHighestDegree = 20.0;
constexpr ValueRange kGrazing{1e-3, 90.0, "degrees"};
constexpr double kLargestRadius = 1e12;  // [mm]; a sag of a tenth of a nanometre over 10 m is less than anybody sees

[[noreturn]] void refuse_form(const std::string& text) {
  throw InputError(
      fmt::format("form \"{}\"; accepted: none; piston; piston,tilt; polynomial:N, N from 1 to {}; sphere or "
                  "sphere:radius=MM; ellipse:p=MM,q=MM,angle=DEG[,at=MM][,source=low|high][,fit=position|angle|"
                  "position+angle|none]",
                  text, kHighestDegree));
}

ProfileForm polynomial_form(const std::string& text, std::string_view degree) {
  const std::optional<double> number = finite_number(degree);
  if (!number || *number < 1.0 || *number > kHighestDegree || *number != std::floor(*number)) refuse_form(text);
  ProfileForm form;
  form.degree = static_cast<int>(*number);
  return form;
}

ProfileForm sphere_form(const SpecText& spec) {
  spec.accept_only({"radius"});
  ProfileForm form;
  form.kind = ProfileForm::Kind::Sphere;
  form.radius = spec.optional_number("radius");
  const bool within =
      !form.radius || (std::abs(*form.radius) >= ranges::kSize.least && std::abs(*form.radius) <= kLargestRadius);
  if (!within) {
    spec.reject("radius", fmt::format("a number from {:g} to {:g} (mm), negative of a convex one, is",
                                      ranges::kSize.least, kLargestRadius));
  }
  return form;
}

ProfileForm ellipse_form(const SpecText& spec) {
  constexpr double kRadiansPerDegree = kPi / 180.0;
  spec.accept_only({"p", "q", "angle", "at", "source", "fit"});
  ProfileForm form;
  form.kind = ProfileForm::Kind::Ellipse;
  form.mirror = {spec.number("p", ranges::kSize), spec.number("q", ranges::kSize),
                 spec.number("angle", kGrazing) * kRadiansPerDegree};
  form.pole = spec.optional_number("at");
  if (form.pole && !ranges::kPlace.holds(*form.pole)) spec.reject("at", ranges::kPlace.text());
  form.source_high = spec.choice("source", {"low", "high"}) == "high";
  const std::string fit = spec.has("fit") ? spec.choice("fit", {"position", "angle", "position+angle", "none"})
                                          : std::string(form.pole ? "none" : "position");
  form.fit_position = fit.starts_with("position");
  form.fit_angle = fit.ends_with("angle");
  return form;
}

ProfileForm form_of_kind(const std::string& text) {
  const auto [kind, rest] = split_kind(text);
  if (kind == "polynomial") return polynomial_form(text, rest);
  if (kind == "sphere" && (text == kind || !rest.empty())) return sphere_form(parse_spec_text(text, "form"));
  if (kind == "ellipse") return ellipse_form(parse_spec_text(text, "form"));
  ProfileForm form;
  if (text == "none") {
    form.kind = ProfileForm::Kind::None;
  } else if (text == "piston") {
    form.degree = 0;
  } else if (text != "piston,tilt") {
    refuse_form(text);
  }
  return form;
}

}  // namespace

ProfileForm parse_profile_form(const std::string& text) {
  ProfileForm form = form_of_kind(text);
  form.text = text;
  return form;
}

}  // namespace dwell
