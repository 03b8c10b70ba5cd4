#include "runs/programs/gcode_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/text_lines.h"
#include "core/base/utf8_text.h"
#include "core/base/whole_file.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/number_text.h"
#include "runs/programs/pvt_place.h"
#include "runs/programs/record_lines.h"

namespace dwell {
namespace {

constexpr std::string_view kPartColumns = "file,lines,sha256";
constexpr double kTurn = 1e-4;  // [rad] more than rounding of coordinates explains

std::size_t lines_in(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Lines of a step at most: a lifted one is followed by the way down.
std::size_t most_lines_of(const ProgramStep& step) { return step.removes ? 1 : 3; }

Program part_of(const Program& program, std::size_t first, std::size_t end) {
  Program part;
  part.frame = program.frame;
  const auto begin = program.steps.begin();
  part.steps.assign(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(end));
  return part;
}

/// The angle between two steps; 0 where one of them is a halt.
double turn_between(const ProgramStep& before, const ProgramStep& after) {
  const Point a = before.finish - before.start, b = after.finish - after.start;
  if (!(before.length() > 0.0) || !(after.length() > 0.0)) return 0.0;
  return std::abs(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y));
}

/// Where to cut, of the steps that have room: before which step the next part begins.
std::size_t place_of_cut(const std::vector<ProgramStep>& steps, std::size_t first, std::size_t end) {
  const std::size_t earliest = std::max(first + 1, end - (end - first) / 4);
  std::size_t best = end;
  double sharpest = kTurn;
  for (std::size_t i = end; i >= earliest; --i) {
    if (!steps[i].removes || !steps[i - 1].removes) return i;
    if (const double turn = turn_between(steps[i - 1], steps[i]); turn > sharpest) {
      sharpest = turn;
      best = i;
    }
  }
  return best;
}

class PartListReader {
 public:
  PartListReader(const std::string& file, const GcodeReading& reading, const ReadBeside& beside,
                 const Progress& progress)
      : reading_(reading), beside_(beside), progress_(progress) {
    at_.file = file;
    program_.file = file;
  }

  Program read(std::string_view text) {
    bool in_rows = false;
    for (TextLines lines(text); lines.next();) {
      at_.number = lines.number();
      const std::string_view line = trim(lines.line());
      if (line.empty()) continue;
      if (line.front() == '#') {
        read_header(trim(line.substr(1)));
      } else if (in_rows) {
        read_row(line);
      } else if (line == kPartColumns) {
        in_rows = true;
      } else {
        at_.fail(
            fmt::format("column line \"{}\"; accepted: {}", with_escaped_bytes(line.substr(0, 100)), kPartColumns));
      }
    }
    at_.number = 0;
    if (static_cast<double>(parts_) != count_ || parts_ == 0) {
      at_.fail(
          fmt::format("{}, but the header says count = {}; required the same, and one at least (truncated or "
                      "edited?)",
                      counted(parts_, "part"), count_));
    }
    return std::move(program_);
  }

 private:
  void read_header(std::string_view line) {
    const std::size_t colon = std::min(line.find(':'), line.size());
    const std::string_view key = trim(line.substr(0, colon));
    const std::string_view value = trim(line.substr(std::min(colon + 1, line.size())));
    if (key == "count") {
      count_ = at_.within(key, value, {1.0, 1e9, ""});
    } else if (key == "lift_mm") {
      lift_ = at_.within(key, value, ranges::kSize);
    } else if (key != kGcodePartsWord) {
      at_.check_comment(line);
    }
  }

  void read_row(std::string_view line) {
    const std::vector<std::string_view> fields = split(line, ',');
    if (fields.size() != 3) at_.fail(fmt::format("{}; required 3: {}", counted(fields.size(), "column"), kPartColumns));
    const std::string name(fields[0]);
    const std::string bytes = listed_bytes(at_, name, fields[2], beside_);
    if (at_.finite("lines", fields[1]) != static_cast<double>(lines_in(bytes)))
      at_.fail(fmt::format("lines = {}, but {} has {}; required the same", fields[1], name, lines_in(bytes)));
    add(read_gcode(bytes, name, reading_, progress_), name);
    ++parts_;
  }

