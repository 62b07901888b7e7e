/* Derivatives of model exchange: outputs and derivatives of states over inputs and states, from the
   model's own equations; during the initialization over inputs and real parameters, as differences. */
#include <string.h>

#include "kernel.h"
#include "shell.h"

#if HAS_EXCHANGE
static int slopes(Instance *m) {
    Snap *s = &m->now;
    return tw_slopes(s->par, s->own, s->inp, s->cont, s->discrete, m->work, m->along, m->found);
}

/* The place of an unknown in `found`, or -1. */
static int unknown_of(const Variable *v) {
    if (v->store == STORE_OUT) return v->slot;
    return v->store == STORE_DER ? NOUT + v->slot : -1;
}

/* The place of a known in `along`, or -1. */
static int known_of(const Variable *v) {
    const int state = state_of(v);
    if (v->store == STORE_INP && v->type == TYPE_REAL) return v->slot;
    return state >= 0 ? NINP + state : -1;
}

static int is_parameter(const Instance *m, const Variable *v) {
    const int counts = m->now.mode == INITIALIZING || v->tunable;
    return counts && v->cause == CAUSE_PARAMETER && v->type == TYPE_REAL;
}

static int are_possible(Instance *m, const Direction *d, size_t n_seed) {
    for (size_t i = 0; i < d->n_unknowns; i++) {
        const Variable *v = find(m, d->unknowns[i]);
        if (!v) return 0;
        if (unknown_of(v) >= 0 || (m->now.mode == INITIALIZING && v->store == STORE_CONT)) continue;
        fail(m, "%s: derivatives are of real outputs and of derivatives of states", v->name);
        return 0;
    }
    for (size_t i = 0; i < d->n_knowns; i++) {
        const Variable *v = find(m, d->knowns[i]);
        if (!v) return 0;
        if (known_of(v) >= 0 || is_parameter(m, v)) continue;
        if (n_seed == d->n_knowns && d->seed[i] == 0.0 && v->cause == CAUSE_PARAMETER) continue;
        fail(m,
             "%s: derivatives are with respect to real inputs, continuous states and, in "
             "initialization mode, real parameters",
             v->name);
        return 0;
    }
    for (size_t i = 0; i < n_seed; i++) {
        if (is_finite(d->seed[i])) continue;
        fail(m, "a seed of the derivative is not finite");
        return 0;
    }
    return 1;
}

static int has_none(Instance *m, const char *name, int32_t status) {
    return fail(m, "%s has no derivative here: %s: %s", name, status_text(status)->name,
                status_text(status)->advice);
}

/* found = d (outputs, derivatives) along `along`. */
static int differentiate(Instance *m) {
    memset(m->found, 0, sizeof m->found);
    if (refresh(m)) return BAD;
    int rc = slopes(m);
    for (int i = 0; i < NOUT + NCONT; i++) {
        if (!is_finite(m->found[i]) && rc >= 0 && rc < FIRST_FAILURE) rc = STATUS_NOT_FINITE;
    }
    return rc < 0 || rc >= FIRST_FAILURE ? has_none(m, m->part.name, rc) : GOOD;
}

/* Outputs, derivatives and states with a value changed, at the start of a run. */
static int try_value(Instance *m, double *place, double value, double *unknowns) {
    const double before = *place;
    *place = value;
    m->now.dirty = 1;
    m->now.prepared = 0;
    const int rc = refresh(m);
    memcpy(unknowns, m->now.solution.out, NOUT * sizeof *unknowns);
    memcpy(unknowns + NOUT, m->now.der, NCONT * sizeof *unknowns);
    memcpy(unknowns + NOUT + NCONT, m->now.cont, NCONT * sizeof *unknowns);
    *place = before;
    m->now.dirty = 1;
    m->now.prepared = 0;
    m->now.latch = m->unsolved = 0;
    return rc == GOOD;
}

static double *place_of(Instance *m, const Variable *v) {
    if (v->store == STORE_PAR) return &m->now.par[v->slot];
    return v->store == STORE_OWN ? &m->now.own[v->slot] : &m->now.inp[v->slot];
}

