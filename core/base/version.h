#pragma once

namespace dwell {

/// The version of the library, as "0.1.0".
const char* version();

}  // namespace dwell
