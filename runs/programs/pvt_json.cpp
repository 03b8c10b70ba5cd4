#include "runs/programs/pvt_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "core/base/counted.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/utf8_text.h"
#include "core/base/word_list.h"
#include "runs/programs/number_text.h"
#include "runs/programs/pvt_place.h"
#include "runs/programs/record_lines.h"

namespace dwell {
namespace {

using PvtJson = nlohmann::json;

constexpr std::array<std::string_view, 6> kJsonColumns{"t_s", "x_mm", "vx_mm_per_s", "y_mm", "vy_mm_per_s", "lift"};
constexpr std::array<std::string_view, 6> kJsonKeys{"pvt", "units", "made", "total_s", "columns", "rows"};

std::string in_json(const std::string& text) {
  return PvtJson(text).dump(-1, ' ', true, PvtJson::error_handler_t::replace);
}

/// A value for a message: a list or an object, which may be deep, only by its size.
std::string value_text(const PvtJson& value) {
  if (value.is_array()) return fmt::format("a list of {}", value.size());
  if (value.is_object()) return fmt::format("an object of {}", value.size());
  return value.dump(-1, ' ', true, PvtJson::error_handler_t::replace).substr(0, 60);
}

class PvtJsonReader {
 public:
  PvtJsonReader(const std::string& file, const Progress& progress) : poll_(progress) {
    at_.file = file;
    at_.unit = "row";
  }

  PvtTable read(std::string_view text) {
    const PvtJson json = parse(text);
    if (json.is_discarded() || !json.is_object()) at_.fail("is no JSON object; required one with its end (truncated?)");
    for (const auto& entry : json.items()) {
      if (is_among(entry.key(), kJsonKeys)) continue;
      at_.fail(fmt::format("key {} is not known; accepted: pvt, units, made, total_s, columns, rows",
                           in_quotes(with_escaped_bytes(entry.key()))));
    }
    if (of(json, "units") != PvtJson(std::string(kPvtUnits)))
      at_.fail(fmt::format("units = {}; accepted: \"{}\"", value_text(json["units"]), kPvtUnits));
    read_columns(of(json, "columns"));
    const PvtJson& rows = of(json, "rows");
    if (!rows.is_array()) at_.fail("rows is no list; required a list of rows");
    for (const PvtJson& row : rows) {
      poll_.step();
      ++at_.number;
      read_row(row);
    }
    at_.number = 0;
    at_.check_end(table_);
    check_total(of(json, "total_s"));
    return std::move(table_);
  }

 private:
  /// A key that stands twice is refused, for the later one would take the place of the other.
  PvtJson parse(std::string_view text) const {
    std::set<std::string> keys;
    return PvtJson::parse(
        text.begin(), text.end(),
        [this, &keys](int depth, PvtJson::parse_event_t event, PvtJson& value) {
          if (event != PvtJson::parse_event_t::key || depth != 1) return true;
          const auto& key = value.get_ref<const std::string&>();
          if (!keys.insert(key).second)
            at_.fail(fmt::format("a second {}; accepted: one", in_quotes(with_escaped_bytes(key))));
          return true;
        },
        false);
  }

  const PvtJson& of(const PvtJson& json, const char* key) const {
    const auto found = json.find(key);
    if (found == json.end()) at_.fail(fmt::format("key \"{}\" is missing", key));
    return *found;
  }

  void read_columns(const PvtJson& columns) {
    bool same = columns.is_array() && columns.size() == kJsonColumns.size();
    for (std::size_t k = 0; same && k < kJsonColumns.size(); ++k)
      same = columns[k].is_string() && columns[k].get_ref<const std::string&>() == kJsonColumns[k];
    if (!same) {
      at_.fail(
          fmt::format("columns = {}; accepted: [\"t_s\",\"x_mm\",\"vx_mm_per_s\",\"y_mm\",\"vy_mm_per_s\","
                      "\"lift\"]",
                      value_text(columns)));
    }
  }

  double number(const PvtJson& row, std::size_t k, const ValueRange& range) const {
    if (!row[k].is_number()) {
      at_.fail(fmt::format("{} = {}; required a number", kJsonColumns[k], value_text(row[k])));
    }
    const double value = row[k].get<double>();
    at_.check_within(kJsonColumns[k], value, range);
    return value;
  }

  void read_row(const PvtJson& row) {
    if (!row.is_array() || row.size() != kJsonColumns.size()) {
      at_.fail(fmt::format("{}; required a list of {}", value_text(row), counted(kJsonColumns.size(), "number")));
    }
    const double lift = number(row, 5, {0.0, 1.0, ""});
    if (lift != 0.0 && lift != 1.0) at_.fail(fmt::format("lift = {}; accepted: 0, 1", lift));
    at_.add(table_, {number(row, 0, {0.0, ranges::kTime.most, "s"}),
                     {number(row, 1, ranges::kPlace), number(row, 3, ranges::kPlace)},
                     {number(row, 2, kPvtSpeeds), number(row, 4, kPvtSpeeds)},
                     lift == 1.0});
  }

  void check_total(const PvtJson& total) const {
    if (total.is_number() && std::abs(total.get<double>() - table_.seconds()) <= 1e-8) return;
    at_.fail(fmt::format("total_s = {}, but the rows end at {} s; required the same (edited?)", value_text(total),
                         table_.seconds()));
  }

  Poll poll_;
  PvtPlace at_;
  PvtTable table_;
};

}  // namespace

std::string pvt_json_text(const PvtTable& table, const FeedTable& made, const Progress& progress) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{{\n\"pvt\": {},\n\"units\": \"{}\",\n\"made\": [", in_json("dwell " + made.version), kPvtUnits);
  const char* comma = "";
  for (const std::string& line : record_lines(made)) {
    fmt::format_to(out, "{}\n{}", comma, in_json(line));
    comma = ",";
  }
  fmt::format_to(out, "],\n\"total_s\": {},\n\"columns\": [", seconds_text(table.seconds()));
  comma = "";
  for (const std::string_view column : kJsonColumns) {
    fmt::format_to(out, "{}\"{}\"", comma, column);
    comma = ", ";
  }
  fmt::format_to(out, "],\n\"rows\": [");
  comma = "";
  Poll poll(progress);
  for (const PvtRow& row : table.rows) {
    poll.step();
    fmt::format_to(out, "{}\n[{}, {}, {}, {}, {}, {}]", comma, seconds_text(row.seconds), coordinate_text(row.place.x),
                   coordinate_text(row.speed.x), coordinate_text(row.place.y), coordinate_text(row.speed.y),
                   row.lifted ? 1 : 0);
    comma = ",";
  }
  fmt::format_to(out, "\n]\n}}\n");
  return fmt::to_string(text);
}

bool is_pvt_json(std::string_view text) { return text.starts_with('{'); }

PvtTable parse_pvt_json(std::string_view text, const std::string& file, const Progress& progress) {
  return PvtJsonReader(file, progress).read(without_byte_order_mark(text));
}

}  // namespace dwell
