#include "core/formats/npy_sidecar.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/whole_file.h"
#include "core/formats/npy.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

bool is_there(const std::filesystem::path& file) {
  std::error_code none;  // a name that cannot be looked up is none
  return std::filesystem::exists(file, none);
}

using Json = nlohmann::ordered_json;

/// Reads the fields of one object, for messages known as `where`.
class SidecarReader {
 public:
  SidecarReader(const Json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object.is_object()) throw InputError(fmt::format("{}: a JSON object is required", where_));
  }

  std::string sha256() const {
    const auto found = object_.find("sha256");
    if (found == object_.end() || !found->is_string()) refuse("sha256", "a string, the SHA-256 of the NPY file");
    return found->get<std::string>();
  }

  SaidOfMap said() const {
    check_pair("pitch_mm", true);
    check_pair("origin_mm", false);
    const auto unit = object_.find("unit");
    if (unit != object_.end() && !unit->is_string() && !unit->is_null()) refuse("unit", "a string");
    std::vector<MapField> fields;
    for (const auto& [key, value] : object_.items()) {
      if (key != "history" && key != "sha256" && key != "previous") add_field(key, value, fields);
    }
    SaidOfMap said = read_map_fields(fields, where_);
    said.header.history = history();
    return said;
  }

 private:
  [[noreturn]] void refuse(const char* field, const char* required) const {
    const auto found = object_.find(field);
    const std::string value =
        found == object_.end() ? "missing" : found->dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60);
    throw InputError(fmt::format("{}: {} = {}; required: {}", where_, field, value, required));
  }

  void check_pair(const char* field, bool positive) const {
    const auto found = object_.find(field);
    if (found == object_.end() || found->is_null()) return;
    if (positive && found->is_number() && found->get<double>() > 0.0) return;  // for x and y
    if (!found->is_array() || found->size() != 2 || !(*found)[0].is_number() || !(*found)[1].is_number()) {
      refuse(field, positive ? "one number > 0, or two [x, y]" : "two numbers [x, y]");
    }
    if (positive && !((*found)[0].get<double>() > 0.0 && (*found)[1].get<double>() > 0.0)) {
      refuse(field, "two numbers > 0");
    }
  }

  std::vector<std::string> history() const {
    std::vector<std::string> lines;
    const auto history = object_.find("history");
    if (history == object_.end()) return lines;
    if (!history->is_array()) refuse("history", "an array of strings");
    for (const Json& step : *history) {
      if (!step.is_string()) refuse("history", "an array of strings");
      lines.push_back(step.get<std::string>());
      if (lines.back().find_first_of("\r\n") != std::string::npos) refuse("history", "a line each step");
    }
    return lines;
  }

  /// Numbers and texts, and those within objects ("grid": {"pitch_mm": ...}) and arrays.
  static void add_field(const std::string& key, const Json& value, std::vector<MapField>& fields) {
    constexpr std::ptrdiff_t kDeepest = 8;  // no program nests further, and the stack ends somewhere
    if (value.is_object()) {
      if (std::count(key.begin(), key.end(), '.') >= kDeepest) return;
      for (const auto& [inner, its_value] : value.items()) {
        add_field(fmt::format("{}.{}", key, inner), its_value, fields);
      }
      return;
    }
    if (value.is_null()) return;  // says nothing
    MapField field;
    field.name = key;
    field.shown = key;
    for (const Json& element : value.is_array() ? value : Json::array({value})) {
      if (element.is_number()) field.numbers.push_back(element.get<double>());
      if (element.is_boolean()) field.numbers.push_back(element.get<bool>() ? 1.0 : 0.0), field.logical = true;
      if (element.is_string()) field.texts.push_back(element.get<std::string>());
    }
    fields.push_back(std::move(field));
  }

  const Json& object_;
  std::string where_;
};

Json parse_json(const std::string& text, const std::string& where) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: no sidecar of an NPY file: {}", where, error.what()));
  }
}

