#pragma once

#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/pvt_table.h"

namespace dwell {

/// The text of pvt.json (docs/formats.md), the table of pvt.csv as JSON, a row a line.
std::string pvt_json_text(const PvtTable& table, const FeedTable& made, const Progress& progress = {});

/// Whether a text begins as JSON.
bool is_pvt_json(std::string_view text);

/// Reads one. Throws InputError naming file, row, key, value and what is accepted: what is no JSON, an unknown key or a
/// missing one, other units or columns, and as parse_pvt_csv.
PvtTable parse_pvt_json(std::string_view text, const std::string& file, const Progress& progress = {});

}  // namespace dwell
