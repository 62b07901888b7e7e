/* Derivatives of outputs with respect to inputs, from the model's own equations. */
#include <string.h>

#include "kernel.h"
#include "shell.h"

static int are_known(Instance *m, const uint32_t *references, size_t n, int cause) {
    for (size_t i = 0; i < n; i++) {
        const Variable *v = find(m, references[i]);
        if (!v) return 0;
        if (v->cause == cause && v->type == TYPE_REAL) continue;
        fail(m, "%s: derivatives are of real outputs, with respect to inputs", v->name);
        return 0;
    }
    return 1;
}

static int is_possible(Instance *m, const Direction *d, size_t n_seed) {
    if (!HAS_SENS) {
        fail(m, "%s has no derivatives", MODEL_NAME);
        return 0;
    }
    if (!are_known(m, d->unknowns, d->n_unknowns, CAUSE_OUTPUT)) return 0;
    if (!are_known(m, d->knowns, d->n_knowns, CAUSE_INPUT)) return 0;
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
    return fail(m, "%s at t = %g s has no derivative here%s: %s: %s", MODEL_NAME, m->now.time,
                rc == STATUS_SINGULAR ? ", at the fold" : "", status_text(rc)->name,
                status_text(rc)->advice);
}

/* One solve for the whole direction. Where no input of it acts at once the answer is 0 exactly. */
int directional(Instance *m, const Direction *d, double *sensitivity) {
    double seed[AT_LEAST_ONE(NINP)] = {0}, dout[AT_LEAST_ONE(NOUT)];
    uint32_t moved = 0;
    if (!is_possible(m, d, d->n_knowns) || refresh_work(m)) return BAD;
    for (size_t i = 0; i < d->n_knowns; i++) {
        int slot = VARIABLES[d->knowns[i]].slot;
        seed[slot] += d->seed[i];
        moved |= 1u << slot;
    }
    if (differentiate(m, seed, dout)) return BAD;
    for (size_t i = 0; i < d->n_unknowns; i++) {
        const Variable *v = &VARIABLES[d->unknowns[i]];
        sensitivity[i] = v->depends & moved ? dout[v->slot] : 0.0;
    }
    return GOOD;
}

/* For each known the sum over the unknowns, weighted by the seed. */
int adjoint(Instance *m, const Direction *d, double *sensitivity) {
    double seed[AT_LEAST_ONE(NINP)], dout[AT_LEAST_ONE(NOUT)];
    if (!is_possible(m, d, d->n_unknowns) || refresh_work(m)) return BAD;
    for (size_t k = 0; k < d->n_knowns; k++) {
        int slot = VARIABLES[d->knowns[k]].slot;
        memset(seed, 0, sizeof seed);
        seed[slot] = 1.0;
        if (differentiate(m, seed, dout)) return BAD;
        sensitivity[k] = 0.0;
        for (size_t i = 0; i < d->n_unknowns; i++) {
            const Variable *v = &VARIABLES[d->unknowns[i]];
            if (v->depends >> slot & 1u) sensitivity[k] += d->seed[i] * dout[v->slot];
        }
    }
    return GOOD;
}
