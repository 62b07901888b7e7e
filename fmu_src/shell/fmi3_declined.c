/* FMI 3.0: the functions that co-simulation here does not need. Each says why it does nothing. */
#include "fmi3_shell.h"

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    ENTER(fmi3EnterEventMode);
    return fmi3Error;
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    ENTER(fmi3EnterStepMode);
    return fmi3Error;
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
    ENTER(fmi3EvaluateDiscreteStates);
    return fmi3Error;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation, fmi3Boolean
                                    *nominalsOfContinuousStatesChanged, fmi3Boolean
                                    *valuesOfContinuousStatesChanged, fmi3Boolean
                                    *nextEventTimeDefined, fmi3Float64 *nextEventTime) {
    (void)discreteStatesNeedUpdate, (void)terminateSimulation,
    (void)nominalsOfContinuousStatesChanged, (void)valuesOfContinuousStatesChanged,
    (void)nextEventTimeDefined, (void)nextEventTime;
    ENTER(fmi3UpdateDiscreteStates);
    return fmi3Error;
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
    ENTER(fmi3EnterConfigurationMode);
    return fmi3Error;
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
    ENTER(fmi3ExitConfigurationMode);
    return fmi3Error;
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference
                                  valueReferences[], size_t nValueReferences, fmi3Float64
                                  intervals[], fmi3IntervalQualifier qualifiers[]) {
    (void)valueReferences, (void)nValueReferences, (void)intervals, (void)qualifiers;
    ENTER(fmi3GetIntervalDecimal);
    return fmi3Error;
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference
                                   valueReferences[], size_t nValueReferences, fmi3UInt64
                                   counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier
                                   qualifiers[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions,
    (void)qualifiers;
    ENTER(fmi3GetIntervalFraction);
    return fmi3Error;
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, fmi3Float64 shifts[]) {
    (void)valueReferences, (void)nValueReferences, (void)shifts;
    ENTER(fmi3GetShiftDecimal);
    return fmi3Error;
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference
                                valueReferences[], size_t nValueReferences, fmi3UInt64
                                counters[], fmi3UInt64 resolutions[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    ENTER(fmi3GetShiftFraction);
    return fmi3Error;
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference
                                  valueReferences[], size_t nValueReferences, const fmi3Float64
                                  intervals[]) {
    (void)valueReferences, (void)nValueReferences, (void)intervals;
    ENTER(fmi3SetIntervalDecimal);
    return fmi3Error;
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference
                                   valueReferences[], size_t nValueReferences, const fmi3UInt64
                                   counters[], const fmi3UInt64 resolutions[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    ENTER(fmi3SetIntervalFraction);
    return fmi3Error;
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, const fmi3Float64 shifts[]) {
    (void)valueReferences, (void)nValueReferences, (void)shifts;
    ENTER(fmi3SetShiftDecimal);
    return fmi3Error;
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference
                                valueReferences[], size_t nValueReferences, const fmi3UInt64
                                counters[], const fmi3UInt64 resolutions[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    ENTER(fmi3SetShiftFraction);
    return fmi3Error;
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
                                      fmi3Float64 activationTime) {
    (void)clockReference, (void)activationTime;
    ENTER(fmi3ActivateModelPartition);
    return fmi3Error;
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
    ENTER(fmi3EnterContinuousTimeMode);
    return fmi3Error;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean
                                       noSetFMUStatePriorToCurrentPoint, fmi3Boolean
                                       *enterEventMode, fmi3Boolean *terminateSimulation) {
    (void)noSetFMUStatePriorToCurrentPoint, (void)enterEventMode, (void)terminateSimulation;
    ENTER(fmi3CompletedIntegratorStep);
    return fmi3Error;
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
    (void)time;
    ENTER(fmi3SetTime);
    return fmi3Error;
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
    (void)continuousStates, (void)nContinuousStates;
    ENTER(fmi3SetContinuousStates);
    return fmi3Error;
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[],
                                             size_t nContinuousStates) {
    (void)derivatives, (void)nContinuousStates;
    ENTER(fmi3GetContinuousStateDerivatives);
    return fmi3Error;
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[], size_t
                                  nEventIndicators) {
    (void)eventIndicators, (void)nEventIndicators;
    ENTER(fmi3GetEventIndicators);
    return fmi3Error;
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[], size_t
                                   nContinuousStates) {
    (void)continuousStates, (void)nContinuousStates;
    ENTER(fmi3GetContinuousStates);
    return fmi3Error;
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[],
                                             size_t nContinuousStates) {
    (void)nominals, (void)nContinuousStates;
    ENTER(fmi3GetNominalsOfContinuousStates);
    return fmi3Error;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators) {
    (void)nEventIndicators;
    ENTER(fmi3GetNumberOfEventIndicators);
    return fmi3Error;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates) {
    (void)nContinuousStates;
    ENTER(fmi3GetNumberOfContinuousStates);
    return fmi3Error;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference
                                    valueReferences[], size_t nValueReferences, const fmi3Int32
                                    orders[], fmi3Float64 values[], size_t nValues) {
    (void)valueReferences, (void)nValueReferences, (void)orders, (void)values, (void)nValues;
    ENTER(fmi3GetOutputDerivatives);
    return fmi3Error;
}
