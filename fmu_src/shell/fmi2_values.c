/* FMI 2.0 co-simulation: values, states and derivatives, translated. */
#include "fmi2_shell.h"

static const Kind REAL = {"Real", TYPE_BIT(TYPE_REAL), FORM_DOUBLE};
/* What a plain description calls Integer: choices and Booleans too. */
static const Kind INTEGER = {
    "Integer", TYPE_BIT(TYPE_INTEGER) | TYPE_BIT(TYPE_ENUMERATION) | TYPE_BIT(TYPE_BOOLEAN), FORM_INT32};
static const Kind BOOLEAN = {"Boolean", TYPE_BIT(TYPE_BOOLEAN), FORM_INT32};
static const Kind STRING = {"String", 0, FORM_NONE};

#define VALUES(Name, type, kind)                                                                         \
    fmi2Status fmi2Get##Name(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, type value[]) { \
        ENTER(fmi2Get##Name);                                                                            \
        return (fmi2Status)get_values(m, CALL_fmi2Get##Name, vr, nvr, &kind, value);                     \
    }                                                                                                    \
    fmi2Status fmi2Set##Name(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,                 \
                             const type value[]) {                                                       \
        ENTER(fmi2Set##Name);                                                                            \
        return (fmi2Status)set_values(m, CALL_fmi2Set##Name, vr, nvr, &kind, value);                     \
    }

VALUES(Real, fmi2Real, REAL)
VALUES(Integer, fmi2Integer, INTEGER)
VALUES(Boolean, fmi2Boolean, BOOLEAN)
VALUES(String, fmi2String, STRING)

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    ENTER(fmi2GetFMUstate);
    NEED(fmi2GetFMUstate, FMUstate, 1);
    return (fmi2Status)get_state(m, FMUstate);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
    ENTER(fmi2SetFMUstate);
    return (fmi2Status)set_state(m, FMUstate);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    ENTER(fmi2FreeFMUstate);
    return FMUstate ? (fmi2Status)free_state(m, FMUstate) : fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size) {
    ENTER(fmi2SerializedFMUstateSize);
    NEED(fmi2SerializedFMUstateSize, size, 1);
    return (fmi2Status)state_size(m, FMUstate, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[],
                                 size_t size) {
    ENTER(fmi2SerializeFMUstate);
    NEED(fmi2SerializeFMUstate, serializedState, size);
    return (fmi2Status)write_state(m, FMUstate, (unsigned char *)serializedState, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate) {
    ENTER(fmi2DeSerializeFMUstate);
    NEED(fmi2DeSerializeFMUstate, serializedState, size);
    NEED(fmi2DeSerializeFMUstate, FMUstate, 1);
    return (fmi2Status)read_state(m, (const unsigned char *)serializedState, size, FMUstate);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown, const fmi2ValueReference vKnown_ref[], size_t nKnown,
                                        const fmi2Real dvKnown[], fmi2Real dvUnknown[]) {
    ENTER(fmi2GetDirectionalDerivative);
    NEED(fmi2GetDirectionalDerivative, vUnknown_ref, nUnknown);
    NEED(fmi2GetDirectionalDerivative, dvUnknown, nUnknown);
    NEED(fmi2GetDirectionalDerivative, vKnown_ref, nKnown);
    NEED(fmi2GetDirectionalDerivative, dvKnown, nKnown);
    const Direction d = {vUnknown_ref, vKnown_ref, nUnknown, nKnown, dvKnown};
    return (fmi2Status)directional(m, &d, dvUnknown);
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    ENTER(fmi2SetRealInputDerivatives);
    return (fmi2Status)set_rates(m, CALL_fmi2SetRealInputDerivatives, vr, nvr, order, value);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
    (void)vr, (void)nvr, (void)order, (void)value;
    ENTER(fmi2GetRealOutputDerivatives);
    return fmi2Error;
}
