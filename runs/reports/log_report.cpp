#include "runs/reports/log_report.h"

#include <fmt/format.h>

#include "core/base/counted.h"
#include "core/base/duration_text.h"
#include "runs/base/json_blocks.h"
#include "runs/reports/machine_report.h"

namespace dwell {
namespace {

/// "47.2 +- 0.1 mm/s^2".
std::string figure_words(const FittedFigure& figure) {
  // Delays are milliseconds for people.
  const double scale = figure.unit == "s" ? 1e3 : 1.0;
  const std::string unit = figure.unit == "s" ? "ms" : figure.unit;
  return fmt::format("{:.6g} +- {:.2g}{}{}", scale * figure.value, scale * figure.error, unit.empty() ? "" : " ", unit);
}

std::string left_out_words(const MachineFit& fit) {
  std::string words;
  const auto add = [&words](std::size_t count, const char* why) {
    if (count > 0) words += fmt::format("{}{} {}", words.empty() ? "; left out: " : ", ", count, why);
  };
  add(fit.outliers, "far off all others");
  add(fit.gaps, "with missing samples");
  add(fit.lifted, "with lifts or halts");
  return words;
}

}  // namespace

std::string log_lines(const MotionLog& log, const AlignedLog& aligned, const Program& program) {
  std::string text =
      fmt::format("log       {}: {} every {:.6g} ms\n", log.file, counted(log.size(), "sample"), 1e3 * log.period);
  for (const std::string& note : log.notes) text += fmt::format("          {}\n", note);
  return text + fmt::format(
                    "aligned   to steps {} to {} of {}: from {:.6g} to {:.6g} s of the log, {}; beside the path {:.3g} "
                    "um RMS, "
                    "{:.3g} um at most ({:g} um accepted)\n",
                    aligned.first + 1, aligned.end, program.steps.size(), aligned.begins(), aligned.ends(),
                    duration_text(aligned.seconds()), 1e3 * aligned.rms_off, 1e3 * aligned.max_off,
                    1e3 * aligned.tolerance);
}

nlohmann::ordered_json log_block(const MotionLog& log, const AlignedLog& aligned) {
  std::size_t corners = 0;
  for (const char corner : aligned.corners) corners += static_cast<std::size_t>(corner);
  return {{"samples", log.size()},
          {"period_s", log.period},
          {"gaps", log.gaps.size()},
          {"notes", log.notes},
          {"begins_s", aligned.begins()},
          {"ends_s", aligned.ends()},
          {"samples_before", aligned.before},
          {"samples_after", aligned.after},
          {"steps", aligned.end - aligned.first},
          {"corners", corners},
          {"off_path_rms_mm", aligned.rms_off},
          {"off_path_max_mm", aligned.max_off},
          {"tolerance_mm", aligned.tolerance}};
}

std::string fit_lines(const MachineFit& fit, const NamedMachine& machine) {
  std::string text = fmt::format("runs      {} from corner to corner{}\n", fit.runs, left_out_words(fit));
  for (const FittedFigure& figure : fit.fitted) {
    text += fmt::format("fitted    {} {}, explains {:.3g} %{}\n", figure.name, figure_words(figure),
                        100.0 * figure.explained, figure.written ? "" : "; not in machine files");
  }
  for (const UndeterminedFigure& figure : fit.undetermined)
    text += fmt::format("not known {}: {}\n", figure.name, figure.why);
  for (const std::string& note : fit.notes) text += fmt::format("note      {}\n", note);
  text += fmt::format(
      "fit       runs differ from the commanded times by {:.4g} ms RMS, from the fitted machine's by {:.4g} ms; "
      "together {:.3f} s logged, {:.3f} s commanded, {:.3f} s by the machine\n",
      1e3 * fit.commanded_rms, 1e3 * fit.rms, fit.logged, fit.commanded, fit.modelled);
  return text + machine_lines(machine);
}

nlohmann::ordered_json fit_block(const MachineFit& fit) {
  auto fitted = nlohmann::ordered_json::array(), undetermined = nlohmann::ordered_json::array();
  for (const FittedFigure& f : fit.fitted) {
    fitted.push_back({{"name", f.key},
                      {"value", f.value},
                      {"standard_error", finite_or_null(f.error)},
                      {"unit", f.unit},
                      {"explained", f.explained},
                      {"written", f.written}});
  }
  for (const UndeterminedFigure& u : fit.undetermined) undetermined.push_back({{"name", u.name}, {"why", u.why}});
  return {{"runs", fit.runs},
          {"runs_far_off", fit.outliers},
          {"runs_with_gaps", fit.gaps},
          {"runs_with_lifts", fit.lifted},
          {"commanded_rms_s", fit.commanded_rms},
          {"rms_s", fit.rms},
          {"logged_s", fit.logged},
          {"commanded_s", fit.commanded},
          {"modelled_s", fit.modelled},
          {"fitted", fitted},
          {"undetermined", undetermined},
          {"notes", fit.notes}};
}

}  // namespace dwell