  void add(Program part, const std::string& name) {
    if (part.steps.empty()) at_.fail(fmt::format("{} holds no step; required one at least", name));
    if (parts_ == 0) {
      program_.frame = part.frame;
      program_.notes = part.notes;
    } else {
      if (!lift_) at_.fail("lift_mm is missing; required before the parts: how far the tool is lifted between them");
      if (part.frame != program_.frame) at_.fail(fmt::format("{} lies in another frame; required one", name));
      const Point from = program_.steps.back().finish, to = part.steps.front().start;
      if (from != to) program_.steps.push_back({from, to, 0.0, false});
      program_.rapid_length += *lift_ + distance(from, to);
    }
    for (PathModeChange change : part.path_modes) {
      change.first_step += program_.steps.size();
      program_.path_modes.push_back(change);
    }
    program_.steps.insert(program_.steps.end(), part.steps.begin(), part.steps.end());
    program_.rapid_length += part.rapid_length;
    program_.fastest_feed = std::max(program_.fastest_feed, part.fastest_feed);
  }

  const GcodeReading& reading_;
  const ReadBeside& beside_;
  const Progress& progress_;
  PvtPlace at_;
  Program program_;
  double count_ = 0.0;
  std::optional<double> lift_;
  std::size_t parts_ = 0;
};

}  // namespace

std::vector<WrittenProgram> written_gcode_parts(const Program& program, const GcodeOptions& options,
                                                std::size_t most_lines, const FeedTable& made,
                                                const Progress& progress) {
  const std::vector<ProgramStep>& steps = program.steps;
  std::vector<WrittenProgram> files(1);
  std::string rows;
  std::size_t first = 0;
  while (first < steps.size() && !steps[first].removes) ++first;
  while (first < steps.size()) {
    progress.check();
    const std::size_t one = lines_in(gcode_text(part_of(program, first, first + 1), options));
    if (one > most_lines) {
      throw InputError(
          fmt::format("`max lines` = {}: a part with a single step has {} lines, most of them before the "
                      "work; required at least so many",
                      most_lines, one));
    }
    std::size_t end = first + 1;
    for (std::size_t lines = one; end < steps.size(); ++end) {
      lines += most_lines_of(steps[end]);
      if (lines > most_lines) break;
    }
    if (end < steps.size()) end = place_of_cut(steps, first, end);
    std::size_t last = end;
    while (!steps[last - 1].removes) --last;
    WrittenProgram part{fmt::format("program_{:03}.nc", files.size()),
                        gcode_text(part_of(program, first, last), options, progress), std::string(kGcodePartsWord)};
    rows += fmt::format("{},{},{}\n", part.file, lines_in(part.bytes), sha256_of(part.bytes));
    files.push_back(std::move(part));
    first = end;
    while (first < steps.size() && !steps[first].removes) ++first;
  }
  std::string list = fmt::format(
      "# {}: of program.nc, to be run in this order, the tool lifted between them, dwell {}\n# lift_mm: {}\n"
      "# count: {}\n",
      kGcodePartsWord, made.version, coordinate_text(options.lift_height_mm), files.size() - 1);
  for (const std::string& line : record_lines(made)) list += "# " + line + "\n";
  files.front() = {std::string(kGcodePartsFile), fmt::format("{}{}\n{}", list, kPartColumns, rows),
                   std::string(kGcodePartsWord)};
  return files;
}

bool is_gcode_part_list(std::string_view text) { return text.starts_with(fmt::format("# {}:", kGcodePartsWord)); }

Program parse_gcode_part_list(std::string_view text, const std::string& file, const GcodeReading& reading,
                              const ReadBeside& beside, const Progress& progress) {
  return PartListReader(file, reading, beside, progress).read(text);
}

}  // namespace dwell
