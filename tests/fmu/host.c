/* A host that is no Python: host LIBRARY RESOURCE_URI GUID CYCLES. Prints what it sees. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2Functions.h"

#define NEED(name) name##TYPE *p_##name = (name##TYPE *)dlsym(library, #name)

static void logger(fmi2ComponentEnvironment env, fmi2String instance, fmi2Status status,
                   fmi2String category, fmi2String message, ...) {
    (void)env, (void)instance;
    printf("message %d %s: %s\n", status, category ? category : "", message);
}

int main(int argc, char **argv) {
    if (argc != 5) return 9;
    void *library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) { puts(dlerror()); return 1; }
    NEED(fmi2Instantiate); NEED(fmi2SetupExperiment); NEED(fmi2EnterInitializationMode);
    NEED(fmi2ExitInitializationMode); NEED(fmi2DoStep); NEED(fmi2GetReal); NEED(fmi2SetReal);
    NEED(fmi2GetInteger); NEED(fmi2FreeInstance);
    fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};
    const fmi2ValueReference inputs[] = {1, 2, 3}, torque = 11, solver_status = 17;
    fmi2Real good[] = {500.0, 20.0, 310.0}, bad[] = {9500.0, 20.0, 310.0}, value = 0.0;
    for (int cycle = 0; cycle < atoi(argv[4]); cycle++) {
        fmi2Component c = p_fmi2Instantiate("host", fmi2CoSimulation, argv[3], argv[2],
                                            &callbacks, fmi2False, fmi2True);
        if (!c) return 2;
        int rc = p_fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0);
        rc |= p_fmi2EnterInitializationMode(c);
        rc |= p_fmi2ExitInitializationMode(c);
        rc |= p_fmi2SetReal(c, inputs, 3, good);
        for (int i = 0; i < 10; i++) rc |= p_fmi2DoStep(c, i * 1e-3, 1e-3, fmi2True);
        rc |= p_fmi2GetReal(c, &torque, 1, &value);
        p_fmi2SetReal(c, inputs, 3, bad);
        fmi2Integer status = 0;
        int failed = p_fmi2DoStep(c, 1e-2, 1e-3, fmi2True);
        p_fmi2GetInteger(c, &solver_status, 1, &status);
        printf("good %d torque %.17g failed %d status %d\n", rc, value, failed, status);
        p_fmi2FreeInstance(c);
    }
    dlclose(library);
    return 0;
}
