/* From plain C to the compiled kernels: choose the code for this CPU, keep the host's
   floating-point settings out, unwrap the compiler's calling convention. */
#include "kernel.h"
#include "model.h"

/* int32 f(result, exception, arguments...): what the compiler of the kernels makes. A return value
   other than 0 would be an exception; the kernels raise none. */
#define RULE (int32_t *, void **, const double *)
#define DERIVE (int32_t *, void **, double *)
#define STEP (int32_t *, void **, double *, double *, double *, double *, double *, \
              int32_t *, double, double)
#define SENS (int32_t *, void **, double *, double *, double *, double *, \
              double *, double *)
enum { FAULT = -1000 };

/* Two levels, or one whose name the build gives. */
#ifdef TW_LEVEL
#define JOIN_(a, b) a##_##b
#define JOIN(a, b) JOIN_(a, b)
#define DECLARE(entry, KIND) extern int32_t JOIN(entry, TW_LEVEL) KIND;
#define PICK(entry) JOIN(entry, TW_LEVEL)
#else
#define DECLARE(entry, KIND) extern int32_t entry##_v2 KIND; extern int32_t entry##_v3 KIND;
#define PICK(entry) (is_v3() ? entry##_v3 : entry##_v2)
#endif

DECLARE(tw_derive, DERIVE)
DECLARE(tw_step, STEP)
#if HAS_RULES
DECLARE(tw_rule, RULE)
#endif
#if HAS_SENS
DECLARE(tw_sens, SENS)
#endif

#ifndef TW_LEVEL
/* Not by the compiler's __builtin_cpu_supports: its table does not link into a shared library
   everywhere. */
static void cpuid(uint32_t leaf, uint32_t r[4])
{
    __asm__ volatile("cpuid" : "=a"(r[0]), "=b"(r[1]), "=c"(r[2]), "=d"(r[3])
                     : "a"(leaf), "c"(0));
}

static int has(uint32_t word, uint32_t bits)
{
    return (word & bits) == bits;
}

/* x86-64-v3: AVX2, FMA, BMI, F16C, MOVBE, LZCNT, and an operating system that saves AVX. */
static int find_v3(void)
{
    const uint32_t fma_movbe_osxsave_avx_f16c = 1u << 12 | 1u << 22 | 1u << 27 | 1u << 28 | 1u << 29;
    const uint32_t bmi1_avx2_bmi2 = 1u << 3 | 1u << 5 | 1u << 8, lzcnt = 1u << 5, sse_avx = 6;
    uint32_t r[4], low, high;
    cpuid(0, r);
    if (r[0] < 7)
        return 0;
    cpuid(1, r);
    if (!has(r[2], fma_movbe_osxsave_avx_f16c))
        return 0;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    cpuid(7, r);
    if (!has(low, sse_avx) || !has(r[1], bmi1_avx2_bmi2))
        return 0;
    cpuid(0x80000000u, r);
    if (r[0] < 0x80000001u)
        return 0;
    cpuid(0x80000001u, r);
    return has(r[2], lzcnt);
}

static int is_v3(void)
{
    static volatile int known = -1; /* the same from every thread: a race is harmless */
    int v3 = known;
    if (v3 < 0)
        known = v3 = find_v3();
    return v3;
}
#endif

/* The host may round otherwise, flush small numbers to zero or trap: numbers would differ or the
   process end. Round to nearest, nothing flushed, nothing trapped; then the host's own again. */
#if defined(__x86_64__)
typedef uint32_t Settings;
static Settings enter(void)
{
    const uint32_t plain = 0x1F80;
    uint32_t host;
    __asm__ volatile("stmxcsr %0" : "=m"(host));
    __asm__ volatile("ldmxcsr %0" : : "m"(plain) : "memory");
    return host;
}
static void leave(Settings host)
{
    __asm__ volatile("ldmxcsr %0" : : "m"(host) : "memory");
}
#elif defined(__aarch64__)
typedef uint64_t Settings;
static Settings enter(void)
{
    uint64_t host;
    __asm__ volatile("mrs %0, fpcr" : "=r"(host));
    __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0) : "memory");
    return host;
}
static void leave(Settings host)
{
    __asm__ volatile("msr fpcr, %0" : : "r"(host) : "memory");
}
#else
#error "no kernels are made for this machine"
#endif

#define CALL(entry, ...)                                          \
    int32_t result = -1;                                          \
    void *exception = 0;                                          \
    const Settings host = enter();                                \
    const int32_t raised = PICK(entry)(&result, &exception, __VA_ARGS__); \
    leave(host);                                                  \
    return raised ? FAULT - raised : result

int tw_derive(double *par)
{
    CALL(tw_derive, par);
}

int tw_rule(const double *par)
{
#if HAS_RULES
    CALL(tw_rule, par);
#else
    (void)par;
    return 0;
#endif
}

int tw_step(double *par, double *inp, double *state, double *work, double *out, int32_t *iout,
            double t, double dt)
{
    CALL(tw_step, par, inp, state, work, out, iout, t, dt);
}

int tw_sens(double *par, double *inp, double *state, double *work, double *seed, double *dout)
{
#if HAS_SENS
    CALL(tw_sens, par, inp, state, work, seed, dout);
#else
    (void)par, (void)inp, (void)state, (void)work, (void)seed, (void)dout;
    return FAULT;
#endif
}
