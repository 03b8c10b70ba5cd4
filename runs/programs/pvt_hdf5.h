#pragma once

#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/pvt_table.h"

namespace dwell {

/// The bytes of pvt.h5 (docs/formats.md): the table of pvt.csv as the data set /pvt, with attributes.
std::string pvt_hdf5_bytes(const PvtTable& table, const FeedTable& made);

/// Reads one, in a process of its own (core/formats/isolated_reader.h). Throws InputError naming file, row, column and
/// what is accepted: no data set /pvt of six columns, other units or columns, and as parse_pvt_csv.
PvtTable parse_pvt_hdf5(std::string_view bytes, const std::string& file, const Progress& progress = {});

}  // namespace dwell
