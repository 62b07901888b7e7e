/* Two inertias with a clutch between them: the plant that a pack's FMU is coupled with.
 *
 * Compiled with FMI_VERSION 2 or 3 as a co-simulation FMU. The clutch's torque is held over a step,
 * so the speeds at its end are exact. No output depends on the input at a communication point.
 */
#include <stdlib.h>
#include <string.h>

enum {
    TIME, TORQUE, SLIP, LOAD, ENGINE_SPEED, OUTPUT_SPEED,
    ENGINE_INERTIA, OUTPUT_INERTIA, ENGINE_TORQUE, LOAD_TORQUE,
    LOAD_START, LOAD_END, RAMP_TIME, ENGINE_START, OUTPUT_START, VARIABLES
};

static const double STARTS[VARIABLES] = {
    [ENGINE_INERTIA] = 0.15, [OUTPUT_INERTIA] = 1.0, [ENGINE_TORQUE] = 100.0, [LOAD_TORQUE] = 20.0,
    [LOAD_START] = 200.0, [LOAD_END] = 6000.0, [RAMP_TIME] = 0.3, [ENGINE_START] = 200.0,
};

typedef struct {
    double value[VARIABLES];
    int starting; /* the speeds are still those that the parameters give */
} Plant;

static void settle(Plant *p) {
    double *v = p->value;
    if (p->starting) {
        v[ENGINE_SPEED] = v[ENGINE_START];
        v[OUTPUT_SPEED] = v[OUTPUT_START];
    }
    double share = v[TIME] < v[RAMP_TIME] ? v[TIME] / v[RAMP_TIME] : 1.0;
    v[LOAD] = v[LOAD_START] + share * (v[LOAD_END] - v[LOAD_START]);
    v[SLIP] = v[ENGINE_SPEED] - v[OUTPUT_SPEED];
}

static void reset(Plant *p) {
    memcpy(p->value, STARTS, sizeof STARTS);
    p->starting = 1;
    settle(p);
}

static Plant *made(void) {
    Plant *p = malloc(sizeof *p);
    if (p) reset(p);
    return p;
}

static void advance(Plant *p, double start, double step) {
    double *v = p->value;
    v[ENGINE_SPEED] += step * (v[ENGINE_TORQUE] - v[TORQUE]) / v[ENGINE_INERTIA];
    v[OUTPUT_SPEED] += step * (v[TORQUE] - v[LOAD_TORQUE]) / v[OUTPUT_INERTIA];
    v[TIME] = start + step;
    settle(p);
}

/* Return 0 if all references are of variables; outputs are not to be set. */
static int get(Plant *p, const unsigned *r, size_t n, double *values) {
    for (size_t k = 0; k < n; k++) {
        if (r[k] >= VARIABLES) return 1;
        values[k] = p->value[r[k]];
    }
    return 0;
}

static int put(Plant *p, const unsigned *r, size_t n, const double *values) {
    for (size_t k = 0; k < n; k++) {
        if (r[k] >= VARIABLES || (r[k] != TORQUE && r[k] < ENGINE_INERTIA)) return 1;
        p->value[r[k]] = values[k];
    }
    settle(p);
    return 0;
}

static int keep(Plant *p, void **state) {
    if (!*state) *state = malloc(sizeof *p);
    if (!*state) return 1;
    memcpy(*state, p, sizeof *p);
    return 0;
}

static int take(void **state, const void *bytes, size_t size) {
    if (size != sizeof(Plant)) return 1;
    return keep((Plant *)bytes, state);
}

#if FMI_VERSION == 2

#include "fmi2Functions.h"

#define STATUS(wrong) ((wrong) ? fmi2Error : fmi2OK)
typedef fmi2Component C;
typedef fmi2Status S;
typedef const fmi2ValueReference *R;

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }
S fmi2SetDebugLogging(C c, fmi2Boolean on, size_t n, const fmi2String *names) { return fmi2OK; }

C fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                  const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean log) {
    return type == fmi2CoSimulation ? made() : NULL;
}

void fmi2FreeInstance(C c) { free(c); }

S fmi2SetupExperiment(C c, fmi2Boolean tolerant, fmi2Real tolerance, fmi2Real start,
                      fmi2Boolean stops, fmi2Real stop) {
    ((Plant *)c)->value[TIME] = start;
    settle(c);
    return fmi2OK;
}

