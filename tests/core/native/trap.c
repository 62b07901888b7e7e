/* A host that traps: once an FMU is initialized, no call may take memory, a file or a lock, or jump.

   What the C library itself does for the FMU is trapped too where it goes through these names. Reads
   from standard input: LIBRARY GUID RESOURCES; how many inputs, then REFERENCE LOW HIGH LEAST MOST of
   each, the range to walk in and the allowed one; how many parameters, then KIND (r, i, b) REFERENCE
   VALUE; how many Real outputs, then the references; how many steps. One input in fifty is hostile:
   NaN, infinite, huge, zero, or an end of the allowed range. Prints what was trapped, counts, and
   the stack [bytes] that initialization and steps took: they run on a painted stack of their own. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <ucontext.h>

#include "fmi2Functions.h"

static int armed;
static long n_trapped;
static const char *trapped = "none";

static void trap(const char *name) {
    if (!armed) return;
    n_trapped++;
    trapped = name;
}

void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);
void __libc_free(void *);
void *malloc(size_t n) { return trap("malloc"), __libc_malloc(n); }
void *calloc(size_t n, size_t size) { return trap("calloc"), __libc_calloc(n, size); }
void *realloc(void *p, size_t n) { return trap("realloc"), __libc_realloc(p, n); }
void *aligned_alloc(size_t a, size_t n) { return trap("aligned_alloc"), __libc_memalign(a, n); }
void free(void *p) {
    if (p) trap("free");
    __libc_free(p);
}

static void *next(const char *name) {
    int was = armed;
    armed = 0;
    void *found = dlsym(RTLD_NEXT, name);
    armed = was;
    return found;
}

FILE *fopen(const char *path, const char *mode) {
    FILE *(*open)(const char *, const char *);
    trap("fopen");
    *(void **)&open = next("fopen");
    return open(path, mode);
}

int pthread_mutex_lock(pthread_mutex_t *mutex) {
    int (*lock)(pthread_mutex_t *);
    trap("pthread_mutex_lock");
    *(void **)&lock = next("pthread_mutex_lock");
    return lock(mutex);
}

void longjmp(jmp_buf place, int value) {
    void (*jump)(jmp_buf, int) __attribute__((noreturn));
    trap("longjmp");
    *(void **)&jump = next("longjmp");
    jump(place, value);
}

enum { MOST = 512 };
typedef struct { unsigned n, reference[MOST]; double a[MOST], b[MOST], least[MOST], most[MOST]; } Rows;
static Rows in, par, out;
static char kind[MOST];
static uint64_t seed = 88172645463325252u;
static long n_messages;

static double uniform(void) {
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static void logger(fmi2ComponentEnvironment env, fmi2String instance, fmi2Status status,
                   fmi2String category, fmi2String message, ...) {
    (void)env, (void)instance, (void)status, (void)category, (void)message;
    n_messages++;
}

static double hostile(unsigned i) {
    const double words[] = {NAN, INFINITY, -INFINITY, 1e308, -1e308, 0.0, 5e-324, in.least[i],
                            in.most[i], 0.5 * (in.a[i] + in.b[i])};
    return words[(int)(uniform() * 10.0)];
}

static int are_finite(const double *x, unsigned n) {
    int good = 1;
    for (unsigned i = 0; i < n; i++) good &= isfinite(x[i]) != 0;
    return good;
}

/* The calls of a step, or of an initialization, on a stack that shows how deep it was written to. */
enum { ROOM = 1 << 20, PAINT = 0xa5 };
static unsigned char stack[ROOM] __attribute__((aligned(64)));
static unsigned char *base; /* where the frame of the call's caller ends */
static ucontext_t here, there;
static void (*called)(void);

static void run(void) {
    base = __builtin_frame_address(0);
    called();
}

static void on_stack(void (*calls)(void)) {
    called = calls;
    getcontext(&there);
    there.uc_stack.ss_sp = stack;
    there.uc_stack.ss_size = sizeof stack;
    there.uc_link = &here;
    makecontext(&there, run, 0);
    swapcontext(&here, &there);
}

static void paint(void) { memset(stack, PAINT, sizeof stack); }

static long depth(void) {
    const unsigned char *p = stack;
    while (p < base && *p == PAINT) p++;
    return base - p;
}

#define TAKE(name) *(void **)&name = dlsym(library, "fmi2" #name)
static fmi2InstantiateTYPE *Instantiate;
static fmi2SetupExperimentTYPE *SetupExperiment;
static fmi2EnterInitializationModeTYPE *EnterInitializationMode;
static fmi2ExitInitializationModeTYPE *ExitInitializationMode;
static fmi2SetRealTYPE *SetReal;
static fmi2SetIntegerTYPE *SetInteger;
static fmi2SetBooleanTYPE *SetBoolean;
static fmi2GetRealTYPE *GetReal;
static fmi2DoStepTYPE *DoStep;
static fmi2GetFMUstateTYPE *GetFMUstate;
static fmi2SetFMUstateTYPE *SetFMUstate;
static fmi2GetDirectionalDerivativeTYPE *GetDirectionalDerivative;
static fmi2FreeInstanceTYPE *FreeInstance;
static fmi2Component c;
static double x[MOST], before[MOST], after[MOST], t, h;
static int is_set, known, rc, shown;

