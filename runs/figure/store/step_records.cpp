#include "runs/figure/store/step_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/errors.h"
#include "runs/base/json_blocks.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, kLessonSubjects> kSubjectKeys{"rate", "width", "shift_mm", "rotation_mrad"};

Json estimate_record(const Estimate& estimate) {
  return {{"value", finite_or_null(estimate.value)}, {"error", finite_or_null(estimate.error)}};
}

}  // namespace

Json statistics_record(const MapStatistics& statistics) {
  Json record{{"pixels", statistics.valid_pixels},
              {"rms_nm", statistics.rms},
              {"pv_nm", statistics.pv},
              {"mean_nm", statistics.mean}};
  if (statistics.pvr) record["pvr_nm"] = *statistics.pvr;
  return record;
}

MapStatistics statistics_of_record(const Json& record) {
  MapStatistics statistics;
  statistics.valid_pixels = record.at("pixels");
  statistics.rms = record.at("rms_nm"), statistics.pv = record.at("pv_nm"), statistics.mean = record.at("mean_nm");
  if (record.contains("pvr_nm")) statistics.pvr = record.at("pvr_nm").get<double>();
  return statistics;
}

Json verdict_records(const std::vector<SurfaceVerdict>& verdicts) {
  Json list = Json::array();
  for (const SurfaceVerdict& v : verdicts) {
    list.push_back({{"quantity", v.limit.name},
                    {"unit", v.limit.unit()},
                    {"most", v.limit.most},
                    {"value", finite_or_null(v.value)},
                    {"passes", v.passes()},
                    {"note", v.note}});
  }
  return list;
}

Json lesson_record(const ToolLesson& lesson) {
  Json decisions = Json::object();
  for (const LessonDecision& d : lesson.decisions) {
    decisions[kSubjectKeys.at(static_cast<std::size_t>(d.subject))] = {
        {"found", estimate_record(d.found)}, {"threshold", d.threshold}, {"applied", d.applied},
        {"overridden", d.overridden},        {"clipped", d.clipped},     {"used", d.used}};
  }
  return {{"decisions", decisions},
          {"rate", lesson.rate},
          {"width", lesson.width},
          {"shift_mm", {lesson.shift.x, lesson.shift.y}},
          {"rotation_deg", lesson.degrees}};
}

ToolLesson lesson_of_record(const Json& record) {
  ToolLesson lesson;
  const Json& decisions = record.at("decisions");
  for (std::size_t k = 0; k < kLessonSubjects; ++k) {
    const Json& d = decisions.at(kSubjectKeys[k]);
    const Json& found = d.at("found");
    const auto number = [](const Json& value) { return value.is_number() ? value.get<double>() : 0.0; };
    LessonDecision decision;
    decision.subject = static_cast<LessonSubject>(k);
    decision.found = {number(found.at("value")), number(found.at("error"))};
    decision.threshold = d.at("threshold"), decision.used = d.at("used");
    decision.applied = d.at("applied"), decision.overridden = d.at("overridden"), decision.clipped = d.at("clipped");
    lesson.decisions.push_back(decision);
  }
  lesson.rate = record.at("rate"), lesson.width = record.at("width");
  lesson.shift = {record.at("shift_mm").at(0), record.at("shift_mm").at(1)};
  lesson.degrees = record.at("rotation_deg");
  return lesson;
}

Json comparison_record(const RemovalComparison& comparison) {
  const RemovalRegistration& r = comparison.registration;
  const RemovalSplit& split = comparison.split;
  return {{"registration",
           {{"rate", estimate_record(r.rate)},
            {"width", estimate_record(r.width)},
            {"x_mm", estimate_record(r.x)},
            {"y_mm", estimate_record(r.y)},
            {"rotation_deg", estimate_record(r.degrees)},
            {"scale", estimate_record(r.scale)},
            {"measured_rms_nm", r.measured_rms},
            {"difference_rms_nm", r.before.rms},
            {"left_rms_nm", r.after.rms},
            {"points", r.points},
            {"spikes", r.spikes}}},
          {"split_nm",
           {{"motion", finite_or_null(split.motion)},
            {"tool", split.tool},
            {"position", split.position},
            {"unexplained", split.unexplained}}},
          {"orientation",
           {{"as_thought_nm", finite_or_null(comparison.orientation.as_thought)},
            {"best_nm", finite_or_null(comparison.orientation.best)}}}};
}

Json next_run_record(const NextRun& next) {
  Json curve = Json::array();
  for (const NextRunPoint& point : next.curve) curve.push_back({{"dwell_s", point.seconds}, {"rms_nm", point.rms}});
  return {{"dwell_s", next.seconds},
          {"rms_nm", next.rms},
          {"margin_nm", next.margin},
          {"now", verdict_records(next.now)},
          {"expected", verdict_records(next.expected)},
          {"curve", curve},
          {"advice", next.advice}};
}

Json option_records(const JobOptions& options, const std::function<bool(const std::string&)>& holds) {
  Json records = Json::object();
  for (const JobOptionRecord& record : job_option_table()) {
    const std::string value = record.get(options);
    if (holds(record.key) && !value.empty()) records[record.key] = value;
  }
  return records;
}

void set_options_of_records(JobOptions& options, const Json& records, const std::string& source) {
  const auto& table = job_option_table();
  for (const auto& [key, value] : records.items()) {
    const std::string& name = key;
    const auto record = std::find_if(table.begin(), table.end(), [&name](const auto& row) { return row.key == name; });
    if (record == table.end())
      throw InputError(fmt::format("{}: option '{}' is not known to this version", source, key));
    set_job_option(options, *record, value.get<std::string>(), fmt::format("{}: {}", source, key));
  }
}

}  // namespace dwell
