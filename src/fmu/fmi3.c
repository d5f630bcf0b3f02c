/* FMI 3.0 for co-simulation around a model. */
#include "fmu/fmi3.h"

#include <stdlib.h>
#include <string.h>

#include "fmu/instance.h"

typedef struct {
    hci_fmu_model *model;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
    double time_s; /* up to which it has come */
} instance;

/* Says what is wrong, where something is. */
static fmi3Status status_of(const instance *x, const char *words)
{
    if (!words) return fmi3OK;
    if (x->log) x->log(x->environment, fmi3Error, "logStatusError", words);
    return fmi3Error;
}

/* Whatever this FMU does not have: fine where nothing is asked of it. */
static fmi3Status none_of(fmi3Instance c, size_t n)
{
    return status_of(c, n == 0 ? NULL : "this FMU has nothing of the kind");
}

/* ---- instances ---- */

const char *HCI_FMI3(fmi3GetVersion)(void)
{
    return "3.0";
}

fmi3Status HCI_FMI3(fmi3SetDebugLogging)(fmi3Instance c, fmi3Boolean on, size_t count,
                                         const fmi3String categories[])
{
    (void)c;
    (void)on;
    (void)count;
    (void)categories;
    return fmi3OK; /* errors are always said, and there is nothing else to say */
}

fmi3Instance HCI_FMI3(fmi3InstantiateCoSimulation)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3Boolean events, fmi3Boolean early_return, const fmi3ValueReference required[], size_t required_count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    instance *x = calloc(1, sizeof *x);
    const char *words = NULL;
    (void)name;
    (void)resources;
    (void)visible;
    (void)logging;
    (void)early_return;
    (void)required;
    (void)required_count;
    (void)update;
    if (!x) return NULL;
    x->environment = environment;
    x->log = log;
    if (!token || strcmp(token, hci_fmu_token) != 0)
        words = "the instantiation token is that of another model description";
    else if (events)
        words = "this FMU has no event mode";
    else if (!(x->model = hci_fmu_new()))
        words = "memory is out";
    if (!words) return x;
    status_of(x, words);
    free(x);
    return NULL;
}

void HCI_FMI3(fmi3FreeInstance)(fmi3Instance c)
{
    instance *x = c;
    if (!x) return;
    hci_fmu_free(x->model);
    free(x);
}

/* ---- phases ---- */

fmi3Status HCI_FMI3(fmi3EnterInitializationMode)(fmi3Instance c, fmi3Boolean tolerance_defined,
                                                 fmi3Float64 tolerance, fmi3Float64 start,
                                                 fmi3Boolean stop_defined, fmi3Float64 stop)
{
    instance *x = c;
    (void)tolerance_defined;
    (void)tolerance;
    (void)stop_defined;
    (void)stop;
    x->time_s = start;
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3ExitInitializationMode)(fmi3Instance c)
{
    instance *x = c;
    return status_of(x, hci_fmu_begin(x->model));
}

fmi3Status HCI_FMI3(fmi3Terminate)(fmi3Instance c)
{
    (void)c;
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3Reset)(fmi3Instance c)
{
    instance *x = c;
    hci_fmu_reset(x->model);
    x->time_s = 0.0;
    return fmi3OK;
}

/* ---- values ---- */

/* The time follows the variables of the model. */
fmi3Status HCI_FMI3(fmi3GetFloat64)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                    fmi3Float64 value[], size_t values)
{
    instance *x = c;
    const char *words = values < n ? "less room than values" : NULL;
    for (size_t k = 0; k < n && !words; ++k)
        if (vr[k] == hci_fmu_count)
            value[k] = x->time_s;
        else
            words = hci_fmu_get(x->model, HCI_FMU_REAL, &vr[k], 1, &value[k]);
    return status_of(x, words);
}

fmi3Status HCI_FMI3(fmi3SetFloat64)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                    const fmi3Float64 value[], size_t values)
{
    instance *x = c;
    return status_of(x, values < n ? "fewer values than variables"
                                   : hci_fmu_set(x->model, HCI_FMU_REAL, vr, n, value));
}

