#include "runs/programs/pvt_hdf5.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/formats/hdf5_file.h"
#include "core/formats/isolated_reader.h"
#include "core/formats/map_source.h"
#include "runs/programs/pvt_place.h"
#include "runs/programs/record_lines.h"

namespace dwell {
namespace {

constexpr const char* kHdf5Path = "/pvt";
constexpr std::array<const char*, 6> kHdf5Columns{"t_s", "x_mm", "vx_mm_per_s", "y_mm", "vy_mm_per_s", "lift"};

std::vector<std::string> hdf5_columns() { return {kHdf5Columns.begin(), kHdf5Columns.end()}; }

/// Throws unless an attribute of the data set is these lines of text.
void require_lines(const Hdf5File& file, const std::string& name, const std::vector<std::string>& lines,
                   const std::string& where) {
  const auto value = file.attribute(kHdf5Path, name);
  if (value && value->numbers.empty() && value->members.empty() && value->texts == lines) return;
  std::string accepted;
  for (const std::string& line : lines) accepted += (accepted.empty() ? "" : ", ") + line;
  throw InputError(fmt::format("{}: the attribute {} of HDF5 data set '{}' is {}; accepted: {}", where, name, kHdf5Path,
                               value ? "another" : "not there", accepted));
}

/// The matrix of the data set, as if it were a map: what comes from another process is one.
MapSource read_rows(std::string_view bytes, const std::string& where) {
  const Hdf5File file(bytes, where);
  Hdf5Matrix matrix = file.matrix(kHdf5Path);
  if (matrix.cols != kHdf5Columns.size()) {
    throw InputError(fmt::format("{}: HDF5 data set '{}' of {} columns; required {}", where, kHdf5Path, matrix.cols,
                                 kHdf5Columns.size()));
  }
  require_lines(file, "units", {std::string(kPvtUnits)}, where);
  require_lines(file, "columns", hdf5_columns(), where);
  MapSource source;
  source.rows = static_cast<Index>(matrix.rows);
  source.cols = static_cast<Index>(matrix.cols);
  source.values = std::move(matrix.values);
  return source;
}

}  // namespace

std::string pvt_hdf5_bytes(const PvtTable& table, const FeedTable& made) {
  std::vector<double> values;
  values.reserve(table.rows.size() * kHdf5Columns.size());
  for (const PvtRow& row : table.rows) {
    values.insert(values.end(),
                  {row.seconds, row.place.x, row.speed.x, row.place.y, row.speed.y, row.lifted ? 1.0 : 0.0});
  }
  Hdf5Content content;
  content.path = kHdf5Path;
  content.rows = table.rows.size();
  content.cols = kHdf5Columns.size();
  content.values = values;
  content.numbers = {{"total_s", {table.seconds()}}};
  content.texts = {{"pvt", "dwell " + made.version}, {"units", std::string(kPvtUnits)}};
  content.lists = {{"columns", hdf5_columns()}, {"made", record_lines(made)}};
  return hdf5_bytes(content);
}

PvtTable parse_pvt_hdf5(std::string_view bytes, const std::string& file, const Progress& progress) {
  const MapSource source = read_isolated([&] { return read_rows(bytes, file); }, bytes.size(), "an HDF5 file", file);
  PvtPlace at{file, "row", 0};
  PvtTable table;
  Poll poll(progress);
  const auto checked = [&at](double value, const char* name, const ValueRange& range) {
    at.check_within(name, value, range);
    return value;
  };
  for (std::size_t i = 0; i + 6 <= source.values.size(); i += 6) {
    poll.step();
    ++at.number;
    const double* row = source.values.data() + i;
    const double lift = row[5];
    if (lift != 0.0 && lift != 1.0) at.fail(fmt::format("lift = {}; accepted: 0, 1", lift));
    at.add(table, {checked(row[0], kHdf5Columns[0], {0.0, ranges::kTime.most, "s"}),
                   {checked(row[1], kHdf5Columns[1], ranges::kPlace), checked(row[3], kHdf5Columns[3], ranges::kPlace)},
                   {checked(row[2], kHdf5Columns[2], kPvtSpeeds), checked(row[4], kHdf5Columns[4], kPvtSpeeds)},
                   lift == 1.0});
  }
  at.number = 0;
  at.check_end(table);
  return table;
}

}  // namespace dwell
