/* A master gone wild, in C: abuse LIBRARY GUID RESOURCES STEPS SEED JUMPS, the variables on standard
   input: SPEED TORQUE (places among inputs and outputs, -1: none), then N_SET [REFERENCE NUMBER]...
   N_INPUTS [REFERENCE LOW HIGH FROM TO]... N_OUTPUTS [REFERENCE]... Inputs wander between FROM and TO,
   in a share JUMPS of the steps they jump; before one step in 32 comes a value outside LOW .. HIGH, or
   none at all, that must be refused. One step in 64 is taken back and repeated. Prints counts, resident kB half way and at the end, and if a fresh instance and the
   used one, reset, then answer alike. */
#include <dlfcn.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

#define MOST 64
#define NEED(name) static fmi2##name##TYPE *name
NEED(Instantiate); NEED(FreeInstance); NEED(EnterInitializationMode); NEED(ExitInitializationMode);
NEED(SetReal); NEED(GetReal); NEED(SetInteger); NEED(DoStep); NEED(Reset); NEED(GetFMUstate);
NEED(SetFMUstate); NEED(FreeFMUstate); NEED(SerializedFMUstateSize); NEED(SerializeFMUstate);
NEED(DeSerializeFMUstate); NEED(SetupExperiment);
static void *library;
#define TAKE(name) *(void **)&name = dlsym(library, "fmi2" #name);

static int n_set, n_in, n_out, speed, torque;
static fmi2ValueReference set[MOST], in[MOST], out[MOST];
static fmi2Integer chosen[MOST];
static double low[MOST], high[MOST], from[MOST], to[MOST], jumps;
static uint64_t seed;
static long right, refused, unsolved, lost, rolled, spoiled;

static uint64_t next(void) {
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return seed;
}
static double share(void) { return (double)(next() >> 11) / 9007199254740992.0; }

static long resident(void) {
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%*d %ld", &pages) != 1) exit(8);
    fclose(file);
    return pages * 4;
}

static int begin(fmi2Component c) {
    int rc = SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0);
    if (n_set) rc |= SetInteger(c, set, (size_t)n_set, chosen);
    return rc | EnterInitializationMode(c) | ExitInitializationMode(c);
}

static void wander(double *x) {
    int jump = share() < jumps;
    for (int k = 0; k < n_in; k++) {
        double width = to[k] - from[k], y = x[k] + 0.01 * width * (2.0 * share() - 1.0);
        if (jump) y = from[k] + width * share();
        uint64_t kind = jump ? next() % 32 : 9;
        if (kind == 0) y = from[k];
        if (kind == 1) y = to[k];
        if (kind == 2) y = 0.0;
        if (kind == 3) y = 5e-324;
        x[k] = y < from[k] ? from[k] : y > to[k] ? to[k] : y;
    }
}

static double wrong(int k) {
    const double width = high[k] - low[k];  /* of rounding a range is taken some digits wider */
    const double all[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, low[k] - 1e-6 * width,
                          high[k] + 1e-6 * width};
    return all[next() % 7];
}

static void lose(const char *what, long i) {
    if (lost++ < 5) fprintf(stderr, "step %ld: %s\n", i, what);
}

/* One step; what came back, all outputs finite if it is OK. */
static int one(fmi2Component c, const double *x, double t, double h, double *y, long i) {
    memset(y, 0, MOST * sizeof *y);
    int rc = SetReal(c, in, (size_t)n_in, x);
    if (rc > fmi2Warning) return lose("a legal input is refused", i), rc;
    rc = DoStep(c, t, h, fmi2True);
    if (rc > fmi2Warning) return rc;
    if (GetReal(c, out, (size_t)n_out, y) > fmi2Warning) return lose("no outputs after OK", i), 3;
    for (int k = 0; k < n_out; k++) if (!isfinite(y[k])) lose("an output is not finite", i);
    if (speed >= 0 && y[torque] * x[speed] < 0.0) lose("friction drives", i);
    return 0;
}

static void again(fmi2Component c, fmi2FMUstate *s, const double *x, double t, double h,
                  const double *y, int rc, long i) {
    double z[MOST];
    if (SetFMUstate(c, *s)) lose("a state cannot be set", i);
    if (one(c, x, t, h, z, i) != rc || memcmp(y, z, sizeof z)) lose("rolled back, other bits", i);
    rolled++;
}