S fmi2EnterInitializationMode(C c) { return fmi2OK; }
S fmi2ExitInitializationMode(C c) { ((Plant *)c)->starting = 0; return fmi2OK; }
S fmi2Terminate(C c) { return fmi2OK; }
S fmi2Reset(C c) { reset(c); return fmi2OK; }

S fmi2GetReal(C c, R r, size_t n, fmi2Real *v) { return STATUS(get(c, r, n, v)); }
S fmi2SetReal(C c, R r, size_t n, const fmi2Real *v) { return STATUS(put(c, r, n, v)); }

/* There are no variables of the other types. */
S fmi2GetInteger(C c, R r, size_t n, fmi2Integer *v) { return STATUS(n); }
S fmi2SetInteger(C c, R r, size_t n, const fmi2Integer *v) { return STATUS(n); }
S fmi2GetBoolean(C c, R r, size_t n, fmi2Boolean *v) { return STATUS(n); }
S fmi2SetBoolean(C c, R r, size_t n, const fmi2Boolean *v) { return STATUS(n); }
S fmi2GetString(C c, R r, size_t n, fmi2String *v) { return STATUS(n); }
S fmi2SetString(C c, R r, size_t n, const fmi2String *v) { return STATUS(n); }

S fmi2GetFMUstate(C c, fmi2FMUstate *state) { return STATUS(keep(c, state)); }
S fmi2SetFMUstate(C c, fmi2FMUstate state) { memcpy(c, state, sizeof(Plant)); return fmi2OK; }
S fmi2FreeFMUstate(C c, fmi2FMUstate *state) { free(*state); *state = NULL; return fmi2OK; }

S fmi2SerializedFMUstateSize(C c, fmi2FMUstate state, size_t *size) {
    *size = sizeof(Plant);
    return fmi2OK;
}

S fmi2SerializeFMUstate(C c, fmi2FMUstate state, fmi2Byte *bytes, size_t size) {
    if (size < sizeof(Plant)) return fmi2Error;
    memcpy(bytes, state, sizeof(Plant));
    return fmi2OK;
}

S fmi2DeSerializeFMUstate(C c, const fmi2Byte *bytes, size_t size, fmi2FMUstate *state) {
    return STATUS(take(state, bytes, size));
}

S fmi2GetDirectionalDerivative(C c, R unknown, size_t unknowns, R known, size_t knowns,
                               const fmi2Real *seed, fmi2Real *slope) {
    for (size_t k = 0; k < unknowns; k++) slope[k] = 0.0;
    return fmi2OK;
}

S fmi2SetRealInputDerivatives(C c, R r, size_t n, const fmi2Integer *order, const fmi2Real *v) {
    return STATUS(n);
}

S fmi2GetRealOutputDerivatives(C c, R r, size_t n, const fmi2Integer *order, fmi2Real *v) {
    return STATUS(n);
}

S fmi2DoStep(C c, fmi2Real start, fmi2Real step, fmi2Boolean no_state_set) {
    advance(c, start, step);
    return fmi2OK;
}

S fmi2CancelStep(C c) { return fmi2Error; }
S fmi2GetStatus(C c, const fmi2StatusKind kind, fmi2Status *v) { return fmi2Discard; }
S fmi2GetRealStatus(C c, const fmi2StatusKind kind, fmi2Real *v) {
    *v = ((Plant *)c)->value[TIME];
    return STATUS(kind != fmi2LastSuccessfulTime);
}
S fmi2GetIntegerStatus(C c, const fmi2StatusKind kind, fmi2Integer *v) { return fmi2Discard; }
S fmi2GetBooleanStatus(C c, const fmi2StatusKind kind, fmi2Boolean *v) { return fmi2Discard; }
S fmi2GetStringStatus(C c, const fmi2StatusKind kind, fmi2String *v) { return fmi2Discard; }

/* Model exchange, which some hosts ask for when they load. */
S fmi2EnterEventMode(C c) { return fmi2Error; }
S fmi2NewDiscreteStates(C c, fmi2EventInfo *info) { return fmi2Error; }
S fmi2EnterContinuousTimeMode(C c) { return fmi2Error; }
S fmi2CompletedIntegratorStep(C c, fmi2Boolean no_state_set, fmi2Boolean *event, fmi2Boolean *end) {
    return fmi2Error;
}
S fmi2SetTime(C c, fmi2Real time) { return fmi2Error; }
S fmi2SetContinuousStates(C c, const fmi2Real *x, size_t n) { return fmi2Error; }
S fmi2GetDerivatives(C c, fmi2Real *x, size_t n) { return fmi2Error; }
S fmi2GetEventIndicators(C c, fmi2Real *x, size_t n) { return fmi2Error; }
S fmi2GetContinuousStates(C c, fmi2Real *x, size_t n) { return fmi2Error; }
S fmi2GetNominalsOfContinuousStates(C c, fmi2Real *x, size_t n) { return fmi2Error; }

