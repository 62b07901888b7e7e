/* The commands of a script, on an FMU of FMI 2.0. */
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "fmi2Functions.h"
#include "script.h"

#define EACH(DO)                                                                                   \
    DO(GetTypesPlatform) DO(GetVersion) DO(Instantiate) DO(FreeInstance) DO(SetupExperiment)       \
    DO(EnterInitializationMode) DO(ExitInitializationMode) DO(Terminate) DO(Reset) DO(DoStep)      \
    DO(GetReal) DO(GetInteger) DO(GetBoolean) DO(GetString) DO(SetReal) DO(SetInteger)             \
    DO(SetBoolean) DO(SetString) DO(GetFMUstate) DO(SetFMUstate) DO(FreeFMUstate)                  \
    DO(SerializedFMUstateSize) DO(SerializeFMUstate) DO(DeSerializeFMUstate) DO(GetStatus)         \
    DO(GetRealStatus) DO(GetIntegerStatus) DO(GetBooleanStatus) DO(GetStringStatus)                \
    DO(SetDebugLogging) DO(GetDirectionalDerivative) DO(SetRealInputDerivatives)
#define DECLARE(name) static fmi2##name##TYPE *name;
#define FIND(name) name = (fmi2##name##TYPE *)dlsym(library, "fmi2" #name);
EACH(DECLARE)

void open_library(void *library) { EACH(FIND) }

/* A host whose logger takes no arguments behind the text would see "%s"; ## stands for #. */
static void logger(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                   fmi2String category, fmi2String format, ...)
{
    char text[2048];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    char *to = text;
    for (const char *c = text; *c; c++) {
        *to++ = *c;
        if (c[0] == '#' && c[1] == '#') c++;
    }
    *to = '\0';
    hear(environment == (void *)&GetVersion ? name : "lost", status, category,
         strcmp(format, "%s") == 0 ? "%s" : text);
}

void *make(const char *name, const char *guid, int logging, const char *oddity)
{
    fmi2CallbackFunctions callbacks = {logger, NULL, NULL, NULL, (void *)&GetVersion};
    int is = oddity ? oddity[0] : 0; /* m: model exchange, l: no logger, c: no callbacks */
    if (is == 'l')
        callbacks.logger = NULL;
    return Instantiate(name, is == 'm' ? fmi2ModelExchange : fmi2CoSimulation, guid, resources,
                       is == 'c' ? NULL : &callbacks, fmi2False, logging);
}

void drop(void *m) { FreeInstance(m); }

int set_up(void *m, double start) { return SetupExperiment(m, 1, 1e-6, start, 1, start + 1.0); }

int enter(void *m, double start)
{
    (void)start;
    return EnterInitializationMode(m);
}

int leave(void *m) { return ExitInitializationMode(m); }
int end(void *m) { return Terminate(m); }
int start_over(void *m) { return Reset(m); }
int step(void *m, double t, double h) { return DoStep(m, t, h, fmi2True); }
int choose(void *m, int on, size_t n, const char *const *names)
{
    return SetDebugLogging(m, on, n, n ? (const fmi2String *)names : NULL);
}

int put(void *m, Type type, const uint32_t *references, size_t n, const double *values)
{
    int whole[MOST];
    for (size_t i = 0; i < n && type != REAL; i++)
        whole[i] = type >= RATE ? (int)(type - RATE + 1) : (int)values[i];
    if (type >= RATE)
        return SetRealInputDerivatives(m, references, n, whole, values);
    if (type == REAL)
        return SetReal(m, references, n, values);
    return (type == BOOLEAN ? SetBoolean : SetInteger)(m, references, n, whole);
}

int take(void *m, Type type, const uint32_t *references, size_t n, double *values)
{
    int whole[MOST] = {0};
    if (type == REAL)
        return GetReal(m, references, n, values);
    int rc = (type == BOOLEAN ? GetBoolean : GetInteger)(m, references, n, whole);
    for (size_t i = 0; i < n; i++)
        values[i] = whole[i];
    return rc;
}

