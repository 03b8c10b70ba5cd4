#pragma once

#include <climits>  // tells which C library this is

/// Stands before a function whose loops gain from vectors of several numbers. The function is compiled twice, for
/// processors of the last ten years and for all others, and the loader picks one; the last bits of a result may differ
/// between the two. The sanitizers cannot run this choice, because it is made before they have started.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DWELL_SIMD __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define DWELL_SIMD
#endif
