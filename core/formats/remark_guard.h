#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/formats/map_header.h"

namespace dwell {

/// Where a remark stands, for how it could be said clearly.
enum class RemarkPlace { Comment, Field };

/// The last guard before a remark (a comment, a text attribute, COMMENT of FITS) is taken for prose: what no rule has
/// understood may still speak of the unit of the values ("amplitude in um", but not "PV 120 nm" or "5 mm aperture":
/// there it is the unit of a number), a factor ("values x 1e-3 mm", "nm per count"), waves or radians, places in
/// pixels, the way that rows run ("row 0 = top"), the middle of the map, or a marker of no data. Returns what the user
/// must settle, a statement each, with messages that begin with `place`; nothing of a sentence that says none of these.
/// A false alarm costs the user an option, a silence a mirror. Cost O(length).
std::vector<UnclearStatement> unclear_remarks(std::string_view remark, const std::string& place,
                                              RemarkPlace kind = RemarkPlace::Comment);

}  // namespace dwell
