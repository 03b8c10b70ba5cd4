#include "core/base/version.h"

namespace dwell {

const char* version() { return DWELL_VERSION; }

}  // namespace dwell
