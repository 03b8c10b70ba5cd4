#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/units.h"
#include "core/base/utf8_text.h"
#include "core/base/value_range.h"
#include "core/base/whole_file.h"
#include "core/base/word_list.h"
#include "core/formats/path_remark.h"
#include "core/map/unit_mention.h"
#include "paths/feed/plan_program.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/frame_text.h"
#include "runs/programs/recorded_option.h"

namespace dwell {
namespace {

constexpr std::string_view kColumns = "sequence,x_mm,y_mm,dwell_s,feed_mm_per_min,lift";
constexpr std::size_t kColumnCount = 6;

template <typename Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Reads the lines of one feed table in order: header lines, column line, rows.
class FeedTableReader {
 public:
  FeedTableReader(std::string file, std::string_view text, const Progress& progress)
      : file_(std::move(file)), text_(text), poll_(progress) {}

  FeedTable read() {
    bool in_rows = false;
    while (!text_.empty()) {
      const std::string_view line = next_line();
      poll_.step();
      if (line.empty()) continue;
      if (in_rows) {
        read_row(line);
      } else if (line.front() == '#') {
        read_header(line);
      } else if (line == kColumns) {
        check_header();
        in_rows = true;
      } else {
        fail(fmt::format("column line \"{}\"; accepted: {}", line, kColumns));
      }
    }
    if (!in_rows) throw InputError(fmt::format("{}: no column line; required: {}", file_, kColumns));
    check_rows();
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}, line {}: {}", file_, line_number_, what));
  }

  std::string_view next_line() {
    const std::size_t end = text_.find('\n');
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++line_number_;
    return line;
  }

  void read_header(std::string_view line) {
    line.remove_prefix(1);
    if (!line.empty() && line.front() == ' ') line.remove_prefix(1);
    constexpr std::string_view kVersion = "dwell ";  // and a number; "dwell in ms" is a remark
    if (line.starts_with(kVersion) && line.find_first_of("0123456789") == kVersion.size()) {
      table_.version = line.substr(6);
      return;
    }
    const std::size_t colon = line.find_first_of(":=");
    if (colon == std::string_view::npos) return check_remark(line);
    const std::string_view key = trim(line.substr(0, colon));
    const std::string_view value = trim(line.substr(colon + 1));
    if (key == "input") return read_input(value);
    if (key == "machine_frame") return read_frame(value);
    if (is_record(line)) return read_option(value);
    if (key == "path" || is_quantity(key)) return read_quantity(key, value);
    check_remark(line);
  }

  /// A remark that names another unit than the columns do is not skipped.
  void check_remark(std::string_view line) const {
    if (const auto unit = find_other_unit(line)) {
      fail(
          fmt::format("\"{}\" in the comment \"{}\" looks like another unit; accepted: {}, or the comment without a "
                      "unit",
                      with_escaped_bytes(*unit), with_escaped_bytes(line), kFeedTableUnits));
    }
    check_places(line);
  }

  /// Nor one that names other places than x and y in mm, as "y axis down".
  void check_places(std::string_view line) const {
    if (const auto other = find_other_places(line)) {
      fail(fmt::format("the comment \"{}\" looks like {}; accepted: {}, or the comment left out",
                       with_escaped_bytes(line), *other, kFeedTableUnits));
    }
  }

  /// Whether a header line of this name is about the numbers of the table: of these none is skipped. Others are the
  /// user's own.
  static bool is_quantity(std::string_view key) {
    constexpr std::string_view kSeparators = " \t_-./()[]";
    constexpr std::string_view kWords[] = {"unit",     "units", "motion", "feed",  "feedrate", "speed",
                                           "velocity", "rows",  "dwell",  "scale", "factor",   "offset",
                                           "origin",   "x",     "y",      "z",     "lift",     "mm",
                                           "um",       "nm",    "ms",     "inch",  "inches",   "sequence"};
    const std::string lower = lower_case(key);
    std::string_view rest = lower;
    while (true) {
      rest.remove_prefix(std::min(rest.find_first_not_of(kSeparators), rest.size()));
      if (rest.empty()) return false;
      const std::string_view word = rest.substr(0, rest.find_first_of(kSeparators));
      if (is_among(word, kWords)) return true;
      rest.remove_prefix(word.size());
    }
  }

