#pragma once

namespace dwell {

/// The number of threads to run: `asked`, or one for every processor if 0.
int thread_count(int asked);

}  // namespace dwell
