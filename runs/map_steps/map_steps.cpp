#include "runs/map_steps/map_steps.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/base/number_text.h"
#include "core/map/aperture.h"
#include "core/map/map_crop.h"
#include "core/map/map_decimate.h"
#include "core/map/map_extend.h"
#include "core/map/map_fill.h"
#include "core/map/map_outliers.h"
#include "core/map/map_turn.h"
#include "core/map/map_warp.h"
#include "runs/map_steps/blemish_step.h"
#include "runs/map_steps/map_pair_steps.h"

namespace dwell {
namespace {

using Argument = MapStepArgument;
using Kind = MapStepArgument::Kind;

std::string size_of(const HeightMap& map) {
  return fmt::format("{} x {} pixels, {} with data", map.grid.rows, map.grid.cols, map.valid_pixels());
}

std::string run_crop(HeightMap& map, const MapStep& step, MapStepContext&) {
  if (step.area == "data") {
    map = crop_to_data(map);
    return size_of(map);
  }
  const Aperture area = parse_aperture(step.area);
  if (area.kind != Aperture::Kind::Rectangle) step.refuse("accepted: data or rect:x0,y0,x1,y1 [mm]");
  map = crop(map, {area.x0, area.y0}, {area.x1, area.y1});
  return size_of(map);
}

std::string run_mask(HeightMap& map, const MapStep& step, bool keep, const Progress& progress) {
  const Index before = map.valid_pixels();
  const Aperture area = parse_aperture(step.area);
  map = keep ? within(std::move(map), area, progress) : outside(std::move(map), area, progress);
  return fmt::format("{} removed, {} left", counted(before - map.valid_pixels(), "pixel"), map.valid_pixels());
}

std::string run_keep(HeightMap& map, const MapStep& step, MapStepContext& context) {
  return run_mask(map, step, true, context.progress);
}
std::string run_drop(HeightMap& map, const MapStep& step, MapStepContext& context) {
  return run_mask(map, step, false, context.progress);
}

std::string describe_place(const HeightMap& map) {
  return fmt::format("first pixel at ({:.9g}, {:.9g}) mm", map.grid.origin.x, map.grid.origin.y);
}

std::string run_flip(HeightMap& map, const MapStep& step, MapStepContext&) {
  const std::string axis = step.word("axis");
  if (axis != "x" && axis != "y") step.refuse(fmt::format("axis = '{}'; accepted: x or y", axis));
  map = turn_map(map, axis == "x" ? GridTurn::FlipX : GridTurn::FlipY, step.point("about"));
  return describe_place(map);
}

std::string run_transpose(HeightMap& map, const MapStep& step, MapStepContext&) {
  map = turn_map(map, GridTurn::Transpose, step.point("about"));
  return describe_place(map);
}

std::string run_rotate(HeightMap& map, const MapStep& step, MapStepContext& context) {
  const double degrees = step.number("degrees");
  const double quarters = std::fmod(std::fmod(degrees / 90.0, 4.0) + 4.0, 4.0);
  if (quarters == std::floor(quarters)) {
    constexpr GridTurn kTurns[] = {GridTurn::Quarter, GridTurn::Half, GridTurn::ThreeQuarters};
    if (quarters > 0.0) map = turn_map(map, kTurns[static_cast<int>(quarters) - 1], step.point("about"));
    return "exact, " + describe_place(map);
  }
  map = rotate_map(map, degrees, step.point("about").value_or(middle_of(map.grid)), context.threads, context.limit(),
                   context.progress);
  return fmt::format("{}, {}", size_of(map), describe_place(map));
}

std::string run_fill(HeightMap& map, const MapStep& step, MapStepContext& context) {
  if (step.word("how") != "harmonic") step.refuse(fmt::format("how = '{}'; accepted: harmonic", step.word("how")));
  const double largest = step.optional_number("largest").value_or(0.0);
  if (step.has("largest") && !(largest > 0.0)) step.refuse(fmt::format("largest = {} mm^2; > 0 required", largest));
  const FillSummary summary = fill_holes(map, {step.has("all"), largest}, context.progress);
  return fmt::format("{} of {} filled{}", counted(summary.holes, "hole"), counted(summary.pixels, "pixel"),
                     summary.left > 0 ? fmt::format(", {} larger ones left", summary.left) : "");
}

std::string run_outliers(HeightMap& map, const MapStep& step, MapStepContext& context) {
  const OutlierOptions options{step.number("sigmas"), step.whole("window", 3, kMaxOutlierWindow), step.number("floor")};
  const Index removed = remove_outliers(map, options, context.threads, context.progress);
  return fmt::format("{} removed", counted(removed, "pixel"));
}

std::string run_limit(HeightMap& map, const MapStep& step, MapStepContext&) {
  const Index removed = remove_beyond(map, {step.number("height"), step.number("slope")});
  return fmt::format("{} removed", counted(removed, "pixel"));
}

std::string run_decimate(HeightMap& map, const MapStep& step, MapStepContext& context) {
  const Index most = 1'000'000;
  const Index across = step.whole("factor", 1, most);
  const Index along = step.has("factor-y") ? step.whole("factor-y", 1, most) : across;
  map = decimate_map(map, along, across, context.progress);
  return fmt::format("{} of {:.9g} x {:.9g} mm", size_of(map), map.grid.pitch_x, map.grid.pitch_y);
}

std::string run_resample(HeightMap& map, const MapStep& step, MapStepContext& context) {
  const double pitch = step.number("pitch");
  map = resample_map(map, {pitch, step.optional_number("pitch-y").value_or(pitch)}, context.threads, context.limit(),
                     context.progress);
  return fmt::format("{}, {}", size_of(map), describe_place(map));
}

std::string run_extend(HeightMap& map, const MapStep& step, MapStepContext& context) {
  ExtendOptions options;
  options.how = parse_extension(step.word("how"));
  options.width = step.number("width");
  options.shortest = step.optional_number("shortest").value_or(options.width);
  if (step.has("iterations")) options.iterations = static_cast<int>(step.whole("iterations", 1, 1'000'000));
  options.tolerance = step.optional_number("tolerance").value_or(options.tolerance);
  options.limit = context.limit();
  ExtendSummary summary;
  map = extend_map(map, options, summary, context.threads, context.progress);
  std::string text = fmt::format("{} added", counted(summary.pixels, "pixel"));
  if (options.how != Extension::Gerchberg) return text;
  const bool settled = summary.change <= options.tolerance;
  return text + fmt::format(", waves longer than {} mm, {}, {} at a change of {:.1e}", options.shortest,
                            counted(summary.iterations, "iteration"), settled ? "settled" : "NOT settled",
                            summary.change);
}

Argument about() {
  return {"about", Kind::Word, "X/Y", "the point that stays, in mm (default: the middle of the pixel centres)", ""};
}

/// How another map's file is read.
void add_reading(std::vector<Argument>& arguments) {
  arguments.push_back(
      {"pixel", Kind::Word, "MM or X/Y", "pixel pitch of the file in mm (default: as --map-pixel)", ""});
  arguments.push_back(
      {"unit", Kind::Word, "UNIT", "unit of its heights: nm, um, mm, m or waves (default: as --map-unit)", ""});
  arguments.push_back({"wavelength", Kind::Number, "NM", "of heights in waves, in nm (default: as --wavelength)", ""});
  arguments.push_back({"wave-scale", Kind::Number, "X", "its height for each wave (default: as --wave-scale)", ""});
  arguments.push_back({"origin", Kind::Word, "X/Y", "its first pixel in mm (default: as --map-origin)", ""});
}

void add_registering(std::vector<Argument>& arguments) {
  arguments.push_back({"shift", Kind::Number, "MM",
                       "how far to look each way in mm (default: a tenth of the longer side); 0 with degrees=0: from "
                       "where they lie",
                       ""});
  arguments.push_back(
      {"degrees", Kind::Number, "DEG", "how far to look for a rotation, each way, in degrees (default 3)", ""});
  arguments.push_back({"scale", Kind::Flag, "", "the lateral scale is free too", ""});
  arguments.push_back({"no-rotation", Kind::Flag, "", "shift only", ""});
  arguments.push_back({"no-level", Kind::Flag, "", "piston and tilt between the maps count (default: are fitted)", ""});
}

std::vector<MapStepRecord> shape_steps() {
  const char* area =
      "rect:X0,Y0,X1,Y1, circle:X,Y,R, ellipse:X,Y,A,B[,DEG], annulus:X,Y,RIN,ROUT or "
      "polygon:X1,Y1,X2,Y2,...[/HOLE...]";
  return {
      {"crop",
       "data or rect:X0,Y0,X1,Y1",
       "cut the grid down to a rectangle in mm, or to the pixels with data",
       "crop:rect:-10,-5,10,5",
       {},
       run_crop},
      {"keep",
       area,
       "remove what lies outside an area in mm; its boundary is kept",
       "keep:circle:0,0,25",
       {},
       run_keep},
      {"drop",
       area,
       "remove what lies inside an area in mm, its boundary too",
       "drop:ellipse:3,4,2,1,30",
       {},
       run_drop},
      {"flip",
       "",
       "mirror: x exchanges left and right, y bottom and top; exact",
       "flip:x",
       {{"axis", Kind::Word, "AXIS", "x or y", "", true}, about()},
       run_flip},
      {"rotate",
       "",
       "turn counter-clockwise (+x right, +y up); multiples of 90 exact, others by cubic B-spline",
       "rotate:90",
       {{"degrees", Kind::Number, "DEG", "angle in degrees", "", true}, about()},
       run_rotate},
      {"transpose", "", "exchange x and y; exact", "transpose", {about()}, run_transpose},
  };
}

std::vector<MapStepRecord> height_steps() {
  return {
      {"outliers",
       "",
       "remove pixels far from the median of their neighbourhood",
       "outliers:sigmas=4,window=7",
       {{"sigmas", Kind::Number, "K", "how far, in robust standard deviations (1.4826 MAD) of the window", "5"},
        {"window", Kind::Number, "N", "side of the window in pixels, odd, 3 to 101", "5"},
        {"floor", Kind::Number, "NM", "least standard deviation assumed in nm", "0"}},
       run_outliers},
      {"blemishes",
       "",
       "remove dust, scratches and pits: clusters of pixels that are narrower than a width and far from their "
       "surroundings",
       "blemishes:width=4",
       {{"width", Kind::Number, "MM", "blemishes are narrower than this, in mm", "", true},
        {"sigmas", Kind::Number, "K", "how far, in robust standard deviations (1.4826 MAD) of the surroundings", "8"}},
       run_blemishes},
      {"limit",
       "",
       "remove pixels beyond a height or slope",
       "limit:slope=5000",
       {{"height", Kind::Number, "NM", "largest distance from the map's median in nm, 0 = any", "0"},
        {"slope", Kind::Number, "NM/MM", "largest slope to a neighbour in nm/mm, 0 = any", "0"}},
       run_limit},
      {"fill",
       "",
       "fill holes by the harmonic surface through their edges",
       "fill:harmonic",
       {{"how", Kind::Word, "HOW", "harmonic", "harmonic"},
        {"all", Kind::Flag, "", "also what reaches the map's edge", ""},
        {"largest", Kind::Number, "MM2", "leave larger holes, in mm^2 (default: any size)", ""}},
       run_fill},
      {"decimate",
       "",
       "average blocks of pixels; a block needs data in half of it",
       "decimate:4",
       {{"factor", Kind::Number, "N", "pixels a block", "", true},
        {"factor-y", Kind::Number, "N", "along y (default: as factor)", ""}},
       run_decimate},
      {"resample",
       "",
       "another pixel pitch: averaged over blocks where coarser, then by cubic B-spline",
       "resample:pitch=0.2",
       {{"pitch", Kind::Number, "MM", "new pitch in mm", "", true},
        {"pitch-y", Kind::Number, "MM", "along y (default: as pitch)", ""}},
       run_resample},
      {"extend",
       "",
       "continue the surface beyond its edge, onto a larger grid",
       "extend:harmonic,width=5",
       {{"how", Kind::Word, "HOW", "zero, nearest, decay (nearest, falling to 0 as a cosine), harmonic or gerchberg",
         "", true},
        {"width", Kind::Number, "MM", "how far in mm", "", true},
        {"shortest", Kind::Number, "MM", "gerchberg: shortest wave in mm (default: the width)", ""},
        {"iterations", Kind::Number, "N", "gerchberg: at most (default 200)", ""},
        {"tolerance", Kind::Number, "PART",
         "gerchberg: ends when the change is less, relative to the RMS (default 0.0001)", ""}},
       run_extend},
  };
}

std::vector<MapStepRecord> pair_steps() {
  std::vector<Argument> subtract{{"file", Kind::File, "FILE", "the map to take off", "", true},
                                 {"how", Kind::Word, "HOW",
                                  "strict: the grids must agree; resample: onto the map's grid; register: moved onto "
                                  "the map first",
                                  "strict"}};
  std::vector<Argument> average{
      {"files", Kind::Files, "FILE[,FILE...]", "the other maps", "", true},
      {"resample", Kind::Flag, "", "put them onto the map's grid (default: the grids must agree)", ""},
      {"least", Kind::Number, "N", "maps that need data in a pixel (default: all)", ""}};
  std::vector<Argument> onto{{"to", Kind::File, "FILE", "the map to lie on, whose grid is taken", "", true}};
  for (auto* arguments : {&subtract, &onto}) add_registering(*arguments);
  for (auto* arguments : {&subtract, &average, &onto}) add_reading(*arguments);
  return {
      {"subtract", "", "take another map off", "subtract:reference.csv,register", subtract, subtract_map},
      {"average", "", "mean of this map and others", "average:second.csv,third.csv,least=2", average, average_maps},
      {"register", "", "move the map onto another by a robust fit", "register:to=other.csv,shift=2", onto,
       register_on_map},
      {"fiducials",
       "",
       "move the map so that marks on it come to lie where they should, by least squares",
       "fiducials:rigid,from=0/0/10/0,to=1/1/11/1.2",
       {{"fit", Kind::Word, "FIT", "shift, rigid, similarity or affine", "rigid"},
        {"from", Kind::Word, "X/Y/X/Y...", "where the marks are on the map, in mm", "", true},
        {"to", Kind::Word, "X/Y/X/Y...", "where they should be, in mm", "", true}},
       move_by_fiducials},
  };
}

/// The arguments of a step in words.
std::string describe_argument(const MapStepArgument& a) {
  const std::string name = a.kind == Kind::Flag    ? a.name
                           : a.kind == Kind::Files ? a.value
                                                   : fmt::format("{}={}", a.name, a.value);
  const std::string tail = a.required           ? " (required)"
                           : a.fallback.empty() ? ""
                                                : fmt::format(" (default {})", a.fallback);
  return fmt::format("{}: {}{}", name, a.help, tail);
}

bool names_file(const MapStepArgument& a) { return a.kind == Kind::File || a.kind == Kind::Files; }

}  // namespace

const std::vector<MapStepRecord>& map_step_table() {
  static const std::vector<MapStepRecord> kTable = [] {
    std::vector<MapStepRecord> table = shape_steps();
    for (auto part : {height_steps(), pair_steps()}) table.insert(table.end(), part.begin(), part.end());
    return table;
  }();
  return kTable;
}

std::vector<MapStep> parse_map_steps(const std::string& text) {
  std::vector<MapStep> steps;
  for (const std::string_view part : split(text, ';')) {
    if (!trim(part).empty()) steps.push_back(parse_map_step(std::string(trim(part)), map_step_table()));
  }
  return steps;
}

std::vector<std::string> map_step_files(const std::string& text) {
  std::vector<std::string> files;
  for (const MapStep& step : parse_map_steps(text)) {
    for (const MapStepArgument& a : step.record->arguments) {
      if (!names_file(a)) continue;
      for (std::string& file : step.values(a.name)) files.push_back(std::move(file));
    }
  }
  return files;
}

std::string renamed_map_steps(const std::string& text, const std::function<std::string(const std::string&)>& name) {
  std::string result;
  for (MapStep& step : parse_map_steps(text)) {
    for (auto& [argument, value] : step.given) {
      for (const MapStepArgument& a : step.record->arguments) {
        if (names_file(a) && a.name == argument) value = name(value);
      }
    }
    result += (result.empty() ? "" : "; ") + to_string(step, false);
  }
  return result;
}

void apply_map_steps(HeightMap& map, const std::vector<MapStep>& steps, MapStepContext& context) {
  for (const MapStep& step : steps) {
    const std::string text = to_string(step, true);
    context.progress.step(text);
    std::vector<std::string> history = map.history;
    std::string done;
    try {
      done = step.record->run(map, step, context);
    } catch (const InputError& error) {
      const std::string what = error.what();
      throw InputError(what.starts_with("step '") ? what : fmt::format("step '{}': {}", text, what));
    }
    history.push_back(fmt::format("{} ({})", text, done));
    map.history = std::move(history);
  }
}

std::string map_steps_help() {
  std::string text =
      "Steps that prepare a map: --step NAME[:ARGUMENTS], done in the order given. Lengths in mm, heights in nm.\n"
      "Values without a name are those of the arguments in the order below.\n";
  for (const MapStepRecord& record : map_step_table()) {
    text += fmt::format("\n{}\n    {}\n", record.name, record.help);
    if (!record.area.empty()) text += fmt::format("      {}\n", record.area);
    for (const MapStepArgument& a : record.arguments) text += fmt::format("      {}\n", describe_argument(a));
    text += fmt::format("    --step '{}'\n", record.example);
  }
  return text;
}

std::string map_steps_markdown() {
  std::string text = "| step | what it does | arguments | example |\n|---|---|---|---|\n";
  for (const MapStepRecord& record : map_step_table()) {
    std::string arguments = record.area;
    for (const MapStepArgument& a : record.arguments)
      arguments += (arguments.empty() ? "" : "<br>") + describe_argument(a);
    text += fmt::format("| `{}` | {} | {} | `{}` |\n", record.name, record.help, arguments, record.example);
  }
  return text;
}

}  // namespace dwell
