#pragma once

#include <string>
#include <string_view>

namespace dwell {

/// What bytes that are not plain text look like, as a phrase ("a PNG image"), by their first bytes; empty for text.
/// Formats that maps are read from (core/formats/map_formats.h) are not known here.
std::string kind_of_binary(std::string_view bytes);

}  // namespace dwell