/* sum += seed d (outputs, derivatives, states) / d value: a central difference in the range. */
static int add_difference(Instance *m, const Variable *v, double seed, double *sum) {
    double tried[2][AT_LEAST_ONE(NOUT + 2 * NCONT)], x[2], *place = place_of(m, v);
    const double at = *place, room = v->high / 2.0 - v->low / 2.0;
    const double h = 1e-5 * (at != 0.0 ? size_of(at) : room < 1.0 ? room : 1.0);
    for (int k = 0; k < 2; k++) {
        x[k] = at + (k ? h : -h);
        if (is_inside(v, x[k]) && try_value(m, place, x[k], tried[k])) continue;
        x[k] = at;
        if (!try_value(m, place, at, tried[k])) return BAD;
    }
    if (refresh(m)) return BAD;
    if (x[0] == x[1]) return has_none(m, v->name, STATUS_BAD_INPUT);
    for (int i = 0; i < NOUT + 2 * NCONT; i++) sum[i] += seed * (tried[1][i] - tried[0][i]) / (x[1] - x[0]);
    return GOOD;
}

/* sum += the change of all unknowns with one known. */
static int add_known(Instance *m, const Variable *v, double seed, double *sum) {
    if (seed == 0.0) return GOOD;
    if (m->now.mode == INITIALIZING || known_of(v) < 0) return add_difference(m, v, seed, sum);
    memset(m->along, 0, sizeof m->along);
    m->along[known_of(v)] = seed;
    if (differentiate(m)) return BAD;
    for (int i = 0; i < NOUT + NCONT; i++) sum[i] += m->found[i];
    return GOOD;
}

static double entry_of(const Variable *v, const double *sum) {
    return sum[v->store == STORE_CONT ? NOUT + NCONT + v->slot : unknown_of(v)];
}

int exchange_directional(Instance *m, const Direction *d, double *sensitivity) {
    double sum[AT_LEAST_ONE(NOUT + 2 * NCONT)] = {0};
    if (!are_possible(m, d, d->n_knowns)) return BAD;
    const int together = m->now.mode != INITIALIZING;
    memset(m->along, 0, sizeof m->along);
    for (size_t i = 0; together && i < d->n_knowns; i++) {
        const int place = known_of(&VARIABLES[d->knowns[i]]);
        if (place >= 0) m->along[place] += d->seed[i];
    }
    if (together && differentiate(m)) return BAD;
    for (int i = 0; together && i < NOUT + NCONT; i++) sum[i] = m->found[i];
    for (size_t i = 0; i < d->n_knowns; i++) {
        const Variable *v = &VARIABLES[d->knowns[i]];
        if (together && known_of(v) >= 0) continue;
        if (add_known(m, v, d->seed[i], sum)) return BAD;
    }
    for (size_t i = 0; i < d->n_unknowns; i++) {
        sensitivity[i] = entry_of(&VARIABLES[d->unknowns[i]], sum);
    }
    return GOOD;
}

int exchange_adjoint(Instance *m, const Direction *d, double *sensitivity) {
    if (!are_possible(m, d, d->n_unknowns)) return BAD;
    for (size_t k = 0; k < d->n_knowns; k++) {
        double sum[AT_LEAST_ONE(NOUT + 2 * NCONT)] = {0}, total = 0.0;
        if (add_known(m, &VARIABLES[d->knowns[k]], 1.0, sum)) return BAD;
        for (size_t i = 0; i < d->n_unknowns; i++) {
            total += d->seed[i] * entry_of(&VARIABLES[d->unknowns[i]], sum);
        }
        sensitivity[k] = total;
    }
    return GOOD;
}
#else
int exchange_directional(Instance *m, const Direction *d, double *sensitivity) {
    return (void)m, (void)d, (void)sensitivity, BAD;
}

int exchange_adjoint(Instance *m, const Direction *d, double *sensitivity) {
    return (void)m, (void)d, (void)sensitivity, BAD;
}
#endif
