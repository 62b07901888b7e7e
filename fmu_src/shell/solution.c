/* A solution: of the present values, and over a step along which inputs may move: straight, with their
   rates, from their values at its start. */
#include <string.h>

#include "kernel.h"
#include "shell.h"

/* Check the rules between parameters and compute the derived constants. */
int prepare(Instance *m) {
    if (m->now.prepared) return load_table(m);
    int32_t failed = m->now.latch;
    m->now.latch = STATUS_BAD_INPUT;
#if HAS_RULES
    int rule = tw_rule(m->now.par);
    if (rule) {
        tell_rule(m, rule > 0 && rule <= N_RULES ? RULES[rule - 1].text : "a rule is broken");
        return BAD;
    }
#endif
    int rc = tw_derive(m->now.par);
    if (rc < 0 || rc >= FIRST_FAILURE) {
        return fail(m, "the parameters cannot be used: %s", status_text(rc)->advice);
    }
    m->table_ready = 0;
    if (load_table(m)) return BAD;
    m->now.prepared = 1;
    m->now.latch = failed;
    return GOOD;
}

typedef uint64_t Pair __attribute__((vector_size(16)));

/* As `is_finite`, four at once: 1 more in an exponent of ones alone reaches the sign. */
static int all_finite(const double *x, int n) {
    const Pair exponent = {(uint64_t)0x7ff << 52, (uint64_t)0x7ff << 52};
    const Pair one = {(uint64_t)1 << 52, (uint64_t)1 << 52};
    Pair bits[2], found = {0, 0};
    int i = 0;
    for (; i + 4 <= n; i += 4) {
        memcpy(bits, &x[i], sizeof bits);
        found |= ((bits[0] & exponent) + one) | ((bits[1] & exponent) + one);
    }
    int good = !((found[0] | found[1]) >> 63);
    for (; i < n; i++) good &= is_finite(x[i]);
    return good;
}

/* The kernels leave `state` alone when they fail, and say so of a solution that is not finite. A small
   state is kept all the same; to copy a large one would take longer than to look a solution up. */
#define KEEPS_STATE (NSTATE <= 1024)

static void copy_solution(Solution *to, const Solution *from) {
    const size_t from_here = KEEPS_STATE ? 0 : offsetof(Solution, out);
    memcpy((char *)to + from_here, (const char *)from + from_here, sizeof *to - from_here);
}

void put_back(Instance *m) {
    copy_solution(&m->now.solution, &m->undo);
    memcpy(m->now.inp, m->given, sizeof m->given);
}

int solve(Instance *m, double t, double h) {
    Solution *s = &m->now.solution;
    copy_solution(&m->undo, s);
    memcpy(m->given, m->now.inp, sizeof m->given);
    int rc = tw_step(m->now.par, m->now.inp, s->state, m->work, s->out, s->iout, t, h);
    if (rc < 0 || (rc < FIRST_FAILURE && !all_finite(s->out, NOUT))) rc = STATUS_NOT_FINITE;
    m->work_fits = rc < FIRST_FAILURE && h == 0.0; /* derivatives hold the memory */
    if (rc < FIRST_FAILURE) return 0;
    put_back(m);
    return rc;
}

/* What the states of model exchange are in co-simulation: outputs, or what the kernels leave at W_STATES;
   their rates are those over the step of `h` that has led here. */
void note_states(Instance *m, double h) {
    Snap *s = &m->now;
    for (int i = 0; i < NCONT; i++) {
        const int out = CONTINUOUS_STATES[i].out;
        const double now = out >= 0 ? s->solution.out[out] : W_STATES > 0 ? m->work[W_STATES + i] : 0.0;
        const double rate = h > 0.0 ? (now - s->cont[i]) / h : 0.0;
        s->der[i] = is_finite(rate) ? rate : 0.0;
        s->cont[i] = is_finite(now) ? now : 0.0;
    }
}

/* Bring the outputs up to date, at most once per change. */
int refresh(Instance *m) {
    if (!m->now.dirty) return GOOD;
    if (m->now.exchange) return prepare(m) ? BAD : solve_exchange(m);
    if (!m->unsolved) { /* else the same values would fail again */
        if (prepare(m)) return BAD;
        m->unsolved = solve(m, m->now.time, 0.0);
        if (m->unsolved) m->now.latch = m->unsolved;
        if (!m->unsolved && m->now.mode == INITIALIZING) note_states(m, 0.0);
    }
    m->now.dirty = m->unsolved != 0;
    if (m->unsolved) tell_failure(m, m->unsolved, m->now.time, 0.0);
    return m->unsolved ? BAD : GOOD;
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
