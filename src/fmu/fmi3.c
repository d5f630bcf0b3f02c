/* FMI 3.0 for co-simulation around an instance. */
#include "fmu/fmi3.h"

#include <stdlib.h>
#include <string.h>

#include "fmu/fmi3_absent.h"
#include "fmu/instance.h"

#if defined __GNUC__ /* signatures are the standard's, with parameters that nothing here needs */
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

typedef struct {
    hci_fmu_instance base;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
} instance;

static void say(const hci_fmu_instance *base, hci_fmu_status status, const char *words)
{
    const instance *x = (const instance *)base;
    const char *category = status == HCI_FMU_DISCARD ? "logStatusDiscard" : "logStatusError";
    if (x->log) x->log(x->environment, (fmi3Status)status, category, words);
}

/* ---- instances ---- */

const char *HCI_FMI3(fmi3GetVersion)(void)
{
    return "3.0";
}

fmi3Status HCI_FMI3(fmi3SetDebugLogging)(fmi3Instance c, fmi3Boolean on, size_t count,
                                         const fmi3String categories[])
{
    ((instance *)c)->base.logs = on;
    return fmi3OK;
}

void HCI_FMI3(fmi3FreeInstance)(fmi3Instance c)
{
    instance *x = c;
    if (!x) return;
    hci_fmu_close(&x->base);
    free(x);
}

fmi3Instance HCI_FMI3(fmi3InstantiateCoSimulation)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3Boolean events, fmi3Boolean early_return, const fmi3ValueReference required[], size_t required_count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    instance *x = calloc(1, sizeof *x);
    if (!x) return NULL;
    x->base.say = say;
    x->base.logs = logging;
    x->environment = environment;
    x->log = log;
    if (hci_fmu_open(&x->base, token, events ? "this FMU has no event mode" : NULL) == HCI_FMU_OK) return x;
    HCI_FMI3(fmi3FreeInstance)(x);
    return NULL;
}

static fmi3Instance other_interface(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    if (log) log(environment, fmi3Error, "logStatusError", "this FMU is for co-simulation alone");
    return NULL;
}

fmi3Instance HCI_FMI3(fmi3InstantiateModelExchange)(fmi3String name, fmi3String token, fmi3String resources,
                                                    fmi3Boolean visible, fmi3Boolean logging,
                                                    fmi3InstanceEnvironment environment,
                                                    fmi3LogMessageCallback log)
{
    return other_interface(environment, log);
}

fmi3Instance HCI_FMI3(fmi3InstantiateScheduledExecution)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock)
{
    return other_interface(environment, log);
}

/* ---- phases ---- */

fmi3Status HCI_FMI3(fmi3EnterInitializationMode)(fmi3Instance c, fmi3Boolean tolerance_defined,
                                                 fmi3Float64 tolerance, fmi3Float64 start,
                                                 fmi3Boolean stop_defined, fmi3Float64 stop)
{
    ((instance *)c)->base.time_s = start;
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3ExitInitializationMode)(fmi3Instance c)
{
    return (fmi3Status)hci_fmu_begin(c);
}

fmi3Status HCI_FMI3(fmi3EnterStepMode)(fmi3Instance c)
{
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3Terminate)(fmi3Instance c)
{
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3Reset)(fmi3Instance c)
{
    return (fmi3Status)hci_fmu_reset(c);
}

/* ---- values ---- */

HCI_FMU_WHOLE(integer, fmi3Int32)
HCI_FMU_WHOLE(truth, fmi3Boolean)

/* NAME(values): the call where there are as many values as references, else an error. */
#define IF_ENOUGH(call)                                                                                      \
    ((fmi3Status)(values < n ? hci_fmu_tell(c, "fewer values than value references") : (call)))

fmi3Status HCI_FMI3(fmi3GetFloat64)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                    fmi3Float64 value[], size_t values)
{
    return IF_ENOUGH(hci_fmu_get(c, HCI_FMU_REAL, vr, n, value));
}

fmi3Status HCI_FMI3(fmi3SetFloat64)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                    const fmi3Float64 value[], size_t values)
{
    return IF_ENOUGH(hci_fmu_set(c, HCI_FMU_REAL, vr, n, value));
}

fmi3Status HCI_FMI3(fmi3GetInt32)(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Int32 value[],
                                  size_t values)
{
    return IF_ENOUGH(get_integer(c, HCI_FMU_INTEGER, vr, n, value));
}

fmi3Status HCI_FMI3(fmi3SetInt32)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                  const fmi3Int32 value[], size_t values)
{
    return IF_ENOUGH(set_integer(c, HCI_FMU_INTEGER, vr, n, value));
}

fmi3Status HCI_FMI3(fmi3GetBoolean)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                    fmi3Boolean value[], size_t values)
{
    return IF_ENOUGH(get_truth(c, HCI_FMU_BOOLEAN, vr, n, value));
}

fmi3Status HCI_FMI3(fmi3SetBoolean)(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                    const fmi3Boolean value[], size_t values)
{
    return IF_ENOUGH(set_truth(c, HCI_FMU_BOOLEAN, vr, n, value));
}

/* ---- states ---- */

fmi3Status HCI_FMI3(fmi3GetFMUState)(fmi3Instance c, fmi3FMUState *state)
{
    return (fmi3Status)hci_fmu_take(c, state);
}

fmi3Status HCI_FMI3(fmi3SetFMUState)(fmi3Instance c, fmi3FMUState state)
{
    return (fmi3Status)hci_fmu_return(c, state);
}

fmi3Status HCI_FMI3(fmi3FreeFMUState)(fmi3Instance c, fmi3FMUState *state)
{
    hci_fmu_drop(state);
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3SerializedFMUStateSize)(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    return (fmi3Status)hci_fmu_bytes_size(c, state, size);
}

fmi3Status HCI_FMI3(fmi3SerializeFMUState)(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    return (fmi3Status)hci_fmu_to_bytes(c, state, bytes, size);
}

fmi3Status HCI_FMI3(fmi3DeserializeFMUState)(fmi3Instance c, const fmi3Byte bytes[], size_t size,
                                             fmi3FMUState *state)
{
    return (fmi3Status)hci_fmu_from_bytes(c, bytes, size, state);
}

/* ---- steps ---- */

fmi3Status HCI_FMI3(fmi3DoStep)(fmi3Instance c, fmi3Float64 from_s, fmi3Float64 duration_s,
                                fmi3Boolean no_way_back, fmi3Boolean *event, fmi3Boolean *terminate,
                                fmi3Boolean *early, fmi3Float64 *last_s)
{
    const fmi3Status status = (fmi3Status)hci_fmu_do_step(c, from_s, duration_s);
    *event = *terminate = *early = false;
    *last_s = ((const instance *)c)->base.time_s;
    return status;
}

/* ---- what is not there ---- */

fmi3Status HCI_FMI3(fmi3GetNumberOfEventIndicators)(fmi3Instance c, size_t *n)
{
    *n = 0;
    return fmi3OK;
}

fmi3Status HCI_FMI3(fmi3GetNumberOfContinuousStates)(fmi3Instance c, size_t *n)
{
    *n = 0;
    return fmi3OK;
}

#define ABSENT(name, asked, parameters)                                                                      \
    fmi3Status HCI_FMI3(name) parameters                                                                     \
    {                                                                                                        \
        return (fmi3Status)hci_fmu_none(c, asked);                                                           \
    }

HCI_FMI3_ABSENT(ABSENT)
