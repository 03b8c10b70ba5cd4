#include "core/formats/sdf_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/word_list.h"
#include "core/formats/map_fields.h"
#include "core/formats/map_header.h"
#include "core/formats/text_grid.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr char kBcrComment = ';';       // of BCR
constexpr std::string_view kEnd = "*";  // of header, data and trailer
/// DDMMYYYYHHMM. Always the same, so that the same map gives the same bytes, and a date, since other readers parse it.
constexpr std::string_view kFixedDate = "010120000000";
constexpr double kMetresPerNm = 1e-9;
constexpr double kMmPerMetre = 1e3;

std::string_view without_comment(std::string_view line) { return trim(line.substr(0, line.find(kBcrComment))); }

/// A field that the standard does not have, for a look at what it speaks of.
MapField other_field(std::string_view name, std::string_view value, std::string place) {
  MapField field;
  field.name = std::string(name);
  field.shown = fmt::format("{} {}", place, name);
  if (const auto number = finite_number(value)) {
    field.numbers = {*number};
  } else {
    field.texts = {std::string(value)};
  }
  return field;
}

/// Takes what other fields say of the map. The standard has all lengths in m, and BAD for no data.
void take_other_fields(const std::vector<MapField>& fields, MapSource& source, const std::string& where) {
  const SaidOfMap said = read_map_fields(fields, where);
  if (said.header.unit && known_length_unit(*said.header.unit) != units::kNmPerM) {
    throw InputError(
        fmt::format("{}: the SDF file says a unit of {}; Xscale, Yscale and Zscale are in m, so m is required", where,
                    in_quotes(*said.header.unit)));
  }
  if (!said.header.no_data.empty()) {
    throw InputError(fmt::format("{}: the SDF file says that {} is no data; BAD is required for it", where,
                                 said.header.no_data.front()));
  }
  source.header.unclear.insert(source.header.unclear.end(), said.header.unclear.begin(), said.header.unclear.end());
  if (said.header.origin && !source.header.origin) source.header.origin = said.header.origin;
  if (!source.header.origin) source.unclear_origin = said.unclear_origin;
}

/// The fields of the first record, by name in lower case.
class SdfHeader {
 public:
  SdfHeader(TextLines& lines, const std::string& where) : where_(where) {
    while (lines.next()) {
      const std::string_view line = without_comment(lines.line());
      if (line == kEnd) return;
      if (!line.empty()) take(line, lines.number());
    }
    throw InputError(fmt::format("{}: truncated SDF file; its header does not end with a line *", where_));
  }

  /// The text of a field, which must be there.
  std::string_view text(const char* name) const {
    const auto found = fields_.find(lower_case(name));
    if (found == fields_.end()) throw InputError(fmt::format("{}: SDF header has no {}", where_, name));
    return found->second;
  }

  Index count(const char* name) const {
    const std::optional<Index> value = parse_count(text(name));
    if (!value) refuse(name, "a whole number >= 1");
    return *value;
  }

  double positive(const char* name) const {
    const std::optional<double> value = finite_number(text(name));
    if (!value || !(*value > 0.0)) refuse(name, "a finite number > 0 [m]");
    return *value;
  }

  /// A code that means "none".
  void require_none(const char* name) const {
    const std::string value = lower_case(text(name));
    if (value != "0" && value != "null" && value != "none") refuse(name, "0 (none)");
  }

  /// Those that the standard does not have.
  std::vector<MapField> others() const {
    static constexpr std::array<std::string_view, 12> kKnown{"manufacid",   "createdate",  "moddate",  "numpoints",
                                                             "numprofiles", "xscale",      "yscale",   "zscale",
                                                             "zresolution", "compression", "datatype", "checktype"};
    std::vector<MapField> fields;
    for (const auto& [name, value] : fields_) {
      if (!is_among(name, kKnown)) {
        fields.push_back(other_field(name, value, "SDF header field"));
      }
    }
    return fields;
  }

  /// DataType says how a binary file would store the values; as text they are numbers all the same.
  void require_data_type() const {
    static constexpr std::array<std::string_view, 16> kTypes{
        "0",     "1",        "2",        "3",     "4",    "5",       "6",       "7",
        "uchar", "uinteger", "ulongint", "float", "char", "integer", "longint", "double"};
    if (!is_among(lower_case(text("DataType")), kTypes)) {
      refuse("DataType", "0 to 7");
    }
  }

