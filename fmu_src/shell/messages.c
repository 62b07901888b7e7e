/* What is said about a run: where it failed, what was refused, what happened. */
#include <string.h>

#include "shell.h"

const StatusText *status_text(int32_t status) {
    int worst = 0;
    for (int i = 0; i < N_STATUSES; i++) {
        if (STATUSES[i].number == status) return &STATUSES[i];
        if (STATUSES[i].number == STATUS_NOT_FINITE) worst = i;
    }
    return &STATUSES[worst]; /* a defect of the kernel */
}

/* The point in words: the inputs, and the outputs chosen for events. */
static void add_point(Text *t, const Instance *m, int with_outputs) {
    static const int shown[] = POINT;
    for (int i = 0; shown[i] >= 0; i++) {
        const Variable *v = &VARIABLES[shown[i]];
        if (v->cause == CAUSE_OUTPUT && !with_outputs) continue;
        if (i > 0) add(t, ", ");
        add_quantity(t, v, value_of(m, v));
    }
}

/* The beginning of a sentence: the part and a time [s]. Where nobody listens it takes no words. */
static Text begun(const Instance *m, double time) {
    Text text = {0};
    text.is_full = !m->log.logger;
    add(&text, "%s at t = ", m->part.name);
    add_number(&text, time);
    return text;
}

void tell_failure(const Instance *m, int32_t status, double t, double h) {
    Text text = begun(m, t);
    add(&text, " s, ");
    if (h > 0.0) {
        add(&text, "step ");
        add_number(&text, h);
        add(&text, " s, ");
    }
    add_point(&text, m, 0);
    add(&text, ": %s: %s", status_text(status)->name, status_text(status)->advice);
    tell(&m->log, BAD, LOG_ERROR, &text);
}

static void add_parameter(Text *t, const Instance *m, const char *name, size_t length) {
    for (int i = 0; i < N_VARIABLES; i++) {
        const Variable *v = &VARIABLES[i];
        if (strlen(v->name) != length || memcmp(v->name, name, length) != 0) continue;
        double value = value_of(m, v);
        if (v->type == TYPE_ENUMERATION) {
            add(t, "'%s'", ENUMERATIONS[v->enumeration].items[(int)value - 1].name);
        } else if (v->type == TYPE_BOOLEAN) {
            add(t, value != 0.0 ? "True" : "False");
        } else if (v->type == TYPE_INTEGER) {
            add(t, "%d", (int)value);
        } else {
            add_exact(t, value);
        }
    }
}

/* The rule's text, with the values of the parameters named in braces. */
void tell_rule(const Instance *m, const char *rule) {
    Text text = {0};
    while (*rule) {
        const char *open = strchr(rule, '{'), *close = open ? strchr(open, '}') : NULL;
        if (!close) {
            add(&text, "%s", rule);
            break;
        }
        add(&text, "%.*s", (int)(open - rule), rule);
        add_parameter(&text, m, open + 1, (size_t)(close - open - 1));
        rule = close + 1;
    }
    tell(&m->log, BAD, LOG_ERROR, &text);
}

static void add_range(Text *t, const Variable *v, double low, double high) {
    add_number(t, low);
    add(t, " .. ");
    add_number(t, high);
    if (strcmp(v->unit, "1") != 0) add(t, " %s", v->unit);
}

/* What is said of a number of a fidelity that is gone, or NULL. */
static const char *gone(const Variable *v, double number) {
    for (int i = 0; v->store == STORE_PAR && v->slot == LEVEL && i < N_GONE_LEVELS; i++) {
        if (GONE_LEVELS[i].number == number) return GONE_LEVELS[i].name;
    }
    return NULL;
}

static void add_allowed(Text *t, const Variable *v) {
    if (v->enumeration >= 0) {
        const Enumeration *e = &ENUMERATIONS[v->enumeration];
        const char *between = "";
        for (int i = 0; i < e->n; i++) {
            if (gone(v, e->items[i].number)) continue;
            add(t, "%s%d (%s)", between, (int)e->items[i].number, e->items[i].name);
            between = ", ";
        }
        return;
    }
    add_range(t, v, v->low, v->high);
}

static void add_reason(Text *t, const Variable *v, double value) {
    add_quantity(t, v, value);
    add(t, " is outside ");
    add_allowed(t, v);
    add(t, "; the value is not taken over.");
    double kelvin = value + 273.15;
    if (strcmp(v->unit, "K") == 0 && !v->relative && is_inside(v, kelvin)) {
        add(t, " Did you mean ");
        add_number(t, kelvin);
        add(t, " K (");
        add_number(t, value);
        add(t, " degC)?");
    }
}