static void initialize(void) {
    SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0);
    EnterInitializationMode(c);
    SetReal(c, in.reference, in.n, x);
    rc = ExitInitializationMode(c);
}

static void step(void) {
    is_set = SetReal(c, in.reference, in.n, x) <= fmi2Warning;
    known = GetReal(c, out.reference, out.n, before) <= fmi2Warning;
    rc = DoStep(c, t, h, fmi2True);
    shown = GetReal(c, out.reference, out.n, after) <= fmi2Warning;
}

int main(void) {
    static char file[4096], guid[64], resources[4096];
    long steps, failed = 0, not_finite = 0, moved = 0, refused = 0;
    if (scanf("%4095s %63s %4095s", file, guid, resources) != 3) return 9;
    if (scanf("%u", &in.n) != 1) return 9;
    for (unsigned i = 0; i < in.n; i++) {
        if (scanf("%u %lf %lf %lf %lf", &in.reference[i], &in.a[i], &in.b[i], &in.least[i],
                  &in.most[i]) != 5) return 9;
    }
    if (scanf("%u", &par.n) != 1) return 9;
    for (unsigned i = 0; i < par.n; i++) {
        if (scanf(" %c %u %lf", &kind[i], &par.reference[i], &par.a[i]) != 3) return 9;
    }
    if (scanf("%u", &out.n) != 1) return 9;
    for (unsigned i = 0; i < out.n; i++) {
        if (scanf("%u", &out.reference[i]) != 1) return 9;
    }
    if (scanf("%ld", &steps) != 1) return 9;
    void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (!library) return puts(dlerror()), 9;
    TAKE(Instantiate); TAKE(SetupExperiment); TAKE(EnterInitializationMode); TAKE(SetReal);
    TAKE(ExitInitializationMode); TAKE(SetInteger); TAKE(SetBoolean); TAKE(GetReal); TAKE(DoStep);
    TAKE(GetFMUstate); TAKE(SetFMUstate); TAKE(GetDirectionalDerivative); TAKE(FreeInstance);
    const fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};
    c = Instantiate("trap", fmi2CoSimulation, guid, resources, &callbacks, 0, 1);
    if (!c) return 9;
    for (unsigned i = 0; i < par.n; i++) {
        const int whole = (int)par.a[i];
        if (kind[i] == 'r') SetReal(c, &par.reference[i], 1, &par.a[i]);
        if (kind[i] == 'i') SetInteger(c, &par.reference[i], 1, &whole);
        if (kind[i] == 'b') SetBoolean(c, &par.reference[i], 1, &whole);
    }
    for (unsigned i = 0; i < in.n; i++) x[i] = 0.5 * (in.a[i] + in.b[i]);
    paint();
    on_stack(initialize);
    if (rc > fmi2Warning) return puts("no start"), 9;
    const long at_start = depth();
    paint();
    fmi2FMUstate state = NULL;
    GetFMUstate(c, &state);
    const double one = 1.0;

    armed = 1;
    for (long k = 0; k < steps; k++) {
        for (unsigned i = 0; i < in.n; i++) {
            if (uniform() < 0.3) x[i] = in.a[i] + uniform() * (in.b[i] - in.a[i]);
        }
        const int i = in.n ? (int)(uniform() * in.n) : 0, bad = in.n && (k == 7 || uniform() < 0.02);
        const double good = x[i];
        if (bad) x[i] = hostile((unsigned)i);
        h = 1e-4 * pow(100.0, uniform());
        if (uniform() < 0.005) h = hostile(0);
        if (k == 5) h = -1.0; /* one failure at least */
        on_stack(step);
        refused += !is_set;
        if (rc <= fmi2Warning) t += h;
        failed += rc > fmi2Warning;
        not_finite += shown && !are_finite(after, out.n);
        not_finite += rc <= fmi2Warning && !shown;
        if (rc > fmi2Warning && known && (!shown || memcmp(before, after, out.n * sizeof *after))) moved++;
        if (bad) x[i] = good;
        if (uniform() < 0.01) GetFMUstate(c, &state);
        if (uniform() < 0.005) SetFMUstate(c, state);
        if (in.n && uniform() < 0.01 && k % 7 == 0) {
            GetDirectionalDerivative(c, &out.reference[0], 1, &in.reference[i], 1, &one, after);
        }
        if (!(t < 1e6)) t = 0.0;
    }
    armed = 0;
    FreeInstance(c);
    printf("trapped %ld %s\nfailed %ld\nnot_finite %ld\nmoved %ld\nrefused %ld\nmessages %ld\n"
           "stack %ld %ld\n",
           n_trapped, trapped, failed, not_finite, moved, refused, n_messages, at_start, depth());
    return 0;
}
