/* Time of a call of the derivatives in model exchange, FMI 2.0: states and an input moved each time.

   exchange_cost LIBRARY GUID RESOURCES INPUT VALUE CALLS STEP [PARAMETER NUMBER VALUE]..., values by
   their references; prints the least of five means [us]. STEP 1: a completed step after each call. */
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef void *Component;
typedef struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, int);
    void *environment;
} Callbacks;

static void *library;
static void *find(const char *name) {
    void *found = dlsym(library, name);
    if (!found) exit(fprintf(stderr, "no %s\n", name));
    return found;
}

static void quiet(void *c, const char *name, int status, const char *category, const char *text, ...) {
    (void)c, (void)name, (void)status, (void)category, (void)text;
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e6 + (double)t.tv_nsec * 1e-3;
}

int main(int n, char **given) {
    if (n < 8) return fprintf(stderr, "see the head of the source\n");
    library = dlopen(given[1], RTLD_NOW);
    if (!library) return fprintf(stderr, "%s\n", dlerror());
    Callbacks callbacks = {quiet, calloc, free, NULL, NULL};
    Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int) =
        (Component (*)(const char *, int, const char *, const char *, const Callbacks *, int, int))find(
            "fmi2Instantiate");
    int (*experiment)(Component, int, double, double, int, double) =
        (int (*)(Component, int, double, double, int, double))find("fmi2SetupExperiment");
    int (*enter)(Component) = (int (*)(Component))find("fmi2EnterInitializationMode");
    int (*leave)(Component) = (int (*)(Component))find("fmi2ExitInitializationMode");
    int (*go_on)(Component) = (int (*)(Component))find("fmi2EnterContinuousTimeMode");
    int (*put)(Component, const uint32_t *, size_t, const double *) =
        (int (*)(Component, const uint32_t *, size_t, const double *))find("fmi2SetReal");
    int (*choose)(Component, const uint32_t *, size_t, const int *) =
        (int (*)(Component, const uint32_t *, size_t, const int *))find("fmi2SetInteger");
    int (*states)(Component, double *, size_t) =
        (int (*)(Component, double *, size_t))find("fmi2GetContinuousStates");
    int (*derivatives)(Component, double *, size_t) =
        (int (*)(Component, double *, size_t))find("fmi2GetDerivatives");
    int (*complete)(Component, int, int *, int *) =
        (int (*)(Component, int, int *, int *))find("fmi2CompletedIntegratorStep");
    Component c = instantiate("unit", 0, given[2], given[3], &callbacks, 0, 0);
    if (!c) return fprintf(stderr, "no instance\n");
    const uint32_t input = (uint32_t)atoi(given[4]);
    const double value = atof(given[5]);
    const int calls = atoi(given[6]), completes = atoi(given[7]);
    int bad = experiment(c, 0, 0.0, 0.0, 0, 0.0), ends[2];
    for (int k = 8; k + 1 < n; k += 2) {
        const uint32_t place = (uint32_t)atoi(given[k]);
        const int number = atoi(given[k + 1]);
        bad |= choose(c, &place, 1, &number);
    }
    bad |= enter(c) | put(c, &input, 1, &value) | leave(c) | go_on(c);
    double x[64], best = 1e300;
    (void)states;
    for (int round = 0; round < 5; round++) {
        const double begin = now();
        for (int k = 0; k < calls; k++) {
            const double moved = value * (1.0 + 1e-4 * (k % 7));
            bad |= put(c, &input, 1, &moved) | derivatives(c, x, (size_t)atoi(getenv("STATES")));
            if (completes) bad |= complete(c, 1, &ends[0], &ends[1]);
        }
        const double each = (now() - begin) / calls;
        if (each < best) best = each;
    }
    if (bad) return fprintf(stderr, "a call failed\n");
    printf("%.3f\n", best);
    return 0;
}
