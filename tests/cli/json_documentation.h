#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/number_text.h"
#include "core/base/whole_file.h"

namespace dwell::test {

/// The keys that docs/json.md lists, by command: paths as "map.pv_nm" and "inputs[].file", each with whether it may be
/// missing.
class JsonDocumentation {
 public:
  using Keys = std::map<std::string, bool>;

  explicit JsonDocumentation(const std::string& file) {
    std::map<std::string, std::vector<Row>> tables;
    std::string heading;
    const std::string text = read_whole_file(file);
    for (const std::string_view line : split(text, '\n')) {
      if (line.starts_with("## ") || line.starts_with("### ")) heading = line.substr(line.find(' ') + 1);
      if (line.starts_with("| `") || line.starts_with("| [")) tables[heading].push_back(row_of(line));
    }
    for (const auto& [name, rows] : tables) {
      if (!name.starts_with("dwell ")) continue;
      Keys& keys = commands_[name.substr(6)];
      for (const Row& row : rows) {
        if (row.block.empty()) {
          keys[row.key] = row.optional;
          continue;
        }
        for (const Row& inner : tables.at(row.block)) {
          keys[row.key.empty() ? inner.key : row.key + "." + inner.key] = row.optional || inner.optional;
        }
      }
    }
  }

  const std::map<std::string, Keys>& commands() const { return commands_; }

 private:
  struct Row {
    std::string key, block;  // a block's keys stand below the key
    bool optional;
  };

  /// "| `map`: [map](#map) | meaning | only |"
  static Row row_of(std::string_view line) {
    const std::vector<std::string_view> cells = split(line, '|');
    if (cells.size() != 5) throw std::runtime_error("docs/json.md: not three cells: " + std::string(line));
    const std::string_view cell = trim(cells[1]);
    Row row{"", "", !trim(cells[3]).empty()};
    if (cell.starts_with('`')) row.key = cell.substr(1, cell.find('`', 1) - 1);
    if (const auto at = cell.find("(#"); at != std::string_view::npos)
      row.block = cell.substr(at + 2, cell.size() - at - 3);
    return row;
  }

  std::map<std::string, Keys> commands_;
};

/// The paths of the keys of a JSON value.
struct PrintedKeys {
  std::set<std::string> leaves;  // that hold no further keys
  std::set<std::string>
      empty;  // the leaves among them that are null or an empty list, in the place of what may be below

  void collect(const nlohmann::json& value, const std::string& path = "") {
    if (value.is_object()) {
      for (const auto& [key, below] : value.items()) collect(below, path.empty() ? key : path + "." + key);
    } else if (value.is_array() && !value.empty() && value[0].is_object()) {
      for (const auto& below : value) collect(below, path + "[]");
    } else {
      leaves.insert(path);
      if (value.is_null() || (value.is_array() && value.empty())) empty.insert(path);
    }
  }

  /// Whether one of the empty leaves stands for the key.
  bool stand_for(const std::string& key) const {
    return std::any_of(empty.begin(), empty.end(), [&](const std::string& leaf) {
      return key.starts_with(leaf + ".") || key.starts_with(leaf + "[]");
    });
  }
};

}  // namespace dwell::test
