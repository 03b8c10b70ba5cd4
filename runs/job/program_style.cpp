#include "runs/job/program_style.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "paths/feed/exported_motion.h"
#include "runs/programs/frame_text.h"

namespace dwell {
namespace {

/// What the preamble says of corners. A machine that stops at them does so by its own rule or by G61, one that blends
/// them by G64 with its tolerance; of others no path mode is what they do. A plan for a machine that blends forbids
/// that rows of moves are merged (Q0), which it does not consider.
std::optional<PathMode> path_mode_to_write(const PathModeOption& option, const std::optional<NamedMachine>& machine) {
  switch (option.choice) {
    case PathModeOption::Choice::Given: {
      PathMode mode = option.mode;
      if (machine && mode.kind == PathMode::Kind::Blended && mode.tolerance_mm) mode.merging_mm = 0.0;
      return mode;
    }
    case PathModeOption::Choice::None:
      return std::nullopt;
    case PathModeOption::Choice::Auto:
      break;
  }
  if (machine && machine->machine.corner == CornerRule::ExactStop) return PathMode{PathMode::Kind::ExactPath, {}, {}};
  if (machine && machine->machine.corner == CornerRule::Blend)
    return PathMode{PathMode::Kind::Blended, machine->machine.blend_tolerance, 0.0};
  return std::nullopt;
}

void check_path_mode_of_machine(const PathModeOption& option, const Machine& machine) {
  if (option.choice != PathModeOption::Choice::Given) return;
  if (option.mode.kind == PathMode::Kind::Blended && !option.mode.tolerance_mm && machine.corner != CornerRule::Blend) {
    throw InputError(fmt::format(
        "--path-mode {} with --machine: how far from corners the controller rounds them (G64) is neither in the "
        "program "
        "nor in the machine file, so that its motion cannot be planned; required --path-mode blend:TOLERANCE_MM, or a "
        "machine with the corner rule blend",
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
  if (options.path_mode.choice != PathModeOption::Choice::Given) return placed;
  const PathMode& mode = options.path_mode.mode;
  placed.corner = mode.kind == PathMode::Kind::Blended ? CornerRule::Blend : CornerRule::ExactStop;  // G64, G61
  if (mode.tolerance_mm) placed.blend_tolerance = *mode.tolerance_mm;
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
  if (machine) check_path_mode_of_machine(options.path_mode, machine->machine);
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
