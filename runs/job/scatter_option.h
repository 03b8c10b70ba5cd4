#pragma once

#include <optional>
#include <string>

#include "core/map/scattered_surface.h"

namespace dwell {

/// "pitch=MM[,reach=MM]", both > 0. Throws InputError naming the text and what is accepted.
ScatterOptions parse_scatter_options(const std::string& text);
/// A text that reads back equal; empty for none.
std::string to_string(const std::optional<ScatterOptions>& options);

}  // namespace dwell
