#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "cli/commands.h"
#include "cli/json_option.h"
#include "cli/memory.h"
#include "cli/out_of_memory.h"
#include "cli/progress_line.h"
#include "cli/quiet_threads.h"
#include "cli/standard_streams.h"
#include "cli/sudden_end.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "core/base/memory.h"
#include "core/base/time_limit.h"
#include "core/base/version.h"
#include "runs/job/option_flags.h"

namespace {

/// What is wrong with the words of the command line, and where help is.
std::string usage_message(const CLI::App* program, const CLI::Error& error) {
  const auto commands = program->get_subcommands();
  const std::string help = commands.empty() ? "dwell --help" : fmt::format("dwell {} --help", commands[0]->get_name());
  std::string what = error.what();
  const std::vector<std::string> words = program->remaining(true);
  const auto option = std::find_if(words.begin(), words.end(), [](const auto& w) { return w.starts_with("-"); });
  if (option != words.end()) {
    what = fmt::format("unknown option {}", *option);
  } else if (!words.empty()) {
    what = fmt::format("{} '{}' was not expected", commands.empty() ? "command" : "argument", words.front());
  }
  return fmt::format("dwell: {}; '{}' lists what is accepted\n", what, help);
}

int run(int argc, char** argv) {
  using namespace dwell::cli;
  CLI::App program{
      "Dwell-time optimisation for sub-aperture finishing of optics: height map and removal function to feed table."};
  program.set_version_flag("--version", std::string("dwell ") + dwell::version());
  program.require_subcommand(1);
  program.failure_message(usage_message);
  int exit_code = kDone;
  add_plan_command(program, exit_code);
  add_paths_command(program, exit_code);
  add_pareto_command(program, exit_code);
  add_simulate_command(program, exit_code);
  add_figure_command(program, exit_code);
  add_merge_command(program, exit_code);
  add_map_command(program, exit_code);
  add_profile_command(program, exit_code);
  add_tif_command(program, exit_code);
  add_machine_command(program, exit_code);
  add_example_command(program, exit_code);
  check_json_words({argv + 1, argv + argc});
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kBadInput;
  }
  return exit_code;
}

int fail(int exit_code, const char* prefix, const std::exception& error) {
  dwell::cli::finish_progress();
  dwell::cli::say(fmt::format("dwell: {}{}\n", prefix, error.what()));
  return exit_code;
}

constexpr const char* kNoThread =
    "no thread can be started: the limit of processes (ulimit -u) or of memory (ulimit -v) is too low, or the machine "
    "is "
    "full: ";

}  // namespace

int main(int argc, char** argv) {
  using namespace dwell::cli;
  hold_interrupts();
  start_with_quiet_threads(argv);
  hold_standard_streams();
  leave_nothing_at_a_sudden_end();
  try {
    catch_interrupts();
    keep_freed_memory();
    const int exit_code = run(argc, argv);
    const bool said = finish_output();
    ignore_interrupts();
    return said ? exit_code : kInternalFault;
  } catch (const dwell::InputError& error) {
    return fail(kBadInput, "", dwell::with_flags(error));
  } catch (const dwell::TimeLimitReached& error) {
    const std::string reason = dwell::with_option_names(error.what(), dwell::flag_of);
    return fail(kLimitReached, "limit reached: ", std::runtime_error(reason + "; nothing was written"));
  } catch (const dwell::Interrupted&) {
    say_interrupted();
    return kInterrupted;
  } catch (const dwell::OutOfMemory& error) {
    return fail(kInternalFault, "", error);
  } catch (const std::bad_alloc&) {
    return fail(kInternalFault, "", std::runtime_error(out_of_memory_message()));
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(kInternalFault, "internal fault: ", error);
  } catch (const std::system_error& error) {
    const bool lacking = error.code() == std::errc::resource_unavailable_try_again;  // of a thread
    return fail(kInternalFault, lacking ? kNoThread : "internal fault: ", error);
  } catch (const std::exception& error) {
    return fail(kInternalFault, "internal fault: ", error);
  }
}
