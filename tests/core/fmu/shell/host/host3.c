/* The commands of a script, on an FMU of FMI 3.0. */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "fmi3Functions.h"
#include "script.h"

#define EACH(DO)                                                                                   \
    DO(GetVersion) DO(InstantiateCoSimulation) DO(InstantiateModelExchange)                        \
    DO(InstantiateScheduledExecution) DO(FreeInstance) DO(EnterInitializationMode)                 \
    DO(ExitInitializationMode) DO(Terminate) DO(Reset) DO(DoStep) DO(SetDebugLogging)              \
    DO(GetFloat64) DO(GetInt32) DO(GetInt64) DO(GetBoolean) DO(SetFloat64) DO(SetInt32)            \
    DO(SetInt64) DO(SetBoolean) DO(GetFMUState) DO(SetFMUState) DO(FreeFMUState)                   \
    DO(SerializedFMUStateSize) DO(SerializeFMUState) DO(DeserializeFMUState)                       \
    DO(GetDirectionalDerivative) DO(GetAdjointDerivative) DO(GetNumberOfVariableDependencies)      \
    DO(GetVariableDependencies)
#define DECLARE(name) static fmi3##name##TYPE *name;
#define FIND(name) name = (fmi3##name##TYPE *)dlsym(library, "fmi3" #name);
EACH(DECLARE)

static int early, happened, wants_events, said_wrongly;
static void *stepping; /* the instance whose step calls back */
static double heard[4]; /* in the callback: calls, time, a value, statuses of what is refused */

/* What is set when the FMU asks for inputs within a step: once, then nothing. */
static struct {
    void *instance;
    size_t n;
    uint32_t references[MOST];
    double values[MOST], asked_for;
} later;
static double last_time;

void open_library(void *library) { EACH(FIND) }

static void logger(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                   fmi3String text)
{
    hear(environment, status, category, text);
}

/* Reads, and tries what is not allowed there. */
static void updated(fmi3InstanceEnvironment environment, fmi3Float64 time, fmi3Boolean set,
                    fmi3Boolean get, fmi3Boolean finished, fmi3Boolean can_return,
                    fmi3Boolean *wants, fmi3Float64 *at)
{
    const fmi3ValueReference energy[] = {14}, load[] = {1};
    const double more = 7.0;
    fmi3Boolean flag;
    double end;
    (void)environment;
    heard[0] += 1.0;
    heard[1] = get && finished && !set && !can_return ? time : -1.0;
    if (GetFloat64(stepping, energy, 1, &heard[2], 1))
        heard[2] = -1.0;
    heard[3] = SetFloat64(stepping, load, 1, &more, 1) == fmi3Error
               && DoStep(stepping, time, 1e-3, 1, &flag, &flag, &flag, &end) == fmi3Error
               && Reset(stepping) == fmi3Error;
    FreeInstance(stepping);
    *wants = 1;
    *at = time;
}

static void update(fmi3InstanceEnvironment environment, fmi3Float64 time, fmi3Boolean set,
                   fmi3Boolean get, fmi3Boolean finished, fmi3Boolean may_end,
                   fmi3Boolean *ends, fmi3Float64 *end_time)
{
    char text[80];
    said_wrongly += !set || get || finished || may_end || *ends || !environment || !end_time;
    later.asked_for = time;
    int rc = SetFloat64(later.instance, later.references, later.n, later.values, later.n);
    int others = GetFloat64(later.instance, later.references, 1, later.values, 1) != 3;
    others += Reset(later.instance) != 3;
    snprintf(text, sizeof text, "set within the step: %d, also done: %d", rc, others);
    hear(environment, rc, "host", text);
    later.n = 0;
}

