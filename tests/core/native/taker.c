/* What an FMU must not do: each step takes memory and gives it back, and writes far down the stack. */
#include <stdlib.h>

#include "fmi2Functions.h"

fmi2Component fmi2Instantiate(fmi2String a, fmi2Type b, fmi2String c, fmi2String d,
                              const fmi2CallbackFunctions *e, fmi2Boolean f, fmi2Boolean g) {
    (void)a, (void)b, (void)c, (void)d, (void)e, (void)f, (void)g;
    static int one;
    return &one;
}
#define EMPTY(name, ...) \
    fmi2Status fmi2##name(__VA_ARGS__) { return fmi2OK; }
EMPTY(SetupExperiment, fmi2Component c, fmi2Boolean a, fmi2Real b, fmi2Real d, fmi2Boolean e, fmi2Real f)
EMPTY(EnterInitializationMode, fmi2Component c)
EMPTY(ExitInitializationMode, fmi2Component c)
EMPTY(SetReal, fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Real x[])
EMPTY(GetReal, fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Real x[])
EMPTY(GetFMUstate, fmi2Component c, fmi2FMUstate *s)
EMPTY(SetFMUstate, fmi2Component c, fmi2FMUstate s)
void fmi2FreeInstance(fmi2Component c) { (void)c; }

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean n) {
    (void)c, (void)t, (void)h, (void)n;
    volatile char deep[20000];
    deep[0] = 1;
    void *volatile taken = malloc(8);
    free(taken);
    return fmi2OK;
}
