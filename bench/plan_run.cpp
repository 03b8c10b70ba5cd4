#include "bench/plan_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bench/child.h"
#include "bench/mirror.h"
#include "bench/scratch_folder.h"
#include "core/base/whole_file.h"
#include "core/formats/npy.h"

namespace dwell::bench {
namespace {

constexpr double kPitch = 0.1;    // [mm]
constexpr double kRms = 100.0;    // [nm]
constexpr long kSmallSize = 512;  // [pixels]

struct PlanCase {
  std::string name, what;
  long size = 0;  // edge of the map [pixels]; 0 = not a made-up one
  std::vector<std::string> arguments;
  int threads = 2;
  bool one_processor = false;
};

/// The square mirror of the scenarios, as files: tool of sigma = size / 50 pixels, dwell at every 4th pixel and up to
/// two sigma beyond.
PlanCase square_case(long size, const std::string& motion, const std::filesystem::path& map) {
  const double sigma = static_cast<double>(size) / 50.0 * kPitch;
  const bool halts = motion == "stop";
  return {fmt::format("{}-every-4-{}", size, motion),
          fmt::format("square mirror {0} x {0}, every 4th pixel, the tool {1}", size, halts ? "halts" : "runs through"),
          size,
          {"--map", map.string(), "--map-pixel", fmt::format("{}", kPitch), "--tif",
           fmt::format("gaussian:peak=1,sigma={0},radius={1}", sigma, 3.5 * sigma), "--path",
           fmt::format("raster:pitch={0},step={0},overrun={1}", 4.0 * kPitch, 2.0 * sigma), "--motion", motion}};
}

/// The settings under which the published dwell is beaten on every axis.
PlanCase udo_case(const std::filesystem::path& folder) {
  return {"udo-raster",
          "measured mirror, measured spot, published raster",
          0,
          {"--map", (folder / "map_nm.csv").string(), "--map-pixel", "0.09383299999999997", "--tif",
           (folder / "tif_nm_per_s.csv").string(), "--tif-pixel", "0.09383299766341224", "--path",
           "file:" + (folder / "path_and_published_dwell.csv").string(), "--min-dwell", "0.1", "--time-price", "5e-6"}};
}

/// A plan on one processor, with so many threads.
PlanCase one_processor_case(int threads, const std::filesystem::path& map) {
  PlanCase plan = square_case(kSmallSize, "moving", map);
  plan.name = fmt::format("one-processor-{}-thread{}", threads, threads == 1 ? "" : "s");
  plan.what += ", on one processor";
  plan.threads = threads;
  plan.one_processor = true;
  return plan;
}

/// The last line that a failed program printed.
std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

nlohmann::json run_case(const PlanCase& plan, double limit, const std::filesystem::path& folder) {
  const std::filesystem::path out = folder / plan.name, words = folder / (plan.name + ".txt");
  std::vector<std::string> arguments{"plan"};
  arguments.insert(arguments.end(), plan.arguments.begin(), plan.arguments.end());
  for (const std::string& word :
       {std::string("--threads"), std::to_string(plan.threads), std::string("--out"), out.string()})
    arguments.push_back(word);
  const ChildRun child = run_program(DWELL_PROGRAM, arguments, {plan.threads, limit, words, plan.one_processor});
  constexpr int kLimitReached = 3;  // a finished plan, with a remark
  if (child.exit_code != 0 && child.exit_code != kLimitReached) {
    const std::string why = child.end == ChildEnd::Killed ? fmt::format("not done after {:.0f} s", limit)
                                                          : "dwell plan: " + last_line(read_whole_file(words));
    return {{"failed", why}};
  }
  const auto summary = nlohmann::json::parse(read_whole_file(out / "summary.json"));
  std::filesystem::remove_all(out);
  return {{"seconds", child.seconds},
          {"cpu_seconds", child.cpu_seconds},
          {"peak_memory", child.peak_memory},
          {"exit_code", child.exit_code},
          {"points", summary.at("path").at("points")},
          {"status", summary.at("solve").at("status")},
          {"solver_seconds", summary.at("solve").at("wall_s")},
          {"residual_rms", summary.at("program").at("residual_rms_nm")},
          {"total_dwell", summary.at("dwell").at("total_s")},
          {"step_rms", summary.at("dwell").at("step_rms_s")}};
}

std::string plan_in_words(const nlohmann::json& result) {
  for (const char* why : {"failed", "skipped"}) {
    if (result.contains(why)) return fmt::format("{}: {}", why, result[why].get<std::string>());
  }
  return fmt::format("{:.2f} s, {:.2f} GiB, solver {:.2f} s", result["seconds"].get<double>(),
                     result["peak_memory"].get<double>() / 0x1p30, result["solver_seconds"].get<double>());
}

}  // namespace

nlohmann::json run_plans(const PlanRunOptions& options, const Budget& budget) {
  const ScratchFolder scratch;
  const std::filesystem::path map = scratch.path() / "map.npy", small = scratch.path() / "small.npy",
                              udo = options.data / "udo-raster";
  std::vector<PlanCase> cases{square_case(options.size, "stop", map), square_case(options.size, "moving", map)};
  for (PlanCase& plan : cases) plan.threads = options.threads;
  if (std::filesystem::is_regular_file(udo / "map_nm.csv")) cases.push_back(udo_case(udo));
  for (const int threads : {1, 2}) cases.push_back(one_processor_case(threads, small));
  write_whole_file(map, npy_bytes(noise_mirror(options.size, kPitch, kRms, 1)));
  write_whole_file(small, npy_bytes(noise_mirror(kSmallSize, kPitch, kRms, 1)));

  nlohmann::json all = nlohmann::json::array();
  for (const PlanCase& plan : cases) {
    const double limit = std::min(options.longest, budget.left());
    nlohmann::json result =
        limit < 1.0 ? nlohmann::json{{"skipped", "no time left"}} : run_case(plan, limit, scratch.path());
    result.update({{"name", plan.name}, {"what", plan.what}, {"size", plan.size}, {"threads", plan.threads}});
    fmt::print("{:7.1f} s  plan {:20} {} threads: {}\n", budget.spent(), plan.name, plan.threads,
               plan_in_words(result));
    std::fflush(stdout);
    all.push_back(std::move(result));
  }
  return all;
}

}  // namespace dwell::bench
