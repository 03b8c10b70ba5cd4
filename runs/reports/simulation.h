#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/anatomy/residual_anatomy.h"
#include "core/base/progress.h"
#include "core/form/map_statistics.h"
#include "core/motion/program.h"
#include "core/removal/exact_residual.h"
#include "core/tif/removal_kernel.h"
#include "paths/feed/lift_rests.h"
#include "paths/feed/motion_nodes.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/base/input_file.h"
#include "runs/base/json_blocks.h"
#include "runs/job/job_options.h"
#include "runs/job/learnt_files.h"
#include "runs/machine/machine_file.h"
#include "runs/programs/gcode_reading.h"
#include "runs/reports/counted_figures.h"
#include "runs/reports/program_record.h"
#include "runs/reports/recorded_run.h"

namespace dwell {

/// Where a simulation's options come from, and what may be other than when the program was made.
struct SimulationSource {
  std::string plan;                     // folder of the plan whose options these are; empty: the program stands alone
  std::vector<std::string> given;       // a sentence for each option that is given in the place of the plan's
  OtherInputs other;                    // inputs that are meant to be others than the program's header says
  std::optional<LogSource> log;         // of a run of the program
  std::optional<LearntFiles> learnt{};  // of the plan's folder, where program and machine are the plan's
};

/// What a program would leave if every move had its commanded speed from end to end.
struct CommandedMotion {
  MapStatistics residual;
  double run_seconds = 0.0;
};

/// The machine on which a program is executed, and what its motion makes of the program.
struct ExecutedProgram {
  NamedMachine machine;
  CommandedMotion commanded;
  double run_seconds = 0.0;     // of the motion, lifted moves included
  double removal_change = 0.0;  // RMS of the executed removal less the commanded one, form terms removed [nm]
  std::size_t slow_steps = 0;   // removing steps that take more than 1 % longer than commanded
  std::size_t removing_steps = 0;
  int logs = 0;                   // whose lessons are in the motion
  double max_acceleration = 0.0;  // along the path, at work [mm/s^2]
  LiftTotals lifts{};             // the machine's rests at them
};

/// The effect of a program on disk on a map.
struct Simulation {
  std::vector<InputFile> inputs;
  Program program;
  std::optional<double> max_feed;  // [mm/s] of rapids, where a plan says it
  FormTerms terms;
  MapFigures map;  // as it was before the run, for the summary
  RemovalFunction tif;
  double volume_factor = 1.0;  // of its kernel
  MapStatistics before;
  ExactResidual after;                      // of the motion, where there is a machine; of the pixels that count
  HeightMap beside;                         // its surface with those that do not count; empty if all do [nm]
  std::optional<CountedFigures> counted;    // where some count less than others, or not at all
  std::optional<ExecutedProgram> executed;  // on a machine
  std::optional<RecordedRun> recorded;      // by a controller
  std::vector<MotionNode> nodes;            // of its motion, where they are wanted
  ResidualAnatomy anatomy;                  // of what it leaves
  std::string advice;                       // what would help most, a sentence
  std::vector<SurfaceVerdict> acceptance;   // how it stands to the job's limits
  std::string plan;                         // as SimulationSource
  std::vector<std::string> differences;     // from the plan that the program was made by, a sentence each
  std::vector<std::string> limits;          // that were reached, a sentence each

  /// What is left, to be shown [nm].
  const HeightMap& shown() const { return beside.values.empty() ? after.surface : beside; }
};

/// Simulates a program file (feed.csv or G-code) on the job's map with the job's removal function; the tool moves
/// continuously, at the commanded speeds or, with a machine, as that executes the program. With a log of a run, what
/// the recorded motion leaves stands beside it (recorded_run). `every_pixel`: the exact figure from every pixel
/// (exact_residual), which takes longer. `keep_nodes`: with a machine, keeps the nodes of its motion. `reading`: for
/// G-code that leaves something to its controller. Of the job it uses map, tif, remove, apertures, weight, accept and
/// threads. Map and removal function are held to what the program's header says of them (program_record.h). Throws
/// InputError, Interrupted.
Simulation simulate_file(const std::filesystem::path& program, const GcodeReading& reading, const JobOptions& options,
                         const Progress& progress, bool every_pixel = false, const SimulationSource& source = {},
                         bool keep_nodes = false);

/// The simulation as JSON text (docs/json.md), units in the keys.
std::string simulation_json(const Simulation& simulation);

}  // namespace dwell
