/* Functions that FMI 3.0 wants of every FMU and that these have nothing for: other types of variables,
 * clocks, events, derivatives. X(name, how many values are asked for, parameters). */
#ifndef HCI_SRC_FMU_FMI3_ABSENT_H
#define HCI_SRC_FMU_FMI3_ABSENT_H

#define HCI_FMI3_ABSENT_TYPE(X, type)                                                                        \
    X(fmi3Get##type, n,                                                                                      \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3##type value[], size_t values))          \
    X(fmi3Set##type, n,                                                                                      \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3##type value[], size_t values))

#define HCI_FMI3_ABSENT(X)                                                                                   \
    HCI_FMI3_ABSENT_TYPE(X, Float32)                                                                         \
    HCI_FMI3_ABSENT_TYPE(X, Int8)                                                                            \
    HCI_FMI3_ABSENT_TYPE(X, UInt8)                                                                           \
    HCI_FMI3_ABSENT_TYPE(X, Int16)                                                                           \
    HCI_FMI3_ABSENT_TYPE(X, UInt16)                                                                          \
    HCI_FMI3_ABSENT_TYPE(X, UInt32)                                                                          \
    HCI_FMI3_ABSENT_TYPE(X, Int64)                                                                           \
    HCI_FMI3_ABSENT_TYPE(X, UInt64)                                                                          \
    HCI_FMI3_ABSENT_TYPE(X, String)                                                                          \
    X(fmi3GetBinary, n,                                                                                      \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, size_t sizes[], fmi3Binary value[],          \
       size_t values))                                                                                       \
    X(fmi3SetBinary, n,                                                                                      \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, const size_t sizes[],                        \
       const fmi3Binary value[], size_t values))                                                             \
    X(fmi3GetClock, n, (fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Clock value[]))         \
    X(fmi3SetClock, n, (fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Clock value[]))   \
    X(fmi3GetIntervalDecimal, n,                                                                             \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Float64 interval[],                      \
       fmi3IntervalQualifier qualifier[]))                                                                   \
    X(fmi3GetIntervalFraction, n,                                                                            \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3UInt64 counter[],                        \
       fmi3UInt64 resolution[], fmi3IntervalQualifier qualifier[]))                                          \
    X(fmi3GetShiftDecimal, n,                                                                                \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Float64 shift[]))                        \
    X(fmi3GetShiftFraction, n,                                                                               \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3UInt64 counter[],                        \
       fmi3UInt64 resolution[]))                                                                             \
    X(fmi3SetIntervalDecimal, n,                                                                             \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Float64 interval[]))               \
    X(fmi3SetIntervalFraction, n,                                                                            \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3UInt64 counter[],                  \
       const fmi3UInt64 resolution[]))                                                                       \
    X(fmi3SetShiftDecimal, n,                                                                                \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Float64 shift[]))                  \
    X(fmi3SetShiftFraction, n,                                                                               \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3UInt64 counter[],                  \
       const fmi3UInt64 resolution[]))                                                                       \
    X(fmi3ActivateModelPartition, 1, (fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time_s))         \
    X(fmi3EnterEventMode, 1, (fmi3Instance c))                                                               \
    X(fmi3EvaluateDiscreteStates, 1, (fmi3Instance c))                                                       \
    X(fmi3UpdateDiscreteStates, 1,                                                                           \
      (fmi3Instance c, fmi3Boolean * again, fmi3Boolean * terminate, fmi3Boolean * nominals,                 \
       fmi3Boolean * values, fmi3Boolean * event_defined, fmi3Float64 * event_s))                            \
    X(fmi3EnterConfigurationMode, 1, (fmi3Instance c))                                                       \
    X(fmi3ExitConfigurationMode, 1, (fmi3Instance c))                                                        \
    X(fmi3EnterContinuousTimeMode, 1, (fmi3Instance c))                                                      \
    X(fmi3CompletedIntegratorStep, 1,                                                                        \
      (fmi3Instance c, fmi3Boolean no_way_back, fmi3Boolean * event, fmi3Boolean * terminate))               \
    X(fmi3SetTime, 1, (fmi3Instance c, fmi3Float64 time_s))                                                  \
    X(fmi3SetContinuousStates, n, (fmi3Instance c, const fmi3Float64 x[], size_t n))                         \
    X(fmi3GetContinuousStates, n, (fmi3Instance c, fmi3Float64 x[], size_t n))                               \
    X(fmi3GetContinuousStateDerivatives, n, (fmi3Instance c, fmi3Float64 x[], size_t n))                     \
    X(fmi3GetNominalsOfContinuousStates, n, (fmi3Instance c, fmi3Float64 x[], size_t n))                     \
    X(fmi3GetEventIndicators, n, (fmi3Instance c, fmi3Float64 x[], size_t n))                                \
    X(fmi3GetOutputDerivatives, n,                                                                           \
      (fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Int32 order[],                     \
       fmi3Float64 value[], size_t values))                                                                  \
    X(fmi3GetDirectionalDerivative, unknowns,                                                                \
      (fmi3Instance c, const fmi3ValueReference unknown[], size_t unknowns,                                  \
       const fmi3ValueReference known[], size_t knowns, const fmi3Float64 seed[], size_t seeds,              \
       fmi3Float64 answer[], size_t answers))                                                                \
    X(fmi3GetAdjointDerivative, unknowns,                                                                    \
      (fmi3Instance c, const fmi3ValueReference unknown[], size_t unknowns,                                  \
       const fmi3ValueReference known[], size_t knowns, const fmi3Float64 seed[], size_t seeds,              \
       fmi3Float64 answer[], size_t answers))                                                                \
    X(fmi3GetNumberOfVariableDependencies, 1, (fmi3Instance c, fmi3ValueReference vr, size_t * count))       \
    X(fmi3GetVariableDependencies, 1,                                                                        \
      (fmi3Instance c, fmi3ValueReference dependent, size_t elements[], fmi3ValueReference independents[],   \
       size_t independent_elements[], fmi3DependencyKind kinds[], size_t count))

#endif
