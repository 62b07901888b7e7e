/* Derivatives of outputs with respect to inputs, from the model's own equations; also with respect to
   tunable parameters and, until the initialization ends, all others: from these equations where the
   model has them, else as a difference of two solutions. */
#include <string.h>

#include "kernel.h"
#include "shell.h"

/* Real outputs; real inputs, tunable parameters and, while they still count as values, all real ones.
   Hosts name all that an output depends on and give what they do not ask for the seed 0. */
static int are_known(Instance *m, const uint32_t *references, size_t n, uint32_t causes, const double *seed) {
    for (size_t i = 0; i < n; i++) {
        const Variable *v = find(m, references[i]);
        if (!v) return 0;
        const int counts = v->bits & causes || (causes & CAUSE_BIT(CAUSE_INPUT) && v->tunable);
        if (counts && (v->type == TYPE_REAL || (seed && seed[i] == 0.0))) continue;
        fail(m,
             "%s: derivatives are of real outputs, with respect to inputs, tunable parameters and, "
             "in initialization mode, real parameters",
             v->name);
        return 0;
    }
    return 1;
}

static int is_possible(Instance *m, const Direction *d, int forward) {
    size_t n_seed = forward ? d->n_knowns : d->n_unknowns;
    uint32_t parameters = m->now.mode == INITIALIZING ? CAUSE_BIT(CAUSE_PARAMETER) : 0;
    if (!HAS_SENS) {
        fail(m, "%s has no derivatives", m->part.name);
        return 0;
    }
    if (!are_known(m, d->unknowns, d->n_unknowns, CAUSE_BIT(CAUSE_OUTPUT), NULL)) return 0;
    if (!are_known(m, d->knowns, d->n_knowns, CAUSE_BIT(CAUSE_INPUT) | parameters, forward ? d->seed : NULL))
        return 0;
    for (size_t i = 0; i < n_seed; i++) {
        if (is_finite(d->seed[i])) continue;
        fail(m, "a seed of the derivative is not finite");
        return 0;
    }
    return 1;
}

/* Let `work` belong to the present point; the solution itself stays as it is, to the bit. */
static int refresh_work(Instance *m) {
    if (refresh(m)) return BAD;
    if (m->work_fits) return GOOD;
    if (prepare(m)) return BAD;
    int rc = solve(m, m->now.time, 0.0);
    if (rc) {
        tell_failure(m, rc, m->now.time, 0.0);
        return BAD;
    }
    put_back(m);
    return GOOD;
}

/* dout = d out / d inp . seed, every number of it finite. */
static int differentiate(Instance *m, double *seed, double *dout) {
    int rc = 0;
    memset(dout, 0, AT_LEAST_ONE(NOUT) * sizeof *dout);
#if HAS_SENS
    rc = tw_sens(m->now.par, m->now.inp, m->now.solution.state, m->work, seed, dout);
#else
    (void)seed;
#endif
    for (int i = 0; i < NOUT; i++) {
        if (!is_finite(dout[i]) && rc >= 0 && rc < FIRST_FAILURE) rc = STATUS_NOT_FINITE;
    }
    if (rc >= 0 && rc < FIRST_FAILURE) return GOOD;
    m->work_fits = 0;
    Text text = {0};
    add(&text, "%s at t = ", m->part.name);
    add_number(&text, m->now.time);
    add(&text, " s has no derivative here%s: %s: %s", rc == STATUS_SINGULAR ? ", at the fold" : "",
        status_text(rc)->name, status_text(rc)->advice);
    tell(&m->log, BAD, LOG_ERROR, &text);
    return BAD;
}

static int has_none(const Instance *m, const Variable *v) {
    Text text = {0};
    add(&text, "%s = ", v->name);
    add_number(&text, m->now.par[v->slot]);
    add(&text, " has no derivative here");
    tell(&m->log, BAD, LOG_ERROR, &text);
    return BAD;
}

/* The outputs with another value of a parameter; 0 if there are none. */
static int try_value(Instance *m, const Variable *v, double value, double *out) {
    double *par = m->now.par;
    par[v->slot] = value;
#if HAS_RULES
    if (tw_rule(par)) return 0;
#endif
    int rc = tw_derive(par);
    if (rc < 0 || rc >= FIRST_FAILURE || solve(m, m->now.time, 0.0)) return 0;
    memcpy(out, m->now.solution.out, sizeof m->now.solution.out);
    put_back(m);
    return 1;
}

/* dout += seed d out / d parameter: the central difference, where range, rules and solutions let it
   be, else a one-sided one. */
