/* Runs a native FMI 2.0 library as a co-simulation host does, on whatever platform:
   driver LIBRARY GUID NAME IN OUT. IN: int32 inputs, outputs, steps; uint32 references of inputs and
   outputs; doubles: step size, then the inputs of each step. OUT: the outputs after each step.
   Every step is made twice, from a state that is set again, freed, and refused from then on. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2Functions.h"

#ifdef _WIN32
#include <windows.h>
#define OPEN(path) ((void *)LoadLibraryA(path))
#define FIND(library, name) ((void *)GetProcAddress((HMODULE)(library), name))
#define WHY "LoadLibrary failed"
#else
#include <dlfcn.h>
#define OPEN(path) dlopen(path, RTLD_NOW)
#define FIND(library, name) dlsym(library, name)
#define WHY dlerror()
#endif

enum { MOST = 256 };

static void stop(const char *what)
{
    fprintf(stderr, "driver: %s\n", what);
    exit(1);
}

static void say(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                fmi2String category, fmi2String text, ...)
{
    va_list values;
    (void)environment, (void)name, (void)status, (void)category;
    va_start(values, text);
    vfprintf(stderr, text, values);
    va_end(values);
    fputc('\n', stderr);
}

static void *find(void *library, const char *name)
{
    void *function = FIND(library, name);
    if (!function)
        stop(name);
    return function;
}

static void take(void *target, size_t size, size_t n, FILE *file)
{
    if (fread(target, size, n, file) != n)
        stop("the input file is too short");
}

#define USE(name) name##TYPE *name = (name##TYPE *)find(library, #name)
#define CHECK(call)      \
    if ((call) > fmi2OK) \
    stop(#call)

static void run(void *library, const char *guid, const char *name, FILE *in, FILE *out)
{
    USE(fmi2Instantiate);
    USE(fmi2SetupExperiment);
    USE(fmi2EnterInitializationMode);
    USE(fmi2ExitInitializationMode);
    USE(fmi2SetReal);
    USE(fmi2GetReal);
    USE(fmi2DoStep);
    USE(fmi2GetFMUstate);
    USE(fmi2SetFMUstate);
    USE(fmi2FreeFMUstate);
    USE(fmi2Terminate);
    USE(fmi2FreeInstance);
    const fmi2CallbackFunctions callbacks = {say, calloc, free, NULL, NULL};
    fmi2ValueReference inputs[MOST], outputs[MOST];
    double given[MOST], found[MOST], dt;
    int n[3];
    take(n, sizeof n[0], 3, in);
    if (n[0] > MOST || n[1] > MOST)
        stop("too many variables");
    take(inputs, sizeof inputs[0], n[0], in);
    take(outputs, sizeof outputs[0], n[1], in);
    take(&dt, sizeof dt, 1, in);
    fmi2Component c =
        fmi2Instantiate(name, fmi2CoSimulation, guid, ".", &callbacks, 0, 0);
    if (!c)
        stop("fmi2Instantiate");
    CHECK(fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0));
    CHECK(fmi2EnterInitializationMode(c));
    CHECK(fmi2ExitInitializationMode(c));
    for (int i = 0; i < n[2]; i++) {
        fmi2FMUstate state = NULL, freed;
        take(given, sizeof given[0], n[0], in);
        CHECK(fmi2SetReal(c, inputs, n[0], given));
        CHECK(fmi2GetFMUstate(c, &state));
        CHECK(fmi2DoStep(c, i * dt, dt, 1));
        freed = state;
        CHECK(fmi2SetFMUstate(c, state));
        CHECK(fmi2FreeFMUstate(c, &state));
        if (fmi2SetFMUstate(c, freed) != fmi2Error)
            stop("a freed state was taken for a living one");
        CHECK(fmi2DoStep(c, i * dt, dt, 1));
        CHECK(fmi2GetReal(c, outputs, n[1], found));
        fwrite(found, sizeof found[0], n[1], out);
    }
    CHECK(fmi2Terminate(c));
    fmi2FreeInstance(c);
}

int main(int n, char **arguments)
{
    if (n != 6)
        stop("usage: driver LIBRARY GUID NAME IN OUT");
    void *library = OPEN(arguments[1]);
    FILE *in = fopen(arguments[4], "rb"), *out = fopen(arguments[5], "wb");
    if (!library)
        stop(WHY);
    if (!in || !out)
        stop("the files cannot be opened");
    run(library, arguments[2], arguments[3], in, out);
    fclose(in);
    return fclose(out);
}