Json entry_of(const HeightMap& map, const std::string& npy) {
  const Grid& grid = map.grid;
  return {{"pitch_mm", {grid.pitch_x, grid.pitch_y}},
          {"origin_mm", {grid.origin.x, grid.origin.y}},
          {"unit", unit_of(map.quantity)},
          {"history", map.history},
          {"sha256", sha256_of(npy)}};
}

/// The object of a sidecar that speaks of the file of this SHA-256; null if none does.
Json entry_for(const Json& sidecar, const std::string& sha256, const std::string& where) {
  if (SidecarReader(sidecar, where).sha256() == sha256) return sidecar;
  const auto previous = sidecar.find("previous");
  const std::string inner = where + ", previous";
  if (previous != sidecar.end() && SidecarReader(*previous, inner).sha256() == sha256) return *previous;
  return nullptr;
}

/// What is known of the file that is about to be replaced; at least its SHA-256.
Json entry_of_existing(const std::filesystem::path& npy_file, const std::filesystem::path& sidecar) {
  const std::string sha256 = sha256_of_file(npy_file);
  Json entry = nullptr;
  try {
    const std::string where = sidecar.string();
    if (is_there(sidecar)) entry = entry_for(parse_json(read_whole_file(sidecar), where), sha256, where);
  } catch (const InputError&) {
    // What cannot be read says nothing; it is about to be replaced.
  }
  if (entry.is_null()) return {{"sha256", sha256}};
  entry.erase("previous");
  return entry;
}

}  // namespace

std::filesystem::path npy_sidecar_name(const std::filesystem::path& npy_file) { return npy_file.string() + ".json"; }

SaidOfMap parse_npy_sidecar(const std::string& text, const std::string& sha256, const std::string& where) {
  const Json sidecar = parse_json(text, where);
  const Json entry = entry_for(sidecar, sha256, where);
  if (entry.is_null()) {
    throw InputError(fmt::format(
        "{}: stale; its sha256 is {}, but that of the NPY file is {}. Remove the sidecar (and give pitch and "
        "origin as options) or restore the file it was written with",
        where, in_quotes(sidecar["sha256"].get<std::string>()), sha256));
  }
  return SidecarReader(entry, where).said();
}

SaidOfMap read_npy_sidecar(const std::filesystem::path& npy_file, std::string_view bytes) {
  const std::filesystem::path sidecar = npy_sidecar_name(npy_file);
  if (!is_there(sidecar)) return {};
  return parse_npy_sidecar(read_whole_file(sidecar), sha256_of(bytes), sidecar.string());
}

void add_npy_sidecar(const std::filesystem::path& npy_file, std::string_view bytes, MapSource& source) {
  SaidOfMap said = read_npy_sidecar(npy_file, bytes);
  const std::string sidecar = npy_sidecar_name(npy_file.filename()).string();
  source.header = std::move(said.header);
  source.unclear_origin = std::move(said.unclear_origin);
  source.pitch_field = fmt::format("{}: {}", sidecar, said.pitch_field);
  source.pitch_hint = fmt::format(", or put its sidecar {} beside it", sidecar);
  if (!said.unclear_pitch.empty()) {
    source.pitch_hint = fmt::format(
        "; its sidecar {} leaves open of what it is, in which unit, or whether x or y comes "
        "first: {}",
        sidecar, said.unclear_pitch);
  }
}

void stage_npy_with_sidecar(const std::filesystem::path& npy_file, const HeightMap& map, StagedFiles& files) {
  const std::filesystem::path sidecar = npy_sidecar_name(npy_file);
  const std::string npy = npy_bytes(map);
  const Json entry = entry_of(map, npy);
  constexpr int kIndent = 2;
  const auto stage = [&](const Json& json) {
    files.add(sidecar, json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n");
  };
  const bool replaces = is_there(npy_file);
  Json both = entry;
  if (replaces) both["previous"] = entry_of_existing(npy_file, sidecar);
  stage(both);
  files.add(npy_file, npy);
  if (replaces) stage(entry);
}

}  // namespace dwell
