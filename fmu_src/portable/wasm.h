/* What the generated module.c is written in: the instructions of WebAssembly as C99.

   `m` is a block of memory that begins with `Own`; an address is a place in it. Nothing is shared
   between blocks. Places are not checked: the compiled kernels of the binaries do not either. What
   WebAssembly stops at (a division by zero) gives 0 and is noted in the block. */
#ifndef THRUSTWASHER_WASM_H
#define THRUSTWASHER_WASM_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#if (defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__) || defined(__BIG_ENDIAN__) \
    || defined(__ARMEB__) || defined(__MIPSEB__)
#error "this FMU is for little-endian machines"
#endif
#ifdef __FAST_MATH__
#error "numbers would differ: compile without -ffast-math"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD == 2
#error \
    "numbers would differ: this compiler computes with more digits than double has (try -msse2 -mfpmath=sse)"
#endif
/* No product and sum in one step, whatever the options: all machines give the same numbers. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif

typedef uint8_t u8;
typedef int8_t s8;
typedef uint16_t u16;
typedef int16_t s16;
typedef uint32_t u32;
typedef int32_t s32;
typedef uint64_t u64;
typedef int64_t s64;
typedef float f32;
typedef double f64;

/* At address 0, where no number of the kernels lies. */
typedef struct {
    u32 stack;   /* the stack's end; it grows downwards */
    u32 trapped; /* an instruction had no result since this was 0 */
} Own;
#define STACK (((Own *)(void *)m)->stack)
#define TRAP (((Own *)(void *)m)->trapped = 1)
#define UNREACHABLE TRAP

#define LOAD(name, kept, result)                        \
    static inline result name(const u8 *m, u64 place) { \
        kept x;                                         \
        memcpy(&x, m + (size_t)place, sizeof x);        \
        return (result)x;                               \
    }
#define STORE(name, kept, given)                             \
    static inline void name(u8 *m, u64 place, given value) { \
        kept x = (kept)value;                                \
        memcpy(m + (size_t)place, &x, sizeof x);             \
    }
LOAD(i32_load, u32, u32)
LOAD(i64_load, u64, u64)
LOAD(f32_load, f32, f32)
LOAD(f64_load, f64, f64)
LOAD(i32_load8_u, u8, u32)
LOAD(i32_load8_s, s8, u32)
LOAD(i32_load16_u, u16, u32)
LOAD(i32_load16_s, s16, u32)
LOAD(i64_load8_u, u8, u64)
LOAD(i64_load8_s, s8, u64)
LOAD(i64_load16_u, u16, u64)
LOAD(i64_load16_s, s16, u64)
LOAD(i64_load32_u, u32, u64)
LOAD(i64_load32_s, s32, u64)
STORE(i32_store, u32, u32)
STORE(i64_store, u64, u64)
STORE(f32_store, f32, f32)
STORE(f64_store, f64, f64)
STORE(i32_store8, u8, u32)
STORE(i32_store16, u16, u32)
STORE(i64_store8, u8, u64)
STORE(i64_store16, u16, u64)
STORE(i64_store32, u32, u64)

static inline void memory_fill(u8 *m, u32 place, u32 value, u32 n) { memset(m + place, (int)value, n); }

static inline void memory_copy(u8 *m, const u8 *from, u32 to_place, u32 from_place, u32 n) {
    memmove(m + to_place, from + from_place, n);
}

#define BITS(name, from, to)            \
    static inline to name(from x) {     \
        to bits;                        \
        memcpy(&bits, &x, sizeof bits); \
        return bits;                    \
    }
BITS(f32_reinterpret_i32, u32, f32)
BITS(i32_reinterpret_f32, f32, u32)
BITS(f64_reinterpret_i64, u64, f64)
BITS(i64_reinterpret_f64, f64, u64)

static inline u64 count_leading(u64 x, u64 width) {
    u64 n = width;
    for (u64 step = width / 2; step; step /= 2) {
        if (x >> step) {
            n -= step;
            x >>= step;
        }
    }
    return x ? n - 1 : n;
}

static inline u64 count_trailing(u64 x, u64 width) {
    return x ? width - 1 - count_leading(x & (0 - x), width) : width;
}

