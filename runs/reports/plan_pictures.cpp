#include "runs/reports/plan_pictures.h"

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/counted.h"
#include "core/base/side_by_side.h"
#include "core/form/map_statistics.h"
#include "runs/drawing/limit_picture.h"
#include "runs/drawing/path_picture.h"
#include "runs/drawing/picture.h"
#include "runs/drawing/residual_picture.h"
#include "runs/plan/counted_pixels.h"
#include "runs/reports/figure_output.h"

namespace dwell {
namespace {

struct PlanPicture {
  std::string name;
  std::function<std::string(FigureFormat format, const Progress& progress)> draw;
};

/// Of the machine's motion; none without one. Both must outlive the result.
std::vector<PlanPicture> motion_pictures(const PlannedJob& plan, const WrittenPlan& written) {
  if (!plan.job.machine) return {};
  const std::string machine = plan.job.machine->name;
  return {{"limits",
           [&plan, &written, machine](FigureFormat format, const Progress& progress) {
             return limit_picture(plan.part().map, written.nodes, written.binding,
                                  fmt::format("What limits the motion (machine: {})", machine), format, progress);
           }},
          {"motion", [&written, machine](FigureFormat format, const Progress&) {
             return speed_picture(written.nodes,
                                  fmt::format("Motion of {} (machine: {})", written.program.file, machine), format);
           }}};
}

/// Where what the program leaves is uncertain; none where that is not asked for. The plan must outlive the result.
std::vector<PlanPicture> uncertainty_pictures(const WrittenPlan& written) {
  if (!written.uncertainty) return {};
  return {{"uncertainty", [&written](FigureFormat format, const Progress& progress) {
             const PlanUncertainty& u = *written.uncertainty;
             const std::string title = fmt::format("How far off what is left may be: RMS over {} samples ({})",
                                                   u.of.samples, to_string(u.of.unsure));
             return map_picture(u.drawn.deviation, {title, "nm", false, {}, {}}, format, progress);
           }}};
}

/// Both must outlive the result.
std::vector<PlanPicture> plan_pictures(const PlannedJob& plan, const WrittenPlan& written) {
  const Part& part = plan.part();
  const ToolPath& path = plan.laid.path;
  const std::string removed = to_string(part.form);
  const auto figure = std::make_shared<const HeightMap>(shown_figure(part));
  return {
      {"before",
       [&part, figure, removed](FigureFormat format, const Progress& progress) {
         const std::string title = fmt::format("Before: {} ({} removed)", in_words(part.before), removed);
         return map_picture(*figure, {title, "nm", true, {}, {}, &part.figure}, format, progress);
       }},
      {"after",
       [&plan, &part, &written, removed](FigureFormat format, const Progress& progress) {
         const std::string title =
             fmt::format("After (simulated program): {} ({} removed)", in_words(written.exact.statistics), removed);
         return after_picture(part.figure, written.shown(), plan.job.options.figure_range, title, format, progress,
                              &written.exact.surface);
       }},
      {"residual",
       [&written, removed](FigureFormat format, const Progress& progress) {
         const std::string title =
             fmt::format("What is left: {} ({} removed)", in_words(written.exact.statistics), removed);
         return residual_picture(written.shown(), written.anatomy, title, format, progress, &written.exact.surface);
       }},
      {"dwell",
       [&plan, &path](FigureFormat format, const Progress& progress) {
         const std::string title =
             fmt::format("Dwell: {}, total {:.4g} s", counted(path.size(), "point"), plan.dwell.seconds.sum());
         return dwell_picture(path, plan.program.table.dwell_s, {title, "s", false, {}, {}}, format, progress);
       }},
      {"path",
       [&plan, figure, &path](FigureFormat format, const Progress& progress) {
         const std::string title = fmt::format("Path: {}, {}, {:.4g} mm, {}", path.kind, counted(path.size(), "point"),
                                               plan.laid.metrics.length, counted(plan.laid.metrics.lifts, "lift"));
         return path_picture(*figure, path, title, format, progress);
       }},
      {"path_detail",
       [figure, &path](FigureFormat format, const Progress& progress) {
         return path_detail_picture(*figure, path, "Path, detail: " + path.kind, format, progress);
       }},
  };
}

}  // namespace

void write_plan_pictures(const PlannedJob& plan, const WrittenPlan& written, const OutputFolder& folder,
                         const Progress& progress) {
  std::vector<PlanPicture> pictures = plan_pictures(plan, written);
  for (PlanPicture& picture : motion_pictures(plan, written)) pictures.push_back(std::move(picture));
  for (PlanPicture& picture : uncertainty_pictures(written)) pictures.push_back(std::move(picture));
  run_side_by_side(plan.part().threads, progress, pictures.size(), [&](std::size_t k, const Progress& shared) {
    write_figure(folder, plan.job.options.figures, pictures[k].name,
                 [&](FigureFormat format) { return pictures[k].draw(format, shared); });
  });
}

}  // namespace dwell
