/* The lifecycle of an instance: from its start values over initialization to steps. */
#include <string.h>

#include "kernel.h"
#include "shell.h"

int reset(Instance *m) {
    const uint8_t exchange = m->now.exchange;
    memset(&m->now, 0, sizeof m->now);
    m->now.exchange = exchange;
    m->now.mode = INSTANTIATED;
    m->now.dirty = 1;
    memset(m->beyond, 0, sizeof m->beyond);
    memset(m->left, 0, sizeof m->left);
    memset(m->cared, 0, sizeof m->cared);
    memset(m->engaged, 0, sizeof m->engaged);
    m->unsolved = m->work_fits = m->last_step = m->table_ready = 0;
    m->happened = m->is_early = 0;
    m->warned = -1;
    m->told_late = m->told_long = 0;
    memset(m->told_zero, 0, sizeof m->told_zero);
    for (int i = 0; i < N_VARIABLES; i++) {
        const Variable *v = &VARIABLES[i];
        if (v->store == STORE_PAR) m->now.par[v->slot] = m->part.starts[i];
        if (v->store == STORE_INP) m->now.inp[v->slot] = m->part.starts[i];
        if (v->store == STORE_OWN) m->now.own[v->slot] = m->part.starts[i];
    }
    return GOOD;
}

/* The host's name is copied: nobody says how long it lives. */
void name_log(Log *log, const char *name, int on, int fmi) {
    log->fmi = fmi;
    size_t n = name ? strlen(name) : 0;
    if (n >= sizeof log->name) n = whole_letters(name, sizeof log->name - 1);
    if (n > 0) memcpy(log->name, name, n);
    log->name[n] = '\0';
    memset(log->on, on != 0, sizeof log->on);
}

/* The only memory an instance takes; NULL, and the reason in the log, if it cannot be. */
Instance *instantiate(const Log *log, const char *guid, const char *resources, int ends_early) {
    const size_t size = sizeof(Instance) + (ends_early ? sizeof(Solution) : 0);
    Instance *m = tw_memory(size);
    if (!m) {
        Text text = {0};
        add(&text, "%lu bytes of memory are wanted and not to be had", (unsigned long)size);
        tell(log, BAD, LOG_ERROR, &text);
        return NULL;
    }
    m->log = *log;
    if (ends_early) m->before = (Solution *)(m + 1);
    if (load_part(m, resources, guid)) {
        tw_free(m);
        return NULL;
    }
    for (int i = 0; i < NINP; i++) {
        const double *box = m->part.ranges[0][i], *verified = m->part.ranges[1][i];
        m->both[i][0] = box[0] < verified[0] ? verified[0] : box[0];
        m->both[i][1] = box[1] < verified[1] ? box[1] : verified[1];
    }
    if (!m->log.name[0]) memcpy(m->log.name, m->part.name, sizeof m->part.name);
    reset(m);
    return m;
}

void free_instance(void *instance) { tw_free(instance); }

/* The way out of a mode towards the modes a function is allowed in: onward, else a new start. */
static const char *way(uint32_t mode, uint32_t allowed) {
    if (mode == STEPPING && allowed & EVENTS) return "EnterEventMode";
    if (mode == EVENTS && allowed & STEPPING) return "EnterStepMode";
    if (mode == CONTINUOUS && allowed & EXCHANGE_EVENTS) return "EnterEventMode";
    if (mode == EXCHANGE_EVENTS && allowed & CONTINUOUS) return "EnterContinuousTimeMode";
    for (int i = 0; i < N_MODES; i++) {
        if (MODES[i].mode == mode && allowed > mode) return MODES[i].leave;
    }
    return MODES[N_MODES - 1].leave;
}

static const char *mode_name(uint32_t mode) {
    for (int i = 0; i < N_MODES; i++) {
        if (MODES[i].mode == mode) return MODES[i].name;
    }
    return "unknown";
}

/* Whether a function is one of the instance's kind of interface: by the modes it is allowed in. */
static int is_for(const Instance *m, uint32_t modes) {
    const int steps = (modes & (STEPPING | EVENTS)) != 0,
              exchanges = (modes & (CONTINUOUS | EXCHANGE_EVENTS)) != 0;
    return steps == exchanges || (m->now.exchange ? exchanges : steps);
}