#else

#include "fmi3Functions.h"

#define STATUS(wrong) ((wrong) ? fmi3Error : fmi3OK)
typedef fmi3Instance C;
typedef fmi3Status S;
typedef fmi3Boolean B;
typedef fmi3Float64 F;
typedef const fmi3ValueReference *R;

const char *fmi3GetVersion(void) { return fmi3Version; }
S fmi3SetDebugLogging(C c, B on, size_t n, const fmi3String *names) { return fmi3OK; }

C fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, B visible,
                              B log, B events, B early, R required, size_t n,
                              fmi3InstanceEnvironment host, fmi3LogMessageCallback logger,
                              fmi3IntermediateUpdateCallback update) {
    return made();
}

C fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, B visible,
                               B log, fmi3InstanceEnvironment host, fmi3LogMessageCallback logger) {
    return NULL;
}

C fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                    B visible, B log, fmi3InstanceEnvironment host,
                                    fmi3LogMessageCallback logger, fmi3ClockUpdateCallback update,
                                    fmi3LockPreemptionCallback lock,
                                    fmi3UnlockPreemptionCallback unlock) {
    return NULL;
}

void fmi3FreeInstance(C c) { free(c); }

S fmi3EnterInitializationMode(C c, B tolerant, F tolerance, F start, B stops, F stop) {
    ((Plant *)c)->value[TIME] = start;
    settle(c);
    return fmi3OK;
}

S fmi3ExitInitializationMode(C c) { ((Plant *)c)->starting = 0; return fmi3OK; }
S fmi3Terminate(C c) { return fmi3OK; }
S fmi3Reset(C c) { reset(c); return fmi3OK; }

S fmi3GetFloat64(C c, R r, size_t n, F *v, size_t m) { return STATUS(get(c, r, n, v)); }
S fmi3SetFloat64(C c, R r, size_t n, const F *v, size_t m) { return STATUS(put(c, r, n, v)); }

/* There are no variables of the other types. */
#define NONE_OF(name, type)                                                                   \
    S fmi3Get##name(C c, R r, size_t n, type *v, size_t m) { return STATUS(n); }              \
    S fmi3Set##name(C c, R r, size_t n, const type *v, size_t m) { return STATUS(n); }
NONE_OF(Float32, fmi3Float32)
NONE_OF(Int8, fmi3Int8)
NONE_OF(UInt8, fmi3UInt8)
NONE_OF(Int16, fmi3Int16)
NONE_OF(UInt16, fmi3UInt16)
NONE_OF(Int32, fmi3Int32)
NONE_OF(UInt32, fmi3UInt32)
NONE_OF(Int64, fmi3Int64)
NONE_OF(UInt64, fmi3UInt64)
NONE_OF(Boolean, fmi3Boolean)
NONE_OF(String, fmi3String)
S fmi3GetBinary(C c, R r, size_t n, size_t *sizes, fmi3Binary *v, size_t m) { return STATUS(n); }
S fmi3SetBinary(C c, R r, size_t n, const size_t *sizes, const fmi3Binary *v, size_t m) {
    return STATUS(n);
}
S fmi3GetClock(C c, R r, size_t n, fmi3Clock *v) { return STATUS(n); }
S fmi3SetClock(C c, R r, size_t n, const fmi3Clock *v) { return STATUS(n); }

S fmi3GetNumberOfVariableDependencies(C c, fmi3ValueReference r, size_t *n) { return fmi3Error; }
S fmi3GetVariableDependencies(C c, fmi3ValueReference r, size_t *of, fmi3ValueReference *on,
                              size_t *elements, fmi3DependencyKind *kinds, size_t n) {
    return fmi3Error;
}

S fmi3GetFMUState(C c, fmi3FMUState *state) { return STATUS(keep(c, state)); }
S fmi3SetFMUState(C c, fmi3FMUState state) { memcpy(c, state, sizeof(Plant)); return fmi3OK; }
S fmi3FreeFMUState(C c, fmi3FMUState *state) { free(*state); *state = NULL; return fmi3OK; }

