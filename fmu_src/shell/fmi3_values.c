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

/* Which inputs act on an output at the same time point, as bits; BAD if it is no output. */
static int dependencies(Instance *m, fmi3ValueReference reference, uint32_t *bits) {
    const Variable *v = find(m, reference);
    if (!v) return BAD;
    if (v->cause != CAUSE_OUTPUT) return fail(m, "%s is no output: it depends on nothing", v->name);
    *bits = v->depends;
    return GOOD;
}

static size_t count(uint32_t bits) {
    size_t n = 0;
    for (; bits; bits >>= 1) n += bits & 1u;
    return n;
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference,
                                               size_t *nDependencies) {
    uint32_t bits = 0;
    ENTER(fmi3GetNumberOfVariableDependencies);
    NEED(fmi3GetNumberOfVariableDependencies, nDependencies, 1);
    if (dependencies(m, valueReference, &bits)) return fmi3Error;
    *nDependencies = count(bits);
    return fmi3OK;
}

/* Elements of scalars are number 1; inputs follow each other in the list of variables. */
fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[], fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[],
                                       fmi3DependencyKind dependencyKinds[], size_t nDependencies) {
    uint32_t bits = 0;
    size_t n = 0;
    ENTER(fmi3GetVariableDependencies);
    if (dependencies(m, dependent, &bits)) return fmi3Error;
    if (nDependencies != count(bits)) {
        return (fmi3Status)fail(m, "%s has %lu dependencies, asked for: %lu", VARIABLES[dependent].name,
                                (unsigned long)count(bits), (unsigned long)nDependencies);
    }
    NEED(fmi3GetVariableDependencies, elementIndicesOfDependent, nDependencies);
    NEED(fmi3GetVariableDependencies, independents, nDependencies);
    NEED(fmi3GetVariableDependencies, elementIndicesOfIndependents, nDependencies);
    NEED(fmi3GetVariableDependencies, dependencyKinds, nDependencies);
    for (uint32_t i = 0; i < N_VARIABLES; i++) {
        const Variable *v = &VARIABLES[i];
        if (v->cause != CAUSE_INPUT || !(bits >> v->slot & 1u)) continue;
        elementIndicesOfDependent[n] = elementIndicesOfIndependents[n] = 1;
        independents[n] = i;
        dependencyKinds[n++] = fmi3Dependent;
    }
    return fmi3OK;
}