fmi3Status HCI_FMI3(fmi3GetInt64)(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Int64 value[],
                                  size_t values)
{
    instance *x = c;
    const char *words = values < n ? "less room than values" : NULL;
    for (size_t k = 0; k < n && !words; ++k) {
        double number = 0.0;
        words = hci_fmu_get(x->model, HCI_FMU_CHOICE, &vr[k], 1, &number);
        if (!words) value[k] = (fmi3Int64)number;
    }
    return status_of(x, words);
}

fmi3Status HCI_FMI3(fmi3SetInt64)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                  const fmi3Int64 value[], size_t values)
{
    instance *x = c;
    const char *words = values < n ? "fewer values than variables" : NULL;
    for (size_t k = 0; k < n && !words; ++k) {
        const double number = (double)value[k];
        words = hci_fmu_set(x->model, HCI_FMU_CHOICE, &vr[k], 1, &number);
    }
    return status_of(x, words);
}

fmi3Status HCI_FMI3(fmi3GetBoolean)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                    fmi3Boolean value[], size_t values)
{
    instance *x = c;
    const char *words = values < n ? "less room than values" : NULL;
    for (size_t k = 0; k < n && !words; ++k) {
        double number = 0.0;
        words = hci_fmu_get(x->model, HCI_FMU_BOOLEAN, &vr[k], 1, &number);
        if (!words) value[k] = number > 0.0;
    }
    return status_of(x, words);
}

fmi3Status HCI_FMI3(fmi3SetBoolean)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                    const fmi3Boolean value[], size_t values)
{
    instance *x = c;
    const char *words = values < n ? "fewer values than variables" : NULL;
    for (size_t k = 0; k < n && !words; ++k) {
        const double number = value[k] ? 1.0 : 0.0;
        words = hci_fmu_set(x->model, HCI_FMU_BOOLEAN, &vr[k], 1, &number);
    }
    return status_of(x, words);
}

/* ---- states ---- */

fmi3Status HCI_FMI3(fmi3GetFMUState)(fmi3Instance c, fmi3FMUState *state)
{
    instance *x = c;
    hci_fmu_saved *saved = *state;
    const char *words = hci_fmu_take(x->model, &saved);
    *state = saved;
    return status_of(x, words);
}

fmi3Status HCI_FMI3(fmi3SetFMUState)(fmi3Instance c, fmi3FMUState state)
{
    instance *x = c;
    return status_of(x, hci_fmu_return(x->model, state));
}

fmi3Status HCI_FMI3(fmi3FreeFMUState)(fmi3Instance c, fmi3FMUState *state)
{
    (void)c;
    if (!state) return fmi3OK;
    free(*state);
    *state = NULL;
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3SerializedFMUStateSize)(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    const hci_fmu_saved *saved = state;
    if (!saved) return status_of(c, "no state was given");
    *size = saved->size;
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3SerializeFMUState)(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    const hci_fmu_saved *saved = state;
    if (!saved || size < saved->size) return status_of(c, "no state, or too little memory for it");
    memcpy(bytes, hci_fmu_bytes(saved), saved->size);
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3DeserializeFMUState)(fmi3Instance c, const fmi3Byte bytes[], size_t size,
                                             fmi3FMUState *state)
{
    hci_fmu_saved *saved = *state;
    const char *words = hci_fmu_from_bytes(bytes, size, &saved);
    *state = saved;
    return status_of(c, words);
}

/* ---- steps ---- */

fmi3Status HCI_FMI3(fmi3EnterStepMode)(fmi3Instance c)
{
    (void)c;
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3DoStep)(fmi3Instance c, fmi3Float64 from_s, fmi3Float64 duration_s,
                                fmi3Boolean no_way_back, fmi3Boolean *event, fmi3Boolean *terminate,
                                fmi3Boolean *early, fmi3Float64 *last_s)
{
    instance *x = c;
    const char *words = NULL;
    (void)no_way_back;
    if (!hci_fmu_has_begun(x->model))
        words = "a step before the end of the initialization";
    else if (!(duration_s > 0.0))
        words = "a communication step that is not above 0";
    if (!words) words = hci_fmu_step(x->model, duration_s);
    if (!words) x->time_s = from_s + duration_s;
    *event = *terminate = *early = false;
    *last_s = x->time_s;
    return status_of(x, words);
}