S fmi3SerializedFMUStateSize(C c, fmi3FMUState state, size_t *size) {
    *size = sizeof(Plant);
    return fmi3OK;
}

S fmi3SerializeFMUState(C c, fmi3FMUState state, fmi3Byte *bytes, size_t size) {
    if (size < sizeof(Plant)) return fmi3Error;
    memcpy(bytes, state, sizeof(Plant));
    return fmi3OK;
}

S fmi3DeserializeFMUState(C c, const fmi3Byte *bytes, size_t size, fmi3FMUState *state) {
    return STATUS(take(state, bytes, size));
}

S fmi3GetDirectionalDerivative(C c, R unknown, size_t unknowns, R known, size_t knowns,
                               const F *seed, size_t seeds, F *slope, size_t slopes) {
    for (size_t k = 0; k < slopes; k++) slope[k] = 0.0;
    return fmi3OK;
}

S fmi3GetAdjointDerivative(C c, R unknown, size_t unknowns, R known, size_t knowns, const F *seed,
                           size_t seeds, F *slope, size_t slopes) {
    return fmi3Error;
}

S fmi3GetOutputDerivatives(C c, R r, size_t n, const fmi3Int32 *orders, F *v, size_t m) {
    return STATUS(n);
}

S fmi3DoStep(C c, F start, F step, B no_state_set, B *event, B *end, B *early, F *reached) {
    advance(c, start, step);
    *event = *end = *early = fmi3False;
    *reached = start + step;
    return fmi3OK;
}

/* Nothing below belongs to a part of the standard that this FMU takes part in. */
S fmi3EnterConfigurationMode(C c) { return fmi3Error; }
S fmi3ExitConfigurationMode(C c) { return fmi3Error; }
S fmi3EnterEventMode(C c) { return fmi3Error; }
S fmi3EnterStepMode(C c) { return fmi3Error; }
S fmi3EvaluateDiscreteStates(C c) { return fmi3Error; }
S fmi3UpdateDiscreteStates(C c, B *again, B *end, B *nominals, B *values, B *timed, F *next) {
    return fmi3Error;
}
S fmi3GetIntervalDecimal(C c, R r, size_t n, F *v, fmi3IntervalQualifier *q) { return fmi3Error; }
S fmi3GetIntervalFraction(C c, R r, size_t n, fmi3UInt64 *v, fmi3UInt64 *w,
                          fmi3IntervalQualifier *q) {
    return fmi3Error;
}
S fmi3GetShiftDecimal(C c, R r, size_t n, F *v) { return fmi3Error; }
S fmi3GetShiftFraction(C c, R r, size_t n, fmi3UInt64 *v, fmi3UInt64 *w) { return fmi3Error; }
S fmi3SetIntervalDecimal(C c, R r, size_t n, const F *v) { return fmi3Error; }
S fmi3SetIntervalFraction(C c, R r, size_t n, const fmi3UInt64 *v, const fmi3UInt64 *w) {
    return fmi3Error;
}
S fmi3SetShiftDecimal(C c, R r, size_t n, const F *v) { return fmi3Error; }
S fmi3SetShiftFraction(C c, R r, size_t n, const fmi3UInt64 *v, const fmi3UInt64 *w) {
    return fmi3Error;
}
S fmi3EnterContinuousTimeMode(C c) { return fmi3Error; }
S fmi3CompletedIntegratorStep(C c, B no_state_set, B *event, B *end) { return fmi3Error; }
S fmi3SetTime(C c, F time) { return fmi3Error; }
S fmi3SetContinuousStates(C c, const F *x, size_t n) { return fmi3Error; }
S fmi3GetContinuousStateDerivatives(C c, F *x, size_t n) { return fmi3Error; }
S fmi3GetEventIndicators(C c, F *x, size_t n) { return fmi3Error; }
S fmi3GetContinuousStates(C c, F *x, size_t n) { return fmi3Error; }
S fmi3GetNominalsOfContinuousStates(C c, F *x, size_t n) { return fmi3Error; }
S fmi3GetNumberOfEventIndicators(C c, size_t *n) { *n = 0; return fmi3OK; }
S fmi3GetNumberOfContinuousStates(C c, size_t *n) { *n = 0; return fmi3OK; }
S fmi3ActivateModelPartition(C c, fmi3ValueReference clock, F time) { return fmi3Error; }

#endif