static int add_difference(Instance *m, const Variable *v, double seed, double *dout) {
    double par[NPAR], out[2][AT_LEAST_ONE(NOUT)], x[2];
    const double at = m->now.par[v->slot], room = v->high / 2.0 - v->low / 2.0;
    const double h = 1e-5 * (at != 0.0 ? size_of(at) : room < 1.0 ? room : 1.0);
    if (has_table_for(m, v)) {
        return fail(m, "%s: no derivative with fidelity 'map', whose map is for one value", v->name);
    }
    memcpy(par, m->now.par, sizeof par);
    for (int k = 0; k < 2; k++) {
        x[k] = at + (k ? h : -h);
        if (!is_inside(v, x[k]) || !try_value(m, v, x[k], out[k])) {
            x[k] = at;
            memcpy(out[k], m->now.solution.out, sizeof out[k]);
        }
        memcpy(m->now.par, par, sizeof par);
    }
    m->work_fits = 0;
    if (x[0] == x[1]) return has_none(m, v);
    for (int i = 0; i < NOUT; i++) dout[i] += seed * (out[1][i] - out[0][i]) / (x[1] - x[0]);
    return GOOD;
}

/* The place of a parameter in a direction, or -1 if the model does not differentiate over it. */
static int place_in_seed(const Variable *v) {
    int place = NINP;
    if (NSEED == NINP || !v->tunable) return -1;
    for (const Variable *before = VARIABLES; before < v; before++) place += before->tunable;
    return place < NSEED ? place : -1;
}

/* Tell if a rule lets a parameter move at all. */
static int may_move(Instance *m, const Variable *v) {
    double *value = &m->now.par[v->slot];
    const double at = *value;
    int may = 0;
    for (int side = -1; side < 2; side += 2) {
        *value = at + side * 1e-6 * (at != 0.0 ? size_of(at) : 1.0);
#if HAS_RULES
        may |= is_inside(v, *value) && !tw_rule(m->now.par);
#else
        may |= is_inside(v, *value);
#endif
    }
    *value = at;
    return may;
}

/* dout += seed d out / d parameter. */
static int add_parameter(Instance *m, const Variable *v, double seed, double *dout) {
    double along[AT_LEAST_ONE(NSEED)] = {0}, found[AT_LEAST_ONE(NOUT)] = {0};
    const int place = place_in_seed(v);
    if (v->store == STORE_OWN) return GOOD; /* for model exchange only */
    if (place < 0 || has_table_for(m, v)) return add_difference(m, v, seed, dout);
    if (!may_move(m, v)) return has_none(m, v);
    along[place] = seed;
    if (refresh_work(m)) return BAD;
    m->work_fits = 0; /* solved more sharply there */
    if (differentiate(m, along, found)) return BAD;
    for (int i = 0; i < NOUT; i++) dout[i] += found[i];
    return GOOD;
}

/* The inputs' part of a direction in one solve, then the parameters one by one. Where no input of it
   acts at once the answer is 0 exactly. */
int directional(Instance *m, const Direction *d, double *sensitivity) {
    double seed[AT_LEAST_ONE(NSEED)] = {0}, dout[AT_LEAST_ONE(NOUT)] = {0};
    double by_parameters[AT_LEAST_ONE(NOUT)] = {0};
    uint32_t moved = 0;
    if (m->now.exchange) return exchange_directional(m, d, sensitivity);
    if (!is_possible(m, d, 1) || refresh_work(m)) return BAD;
    for (size_t i = 0; i < d->n_knowns; i++) {
        const Variable *v = &VARIABLES[d->knowns[i]];
        if (v->cause != CAUSE_INPUT || d->seed[i] == 0.0) continue;
        seed[v->slot] += d->seed[i];
        moved |= 1u << v->slot;
    }
    if (moved && differentiate(m, seed, dout)) return BAD;
    for (size_t i = 0; i < d->n_knowns; i++) {
        const Variable *v = &VARIABLES[d->knowns[i]];
        if (v->cause == CAUSE_INPUT || d->seed[i] == 0.0) continue;
        if (add_parameter(m, v, d->seed[i], by_parameters)) return BAD;
    }
    for (size_t i = 0; i < d->n_unknowns; i++) {
        const Variable *v = &VARIABLES[d->unknowns[i]];
        sensitivity[i] = (v->depends & moved ? dout[v->slot] : 0.0) + by_parameters[v->slot];
    }
    return GOOD;
}

/* For each known the sum over the unknowns, weighted by the seed. */
int adjoint(Instance *m, const Direction *d, double *sensitivity) {
    if (m->now.exchange) return exchange_adjoint(m, d, sensitivity);
    if (!is_possible(m, d, 0)) return BAD;
    for (size_t k = 0; k < d->n_knowns; k++) {
        const Variable *v = &VARIABLES[d->knowns[k]];
        double seed[AT_LEAST_ONE(NSEED)] = {0}, dout[AT_LEAST_ONE(NOUT)] = {0};
        if (refresh_work(m)) return BAD;
        if (v->cause == CAUSE_INPUT) seed[v->slot] = 1.0;
        if (v->cause == CAUSE_INPUT ? differentiate(m, seed, dout) : add_parameter(m, v, 1.0, dout))
            return BAD;
        sensitivity[k] = 0.0;
        for (size_t i = 0; i < d->n_unknowns; i++) {
            const Variable *u = &VARIABLES[d->unknowns[i]];
            if (v->cause != CAUSE_INPUT || u->depends >> v->slot & 1u) {
                sensitivity[k] += d->seed[i] * dout[u->slot];
            }
        }
    }
    return GOOD;
}