void *make(const char *name, const char *guid, int logging, const char *oddity)
{
    static char title[64];
    fmi3LogMessageCallback log = oddity && oddity[0] == 'l' ? NULL : logger;
    const fmi3ValueReference wanted[] = {4}, inputs[] = {1, 2, 3}, read[] = {14};
    strncpy(title, name ? name : "NULL", sizeof title - 1);
    switch (oddity ? oddity[0] : 0) {
    case 'm': return InstantiateModelExchange(name, guid, NULL, 0, logging, title, log);
    case 's':
        return InstantiateScheduledExecution(name, guid, NULL, 0, logging, title, log, NULL, NULL,
                                             NULL);
    case 'e':
        wants_events = 1;
        return InstantiateCoSimulation(name, guid, resources, 0, logging, 1, 0, NULL, 0, title,
                                       log, NULL);
    case 'r':
        wants_events = 1;
        return InstantiateCoSimulation(name, guid, resources, 0, logging, 1, 1, NULL, 0, title,
                                       log, NULL);
    case 'a': /* to be read after steps */
        return InstantiateCoSimulation(name, guid, resources, 0, logging, 0, 1, read, 1, title, log,
                                       updated);
    case 'i': /* no input */
        return InstantiateCoSimulation(name, guid, resources, 0, logging, 0, 0, wanted, 1, title,
                                       log, update);
    case 'n':
        return InstantiateCoSimulation(name, guid, resources, 0, logging, 0, 0, inputs, 3, title,
                                       log, NULL);
    case 'x': /* events, and inputs that move */
        wants_events = 1;
        return later.instance = InstantiateCoSimulation(name, guid, resources, 0, logging, 1, 1,
                                                        inputs, 3, title, log, update);
    case 'u':
        return later.instance = InstantiateCoSimulation(name, guid, resources, 0, logging, 0, 0,
                                                        inputs, 3, title, log, update);
    default:
        return InstantiateCoSimulation(name, guid, resources, 0, logging, 0, 1, NULL, 0, title,
                                       log, NULL);
    }
}

void drop(void *m) { FreeInstance(m); }
int set_up(void *m, double start) { return m && start == start ? 0 : 3; }
int enter(void *m, double start) { return EnterInitializationMode(m, 1, 1e-6, start, 1, 9.0); }
int leave(void *m) { return ExitInitializationMode(m); }
int end(void *m) { return Terminate(m); }
int start_over(void *m) { return Reset(m); }
int choose(void *m, int on, size_t n, const char *const *names)
{
    return SetDebugLogging(m, on, n, n ? (const fmi3String *)names : NULL);
}

/* Whatever happens, all that is pointed to has to be written. */
int step(void *m, double t, double h)
{
    fmi3Boolean event = 1, over = 1, returned = 1;
    last_time = -777.0;
    stepping = m;
    int rc = DoStep(m, t, h, 1, &event, &over, &returned, &last_time);
    said_wrongly += ((event || returned) && !wants_events) || over || last_time == -777.0;
    early = returned;
    happened = event;
    return rc;
}

int put(void *m, Type type, const uint32_t *references, size_t n, const double *values)
{
    int64_t wide[MOST];
    int32_t whole[MOST];
    fmi3Boolean truth[MOST];
    if (type == RATE) {
        memcpy(later.references, references, n * sizeof *references);
        memcpy(later.values, values, n * sizeof *values);
        later.n = n;
        return 0;
    }
    for (size_t i = 0; i < n && type != REAL; i++) {
        wide[i] = (int64_t)values[i];
        whole[i] = (int32_t)values[i];
        truth[i] = values[i] != 0.0;
    }
    if (type == REAL)
        return SetFloat64(m, references, n, values, n);
    if (type == WHOLE)
        return SetInt32(m, references, n, whole, n);
    return type == ENUMERATION ? SetInt64(m, references, n, wide, n)
                               : SetBoolean(m, references, n, truth, n);
}

int take(void *m, Type type, const uint32_t *references, size_t n, double *values)
{
    int64_t wide[MOST] = {0};
    int32_t whole[MOST] = {0};
    fmi3Boolean truth[MOST] = {0};
    int rc = type == REAL          ? GetFloat64(m, references, n, values, n)
             : type == WHOLE       ? GetInt32(m, references, n, whole, n)
             : type == ENUMERATION ? GetInt64(m, references, n, wide, n)
                                   : GetBoolean(m, references, n, truth, n);
    for (size_t i = 0; i < n && type != REAL; i++)
        values[i] = type == WHOLE ? whole[i] : type == ENUMERATION ? (double)wide[i] : truth[i];
    return rc;
}