 private:
  [[noreturn]] void refuse(const char* name, const char* required) const {
    throw InputError(
        fmt::format("{}: SDF header says {} = {}; required: {}", where_, name, in_quotes(text(name)), required));
  }

  void take(std::string_view line, long number) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
      throw InputError(fmt::format("{}, line {}: {} in the SDF header; name = value, or * at its end, is required",
                                   where_, number, in_quotes(line)));
    }
    const std::string_view name = trim(line.substr(0, equals));
    if (!fields_.emplace(lower_case(name), trim(line.substr(equals + 1))).second) {
      throw InputError(
          fmt::format("{}, line {}: {} is given a second time; once is accepted", where_, number, in_quotes(name)));
    }
  }

  std::string where_;
  std::map<std::string, std::string_view> fields_;
};

/// Whether the first profile has the largest y. Throws unless the version is one that is read.
bool first_profile_on_top(std::string_view magic, const std::string& where) {
  if (magic == "aISO-1.0" || magic == "aISO-2.0") return false;
  if (magic == "aBCR-1.0") return true;
  throw InputError(fmt::format(
      "{}: begins with {}; aISO-1.0, aISO-2.0 or aBCR-1.0 is required (an SDF file as text; export a binary one as "
      "ASCII)",
      where, in_quotes(magic)));
}

/// A line of the trailer of other programs, "name = value" or "<name>value</name>", as a field; nothing if it is none.
std::optional<MapField> trailer_field(std::string_view line) {
  const bool tag = line.starts_with('<');
  const std::size_t at = line.find(tag ? '>' : '=');
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view name = trim(line.substr(tag ? 1 : 0, tag ? at - 1 : at));
  std::string_view value = line.substr(at + 1);
  if (tag) value = value.substr(0, value.find('<'));
  return other_field(name, trim(value), "SDF trailer field");
}

/// What `sdf_text` writes into the trailer, and the fields of others. The pitches there have all digits; they must be
/// those of the header.
void read_trailer(TextLines& lines, const std::string& where, MapHeader& header, std::vector<MapField>& others) {
  const Point pitch = *header.pitch;
  header.pitch.reset();
  while (lines.next()) {
    const std::string_view line = trim(lines.line());
    if (line.starts_with('#')) {
      read_header_line(line, fmt::format("{}, line {}", where, lines.number()), header);
    } else if (auto field = trailer_field(line)) {
      others.push_back(std::move(*field));
    }
  }
  if (!header.unit) header.unit = "nm";
  if (*header.unit != "nm") {
    throw InputError(fmt::format("{}: trailer says unit {}; nm is required, as Zscale is in m", where, *header.unit));
  }
  if (!header.pitch) header.pitch = pitch;
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-12 * b; };
  if (!same(header.pitch->x, pitch.x) || !same(header.pitch->y, pitch.y)) {
    throw InputError(
        fmt::format("{}: trailer says pitch_mm = {},{}, but Xscale and Yscale say {},{} mm; they must agree", where,
                    header.pitch->x, header.pitch->y, pitch.x, pitch.y));
  }
}

/// What the trailer holds for a character of a header line. The file is ASCII, and readers that split it at every
/// asterisk would take one in the history for the end of the trailer.
std::string in_trailer(char c) {
  if (c == '\n') return "\r\n";
  const bool printable = c >= ' ' && c <= '~';
  return std::string(1, printable && c != kEnd.front() ? c : '?');
}

}  // namespace

bool is_sdf(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::array kMagics{"aISO-"sv, "bISO-"sv, "aBCR-"sv, "bBCR-"sv};
  return std::any_of(kMagics.begin(), kMagics.end(), [&](std::string_view magic) { return bytes.starts_with(magic); });
}

