/* FMI 2.0 model exchange, translated. */
#include <float.h>

#include "fmi2_shell.h"

fmi2Status fmi2EnterEventMode(fmi2Component c) {
    ENTER(fmi2EnterEventMode);
    return (fmi2Status)enter_event_mode(m);
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *eventInfo) {
    double next = 0.0;
    ENTER(fmi2NewDiscreteStates);
    NEED(fmi2NewDiscreteStates, eventInfo, 1);
    const fmi2EventInfo nothing = {fmi2False, fmi2False, fmi2False, fmi2False, fmi2False, 0.0};
    *eventInfo = nothing;
    if (update_discrete(m, &next)) return fmi2Error;
    eventInfo->nextEventTimeDefined = next < DBL_MAX;
    eventInfo->nextEventTime = next; /* OpenModelica reads it in any case */
    return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
    ENTER(fmi2EnterContinuousTimeMode);
    m->now.mode = CONTINUOUS;
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation) {
    (void)noSetFMUStatePriorToCurrentPoint; /* going back is always possible */
    ENTER(fmi2CompletedIntegratorStep);
    if (enterEventMode) *enterEventMode = fmi2False;
    if (terminateSimulation) *terminateSimulation = fmi2False;
    return (fmi2Status)complete_step(m);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
    ENTER(fmi2SetTime);
    return (fmi2Status)set_time(m, time);
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx) {
    ENTER(fmi2SetContinuousStates);
    return (fmi2Status)set_continuous(m, CALL_fmi2SetContinuousStates, x, nx);
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx) {
    ENTER(fmi2GetDerivatives);
    return (fmi2Status)get_exchanged(m, CALL_fmi2GetDerivatives, m->now.der, NCONT, derivatives, nx);
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni) {
    ENTER(fmi2GetEventIndicators);
    return (fmi2Status)get_exchanged(m, CALL_fmi2GetEventIndicators, m->now.sign, NSIGN, eventIndicators, ni);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx) {
    ENTER(fmi2GetContinuousStates);
    return (fmi2Status)get_exchanged(m, CALL_fmi2GetContinuousStates, m->now.cont, NCONT, x, nx);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx) {
    ENTER(fmi2GetNominalsOfContinuousStates);
    return (fmi2Status)get_nominals(m, CALL_fmi2GetNominalsOfContinuousStates, x_nominal, nx);
}
