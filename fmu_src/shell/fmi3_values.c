/* FMI 3.0 co-simulation: values, dependencies, states and derivatives, translated. */
#include "fmi3_shell.h"

#define VALUES(Name, types, form)                                                                  \
    static const Kind KIND_##Name = {#Name, types, form};                                          \
    fmi3Status fmi3Get##Name(fmi3Instance instance, const fmi3ValueReference valueReferences[],    \
                             size_t nValueReferences, fmi3##Name values[], size_t nValues) {       \
        ENTER(fmi3Get##Name);                                                                      \
        AS_MANY(fmi3Get##Name, nValueReferences, nValues);                                         \
        return (fmi3Status)get_values(m, CALL_fmi3Get##Name, valueReferences, nValueReferences,    \
                                      &KIND_##Name, values);                                       \
    }                                                                                              \
    fmi3Status fmi3Set##Name(fmi3Instance instance, const fmi3ValueReference valueReferences[],    \
                             size_t nValueReferences, const fmi3##Name values[], size_t nValues) { \
        ENTER(fmi3Set##Name);                                                                      \
        AS_MANY(fmi3Set##Name, nValueReferences, nValues);                                         \
        return (fmi3Status)set_values(m, CALL_fmi3Set##Name, valueReferences, nValueReferences,    \
                                      &KIND_##Name, values);                                       \
    }

VALUES(Float64, TYPE_BIT(TYPE_REAL), FORM_DOUBLE)
/* What a plain description calls Int32: choices and Booleans too. */
VALUES(Int32, TYPE_BIT(TYPE_INTEGER) | TYPE_BIT(TYPE_ENUMERATION) | TYPE_BIT(TYPE_BOOLEAN), FORM_INT32)
VALUES(Int64, TYPE_BIT(TYPE_ENUMERATION), FORM_INT64)
VALUES(Boolean, TYPE_BIT(TYPE_BOOLEAN), FORM_BYTE)
VALUES(Float32, 0, FORM_NONE)
VALUES(Int8, 0, FORM_NONE)
VALUES(UInt8, 0, FORM_NONE)
VALUES(Int16, 0, FORM_NONE)
VALUES(UInt16, 0, FORM_NONE)
VALUES(UInt32, 0, FORM_NONE)
VALUES(UInt64, 0, FORM_NONE)
VALUES(String, 0, FORM_NONE)

static const Kind BINARY = {"Binary", 0, FORM_NONE}, CLOCK = {"Clock", 0, FORM_NONE};

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, size_t valueSizes[], fmi3Binary values[], size_t nValues) {
    (void)valueSizes;
    ENTER(fmi3GetBinary);
    AS_MANY(fmi3GetBinary, nValueReferences, nValues);
    return (fmi3Status)get_values(m, CALL_fmi3GetBinary, valueReferences, nValueReferences, &BINARY, values);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, const size_t valueSizes[], const fmi3Binary values[],
                         size_t nValues) {
    (void)valueSizes;
    ENTER(fmi3SetBinary);
    AS_MANY(fmi3SetBinary, nValueReferences, nValues);
    return (fmi3Status)set_values(m, CALL_fmi3SetBinary, valueReferences, nValueReferences, &BINARY, values);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, fmi3Clock values[]) {
    ENTER(fmi3GetClock);
    return (fmi3Status)get_values(m, CALL_fmi3GetClock, valueReferences, nValueReferences, &CLOCK, values);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, const fmi3Clock values[]) {
    ENTER(fmi3SetClock);
    return (fmi3Status)set_values(m, CALL_fmi3SetClock, valueReferences, nValueReferences, &CLOCK, values);
}

/* Which inputs and states act on an output, derivative or event indicator at the same time point:
   how many, *found: the variable; BAD if it is none of these. */
static int dependencies(Instance *m, fmi3ValueReference reference, const Variable **found, size_t *n) {
    const Variable *v = *found = find(m, reference);
    if (!v) return BAD;
    if (v->cause != CAUSE_OUTPUT && v->store != STORE_DER && v->store != STORE_SIGN)
        return fail(m, "%s is no output: it depends on nothing", v->name);
    *n = 0;
    for (uint32_t bits = v->depends; bits; bits >>= 1) *n += bits & 1u;
    for (uint32_t bits = v->states; bits; bits >>= 1) *n += bits & 1u;
    return GOOD;
}

static int acts_on(const Variable *v, const Variable *known) {
    const int state = state_of(known);
    if (known->cause == CAUSE_INPUT) return v->depends >> known->slot & 1u;
    return state >= 0 && v->states >> state & 1u;
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference,
                                               size_t *nDependencies) {
    const Variable *v = NULL;
    ENTER(fmi3GetNumberOfVariableDependencies);
    NEED(fmi3GetNumberOfVariableDependencies, nDependencies, 1);
    return (fmi3Status)dependencies(m, valueReference, &v, nDependencies);
}

/* Elements of scalars are number 1; inputs follow each other in the list of variables. */
fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[], fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[],
                                       fmi3DependencyKind dependencyKinds[], size_t nDependencies) {
    const Variable *v = NULL;
    size_t n = 0;
    ENTER(fmi3GetVariableDependencies);
    if (dependencies(m, dependent, &v, &n)) return fmi3Error;
    if (nDependencies != n) {
        return (fmi3Status)fail(m, "%s has %lu dependencies, asked for: %lu", v->name, (unsigned long)n,
                                (unsigned long)nDependencies);
    }
    n = 0;
    NEED(fmi3GetVariableDependencies, elementIndicesOfDependent, nDependencies);
    NEED(fmi3GetVariableDependencies, independents, nDependencies);
    NEED(fmi3GetVariableDependencies, elementIndicesOfIndependents, nDependencies);
    NEED(fmi3GetVariableDependencies, dependencyKinds, nDependencies);
    for (uint32_t i = 0; i < N_VARIABLES; i++) {
        if (!acts_on(v, &VARIABLES[i])) continue;
        elementIndicesOfDependent[n] = elementIndicesOfIndependents[n] = 1;
        independents[n] = i;
        dependencyKinds[n++] = fmi3Dependent;
    }
    return fmi3OK;
}
