/* FMI 3.0 co-simulation: states, derivatives and inputs within a step, translated. */
#include "fmi3_shell.h"

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    ENTER(fmi3GetFMUState);
    NEED(fmi3GetFMUState, FMUState, 1);
    return (fmi3Status)get_state(m, FMUState);
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
    ENTER(fmi3SetFMUState);
    return (fmi3Status)set_state(m, FMUState);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    ENTER(fmi3FreeFMUState);
    return FMUState ? (fmi3Status)free_state(m, FMUState) : fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size) {
    ENTER(fmi3SerializedFMUStateSize);
    NEED(fmi3SerializedFMUStateSize, size, 1);
    return (fmi3Status)state_size(m, FMUState, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[],
                                 size_t size) {
    ENTER(fmi3SerializeFMUState);
    NEED(fmi3SerializeFMUState, serializedState, size);
    return (fmi3Status)write_state(m, FMUState, serializedState, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState *FMUState) {
    ENTER(fmi3DeserializeFMUState);
    NEED(fmi3DeserializeFMUState, serializedState, size);
    NEED(fmi3DeserializeFMUState, FMUState, 1);
    return (fmi3Status)read_state(m, serializedState, size, FMUState);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t nUnknowns, const fmi3ValueReference knowns[], size_t nKnowns,
                                        const fmi3Float64 seed[], size_t nSeed, fmi3Float64 sensitivity[],
                                        size_t nSensitivity) {
    ENTER(fmi3GetDirectionalDerivative);
    NEED(fmi3GetDirectionalDerivative, unknowns, nUnknowns);
    NEED(fmi3GetDirectionalDerivative, knowns, nKnowns);
    NEED(fmi3GetDirectionalDerivative, seed, nSeed);
    NEED(fmi3GetDirectionalDerivative, sensitivity, nSensitivity);
    AS_MANY(fmi3GetDirectionalDerivative, nKnowns, nSeed);
    AS_MANY(fmi3GetDirectionalDerivative, nUnknowns, nSensitivity);
    const Direction d = {unknowns, knowns, nUnknowns, nKnowns, seed};
    return (fmi3Status)directional(m, &d, sensitivity);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t nUnknowns, const fmi3ValueReference knowns[], size_t nKnowns,
                                    const fmi3Float64 seed[], size_t nSeed, fmi3Float64 sensitivity[],
                                    size_t nSensitivity) {
    ENTER(fmi3GetAdjointDerivative);
    NEED(fmi3GetAdjointDerivative, unknowns, nUnknowns);
    NEED(fmi3GetAdjointDerivative, knowns, nKnowns);
    NEED(fmi3GetAdjointDerivative, seed, nSeed);
    NEED(fmi3GetAdjointDerivative, sensitivity, nSensitivity);
    AS_MANY(fmi3GetAdjointDerivative, nUnknowns, nSeed);
    AS_MANY(fmi3GetAdjointDerivative, nKnowns, nSensitivity);
    const Direction d = {unknowns, knowns, nUnknowns, nKnowns, seed};
    return (fmi3Status)adjoint(m, &d, sensitivity);
}

/* Between communication points: inputs at the end of a step are asked for at its start, outputs may be
   read at its end. It is too late there to return early. */

int begin_updates(Instance *m, const fmi3ValueReference wanted[], size_t n,
                  fmi3IntermediateUpdateCallback update) {
    m->update = (void (*)(void))update;
    m->shows = n == 0;
    if (n == 0) return GOOD;
    if (!wanted || !update) {
        return fail(m, "intermediate variables are required, but %s is NULL",
                    wanted ? "intermediateUpdate" : "the array of them");
    }
    for (size_t i = 0; i < n; i++) {
        const Variable *v = find(m, wanted[i]);
        if (!v) return BAD;
        m->asks |= v->cause == CAUSE_INPUT;
        m->shows |= v->cause == CAUSE_OUTPUT;
        if (v->cause == CAUSE_OUTPUT || (v->cause == CAUSE_INPUT && v->type == TYPE_REAL)) continue;
        return fail(m,
                    "%s is required between communication points, allowed: outputs and Float64 "
                    "inputs",
                    v->name);
    }
    return GOOD;
}

void ask_ahead(Instance *m, double t, double h) {
    Snap *s = &m->now;
    double start[AT_LEAST_ONE(NINP)], early_time = t;
    const int32_t dirty = s->dirty, latch = s->latch, unsolved = m->unsolved;
    fmi3Boolean early = fmi3False;
    if (!m->asks || !(h > 0.0) || !is_finite(t + h)) return;
    memcpy(start, s->inp, sizeof start);
    s->mode = UPDATING;
    ((fmi3IntermediateUpdateCallback)m->update)(m->log.environment, t + h, fmi3True, fmi3False, fmi3False,
                                                fmi3False, &early, &early_time);
    s->mode = STEPPING;
    for (int i = 0; i < NINP; i++) s->inp[NINP + i] = (s->inp[i] - start[i]) / h;
    memcpy(s->inp, start, sizeof start);
    s->dirty = dirty;
    m->unsolved = unsolved;
    if (!s->n_refused) s->latch = latch;
}

void show_end(Instance *m) {
    fmi3Boolean early = fmi3False;
    double early_time = m->now.time;
    if (!m->update || !m->shows) return;
    m->now.mode = UPDATED;
    ((fmi3IntermediateUpdateCallback)m->update)(m->log.environment, m->now.time, fmi3False, fmi3True,
                                                fmi3True, fmi3False, &early, &early_time);
    m->now.mode = STEPPING;
}
