#include "runs/logs/log_file.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/whole_file.h"
#include "core/formats/file_kind.h"
#include "core/formats/hdf5_map.h"
#include "core/formats/hdf5_table.h"
#include "core/formats/map_name.h"
#include "core/formats/npy.h"
#include "runs/logs/log_clock.h"
#include "runs/logs/log_text.h"

namespace dwell {
namespace {

void note_assumed(const LogColumns& columns, MotionLog& log) {
  const bool time = columns.time && columns.time->assumed, places = columns.x.assumed || columns.y.assumed;
  if (!time && !places) return;
  log.notes.push_back(fmt::format("the file says no unit of {}: taken as {}",
                                  time ? (places ? "time and places" : "time") : "places",
                                  time ? (places ? "s and mm" : "s") : "mm"));
}

/// Takes the samples from rows of which `value(row, column)` gives the numbers.
template <class Value>
MotionLog samples_of(std::size_t rows, const LogColumns& columns, const LogReading& reading, const std::string& name,
                     const Progress& progress, const Value& value) {
  MotionLog log;
  log.file = name;
  log.seconds.reserve(rows);
  log.places.reserve(rows);
  Poll poll(progress);
  for (std::size_t row = 0; row < rows; ++row) {
    poll.step();
    const auto number = [&](const LogColumn& column) { return column.factor * value(row, column); };
    log.seconds.push_back(columns.time ? number(*columns.time) : static_cast<double>(row) * *reading.period);
    log.places.push_back({number(columns.x), number(columns.y)});
  }
  note_assumed(columns, log);
  settle_clock(log);
  return log;
}

MotionLog log_of_table(const NumberTable& table, const LogReading& reading, const std::string& name,
                       const Progress& progress) {
  const LogColumns columns = find_log_columns(table.names, table.cols, reading, name);
  return samples_of(table.rows, columns, reading, name, progress, [&](std::size_t row, const LogColumn& column) {
    const double v = table.values[row * table.cols + column.index];
    if (std::isfinite(v)) return v;
    throw InputError(
        fmt::format("{}: row {}: column \"{}\" = {}; a finite number is required", name, row + 1, column.name, v));
  });
}

NumberTable npy_table(std::string_view bytes, const std::string& name) {
  MapSource source = parse_npy(bytes, name);
  return {{}, static_cast<std::size_t>(source.rows), static_cast<std::size_t>(source.cols), std::move(source.values)};
}

}  // namespace

MotionLog parse_log_text(std::string_view text, const std::string& name, const LogReading& reading,
                         const Progress& progress) {
  const LogText table = read_log_text(text, name, progress);
  const LogColumns columns = find_log_columns(table.names, table.columns, reading, name);
  check_unread_lines(table, columns, name);
  MotionLog log =
      samples_of(table.rows.size(), columns, reading, name, progress, [&](std::size_t row, const LogColumn& column) {
        const std::string_view field = field_of(table, row, column.index);
        const auto v = finite_number(field);
        if (v) return *v;
        throw InputError(
            fmt::format("{}: line {}: column \"{}\" = {}; a finite number with a decimal point is required", name,
                        table.rows[row].number, column.name, in_quotes(field)));
      });
  log.notes.insert(log.notes.begin(), table.notes.begin(), table.notes.end());
  return log;
}

MotionLog read_motion_log(const std::filesystem::path& file, const LogReading& reading, const Progress& progress) {
  const MapName name = split_map_name(file);
  const std::string bytes = read_whole_file(name.file), shown = file.string();
  if (bytes.empty())
    throw InputError(fmt::format("{}: the file is empty; a log of time and places is required", shown));
  if (is_hdf5(bytes)) return log_of_table(parse_hdf5_table(bytes, name.inside, shown), reading, shown, progress);
  if (!name.inside.empty())
    throw InputError(
        fmt::format("{}: no HDF5 file, which alone holds several arrays; leave out ':{}'", shown, name.inside));
  if (is_npy(bytes)) return log_of_table(npy_table(bytes, shown), reading, shown, progress);
  const std::string binary = kind_of_binary(bytes);
  if (!binary.empty()) {
    throw InputError(fmt::format("{}: the file looks like {}; a log as text, NPY or HDF5 is required", shown, binary));
  }
  return parse_log_text(bytes, shown, reading, progress);
}

}  // namespace dwell
