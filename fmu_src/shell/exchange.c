/* Model exchange: the host's solver owns time and continuous states; here are derivatives, event
   indicators, outputs, and what is discrete, which changes in event mode only. */
#include <float.h>
#include <string.h>

#include "shell.h"

Instance *instantiate_exchange(const Log *log, const char *guid, const char *resources) {
    Text text = {0};
    if (!HAS_EXCHANGE) {
        add(&text, "this FMU is for co-simulation, not for model exchange");
        tell(log, BAD, LOG_ERROR, &text);
        return NULL;
    }
    Instance *m = instantiate(log, guid, resources, 0);
    if (m) m->now.exchange = 1;
    return m;
}

#if HAS_EXCHANGE
static int not_finite(const Instance *m, const char *name, double value) {
    Text text = {0};
    add(&text, "%s = ", name);
    add_exact(&text, value);
    return fail(m, "%s, allowed: a finite number", text.text);
}

/* What the kernels need of the time is settled in event mode: the present values stay. Or they have a
   place for it in what is discrete, and behind it 1 if it counts. */
int set_time(Instance *m, double t) {
    if (!is_finite(t)) return not_finite(m, "time", t);
    m->now.time = t;
#if TIME_AT
    double *now = &m->now.discrete[TIME_AT];
    if (now[1] != 0.0 && now[0] != t) {
        m->now.dirty = 1;
        m->now.latch = m->unsolved = 0;
    }
    now[0] = t;
#endif
    return GOOD;
}

static int as_many(const Instance *m, int call, size_t n, size_t there) {
    if (n == there) return 1;
    fail(m, "%s: %lu values, allowed: %lu", CALLS[call].name, (unsigned long)n, (unsigned long)there);
    return 0;
}

/* A solver may try states that are no numbers: it has to take a shorter step. */
int set_continuous(Instance *m, int call, const double *states, size_t n) {
    if (!as_many(m, call, n, NCONT) || is_missing(m, call, states, n)) return BAD;
    for (int i = 0; i < NCONT; i++) {
        if (is_finite(states[i])) continue;
        not_finite(m, CONTINUOUS_STATES[i].name, states[i]);
        return DISCARD;
    }
    if (NCONT > 0 && memcmp(m->now.cont, states, NCONT * sizeof *states) == 0) return GOOD;
    memcpy(m->now.cont, states, NCONT * sizeof *states);
    m->now.dirty = 1;
    m->now.latch = m->unsolved = 0;
    return GOOD;
}

/* States, derivatives or indicators: `from`, an array of the instance of `there` numbers. */
int get_exchanged(Instance *m, int call, const double *from, size_t there, double *to, size_t n) {
    if (!as_many(m, call, n, there) || is_missing(m, call, to, n)) return BAD;
    if (from != m->now.cont && refresh(m)) return m->now.mode == CONTINUOUS ? DISCARD : BAD;
    if (n > 0) memcpy(to, from, n * sizeof *to);
    return GOOD;
}

int get_nominals(Instance *m, int call, double *nominals, size_t n) {
    if (!as_many(m, call, n, NCONT) || is_missing(m, call, nominals, n)) return BAD;
    for (int i = 0; i < NCONT; i++) nominals[i] = CONTINUOUS_STATES[i].nominal;
    return GOOD;
}

int enter_event_mode(Instance *m) {
    m->now.mode = EXCHANGE_EVENTS;
    return GOOD;
}

int update_discrete(Instance *m, double *next) {
    Snap *s = &m->now;
    if (refresh(m) || update_exchange(m) || refresh(m)) return BAD;
    if (N_SWITCHES > 0) tell_switches(m);
    tell_advice(m);
    *next = NMODE > 0 && s->discrete[0] > s->time ? s->discrete[0] : DBL_MAX;
    return GOOD;
}

/* What is kept is kept here and at events: what is tried and rejected leaves no trace. */
int complete_step(Instance *m) { return refresh(m) == GOOD && finish_step(m) == GOOD ? GOOD : BAD; }
#else
int set_time(Instance *m, double t) { return (void)m, (void)t, BAD; }

int set_continuous(Instance *m, int call, const double *states, size_t n) {
    return (void)m, (void)call, (void)states, (void)n, BAD;
}

int get_exchanged(Instance *m, int call, const double *from, size_t there, double *to, size_t n) {
    return (void)m, (void)call, (void)from, (void)there, (void)to, (void)n, BAD;
}

int get_nominals(Instance *m, int call, double *nominals, size_t n) {
    return (void)m, (void)call, (void)nominals, (void)n, BAD;
}

int enter_event_mode(Instance *m) { return (void)m, BAD; }

int update_discrete(Instance *m, double *next) { return (void)m, (void)next, BAD; }

int complete_step(Instance *m) { return (void)m, BAD; }
#endif
