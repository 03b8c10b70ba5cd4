#include "runs/reports/acceptance_report.h"

#include <fmt/format.h>

#include <cmath>

#include "runs/base/json_blocks.h"

namespace dwell {

std::vector<SurfaceVerdict> judge_residual(const ExactResidual& left, const std::vector<SurfaceLimit>& limits,
                                           int threads, const Progress& progress) {
  if (limits.empty()) return {};
  progress.step("judging the surface");
  std::vector<SurfaceVerdict> verdicts = judge_surface(left.surface, {}, limits, threads, progress);
  for (SurfaceVerdict& verdict : verdicts) {
    const bool rms = verdict.limit.quantity == SurfaceQuantity::Rms;
    if (!rms && verdict.limit.quantity != SurfaceQuantity::Pv) continue;
    const double value = rms ? left.statistics.rms_about_zero() : left.statistics.pv;
    verdict.value = std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  return verdicts;
}

std::vector<std::string> unmet_limits(const std::vector<SurfaceVerdict>& verdicts) {
  std::vector<std::string> sentences;
  for (const SurfaceVerdict& v : verdicts) {
    if (v.passes()) continue;
    const std::string asked = fmt::format("accepted is {}<={:.6g} {}", v.limit.name, v.limit.most, v.limit.unit());
    sentences.push_back(v.value ? fmt::format("{}, the surface has {:.6g} {}", asked, *v.value, v.limit.unit())
                                : fmt::format("{}, which cannot be told of the surface ({})", asked, v.note));
  }
  return sentences;
}

nlohmann::ordered_json acceptance_block(const std::vector<SurfaceVerdict>& verdicts) {
  using Json = nlohmann::ordered_json;
  Json rows = Json::array();
  for (const SurfaceVerdict& v : verdicts) {
    rows.push_back({{"what", v.limit.name},
                    {"unit", v.limit.unit()},
                    {"limit", v.limit.most},
                    {"value", finite_or_null(v.value)},
                    {"margin", v.value ? finite_or_null(v.margin()) : Json(nullptr)},
                    {"passes", v.passes()},
                    {"note", v.note}});
    if (v.limit.quantity == SurfaceQuantity::Band) rows.back()["wavelengths_mm"] = {v.limit.shortest, v.limit.longest};
  }
  return {{"passes", all_pass(verdicts)}, {"limits", rows}};
}

}  // namespace dwell
