#include "bench/plan_cases.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>
#include <system_error>

#include "core/base/text_lines.h"
#include "core/base/whole_file.h"
#include "paths/path_file.h"
#include "runs/programs/feed_table.h"

namespace dwell::bench {
namespace {

constexpr long kSmallSize = 512;  // [pixels]
constexpr double kFastFeed = 3000.0;

std::string runs_or_halts(const std::string& motion) {
  return motion == "stop" ? "the tool halts" : "the tool runs through";
}

std::string file_of(long size, const std::filesystem::path& folder) {
  return (folder / fmt::format("map{}.npy", size)).string();
}

/// A square mirror of the scenarios, as files: pixels of `pitch` mm, a Gaussian tool of `sigma` pixels, dwell at every
/// `step`-th pixel and up to two sigma beyond.
PlanCase square_case(long size, double pitch, double sigma, long step, const std::string& motion,
                     const std::filesystem::path& folder) {
  const double width = sigma * pitch, spacing = static_cast<double>(step) * pitch;
  PlanCase plan;
  plan.size = size;
  plan.arguments = {"plan",
                    "--map",
                    file_of(size, folder),
                    "--map-pixel",
                    fmt::format("{}", pitch),
                    "--tif",
                    fmt::format("gaussian:peak=1,sigma={0},radius={1}", width, 3.5 * width),
                    "--path",
                    fmt::format("raster:pitch={0},step={0},overrun={1}", spacing, 2.0 * width),
                    "--motion",
                    motion};
  return plan;
}

/// The large problem with a narrow tool.
PlanCase narrow_tool(long size, int threads, const std::filesystem::path& folder) {
  PlanCase plan = square_case(size, 1.0, 17.0, 4, "moving", folder);
  plan.name = fmt::format("{}-narrow-moving{}", size, threads == 1 ? "-1-thread" : "");
  plan.what = fmt::format(
      "{0} x {0} pixels of 1 mm, tool of sigma 17 pixels, raster of 4 x 4 pixels, the tool runs through", size);
  plan.threads = threads;
  return plan;
}

/// The large problem with a wide tool, a fiftieth of the map.
PlanCase wide_tool(long size, const std::string& motion, int threads, const std::filesystem::path& folder) {
  const double sigma = static_cast<double>(size) / 50.0;
  PlanCase plan = square_case(size, 0.1, sigma, 4, motion, folder);
  plan.name = fmt::format("{}-wide-{}{}", size, motion, threads == 1 ? "-1-thread" : "");
  plan.what = fmt::format("{0} x {0} pixels, tool of sigma {1:.0f} pixels, every 4th pixel, {2}", size, sigma,
                          runs_or_halts(motion));
  plan.threads = threads;
  return plan;
}

/// The largest map that a workshop would plan in one piece.
PlanCase largest_map(const std::filesystem::path& folder) {
  constexpr long kSize = 16384;
  PlanCase plan = square_case(kSize, 0.1, 328.0, 16, "moving", folder);
  plan.name = fmt::format("{}-every-16", kSize);
  plan.what = fmt::format("{0} x {0} pixels, tool of sigma 328 pixels, every 16th pixel, the tool runs through", kSize);
  plan.enlarged = 4.0;
  plan.longest = 1200.0;
  return plan;
}

/// A plan on one processor, with so many threads.
PlanCase one_processor_case(int threads, const std::filesystem::path& folder) {
  PlanCase plan = wide_tool(kSmallSize, "moving", threads, folder);
  plan.name = fmt::format("one-processor-{}-thread{}", threads, threads == 1 ? "" : "s");
  plan.what += ", on one processor";
  plan.one_processor = true;
  return plan;
}

PlanCase interrupted_case(long size, double after, const std::filesystem::path& folder) {
  PlanCase plan = wide_tool(size, "moving", 2, folder);
  plan.name = fmt::format("{}-interrupted", size);
  plan.what = fmt::format("{0} x {0} pixels, every 4th pixel, interrupted after {1:g} s", size, after);
  plan.interrupt_after = after;
  return plan;
}

std::vector<std::string> udo_part(const std::filesystem::path& udo) {
  return {"--map", (udo / "map_nm.csv").string(),       "--map-pixel", "0.09383299999999997",
          "--tif", (udo / "tif_nm_per_s.csv").string(), "--tif-pixel", "0.09383299766341224"};
}

/// A plan of udo-raster along the published path.
PlanCase udo_plan(const std::string& name, const std::string& what, const std::filesystem::path& udo,
                  const std::vector<std::string>& more) {
  PlanCase plan{name, what, 0, 1.0, {"plan"}};
  for (const std::string& word : udo_part(udo)) plan.arguments.push_back(word);
  for (const std::string& word : {std::string("--path"), "file:" + (udo / "path_and_published_dwell.csv").string(),
                                  std::string("--min-dwell"), std::string("0.1")})
    plan.arguments.push_back(word);
  plan.arguments.insert(plan.arguments.end(), more.begin(), more.end());
  return plan;
}

/// The published dwell, simulated.
PlanCase udo_published(const std::string& motion, const std::filesystem::path& udo,
                       const std::filesystem::path& folder) {
  PlanCase plan{"udo-published-" + motion, "the published dwell, " + runs_or_halts(motion), 0, 1.0, {"simulate"}};
  for (const std::string& word : udo_part(udo)) plan.arguments.push_back(word);
  plan.arguments.insert(plan.arguments.end(), {"--program", (folder / ("published-" + motion + ".csv")).string()});
  plan.simulates = true;
  return plan;
}

/// The third column of the published file.
std::vector<double> published_dwell(const std::filesystem::path& file) {
  const std::string text = read_whole_file(file);
  std::vector<double> dwell;
  bool title = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    if (title || line.empty()) {
      title = false;
      continue;
    }
    const std::size_t comma = line.rfind(',');
    double value = 0.0;
    const auto read = std::from_chars(line.data() + comma + 1, line.data() + line.size(), value);
    if (comma == std::string::npos || read.ec != std::errc() || !(value >= 0.0))
      throw std::runtime_error(fmt::format("{}: '{}' does not end in a dwell of 0 s or more", file.string(), line));
    dwell.push_back(value);
  }
  return dwell;
}

}  // namespace

