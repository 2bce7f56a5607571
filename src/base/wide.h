#pragma once

/// Before a function: compiled for AVX2 as well, which is called where the processor has it.
/// Without fused operations, so that the results are the same everywhere. MEDIAL_HAS_WIDE: it is.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MEDIAL_HAS_WIDE
#define MEDIAL_WIDE __attribute__((target_clones("avx2", "default"), flatten))
#else
#define MEDIAL_WIDE
#endif
