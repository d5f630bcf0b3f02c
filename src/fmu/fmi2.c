/* FMI 2.0 for co-simulation around an instance. */
#include "fmu/fmi2.h"

#include <stdlib.h>
#include <string.h>

#include "fmu/instance.h"

#if defined __GNUC__ /* signatures are the standard's, with parameters that nothing here needs */
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

typedef struct {
    hci_fmu_instance base;
    char *name;
    fmi2CallbackFunctions callbacks;
} instance;

static void say(const hci_fmu_instance *base, hci_fmu_status status, const char *words)
{
    const instance *x = (const instance *)base;
    const char *category = status == HCI_FMU_DISCARD ? "logStatusDiscard" : "logStatusError";
    if (x->callbacks.logger)
        x->callbacks.logger(x->callbacks.componentEnvironment, x->name, (fmi2Status)status, category, "%s",
                            words);
}

/* ---- instances ---- */

const char *HCI_FMI2(fmi2GetTypesPlatform)(void)
{
    return "default";
}

const char *HCI_FMI2(fmi2GetVersion)(void)
{
    return "2.0";
}

fmi2Status HCI_FMI2(fmi2SetDebugLogging)(fmi2Component c, fmi2Boolean on, size_t count,
                                         const fmi2String categories[])
{
    ((instance *)c)->base.logs = on != fmi2False;
    return fmi2OK;
}

static char *copy_of(const char *text)
{
    const size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    if (copy) memcpy(copy, text, size);
    return copy;
}

void HCI_FMI2(fmi2FreeInstance)(fmi2Component c)
{
    instance *x = c;
    if (!x) return;
    hci_fmu_close(&x->base);
    free(x->name);
    free(x);
}

fmi2Component HCI_FMI2(fmi2Instantiate)(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                        const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                                        fmi2Boolean logging)
{
    instance *x = calloc(1, sizeof *x);
    if (!x) return NULL;
    if (functions) x->callbacks = *functions;
    x->base.say = say;
    x->base.logs = logging != fmi2False;
    x->name = copy_of(name ? name : "");
    const char *words = !x->name                   ? "memory is out"
                        : type != fmi2CoSimulation ? "this FMU is for co-simulation alone"
                                                   : NULL;
    if (hci_fmu_open(&x->base, guid, words) == HCI_FMU_OK) return x;
    HCI_FMI2(fmi2FreeInstance)(x);
    return NULL;
}

/* ---- phases ---- */

fmi2Status HCI_FMI2(fmi2SetupExperiment)(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                                         fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop)
{
    ((instance *)c)->base.time_s = start;
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2EnterInitializationMode)(fmi2Component c)
{
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2ExitInitializationMode)(fmi2Component c)
{
    return (fmi2Status)hci_fmu_begin(c);
}

fmi2Status HCI_FMI2(fmi2Terminate)(fmi2Component c)
{
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2Reset)(fmi2Component c)
{
    return (fmi2Status)hci_fmu_reset(c);
}

/* ---- values ---- */

HCI_FMU_WHOLE(whole, int)

fmi2Status HCI_FMI2(fmi2GetReal)(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    return (fmi2Status)hci_fmu_get(c, HCI_FMU_REAL, vr, n, value);
}

fmi2Status HCI_FMI2(fmi2SetReal)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                 const fmi2Real value[])
{
    return (fmi2Status)hci_fmu_set(c, HCI_FMU_REAL, vr, n, value);
}

fmi2Status HCI_FMI2(fmi2GetInteger)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                    fmi2Integer value[])
{
    return (fmi2Status)get_whole(c, HCI_FMU_INTEGER, vr, n, value);
}

fmi2Status HCI_FMI2(fmi2SetInteger)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                    const fmi2Integer value[])
{
    return (fmi2Status)set_whole(c, HCI_FMU_INTEGER, vr, n, value);
}

fmi2Status HCI_FMI2(fmi2GetBoolean)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                    fmi2Boolean value[])
{
    return (fmi2Status)get_whole(c, HCI_FMU_BOOLEAN, vr, n, value);
}

fmi2Status HCI_FMI2(fmi2SetBoolean)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                    const fmi2Boolean value[])
{
    return (fmi2Status)set_whole(c, HCI_FMU_BOOLEAN, vr, n, value);
}

/* ---- states ---- */

fmi2Status HCI_FMI2(fmi2GetFMUstate)(fmi2Component c, fmi2FMUstate *state)
{
    return (fmi2Status)hci_fmu_take(c, state);
}

fmi2Status HCI_FMI2(fmi2SetFMUstate)(fmi2Component c, fmi2FMUstate state)
{
    return (fmi2Status)hci_fmu_return(c, state);
}

fmi2Status HCI_FMI2(fmi2FreeFMUstate)(fmi2Component c, fmi2FMUstate *state)
{
    hci_fmu_drop(state);
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2SerializedFMUstateSize)(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    return (fmi2Status)hci_fmu_bytes_size(c, state, size);
}

fmi2Status HCI_FMI2(fmi2SerializeFMUstate)(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    return (fmi2Status)hci_fmu_to_bytes(c, state, bytes, size);
}

fmi2Status HCI_FMI2(fmi2DeSerializeFMUstate)(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                             fmi2FMUstate *state)
{
    return (fmi2Status)hci_fmu_from_bytes(c, bytes, size, state);
}

/* ---- steps ---- */

fmi2Status HCI_FMI2(fmi2DoStep)(fmi2Component c, fmi2Real from_s, fmi2Real duration_s,
                                fmi2Boolean no_way_back)
{
    return (fmi2Status)hci_fmu_do_step(c, from_s, duration_s);
}

fmi2Status HCI_FMI2(fmi2CancelStep)(fmi2Component c)
{
    return (fmi2Status)hci_fmu_tell(c, "no step is asynchronous here");
}

fmi2Status HCI_FMI2(fmi2GetRealStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = ((const instance *)c)->base.time_s;
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2GetBooleanStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = fmi2False;
    return fmi2OK;
}

/* ---- what is not there ---- */

fmi2Status HCI_FMI2(fmi2GetStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    return fmi2Discard;
}

fmi2Status HCI_FMI2(fmi2GetIntegerStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    return fmi2Discard;
}

fmi2Status HCI_FMI2(fmi2GetStringStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    return fmi2Discard;
}

fmi2Status HCI_FMI2(fmi2GetString)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                   fmi2String value[])
{
    return (fmi2Status)hci_fmu_none(c, n);
}

fmi2Status HCI_FMI2(fmi2SetString)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                   const fmi2String value[])
{
    return (fmi2Status)hci_fmu_none(c, n);
}

fmi2Status HCI_FMI2(fmi2GetDirectionalDerivative)(fmi2Component c, const fmi2ValueReference unknown[],
                                                  size_t unknowns, const fmi2ValueReference known[],
                                                  size_t knowns, const fmi2Real change[], fmi2Real answer[])
{
    return (fmi2Status)hci_fmu_none(c, unknowns);
}

fmi2Status HCI_FMI2(fmi2SetRealInputDerivatives)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                                 const fmi2Integer order[], const fmi2Real value[])
{
    return (fmi2Status)hci_fmu_none(c, n);
}

fmi2Status HCI_FMI2(fmi2GetRealOutputDerivatives)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                                  const fmi2Integer order[], fmi2Real value[])
{
    return (fmi2Status)hci_fmu_none(c, n);
}
