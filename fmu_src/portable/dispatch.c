/* From plain C to the kernels of module.c, in place of ../shell/dispatch.c.

   An instance lies in one block with the memory of its module, so that nothing is copied:

       the module's stack and constants | Handed | the instance

   For the module an address is the distance from the beginning of the block. */
#include <fenv.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "kernel.h"
#include "module.h"
#include "shell.h"
#include "wasm.h"

enum { FAULT = -1000 };

/* What comes back beside the return value, and room for arrays that lie outside of the block. */
typedef struct {
    int32_t result, exception;
    double inp[sizeof((Instance *)0)->now.inp / sizeof(double)], seed[AT_LEAST_ONE(NSEED)];
    double out[AT_LEAST_ONE(NOUT)];
} Handed;

#define ROUNDED(size) (((size) + 15u) / 16u * 16u)
#define HANDED ROUNDED(MODULE_SIZE)
#define INSTANCE (HANDED + ROUNDED(sizeof(Handed)))
#define BLOCK (INSTANCE + sizeof(Instance))

void *tw_memory(size_t size) {
    u8 *m = calloc(1, INSTANCE + size);
    if (!m) return NULL;
    module_open(m);
    return m + INSTANCE;
}

void tw_free(void *memory) {
    if (memory) free((u8 *)memory - INSTANCE);
}

static u8 *block_of(const double *par) {
    return (u8 *)(uintptr_t)par - offsetof(Instance, now.par) - INSTANCE;
}

static int lies_in(const u8 *m, const void *array) {
    return (uintptr_t)array >= (uintptr_t)m && (uintptr_t)array - (uintptr_t)m < BLOCK;
}

/* The address of an array in the block, or of a copy of it in the room that Handed has. */
static u32 place(u8 *m, const double *array, size_t room, size_t size) {
    if (lies_in(m, array)) return (u32)((uintptr_t)array - (uintptr_t)m);
    memcpy(m + HANDED + room, array, size);
    return (u32)(HANDED + room);
}
#define INSIDE(array) ((u32)((uintptr_t)(array) - (uintptr_t)m))
#define PLACE(array, member) place(m, array, offsetof(Handed, member), sizeof((Handed *)0)->member)
#define RESULT (u32)(HANDED + offsetof(Handed, result))
#define EXCEPTION (u32)(HANDED + offsetof(Handed, exception))

/* The host may round otherwise or trap: numbers would differ or the process end. Then the host's own
   settings again. */
#define CALL(entry, ...)                                                  \
    fenv_t host;                                                          \
    fegetenv(&host);                                                      \
    fesetenv(FE_DFL_ENV);                                                 \
    ((Own *)(void *)m)->trapped = 0;                                      \
    const u32 raised = module_##entry(m, RESULT, EXCEPTION, __VA_ARGS__); \
    fesetenv(&host)

static int returned(const u8 *m, u32 raised) {
    if (raised || ((const Own *)(const void *)m)->trapped) return FAULT;
    return (int)(s32)i32_load(m, RESULT);
}

int tw_derive(double *par) {
    u8 *m = block_of(par);
    CALL(derive, INSIDE(par));
    return returned(m, raised);
}

int tw_rule(const double *par) {
#if HAS_RULES
    u8 *m = block_of(par);
    CALL(rule, INSIDE(par));
    return returned(m, raised);
#else
    (void)par;
    return 0;
#endif
}

int tw_step(double *par, double *inp, double *state, double *work, double *out, int32_t *iout, double t,
            double dt) {
    u8 *m = block_of(par);
    const u32 given = PLACE(inp, inp);
    CALL(step, INSIDE(par), given, INSIDE(state), INSIDE(work), INSIDE(out), INSIDE(iout), t, dt);
    return returned(m, raised);
}

int tw_sens(double *par, double *inp, double *state, double *work, double *seed, double *dout) {
#if HAS_SENS
    u8 *m = block_of(par);
    const u32 given = PLACE(inp, inp), along = PLACE(seed, seed), found = PLACE(dout, out);
    CALL(sens, INSIDE(par), given, INSIDE(state), INSIDE(work), along, found);
    if (!lies_in(m, dout)) memcpy(dout, m + found, NOUT * sizeof *dout);
    return returned(m, raised);
#else
    (void)par, (void)inp, (void)state, (void)work, (void)seed, (void)dout;
    return FAULT;
#endif
}

#if HAS_EXCHANGE
int tw_start(double *par, double *own, double *inp, double *cont, double *discrete, double *work, double t) {
    u8 *m = block_of(par);
    CALL(start, INSIDE(par), INSIDE(own), INSIDE(inp), INSIDE(cont), INSIDE(discrete), INSIDE(work), t);
    return returned(m, raised);
}

int tw_rates(double *par, double *own, double *inp, double *cont, double *discrete, double *work, double *out,
             double *der, double *sign) {
    u8 *m = block_of(par);
    CALL(rates, INSIDE(par), INSIDE(own), INSIDE(inp), INSIDE(cont), INSIDE(discrete), INSIDE(work),
         INSIDE(out), INSIDE(der), INSIDE(sign));
    return returned(m, raised);
}

int tw_update(double *par, double *own, double *inp, double *cont, double *discrete, double *work,
              double *out, int32_t *iout, double t) {
    u8 *m = block_of(par);
    CALL(update, INSIDE(par), INSIDE(own), INSIDE(inp), INSIDE(cont), INSIDE(discrete), INSIDE(work),
         INSIDE(out), INSIDE(iout), t);
    return returned(m, raised);
}

#if NEEDS_STEPS
int tw_finish(double *par, double *own, double *inp, double *cont, double *discrete, double *work, double t) {
    u8 *m = block_of(par);
    CALL(finish, INSIDE(par), INSIDE(own), INSIDE(inp), INSIDE(cont), INSIDE(discrete), INSIDE(work), t);
    return returned(m, raised);
}
#endif

int tw_slopes(double *par, double *own, double *inp, double *cont, double *discrete, double *work,
              double *along, double *found) {
    u8 *m = block_of(par);
    CALL(slopes, INSIDE(par), INSIDE(own), INSIDE(inp), INSIDE(cont), INSIDE(discrete), INSIDE(work),
         INSIDE(along), INSIDE(found));
    return returned(m, raised);
}
#endif
