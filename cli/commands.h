#pragma once

#include <CLI/CLI.hpp>

namespace dwell::cli {

/// Each function adds its subcommand to the program; when the command has run, its exit code is in `exit_code`.
void add_plan_command(CLI::App& program, int& exit_code);
void add_paths_command(CLI::App& program, int& exit_code);
void add_pareto_command(CLI::App& program, int& exit_code);
void add_simulate_command(CLI::App& program, int& exit_code);
void add_map_command(CLI::App& program, int& exit_code);
void add_profile_command(CLI::App& program, int& exit_code);
void add_tif_command(CLI::App& program, int& exit_code);
void add_machine_command(CLI::App& program, int& exit_code);
/// Its subcommand `fit`.
void add_machine_fit_command(CLI::App& machine, int& exit_code);
void add_figure_command(CLI::App& program, int& exit_code);
/// Its subcommands `status`, `check`, `withdraw`.
void add_figure_record_commands(CLI::App& figure, int& exit_code);
/// Its subcommand `simulate`.
void add_figure_simulate_command(CLI::App& figure, int& exit_code);
void add_merge_command(CLI::App& program, int& exit_code);
void add_example_command(CLI::App& program, int& exit_code);

}  // namespace dwell::cli