  void read_quantity(std::string_view key, std::string_view value) {
    if (std::find(seen_.begin(), seen_.end(), key) != seen_.end()) {
      fail(fmt::format("{} = {} is the second header line of this name; accepted: one", key, value));
    }
    seen_.emplace_back(key);
    if (key == "motion") {
      read_motion(value);
    } else if (key == "max_feed_mm_per_min") {
      table_.max_feed_mm_per_min = within(key, value, ranges::kFeed);
      has_max_feed_ = true;
    } else if (key == "path") {
      table_.path.kind = value;
    } else if (key == "rows") {
      rows_ = parse<std::size_t>(value);
      if (!rows_) fail(fmt::format("rows = {}; required a whole number", value));
    } else if (key == "total_dwell_s") {
      total_ = number(key, value);
    } else if (key != "units" || value != kFeedTableUnits) {
      fail(
          fmt::format("header line \"{}: {}\" may change what the numbers mean; accepted: motion, "
                      "max_feed_mm_per_min, path, rows, total_dwell_s, input, and \"units: {}\"",
                      key, value, kFeedTableUnits));
    }
  }

  void read_motion(std::string_view value) {
    try {
      table_.motion = parse_motion(std::string(value));
    } catch (const InputError& error) {
      fail(error.what());
    }
    has_motion_ = true;
  }

  /// Of the machine that the table's program.nc is for; the table itself is in the part's coordinates.
  void read_frame(std::string_view value) {
    if (!table_.frame.is_of_part()) fail(fmt::format("machine_frame = {} is the second; accepted: one", value));
    try {
      table_.frame = parse_frame(value);
    } catch (const InputError& error) {
      fail(error.what());
    }
  }

  void read_input(std::string_view value) {
    const std::size_t at = value.rfind(" sha256=");
    if (at == std::string_view::npos) fail(fmt::format("input = {}; required NAME sha256=HASH", value));
    table_.inputs.emplace_back(value.substr(0, at), value.substr(at + 8));
  }

  void read_option(std::string_view value) {
    const std::size_t equals = value.find('=');
    table_.options.emplace_back(trim(value.substr(0, equals)), trim(value.substr(equals + 1)));
  }

  void check_header() const {
    const auto need = [this](bool present, std::string_view line) {
      if (!present) fail(fmt::format("header line \"{}\" is missing before the column line", line));
    };
    need(has_motion_, "# motion: moving|stop");
    need(has_max_feed_, "# max_feed_mm_per_min: NUMBER");
    need(rows_.has_value(), "# rows: NUMBER");
    need(total_.has_value(), "# total_dwell_s: NUMBER");
  }

  double number(std::string_view name, std::string_view text) const {
    const std::optional<double> value = parse<double>(text);
    if (!value || !std::isfinite(*value)) fail(fmt::format("{} = \"{}\"; required a finite number", name, text));
    return *value;
  }

  double within(std::string_view name, std::string_view text, const ValueRange& range) const {
    const double value = number(name, text);
    if (!range.holds(value)) fail(fmt::format("{} = {}; required {}", name, text, range.text()));
    return value;
  }

