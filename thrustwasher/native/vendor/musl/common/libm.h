/* musl 1.2.5, src/internal/libm.h, what concerns double precision; declarations stand here in place
   of those in math.h. Changed: no fused multiply-add, so that every processor gives the same bits. */
#ifndef _LIBM_H
#define _LIBM_H

#include <stdint.h>
#include <float.h>

#undef __FP_FAST_FMA
#define hidden __attribute__((__visibility__("hidden")))
typedef double double_t;

#define INFINITY __builtin_inff()
#define NAN __builtin_nanf("")
#define fabs(x) __builtin_fabs(x)
#define copysign(x, y) __builtin_copysign(x, y)
#define sqrt(x) __builtin_sqrt(x) /* an instruction, with -fno-math-errno */
#define isnan(x) ((asuint64(x) & -1ULL >> 1) > 0x7ffULL << 52)
#define isinf(x) ((asuint64(x) & -1ULL >> 1) == 0x7ffULL << 52)
#define signbit(x) ((int)(asuint64(x) >> 63))

#define WANT_ROUNDING 1
#define issignaling_inline(x) 0
#define TOINT_INTRINSICS 0

#define predict_true(x) __builtin_expect(!!(x), 1)
#define predict_false(x) __builtin_expect(x, 0)

static inline double eval_as_double(double x)
{
	double y = x;
	return y;
}

/* fp_barrier returns its input, but limits code transformations
   as if it had a side-effect (e.g. observable io) and returned
   an arbitrary value.  */
static inline double fp_barrier(double x)
{
	volatile double y = x;
	return y;
}

static inline float fp_barrierf(float x)
{
	volatile float y = x;
	return y;
}

/* fp_force_eval ensures that the input value is computed when that's
   otherwise unused.  */
static inline void fp_force_eval(double x)
{
	volatile double y;
	y = x;
	(void)y;
}

#define FORCE_EVAL(x) fp_force_eval(x)

#define asuint(f) ((union{float _f; uint32_t _i;}){f})._i
#define asfloat(i) ((union{uint32_t _i; float _f;}){i})._f
#define asuint64(f) ((union{double _f; uint64_t _i;}){f})._i
#define asdouble(i) ((union{uint64_t _i; double _f;}){i})._f

#define EXTRACT_WORDS(hi,lo,d)                    \
do {                                              \
  uint64_t __u = asuint64(d);                     \
  (hi) = __u >> 32;                               \
  (lo) = (uint32_t)__u;                           \
} while (0)

#define GET_HIGH_WORD(hi,d)                       \
do {                                              \
  (hi) = asuint64(d) >> 32;                       \
} while (0)

#define GET_LOW_WORD(lo,d)                        \
do {                                              \
  (lo) = (uint32_t)asuint64(d);                   \
} while (0)

#define INSERT_WORDS(d,hi,lo)                     \
do {                                              \
  (d) = asdouble(((uint64_t)(hi)<<32) | (uint32_t)(lo)); \
} while (0)

#define SET_HIGH_WORD(d,hi)                       \
  INSERT_WORDS(d, hi, (uint32_t)asuint64(d))

#define SET_LOW_WORD(d,lo)                        \
  INSERT_WORDS(d, asuint64(d)>>32, lo)

hidden int    __rem_pio2_large(double*,double*,int,int,int);
hidden int    __rem_pio2(double,double*);
hidden double __sin(double,double,int);
hidden double __cos(double,double);
hidden double __tan(double,double,int);
hidden double __expo2(double,double);

hidden double __math_xflow(uint32_t, double);
hidden double __math_uflow(uint32_t);
hidden double __math_oflow(uint32_t);
hidden double __math_divzero(uint32_t);
hidden double __math_invalid(double);

hidden double acos(double);
hidden double asin(double);
hidden double asinh(double);
hidden double atan(double);
hidden double atan2(double, double);
hidden double cbrt(double);
hidden double ceil(double);
hidden double cos(double);
hidden double cosh(double);
hidden double erf(double);
hidden double erfc(double);
hidden double exp(double);
hidden double exp2(double);
hidden double expm1(double);
hidden double floor(double);
hidden double fmod(double, double);
hidden double hypot(double, double);
hidden double log(double);
hidden double log10(double);
hidden double log1p(double);
hidden double log2(double);
hidden double pow(double, double);
hidden double scalbn(double, int);
hidden double sin(double);
hidden void   sincos(double, double*, double*);
hidden double sinh(double);
hidden double tan(double);
hidden double tanh(double);

#endif
