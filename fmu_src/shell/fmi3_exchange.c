/* FMI 3.0 model exchange, translated. */
#include "fmi3_shell.h"

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
    ENTER(fmi3EnterContinuousTimeMode);
    m->now.mode = CONTINUOUS;
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation) {
    (void)noSetFMUStatePriorToCurrentPoint; /* going back is always possible */
    ENTER(fmi3CompletedIntegratorStep);
    if (enterEventMode) *enterEventMode = fmi3False;
    if (terminateSimulation) *terminateSimulation = fmi3False;
    return (fmi3Status)complete_step(m);
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
    ENTER(fmi3SetTime);
    return (fmi3Status)set_time(m, time);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
    ENTER(fmi3SetContinuousStates);
    return (fmi3Status)set_continuous(m, CALL_fmi3SetContinuousStates, continuousStates, nContinuousStates);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[],
                                             size_t nContinuousStates) {
    ENTER(fmi3GetContinuousStateDerivatives);
    return (fmi3Status)get_exchanged(m, CALL_fmi3GetContinuousStateDerivatives, m->now.der, NCONT,
                                     derivatives, nContinuousStates);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[],
                                  size_t nEventIndicators) {
    ENTER(fmi3GetEventIndicators);
    return (fmi3Status)get_exchanged(m, CALL_fmi3GetEventIndicators, m->now.sign, NSIGN, eventIndicators,
                                     nEventIndicators);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
    ENTER(fmi3GetContinuousStates);
    return (fmi3Status)get_exchanged(m, CALL_fmi3GetContinuousStates, m->now.cont, NCONT, continuousStates,
                                     nContinuousStates);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[],
                                             size_t nContinuousStates) {
    ENTER(fmi3GetNominalsOfContinuousStates);
    return (fmi3Status)get_nominals(m, CALL_fmi3GetNominalsOfContinuousStates, nominals, nContinuousStates);
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators) {
    ENTER(fmi3GetNumberOfEventIndicators);
    NEED(fmi3GetNumberOfEventIndicators, nEventIndicators, 1);
    *nEventIndicators = NSIGN;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates) {
    ENTER(fmi3GetNumberOfContinuousStates);
    NEED(fmi3GetNumberOfContinuousStates, nContinuousStates, 1);
    *nContinuousStates = NCONT;
    return fmi3OK;
}
