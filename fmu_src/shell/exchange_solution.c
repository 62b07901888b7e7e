/* The solution in model exchange: what the kernels say of the host's states. */
#include <string.h>

#include "kernel.h"
#include "shell.h"

#if HAS_EXCHANGE
#define GIVEN s->par, s->own, s->inp, s->cont, s->discrete, m->work

static int start(Instance *m) {
    Snap *s = &m->now;
    memset(s->discrete, 0, sizeof s->discrete);
    return tw_start(GIVEN, s->time);
}
static int rates(Instance *m) {
    Snap *s = &m->now;
    return tw_rates(GIVEN, s->solution.out, s->der, s->sign);
}
static int update(Instance *m) {
    Snap *s = &m->now;
    return tw_update(GIVEN, s->solution.out, s->solution.iout, s->time);
}

static int is_failure(int rc) { return rc < 0 || rc >= FIRST_FAILURE; }

static int all_finite(const double *x, int n) {
    int bad = 0;
    for (int i = 0; i < n; i++) bad += !is_finite(x[i]);
    return !bad;
}

/* The kernel's answer, a failure too where it is not finite. */
static int answered(const Snap *s, int rc) {
    if (is_failure(rc)) return rc < 0 ? STATUS_NOT_FINITE : rc;
    return all_finite(s->solution.out, NOUT) && all_finite(s->der, NCONT) && all_finite(s->sign, NSIGN)
               ? 0
               : STATUS_NOT_FINITE;
}

/* Outputs, derivatives and indicators at the present values; until the initialization ends also the
   states and what is discrete. The last good ones stay where there are none. */
int solve_exchange(Instance *m) {
    Snap *s = &m->now;
    double der[AT_LEAST_ONE(NCONT)], sign[AT_LEAST_ONE(NSIGN)];
    Solution *undo = &m->undo;
    if (m->unsolved) {
        tell_failure(m, m->unsolved, s->time, 0.0);
        return BAD;
    }
    memcpy(undo, &s->solution, sizeof *undo);
    memcpy(der, s->der, sizeof der);
    memcpy(sign, s->sign, sizeof sign);
    int rc = 0;
    for (int i = 0; i < N_REQUIREMENTS; i++) {
        const Requirement *r = &REQUIREMENTS[i];
        if (s->par[r->slot] == r->value) continue;
        s->latch = STATUS_BAD_INPUT;
        return fail(m, "%s = %g is for co-simulation only; in model exchange allowed: %g (%s)", r->name,
                    s->par[r->slot], r->value, r->text);
    }
    if (s->mode == INITIALIZING) {
        rc = start(m);
        if (!is_failure(rc)) rc = update(m);
    }
    if (!is_failure(rc)) rc = rates(m);
    rc = answered(s, rc);
    s->dirty = rc != 0;
    if (!rc) return GOOD;
    memcpy(&s->solution, undo, sizeof *undo);
    memcpy(s->der, der, sizeof der);
    memcpy(s->sign, sign, sizeof sign);
    m->unsolved = s->latch = rc;
    tell_failure(m, rc, s->time, 0.0);
    return BAD;
}

/* What is discrete, anew; nothing changes where there is a failure. */
int update_exchange(Instance *m) {
    Snap *s = &m->now;
    double *discrete = m->discrete;
    int32_t iout[AT_LEAST_ONE(NIOUT)];
    memcpy(discrete, s->discrete, sizeof s->discrete);
    memcpy(iout, s->solution.iout, sizeof iout);
    const int rc = update(m);
    if (!is_failure(rc)) {
        /* outputs are those of `rates`, which starts from what is kept now */
        if (NEEDS_STEPS || memcmp(discrete, s->discrete, sizeof s->discrete) != 0) s->dirty = 1;
        return GOOD;
    }
    memcpy(s->discrete, discrete, sizeof s->discrete);
    memcpy(s->solution.iout, iout, sizeof iout);
    s->latch = rc < 0 ? STATUS_NOT_FINITE : rc;
    tell_failure(m, s->latch, s->time, 0.0);
    return BAD;
}

/* What the kernels keep of a completed step. */
int finish_step(Instance *m) {
#if NEEDS_STEPS
    Snap *s = &m->now;
    const int rc = tw_finish(GIVEN, s->time);
    if (!is_failure(rc)) return GOOD;
    s->latch = rc < 0 ? STATUS_NOT_FINITE : rc;
    tell_failure(m, s->latch, s->time, 0.0);
    return BAD;
#else
    return (void)m, GOOD;
#endif
}
#else
int solve_exchange(Instance *m) { return (void)m, BAD; }

int update_exchange(Instance *m) { return (void)m, BAD; }

int finish_step(Instance *m) { return (void)m, BAD; }
#endif
