/* From plain C to the compiled kernels: choose the code for this CPU, keep the host's
   floating-point settings out, unwrap the compiler's calling convention. */
#include <stdlib.h>

#include "cpu.h"
#include "kernel.h"
#include "model.h"

/* int32 f(result, exception, arguments...): what the compiler of the kernels makes. A return value
   other than 0 would be an exception; the kernels raise none. */
#define RULE (int32_t *, void **, const double *)
#define DERIVE (int32_t *, void **, double *)
#define STEP (int32_t *, void **, double *, double *, double *, double *, double *, int32_t *, double, double)
#define START (int32_t *, void **, double *, double *, double *, double *, double *, double *, double)
#define RATES                                                                                            \
    (int32_t *, void **, double *, double *, double *, double *, double *, double *, double *, double *, \
     double *)
#define UPDATE                                                                                            \
    (int32_t *, void **, double *, double *, double *, double *, double *, double *, double *, int32_t *, \
     double)
#define SLOPES \
    (int32_t *, void **, double *, double *, double *, double *, double *, double *, double *, double *)
#define SENS (int32_t *, void **, double *, double *, double *, double *, double *, double *)
enum { FAULT = -1000 };

#ifdef TW_LEVEL
#define DECLARE(entry, KIND) extern int32_t TW_JOIN(entry, TW_LEVEL) KIND;
#define PICK(entry) TW_JOIN(entry, TW_LEVEL)
#else
#define DECLARE(entry, KIND)        \
    extern int32_t entry##_v2 KIND; \
    extern int32_t entry##_v3 KIND;
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

#if HAS_EXCHANGE
DECLARE(tw_start, START)
DECLARE(tw_rates, RATES)
DECLARE(tw_update, UPDATE)
DECLARE(tw_slopes, SLOPES)
#if NEEDS_STEPS
DECLARE(tw_finish, START)
#endif
#endif

/* The host may round otherwise, flush small numbers to zero or trap: numbers would differ or the
   process end. Round to nearest, nothing flushed, nothing trapped; then the host's own again. */
#if defined(__x86_64__)
typedef uint32_t Settings;
static Settings enter(void) {
    const uint32_t plain = 0x1F80;
    uint32_t host;
    __asm__ volatile("stmxcsr %0" : "=m"(host));
    __asm__ volatile("ldmxcsr %0" : : "m"(plain) : "memory");
    return host;
}
static void leave(Settings host) { __asm__ volatile("ldmxcsr %0" : : "m"(host) : "memory"); }
#elif defined(__aarch64__)
typedef uint64_t Settings;
static Settings enter(void) {
    uint64_t host;
    __asm__ volatile("mrs %0, fpcr" : "=r"(host));
    __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0) : "memory");
    return host;
}
static void leave(Settings host) { __asm__ volatile("msr fpcr, %0" : : "r"(host) : "memory"); }
#else
#error "no kernels are made for this machine"
#endif

#define CALL(entry, ...)                                                  \
    int32_t result = -1;                                                  \
    void *exception = 0;                                                  \
    const Settings host = enter();                                        \
    const int32_t raised = PICK(entry)(&result, &exception, __VA_ARGS__); \
    leave(host);                                                          \
    return raised ? FAULT - raised : result

void *tw_memory(size_t size) { return calloc(1, size); }

void tw_free(void *memory) { free(memory); }

int tw_derive(double *par) { CALL(tw_derive, par); }

int tw_rule(const double *par) {
#if HAS_RULES
    CALL(tw_rule, par);
#else
    (void)par;
    return 0;
#endif
}

int tw_step(double *par, double *inp, double *state, double *work, double *out, int32_t *iout, double t,
            double dt) {
    CALL(tw_step, par, inp, state, work, out, iout, t, dt);
}

int tw_sens(double *par, double *inp, double *state, double *work, double *seed, double *dout) {
#if HAS_SENS
    CALL(tw_sens, par, inp, state, work, seed, dout);
#else
    (void)par, (void)inp, (void)state, (void)work, (void)seed, (void)dout;
    return FAULT;
#endif
}

#if HAS_EXCHANGE
int tw_start(double *par, double *own, double *inp, double *cont, double *discrete, double *work, double t) {
    CALL(tw_start, par, own, inp, cont, discrete, work, t);
}

int tw_rates(double *par, double *own, double *inp, double *cont, double *discrete, double *work, double *out,
             double *der, double *sign) {
    CALL(tw_rates, par, own, inp, cont, discrete, work, out, der, sign);
}

int tw_update(double *par, double *own, double *inp, double *cont, double *discrete, double *work,
              double *out, int32_t *iout, double t) {
    CALL(tw_update, par, own, inp, cont, discrete, work, out, iout, t);
}

#if NEEDS_STEPS
int tw_finish(double *par, double *own, double *inp, double *cont, double *discrete, double *work, double t) {
    CALL(tw_finish, par, own, inp, cont, discrete, work, t);
}
#endif

int tw_slopes(double *par, double *own, double *inp, double *cont, double *discrete, double *work,
              double *along, double *found) {
    CALL(tw_slopes, par, own, inp, cont, discrete, work, along, found);
}
#endif
