/* FMI 2.0 co-simulation: life and steps, translated. */
#include <string.h>

#include "fmi2_shell.h"

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

/* The text is the format, its % doubled: some hosts take no arguments behind it. */
static void send_message(const Log *log, int status, const char *category, const char *text) {
    ((fmi2CallbackLogger)log->logger)(log->environment, log->name, (fmi2Status)status, category, text);
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean loggingOn) {
    (void)visible; /* there is nothing to see */
    Log log = {0};
    log.send = send_message;
    if (functions) {
        log.logger = (void (*)(void))functions->logger;
        log.environment = functions->componentEnvironment;
    }
    name_log(&log, instanceName, loggingOn, 2);
    if (fmuType != fmi2CoSimulation) return instantiate_exchange(&log, fmuGUID, fmuResourceLocation);
    return instantiate(&log, fmuGUID, fmuResourceLocation, 0);
}

void fmi2FreeInstance(fmi2Component c) { free_instance(c); }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
    ENTER(fmi2SetDebugLogging);
    NEED(fmi2SetDebugLogging, categories, nCategories);
    return (fmi2Status)choose_categories(m, loggingOn, nCategories, categories);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance,
                               fmi2Real startTime, fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
    (void)toleranceDefined, (void)tolerance; /* the solver's tolerance is that of its tests */
    (void)stopTimeDefined, (void)stopTime;
    ENTER(fmi2SetupExperiment);
    return (fmi2Status)begin(m, startTime);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    ENTER(fmi2EnterInitializationMode);
    m->now.mode = INITIALIZING;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    ENTER(fmi2ExitInitializationMode);
    return (fmi2Status)leave_initialization(m);
}

fmi2Status fmi2Terminate(fmi2Component c) {
    ENTER(fmi2Terminate);
    m->now.mode = TERMINATED;
    tell_counts(m);
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c) {
    ENTER(fmi2Reset);
    return (fmi2Status)reset(m);
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
    (void)noSetFMUStatePriorToCurrentPoint; /* going back is always possible */
    ENTER(fmi2DoStep);
    m->last_step = advance(m, currentCommunicationPoint, communicationStepSize);
    return (fmi2Status)m->last_step;
}

fmi2Status fmi2CancelStep(fmi2Component c) {
    ENTER(fmi2CancelStep);
    return fmi2Error;
}

/* Status: no step is ever pending, and none ends the run. */

static fmi2Status not_asked(Instance *m, const char *name, const char *kinds) {
    return (fmi2Status)fail(m, "%s: there is no such status, allowed: %s", name, kinds);
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value) {
    ENTER(fmi2GetStatus);
    NEED(fmi2GetStatus, value, 1);
    if (s != fmi2DoStepStatus) return not_asked(m, "fmi2GetStatus", "fmi2DoStepStatus");
    *value = (fmi2Status)m->last_step;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value) {
    ENTER(fmi2GetRealStatus);
    NEED(fmi2GetRealStatus, value, 1);
    if (s != fmi2LastSuccessfulTime) {
        return not_asked(m, "fmi2GetRealStatus", "fmi2LastSuccessfulTime");
    }
    *value = m->now.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value) {
    (void)s, (void)value;
    ENTER(fmi2GetIntegerStatus);
    return not_asked(m, "fmi2GetIntegerStatus", "none");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value) {
    ENTER(fmi2GetBooleanStatus);
    NEED(fmi2GetBooleanStatus, value, 1);
    if (s != fmi2Terminated) return not_asked(m, "fmi2GetBooleanStatus", "fmi2Terminated");
    *value = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value) {
    ENTER(fmi2GetStringStatus);
    NEED(fmi2GetStringStatus, value, 1);
    if (s != fmi2PendingStatus) {
        return not_asked(m, "fmi2GetStringStatus", "fmi2PendingStatus");
    }
    *value = "no step is pending";
    return fmi2OK;
}
