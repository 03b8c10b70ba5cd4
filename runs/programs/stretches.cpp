#include "runs/programs/stretches.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <utility>

#include "core/base/counted.h"
#include "core/base/number_text.h"
#include "core/base/text_lines.h"
#include "core/base/utf8_text.h"
#include "core/base/whole_file.h"
#include "runs/programs/number_text.h"
#include "runs/programs/pmac_program.h"
#include "runs/programs/pvt_place.h"
#include "runs/programs/record_lines.h"
#include "runs/programs/xps_trajectory.h"

namespace dwell {
namespace {

constexpr std::string_view kStretchColumns = "file,x_mm,y_mm,way_s,seconds,sha256";
constexpr std::size_t kStretchFields = 6;
constexpr std::string_view kStretchUnits = "x and y of the beginning mm, times s";
constexpr double kSameTime = 1e-6;  // [s] sums of rounded times

std::string_view word_of(StretchKind kind) { return kind == StretchKind::XpsTrajectory ? "xps" : "pmac"; }

/// Rows of a table between which the tool is at work throughout.
std::vector<std::pair<std::size_t, std::size_t>> stretches_of(const PvtTable& table) {
  std::vector<std::pair<std::size_t, std::size_t>> stretches;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    if (table.rows[i].lifted) continue;
    const bool goes_on = !stretches.empty() && stretches.back().second == i - 1;
    if (goes_on) {
      stretches.back().second = i;
    } else {
      stretches.emplace_back(i - 1, i);
    }
  }
  return stretches;
}

class StretchReader {
 public:
  StretchReader(const std::string& file, StretchKind kind, const ReadBeside& beside, const Progress& progress,
                AxisLetters letters)
      : kind_(kind), beside_(beside), progress_(progress), letters_(letters) {
    at_.file = file;
  }

  PvtTable read(std::string_view text) {
    bool in_rows = false;
    for (TextLines lines(text); lines.next();) {
      at_.number = lines.number();
      const std::string_view line = trim(lines.line());
      if (line.empty()) continue;
      if (line.front() == '#') {
        read_header(line.substr(1));
      } else if (in_rows) {
        read_row(line);
      } else if (line == kStretchColumns) {
        in_rows = true;
      } else {
        at_.fail(
            fmt::format("column line \"{}\"; accepted: {}", with_escaped_bytes(line.substr(0, 100)), kStretchColumns));
      }
    }
    at_.number = 0;
    if (!in_rows) at_.fail(fmt::format("no column line; required: {}", kStretchColumns));
    if (static_cast<double>(stretches_) != count_) {
      at_.fail(fmt::format("{}, but the header says {}; required the same (truncated or edited?)",
                           counted(stretches_, "stretch", "stretches"), count_));
    }
    at_.check_end(table_);
    return std::move(table_);
  }

 private:
  void read_header(std::string_view line) {
    line = trim(line);
    const std::size_t colon = line.find(':');
    const std::string_view key = trim(line.substr(0, colon));
    const std::string_view value = colon == std::string_view::npos ? "" : trim(line.substr(colon + 1));
    if (key == "units") {
      if (value != kStretchUnits) {
        at_.fail(fmt::format("units = {}; accepted: {}", in_quotes(with_escaped_bytes(value)), kStretchUnits));
      }
    } else if (key == "stretches") {
      count_ = at_.within(key, value, {1.0, 1e9, ""});
    } else if (key != word_of(kind_)) {
      at_.check_comment(line);
    }
  }

