#pragma once

#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/pvt_table.h"

namespace dwell {

/// The text of pvt.csv (docs/formats.md). `made` says version, inputs and options for the header.
std::string pvt_csv_text(const PvtTable& table, const FeedTable& made, const Progress& progress = {});

/// Whether a text is such a table: it begins with "# pvt", or its first line that is no comment is a column line of
/// one.
bool is_pvt_csv(std::string_view text);

/// Reads one, of other origin too: the columns t_s,x_mm,vx_mm_per_s,y_mm,vy_mm_per_s and, or without, lift; or the same
/// without units where a header line says them. Throws InputError naming file, line, field, value and what is accepted:
/// other columns, units or places, times that do not grow, velocities at the ends that are not 0, another number of
/// rows or another time than the header says.
PvtTable parse_pvt_csv(std::string_view text, const std::string& file, const Progress& progress = {});

}  // namespace dwell