Instance *enter_slowly(void *instance, int call) {
    Instance *m = instance;
    const Call *c = &CALLS[call];
    if (!m) return NULL;
    if (c->declined) {
        fail(m, "%s is not offered: %s", c->name, c->declined);
        return NULL;
    }
    if (m->now.mode & (UPDATING | UPDATED) && !(c->modes & m->now.mode)) {
        fail(m, "%s is not allowed within intermediateUpdate; return from it first", c->name);
        return NULL;
    }
    if (!is_for(m, c->modes)) {
        fail(m, "%s is not offered: the instance was made for %s", c->name,
             m->now.exchange ? "model exchange, not for co-simulation"
                             : "co-simulation, not for model exchange");
        return NULL;
    }
    if (!(c->modes & m->now.mode)) {
        fail(m, "%s is not allowed in state %s; call fmi%d%s first", c->name, mode_name(m->now.mode),
             (int)m->log.fmi, way(m->now.mode, c->modes));
        return NULL;
    }
    return m;
}

int begin(Instance *m, double start_time) {
    if (!is_finite(start_time)) {
        Text text = {0};
        add(&text, "start time = ");
        add_exact(&text, start_time);
        return fail(m, "%s s, allowed: a finite number", text.text);
    }
    m->now.time = start_time;
    if (RUN_START >= 0) m->now.par[AT_LEAST_ONE(RUN_START + 1) - 1] = start_time; /* profiles count from it */
    return GOOD;
}

static void note_switches(Instance *m) {
    for (int i = 0; i < N_SWITCHES; i++) {
        m->now.seen[i] = m->now.solution.iout[SWITCHES[i].slot];
    }
}

/* Nothing goes on while a value of one of these causalities is missing, and the message is that of
   the newest refusal. */
static int is_complete(Instance *m, const char *what, double t, uint32_t causes) {
    int newest = -1, any = -1;
    for (int i = 0; m->now.n_refused && i < N_VARIABLES; i++) {
        if (!m->now.refused[i] || !(VARIABLES[i].bits & causes)) continue;
        any = i;
        if (m->now.refused[i] == 1) newest = i;
    }
    if (any < 0) return 1;
    m->now.latch = STATUS_BAD_INPUT;
    Text text = {0};
    add(&text, "%s at t = ", what);
    add_number(&text, t);
    if (newest >= 0) {
        add(&text, " s: %s", m->refusal);
    } else {
        add(&text, " s: %s was refused before; set it again", VARIABLES[any].name);
    }
    tell(&m->log, BAD, LOG_ERROR, &text);
    return 0;
}

/* After a failure the mode stays, so that the host may mend a value and try again. */
int leave_initialization(Instance *m) {
    if (!is_complete(m, "no start", m->now.time, CAUSE_BIT(CAUSE_PARAMETER))) return BAD;
    if (m->now.exchange) m->now.dirty = 1; /* states start from the present values */
    if (prepare(m) || refresh(m)) return BAD;
    m->now.mode = m->now.exchange ? EXCHANGE_EVENTS : STEPPING;
    note_switches(m); /* how a run starts is no event */
    tell_advice(m);
    return GOOD;
}

static int is_step(Instance *m, double t, double h) {
    if (is_finite(t) && is_finite(h) && is_finite(t + h) && h > 0.0) return 1;
    Text text = {0};
    add(&text, "step from t = ");
    add_exact(&text, t);
    add(&text, " s by ");
    add_exact(&text, h);
    m->now.latch = STATUS_BAD_INPUT;
    fail(m, "%s s, allowed: finite, step > 0", text.text);
    return 0;
}

/* A step so short that the time stays as it is, as what is left of it at the end of a run: it fails
   where the inputs of now have no solution. */
static int stand_still(Instance *m, double t) {
    memset(m->now.inp + NINP, 0, NINP * sizeof *m->now.inp);
    m->now.time = t;
    m->happened = m->is_early = 0;
    return refresh(m);
}

/* Step from t to t + h, or leave everything as it was but for the status that tells why. */
int advance(Instance *m, double t, double h) {
    if (!is_step(m, t, h) || !is_complete(m, "no step", t, ~0u) || prepare(m)) return BAD;
    const double expected = m->now.time, asked = h;
    if (t + h <= t) return stand_still(m, t);
    int rc = m->before ? follow_to_event(m, t, &h) : follow(m, t, h);
    if (rc) {
        m->now.latch = rc;
        tell_failure(m, rc, t, h);
        return BAD;
    }
    m->now.time = t + h;
    m->now.latch = m->unsolved = 0;
    if (h > 0.0) note_states(m, h);
    tell_late_step(m, t, asked, expected);
    if (ADVISED >= 0) tell_long_step(m, h);
    m->happened = has_changed(m);
    m->is_early = h < asked;
    if (N_SWITCHES > 0) tell_switches(m);
    note_switches(m);
    if (N_COUNTS > 0 && (m->log.on[LOG_SOLVER] || m->log.on[LOG_ALL])) tell_effort(m);
    tell_advice(m);
    return GOOD;
}