  void read_row(std::string_view line) {
    std::string_view fields[kColumnCount];
    std::size_t count = 0;
    for (std::string_view rest = line; count < kColumnCount;) {
      const std::size_t comma = rest.find(',');
      fields[count++] = rest.substr(0, comma);
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
      if (count == kColumnCount) fail(fmt::format("\"{}\" has more than {}", line, counted(kColumnCount, "column")));
    }
    if (count < kColumnCount) fail(fmt::format("\"{}\" has {} of {} columns: {}", line, count, kColumnCount, kColumns));
    const std::size_t expected = table_.path.size() + 1;
    if (parse<std::size_t>(fields[0]) != expected) {
      fail(fmt::format("sequence = \"{}\"; required {} (1, 2, ... without gaps)", fields[0], expected));
    }
    if (fields[5] != "0" && fields[5] != "1") fail(fmt::format("lift = \"{}\"; accepted: 0, 1", fields[5]));
    table_.path.points.push_back({number("x_mm", fields[1]), number("y_mm", fields[2])});
    table_.dwell_s.push_back(within("dwell_s", fields[3], {0.0, ranges::kTime.most, "s"}));
    table_.feed_mm_per_min.push_back(within("feed_mm_per_min", fields[4], {0.0, ranges::kFeed.most, "mm/min"}));
    table_.path.lifted.push_back(fields[5] == "1");
    row_lines_.push_back(line_number_);
  }

  void check_rows() {
    const std::size_t n = table_.path.size();
    if (n != *rows_ || n == 0) {
      throw InputError(
          fmt::format("{}: {}, but the header says {}; required the same, at least 1 "
                      "(truncated or edited?)",
                      file_, counted(n, "row"), *rows_));
    }
    double sum = 0.0;
    for (const double dwell : table_.dwell_s) sum += dwell;
    if (!(std::abs(sum - *total_) <= 1e-9 * sum)) {
      throw InputError(
          fmt::format("{}: dwell_s adds up to {:.12g} s, but the header says total_dwell_s = {:.12g} "
                      "(edited?)",
                      file_, sum, *total_));
    }
    if (table_.path.kind.empty()) table_.path.kind = "file";
    const std::vector<Stroke> strokes = strokes_of(table_.path, table_.motion);
    for (std::size_t j = 0; j < n; ++j) {
      poll_.step();
      line_number_ = row_lines_[j];
      check_feed(strokes[j].length(), table_.dwell_s[j], table_.feed_mm_per_min[j]);
    }
  }

  // 4e-6 mm: a stroke has two halves, the ends of each rounded to 1e-6 mm or halfway between such points.
  void check_feed(double length, double dwell, double feed) const {
    const double max_feed = table_.max_feed_mm_per_min;
    if (!(feed <= max_feed * (1.0 + 1e-8))) {
      fail(fmt::format("feed_mm_per_min = {}; the header allows at most {}", feed, max_feed));
    }
    if (table_.motion == Motion::Stop) {
      if (!(std::abs(feed - max_feed) <= 1e-8 * max_feed)) {
        fail(fmt::format("feed_mm_per_min = {}; with motion stop required the maximum feed {}", feed, max_feed));
      }
      return;
    }
    const double run = units::mm_per_s(feed) * dwell;
    if (!(std::abs(run - length) <= 1e-6 * length + 4e-6)) {
      fail(fmt::format("feed_mm_per_min = {} for {} s runs {} mm, but the stroke of this point is {} mm long (edited?)",
                       feed, dwell, run, length));
    }
  }

  std::string file_;
  std::string_view text_;
  Poll poll_;
  std::size_t line_number_ = 0;
  FeedTable table_;
  bool has_motion_ = false;
  bool has_max_feed_ = false;
  std::optional<std::size_t> rows_;
  std::optional<double> total_;
  std::vector<std::size_t> row_lines_;
  std::vector<std::string> seen_;  // header lines, by name
};

}  // namespace

FeedTable parse_feed_table(std::string_view text, const std::string& file, const Progress& progress) {
  return FeedTableReader(file, without_byte_order_mark(text), progress).read();
}

FeedTable read_feed_table(const std::filesystem::path& file, const Progress& progress) {
  return parse_feed_table(read_whole_file(file), file.string(), progress);
}

}  // namespace dwell