static inline u64 count_ones(u64 x) {
    u64 n = 0;
    for (; x; x &= x - 1) n++;
    return n;
}
#define I32_CLZ(x) ((u32)count_leading((u32)(x), 32))
#define I64_CLZ(x) count_leading(x, 64)
#define I32_CTZ(x) ((u32)count_trailing((u32)(x), 32))
#define I64_CTZ(x) count_trailing(x, 64)
#define I32_POPCNT(x) ((u32)count_ones((u32)(x)))
#define I64_POPCNT(x) count_ones(x)
#define ROTATED(x, left, width) ((x) << ((left) & (width - 1)) | (x) >> ((0 - (left)) & (width - 1)))
#define I32_ROTL(x, y) ROTATED((u32)(x), (u32)(y), 32)
#define I64_ROTL(x, y) ROTATED((u64)(x), (u64)(y), 64)
#define I32_ROTR(x, y) ROTATED((u32)(x), 0 - (u32)(y), 32)
#define I64_ROTR(x, y) ROTATED((u64)(x), 0 - (u64)(y), 64)

#define DIVIDE(width, least)                                                                                 \
    static inline u##width divided_s##width(u8 *m, u##width x, u##width y) {                                 \
        if (y == 0 || (x == (u##width)least && y == (u##width) - 1)) return TRAP, 0;                         \
        return (u##width)((s##width)x / (s##width)y);                                                        \
    }                                                                                                        \
    static inline u##width rest_s##width(u8 *m, u##width x, u##width y) {                                    \
        if (y == 0) return TRAP, 0;                                                                          \
        return y == (u##width) - 1 ? 0 : (u##width)((s##width)x % (s##width)y);                              \
    }                                                                                                        \
    static inline u##width divided_u##width(u8 *m, u##width x, u##width y) { return y ? x / y : (TRAP, 0); } \
    static inline u##width rest_u##width(u8 *m, u##width x, u##width y) { return y ? x % y : (TRAP, 0); }
DIVIDE(32, INT32_MIN)
DIVIDE(64, INT64_MIN)
#define I32_DIV_S(x, y) divided_s32(m, x, y)
#define I64_DIV_S(x, y) divided_s64(m, x, y)
#define I32_REM_S(x, y) rest_s32(m, x, y)
#define I64_REM_S(x, y) rest_s64(m, x, y)
/* One name for both widths. */
#define DIV_U(x, y) (sizeof(x) == 8 ? divided_u64(m, x, y) : divided_u32(m, (u32)(x), (u32)(y)))
#define REM_U(x, y) (sizeof(x) == 8 ? rest_u64(m, x, y) : rest_u32(m, (u32)(x), (u32)(y)))

/* Cut off to a whole number; beyond the range its end, and 0 for what is no number. */
static inline u32 I32_TRUNC_SAT_S_F64(f64 x) {
    if (x != x) return 0;
    if (!(x > -2147483649.0)) return (u32)INT32_MIN;
    return x < 2147483648.0 ? (u32)(s32)x : (u32)INT32_MAX;
}

static inline u64 I64_TRUNC_SAT_S_F64(f64 x) {
    if (x != x) return 0;
    if (!(x >= -9223372036854775808.0)) return (u64)INT64_MIN;
    return x < 9223372036854775808.0 ? (u64)(s64)x : (u64)INT64_MAX;
}

static inline u32 I32_TRUNC_SAT_U_F64(f64 x) {
    if (!(x > -1.0)) return 0;
    return x < 4294967296.0 ? (u32)x : UINT32_MAX;
}

static inline u64 I64_TRUNC_SAT_U_F64(f64 x) {
    if (!(x > -1.0)) return 0;
    return x < 18446744073709551616.0 ? (u64)x : UINT64_MAX;
}

/* What is no number stays so. */
static inline f64 wasm_quiet(f64 x) { return x; }
static inline f32 wasm_quietf(f32 x) { return x; }
static inline f64 wasm_sqrt(f64 x) { return sqrt(x); }
static inline f64 wasm_floor(f64 x) { return floor(x); }
static inline f64 wasm_ceil(f64 x) { return ceil(x); }
static inline f64 wasm_trunc(f64 x) { return trunc(x); }
static inline f64 wasm_nearbyint(f64 x) { return nearbyint(x); }
static inline f64 wasm_fabs(f64 x) { return fabs(x); }

#endif