/* Why a value is not taken over; kept, for the steps that will not run without it. */
void tell_refusal(Instance *m, const Variable *v, double value) {
    Text text = {0};
    if (v->cause != CAUSE_INPUT && v->cause != CAUSE_PARAMETER) {
        add(&text, "%s is an %s variable; it cannot be set", v->name,
            v->cause == CAUSE_OUTPUT  ? "output"
            : v->cause == CAUSE_LOCAL ? "internal"
                                      : "independent");
    } else if (!may_set(m, v)) {
        add(&text, "%s is a fixed parameter%s; it can be set before the initialization ends", v->name,
            v->tunable ? " with fidelity 'map', made for one value" : "");
    } else {
        add_reason(&text, v, value);
    }
    memcpy(m->refusal, text.text, sizeof m->refusal);
    tell(&m->log, BAD, LOG_ERROR, &text);
}

/* Warn once that time jumps, unless by a rounding error of the host's time. A host may count in single
   precision: then the last 29 bits of its times are 0. */
void tell_late_step(Instance *m, double t, double h, double expected) {
    uint64_t bits;
    memcpy(&bits, &t, sizeof bits);
    const double spacing = bits & 0x1fffffffu ? 0x1p-52 : 0x1p-23;
    const double latest = size_of(t) > size_of(expected) ? size_of(t) : size_of(expected);
    if (m->told_late || size_of(t - expected) <= 1e-6 * h + 4.0 * spacing * latest) return;
    m->told_late = 1;
    Text text = {0};
    add(&text, "step from t = ");
    add_exact(&text, t);
    add(&text, " s, but the last one ended at ");
    add_exact(&text, expected);
    add(&text, " s; the host's time counts, and this is said once");
    tell(&m->log, WARNING, LOG_WARNING, &text);
}

/* Warn once that the step [s] is longer than both the description's and the one the unit would have. */
void tell_long_step(Instance *m, double h) {
    const double advised = m->now.solution.out[AT_LEAST_ONE(ADVISED + 1) - 1];
    if (m->told_long || !(advised > 0.0) || h <= advised || h <= (1.0 + 1e-6) * m->part.step) return;
    m->told_long = 1;
    Text text = begun(m, m->now.time);
    add(&text, " s: the step of ");
    add_number(&text, h);
    add(&text, " s is longer than advised_step = ");
    add_number(&text, advised);
    add(&text, " s and than that of the description, ");
    add_number(&text, m->part.step);
    add(&text, " s; shorten the host's step; this is said once");
    tell(&m->log, WARNING, LOG_WARNING, &text);
}

/* Warn once of an input at 0 K. */
void tell_no_temperature(Instance *m, const Variable *v) {
    if (m->told_zero[v->slot]) return;
    m->told_zero[v->slot] = 1;
    Text text = begun(m, m->now.time);
    add(&text, " s: %s = 0 K, as some hosts set an input that is not connected: ", v->name);
    add_number(&text, value_of(m, v));
    add(&text, " K, its last value, stays; connect it to a constant; this is said once");
    tell(&m->log, WARNING, LOG_WARNING, &text);
}

/* One sentence for each event since the last communication point. */
void tell_switches(Instance *m) {
    for (int i = 0; i < N_SWITCHES; i++) {
        const Switch *s = &SWITCHES[i];
        int32_t now = m->now.solution.iout[s->slot];
        if (now == m->now.seen[i]) continue;
        m->now.seen[i] = now;
        if (!m->log.on[LOG_EVENTS] && !m->log.on[LOG_ALL]) continue;
        Text text = begun(m, m->now.time);
        add(&text, " s: %s; ", now ? s->on : s->off);
        add_point(&text, m, 1);
        tell(&m->log, GOOD, LOG_EVENTS, &text);
    }
}

/* What the last solve took. */
void tell_effort(const Instance *m) {
    Text text = begun(m, m->now.time);
    add(&text, " s");
    for (int i = 0; i < N_COUNTS; i++) {
        add(&text, ", %s: ", COUNTS[i].text);
        add_number(&text, m->work[COUNTS[i].place]);
    }
    tell(&m->log, GOOD, LOG_SOLVER, &text);
}

