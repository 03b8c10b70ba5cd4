#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <exception>

#include "cli/commands.h"
#include "cli/terminal.h"
#include "core/errors.h"
#include "core/version.h"

namespace {

int run(int argc, char** argv) {
  using namespace dwell::cli;
  CLI::App program{
      "Dwell-time optimisation for sub-aperture finishing of optics: height map and removal function to feed table."};
  program.set_version_flag("--version", std::string("dwell ") + dwell::version());
  program.require_subcommand(1);
  int exit_code = kDone;
  add_plan_command(program, exit_code);
  add_simulate_command(program, exit_code);
  add_map_command(program, exit_code);
  add_example_command(program, exit_code);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kBadInput;
  }
  return exit_code;
}

int fail(int exit_code, const char* prefix, const std::exception& error) {
  dwell::cli::finish_progress();
  fmt::print(stderr, "dwell: {}{}\n", prefix, error.what());
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace dwell::cli;
  catch_interrupts();
  try {
    return run(argc, argv);
  } catch (const dwell::InputError& error) {
    return fail(kBadInput, "", error);
  } catch (const dwell::Interrupted& error) {
    return fail(kInterrupted, "", error);
  } catch (const std::exception& error) {
    return fail(kInternalFault, "internal fault: ", error);
  }
}