MapSource parse_sdf_text(std::string_view text, const std::string& where, const PixelLimit& limit) {
  TextLines lines(text);
  const std::string_view magic = lines.next() ? without_comment(lines.line()) : std::string_view();
  TextGrid grid;
  grid.top_first = first_profile_on_top(magic, where);
  grid.no_data = "BAD";
  grid.limit = limit;
  const SdfHeader header(lines, where);
  header.require_none("Compression");
  header.require_none("CheckType");
  header.require_data_type();
  grid.cols = header.count("NumPoints");
  grid.rows = header.count("NumProfiles");
  const double nm = header.positive("Zscale") / kMetresPerNm;
  const double pitch_x = header.positive("Xscale") * kMmPerMetre;
  // A single profile has no distance to the next: writers put 0.
  const bool no_pitch_y = grid.rows == 1 && finite_number(header.text("Yscale")) == 0.0;
  const double pitch_y = no_pitch_y ? pitch_x : header.positive("Yscale") * kMmPerMetre;
  if (!std::isfinite(nm) || !std::isfinite(pitch_x) || !std::isfinite(pitch_y)) {
    throw InputError(fmt::format("{}: Xscale, Yscale or Zscale is beyond any surface", where));
  }
  // A hundred times the pixels of any instrument: such a scale is in mm, not in m as the format has it.
  constexpr double kWidestPitch = 50.0;  // [mm]
  if (std::max(pitch_x, pitch_y) > kWidestPitch) {
    throw InputError(
        fmt::format("{}: SDF header: Xscale = {}, Yscale = {} [m] is a pitch of {} x {} mm; the scales are "
                    "in m (0.0005 is 0.5 mm), and at most 0.05 is accepted",
                    where, header.text("Xscale"), header.text("Yscale"), pitch_x, pitch_y));
  }
  TextWords words(lines, kBcrComment);
  MapSource source;
  source.rows = grid.rows;
  source.cols = grid.cols;
  source.header.pitch = Point{pitch_x, pitch_y};
  source.pitch_field =
      fmt::format("SDF header: Xscale = {}, Yscale = {} [m]", header.text("Xscale"), header.text("Yscale"));
  source.raw_factor = nm;
  source.values = read_text_grid(
      words, grid, text.size(),
      [nm](std::string_view word) {
        if (word.size() == 3 && lower_case(word) == "bad")
          return std::optional(std::numeric_limits<double>::quiet_NaN());
        std::optional<double> value = finite_number(word);
        if (value) *value *= nm;
        return value;
      },
      where);
  if (!words.next() || words.word() != kEnd) {
    throw InputError(fmt::format("{}, line {}: a line * is required after NumProfiles = {} times NumPoints = {} values",
                                 where, words.line(), source.rows, source.cols));
  }
  std::vector<MapField> others = header.others();
  read_trailer(lines, where, source.header, others);
  take_other_fields(others, source, where);
  return source;
}

std::string sdf_text(const HeightMap& map) {
  if (map.quantity != MapQuantity::Height) {
    throw InputError("a surface data file (.sdf) holds heights, not removal rates; .csv, .npy or .h5 hold either");
  }
  const Grid& grid = map.grid;
  fmt::memory_buffer buffer;
  auto out = std::back_inserter(buffer);
  fmt::format_to(out,
                 "aISO-1.0\r\nManufacID = dwell\r\nCreateDate = {0}\r\nModDate = {0}\r\n"
                 "NumPoints = {1}\r\nNumProfiles = {2}\r\nXscale = {3}\r\nYscale = {4}\r\nZscale = {5}\r\n"
                 "Zresolution = -1\r\nCompression = 0\r\nDataType = 7\r\nCheckType = 0\r\n*\r\n",
                 kFixedDate, grid.cols, grid.rows, grid.pitch_x / kMmPerMetre, grid.pitch_y / kMmPerMetre,
                 kMetresPerNm);
  for (Index row = 0; row < grid.rows; ++row) {
    for (Index col = 0; col < grid.cols; ++col) {
      if (col > 0) buffer.push_back(' ');
      const double value = map.at(row, col);
      if (std::isnan(value)) {
        fmt::format_to(out, "BAD");
      } else {
        fmt::format_to(out, "{}", value);
      }
    }
    fmt::format_to(out, "\r\n");
  }
  fmt::format_to(out, "*\r\n");
  std::string text = fmt::to_string(buffer);
  for (const char c : header_lines(map)) text += in_trailer(c);
  return text + "*\r\n";
}

}  // namespace dwell
