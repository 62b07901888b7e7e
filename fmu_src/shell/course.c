/* Inputs that move within a step: straight, with their rates, from their values at its start. */
#include <string.h>

#include "shell.h"

/* Everything is checked before the first rate is taken over. */
int set_rates(Instance *m, int call, const uint32_t *references, size_t n, const int32_t *orders,
              const double *rates) {
    if (is_missing(m, call, references, n) || is_missing(m, call, orders, n)
        || is_missing(m, call, rates, n)) return BAD;
    for (size_t i = 0; i < n; i++) {
        const Variable *v = find(m, references[i]);
        if (v && v->cause == CAUSE_INPUT && v->type == TYPE_REAL && orders[i] == 1
            && is_finite(rates[i])) continue;
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

/* What would leave its range ends where the range does; a hair before it, for the rounding. */
static double bounded(const Variable *v, double value, double rate, double h) {
    if (is_inside(v, value + rate * h)) return rate;
    return (1.0 - 1e-15) * ((rate > 0.0 ? v->high : v->low) - value) / h;
}

/* As `solve`, then the inputs are those at the end and without rates. A model that takes no rates
   steps with the inputs at the middle; its outputs are solved anew when they are read. */
int follow(Instance *m, double t, double h) {
    double given[2 * AT_LEAST_ONE(NINP)], end[AT_LEAST_ONE(NINP)], *inp = m->now.inp;
    int moving = 0;
    for (int i = 0; i < NINP; i++) moving |= inp[NINP + i] != 0.0;
    if (!moving) {
        int rc = solve(m, t, h);
        if (!rc) m->now.dirty = 0;
        return rc;
    }
    memcpy(given, inp, sizeof given);
    for (int i = 0; i < N_VARIABLES; i++) {
        const Variable *v = &VARIABLES[i];
        if (v->store != STORE_INP) continue;
        double *value = &inp[v->slot], *rate = &inp[NINP + v->slot];
        if (*rate != 0.0) *rate = bounded(v, *value, *rate, h);
        end[v->slot] = *rate != 0.0 ? *value + *rate * h : *value;
        if (!NRATES && *rate != 0.0) *value += 0.5 * *rate * h;
    }
    int rc = solve(m, t, h);
    memcpy(m->given, given, sizeof given);
    memcpy(inp, given, sizeof given);
    if (rc) return rc;
    memcpy(inp, end, NINP * sizeof *inp);
    memset(inp + NINP, 0, NINP * sizeof *inp);
    m->now.dirty = !NRATES;
    return 0;
}