  void read_row(std::string_view line) {
    const std::vector<std::string_view> fields = split(line, ',');
    if (fields.size() != kStretchFields) {
      at_.fail(fmt::format("{}; required {}: {}", counted(fields.size(), "column"), kStretchFields, kStretchColumns));
    }
    const std::string name(fields[0]);
    const Point start{at_.place("x_mm", fields[1]), at_.place("y_mm", fields[2])};
    const double way = at_.within("way_s", fields[3], {0.0, ranges::kTime.most, "s"});
    const double seconds = at_.within("seconds", fields[4], ranges::kTime);
    const std::string bytes = listed_bytes(at_, name, fields[5], beside_);
    go_to(start, way);
    add(kind_ == StretchKind::XpsTrajectory ? parse_xps_trajectory(bytes, name, start, progress_)
                                            : parse_pmac_program(bytes, name, start, progress_, letters_),
        name, seconds);
    ++stretches_;
  }

  /// The lifted way to where a stretch begins.
  void go_to(Point start, double way) {
    if (table_.rows.empty()) {
      table_.rows.push_back({0.0, start, {}, true});
    } else if (way > 0.0) {
      at_.add(table_, {table_.rows.back().seconds + way, start, {}, true, true});
    } else if (distance(table_.rows.back().place, start) > 1e-9) {
      at_.fail("way_s = 0 s from another place; required > 0");
    }
  }

  void add(const PvtTable& stretch, const std::string& name, double seconds) {
    if (!(std::abs(stretch.seconds() - seconds) <= kSameTime)) {
      at_.fail(fmt::format("seconds = {}, but {} takes {} s; required the same", seconds, name, stretch.seconds()));
    }
    const double begin = table_.rows.back().seconds;
    for (std::size_t i = 1; i < stretch.rows.size(); ++i) {
      PvtRow row = stretch.rows[i];
      row.seconds += begin;
      at_.add(table_, row);
    }
  }

  StretchKind kind_;
  const ReadBeside& beside_;
  const Progress& progress_;
  AxisLetters letters_;
  PvtPlace at_;
  PvtTable table_;
  double count_ = 0.0;
  std::size_t stretches_ = 0;
};

}  // namespace

std::vector<WrittenProgram> written_stretches(StretchKind kind, const PvtTable& table, const FeedTable& made,
                                              const Progress& progress, AxisLetters letters) {
  const auto stretches = stretches_of(table);
  fmt::memory_buffer list;
  const auto out = std::back_inserter(list);
  fmt::format_to(out, "# {}: stretches of work with lifted ways between, dwell {}\n# units: {}\n# stretches: {}\n",
                 word_of(kind), made.version, kStretchUnits, stretches.size());
  for (const std::string& line : record_lines(made)) fmt::format_to(out, "# {}\n", line);
  fmt::format_to(out, "{}\n", kStretchColumns);
  std::vector<WrittenProgram> files(1);
  std::size_t end_before = 0;
  for (const auto& stretch : stretches) {
    progress.check();
    const std::size_t first = stretch.first, last = stretch.second;
    const bool xps = kind == StretchKind::XpsTrajectory;
    WrittenProgram file{
        fmt::format("program_{:03}.{}", files.size(), xps ? "trj" : "pmc"),
        xps ? xps_trajectory_text(table, first, last) : pmac_program_text(table, first, last, made, letters)};
    const PvtRow& begin = table.rows[first];
    const double way = begin.seconds - table.rows[end_before].seconds;
    fmt::format_to(out, "{},{},{},{},{},{}\n", file.file, coordinate_text(begin.place.x),
                   coordinate_text(begin.place.y), seconds_text(way),
                   seconds_text(table.rows[last].seconds - begin.seconds), sha256_of(file.bytes));
    files.push_back(std::move(file));
    end_before = last;
  }
  files.front() = {fmt::format("{}.csv", word_of(kind)), fmt::to_string(list)};
  return files;
}

bool is_stretch_list(std::string_view text, StretchKind kind) {
  return text.starts_with(fmt::format("# {}:", word_of(kind)));
}

PvtTable parse_stretch_list(std::string_view text, const std::string& file, StretchKind kind, const ReadBeside& beside,
                            const Progress& progress, AxisLetters letters) {
  return StretchReader(file, kind, beside, progress, letters).read(text);
}

}  // namespace dwell
