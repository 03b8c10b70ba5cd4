#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/point.h"
#include "core/form/form_terms.h"
#include "core/formats/map_rows.h"
#include "core/formats/matrix_table.h"
#include "core/formats/no_data.h"
#include "core/map/aperture.h"
#include "core/map/scattered_surface.h"
#include "core/motion/motion.h"
#include "core/tif/removal_function.h"
#include "core/tif/removal_orientation.h"
#include "core/tif/tif_pedestal.h"
#include "paths/feed/schedule_kind.h"
#include "paths/path_catalogue.h"
#include "runs/drawing/figure_format.h"
#include "runs/plan/blemish_handling.h"
#include "runs/plan/fit_objective.h"
#include "runs/plan/sampled_uncertainty.h"
#include "runs/programs/gcode_dialect.h"
#include "runs/programs/path_mode_option.h"
#include "solvers/problem/dwell_solver.h"
#include "solvers/weights/time_worth.h"
#include "solvers/weights/weight_goal.h"

namespace dwell {

/// What a plan is made from, in the user's own units, each option as the value it stands for. One table of records
/// (job_option_table) feeds the command line, the job file, the validation and the help text; defaults are those below.
struct JobOptions {
  std::string map;
  std::string removal;                  // file of depths to remove, in place of the map; empty: none
  std::optional<double> piston_nm;      // added to the heights, no level being free; nothing: the map's level
  std::optional<Point> map_pixel_mm;    // in x and y
  std::string map_unit;                 // empty: as the file says, else nm
  std::optional<double> wavelength_nm;  // of heights in waves
  std::optional<double> wave_scale;     // height of the surface for each wave, or for each nm of path difference
  std::optional<Point> map_origin_mm;
  std::optional<NoDataMarkers> map_no_data;
  std::optional<double> map_max_pv_mm;  // nothing: 10 mm
  std::optional<MatrixTable> map_table;
  std::optional<MapRows> map_rows;  // nothing: as the format says
  std::optional<ScatterOptions> map_grid;
  std::string map_steps;
  std::string line_profile;                   // in the place of a map; empty: none
  std::string profile_columns, profile_unit;  // empty: as its header says
  std::string profile_remove = "piston,tilt";
  std::optional<double> line_width_mm;  // nothing: one row of pixels
  std::optional<double> max_pixels;     // nothing: kMaxPixels, and no file that unpacks to many times its size
  std::string tif;
  std::optional<Point> tif_pixel_mm;
  std::string tif_unit;  // empty: as the file says, else nm/s
  std::optional<NoDataMarkers> tif_no_data;
  std::optional<MatrixTable> tif_table;
  std::optional<MapRows> tif_rows;
  std::optional<ScatterOptions> tif_grid;
  std::string tif_steps;
  std::optional<TifPedestal> tif_pedestal;  // nothing: not answered
  std::optional<double> tif_dwell_time_s;
  std::optional<TifCentre> tif_centre;  // nothing: as the file says
  double tif_angle_deg = 0.0;
  ToolOrientation::Flip tif_flip = ToolOrientation::Flip::None;
  double tif_rate = 1.0, tif_width = 1.0;  // over those of the file or the formula
  PathSpec path;
  std::string tools;     // several that work together (tool_spec.h), one a line; empty: the one above
  std::string keep_out;  // areas that the tool does not enter while it is down: AREA;AREA;...
  Motion motion = Motion::Moving;
  FormTerms remove{true, true};
  bool remove_given = false;  // else form_terms says what holds
  double fraction = 1.0;      // of the error that a plan removes
  Aperture aperture;
  std::string accept;       // limits of the surface that is left (surface_limits.h); empty: none
  Aperture clear_aperture;  // of the map within the aperture
  std::string weight;       // of pixels: TERM;TERM;...; empty: all the same
  FitObjective objective;
  std::optional<SampledUncertainty> uncertainty;  // of the plan; nothing: not asked for
  bool robust_plan = false;                       // the residual that is expected under it is made small
  double min_dwell_s = 0.0;
  double max_feed_mm_per_min = 3000.0;
  WeightGoal smoothness{0.0, GoalKind::Auto};
  WeightGoal time_price_nm2_per_s{0.0, GoalKind::Auto};
  TimeWorth time_worth;
  std::string machine;  // file of the machine; empty: accelerations and corners are not considered
  ScheduleKind schedule = ScheduleKind::Constant;  // how the program for the machine says its speeds
  int rounds = 20;                                 // of correction for its motion, at most
  std::string log;  // of a controller, of a run of the program in the folder log_plan; empty: none
  std::string log_plan;
  std::string log_columns;             // empty: by their names
  std::optional<double> log_period_s;  // nothing: the log holds the time
  double log_tolerance_mm = 0.1;
  double certify = 0.0;  // share by which the objective may be above the optimum, to be proven; 0 = not asked for
  SolverKind solver = SolverKind::Auto;
  BlemishHandling blemishes = BlemishHandling::Report;
  double max_solve_s = 3600.0;
  int threads = 0;
  GcodeDialect gcode = GcodeDialect::G94;
  double lift_height_mm = 10.0;
  std::vector<std::string> exports;  // formats besides feed.csv and program.nc, by their words
  std::string program_template;      // file or name of a layout of programs; empty: none
  PathModeOption path_mode;
  std::string header, footer;  // files with lines of G-code; empty: none
  int block_numbers = 0;       // step; 0: none
  int max_lines = 0;           // of a file of G-code; 0: any
  Point zero_mm;               // of the part, at the origin of program.nc
  double rotate_deg = 0.0;
  bool swap_axes = false;
  bool inches = false;  // in program.nc
  std::vector<FigureFormat> figures{FigureFormat::Png};
  FigureRange figure_range = FigureRange::Shared;
  std::string out;
  std::vector<std::string> notes;  // what the reader of a job file has to say of it, a sentence each; no option
};

/// One option: how the command line, the job file and messages know it.
struct JobOptionRecord {
  std::string flag;   // "max-feed": --max-feed on the command line
  std::string key;    // "max_feed_mm_per_min": field of the job file
  std::string value;  // what stands for the value in help: "MM/MIN"
  std::string help;   // one line, without the default
  bool is_file;       // a job file's value is relative to the job file's folder
  bool is_number;     // written without quotes in a job file
  /// Sets the option from text; throws InputError with the reason, not naming the option.
  void (*set)(JobOptions&, const std::string&);
  /// The value as text; empty = not given.
  std::string (*get)(const JobOptions&);
  /// A number may also be left open by words, which stand in quotes in a job file.
  bool takes_words = false;
  /// A job file may give the parts, which semicolons separate, as a list of strings.
  bool takes_list = false;
  /// What an option means on the command line that stands there without a value; empty: it needs one.
  std::string alone = {};
  /// May be given several times; the texts are lines of one then, and strings or tables of a list in a job file.
  bool repeats = false;
};

const std::vector<JobOptionRecord>& job_option_table();

/// The file of the surface that is worked: the map, or the removal in its place. Throws InputError if both are given,
/// or neither is.
const std::string& surface_file(const JobOptions& options);

/// The form terms that do not count. Where they are not given: none of a removal, and no piston if that is given.
/// Throws InputError for a piston that is given and does not count.
FormTerms form_terms(const JobOptions& options);

/// The part of the table about what the fit counts.
std::vector<JobOptionRecord> fit_option_records();

/// The part of the table about how program.nc is written.
std::vector<JobOptionRecord> program_option_records();

/// The part about several tools.
std::vector<JobOptionRecord> tool_option_records();

/// The part about a line profile in the place of a map.
std::vector<JobOptionRecord> profile_option_records();

/// The part about the log of an earlier run.
std::vector<JobOptionRecord> log_option_records();

/// Sets one option, named `source` ("--max-feed" or "job.toml: max_feed_mm_per_min") in errors.
void set_job_option(JobOptions& options, const JobOptionRecord& record, const std::string& text,
                    const std::string& source);

}  // namespace dwell