/* ---- what is not there ---- */

#define NO_VALUES(type)                                                                                      \
    fmi3Status HCI_FMI3(fmi3Get##type)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,              \
                                       fmi3##type value[], size_t values)                                    \
    {                                                                                                        \
        (void)vr;                                                                                            \
        (void)value;                                                                                         \
        (void)values;                                                                                        \
        return none_of(c, n);                                                                                \
    }                                                                                                        \
    fmi3Status HCI_FMI3(fmi3Set##type)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,              \
                                       const fmi3##type value[], size_t values)                              \
    {                                                                                                        \
        (void)vr;                                                                                            \
        (void)value;                                                                                         \
        (void)values;                                                                                        \
        return none_of(c, n);                                                                                \
    }

HCI_FMI3_OTHER_TYPES(NO_VALUES)

fmi3Instance HCI_FMI3(fmi3InstantiateModelExchange)(fmi3String name, fmi3String token, fmi3String resources,
                                                    fmi3Boolean visible, fmi3Boolean logging,
                                                    fmi3InstanceEnvironment environment,
                                                    fmi3LogMessageCallback log)
{
    (void)name;
    (void)token;
    (void)resources;
    (void)visible;
    (void)logging;
    if (log) log(environment, fmi3Error, "logStatusError", "this FMU is for co-simulation alone");
    return NULL;
}

fmi3Instance HCI_FMI3(fmi3InstantiateScheduledExecution)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock)
{
    (void)name;
    (void)token;
    (void)resources;
    (void)visible;
    (void)logging;
    (void)update;
    (void)lock;
    (void)unlock;
    if (log) log(environment, fmi3Error, "logStatusError", "this FMU is for co-simulation alone");
    return NULL;
}

fmi3Status HCI_FMI3(fmi3EnterEventMode)(fmi3Instance c)
{
    return none_of(c, 1);
}

fmi3Status HCI_FMI3(fmi3GetBinary)(fmi3Instance c, const fmi3ValueReference vr[], size_t n, size_t sizes[],
                                   fmi3Binary value[], size_t values)
{
    (void)vr;
    (void)sizes;
    (void)value;
    (void)values;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3SetBinary)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                   const size_t sizes[], const fmi3Binary value[], size_t values)
{
    (void)vr;
    (void)sizes;
    (void)value;
    (void)values;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3GetClock)(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Clock value[])
{
    (void)vr;
    (void)value;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3SetClock)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                  const fmi3Clock value[])
{
    (void)vr;
    (void)value;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3GetNumberOfVariableDependencies)(fmi3Instance c, fmi3ValueReference vr, size_t *count)
{
    (void)vr;
    (void)count;
    return none_of(c, 1);
}

fmi3Status HCI_FMI3(fmi3GetVariableDependencies)(fmi3Instance c, fmi3ValueReference dependent,
                                                 size_t elements[], fmi3ValueReference independents[],
                                                 size_t independent_elements[], fmi3DependencyKind kinds[],
                                                 size_t count)
{
    (void)dependent;
    (void)elements;
    (void)independents;
    (void)independent_elements;
    (void)kinds;
    (void)count;
    return none_of(c, 1);
}

fmi3Status HCI_FMI3(fmi3GetDirectionalDerivative)(fmi3Instance c, const fmi3ValueReference unknown[],
                                                  size_t unknowns, const fmi3ValueReference known[],
                                                  size_t knowns, const fmi3Float64 seed[], size_t seeds,
                                                  fmi3Float64 answer[], size_t answers)
{
    (void)unknown;
    (void)known;
    (void)knowns;
    (void)seed;
    (void)seeds;
    (void)answer;
    (void)answers;
    return none_of(c, unknowns);
}

fmi3Status HCI_FMI3(fmi3GetAdjointDerivative)(fmi3Instance c, const fmi3ValueReference unknown[],
                                              size_t unknowns, const fmi3ValueReference known[],
                                              size_t knowns, const fmi3Float64 seed[], size_t seeds,
                                              fmi3Float64 answer[], size_t answers)
{
    (void)unknown;
    (void)known;
    (void)knowns;
    (void)seed;
    (void)seeds;
    (void)answer;
    (void)answers;
    return none_of(c, unknowns);
}

