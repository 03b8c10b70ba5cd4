// dwell-bench: measures the operators, the planner and the solvers.

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/results.h"
#include "core/errors.h"
#include "core/whole_file.h"

namespace dwell::bench {
namespace {

struct Options {
  bool quick = false;
  std::string out;
};

void micro(const Options& options) {
  MicroOptions micro;
  micro.quick = options.quick;
  nlohmann::json results = nlohmann::json::array();
  for (const MicroResult& r : run_micro(micro)) results.push_back(to_json(r));
  const nlohmann::json all{{"machine", to_json(this_machine())}, {"micro", results}};
  fmt::print("\n{}", micro_table(results));
  if (!options.out.empty()) write_whole_file(options.out, all.dump(1) + "\n");
}

int run(int argc, char** argv) {
  CLI::App app{"Measures the operators, the planner and the solvers of dwell."};
  app.require_subcommand(0, 1);
  Options options;
  CLI::App* micro_command = app.add_subcommand("micro", "operators against the bare FFTW pair; the planner");
  for (CLI::App* command : {&app, micro_command}) {
    command->add_flag("--quick", options.quick, "small sizes, short repetitions");
    command->add_option("--out", options.out, "write the results to this JSON file");
  }
  CLI11_PARSE(app, argc, argv);
  micro(options);
  return 0;
}

}  // namespace
}  // namespace dwell::bench

int main(int argc, char** argv) {
  try {
    return dwell::bench::run(argc, argv);
  } catch (const dwell::InputError& e) {
    fmt::print(stderr, "dwell-bench: {}\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "dwell-bench: internal fault: {}\n", e.what());
    return 1;
  }
}
