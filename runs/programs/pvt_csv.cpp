#include "runs/programs/pvt_csv.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "core/base/counted.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/utf8_text.h"
#include "runs/programs/number_text.h"
#include "runs/programs/pvt_place.h"
#include "runs/programs/record_lines.h"

namespace dwell {
namespace {

constexpr std::string_view kPvtColumns = "t_s,x_mm,vx_mm_per_s,y_mm,vy_mm_per_s";
constexpr std::string_view kBarePvtColumns = "t,x,vx,y,vy";  // in the units of a header line
constexpr std::string_view kLiftColumn = ",lift";
constexpr std::size_t kMostPvtFields = 6;

class PvtCsvReader {
 public:
  PvtCsvReader(std::string_view text, const std::string& file, const Progress& progress)
      : lines_(text), poll_(progress) {
    at_.file = file;
  }

  PvtTable read() {
    bool in_rows = false;
    while (lines_.next()) {
      poll_.step();
      at_.number = lines_.number();
      const std::string_view line = lines_.line();
      if (trim(line).empty()) continue;
      if (line.front() == '#') {
        read_header(line.substr(1), in_rows);
      } else if (in_rows) {
        read_row(line);
      } else {
        read_columns(line);
        in_rows = true;
      }
    }
    at_.number = 0;
    if (!in_rows) at_.fail(fmt::format("no column line; required: {}{}", kPvtColumns, kLiftColumn));
    check_end();
    return std::move(table_);
  }

 private:
  void read_header(std::string_view line, bool in_rows) {
    line = trim(line);
    const std::size_t colon = line.find(':');
    const std::string_view key = trim(line.substr(0, colon));
    const std::string_view value = colon == std::string_view::npos ? "" : trim(line.substr(colon + 1));
    if (key == "pvt" || key == "units" || key == "rows" || key == "total_s") {
      if (in_rows) at_.fail(fmt::format("the header line \"{}\" stands after the columns; required before", key));
      read_quantity(key, value);
    } else if (key != "lift") {  // our own sentence about the column
      at_.check_comment(line);
    }
  }

  void read_quantity(std::string_view key, std::string_view value) {
    bool& seen = seen_[key == "pvt" ? 0U : key == "units" ? 1U : key == "rows" ? 2U : 3U];
    if (seen) at_.fail(fmt::format("{} = {} is the second header line of this name; accepted: one", key, value));
    seen = true;
    if (key == "units" && value != kPvtUnits) {
      at_.fail(fmt::format("units = {}; accepted: {}", in_quotes(with_escaped_bytes(value)), kPvtUnits));
    }
    if (key == "rows") rows_ = at_.within(key, value, {2.0, 1e12, ""});
    if (key == "total_s") total_ = at_.within(key, value, ranges::kTime);
  }

  void read_columns(std::string_view line) {
    line = trim(line);
    lift_ = line.ends_with(kLiftColumn);
    const std::string_view columns = lift_ ? line.substr(0, line.size() - kLiftColumn.size()) : line;
    const bool units = seen_[1];
    if (columns == kPvtColumns || (columns == kBarePvtColumns && units)) return;
    at_.fail(
        fmt::format("column line \"{}\"; accepted: {} or {} with the header line \"# units: {}\", each with or "
                    "without {}",
                    with_escaped_bytes(line.substr(0, 100)), kPvtColumns, kBarePvtColumns, kPvtUnits, kLiftColumn));
  }

  void read_row(std::string_view line) {
    std::array<std::string_view, kMostPvtFields> fields;
    const std::size_t wanted = lift_ ? kMostPvtFields : kMostPvtFields - 1;
    std::size_t count = 0;
    for (std::string_view rest = line;;) {
      const std::size_t comma = rest.find(',');
      if (count == wanted) at_.fail(fmt::format("more than {}", counted(wanted, "column")));
      fields[count++] = rest.substr(0, comma);
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    if (count < wanted) at_.fail(fmt::format("{}; required {}", counted(count, "column"), wanted));
    PvtRow row;
    row.seconds = at_.within("t_s", fields[0], {0.0, ranges::kTime.most, "s"});
    row.place = {at_.place("x_mm", fields[1]), at_.place("y_mm", fields[3])};
    row.speed = {at_.speed("vx_mm_per_s", fields[2]), at_.speed("vy_mm_per_s", fields[4])};
    row.lifted = table_.rows.empty();
    if (lift_) {
      const std::string_view lift = trim(fields[5]);
      if (lift != "0" && lift != "1") at_.fail(fmt::format("lift = \"{}\"; accepted: 0, 1", with_escaped_bytes(lift)));
      row.lifted = lift == "1";
    }
    at_.add(table_, row);
  }

  void check_end() {
    const bool ours = seen_[0];
    if (ours && (!rows_ || !total_ || !seen_[1])) {
      at_.fail(
          "one of the header lines \"# units: ...\", \"# rows: NUMBER\", \"# total_s: NUMBER\" is missing, all of "
          "which follow \"# pvt: ...\"");
    }
    if (rows_ && *rows_ != static_cast<double>(table_.rows.size())) {
      at_.fail(fmt::format("{}, but the header says {}; required the same (truncated or edited?)",
                           counted(table_.rows.size(), "row"), *rows_));
    }
    at_.check_end(table_);
    if (total_ && !(std::abs(table_.seconds() - *total_) <= 1e-8)) {
      at_.fail(fmt::format("ends at {} s, but the header says total_s = {} (edited?)", table_.seconds(), *total_));
    }
  }

  TextLines lines_;
  Poll poll_;
  PvtPlace at_;
  PvtTable table_;
  bool lift_ = false;
  std::array<bool, 4> seen_{};  // header lines pvt, units, rows, total_s
  std::optional<double> rows_, total_;
};

}  // namespace

std::string pvt_csv_text(const PvtTable& table, const FeedTable& made, const Progress& progress) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# pvt: dwell {}\n# units: {}\n# rows: {}\n# total_s: {}\n", made.version, kPvtUnits,
                 table.rows.size(), seconds_text(table.seconds()));
  fmt::format_to(out,
                 "# lift: 1 where the way to the row is made with the tool lifted, in rest at its ends; lifting and "
                 "lowering take their time besides\n");
  for (const std::string& line : record_lines(made)) fmt::format_to(out, "# {}\n", line);
  fmt::format_to(out, "{}{}\n", kPvtColumns, kLiftColumn);
  Poll poll(progress);
  for (const PvtRow& row : table.rows) {
    poll.step();
    fmt::format_to(out, "{},{},{},{},{},{}\n", seconds_text(row.seconds), coordinate_text(row.place.x),
                   coordinate_text(row.speed.x), coordinate_text(row.place.y), coordinate_text(row.speed.y),
                   row.lifted ? 1 : 0);
  }
  return fmt::to_string(text);
}

bool is_pvt_csv(std::string_view text) {
  if (text.starts_with("# pvt")) return true;
  for (TextLines lines(text); lines.next();) {
    const std::string_view line = trim(lines.line());
    if (line.empty() || line.front() == '#') continue;
    return line.starts_with(kPvtColumns) || line.starts_with(kBarePvtColumns);
  }
  return false;
}

PvtTable parse_pvt_csv(std::string_view text, const std::string& file, const Progress& progress) {
  return PvtCsvReader(text, file, progress).read();
}

}  // namespace dwell
