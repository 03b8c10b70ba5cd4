#include "runs/job/input_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/spec_text.h"
#include "core/base/threads.h"
#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/formats/map_name.h"
#include "core/map/value_units.h"
#include "core/tif/calibration/spot_calibration.h"
#include "core/tif/models/removal_models.h"
#include "core/tif/removal_orientation.h"
#include "runs/map_steps/map_steps.h"

namespace dwell {

Point parse_point(const std::string& text) {
  const auto fields = split(text, ',');
  if (fields.size() == 2) {
    const auto x = finite_number(fields[0]), y = finite_number(fields[1]);
    if (x && y) return {*x, *y};
  }
  throw InputError(fmt::format("'{}'; required X,Y in mm, for instance -12.5,3", text));
}

TifCentre parse_tif_centre(const std::string& text) {
  if (text == "middle") return {TifCentre::Kind::Middle, {}};
  if (text == "centroid") return {TifCentre::Kind::Centroid, {}};
  try {
    return {TifCentre::Kind::Given, parse_point(text)};
  } catch (const InputError&) {
    throw InputError(fmt::format("'{}'; accepted: auto, middle, centroid, or X,Y in mm", text));
  }
}

HeightMap load_map(const JobOptions& options, std::vector<InputFile>& inputs, const Progress& progress) {
  if (options.map.empty()) throw InputError("--map: required; a height-error map, for instance mirror.csv");
  const MapReadOptions read{options.map_pixel_mm, options.map_origin_mm, height_unit_nm(options.map_unit), "map"};
  HeightMap map = read_map(options.map, read);
  inputs.push_back({"map", options.map, sha256_of_file(split_map_name(options.map).file)});
  MapStepContext context{read, &inputs, thread_count(options.threads), progress.of_part("map")};
  apply_map_steps(map, parse_map_steps(options.map_steps), context);
  return map;
}

namespace {

/// The removal function from the surface that spots of a known dwell time left.
RemovalFunction removal_of_spots(const JobOptions& options) {
  const std::string unit = options.tif_unit == JobOptions{}.tif_unit ? "nm" : options.tif_unit;
  const MapReadOptions read{options.tif_pixel_mm, std::nullopt, height_unit_nm(unit), "tif", MapQuantity::Height};
  HeightMap depth = read_map(options.tif, read);
  for (double& value : depth.values) value = -value;
  SpotOptions spots;
  spots.dwell_time = *options.tif_dwell_time_s;
  if (options.tif_centre == "middle") {
    throw InputError(
        "--tif-centre middle: a spot may lie anywhere in its file; accepted: auto, centroid, or X,Y in mm");
  }
  if (options.tif_centre != "auto" && options.tif_centre != "centroid") {
    spots.at = {parse_point(options.tif_centre)};
    spots.centre = SpotCentre::Given;
  }
  return measured_removal(calibrate_spots(depth, spots).rates, {TifCentre::Kind::Given, {}});
}

TifCentre centre_of(const HeightMap& rates, const std::string& wanted) {
  if (wanted != "auto") return parse_tif_centre(wanted);
  const bool made_here =
      std::find(rates.history.begin(), rates.history.end(), kToolAxisAtOrigin) != rates.history.end();
  return made_here ? TifCentre{TifCentre::Kind::Given, {}} : TifCentre{};
}

RemovalFunction removal_of_rates(const JobOptions& options) {
  const MapReadOptions read{options.tif_pixel_mm, std::nullopt, rate_unit_nm_per_s(options.tif_unit), "tif",
                            MapQuantity::Rate};
  const HeightMap rates = read_map(options.tif, read);
  return measured_removal(rates, centre_of(rates, options.tif_centre));
}

}  // namespace

RemovalFunction load_removal_function(const JobOptions& options, std::vector<InputFile>& inputs) {
  if (options.tif.empty()) throw InputError("--tif: required; a file of rates, or gaussian:peak=1,fwhm=2.8,radius=5");
  const ToolOrientation orientation{options.tif_angle_deg, parse_flip(options.tif_flip)};
  if (is_removal_model(split_kind(options.tif).first)) {
    if (options.tif_dwell_time_s) {
      throw InputError(
          fmt::format("--tif-dwell-time {}: for the file of a surface that spots left, not for the formula {}",
                      *options.tif_dwell_time_s, options.tif));
    }
    return oriented(removal_of_spec(parse_spec_text(options.tif, "tif")), orientation);
  }
  const std::filesystem::path file = split_map_name(options.tif).file;
  if (options.tif.find(':') != std::string::npos && !std::filesystem::exists(file)) {
    removal_model(split_kind(options.tif).first);  // a misspelt model: says which there are
  }
  RemovalFunction tif;
  try {
    tif = oriented(options.tif_dwell_time_s ? removal_of_spots(options) : removal_of_rates(options), orientation);
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw InputError(what.find(options.tif) == std::string::npos ? fmt::format("{}: {}", options.tif, what) : what);
  }
  inputs.push_back({"tif", options.tif, sha256_of_file(file)});
  return tif;
}

void check_tool_fits(const RemovalFunction& tif, const Grid& map) {
  if (2.0 * tif.radius > map.width() && 2.0 * tif.radius > map.height()) {
    const bool measured = tif.kind == RemovalFunction::Kind::Measured;
    throw InputError(fmt::format(
        "removal function of {:.4g} mm diameter is larger than the map of {:.4g} x {:.4g} mm both ways; check {} and "
        "--map-pixel (the map has {:.6g} mm)",
        2.0 * tif.radius, map.width(), map.height(),
        measured ? fmt::format("--tif-pixel (the file has {:.6g} mm)", tif.samples.grid.pitch_x) : "--tif (its radius)",
        map.pitch_x));
  }
}

}  // namespace dwell
