/* Events: a step ends where a Boolean output changes, for hosts that allow it. */
#include <float.h>
#include <string.h>

#include "shell.h"

#define RESOLUTION 1e-7 /* s: how closely the instant is enclosed */
#define MOST_TRIALS 64  /* from 1e12 s down to the resolution */
#define MOST_IN_A_ROW 8 /* early returns before a whole step is made */

int has_changed(const Instance *m) {
    for (int i = 0; i < N_SWITCHES; i++) {
        if (m->now.solution.iout[SWITCHES[i].slot] != m->now.seen[i]) return 1;
    }
    return 0;
}

/* The first change as the model itself has located it [s]; past all times if it says none. */
static double located(const Instance *m, double t) {
    double first = DBL_MAX;
    for (int i = 0; i < N_SWITCHES; i++) {
        const Switch *s = &SWITCHES[i];
        int32_t now = m->now.solution.iout[s->slot], place = s->instant[now ? 0 : 1];
        if (now == m->now.seen[i] || place < 0) continue;
        double instant = m->now.solution.out[place];
        if (instant > t && instant < first) first = instant;
    }
    return first;
}

static void go_back(Instance *m, const double *given) {
    memcpy(&m->now.solution, m->before, sizeof *m->before);
    memcpy(m->now.inp, given, sizeof m->now.inp);
}

/* Step by h with the inputs and rates given at t; the outputs are those at its end. */
static int from_before(Instance *m, const double *given, double t, double h) {
    go_back(m, given);
    int rc = h > 0.0 ? follow(m, t, h) : solve(m, t, h);
    if (!rc && h > 0.0 && m->now.dirty) rc = solve(m, t + h, 0.0);
    if (rc) {
        go_back(m, given);
    } else {
        m->now.dirty = 0;
    }
    return rc;
}

/* A row of early returns ends when time has gone over the step in which it began. */
static int may_return_early(const Snap *s, double t) { return s->n_early < MOST_IN_A_ROW || t >= s->row_end; }

static void note_early_return(Snap *s, double t, double h) {
    if (s->n_early == 0 || t >= s->row_end) {
        s->n_early = 0;
        s->row_end = t + h;
    }
    s->n_early++;
}

/* Step from t by *h or, if a Boolean output changes, just behind the first change: by the new *h,
   which is 0 where the change comes with the inputs at t. Returns 0 or a failure.

   Each trial starts from a copy of the solution at t: the kernels store every step that succeeds. */
int follow_to_event(Instance *m, double t, double *h) {
    const double whole = *h, near = RESOLUTION + 1e-15 * size_of(t);
    double given[2 * AT_LEAST_ONE(NINP)];
    memcpy(given, m->now.inp, sizeof given);
    memcpy(m->before, &m->now.solution, sizeof *m->before);
    int rc = from_before(m, given, t, whole);
    if (rc || !has_changed(m) || !may_return_early(&m->now, t)) return rc;
    double low = 0.0, high = whole, at = 0.0;
    const double guess = located(m, t) - t;
    rc = from_before(m, given, t, 0.0);
    if (!rc && has_changed(m)) high = 0.0;
    for (int n = 0; !rc && n < MOST_TRIALS && high - low > near; n++) {
        at = n < 2 ? guess + (n ? -0.5 : 0.5) * near : 0.5 * (low + high);
        if (!(low < at && at < high)) at = 0.5 * (low + high);
        rc = from_before(m, given, t, at);
        if (!rc && has_changed(m)) {
            high = at;
        } else {
            low = at;
        }
    }
    if (rc || whole - high <= near) high = whole; /* a trial failed, or the change is at the end */
    if (rc || at != high) rc = from_before(m, given, t, high);
    if (rc) return rc;
    memset(m->now.inp + NINP, 0, NINP * sizeof *m->now.inp);
    if (high < whole) note_early_return(&m->now, t, whole);
    *h = high;
    return 0;
}