int state_get(void *m, void **state) { return GetFMUState(m, state); }
int state_set(void *m, void *state) { return SetFMUState(m, state); }
int state_free(void *m, void **state) { return FreeFMUState(m, state); }
int state_size(void *m, void *state, size_t *size)
{
    return SerializedFMUStateSize(m, state, size);
}
int state_write(void *m, void *state, void *bytes, size_t size)
{
    return SerializeFMUState(m, state, bytes, size);
}
int state_read(void *m, const void *bytes, size_t size, void **state)
{
    return DeserializeFMUState(m, bytes, size, state);
}

int derive(void *m, int adjoint, const uint32_t *unknowns, size_t n_unknowns,
           const uint32_t *knowns, size_t n_knowns, const double *seed, double *found)
{
    return adjoint ? GetAdjointDerivative(m, unknowns, n_unknowns, knowns, n_knowns, seed,
                                          n_unknowns, found, n_knowns)
                   : GetDirectionalDerivative(m, unknowns, n_unknowns, knowns, n_knowns, seed,
                                              n_knowns, found, n_unknowns);
}

static int no_arrays(void *m, double *n)
{
    const fmi3ValueReference vr[3] = {1, 2, 3};
    double x[3] = {0};
    int rcs[] = {
        SetFloat64(m, NULL, 3, x, 3), SetFloat64(m, vr, 3, NULL, 3), SetFloat64(m, vr, 3, x, 2),
        GetFloat64(m, NULL, 3, x, 3), GetFloat64(m, vr, 3, x, 4), GetFMUState(m, NULL),
        SetFMUState(m, NULL), SerializedFMUStateSize(m, NULL, NULL),
        SerializeFMUState(m, NULL, NULL, 9), DeserializeFMUState(m, NULL, 9, NULL),
        GetDirectionalDerivative(m, vr, 3, NULL, 1, x, 1, x, 3), SetDebugLogging(m, 1, 2, NULL),
        GetAdjointDerivative(m, NULL, 1, vr, 1, x, 1, x, 1),
        GetNumberOfVariableDependencies(m, 11, NULL),
        GetVariableDependencies(m, 11, NULL, NULL, NULL, NULL, 2),
    };
    int others = 0;
    for (*n = 0; *n < sizeof rcs / sizeof *rcs; *n += 1)
        others += rcs[(int)*n] != 3;
    return others;
}

int extra(void *m, const char *what, const uint32_t *references, size_t n, double *values,
          size_t *n_values)
{
    (void)n;
    *n_values = 1;
    if (strcmp(what, "no-arrays") == 0)
        return no_arrays(m, values);
    if (strcmp(what, "asked-for") == 0)
        values[0] = later.asked_for;
    else if (strcmp(what, "last-time") == 0)
        values[0] = last_time;
    else if (strcmp(what, "heard") == 0)
        memcpy(values, heard, (*n_values = 4) * sizeof *values);
    else if (strcmp(what, "ended") == 0) {
        values[0] = happened;
        values[1] = early;
        values[2] = last_time;
        *n_values = 3;
    } else if (strcmp(what, "pointers") == 0)
        values[0] = said_wrongly;
    else if (strcmp(what, "version") == 0)
        return strcmp(GetVersion(), "3.0");
    else { /* what an output depends on */
        size_t own[MOST], theirs[MOST];
        fmi3ValueReference inputs[MOST];
        fmi3DependencyKind kinds[MOST];
        if (GetNumberOfVariableDependencies(m, references[0], n_values))
            return 3;
        int rc = GetVariableDependencies(m, references[0], own, inputs, theirs, kinds, *n_values);
        for (size_t i = 0; i < *n_values; i++)
            values[i] = own[i] == 1 && theirs[i] == 1 && kinds[i] == fmi3Dependent
                            ? (double)inputs[i] : -1.0;
        return rc;
    }
    return 0;
}

/* With zeros for all other arguments: only whether the call is allowed is of interest. */
int call_by_name(void *library, const char *name, void *m)
{
    typedef int Function(void *, void *, size_t, void *, size_t, void *, size_t, void *, size_t);
    if (strcmp(name, "fmi3DoStep") == 0)
        return step(m, 0.0, 1e-3);
    if (strcmp(name, "fmi3EnterInitializationMode") == 0)
        return enter(m, 0.0);
    Function *function = (Function *)dlsym(library, name);
    return function ? function(m, NULL, 0, NULL, 0, NULL, 0, NULL, 0) : 8;
}