fmi3Status HCI_FMI3(fmi3EnterConfigurationMode)(fmi3Instance c)
{
    return none_of(c, 1);
}

fmi3Status HCI_FMI3(fmi3ExitConfigurationMode)(fmi3Instance c)
{
    return none_of(c, 1);
}

fmi3Status HCI_FMI3(fmi3GetIntervalDecimal)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                            fmi3Float64 interval[], fmi3IntervalQualifier qualifier[])
{
    (void)vr;
    (void)interval;
    (void)qualifier;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3GetIntervalFraction)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                             fmi3UInt64 counter[], fmi3UInt64 resolution[],
                                             fmi3IntervalQualifier qualifier[])
{
    (void)vr;
    (void)counter;
    (void)resolution;
    (void)qualifier;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3GetShiftDecimal)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                         fmi3Float64 shift[])
{
    (void)vr;
    (void)shift;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3GetShiftFraction)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                          fmi3UInt64 counter[], fmi3UInt64 resolution[])
{
    (void)vr;
    (void)counter;
    (void)resolution;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3SetIntervalDecimal)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                            const fmi3Float64 interval[])
{
    (void)vr;
    (void)interval;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3SetIntervalFraction)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                             const fmi3UInt64 counter[], const fmi3UInt64 resolution[])
{
    (void)vr;
    (void)counter;
    (void)resolution;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3SetShiftDecimal)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                         const fmi3Float64 shift[])
{
    (void)vr;
    (void)shift;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3SetShiftFraction)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                          const fmi3UInt64 counter[], const fmi3UInt64 resolution[])
{
    (void)vr;
    (void)counter;
    (void)resolution;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3EvaluateDiscreteStates)(fmi3Instance c)
{
    return none_of(c, 1);
}

fmi3Status HCI_FMI3(fmi3UpdateDiscreteStates)(fmi3Instance c, fmi3Boolean *again, fmi3Boolean *terminate,
                                              fmi3Boolean *nominals, fmi3Boolean *values,
                                              fmi3Boolean *event_defined, fmi3Float64 *event_s)
{
    (void)again;
    (void)terminate;
    (void)nominals;
    (void)values;
    (void)event_defined;
    (void)event_s;
    return none_of(c, 1);
}

fmi3Status HCI_FMI3(fmi3EnterContinuousTimeMode)(fmi3Instance c)
{
    return none_of(c, 1);
}

fmi3Status HCI_FMI3(fmi3CompletedIntegratorStep)(fmi3Instance c, fmi3Boolean no_way_back, fmi3Boolean *event,
                                                 fmi3Boolean *terminate)
{
    (void)no_way_back;
    (void)event;
    (void)terminate;
    return none_of(c, 1);
}

fmi3Status HCI_FMI3(fmi3SetTime)(fmi3Instance c, fmi3Float64 time_s)
{
    (void)time_s;
    return none_of(c, 1);
}

fmi3Status HCI_FMI3(fmi3SetContinuousStates)(fmi3Instance c, const fmi3Float64 x[], size_t n)
{
    (void)x;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3GetContinuousStateDerivatives)(fmi3Instance c, fmi3Float64 x[], size_t n)
{
    (void)x;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3GetEventIndicators)(fmi3Instance c, fmi3Float64 x[], size_t n)
{
    (void)x;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3GetContinuousStates)(fmi3Instance c, fmi3Float64 x[], size_t n)
{
    (void)x;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3GetNominalsOfContinuousStates)(fmi3Instance c, fmi3Float64 x[], size_t n)
{
    (void)x;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3GetNumberOfEventIndicators)(fmi3Instance c, size_t *n)
{
    (void)c;
    *n = 0;
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3GetNumberOfContinuousStates)(fmi3Instance c, size_t *n)
{
    (void)c;
    *n = 0;
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3GetOutputDerivatives)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                              const fmi3Int32 order[], fmi3Float64 value[], size_t values)
{
    (void)vr;
    (void)order;
    (void)value;
    (void)values;
    return none_of(c, n);
}

fmi3Status HCI_FMI3(fmi3ActivateModelPartition)(fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time_s)
{
    (void)clock;
    (void)time_s;
    return none_of(c, 1);
}
