/* The functions of FMI 2.0 around pythonfmu's: each looks at the call before Python sees it, and
   at what came of it. What the slave says of values, it logs; a call during which it logged an
   error returns fmi2Error, never fmi2Discard, which masters misread, nor fmi2Fatal. */
#define _GNU_SOURCE
#include "guard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void guard_error(Guard *g, int place, const char *what) {
    guard_say(g, fmi2Error, LOG_ERROR, "%s: %s", CALLS[place].name, what);
}

Guard *guard_enter(fmi2Component c, int place) {
    Guard *g = c;
    const Call *call = &CALLS[place];
    if (!g) return NULL;
    g->failed = 0;
    if (call->declined) {
        guard_say(g, fmi2Error, LOG_ERROR, "%s is not offered: %s", call->name, call->declined);
        return NULL;
    }
    if (g->mode & call->modes) return g;
    const ModeText *now = MODES, *last = &MODES[N_MODES - 1];
    while (now->mode != g->mode) now++;
    /* the way to a mode that allows it: onward, else a new start */
    guard_say(g, fmi2Error, LOG_ERROR, "%s is not allowed in state %s; call %s first", call->name,
              now->name, (call->modes > g->mode ? now : last)->leave);
    return NULL;
}

Guard *guard_enter_python(fmi2Component c, int place) {
    Guard *g = guard_enter(c, place);
    if (!g || (g->inner && guard_pin())) return g;
    guard_error(g, place, g->inner ? "the Python of this process has ended"
                : "the Python side is lost; call fmi2Reset or fmi2FreeInstance");
    return NULL;
}

fmi2Status guard_leave(Guard *g, fmi2Status status, int place) {
    if (status == fmi2Fatal) g->inner = NULL; /* pythonfmu has released it, once too often even */
    if (status > fmi2Warning && !g->failed) guard_error(g, place, "failed");
    return status > fmi2Warning || g->failed ? fmi2Error : fmi2OK;
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

static void forget(Guard *g) {
    free(g->name);
    free(g->resources);
    free(g);
}

/* Why there can be no instance of this kind. */
static int fits(Guard *g, fmi2Type type, fmi2String guid, char *why) {
    if (type != fmi2CoSimulation)
        snprintf(why, TEXT, "this FMU is for co-simulation, not for model exchange");
    else if (!guid || strcmp(guid, GUID))
        snprintf(why, TEXT, "the description has the identifier %.200s, this library %s; they are "
                 "of different builds, use both from one FMU", guid ? guid : "none", GUID);
    else
        return g->resources != NULL;
    return 0;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                              fmi2String resources, const fmi2CallbackFunctions *callbacks,
                              fmi2Boolean visible, fmi2Boolean logging) {
    char why[TEXT] = "";
    Guard *g = callbacks ? calloc(1, sizeof *g) : NULL;
    if (!g) return NULL;
    g->host = *callbacks;
    g->callbacks = (fmi2CallbackFunctions){guard_pass_on, calloc, free, NULL, g};
    g->name = strdup(name ? name : MODEL_NAME);
    g->resources = guard_path(resources, why);
    g->visible = visible;
    g->wanted = logging ? ~0u : 0u;
    g->mode = INSTANTIATED;
    if (g->name && fits(g, type, guid, why) && (g->inner = guard_start(g, why))) return g;
    if (!*why)
        snprintf(why, TEXT, "the message before says why; this is Python %.*s%s",
                 (int)strcspn(guard_version(), " "), guard_version(),
                 guard_embeds() ? " started for this FMU: that of python3 on PATH, or the one "
                 "FMU_LIBPYTHON names" : "");
    guard_say(g, fmi2Error, LOG_ERROR, "%s cannot be instantiated: %s", MODEL_NAME, why);
    forget(g);
    return NULL;
}

void fmi2FreeInstance(fmi2Component c) {
    Guard *g = c;
    if (!g) return;
    int alive = guard_pin();
    if (!alive) g->inner = NULL;
    while (g->states) guard_free_state(g, g->states);
    if (g->inner) guard_inner.FreeInstance(g->inner);
    forget(g);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n,
                               const fmi2String categories[]) {
    ENTER(SetDebugLogging);
    NEED(n == 0 || categories, SetDebugLogging, "categories = NULL");
    uint32_t named = 0;
    for (size_t i = 0; i < n; i++) {
        int known = guard_category(categories[i]);
        NEED(known >= 0, SetDebugLogging, "a category is named that the description has not");
        named |= 1u << known;
    }
    if (on) g->wanted = n ? named : ~0u; /* none named: all of them */
    else g->wanted = n ? g->wanted & ~(named | 1u << LOG_ALL) : 0u;
    return fmi2OK;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean with_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean with_stop, fmi2Real stop) {
    ENTER_PYTHON(SetupExperiment);
    fmi2Status status = guard_inner.SetupExperiment(g->inner, with_tolerance, tolerance, start,
                                                    with_stop, stop);
    status = guard_leave(g, status, CALL_fmi2SetupExperiment);
    if (status == fmi2OK) g->time = start;
    return status;
}

/* Do not take "OK" for it: a solution that failed must not pass. */
static fmi2Status solved(Guard *g, fmi2Status status, int place) {
    fmi2Integer value = 0;
    for (fmi2ValueReference vr = 0; status == fmi2OK && !g->failed && vr < N_VARIABLES; vr++)
        if (VARIABLES[vr].store == STORE_IOUT && VARIABLES[vr].slot == IO_STATUS)
            status = guard_inner.GetInteger(g->inner, &vr, 1, &value);
    if (value >= FIRST_FAILURE && !g->failed) guard_error(g, place, "not solved");
    return guard_leave(g, status, place);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    ENTER_PYTHON(EnterInitializationMode);
    fmi2Status status = guard_leave(g, guard_inner.EnterInitializationMode(g->inner),
                                    CALL_fmi2EnterInitializationMode);
    if (status == fmi2OK) g->mode = INITIALIZING;
    return status;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    ENTER_PYTHON(ExitInitializationMode);
    fmi2Status status = solved(g, guard_inner.ExitInitializationMode(g->inner),
                               CALL_fmi2ExitInitializationMode);
    if (status == fmi2OK) g->mode = STEPPING;
    return status;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean no_going_back) {
    ENTER_PYTHON(DoStep);
    g->last_step = solved(g, guard_inner.DoStep(g->inner, t, h, no_going_back), CALL_fmi2DoStep);
    if (g->last_step == fmi2OK) g->time = t + h;
    return g->last_step;
}

fmi2Status fmi2Terminate(fmi2Component c) {
    ENTER_PYTHON(Terminate);
    fmi2Status status = guard_leave(g, guard_inner.Terminate(g->inner), CALL_fmi2Terminate);
    if (status == fmi2OK) g->mode = TERMINATED;
    return status;
}

fmi2Status fmi2Reset(fmi2Component c) {
    ENTER(Reset);
    char why[TEXT] = "";
    fmi2Status status = fmi2OK;
    if (g->inner && guard_pin()) status = guard_inner.Reset(g->inner);
    else if (!(g->inner = guard_start(g, why))) guard_error(g, CALL_fmi2Reset, why);
    status = guard_leave(g, status, CALL_fmi2Reset);
    if (status == fmi2OK) {
        g->mode = INSTANTIATED;
        g->time = 0.0;
        g->last_step = fmi2OK;
    }
    return status;
}
