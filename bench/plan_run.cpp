#include "bench/plan_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bench/child.h"
#include "bench/mirror.h"
#include "bench/plan_cases.h"
#include "bench/scratch_folder.h"
#include "core/base/whole_file.h"
#include "core/formats/npy.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

constexpr double kRms = 100.0;  // [nm]

/// A map between whose pixels lie so many of a larger one, linear in between: a smooth surface of any size without the
/// transforms that a made-up one of that size takes.
HeightMap enlarge(const HeightMap& map, long size) {
  HeightMap large(Grid{size, size, 1.0, 1.0, {}});
  const double scale = static_cast<double>(map.grid.rows - 1) / static_cast<double>(size - 1);
  for (Index r = 0; r < size; ++r) {
    const double v = static_cast<double>(r) * scale;
    const Index i = std::min<Index>(static_cast<Index>(v), map.grid.rows - 2);
    const double fv = v - static_cast<double>(i);
    for (Index c = 0; c < size; ++c) {
      const double u = static_cast<double>(c) * scale;
      const Index j = std::min<Index>(static_cast<Index>(u), map.grid.cols - 2);
      const double fu = u - static_cast<double>(j);
      large.at(r, c) = (1.0 - fv) * ((1.0 - fu) * map.at(i, j) + fu * map.at(i, j + 1)) +
                       fv * ((1.0 - fu) * map.at(i + 1, j) + fu * map.at(i + 1, j + 1));
    }
  }
  return large;
}

/// Makes the map of a case, unless an earlier case had it made.
void make_map(const PlanCase& plan, const std::filesystem::path& folder) {
  const std::filesystem::path file = map_of(plan, folder);
  if (plan.size == 0 || std::filesystem::exists(file)) return;
  const long made = static_cast<long>(static_cast<double>(plan.size) / plan.enlarged);
  HeightMap map = noise_mirror(made, 0.1, kRms, 1);
  if (made != plan.size) map = enlarge(map, plan.size);
  write_whole_file(file, npy_bytes(map));
}

/// What the summary of a plan or a simulation states.
Json stated(const PlanCase& plan, const Json& summary) {
  const Json& anatomy = summary.at("anatomy");
  Json result{{"without_blemishes", anatomy.at("blemishes").contains("without")
                                        ? anatomy.at("blemishes").at("without").at("rms_nm")
                                        : Json()}};
  if (plan.simulates) {
    result["residual_rms"] = summary.at("program").at("residual_rms_nm");
    result["total_dwell"] = summary.at("program").at("total_s");
    return result;
  }
  result.update({{"points", summary.at("path").at("points")},
                 {"status", summary.at("solve").at("status")},
                 {"solver_seconds", summary.at("solve").at("wall_s")},
                 {"residual_rms", summary.at("program").at("residual_rms_nm")},
                 {"total_dwell", summary.at("dwell").at("total_s")},
                 {"step_rms", summary.at("dwell").at("step_rms_s")}});
  return result;
}

Json run_case(const PlanCase& plan, double limit, const std::filesystem::path& folder) {
  const std::filesystem::path out = folder / plan.name, words = folder / (plan.name + ".txt"),
                              json = folder / (plan.name + ".json");
  make_map(plan, folder);
  std::vector<std::string> arguments = plan.arguments;
  arguments.insert(arguments.end(), {"--threads", std::to_string(plan.threads)});
  if (plan.simulates) {
    arguments.push_back("--json=" + json.string());
  } else {
    arguments.insert(arguments.end(), {"--out", out.string()});
  }
  ChildOptions how{plan.threads, limit, words, plan.one_processor};
  how.interrupt_after = plan.interrupt_after;
  const ChildRun child = run_program(dwell_program(), arguments, how);
  if (plan.interrupt_after > 0.0) {
    std::filesystem::remove_all(out);
    if (child.interrupted_seconds > 0.0) return {{"to_exit_seconds", child.interrupted_seconds}};
    return {{"failed", fmt::format("done before it could be interrupted, after {:.2f} s", child.seconds)}};
  }
  constexpr int kLimitReached = 3;  // a finished plan, with a remark
  if (child.exit_code != 0 && child.exit_code != kLimitReached) {
    const std::string why = child.end == ChildEnd::Killed
                                ? fmt::format("not done after {:.0f} s", limit)
                                : "dwell " + plan.arguments.front() + ": " + last_line_of(words);
    return {{"failed", why}};
  }
  const Json summary = Json::parse(read_whole_file(plan.simulates ? json : out / "summary.json"));
  std::filesystem::remove_all(out);
  Json result = stated(plan, summary);
  result.update({{"seconds", child.seconds},
                 {"cpu_seconds", child.cpu_seconds},
                 {"peak_memory", child.peak_memory},
                 {"exit_code", child.exit_code}});
  return result;
}

std::string plan_in_words(const Json& result) {
  for (const char* why : {"failed", "skipped"}) {
    if (result.contains(why)) return fmt::format("{}: {}", why, result[why].get<std::string>());
  }
  if (result.contains("to_exit_seconds"))
    return fmt::format("ended {:.2f} s after the interrupt", result["to_exit_seconds"].get<double>());
  return fmt::format("{:.2f} s, {:.2f} GiB, RMS {:.4g} nm", result["seconds"].get<double>(),
                     result["peak_memory"].get<double>() / 0x1p30, result["residual_rms"].get<double>());
}

}  // namespace

std::filesystem::path dwell_program() { return DWELL_PROGRAM; }

Json run_plans(const PlanRunOptions& options, const Budget& budget, double share, Measurements& measurements) {
  const ScratchFolder scratch;
  const std::vector<PlanCase> cases = plan_cases(options, scratch.path());
  const std::filesystem::path udo = options.data / "udo-raster";
  if (std::filesystem::is_regular_file(udo / "map_nm.csv")) write_published_programs(udo, scratch.path());

  Json all = Json::array();
  for (const PlanCase& plan : cases) {
    const double limit = std::min(plan.longest, budget.left());
    Json result = budget.left(share) < 1.0
                      ? Json{{"skipped", "no time left"}}
                      : measurements.take("plans/" + plan.name, [&] { return run_case(plan, limit, scratch.path()); });
    result.update({{"name", plan.name}, {"what", plan.what}, {"size", plan.size}, {"threads", plan.threads}});
    fmt::print("{:7.1f} s  plan {:24} {} threads: {}\n", budget.spent(), plan.name, plan.threads,
               plan_in_words(result));
    std::fflush(stdout);
    all.push_back(std::move(result));
  }
  return all;
}

}  // namespace dwell::bench