int state_get(void *m, void **state) { return GetFMUstate(m, state); }
int state_set(void *m, void *state) { return SetFMUstate(m, state); }
int state_free(void *m, void **state) { return FreeFMUstate(m, state); }
int state_size(void *m, void *state, size_t *size)
{
    return SerializedFMUstateSize(m, state, size);
}
int state_write(void *m, void *state, void *bytes, size_t size)
{
    return SerializeFMUstate(m, state, bytes, size);
}
int state_read(void *m, const void *bytes, size_t size, void **state)
{
    return DeSerializeFMUstate(m, bytes, size, state);
}

int derive(void *m, int adjoint, const uint32_t *unknowns, size_t n_unknowns,
           const uint32_t *knowns, size_t n_knowns, const double *seed, double *found)
{
    if (adjoint)
        return 9;
    return GetDirectionalDerivative(m, unknowns, n_unknowns, knowns, n_knowns, seed, found);
}

/* Functions that take an array or a pointer, without it: how many did not say Error. */
static int no_arrays(void *m, double *n)
{
    const fmi2ValueReference vr[3] = {1, 2, 3};
    const int whole[3] = {1, 1, 1};
    double x[3] = {0};
    int rcs[] = {
        SetReal(m, NULL, 3, x), SetReal(m, vr, 3, NULL), GetReal(m, NULL, 3, x),
        GetReal(m, vr, 3, NULL), GetFMUstate(m, NULL), SetFMUstate(m, NULL),
        SerializedFMUstateSize(m, NULL, NULL), SerializeFMUstate(m, NULL, NULL, 9),
        DeSerializeFMUstate(m, NULL, 9, NULL), GetDirectionalDerivative(m, vr, 3, NULL, 1, x, x),
        SetDebugLogging(m, 1, 2, NULL), SetInteger(m, NULL, 1, NULL), GetBoolean(m, vr, 1, NULL),
        SetRealInputDerivatives(m, NULL, 1, whole, x),
        SetRealInputDerivatives(m, vr, 1, NULL, x),
        SetRealInputDerivatives(m, vr, 1, whole, NULL),
    };
    int others = 0;
    for (*n = 0; *n < sizeof rcs / sizeof *rcs; *n += 1)
        others += rcs[(int)*n] != 3;
    return others;
}

int extra(void *m, const char *what, const uint32_t *references, size_t n, double *values,
          size_t *n_values)
{
    (void)references, (void)n;
    *n_values = 1;
    if (strcmp(what, "no-arrays") == 0)
        return no_arrays(m, values);
    if (strcmp(what, "last-time") == 0)
        return GetRealStatus(m, fmi2LastSuccessfulTime, values);
    if (strcmp(what, "step-status") == 0) {
        fmi2Status status = fmi2Fatal;
        int rc = GetStatus(m, fmi2DoStepStatus, &status);
        *values = status;
        return rc;
    }
    if (strcmp(what, "terminated") == 0) {
        int terminated = 7;
        int rc = GetBooleanStatus(m, fmi2Terminated, &terminated);
        *values = terminated;
        return rc;
    }
    if (strcmp(what, "version") == 0)
        return strcmp(GetVersion(), "2.0") || strcmp(GetTypesPlatform(), "default");
    return 9;
}

/* With zeros for all other arguments: only whether the call is allowed is of interest. */
int call_by_name(void *library, const char *name, void *m)
{
    typedef int Function(void *, void *, size_t, void *, void *, void *, void *);
    if (strcmp(name, "fmi2DoStep") == 0)
        return DoStep(m, 0.0, 1e-3, fmi2True);
    if (strcmp(name, "fmi2SetupExperiment") == 0)
        return SetupExperiment(m, 0, 0.0, 0.0, 0, 0.0);
    Function *function = (Function *)dlsym(library, name);
    return function ? function(m, NULL, 0, NULL, NULL, NULL, NULL) : 8;
}
