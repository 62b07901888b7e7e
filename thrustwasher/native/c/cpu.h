/* Which of the two levels of x86-64 code this processor runs; elsewhere there is one level. */
#ifndef THRUSTWASHER_CPU_H
#define THRUSTWASHER_CPU_H

#include <stdint.h>

/* Two levels, or one whose name the build gives. */
#ifdef TW_LEVEL
#define TW_JOIN_(a, b) a##_##b
#define TW_JOIN(a, b) TW_JOIN_(a, b)
#else

/* Not by the compiler's __builtin_cpu_supports: its table does not link into a shared library
   everywhere. */
static void cpuid(uint32_t leaf, uint32_t r[4]) {
    __asm__ volatile("cpuid" : "=a"(r[0]), "=b"(r[1]), "=c"(r[2]), "=d"(r[3]) : "a"(leaf), "c"(0));
}

static int has(uint32_t word, uint32_t bits) { return (word & bits) == bits; }

#ifdef TW_LEAST
/* x86-64-v2: SSE3, SSSE3, SSE4.1, SSE4.2, POPCNT and CMPXCHG16B. */
static int is_v2(void) {
    const uint32_t all = 1u << 0 | 1u << 9 | 1u << 13 | 1u << 19 | 1u << 20 | 1u << 23;
    uint32_t r[4];
    cpuid(1, r);
    return has(r[2], all);
}
#endif

/* x86-64-v3: AVX2, FMA, BMI, F16C, MOVBE, LZCNT, and an operating system that saves AVX. */
static int find_v3(void) {
    const uint32_t fma_movbe_osxsave_avx_f16c = 1u << 12 | 1u << 22 | 1u << 27 | 1u << 28 | 1u << 29;
    const uint32_t bmi1_avx2_bmi2 = 1u << 3 | 1u << 5 | 1u << 8, lzcnt = 1u << 5, sse_avx = 6;
    uint32_t r[4], low, high;
    cpuid(0, r);
    if (r[0] < 7) return 0;
    cpuid(1, r);
    if (!has(r[2], fma_movbe_osxsave_avx_f16c)) return 0;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    cpuid(7, r);
    if (!has(low, sse_avx) || !has(r[1], bmi1_avx2_bmi2)) return 0;
    cpuid(0x80000000u, r);
    if (r[0] < 0x80000001u) return 0;
    cpuid(0x80000001u, r);
    return has(r[2], lzcnt);
}

static int is_v3(void) {
    static volatile int known = -1; /* the same from every thread: a race is harmless */
    int v3 = known;
    if (v3 < 0) known = v3 = find_v3();
    return v3;
}
#endif

#endif
