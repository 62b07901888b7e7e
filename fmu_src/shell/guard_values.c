/* The functions of FMI 2.0 that read and write: values, states, how the last step ended. */
#include "guard.h"

#include <math.h>

/* Values. Python checks types, ranges and that all or none are taken over, from the same list the
   tables here are made of; what it finds, it logs. */

static int known(Guard *g, const fmi2ValueReference vr[], size_t n) {
    for (size_t i = 0; i < n; i++) {
        if (vr[i] < N_VARIABLES) continue;
        guard_say(g, fmi2Error, LOG_ERROR, "value reference %u is unknown in %s", vr[i],
                  MODEL_NAME);
        return 0;
    }
    return 1;
}

static int readable(Guard *g, const fmi2ValueReference vr[], size_t n) {
    for (size_t i = 0; i < n; i++) {
        const Variable *v = &VARIABLES[vr[i]];
        if (ACCESS[v->cause].get & g->mode) continue;
        guard_say(g, fmi2Error, LOG_ERROR, "%s has no value in state %s; call %s first", v->name,
                  MODES[0].name, MODES[0].leave);
        return 0;
    }
    return 1;
}

#define GET(Type) \
    fmi2Status fmi2Get##Type(fmi2Component c, const fmi2ValueReference vr[], size_t n, \
                             fmi2##Type value[]) { \
        ENTER_PYTHON(Get##Type); \
        NEED(n == 0 || (vr && value), Get##Type, "an array is NULL"); \
        if (n == 0) return fmi2OK; \
        if (!known(g, vr, n) || !readable(g, vr, n)) return fmi2Error; \
        fmi2Status status = guard_inner.Get##Type(g->inner, vr, n, value); \
        for (size_t i = 0; status == fmi2OK && i < n; i++) \
            NEED(isfinite((double)value[i]), Get##Type, "a value is not finite"); \
        return guard_leave(g, status, CALL_fmi2Get##Type); \
    }
GET(Real)
GET(Integer)
GET(Boolean)

#define SET(Type) \
    fmi2Status fmi2Set##Type(fmi2Component c, const fmi2ValueReference vr[], size_t n, \
                             const fmi2##Type value[]) { \
        ENTER_PYTHON(Set##Type); \
        NEED(n == 0 || (vr && value), Set##Type, "an array is NULL"); \
        if (n == 0) return fmi2OK; \
        if (!known(g, vr, n)) return fmi2Error; \
        return guard_leave(g, guard_inner.Set##Type(g->inner, vr, n, value), \
                           CALL_fmi2Set##Type); \
    }
SET(Real)
SET(Integer)
SET(Boolean)

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         fmi2String value[]) {
    (void)vr, (void)value;
    ENTER(GetString);
    NEED(n == 0, GetString, "there are no variables of type String");
    return fmi2OK;
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         const fmi2String value[]) {
    (void)vr, (void)value;
    ENTER(SetString);
    NEED(n == 0, SetString, "there are no variables of type String");
    return fmi2OK;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    (void)vr, (void)n, (void)order, (void)value;
    ENTER(SetRealInputDerivatives);
    return fmi2Error;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[]) {
    (void)vr, (void)n, (void)order, (void)value;
    ENTER(GetRealOutputDerivatives);
    return fmi2Error;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[],
                                        size_t n_unknown, const fmi2ValueReference known[],
                                        size_t n_known, const fmi2Real seed[],
                                        fmi2Real sensitivity[]) {
    (void)unknown, (void)n_unknown, (void)known, (void)n_known, (void)seed, (void)sensitivity;
    ENTER(GetDirectionalDerivative);
    NEED(0, GetDirectionalDerivative, "the Python target has no directional derivatives "
         "(providesDirectionalDerivative is false); the native target has");
    return fmi2Error;
}

/* States */

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    ENTER_PYTHON(GetFMUstate);
    NEED(state, GetFMUstate, "the place for the state is NULL");
    State *old = guard_find_state(g, *state);
    NEED(old || !*state, GetFMUstate, "the place holds neither NULL nor a state of this instance");
    State *made = guard_new_state(g);
    NEED(made, GetFMUstate, "out of memory");
    made->mode = g->mode;
    made->time = g->time;
    fmi2Status status = guard_leave(g, guard_inner.GetFMUstate(g->inner, &made->inner),
                                    CALL_fmi2GetFMUstate);
    if (status != fmi2OK) {
        guard_free_state(g, made);
        return status;
    }
    if (old) guard_free_state(g, old);
    *state = made;
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    ENTER_PYTHON(SetFMUstate);
    State *known = guard_find_state(g, state);
    NEED(known, SetFMUstate, "this is no FMU state of this instance, or a freed one");
    fmi2Status status = guard_leave(g, guard_inner.SetFMUstate(g->inner, known->inner),
                                    CALL_fmi2SetFMUstate);
    if (status == fmi2OK) {
        g->mode = known->mode;
        g->time = known->time;
    }
    return status;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    ENTER_PYTHON(FreeFMUstate);
    if (!state || !*state) return fmi2OK;
    State *known = guard_find_state(g, *state);
    NEED(known, FreeFMUstate, "this is no FMU state of this instance, or a freed one");
    guard_free_state(g, known);
    *state = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
    ENTER_PYTHON(SerializedFMUstateSize);
    State *known = guard_find_state(g, state);
    NEED(known, SerializedFMUstateSize, "this is no FMU state of this instance, or a freed one");
    NEED(size, SerializedFMUstateSize, "the place for the size is NULL");
    fmi2Status status = guard_inner.SerializedFMUstateSize(g->inner, known->inner, size);
    *size += guard_header_size();
    return guard_leave(g, status, CALL_fmi2SerializedFMUstateSize);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                 size_t size) {
    size_t needed = 0, head = guard_header_size();
    fmi2Status status = fmi2SerializedFMUstateSize(c, state, &needed);
    if (status != fmi2OK) return status;
    ENTER_PYTHON(SerializeFMUstate);
    NEED(bytes && size >= needed, SerializeFMUstate,
         "the array is NULL or shorter than fmi2SerializedFMUstateSize says");
    State *known = guard_find_state(g, state);
    status = guard_inner.SerializeFMUstate(g->inner, known->inner, bytes + head, needed - head);
    guard_write_header(known, bytes, needed);
    return guard_leave(g, status, CALL_fmi2SerializeFMUstate);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state) {
    size_t head = guard_header_size();
    ENTER_PYTHON(DeSerializeFMUstate);
    NEED(bytes && state, DeSerializeFMUstate, "an array or the place for the state is NULL");
    State read, *old = guard_find_state(g, *state);
    NEED(old || !*state, DeSerializeFMUstate,
         "the place holds neither NULL nor a state of this instance");
    const char *damage = guard_read_header(&read, bytes, size);
    if (damage) {
        guard_say(g, fmi2Error, LOG_ERROR, "FMU state = %zu bytes that cannot be used: %s", size,
                  damage);
        return fmi2Error;
    }
    State *made = guard_new_state(g);
    NEED(made, DeSerializeFMUstate, "out of memory");
    made->mode = read.mode;
    made->time = read.time;
    fmi2Status status = guard_leave(g, guard_inner.DeSerializeFMUstate(g->inner, bytes + head,
                                    size - head, &made->inner), CALL_fmi2DeSerializeFMUstate);
    if (status == fmi2OK && old) guard_free_state(g, old);
    if (status == fmi2OK) *state = made;
    else guard_free_state(g, made);
    return status;
}

/* How the last step ended: never pending, never "terminated". */

fmi2Status fmi2CancelStep(fmi2Component c) {
    ENTER(CancelStep);
    return fmi2Error;
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
    ENTER(GetStatus);
    NEED(value && kind == fmi2DoStepStatus, GetStatus,
         "there is only fmi2DoStepStatus, and a place for it is needed");
    *value = g->last_step;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
    ENTER(GetRealStatus);
    NEED(value && kind == fmi2LastSuccessfulTime, GetRealStatus,
         "there is only fmi2LastSuccessfulTime, and a place for it is needed");
    *value = g->time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
    (void)kind, (void)value;
    ENTER(GetIntegerStatus);
    NEED(0, GetIntegerStatus, "there is no such status");
    return fmi2Error;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
    ENTER(GetBooleanStatus);
    NEED(value && kind == fmi2Terminated, GetBooleanStatus,
         "there is only fmi2Terminated, and a place for it is needed");
    *value = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
    ENTER(GetStringStatus);
    NEED(value && kind == fmi2PendingStatus, GetStringStatus,
         "there is only fmi2PendingStatus, and a place for it is needed");
    *value = "no step is pending";
    return fmi2OK;
}
