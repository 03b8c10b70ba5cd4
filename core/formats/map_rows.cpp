#include "core/formats/map_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.h"

namespace dwell {

MapRows parse_map_rows(const std::string& text) {
  if (text == "bottom") return MapRows::Bottom;
  if (text == "top") return MapRows::Top;
  throw InputError(fmt::format("'{}'; accepted: bottom (the first row has the smallest y) or top (the largest)", text));
}

std::string to_string(MapRows rows) { return rows == MapRows::Top ? "top" : "bottom"; }

void apply_map_rows(MapSource& source, const std::optional<MapRows>& rows) {
  if (rows != MapRows::Top) return;
  const Index cols = source.cols;
  for (Index row = 0; row < source.rows / 2; ++row) {
    const auto begin = source.values.begin() + row * cols;
    std::swap_ranges(begin, begin + cols, source.values.begin() + (source.rows - 1 - row) * cols);
  }
  source.header.history.emplace_back("rows: the first row of the file taken for the largest y");
}

}  // namespace dwell