std::filesystem::path map_of(const PlanCase& plan, const std::filesystem::path& folder) {
  return file_of(plan.size, folder);
}

void write_published_programs(const std::filesystem::path& udo, const std::filesystem::path& folder) {
  const std::filesystem::path file = udo / "path_and_published_dwell.csv";
  const ToolPath path = read_path_file(file);
  const std::vector<double> dwell = published_dwell(file);
  // Halts: moves so fast that they remove nothing, since those who published the dwell count none.
  constexpr double kInstant = 1e7;
  write_whole_file(folder / "published-stop.csv", feed_table_text(feed_table_of(path, dwell, Motion::Stop, kInstant)));
  write_whole_file(folder / "published-moving.csv",
                   feed_table_text(feed_table_of(path, dwell, Motion::Moving, kFastFeed)));
}

std::vector<PlanCase> plan_cases(const PlanRunOptions& options, const std::filesystem::path& folder) {
  const bool quick = options.extent == Extent::Quick;
  const long size = options.size > 0 ? options.size : quick ? 1024 : 4096;
  std::vector<PlanCase> cases{narrow_tool(size, 2, folder), wide_tool(size, "stop", 2, folder),
                              wide_tool(size, "moving", 2, folder)};
  const std::filesystem::path udo = options.data / "udo-raster";
  if (std::filesystem::is_regular_file(udo / "map_nm.csv")) {
    // The settings under which the published dwell is beaten on every axis.
    cases.push_back(udo_plan("udo-raster", "measured mirror, measured spot, published raster, price 5e-6 nm^2/s", udo,
                             {"--time-price", "5e-6"}));
    cases.push_back(udo_plan("udo-default", "the same with default options", udo, {}));
    cases.push_back(
        udo_plan("udo-leave-out", "the same, blemishes left out of the fit", udo, {"--blemishes", "leave-out"}));
    for (const char* motion : {"stop", "moving"}) cases.push_back(udo_published(motion, udo, folder));
  }
  for (const int threads : {1, 2}) cases.push_back(one_processor_case(threads, folder));
  cases.push_back(interrupted_case(size, quick ? 0.5 : 5.0, folder));
  if (!quick) {
    cases.push_back(narrow_tool(size, 1, folder));
    cases.push_back(wide_tool(size, "moving", 1, folder));
  }
  for (PlanCase& plan : cases) plan.longest = quick ? 20.0 : options.extent == Extent::Full ? 300.0 : 60.0;
  if (options.extent == Extent::Full) cases.push_back(largest_map(folder));
  return cases;
}

}  // namespace dwell::bench
