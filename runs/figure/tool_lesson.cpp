#include "runs/figure/tool_lesson.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dwell {
namespace {

constexpr double kMradPerDegree = 1000.0 * std::numbers::pi / 180.0;

struct SubjectWords {
  const char* name;
  const char* unit;
};
constexpr SubjectWords kSubjects[kLessonSubjects] = {
    {"rate", "of what was thought"}, {"width", "of what was thought"}, {"shift", "mm"}, {"rotation", "mrad"}};

bool holds(const std::vector<LessonSubject>& subjects, LessonSubject subject) {
  return std::find(subjects.begin(), subjects.end(), subject) != subjects.end();
}

/// Settles whether a change of that size is taken over. What was not fitted (no error) never is.
void decide(LessonDecision& decision, double change, const LessonPolicy& policy) {
  const bool by_rule = change > decision.threshold;
  decision.applied = by_rule;
  if (holds(policy.taken, decision.subject)) decision.applied = true;
  if (holds(policy.left, decision.subject)) decision.applied = false;
  if (!std::isfinite(change) || !(decision.found.error > 0.0)) decision.applied = false;
  decision.overridden = decision.applied != by_rule;
  const bool of_place = decision.subject == LessonSubject::Shift || decision.subject == LessonSubject::Rotation;
  if (of_place && !policy.fixed.empty() && change > decision.threshold) {
    decision.applied = decision.overridden = false;
    decision.why = policy.fixed;
  }
}

/// A rate is weighed with what was known: its change is believed as far as its error allows.
void weigh(LessonDecision& rate, double expected_change) {
  if (!rate.applied || rate.overridden || !std::isfinite(expected_change)) return;
  const double share =
      expected_change * expected_change / (expected_change * expected_change + rate.found.error * rate.found.error);
  rate.used = 1.0 + share * (rate.used - 1.0);
  rate.weighed = share < 0.99;
}

/// A factor within bounds; 1 where it is not taken over.
double clip(LessonDecision& decision, double least, double most) {
  const bool asked_for = decision.overridden && decision.found.value > 0.0;
  const double within = asked_for ? decision.found.value : std::clamp(decision.found.value, least, most);
  decision.used = decision.applied ? within : 1.0;
  decision.clipped = decision.applied && decision.used != decision.found.value;
  return decision.used;
}

Estimate size_of_shift(const Estimate& x, const Estimate& y) {
  const double size = std::hypot(x.value, y.value);
  if (!(size > 0.0)) return {0.0, std::max(x.error, y.error)};
  return {size, std::hypot(x.value * x.error, y.value * y.error) / size};
}

}  // namespace

std::string LessonDecision::sentence() const {
  const SubjectWords& words = kSubjects[static_cast<std::size_t>(subject)];
  std::string text = fmt::format("{} {:.4g} +- {:.2g} {}: ", words.name, found.value, found.error, words.unit);
  if (!(found.error > 0.0)) return text + "was not fitted";
  text += applied ? "taken" : "left";
  if (!why.empty()) return fmt::format("{}: {}", text, why);
  if (clipped) text += fmt::format(" as {:.4g}, the most in one run", used);
  if (weighed) text += fmt::format(" as {:.4g}, weighed with what was known before", used);
  if (overridden) return text + " because it was asked for";
  if (threshold > 0.0) text += fmt::format(", {} {:.2g}", applied ? "beyond" : "within", threshold);
  return text;
}

ToolLesson learn_from(const RemovalRegistration& found, double fwhm, const LessonPolicy& policy) {
  ToolLesson lesson;
  LessonDecision rate, width, shift, rotation;
  rate.subject = LessonSubject::Rate, rate.found = found.rate;
  decide(rate, std::abs(found.rate.value - 1.0), policy);
  width.subject = LessonSubject::Width, width.found = found.width;
  width.threshold = policy.errors * found.width.error;
  decide(width, std::abs(found.width.value - 1.0), policy);
  shift.subject = LessonSubject::Shift, shift.found = size_of_shift(found.x, found.y);
  shift.threshold = std::max(policy.least_shift, policy.errors * shift.found.error);
  decide(shift, shift.found.value, policy);
  rotation.subject = LessonSubject::Rotation;
  rotation.found = {kMradPerDegree * found.degrees.value, kMradPerDegree * found.degrees.error};
  rotation.threshold = std::max(policy.least_mrad, policy.errors * rotation.found.error);
  decide(rotation, std::abs(rotation.found.value), policy);
  const double farthest = policy.orientation_share * fwhm;
  const bool is_certain = shift.found.value - farthest > policy.errors * shift.found.error;
  const bool answered = holds(policy.taken, LessonSubject::Shift) || holds(policy.left, LessonSubject::Shift);
  if (is_certain && !answered) {
    lesson.orientation_fault = fmt::format(
        "what was removed lies {:.3g} +- {:.2g} mm ({:.3g} in x, {:.3g} in y) from where it was meant to, more than a "
        "quarter of the tool's {:.3g} mm: that is no error of positioning to be made up for, but of orientation or "
        "origin",
        shift.found.value, shift.found.error, found.x.value, found.y.value, fwhm);
    rate.applied = width.applied = shift.applied = rotation.applied = false;
  }
  const double certainly = std::abs(found.degrees.value) - policy.errors * found.degrees.error;
  if (certainly > policy.most_degrees && !holds(policy.taken, LessonSubject::Rotation) &&
      !holds(policy.left, LessonSubject::Rotation) && lesson.orientation_fault.empty()) {
    lesson.orientation_fault = fmt::format(
        "what was removed lies turned by {:.3g} +- {:.2g} degrees against where it was meant to, more than {:.3g}: "
        "that "
        "is no error of positioning to be made up for, but of how the part or the map lies",
        found.degrees.value, found.degrees.error, policy.most_degrees);
    rate.applied = width.applied = shift.applied = rotation.applied = false;
  }
  clip(rate, policy.least_rate, policy.most_rate);
  weigh(rate, policy.expected_rate_change);
  lesson.rate = rate.used;
  lesson.width = clip(width, policy.least_width, policy.most_width);
  if (shift.applied) lesson.shift = {found.x.value, found.y.value}, shift.used = shift.found.value;
  if (rotation.applied) lesson.degrees = found.degrees.value, rotation.used = rotation.found.value;
  lesson.decisions = {rate, width, shift, rotation};
  return lesson;
}

}  // namespace dwell
