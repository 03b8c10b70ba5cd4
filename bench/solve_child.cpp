#include "bench/solve_child.h"

#include <fmt/format.h>

#include "bench/child.h"
#include "bench/scratch_folder.h"
#include "core/base/whole_file.h"

namespace dwell::bench {

nlohmann::json solve_in_child(const SolveRequest& r) {
  const ScratchFolder scratch;
  const std::filesystem::path out = scratch.path() / "solve.json";
  std::vector<std::string> arguments{"solve",
                                     "--scenario",
                                     r.scenario,
                                     "--solver",
                                     r.solver,
                                     "--threads",
                                     std::to_string(r.threads),
                                     "--max-seconds",
                                     fmt::format("{}", r.max_seconds),
                                     "--stop-gap",
                                     fmt::format("{}", r.stop_gap),
                                     "--gradient-tolerance",
                                     fmt::format("{}", r.gradient_tolerance),
                                     "--data",
                                     r.data.string(),
                                     "--references",
                                     r.references.string(),
                                     "--out",
                                     out.string()};
  if (r.to_certificate) arguments.emplace_back("--to-certificate");
  ChildOptions how{r.threads, r.wall_limit, {}};
  how.scratch = scratch.path();
  const ChildRun child = run_child(arguments, how);
  nlohmann::json run;
  if (child.end == ChildEnd::Done) {
    run = nlohmann::json::parse(read_whole_file(out));
  } else {
    const bool late = child.end == ChildEnd::Killed;
    run = {{late ? "late" : "failed", late ? "ended, as it did not look at the clock" : "the process failed"},
           {"max_seconds", r.max_seconds}};
  }
  run["process_seconds"] = child.seconds;
  return run;
}

}  // namespace dwell::bench
