/* FMI 3.0 co-simulation: life and steps, translated. */
#include <float.h>

#include "fmi3_shell.h"

const char *fmi3GetVersion(void) { return fmi3Version; }

static void send_message(const Log *log, int status, const char *category, const char *text) {
    ((fmi3LogMessageCallback)log->logger)(log->environment, (fmi3Status)status, category, text);
}

static Log open_log(fmi3String name, fmi3Boolean on, fmi3InstanceEnvironment environment,
                    fmi3LogMessageCallback logMessage) {
    Log log = {0};
    log.send = send_message;
    log.logger = (void (*)(void))logMessage;
    log.environment = environment;
    name_log(&log, name, on, 3);
    return log;
}

static fmi3Instance refuse_instance(const Log *log, const char *why) {
    Text text = {0};
    add(&text, "this FMU %s", why);
    tell(log, BAD, LOG_ERROR, &text);
    return NULL;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment,
                                         fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate) {
    (void)visible; /* there is nothing to see */
    const Log log = open_log(instanceName, loggingOn, instanceEnvironment, logMessage);
    const int ends_early = eventModeUsed && earlyReturnAllowed && N_SWITCHES > 0;
    Instance *m = instantiate(&log, instantiationToken, resourcePath, ends_early);
    if (!m) return NULL;
    m->has_events = eventModeUsed != 0;
    if (begin_updates(m, requiredIntermediateVariables, nRequiredIntermediateVariables, intermediateUpdate)) {
        free_instance(m);
        return NULL;
    }
    return m;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
    (void)visible;
    const Log log = open_log(instanceName, loggingOn, instanceEnvironment, logMessage);
    return instantiate_exchange(&log, instantiationToken, resourcePath);
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath, fmi3Boolean visible,
    fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
    fmi3ClockUpdateCallback clockUpdate, fmi3LockPreemptionCallback lockPreemption,
    fmi3UnlockPreemptionCallback unlockPreemption) {
    (void)instantiationToken, (void)resourcePath, (void)visible;
    (void)clockUpdate, (void)lockPreemption, (void)unlockPreemption;
    const Log log = open_log(instanceName, loggingOn, instanceEnvironment, logMessage);
    return refuse_instance(&log, "is for co-simulation, not for scheduled execution");
}

/* Not out of its own callback: the step that called back goes on with the instance. */
void fmi3FreeInstance(fmi3Instance instance) {
    Instance *m = instance;
    if (m && m->now.mode & (UPDATING | UPDATED)) {
        fail(m, "fmi3FreeInstance is not allowed in the callback of a step");
        return;
    }
    free_instance(m);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[]) {
    ENTER(fmi3SetDebugLogging);
    NEED(fmi3SetDebugLogging, categories, nCategories);
    return (fmi3Status)choose_categories(m, loggingOn, nCategories, categories);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined,
                                       fmi3Float64 tolerance, fmi3Float64 startTime,
                                       fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
    (void)toleranceDefined, (void)tolerance; /* the solver's tolerance is that of its tests */
    (void)stopTimeDefined, (void)stopTime;
    ENTER(fmi3EnterInitializationMode);
    if (begin(m, startTime)) return fmi3Error;
    m->now.mode = INITIALIZING;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    ENTER(fmi3ExitInitializationMode);
    if (leave_initialization(m)) return fmi3Error;
    if (m->has_events) m->now.mode = EVENTS;
    return fmi3OK;
}

/* Nothing is left to do in event mode: what changes has changed. It is the place for tunable
   parameters. */
fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    ENTER(fmi3EnterEventMode);
    if (m->now.exchange) return (fmi3Status)enter_event_mode(m);
    if (!m->has_events) {
        return (fmi3Status)fail(m, "fmi3EnterEventMode: the instance was made with eventModeUsed "
                                   "= false");
    }
    m->now.mode = EVENTS;
    return fmi3OK;
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    ENTER(fmi3EnterStepMode);
    m->now.mode = STEPPING;
    return fmi3OK;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation,
                                    fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged,
                                    fmi3Boolean *nextEventTimeDefined, fmi3Float64 *nextEventTime) {
    fmi3Boolean *const flags[] = {discreteStatesNeedUpdate, terminateSimulation,
                                  nominalsOfContinuousStatesChanged, valuesOfContinuousStatesChanged,
                                  nextEventTimeDefined};
    double next = 0.0;
    ENTER(fmi3UpdateDiscreteStates);
    for (int i = 0; i < 5; i++) {
        if (flags[i]) *flags[i] = fmi3False;
    }
    if (!m->now.exchange) return fmi3OK;
    if (update_discrete(m, &next)) return fmi3Error;
    if (nextEventTimeDefined) *nextEventTimeDefined = next < DBL_MAX;
    if (nextEventTime && next < DBL_MAX) *nextEventTime = next;
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
    ENTER(fmi3Terminate);
    m->now.mode = TERMINATED;
    tell_counts(m);
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    ENTER(fmi3Reset);
    return (fmi3Status)reset(m);
}

static void write_flags(fmi3Boolean *event, fmi3Boolean *end, fmi3Boolean *early) {
    if (event) *event = fmi3False;
    if (end) *end = fmi3False;
    if (early) *early = fmi3False;
}

/* What is pointed to is written in every case: hosts read it after errors too. */
fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint,
                      fmi3Float64 communicationStepSize, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                      fmi3Boolean *eventHandlingNeeded, fmi3Boolean *terminateSimulation,
                      fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime) {
    (void)noSetFMUStatePriorToCurrentPoint; /* going back is always possible */
    write_flags(eventHandlingNeeded, terminateSimulation, earlyReturn);
    if (lastSuccessfulTime) {
        const Instance *known = instance;
        *lastSuccessfulTime = known ? known->now.time : currentCommunicationPoint;
    }
    ENTER(fmi3DoStep);
    ask_ahead(m, currentCommunicationPoint, communicationStepSize);
    m->last_step = advance(m, currentCommunicationPoint, communicationStepSize);
    if (lastSuccessfulTime) *lastSuccessfulTime = m->now.time;
    if (m->last_step != GOOD) return (fmi3Status)m->last_step;
    if (eventHandlingNeeded) *eventHandlingNeeded = m->has_events && m->happened;
    if (earlyReturn) *earlyReturn = m->is_early;
    show_end(m);
    return fmi3OK;
}
