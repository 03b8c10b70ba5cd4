#include "core/base/threads.h"

#include <omp.h>

namespace dwell {

int thread_count(int asked) { return asked > 0 ? asked : omp_get_num_procs(); }

}  // namespace dwell
