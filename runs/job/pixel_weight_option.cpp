#include "runs/job/pixel_weight_option.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/pitch.h"
#include "core/base/spec_text.h"
#include "core/base/value_range.h"
#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/formats/map_name.h"
#include "runs/plan/pixel_weights.h"

namespace dwell {
namespace {

constexpr std::string_view kEdge = "edge:", kCentre = "centre=";

/// A term, read.
struct WeightTerm {
  enum class Kind { Edge, Centre, File } kind = Kind::File;
  std::string text;  // as given; of a file its name
  double width = 0.0, weight = 1.0;
};

double weight_of(const std::string& text) {
  const auto value = parse_number(text);
  if (value && ranges::kWeight.holds(*value)) return *value;
  throw InputError(fmt::format("'centre={}'; required a weight, {}", text, ranges::kWeight.text()));
}

WeightTerm parse_term(const std::string& text) {
  if (text.starts_with(kCentre)) return {WeightTerm::Kind::Centre, text, 0.0, weight_of(text.substr(kCentre.size()))};
  if (text.starts_with(kEdge)) {
    const SpecText spec = parse_spec_text(text, "weight");
    spec.accept_only({"width", "weight"});
    return {WeightTerm::Kind::Edge, text, spec.number("width", ranges::kSize), spec.number("weight", ranges::kWeight)};
  }
  for (const std::string_view word : {"edge", "centre", "center"}) {
    if (text == word || text.starts_with(std::string(word) + '=') || text.starts_with(std::string(word) + ':')) {
      throw InputError(fmt::format("'{}'; accepted: edge:width=MM,weight=W, centre=W, or the name of a file", text));
    }
  }
  return {WeightTerm::Kind::File, text, 0.0, 1.0};
}

std::vector<WeightTerm> parse_terms(const std::string& text) {
  std::vector<WeightTerm> terms;
  for (const std::string_view part : split(text, ';')) {
    if (const std::string term(trim(part)); !term.empty()) terms.push_back(parse_term(term));
  }
  return terms;
}

std::string grid_words(const Grid& g) {
  return fmt::format("{} rows x {} columns of {}, the first pixel at {:.6g},{:.6g} mm", g.rows, g.cols, pitch_text(g),
                     g.origin.x, g.origin.y);
}

bool is_on(const Grid& a, const Grid& b) {
  constexpr double kSame = 1e-6;  // of a pixel
  const auto same = [&](double x, double y, double pitch) { return std::abs(x - y) <= kSame * pitch; };
  return a.rows == b.rows && a.cols == b.cols && same(a.pitch_x, b.pitch_x, b.pitch_x) &&
         same(a.pitch_y, b.pitch_y, b.pitch_y) && same(a.origin.x, b.origin.x, b.pitch_x) &&
         same(a.origin.y, b.origin.y, b.pitch_y);
}

/// The numbers of a file, which takes pitch and origin from the map where it has none.
HeightMap read_weights(const std::string& file, const Grid& grid) {
  MapReadOptions read;
  read.name = "weight";
  try {
    return read_map(file, read);
  } catch (const MissingPitch&) {
    read.pitch = Point{grid.pitch_x, grid.pitch_y};
    read.origin = grid.origin;
    return read_map(file, read);
  }
}

/// The map within the clear aperture.
HeightMap inside_of(const HeightMap& map, const Aperture& clear) {
  try {
    return within(map, clear);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--clear-aperture: {}", error.what()));
  }
}

std::vector<double> weights_of_file(const std::string& file, const HeightMap& map, const std::string& map_file,
                                    std::vector<InputFile>& inputs) {
  HeightMap weights;
  try {
    weights = read_weights(file, map.grid);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("--weight {}: {}; accepted: such a file, edge:width=MM,weight=W or centre=W", file, error.what()));
  }
  if (!weights.unit_assumed)
    throw InputError(fmt::format("--weight {}: the file says a unit; weights are plain numbers", file));
  if (!is_on(weights.grid, map.grid)) {
    throw InputError(fmt::format("--weight {}: {}; required the grid of the map {} (after its steps): {}", file,
                                 grid_words(weights.grid), map_file, grid_words(map.grid)));
  }
  std::vector<double> values = weights.values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) values[i] = 0.0;
    if (ranges::kWeight.holds(values[i])) continue;
    const auto pixel = static_cast<Index>(i);
    throw InputError(fmt::format("--weight {}: {} in row {}, column {}; required {}", file, values[i],
                                 pixel / map.grid.cols + 1, pixel % map.grid.cols + 1, ranges::kWeight.text()));
  }
  inputs.push_back({"weight", file, sha256_of_file(split_map_name(file).file)});
  return values;
}

}  // namespace

void check_pixel_weights(const std::string& text) {
  if (parse_terms(text).empty()) throw InputError(fmt::format("'{}' holds no weight", text));
}

std::string renamed_pixel_weights(const std::string& text, const std::function<std::string(const std::string&)>& name) {
  std::string renamed;
  for (const WeightTerm& term : parse_terms(text)) {
    renamed += renamed.empty() ? "" : ";";
    renamed += term.kind == WeightTerm::Kind::File ? name(term.text) : term.text;
  }
  return renamed;
}

std::vector<std::string> pixel_weight_files(const std::string& text) {
  std::vector<std::string> files;
  for (const WeightTerm& term : parse_terms(text)) {
    if (term.kind == WeightTerm::Kind::File) files.push_back(split_map_name(term.text).file.string());
  }
  return files;
}

std::vector<double> load_pixel_weights(const std::string& text, const Aperture& clear, const HeightMap& map,
                                       const std::string& map_file, int threads, std::vector<InputFile>& inputs) {
  const std::vector<WeightTerm> terms = parse_terms(text);
  if (terms.empty() && clear.kind == Aperture::Kind::Map) return {};
  std::vector<double> weights(map.values.size(), 1.0);
  for (const WeightTerm& term : terms) {
    const std::vector<double> factor =
        term.kind == WeightTerm::Kind::Edge     ? weights_at_edge(map, term.width, term.weight, threads)
        : term.kind == WeightTerm::Kind::Centre ? weights_in_centre(map, term.weight)
                                                : weights_of_file(term.text, map, map_file, inputs);
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= factor[i];
  }
  if (clear.kind == Aperture::Kind::Map) return weights;
  const HeightMap inside = inside_of(map, clear);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (std::isnan(inside.values[i])) weights[i] = 0.0;
  }
  return weights;
}

}  // namespace dwell
