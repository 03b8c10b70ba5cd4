#include "runs/job/job_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/base/number_text.h"
#include "core/base/pitch.h"
#include "core/base/value_range.h"
#include "core/form/form.h"
#include "core/map/aperture.h"
#include "core/map/value_units.h"
#include "core/motion/motion.h"
#include "core/tif/models/removal_models.h"
#include "core/tif/removal_orientation.h"
#include "paths/path_catalogue.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/drawing/figure_format.h"
#include "runs/job/keep_out_option.h"
#include "runs/job/place_option.h"
#include "runs/job/scatter_option.h"
#include "runs/machine/machine_option.h"
#include "runs/map_steps/map_steps.h"
#include "runs/programs/gcode_dialect.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/shipped_templates.h"
#include "solvers/solver_catalogue.h"
#include "solvers/weights/weight_option.h"

namespace dwell {
namespace {

double number(const std::string& text, const ValueRange& range) {
  const auto value = parse_number(text);
  if (!value || !range.holds(*value)) throw InputError(fmt::format("'{}'; required {}", text, range.text()));
  return *value;
}

void check_height_or_rate_unit(const std::string& unit) {
  const bool rate = known_rate_unit(unit) || unit.find('/') != std::string::npos;
  unit_factor(unit, rate ? MapQuantity::Rate : MapQuantity::Height);
}

void check_height_unit(const std::string& unit) {
  if (is_wave_unit(unit)) return;
  try {
    height_unit_nm(unit);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}, waves", error.what()));
  }
}

double pixel_count(const std::string& text) {
  constexpr ValueRange kPixels{1.0, kMostPixelsOfAll, ""};
  const auto value = parse_number(text);
  if (value && kPixels.holds(*value) && *value == std::floor(*value)) return *value;
  throw InputError(fmt::format("'{}'; required a whole number from 1 to {}", text, kMostPixelsOfAll));
}

int whole(const std::string& text) {
  constexpr ValueRange kThreads{0.0, 1024.0, ""};
  const auto value = parse_number(text);
  if (value && kThreads.holds(*value) && *value == std::floor(*value)) return static_cast<int>(*value);
  throw InputError(fmt::format("'{}'; required a whole number from 0 to 1024", text));
}

/// A share in per cent, with its sign so that 1 and 0.01 cannot be mistaken for each other; "off" is 0.
double proof_share(const std::string& text) {
  constexpr ValueRange kShares{1e-4, 1000.0, "%"};
  if (text == "off") return 0.0;
  const auto value = text.ends_with('%') ? parse_number(text.substr(0, text.size() - 1)) : std::nullopt;
  if (value && kShares.holds(*value)) return 0.01 * *value;
  throw InputError(fmt::format("'{}'; required {} such as 1%, or off", text, kShares.text()));
}
std::string proof_text(double share) { return share > 0.0 ? fmt::format("{:.12g}%", 100.0 * share) : "off"; }

std::string shown(double value) { return fmt::format("{}", value); }
std::string shown(const std::optional<double>& value) { return value ? shown(*value) : ""; }
std::string shown(const std::optional<NoDataMarkers>& value) { return value ? to_string(*value) : ""; }
std::string shown(const std::optional<MapRows>& value) { return value ? to_string(*value) : ""; }
std::string shown(const std::optional<MatrixTable>& value) { return value ? to_string(*value) : ""; }

/// The solvers, as a user names them.
std::string solver_words() {
  std::string words;
  for (const SolverRecord& solver : solver_catalogue()) {
    if (solver.kind != SolverKind::Auto) words += (words.empty() ? "" : ", ") + solver.name;
  }
  return words;
}

using Options = JobOptions;
/// The removal models besides the two that the help shows with their keys.
std::string other_models() {
  std::string names;
  for (const RemovalModel& model : removal_models()) {
    if (model.name == "gaussian" || model.name == "disc") continue;
    names += (names.empty() ? "" : ", ") + model.name;
  }
  return names;
}

std::vector<JobOptionRecord> make_table() {
  std::vector<JobOptionRecord> table{
      {"map", "map", "FILE", "height-error map: a file in any map format; NaN = outside the part", true, false,
       [](Options& o, const std::string& t) { o.map = t; }, [](const Options& o) { return o.map; }},
      {"map-pixel", "map_pixel_mm", "MM|X,Y",
       "pixel pitch of the map in mm, for formats that carry none: one number of square pixels, else that along x and "
       "that along y",
       false, true, [](Options& o, const std::string& t) { o.map_pixel_mm = parse_pitch(t); },
       [](const Options& o) { return o.map_pixel_mm ? pitch_option_text(*o.map_pixel_mm) : std::string(); }, true},
      {"map-unit", "map_unit", "UNIT",
       "unit of the heights: nm, um, mm, m or waves (default as the file says, else nm); waves need --wavelength and "
       "--wave-scale",
       false, false, [](Options& o, const std::string& t) { check_height_unit(t), o.map_unit = t; },
       [](const Options& o) { return o.map_unit; }},
      {"wavelength", "wavelength_nm", "NM", "wavelength in nm, of heights in waves; 632.8 of a HeNe laser", false, true,
       [](Options& o, const std::string& t) { o.wavelength_nm = number(t, ranges::kWavelength); },
       [](const Options& o) { return shown(o.wavelength_nm); }},
      {"wave-scale", "wave_scale", "0.5|1|X",
       "height of the surface for each wave, in wavelengths, and of an OPD in nm for each nm of it: 0.5 for a mirror "
       "measured at normal incidence, 1 where the values are heights of the surface; required for waves and for data "
       "called OPD, wavefront or WFR",
       false, true, [](Options& o, const std::string& t) { o.wave_scale = number(t, ranges::kWaveScale); },
       [](const Options& o) { return shown(o.wave_scale); }},
      {"map-origin", "map_origin_mm", "X,Y",
       "position of the map's first pixel in mm (default 0,0 or what the file says)", false, false,
       [](Options& o, const std::string& t) { o.map_origin_mm = parse_point(t); },
       [](const Options& o) { return o.map_origin_mm ? to_string(*o.map_origin_mm) : std::string(); }},
      {"map-no-data", "map_no_data", "VALUE",
       "number in the map's file that stands for no data, in its own unit, as -9999; several separated by commas; or "
       "none: every number is a height",
       false, false, [](Options& o, const std::string& t) { o.map_no_data = parse_no_data(t); },
       [](const Options& o) { return shown(o.map_no_data); }},
      {"map-max-pv", "map_max_pv_mm", "MM",
       "most that the heights may span in mm; a map that spans more is refused (default 10)", false, true,
       [](Options& o, const std::string& t) { o.map_max_pv_mm = number(t, ranges::kSize); },
       [](const Options& o) { return shown(o.map_max_pv_mm); }},
      {"map-table", "map_table", "WHAT",
       "what the first row and column of a matrix as text are: heights; index (left out); or mm, um or m: coordinates "
       "in this unit",
       false, false, [](Options& o, const std::string& t) { o.map_table = parse_matrix_table(t); },
       [](const Options& o) { return shown(o.map_table); }},
      {"map-rows", "map_rows", "EDGE",
       "edge of the part at which the first row of the map's file lies: bottom (the smallest y) or top (the rows are "
       "turned over); default: as the format says, bottom for a matrix",
       false, false, [](Options& o, const std::string& t) { o.map_rows = parse_map_rows(t); },
       [](const Options& o) { return shown(o.map_rows); }},
      {"map-grid", "map_grid", "pitch=MM[,reach=MM]",
       "fits a surface of this pixel pitch to points x y z that lie on no grid; no data farther than reach from the "
       "nearest point (default 1.5 times their spacing)",
       false, false, [](Options& o, const std::string& t) { o.map_grid = parse_scatter_options(t); },
       [](const Options& o) { return to_string(o.map_grid); }},
      {"map-steps", "map_steps", "STEPS",
       "how to prepare the map, before all else: STEP;STEP;... of docs/maps.md, as crop:rect:0,0,9,9;fill:harmonic",
       false, false, [](Options& o, const std::string& t) { parse_map_steps(t), o.map_steps = t; },
       [](const Options& o) { return o.map_steps; }, false, true},
      {"max-pixels", "max_pixels", "N",
       "most pixels of a map that is read, or made by a step (default 268435456); given, a packed file may also unpack "
       "to that many, however small it is",
       false, true, [](Options& o, const std::string& t) { o.max_pixels = pixel_count(t); },
       [](const Options& o) { return shown(o.max_pixels); }},
      {"tif", "tif", "TIF",
       fmt::format("removal function: FILE (as the map), gaussian:peak=NM/S,fwhm=MM[,radius=MM] (or sigma=MM), "
                   "disc:slope=NM/S/MM,radius=MM, or another model ({}) with its keys",
                   other_models()),
       true, false, [](Options& o, const std::string& t) { o.tif = t; }, [](const Options& o) { return o.tif; }},
      {"tif-pixel", "tif_pixel_mm", "MM|X,Y",
       "pixel pitch of the removal function's file in mm, for formats that carry none: one number, or that along x and "
       "that along y",
       false, true, [](Options& o, const std::string& t) { o.tif_pixel_mm = parse_pitch(t); },
       [](const Options& o) { return o.tif_pixel_mm ? pitch_option_text(*o.tif_pixel_mm) : std::string(); }, true},
      {"tif-unit", "tif_unit", "UNIT",
       "unit of the removal rates: nm/s, um/s, um/min or m/s (of the surface that spots left: nm, um, mm or m); "
       "default "
       "as the file says, else nm/s (nm)",
       false, false, [](Options& o, const std::string& t) { check_height_or_rate_unit(t), o.tif_unit = t; },
       [](const Options& o) { return o.tif_unit; }},
      {"tif-no-data", "tif_no_data", "VALUE", "the same as --map-no-data for the removal function's file", false, false,
       [](Options& o, const std::string& t) { o.tif_no_data = parse_no_data(t); },
       [](const Options& o) { return shown(o.tif_no_data); }},
      {"tif-table", "tif_table", "WHAT", "the same as --map-table for the removal function's file", false, false,
       [](Options& o, const std::string& t) { o.tif_table = parse_matrix_table(t); },
       [](const Options& o) { return shown(o.tif_table); }},
      {"tif-rows", "tif_rows", "EDGE", "the same as --map-rows for the removal function's file", false, false,
       [](Options& o, const std::string& t) { o.tif_rows = parse_map_rows(t); },
       [](const Options& o) { return shown(o.tif_rows); }},
      {"tif-grid", "tif_grid", "pitch=MM[,reach=MM]", "the same as --map-grid for the removal function's file", false,
       false, [](Options& o, const std::string& t) { o.tif_grid = parse_scatter_options(t); },
       [](const Options& o) { return to_string(o.tif_grid); }},
      {"tif-steps", "tif_steps", "STEPS",
       "how to prepare the removal function's file, before all else: steps as of --map-steps, for instance "
       "fill:harmonic",
       false, false, [](Options& o, const std::string& t) { parse_map_steps(t), o.tif_steps = t; },
       [](const Options& o) { return o.tif_steps; }, false, true},
      {"tif-pedestal", "tif_pedestal", "HOW",
       "what is done about a removal function that still removes at the rim of its file: subtract (the rim's mean is "
       "taken off), taper (a cosine takes the outer part to zero) or accept; required where the rim's mean is 5 % of "
       "the "
       "peak or more",
       false, false, [](Options& o, const std::string& t) { o.tif_pedestal = parse_tif_pedestal(t); },
       [](const Options& o) { return o.tif_pedestal ? to_string(*o.tif_pedestal) : std::string(); }},
      {"tif-dwell-time", "tif_dwell_time_s", "SECONDS",
       "the removal function's file is a surface, flat before, after the tool stood on it for so many seconds at one "
       "or "
       "more spots; dwell tif shows and does more",
       false, true, [](Options& o, const std::string& t) { o.tif_dwell_time_s = number(t, ranges::kTime); },
       [](const Options& o) { return shown(o.tif_dwell_time_s); }},
      {"tif-centre", "tif_centre", "WHERE",
       "the tool axis in the removal function's file: middle (of its grid), centroid, peak (apex of its rounded top), "
       "X,Y in mm, or auto: "
       "0,0 of a file that dwell tif wrote, the centroid of a spot, the middle of others, if centroid or peak is there",
       false, false, [](Options& o, const std::string& t) { o.tif_centre = parse_tif_centre(t); },
       [](const Options& o) { return to_string(o.tif_centre); }},
      {"tif-angle", "tif_angle_deg", "DEG",
       "turns the removal function about the tool axis, counter-clockwise seen from +z, x to the right and y up, in "
       "degrees",
       false, true, [](Options& o, const std::string& t) { o.tif_angle_deg = number(t, ranges::kAngle); },
       [](const Options& o) { return shown(o.tif_angle_deg); }},
      {"tif-flip", "tif_flip", "AXIS",
       "mirrors the removal function before it is turned: x (+x becomes -x), y, or none", false, false,
       [](Options& o, const std::string& t) { o.tif_flip = parse_flip(t); },
       [](const Options& o) { return to_string(o.tif_flip); }},
      {"tif-rate", "tif_rate", "FACTOR",
       "the volume that the tool takes in a second, over that of the removal function as given: what an earlier run on "
       "the machine has shown (default 1)",
       false, true, [](Options& o, const std::string& t) { o.tif_rate = number(t, ranges::kToolFactor); },
       [](const Options& o) { return o.tif_rate == 1.0 ? std::string() : shown(o.tif_rate); }},
      {"tif-width", "tif_width", "FACTOR",
       "the width of the tool, over that of the removal function as given, with the volume it takes in a second the "
       "same (default 1)",
       false, true, [](Options& o, const std::string& t) { o.tif_width = number(t, ranges::kToolFactor); },
       [](const Options& o) { return o.tif_width == 1.0 ? std::string() : shown(o.tif_width); }},
      {"path", "path", "PATH",
       "KIND:OPTIONS, for instance raster:pitch=1, random:pitch=1,seed=2 or file:PATH.csv; dwell paths --kinds lists "
       "them all",
       false, false, [](Options& o, const std::string& t) { o.path = parse_path_spec(t); },
       [](const Options& o) { return to_string(o.path); }},
      {"keep-out", "keep_out", "AREA;...",
       "areas that the tool's axis does not enter while the tool is down, as in --aperture, or file:NAME with one a "
       "line: the path lifts over them and leaves out its points inside; may be given several times",
       false, false, [](Options& o, const std::string& t) { check_keep_out(t), o.keep_out = t; },
       [](const Options& o) { return o.keep_out; }, false, true},
      {"motion", "motion", "HOW", "moving: the tool runs through; stop: it halts at every dwell point", false, false,
       [](Options& o, const std::string& t) { o.motion = parse_motion(t); },
       [](const Options& o) { return to_string(o.motion); }},
      {"remove", "remove", "TERMS", "form terms that do not count: piston,tilt,power,astigmatism or none", false, false,
       [](Options& o, const std::string& t) { o.remove = parse_form_terms(t), o.remove_given = true; },
       [](const Options& o) { return to_string(o.remove_given ? o.remove : form_terms(o)); }},
      {"aperture", "aperture", "AREA",
       "what counts: map, rect:X0,Y0,X1,Y1, circle:X,Y,R, ellipse:X,Y,A,B[,DEG], annulus:X,Y,RIN,ROUT or "
       "polygon:X,Y,X,Y,...[/HOLE...] in mm",
       false, false, [](Options& o, const std::string& t) { o.aperture = parse_aperture(t); },
       [](const Options& o) { return to_string(o.aperture); }},
      {"fraction", "fraction", "SHARE",
       "share of the error that the plan removes, form terms aside, from 0.01 to 1: 0.8 leaves a fifth of it", false,
       true, [](Options& o, const std::string& t) { o.fraction = number(t, ranges::kFraction); },
       [](const Options& o) { return shown(o.fraction); }},
      {"accept", "accept", "LIMITS",
       "limits that the surface which the program leaves is judged by, as rms<=1,pv<=10nm,slope<=0.2urad, of rms, pv, "
       "pvr, slope, mid and band(A..Bmm): exit code 3 where one is not met; mid lies between two FWHM of the tool and "
       "half of one; or none",
       false, false,
       [](Options& o, const std::string& t) {
         if (t != "none") check_surface_limits(t);
         o.accept = t == "none" ? "" : t;
       },
       [](const Options& o) { return o.accept; }},
      {"min-dwell", "min_dwell_s", "S", "shortest dwell time at a point in s", false, true,
       [](Options& o, const std::string& t) { o.min_dwell_s = number(t, ranges::kDwell); },
       [](const Options& o) { return shown(o.min_dwell_s); }},
      {"max-feed", "max_feed_mm_per_min", "MM/MIN", "fastest feed of the machine in mm/min", false, true,
       [](Options& o, const std::string& t) { o.max_feed_mm_per_min = number(t, ranges::kFeed); },
       [](const Options& o) { return shown(o.max_feed_mm_per_min); }},
      {"machine", "machine", "FILE",
       "machine file (docs/motion.md): the plan keeps within its accelerations and corners, its feeds make up for "
       "them, and "
       "what is left is of its motion; or its fields as a TOML table {...}; none: they are not considered",
       true, false,
       [](Options& o, const std::string& t) {
         if (is_inline_machine(t)) machine_of_option(t);  // refuses what is wrong
         o.machine = t == "none" ? "" : t;
       },
       [](const Options& o) { return o.machine; }},
      {"schedule", "schedule", "KIND",
       "with --machine: constant (one feed a stroke, as G-code says it), or speeds at nodes, which programs of "
       "--export "
       "alone can say: linear (constant acceleration between nodes) or pvt (cubics of time, which round the corners "
       "that "
       "are not stopped at)",
       false, false, [](Options& o, const std::string& t) { o.schedule = parse_schedule_kind(t); },
       [](const Options& o) { return to_string(o.schedule); }},
      {"rounds", "rounds", "N",
       "with --machine: how often at most the plan is corrected for what the machine's motion makes of it", false, true,
       [](Options& o, const std::string& t) { o.rounds = whole(t); },
       [](const Options& o) { return fmt::format("{}", o.rounds); }},
      {"smoothness", "smoothness", "WEIGHT",
       "weight of smooth feed against residual: auto (from tool and path: waves of dwell of 9/8 of the tool's FWHM are "
       "held back by half), a number without unit (0 = none), corner (of the L-curve), step<=S (RMS change of dwell "
       "between neighbours in s) or residual<=NM",
       false, true, [](Options& o, const std::string& t) { o.smoothness = parse_weight_goal(t, kSmoothnessTarget); },
       [](const Options& o) { return to_string(o.smoothness); }, true},
      {"time-price", "time_price_nm2_per_s", "NM2/S",
       "price of machine time: auto (the longest run that is still worth it, see --time-worth), a number (half the "
       "mean square residual in nm^2 that a second must save), corner (of the L-curve), total<=S or residual<=NM",
       false, true,
       [](Options& o, const std::string& t) { o.time_price_nm2_per_s = parse_weight_goal(t, kTimePriceTarget); },
       [](const Options& o) { return to_string(o.time_price_nm2_per_s); }, true},
      {"time-worth", "time_worth", "K[,MU]",
       "with --time-price auto: one per cent more time must lower the mean square left by K per cent, and the next "
       "second must be worth MU of the average one",
       false, false, [](Options& o, const std::string& t) { o.time_worth = parse_time_worth(t); },
       [](const Options& o) { return to_string(o.time_worth); }},
      {"certify", "certify", "SHARE",
       "go on until the plan's objective is proven to be no more than so much above the optimum: 1% or another share "
       "in per cent, or off (a plan with smoothness and time price above 0 goes on to 100% all the same; the proven "
       "bound is shown in any case)",
       false, false, [](Options& o, const std::string& t) { o.certify = proof_share(t); },
       [](const Options& o) { return proof_text(o.certify); }},
      {"solver", "solver", "NAME", "auto, or another of " + solver_words(), false, false,
       [](Options& o, const std::string& t) { o.solver = parse_solver_kind(t); },
       [](const Options& o) { return to_string(o.solver); }},
      {"blemishes", "blemishes", "HOW",
       "dust, scratches and pits, found in what the plan leaves: report (where they are, and what is left without "
       "them), leave-out (of the fit as well, which is solved once more) or keep (not looked for)",
       false, false, [](Options& o, const std::string& t) { o.blemishes = parse_blemish_handling(t); },
       [](const Options& o) { return to_string(o.blemishes); }},
      {"max-solve", "max_solve_s", "S", "time limit in s, of reading, path, set-up and solve together", false, true,
       [](Options& o, const std::string& t) { o.max_solve_s = number(t, ranges::kTime); },
       [](const Options& o) { return shown(o.max_solve_s); }},
      {"threads", "threads", "N", "threads; 0 = one for every processor", false, true,
       [](Options& o, const std::string& t) { o.threads = whole(t); },
       [](const Options& o) { return fmt::format("{}", o.threads); }},
      {"gcode", "gcode", "DIALECT", "what F means in program.nc: g94, g93-per-minute or g93-seconds", false, false,
       [](Options& o, const std::string& t) { o.gcode = parse_gcode_dialect(t); },
       [](const Options& o) { return to_string(o.gcode); }},
      {"lift-height", "lift_height_mm", "MM", "Z of lifted moves in program.nc in mm", false, true,
       [](Options& o, const std::string& t) { o.lift_height_mm = number(t, ranges::kSize); },
       [](const Options& o) { return shown(o.lift_height_mm); }},
      {"export", "export", "FORMATS",
       "programs to write besides feed.csv and program.nc, separated by commas: " + export_words() +
           "; or none. They say the motion of the machine, and take --machine",
       false, false, [](Options& o, const std::string& t) { o.exports = parse_exports(t); },
       [](const Options& o) { return exports_text(o.exports); }},
      {"template", "template", "FILE",
       "layout of one more program, or of the program that is read: a file (docs/formats.md), or one that comes with "
       "dwell: " +
           shipped_template_names(),
       true, false, [](Options& o, const std::string& t) { o.program_template = t; },
       [](const Options& o) { return o.program_template; }},
      {"figures", "figures", "FORMATS", "formats of the figures, separated by commas: png, svg, pdf", false, false,
       [](Options& o, const std::string& t) { o.figures = parse_figure_formats(t); },
       [](const Options& o) { return to_string(o.figures); }},
      {"figure-range", "figure_range", "HOW",
       "colours of the map after: shared, over the range of the map before, and once more over its own; or own, over "
       "its own alone",
       false, false, [](Options& o, const std::string& t) { o.figure_range = parse_figure_range(t); },
       [](const Options& o) { return std::string(to_string(o.figure_range)); }},
      {"out", "out", "FOLDER",
       "where the result is written; replaced whole if it holds an earlier one of the same kind", true, false,
       [](Options& o, const std::string& t) { o.out = t; }, [](const Options& o) { return o.out; }},
  };
  const auto insert_after = [&table](const char* flag, const std::vector<JobOptionRecord>& part) {
    const auto at =
        std::find_if(table.begin(), table.end(), [flag](const auto& record) { return record.flag == flag; });
    table.insert(at + 1, part.begin(), part.end());
  };
  insert_after("lift-height", program_option_records());
  insert_after("map-steps", profile_option_records());
  insert_after("path", tool_option_records());
  insert_after("aperture", fit_option_records());
  insert_after("rounds", log_option_records());
  return table;
}

}  // namespace

const std::vector<JobOptionRecord>& job_option_table() {
  static const std::vector<JobOptionRecord> table = make_table();
  return table;
}

void set_job_option(JobOptions& options, const JobOptionRecord& record, const std::string& text,
                    const std::string& source) {
  if (text.empty()) throw InputError(fmt::format("{}: empty; {}", source, record.help));
  try {
    record.set(options, text);
  } catch (const InputError& error) {
    const std::string message = fmt::format("{}: {}", source, error.what());
    // With its parts, for whoever shows the value and what is accepted in another way than as a sentence.
    if (error.field().empty()) throw InputError(message);
    throw InputError(source, error.value(), error.accepted(), message);
  }
}

}  // namespace dwell