static int holds(const Instance *m, const Condition *c) {
    if (c->by < 0) return 0;
    const double value = value_of(m, &VARIABLES[c->by]);
    switch (c->relation) {
    case RELATION_IS: return value == c->value;
    case RELATION_IS_NOT: return value != c->value;
    case RELATION_ABOVE: return value > c->value;
    default: return value >= c->value;
    }
}

static int is_used(const Instance *m, int parameter) {
    int is_one = -1; /* of the conditions one of which is enough; -1: there are none */
    for (int i = 0; i < N_CONDITIONS; i++) {
        const Condition *c = &CONDITIONS[i];
        if (c->parameter != parameter) continue;
        int is_met = holds(m, c) && (!c->follows || is_used(m, c->by));
        if (c->required && !is_met) return 0;
        if (!c->required && is_one != 1) is_one = is_met;
    }
    return is_one != 0;
}

static void add_setting(Text *t, const Instance *m, const Variable *v) {
    const double value = value_of(m, v);
    if (v->type == TYPE_ENUMERATION) {
        add(t, "%s = %s", v->name, ENUMERATIONS[v->enumeration].items[(int)value - 1].name);
    } else if (v->type == TYPE_BOOLEAN) {
        add(t, "%s = %s", v->name, value != 0.0 ? "true" : "false");
    } else {
        add_quantity(t, v, value);
    }
}

/* The values that keep a parameter from being used; `last`: the parameter named before, or -1. */
static void add_causes(Text *t, const Instance *m, int parameter, int *last) {
    int is_required = 0; /* those that are required come first; they are enough */
    for (int i = 0; i < N_CONDITIONS; i++) {
        const Condition *c = &CONDITIONS[i];
        if (c->parameter != parameter || c->by < 0 || (is_required && !c->required)) continue;
        const int is_held = holds(m, c);
        if (is_held ? !c->follows || is_used(m, c->by) : c->by == parameter) continue;
        is_required |= c->required;
        if (is_held) {
            add_causes(t, m, c->by, last);
        } else if (c->by != *last) {
            add(t, "%s", *last < 0 ? ": " : ", ");
            add_setting(t, m, &VARIABLES[c->by]);
            *last = c->by;
        }
    }
}

/* Say once which parameters were set away from their starts and are not used. */
static void tell_unused(const Instance *m) {
    enum { MOST = 6 };
    int n = 0;
    Text text = begun(m, m->now.time);
    add(&text, " s");
    for (int i = 0; i < N_VARIABLES; i++) {
        const Variable *v = &VARIABLES[i];
        if (v->store != STORE_PAR || value_of(m, v) == m->part.starts[i] || is_used(m, i)) continue;
        if (++n > MOST) continue;
        int last = -1;
        add(&text, "%s", n > 1 ? "; " : ": ");
        add_setting(&text, m, v);
        add(&text, " is not used");
        add_causes(&text, m, i, &last);
    }
    if (n > MOST) add(&text, "; and %d more", n - MOST);
    if (n > 0) tell(&m->log, WARNING, LOG_WARNING, &text);
}

/* Whether an input is outside a range of its own: k = 0 the part's box, 1 what was verified. */
static int is_beyond(const Instance *m, const Variable *v, int k) {
    const double *range = m->part.ranges[k][v->slot];
    const double near = within(range[0], range[1], m->now.inp[v->slot]);
    return near < range[0] || near > range[1];
}

/* Whether all inputs are inside both of their ranges, the usual case. */
static int are_inside(const Instance *m) {
    for (int i = 0; i < NINP; i++) {
        if (!(m->both[i][0] <= m->now.inp[i] && m->now.inp[i] <= m->both[i][1])) return 0;
    }
    return 1;
}

/* Warn once in a run of an input that leaves a range of its own, and count how often it does. */
static void tell_ranges(Instance *m, int k) {
    static const char *const
        begin[] = {"", "OUTSIDE_VERIFIED: "},
        *const end[] = {
            "the part's box: solved all the same, but it is not what the part is meant for; change the "
            "input, or [box] in the part file",
            "for which the accuracy was verified; use with care"};
    for (int i = 1; VARIABLES[i].store == STORE_INP; i++) { /* the first variables after time */
        const Variable *v = &VARIABLES[i];
        const int was_beyond = m->beyond[k][v->slot];
        m->beyond[k][v->slot] = (uint8_t)is_beyond(m, v, k);
        if (was_beyond || !m->beyond[k][v->slot] || m->left[k][v->slot]++) continue;
        Text text = begun(m, m->now.time);
        add(&text, " s: %s", begin[k]);
        add_quantity(&text, v, m->now.inp[v->slot]);
        add(&text, " is outside ");
        add_range(&text, v, m->part.ranges[k][v->slot][0], m->part.ranges[k][v->slot][1]);
        add(&text, ", %s", end[k]);
        tell(&m->log, WARNING, LOG_WARNING, &text);
    }
}

