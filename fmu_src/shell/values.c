/* Setting and getting values, and setting rates: everything is checked before the first is taken over. */
#include <string.h>

#include "shell.h"

/* The value at place i of a host's array; a byte stands for true unless it is 0. */
static inline double read_form(int form, const void *values, size_t i) {
    if (form == FORM_DOUBLE) return ((const double *)values)[i];
    if (form == FORM_INT32) return ((const int32_t *)values)[i];
    if (form == FORM_INT64) return (double)((const int64_t *)values)[i];
    return form == FORM_BYTE && ((const unsigned char *)values)[i] != 0;
}

/* The same, taken as the end of the variable's range where only rounding put it outside. */
static inline double read_value(const Variable *v, int form, const void *values, size_t i) {
    return within(v->low, v->high, read_form(form, values, i));
}

static void write_value(const Kind *kind, void *values, size_t i, double value) {
    switch (kind->form) {
    case FORM_DOUBLE: ((double *)values)[i] = value; break;
    case FORM_INT32: ((int32_t *)values)[i] = (int32_t)value; break;
    case FORM_INT64: ((int64_t *)values)[i] = (int64_t)value; break;
    case FORM_BYTE: ((unsigned char *)values)[i] = value != 0.0; break;
    default: break;
    }
}

int is_missing(Instance *m, int call, const void *array, size_t n) {
    if (array || n == 0) return 0;
    fail(m, "%s: an array is NULL, %lu values are wanted", CALLS[call].name, (unsigned long)n);
    return 1;
}

const Variable *find(Instance *m, uint32_t reference) {
    if (reference < N_VARIABLES) return &VARIABLES[reference];
    fail(m, "value reference %lu is unknown in %s", (unsigned long)reference, m->part.name);
    return NULL;
}

static int misfit(Instance *m, uint32_t reference, const Kind *kind) {
    const Variable *v = find(m, reference);
    if (!v) return 0;
    const TypeText *type = &TYPES[v->type];
    fail(m, "%s is of type %s, not %s", v->name, m->log.fmi == 2 ? type->fmi2 : type->fmi3, kind->name);
    return 0;
}

/* Are all references known and of the kind that is asked for? Collects what they are, as bits. */
static int all_fit(Instance *m, int call, const uint32_t *references, size_t n, const Kind *kind,
                   const void *values, uint32_t *found) {
    const uint32_t takes = kind->takes;
    uint32_t bits = 0;
    if (is_missing(m, call, references, n) || is_missing(m, call, values, n)) return 0;
    for (size_t i = 0; i < n; i++) {
        const uint32_t r = references[i];
        if (r >= N_VARIABLES || !(takes & PLACES[r].bits)) return misfit(m, r, kind);
        bits |= PLACES[r].bits;
    }
    *found = bits;
    return 1;
}

/* Remember that the values of this call are missing: no step until they are set. */
static void refuse(Instance *m, const uint32_t *references, size_t n) {
    for (int i = 0; i < N_VARIABLES; i++) {
        if (m->now.refused[i]) m->now.refused[i] = 2; /* by an earlier call */
    }
    for (size_t i = 0; i < n; i++) {
        if (!may_set(m, &VARIABLES[references[i]])) continue;
        m->now.n_refused += !m->now.refused[references[i]];
        m->now.refused[references[i]] = 1;
    }
}

/* A value that is new: the outputs are no longer those of the present ones. */
static void note_change(Instance *m) {
    m->now.dirty = 1;
    m->now.latch = m->unsolved = 0;
}

static void take_over(Instance *m, uint32_t reference, double value) {
    Snap *s = &m->now;
    const Variable *v = &VARIABLES[reference];
    double *place = v->store == STORE_PAR   ? &s->par[v->slot]
                    : v->store == STORE_OWN ? &s->own[v->slot]
                                            : &s->inp[v->slot];
    if (*place != value) {
        *place = value;
        note_change(m);
        if (v->store == STORE_PAR) s->prepared = 0;
    }
    if (s->n_refused && s->refused[reference]) {
        s->refused[reference] = 0;
        if (--s->n_refused == 0) s->latch = 0;
    }
}

/* 0 K: what some hosts set an input to that is not connected. */
static int is_no_temperature(const Variable *v, double value) {
    return value == 0.0 && !is_inside(v, value) && v->cause == CAUSE_INPUT && !v->relative
           && strcmp(v->unit, "K") == 0;
}

/* What may be set now, within its range; or a parameter to the value that it has, whenever. */
static int is_taken(const Instance *m, const Variable *v, double value) {
    if (!may_set(m, v)) return v->cause == CAUSE_PARAMETER && value_of(m, v) == value;
    return is_inside(v, value) || is_no_temperature(v, value);
}

/* The usual call: real inputs within their ranges, which are finite, while no value is missing. */
static int set_inputs(Instance *m, const uint32_t *references, size_t n, const double *values) {
    const uint16_t wanted = TYPE_BIT(TYPE_REAL) | CAUSE_BIT(CAUSE_INPUT);
    if (!references || !values || m->now.n_refused || !(ACCESS[CAUSE_INPUT].set & m->now.mode)) return 0;
    for (size_t i = 0; i < n; i++) {
        const uint32_t r = references[i];
        if (r >= N_VARIABLES || PLACES[r].bits != wanted) return 0;
        if (!(VARIABLES[r].low <= values[i] && values[i] <= VARIABLES[r].high)) return 0;
    }
    for (size_t i = 0; i < n; i++) {
        double *place = &m->now.inp[PLACES[references[i]].slot];
        if (*place == values[i]) continue;
        *place = values[i];
        note_change(m);
    }
    return 1;
}

