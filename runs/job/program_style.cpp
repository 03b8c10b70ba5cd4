#include "runs/job/program_style.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "paths/feed/exported_motion.h"
#include "runs/programs/frame_text.h"

namespace dwell {
namespace {

/// What the preamble says of corners. A machine that stops at them does so by its own rule or by G61; of others no path
/// mode is what they do.
std::optional<PathMode> path_mode_to_write(const PathModeOption& option, const std::optional<NamedMachine>& machine) {
  switch (option.choice) {
    case PathModeOption::Choice::Given:
      return option.mode;
    case PathModeOption::Choice::None:
      return std::nullopt;
    case PathModeOption::Choice::Auto:
      break;
  }
  const bool stops = machine && machine->machine.corner == CornerRule::ExactStop;
  return stops ? std::optional(PathMode{PathMode::Kind::ExactPath, {}, {}}) : std::nullopt;
}

void check_path_mode_of_machine(const PathModeOption& option) {
  if (option.choice != PathModeOption::Choice::Given) return;
  if (option.mode.kind == PathMode::Kind::Blended) {
    throw InputError(fmt::format(
        "--path-mode {} with --machine: where the controller rounds corners (G64) is not in the program, so "
        "that its motion cannot be planned; required --path-mode exact-path, none or auto, or no --machine",
        to_string(option)));
  }
  if (option.mode.kind == PathMode::Kind::ExactStop) {
    throw InputError(
        "--path-mode exact-stop with --machine: the machine would rest at the end of every move (G61.1), for which no "
        "plan is made; required --path-mode exact-path, none or auto, or no --machine");
  }
}

}  // namespace

ProgramFrame program_frame(const JobOptions& options) {
  return rounded_frame(options.zero_mm, options.rotate_deg, options.swap_axes);
}

Machine machine_for_program(const Machine& machine, const JobOptions& options) {
  Machine placed = machine;
  placed.frame = program_frame(options);
  if (options.schedule != ScheduleKind::Constant) {  // a move with a speed at its middle is two blocks
    placed.corner_delay = listed_corner_delay(machine);
    placed.controller.max_blocks_per_s *= 0.5;
  }
  if (options.path_mode.choice == PathModeOption::Choice::Given) placed.corner = CornerRule::ExactStop;  // G61
  return placed;
}

GcodeStyle gcode_style(const JobOptions& options, const std::optional<NamedMachine>& machine, const GcodeInsert& before,
                       const GcodeInsert& after) {
  return {
      path_mode_to_write(options.path_mode, machine), options.inches, options.block_numbers, before.lines, after.lines,
      static_cast<std::size_t>(options.max_lines)};
}

void check_program_style(const JobOptions& options, const std::optional<NamedMachine>& machine,
                         const GcodeInsert& before, const GcodeInsert& after) {
  if (machine) check_path_mode_of_machine(options.path_mode);
  GcodeOptions gcode;
  gcode.dialect = options.gcode;
  gcode.lift_height_mm = options.lift_height_mm;
  gcode.max_feed_mm_per_min = options.max_feed_mm_per_min;
  gcode.style = gcode_style(options, machine, {}, {});
  if (machine) gcode.machine = machine->machine;
  check_gcode_inserts(before, after, gcode, machine.has_value());
}

JobOptions without_program_style(JobOptions options) {
  const JobOptions defaults;
  options.path_mode = defaults.path_mode;
  options.header = defaults.header;
  options.footer = defaults.footer;
  options.block_numbers = defaults.block_numbers;
  options.max_lines = defaults.max_lines;
  options.zero_mm = defaults.zero_mm;
  options.rotate_deg = defaults.rotate_deg;
  options.swap_axes = defaults.swap_axes;
  options.inches = defaults.inches;
  options.program_template = defaults.program_template;
  return options;
}

}  // namespace dwell
