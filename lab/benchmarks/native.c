/* Times an FMU of FMI 2.0 as a C host sees it: native LIBRARY GUID STEPS, the variables on standard
   input: N_INPUTS [REFERENCE VALUE]... N_OUTPUTS [REFERENCE]... Prints medians: seconds for
   instantiation with initialization, and for one step with all inputs set and all outputs got. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "fmi2Functions.h"

#define MOST 64
#define ROUNDS 15
#define NEED(name) fmi2##name##TYPE *name = (fmi2##name##TYPE *)dlsym(library, "fmi2" #name)

static fmi2ValueReference inputs[MOST], outputs[MOST];
static double point[MOST], values[MOST];
static size_t n_inputs, n_outputs;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int less(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *times)
{
    qsort(times, ROUNDS, sizeof *times, less);
    return times[ROUNDS / 2];
}

static int read_variables(void)
{
    if (scanf("%zu", &n_inputs) != 1 || n_inputs > MOST)
        return 0;
    for (size_t i = 0; i < n_inputs; i++) {
        if (scanf("%u %lf", &inputs[i], &point[i]) != 2)
            return 0;
    }
    if (scanf("%zu", &n_outputs) != 1 || n_outputs > MOST)
        return 0;
    for (size_t i = 0; i < n_outputs; i++) {
        if (scanf("%u", &outputs[i]) != 1)
            return 0;
    }
    return 1;
}

int main(int argc, char **argv)
{
    void *library = argc == 4 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!library || !read_variables())
        return 2;
    NEED(Instantiate); NEED(FreeInstance); NEED(EnterInitializationMode); NEED(SetReal);
    NEED(ExitInitializationMode); NEED(DoStep); NEED(GetReal);
    fmi2CallbackFunctions callbacks = {NULL, NULL, NULL, NULL, NULL};
    double births[ROUNDS], steps[ROUNDS];
    int n = atoi(argv[3]), bad = 0;
    for (int round = 0; round < ROUNDS; round++) {
        double start = now();
        void *m = Instantiate("timed", fmi2CoSimulation, argv[2], ".", &callbacks, 0, 0);
        if (!m)
            return 3;
        EnterInitializationMode(m);
        SetReal(m, inputs, n_inputs, point);
        bad += ExitInitializationMode(m) != fmi2OK;
        births[round] = now() - start;
        start = now();
        for (int i = 0; i < n; i++) {
            for (size_t k = 0; k < n_inputs; k++)
                values[k] = point[k] * (i & 1 ? 1.0 : 0.999999);
            bad += SetReal(m, inputs, n_inputs, values) != fmi2OK;
            bad += DoStep(m, i * 1e-3, 1e-3, fmi2True) != fmi2OK;
            bad += GetReal(m, outputs, n_outputs, values) != fmi2OK;
        }
        steps[round] = (now() - start) / n;
        FreeInstance(m);
    }
    printf("%.9g %.9g %d\n", median(births), median(steps), bad);
    return 0;
}
