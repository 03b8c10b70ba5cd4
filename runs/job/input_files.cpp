#include "runs/job/input_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/errors.h"
#include "core/base/spec_text.h"
#include "core/base/threads.h"
#include "core/base/units.h"
#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/formats/map_name.h"
#include "core/map/value_units.h"
#include "core/tif/calibration/spot_calibration.h"
#include "core/tif/models/removal_models.h"
#include "core/tif/rate_rim.h"
#include "core/tif/removal_orientation.h"
#include "core/tif/scaled_removal.h"
#include "core/tif/tool_questions.h"
#include "runs/job/option_flags.h"
#include "runs/job/place_option.h"
#include "runs/job/scatter_option.h"
#include "runs/map_steps/map_steps.h"

namespace dwell {

namespace {

/// Whether the axis of the tool is given as a place in its file.
bool is_centred_at_a_place(const JobOptions& options) {
  return options.tif_centre && options.tif_centre->kind == TifCentre::Kind::Given;
}

/// The factor of a unit that an option gives, named in what is refused.
double factor_of_option(const char* option, const std::string& unit, MapQuantity quantity) {
  try {
    return unit_factor(unit, quantity);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--{}: {}", option, error.what()));
  }
}

MapReadOptions map_reading(const JobOptions& options) {
  MapReadOptions read;
  read.pitch = options.map_pixel_mm;
  read.origin = options.map_origin_mm;
  read.waves = {is_wave_unit(options.map_unit), options.wavelength_nm, options.wave_scale};
  if (!options.map_unit.empty() && !read.waves.in_waves)
    read.scale = factor_of_option("map-unit", options.map_unit, MapQuantity::Height);
  read.limit = {options.max_pixels};
  read.no_data = options.map_no_data;
  if (options.map_max_pv_mm) read.max_pv = *options.map_max_pv_mm * units::kNmPerMm;
  read.table = options.map_table;
  read.rows = options.map_rows;
  read.grid = options.map_grid;
  read.threads = thread_count(options.threads);
  return read;
}

/// Of a file of rates, or of the surface that spots left.
MapReadOptions tif_reading(const JobOptions& options, MapQuantity quantity) {
  MapReadOptions read;
  read.name = "tif";
  read.quantity = quantity;
  read.pitch = options.tif_pixel_mm;
  // Job files of dwell 0.2 say nm/s where no unit was given, also of the surface that spots left.
  const bool said = !options.tif_unit.empty() && !(quantity == MapQuantity::Height && options.tif_unit == "nm/s");
  if (said) read.scale = factor_of_option("tif-unit", options.tif_unit, quantity);
  read.limit = {options.max_pixels};
  read.origin_counts = is_centred_at_a_place(options);
  read.no_data = options.tif_no_data;
  read.table = options.tif_table;
  read.rows = options.tif_rows;
  read.grid = options.tif_grid;
  read.threads = thread_count(options.threads);
  return read;
}

}  // namespace

HeightMap load_map(const JobOptions& options, std::vector<InputFile>& inputs, const Progress& progress) {
  const std::string& file = surface_file(options);
  const MapReadOptions read = map_reading(options);
  progress.step("reading the map");
  HeightMap map = read_map(file, read, progress.of_part("map"));
  inputs.push_back({options.removal.empty() ? "map" : "removal", file, sha256_of_file(split_map_name(file).file)});
  MapStepContext context{read, &inputs, thread_count(options.threads), progress.of_part("map")};
  apply_map_steps(map, parse_map_steps(options.map_steps), context);
  if (options.piston_nm) {
    for (double& z : map.values) z += *options.piston_nm;
    map.history.push_back(fmt::format("piston ({:.6g} nm added)", *options.piston_nm));
  }
  return map;
}

namespace {

/// The removal function from the surface that spots of a known dwell time left.
RemovalFunction removal_of_spots(const JobOptions& options) {
  HeightMap depth = read_map(options.tif, tif_reading(options, MapQuantity::Height));
  for (double& value : depth.values) value = -value;
  SpotOptions spots;
  spots.dwell_time = *options.tif_dwell_time_s;
  if (options.tif_centre && options.tif_centre->kind == TifCentre::Kind::Middle) {
    throw InputError(
        "--tif-centre middle: a spot may lie anywhere in its file; accepted: auto, centroid, or X,Y in mm");
  }
  if (options.tif_centre && options.tif_centre->kind == TifCentre::Kind::Given) {
    spots.at = {options.tif_centre->given};
    spots.centre = SpotCentre::Given;
  }
  return measured_removal(calibrate_spots(depth, spots).rates, {TifCentre::Kind::Given, {}});
}

bool made_by_dwell_tif(const HeightMap& rates) {
  return std::find(rates.history.begin(), rates.history.end(), kToolAxisAtOrigin) != rates.history.end();
}

/// Where the axis comes from, for people.
std::string axis_source(const JobOptions& options, bool made_here) {
  if (options.tif_centre) return "--tif-centre " + to_string(options.tif_centre);
  return made_here ? "0,0 of a file of dwell tif" : "the middle of its grid";
}

/// The rates as the file has them, prepared by the job's steps.
HeightMap load_rates(const JobOptions& options, std::vector<InputFile>& inputs, const Progress& progress) {
  const MapReadOptions read = tif_reading(options, MapQuantity::Rate);
  HeightMap rates = read_map(options.tif, read);
  MapStepContext context{read, &inputs, thread_count(options.threads), progress.of_part("tif")};
  apply_map_steps(rates, parse_map_steps(options.tif_steps), context);
  return rates;
}

/// A tool axis far off its own file is a slip, or in another unit.
void refuse_axis_outside(const JobOptions& options, const Grid& grid) {
  if (!is_centred_at_a_place(options)) return;
  const Point axis = options.tif_centre->given, first = grid.centre(0, 0),
              last = grid.centre(grid.rows - 1, grid.cols - 1);
  const auto within = [](double v, double from, double to, double margin) {
    return v >= from - margin && v <= to + margin;
  };
  if (within(axis.x, first.x, last.x, 0.5 * grid.pitch_x) && within(axis.y, first.y, last.y, 0.5 * grid.pitch_y))
    return;
  throw InputError(fmt::format(
      "--tif-centre {}: lies outside of the file {}; required a place in it, x from {:.6g} to {:.6g} mm and "
      "y from {:.6g} to {:.6g} mm",
      to_string(options.tif_centre), options.tif, first.x, last.x, first.y, last.y));
}

RemovalFunction removal_of_rates(const JobOptions& options, std::vector<InputFile>& inputs, const Progress& progress) {
  const HeightMap rates = load_rates(options, inputs, progress);
  refuse_axis_outside(options, rates.grid);
  const bool made_here = made_by_dwell_tif(rates);
  const TifCentre centre = options.tif_centre.value_or(made_here ? TifCentre{TifCentre::Kind::Given, {}}
                                                                 : TifCentre{TifCentre::Kind::Middle, {}});
  HeightMap mended = rates;
  if (options.tif_pedestal) mend_pedestal(mended, *options.tif_pedestal);
  RemovalFunction tif = measured_removal(mended, centre);
  const RateRim rim = rate_rim(rates);
  const RemovalFunction as_read = measured_removal(rates, {TifCentre::Kind::Given, {}});
  tif.file = {rates.grid.origin - tif.samples.grid.origin,
              axis_source(options, made_here),
              as_read.peak,
              rim.mean,
              rim.largest,
              rim.scatter,
              std::nullopt};
  if (options.tif_pedestal && *options.tif_pedestal != TifPedestal::Accept) {
    const RateRim used = rate_rim(mended);
    tif.file->mended = TifFile::Mended{tif.peak, used.mean, used.largest};
  }
  tif.notes = notes_of(question_tool({rates, tif, !options.tif_centre && !made_here, options.tif_pedestal}));
  if (rates.unit_assumed) tif.notes.emplace_back("no unit in the file: taken as nm/s; `tif unit` states it");
  for (std::string& note : tif.notes) note = with_option_names(note, flag_of);
  return tif;
}

/// Options that prepare a file of rates mean nothing elsewhere.
void refuse_file_options(const JobOptions& options, const std::string& why) {
  if (!options.tif_steps.empty()) throw InputError(fmt::format("--tif-steps {}: {}", options.tif_steps, why));
  if (options.tif_pedestal)
    throw InputError(fmt::format("--tif-pedestal {}: {}", to_string(*options.tif_pedestal), why));
}

/// Options that say how to read a file mean nothing for a formula.
void refuse_reading_options(const JobOptions& o) {
  const auto refuse = [&o](bool given, const char* option, const std::string& value) {
    if (given)
      throw InputError(fmt::format("--{} {}: for a file of rates, not for the formula {}", option, value, o.tif));
  };
  refuse(o.tif_pixel_mm.has_value(), "tif-pixel", o.tif_pixel_mm ? pitch_option_text(*o.tif_pixel_mm) : "");
  refuse(!o.tif_unit.empty(), "tif-unit", o.tif_unit);
  refuse(o.tif_centre.has_value(), "tif-centre", to_string(o.tif_centre));
  refuse(o.tif_no_data.has_value(), "tif-no-data", o.tif_no_data ? to_string(*o.tif_no_data) : "");
  refuse(o.tif_table.has_value(), "tif-table", o.tif_table ? to_string(*o.tif_table) : "");
  refuse(o.tif_rows.has_value(), "tif-rows", o.tif_rows ? to_string(*o.tif_rows) : "");
  refuse(o.tif_grid.has_value(), "tif-grid", dwell::to_string(o.tif_grid));
}

/// The tool as runs have shown it to be.
RemovalFunction scaled(RemovalFunction tif, const JobOptions& options) {
  if (options.tif_rate == 1.0 && options.tif_width == 1.0) return tif;
  RemovalFunction changed = scaled_removal(tif, options.tif_rate, options.tif_width);
  changed.samples.history.push_back(
      fmt::format("{:.6g} times the volume in a second, {:.6g} times as wide", options.tif_rate, options.tif_width));
  return changed;
}

}  // namespace

RemovalFunction load_removal_function(const JobOptions& options, std::vector<InputFile>& inputs,
                                      const Progress& progress) {
  if (options.tif.empty()) throw InputError("--tif: required; a file of rates, or gaussian:peak=1,fwhm=2.8,radius=5");
  const ToolOrientation orientation{options.tif_angle_deg, options.tif_flip};
  if (is_removal_model(split_kind(options.tif).first)) {
    if (options.tif_dwell_time_s) {
      throw InputError(
          fmt::format("--tif-dwell-time {}: for the file of a surface that spots left, not for the formula {}",
                      *options.tif_dwell_time_s, options.tif));
    }
    refuse_file_options(options, "for a file of rates, not for the formula " + options.tif);
    refuse_reading_options(options);
    return scaled(oriented(removal_of_spec(parse_spec_text(options.tif, "tif")), orientation), options);
  }
  const std::filesystem::path file = split_map_name(options.tif).file;
  if (options.tif.find(':') != std::string::npos && !std::filesystem::exists(file)) {
    removal_model(split_kind(options.tif).first);  // a misspelt model: says which there are
  }
  if (options.tif_dwell_time_s) refuse_file_options(options, "for a file of rates, not for a surface that spots left");
  RemovalFunction tif;
  std::vector<InputFile> of_steps;
  try {
    tif = oriented(options.tif_dwell_time_s ? removal_of_spots(options) : removal_of_rates(options, of_steps, progress),
                   orientation);
  } catch (const MissingPitch&) {
    throw;
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw InputError(what.find(options.tif) == std::string::npos ? fmt::format("{}: {}", options.tif, what) : what);
  }
  inputs.push_back({"tif", options.tif, sha256_of_file(file)});
  inputs.insert(inputs.end(), of_steps.begin(), of_steps.end());
  return scaled(std::move(tif), options);
}

namespace {

/// Whether only a pitch is missing for the file to be read. What else is wrong about it is said when it is read.
bool lacks_pitch(const std::string& file, const MapReadOptions& read) {
  if (file.empty() || read.pitch) return false;
  try {
    read_map(file, read);
  } catch (const MissingPitch&) {
    return true;
  } catch (const std::exception&) {
    return false;
  }
  return false;
}

}  // namespace

std::vector<std::string> missing_pitches(const JobOptions& options) {
  std::vector<std::string> flags;
  try {
    if (lacks_pitch(options.removal.empty() ? options.map : options.removal, map_reading(options)))
      flags.emplace_back("--map-pixel");
    if (options.tif.empty() || is_removal_model(split_kind(options.tif).first)) return flags;
    const MapQuantity quantity = options.tif_dwell_time_s ? MapQuantity::Height : MapQuantity::Rate;
    if (lacks_pitch(options.tif, tif_reading(options, quantity))) flags.emplace_back("--tif-pixel");
  } catch (const InputError&) {
    // A unit that is none, for instance: said when the file is read.
  }
  return flags;
}

}  // namespace dwell
