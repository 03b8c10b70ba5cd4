#pragma once

namespace dwell {

/// How often memory has been asked for in this test program, by operator new or by Eigen.
long allocation_count();

}  // namespace dwell
