#pragma once

/// Put before a function, compiles it for AVX2 as well, and calls that version if the processor
/// supports it. Uses no fused operations, so results are identical everywhere. MEDIAL_HAS_WIDE is
/// defined if the compiler supports this.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MEDIAL_HAS_WIDE
#define MEDIAL_WIDE __attribute__((target_clones("avx2", "default"), flatten))
#else
#define MEDIAL_WIDE
#endif
