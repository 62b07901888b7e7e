/* FMI 3.0: the functions that co-simulation here does not need. Each says why it does nothing. */
#include "fmi3_shell.h"

#pragma GCC diagnostic ignored "-Wunused-parameter" /* clang knows it by this name too */

#define DECLINE(Name, ...)               \
    fmi3Status fmi3##Name(__VA_ARGS__) { \
        ENTER(fmi3##Name);               \
        return fmi3Error;                \
    }

DECLINE(EvaluateDiscreteStates, fmi3Instance instance)
DECLINE(EnterConfigurationMode, fmi3Instance instance)
DECLINE(ExitConfigurationMode, fmi3Instance instance)
DECLINE(GetIntervalDecimal, fmi3Instance instance, const fmi3ValueReference valueReferences[],
        size_t nValueReferences, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
DECLINE(GetIntervalFraction, fmi3Instance instance, const fmi3ValueReference valueReferences[],
        size_t nValueReferences, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
        fmi3IntervalQualifier qualifiers[])
DECLINE(GetShiftDecimal, fmi3Instance instance, const fmi3ValueReference valueReferences[],
        size_t nValueReferences, fmi3Float64 shifts[])
DECLINE(GetShiftFraction, fmi3Instance instance, const fmi3ValueReference valueReferences[],
        size_t nValueReferences, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
DECLINE(SetIntervalDecimal, fmi3Instance instance, const fmi3ValueReference valueReferences[],
        size_t nValueReferences, const fmi3Float64 intervals[])
DECLINE(SetIntervalFraction, fmi3Instance instance, const fmi3ValueReference valueReferences[],
        size_t nValueReferences, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
DECLINE(SetShiftDecimal, fmi3Instance instance, const fmi3ValueReference valueReferences[],
        size_t nValueReferences, const fmi3Float64 shifts[])
DECLINE(SetShiftFraction, fmi3Instance instance, const fmi3ValueReference valueReferences[],
        size_t nValueReferences, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
DECLINE(ActivateModelPartition, fmi3Instance instance, fmi3ValueReference clockReference,
        fmi3Float64 activationTime)
DECLINE(GetOutputDerivatives, fmi3Instance instance, const fmi3ValueReference valueReferences[],
        size_t nValueReferences, const fmi3Int32 orders[], fmi3Float64 values[], size_t nValues)