static void spoil(fmi2Component c, fmi2FMUstate s, long i) {
    static fmi2Byte bytes[1 << 22];
    size_t n = 0;
    fmi2FMUstate other = NULL;
    if (SerializedFMUstateSize(c, s, &n) || n > sizeof bytes) exit(7);
    if (SerializeFMUstate(c, s, bytes, n)) exit(7);
    bytes[next() % n] ^= (fmi2Byte)(1u << next() % 8);
    if (DeSerializeFMUstate(c, bytes, n, &other) == fmi2OK) lose("a spoiled state is taken", i);
    spoiled++;
}

static uint64_t replay(fmi2Component c) {
    double x[MOST], y[MOST];
    uint64_t hash = 14695981039346656037u, keep = seed;
    seed = 88172645463325252u;
    for (int k = 0; k < n_in; k++) x[k] = 0.5 * (from[k] + to[k]);
    if (begin(c)) exit(6);
    for (int i = 0; i < 100; i++) {
        wander(x);
        int rc = one(c, x, i * 1e-3, 1e-3, y, -1);
        const unsigned char *bytes = (const unsigned char *)y;
        for (size_t k = 0; k < sizeof y; k++) hash = (hash ^ bytes[k]) * 1099511628211u;
        hash = (hash ^ (unsigned)rc) * 1099511628211u;
    }
    seed = keep;
    return hash;
}

static int read_job(void) {
    int good = scanf("%d %d %d", &speed, &torque, &n_set) == 3;
    for (int k = 0; k < n_set && good; k++) good = scanf("%u %d", &set[k], &chosen[k]) == 2;
    good = good && scanf("%d", &n_in) == 1;
    for (int k = 0; k < n_in && good; k++)
        good = scanf("%u %lf %lf %lf %lf", &in[k], &low[k], &high[k], &from[k], &to[k]) == 5;
    good = good && scanf("%d", &n_out) == 1;
    for (int k = 0; k < n_out && good; k++) good = scanf("%u", &out[k]) == 1;
    return good;
}

int main(int argc, char **argv) {
    library = argc == 7 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!library || !read_job()) return 2;
    TAKE(Instantiate) TAKE(FreeInstance) TAKE(EnterInitializationMode) TAKE(SetReal) TAKE(GetReal)
    TAKE(ExitInitializationMode) TAKE(SetInteger) TAKE(DoStep) TAKE(Reset) TAKE(GetFMUstate)
    TAKE(SetFMUstate) TAKE(FreeFMUstate) TAKE(SerializedFMUstateSize) TAKE(SerializeFMUstate)
    TAKE(DeSerializeFMUstate) TAKE(SetupExperiment)
    fmi2CallbackFunctions callbacks = {NULL, NULL, NULL, NULL, NULL};
    fmi2Component c = Instantiate("used", fmi2CoSimulation, argv[2], argv[3], &callbacks, 0, 0);
    long n = atol(argv[4]), early = 0;
    seed = 0x9e3779b97f4a7c15u * (strtoull(argv[5], NULL, 10) + 1u), jumps = atof(argv[6]);
    double x[MOST], y[MOST], t = 0.0;
    if (!c || begin(c)) return 3;
    for (int k = 0; k < n_in; k++) x[k] = 0.5 * (from[k] + to[k]);
    for (long i = 0; i < n; i++) {
        if (i == n / 2) early = resident();
        uint64_t dice = next();
        double h = dice % 7 == 0 ? 1e-2 : dice % 7 == 1 ? 1e-6 : 1e-3;
        wander(x);
        if (dice / 7 % 32 == 0) {
            int k = (int)(next() % (uint64_t)n_in);
            double good = x[k];
            x[k] = wrong(k);
            if (SetReal(c, in, (size_t)n_in, x) <= fmi2Warning) lose("a wrong input is taken", i);
            refused++, x[k] = good;
        }
        fmi2FMUstate s = NULL;
        if (dice / 224 % 64 == 0 && GetFMUstate(c, &s)) lose("no state", i);
        int rc = one(c, x, t, h, y, i);
        if (s) {
            again(c, &s, x, t, h, y, rc, i);
            if (dice / 14336 % 16 == 0) spoil(c, s, i);
            FreeFMUstate(c, &s);
        }
        if (rc == 0) right++, t += h;
        else {
            unsolved++, t = 0.0;
            if (Reset(c) || begin(c)) lose("cannot begin anew", i);
        }
    }
    long late = resident();
    fmi2Component fresh = Instantiate("fresh", fmi2CoSimulation, argv[2], argv[3], &callbacks, 0, 0);
    if (!fresh || Reset(c) || replay(c) != replay(fresh)) lose("a fresh instance answers else", n);
    FreeInstance(c);
    FreeInstance(fresh);
    printf("%ld %ld %ld %ld %ld %ld %ld %ld\n", right, refused, unsolved, lost, rolled, spoiled,
           early, late);
    return 0;
}