/* The numbers that belong to a status, or NULL: it has none here. */
static const Figure *figure_of(const Instance *m, int32_t status) {
    for (int i = 0; i < N_FIGURES; i++) {
        const Figure *f = &FIGURES[i];
        if (f->status == status && m->work[W_TOLD + f->when] > 0.0) return f;
    }
    return NULL;
}

static void add_figure(Text *t, const Instance *m, const Figure *f) {
    for (const char *c = f->text; *c; c++) {
        if (*c != '{') {
            add(t, "%c", *c);
            continue;
        }
        add_number(t, m->work[W_TOLD + (c[1] - '0')]);
        c += 2;
    }
    add(t, "; ");
}

/* Whether a status is to be told: once in a run, one with figures once in an engagement. */
static int is_news(Instance *m, int32_t status, const Figure *f) {
    const double engaged = m->engaged[status], now = f ? m->work[W_TOLD + TOLD_ENGAGEMENT] : engaged;
    const int first = !m->cared[status]++;
    m->engaged[status] = now;
    return first || now != engaged;
}

/* Warn once when the solution begins to need care for a reason, the gravest first; what cools down to
 * HOT was told that before. */
static void __attribute__((noinline)) tell_news(Instance *m, int32_t status) {
    for (int i = 0; m->warned < 0 && i < N_GONE_LEVELS; i++) {
        if (GONE_LEVELS[i].number != m->now.par[LEVEL]) continue;
        Text text = begun(m, m->now.time);
        add(&text, " s: %s", GONE_LEVELS[i].name);
        tell(&m->log, WARNING, LOG_WARNING, &text);
    }
    if (m->warned < 0) tell_unused(m);
    int unverified = 0;
    for (int i = 1; VARIABLES[i].store == STORE_INP; i++) unverified |= is_beyond(m, &VARIABLES[i], 1);
    int told = status == m->warned || (status == STATUS_OUTSIDE_VERIFIED && unverified)
               || (status == STATUS_HOT && m->warned == STATUS_EXTRAPOLATED);
    m->warned = status;
    const Figure *figure = figure_of(m, status);
    if (!told && status > STATUS_OK && status < FIRST_FAILURE && is_news(m, status, figure)) {
        Text text = begun(m, m->now.time);
        add(&text, " s: %s: %s; ", status_text(status)->name, status_text(status)->advice);
        if (figure) add_figure(&text, m, figure);
        add_point(&text, m, 1);
        tell(&m->log, WARNING, LOG_WARNING, &text);
    }
    for (int k = 1; k >= 0; k--) tell_ranges(m, k);
}

void tell_advice(Instance *m) {
    int32_t status = IO_STATUS < 0 ? 0 : m->now.solution.iout[AT_LEAST_ONE(IO_STATUS + 1) - 1];
    if (m->now.latch) status = m->now.latch;
    if (status == m->warned && are_inside(m)) { /* nothing is new */
        memset(m->beyond, 0, sizeof m->beyond);
        return;
    }
    tell_news(m, status);
}

static void tell_count(const Instance *m, const char *what, const char *name, uint32_t n) {
    Text text = {0};
    if (n < 2) return;
    add(&text, "%s: %s%s %lu times in this run; the first is told above", m->part.name, name, what,
        (unsigned long)n);
    tell(&m->log, WARNING, LOG_WARNING, &text);
}

/* At the end of a run: how often it was as was warned of once. */
void tell_counts(const Instance *m) {
    static const char *const what[] = {" left the part's box", " left the verified range"};
    for (int i = STATUS_OK + 1; i < FIRST_FAILURE; i++) {
        tell_count(m, "", status_text(i)->name, m->cared[i]);
    }
    for (int k = 1; k >= 0; k--) {
        for (int i = 1; VARIABLES[i].store == STORE_INP; i++) {
            tell_count(m, what[k], VARIABLES[i].name, m->left[k][VARIABLES[i].slot]);
        }
    }
}
