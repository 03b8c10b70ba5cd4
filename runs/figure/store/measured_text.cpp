#include "runs/figure/store/measured_text.h"

#include <fmt/format.h>

#include "core/base/duration_text.h"

namespace dwell {
namespace {

std::string registration_lines(const RemovalComparison& comparison) {
  const RemovalRegistration& r = comparison.registration;
  std::string text = fmt::format(
      "removed   {:.4g} nm RMS of the measured removal differ from the predicted one by {:.4g}, and by {:.4g} after "
      "the "
      "fit ({} pixels, {} spikes left out)\n",
      r.measured_rms, r.before.rms, r.after.rms, r.points, r.spikes);
  text += fmt::format(
      "place     shift {:.4g} +- {:.2g} mm in x, {:.4g} +- {:.2g} mm in y, turned {:.4g} +- {:.2g} degrees\n",
      r.x.value, r.x.error, r.y.value, r.y.error, r.degrees.value, r.degrees.error);
  text += fmt::format("scale     x {:.6g} +- {:.2g} of the part's own\n", r.scale.value, r.scale.error);
  text += fmt::format("tool      rate x {:.4g} +- {:.2g}, width x {:.4g} +- {:.2g}\n", r.rate.value, r.rate.error,
                      r.width.value, r.width.error);
  const RemovalSplit& s = comparison.split;
  text +=
      fmt::format("split     tool {:.4g} nm RMS, {}position {:.4g} nm, unexplained {:.4g} nm\n", s.tool,
                  s.motion ? fmt::format("motion {:.4g} nm, ", *s.motion) : std::string(), s.position, s.unexplained);
  if (!s.motion) text += "          (motion: not known without the controller's log, --log)\n";
  return text;
}

std::string curve_lines(const NextRun& next) {
  std::string text;
  for (const NextRunPoint& point : next.curve)
    text += fmt::format("{}{:.4g} s: {:.4g} nm", text.empty() ? "" : ", ", point.seconds, point.rms);
  return text.empty() ? "" : fmt::format("curve     dwell of a next run and the RMS that it leaves: {}\n", text);
}

}  // namespace

std::string measured_text(const MeasuredStep& step, double fwhm) {
  std::string text = fmt::format("run       {}\n", step.iteration);
  text += fmt::format("before    {}\n", in_words(step.before));
  text += fmt::format("predicted {}\n", in_words(step.predicted));
  text += fmt::format("measured  {}\n", in_words(step.after));
  if (step.comparison.registration.points == 0)
    return text;  // an error of orientation: what it would say is of nothing
  text += registration_lines(step.comparison);
  if (!step.fault.empty()) return text;
  for (const LessonDecision& decision : step.lesson.decisions)
    text += fmt::format("learnt    {}\n", decision.sentence());
  text += fmt::format("converged {:.4g} times: RMS before over RMS measured", step.convergence());
  if (const auto efficiency = step.efficiency())
    text += fmt::format("; {:.4g} % of the improvement that was predicted", 100.0 * *efficiency);
  text += "\n" + surface_lines(step.surface);
  text += fmt::format("reach     the tool of {:.3g} mm FWHM corrects waves longer than {:.3g} mm\n", fwhm, 2.0 * fwhm);
  text += verdict_lines(step.next_run.now) + curve_lines(step.next_run);
  for (const std::string& warning : step.warnings) text += fmt::format("warning   {}\n", warning);
  text += fmt::format("advice    {}\n", step.next_run.advice);
  return text;
}

}  // namespace dwell