int set_values(Instance *m, int call, const uint32_t *references, size_t n, const Kind *kind,
               const void *values) {
    uint32_t found = 0;
    if (kind->form == FORM_DOUBLE && set_inputs(m, references, n, values)) return GOOD;
    if (!all_fit(m, call, references, n, kind, values, &found)) return BAD;
    for (size_t i = 0; i < n; i++) {
        const Variable *v = &VARIABLES[references[i]];
        double value = read_value(v, kind->form, values, i);
        if (is_taken(m, v, value)) continue;
        tell_refusal(m, v, value);
        m->now.latch = STATUS_BAD_INPUT;
        refuse(m, references, n);
        return BAD;
    }
    for (size_t i = 0; i < n; i++) {
        const Variable *v = &VARIABLES[references[i]];
        double value = read_value(v, kind->form, values, i);
        if (is_no_temperature(v, value)) {
            tell_no_temperature(m, v);
            value = value_of(m, v);
        }
        take_over(m, references[i], value);
    }
    return GOOD;
}

int set_rates(Instance *m, int call, const uint32_t *references, size_t n, const int32_t *orders,
              const double *rates) {
    if (is_missing(m, call, references, n) || is_missing(m, call, orders, n) || is_missing(m, call, rates, n))
        return BAD;
    for (size_t i = 0; i < n; i++) {
        const Variable *v = find(m, references[i]);
        if (v && v->cause == CAUSE_INPUT && v->type == TYPE_REAL && orders[i] == 1 && is_finite(rates[i]))
            continue;
        m->now.latch = STATUS_BAD_INPUT;
        if (!v) return BAD;
        if (v->cause != CAUSE_INPUT || v->type != TYPE_REAL) {
            return fail(m, "%s: only Real inputs have a rate of change", v->name);
        }
        if (orders[i] != 1) {
            return fail(m, "%s: derivative of order %ld, allowed: 1", v->name, (long)orders[i]);
        }
        Text text = {0};
        add(&text, "%s: rate of change = ", v->name);
        add_exact(&text, rates[i]);
        return fail(m, "%s %s/s, allowed: a finite number", text.text, v->unit);
    }
    for (size_t i = 0; i < n; i++) {
        m->now.inp[NINP + VARIABLES[references[i]].slot] = rates[i];
    }
    return GOOD;
}

/* After a failure the status alone is to be had. */
static int are_status(const uint32_t *references, size_t n) {
    for (size_t i = 0; i < n; i++) {
        const Variable *v = &VARIABLES[references[i]];
        if (v->store != STORE_IOUT || v->slot != IO_STATUS) return 0;
    }
    return 1;
}

/* Outputs exist from the initialization on; those that are out of date are solved first. */
static int are_solved(Instance *m, const uint32_t *references, size_t n) {
    if (!(ACCESS[CAUSE_OUTPUT].get & m->now.mode)) {
        size_t i = 0;
        while (VARIABLES[references[i]].cause < CAUSE_OUTPUT) i++;
        fail(m, "%s has no value in state %s; call fmi%d%s first", VARIABLES[references[i]].name,
             MODES[0].name, (int)m->log.fmi, MODES[0].leave);
        return 0;
    }
    if (!m->now.dirty || (m->now.latch && are_status(references, n))) return 1;
    return refresh(m) == GOOD;
}

/* The usual calls: outputs that are up to date. Where one is none of them, `values` are of no use yet. */
static int get_outputs(const Instance *m, const uint32_t *references, size_t n, const Kind *kind,
                       void *values) {
    const Solution *s = &m->now.solution;
    if (!references || !values || m->now.dirty || m->now.latch || !(ACCESS[CAUSE_OUTPUT].get & m->now.mode))
        return 0;
    if (kind->form == FORM_DOUBLE) {
        for (size_t i = 0; i < n; i++) {
            const uint32_t r = references[i];
            if (r >= N_VARIABLES || PLACES[r].bits != (TYPE_BIT(TYPE_REAL) | CAUSE_BIT(CAUSE_OUTPUT)))
                return 0;
            ((double *)values)[i] = s->out[PLACES[r].slot];
        }
        return 1;
    }
    for (size_t i = 0; i < n; i++) {
        const uint32_t r = references[i];
        if (kind->form != FORM_INT32 || r >= N_VARIABLES || !(PLACES[r].bits & kind->takes)) return 0;
        if (!(PLACES[r].bits & CAUSE_BIT(CAUSE_OUTPUT))) return 0;
        ((int32_t *)values)[i] = s->iout[PLACES[r].slot];
    }
    return 1;
}

int get_values(Instance *m, int call, const uint32_t *references, size_t n, const Kind *kind, void *values) {
    uint32_t found = 0;
    if (get_outputs(m, references, n, kind, values)) return GOOD;
    if (!all_fit(m, call, references, n, kind, values, &found)) return BAD;
    if (found & (CAUSE_BIT(CAUSE_OUTPUT) | CAUSE_BIT(CAUSE_LOCAL)) && !are_solved(m, references, n))
        return m->now.mode == CONTINUOUS ? DISCARD : BAD;
    for (size_t i = 0; i < n; i++) {
        write_value(kind, values, i, value_of(m, &VARIABLES[references[i]]));
    }
    return GOOD;
}
