/* FMI 2.0 for co-simulation around a model. */
#include "fmu/fmi2.h"

#include <stdlib.h>
#include <string.h>

#include "fmu/instance.h"

typedef struct {
    hci_fmu_model *model;
    char *name;
    fmi2CallbackFunctions callbacks;
    double time_s; /* up to which it has come */
} instance;

/* Says what is wrong, where something is. */
static fmi2Status status_of(const instance *x, const char *words)
{
    if (!words) return fmi2OK;
    if (x->callbacks.logger)
        x->callbacks.logger(x->callbacks.componentEnvironment, x->name, fmi2Error, "logStatusError", "%s",
                            words);
    return fmi2Error;
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
    (void)c;
    (void)on;
    (void)count;
    (void)categories;
    return fmi2OK; /* errors are always said, and there is nothing else to say */
}

static char *copy_of(const char *text)
{
    const size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    if (copy) memcpy(copy, text, size);
    return copy;
}

fmi2Component HCI_FMI2(fmi2Instantiate)(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                        const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                                        fmi2Boolean logging)
{
    instance *x = calloc(1, sizeof *x);
    const char *words = NULL;
    (void)resources;
    (void)visible;
    (void)logging;
    if (!x) return NULL;
    if (functions) x->callbacks = *functions;
    x->name = copy_of(name ? name : "");
    if (type != fmi2CoSimulation)
        words = "this FMU is for co-simulation alone";
    else if (!guid || strcmp(guid, hci_fmu_token) != 0)
        words = "the GUID is that of another model description";
    else if (!x->name || !(x->model = hci_fmu_new()))
        words = "memory is out";
    if (!words) return x;
    status_of(x, words);
    free(x->name);
    free(x);
    return NULL;
}

void HCI_FMI2(fmi2FreeInstance)(fmi2Component c)
{
    instance *x = c;
    if (!x) return;
    hci_fmu_free(x->model);
    free(x->name);
    free(x);
}

/* ---- phases ---- */

fmi2Status HCI_FMI2(fmi2SetupExperiment)(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                                         fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop)
{
    instance *x = c;
    (void)tolerance_defined;
    (void)tolerance;
    (void)stop_defined;
    (void)stop;
    x->time_s = start;
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2EnterInitializationMode)(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2ExitInitializationMode)(fmi2Component c)
{
    instance *x = c;
    return status_of(x, hci_fmu_begin(x->model));
}

fmi2Status HCI_FMI2(fmi2Terminate)(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2Reset)(fmi2Component c)
{
    instance *x = c;
    hci_fmu_reset(x->model);
    x->time_s = 0.0;
    return fmi2OK;
}

/* ---- values ---- */

fmi2Status HCI_FMI2(fmi2GetReal)(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    instance *x = c;
    return status_of(x, hci_fmu_get(x->model, HCI_FMU_REAL, vr, n, value));
}

fmi2Status HCI_FMI2(fmi2SetReal)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                 const fmi2Real value[])
{
    instance *x = c;
    return status_of(x, hci_fmu_set(x->model, HCI_FMU_REAL, vr, n, value));
}

/* Whole numbers, one after the other. */
static fmi2Status get_whole(instance *x, hci_fmu_type type, const fmi2ValueReference *vr, size_t n,
                            int *value)
{
    const char *words = NULL;
    for (size_t k = 0; k < n && !words; ++k) {
        double number;
        words = hci_fmu_get(x->model, type, &vr[k], 1, &number);
        if (!words) value[k] = (int)number;
    }
    return status_of(x, words);
}

static fmi2Status set_whole(instance *x, hci_fmu_type type, const fmi2ValueReference *vr, size_t n,
                            const int *value)
{
    const char *words = NULL;
    for (size_t k = 0; k < n && !words; ++k) {
        const double number = value[k];
        words = hci_fmu_set(x->model, type, &vr[k], 1, &number);
    }
    return status_of(x, words);
}

fmi2Status HCI_FMI2(fmi2GetInteger)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                    fmi2Integer value[])
{
    return get_whole(c, HCI_FMU_CHOICE, vr, n, value);
}

fmi2Status HCI_FMI2(fmi2SetInteger)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                    const fmi2Integer value[])
{
    return set_whole(c, HCI_FMU_CHOICE, vr, n, value);
}

fmi2Status HCI_FMI2(fmi2GetBoolean)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                    fmi2Boolean value[])
{
    return get_whole(c, HCI_FMU_BOOLEAN, vr, n, value);
}

fmi2Status HCI_FMI2(fmi2SetBoolean)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                    const fmi2Boolean value[])
{
    return set_whole(c, HCI_FMU_BOOLEAN, vr, n, value);
}

/* Whatever this FMU does not have: fine where nothing is asked of it. */
static fmi2Status none_of(fmi2Component c, size_t n)
{
    return status_of(c, n == 0 ? NULL : "this FMU has nothing of the kind");
}

fmi2Status HCI_FMI2(fmi2GetString)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                   fmi2String value[])
{
    (void)vr;
    (void)value;
    return none_of(c, n);
}

fmi2Status HCI_FMI2(fmi2SetString)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                   const fmi2String value[])
{
    (void)vr;
    (void)value;
    return none_of(c, n);
}

/* ---- states ---- */

fmi2Status HCI_FMI2(fmi2GetFMUstate)(fmi2Component c, fmi2FMUstate *state)
{
    instance *x = c;
    hci_fmu_saved *saved = *state;
    const char *words = hci_fmu_take(x->model, &saved);
    *state = saved;
    return status_of(x, words);
}

fmi2Status HCI_FMI2(fmi2SetFMUstate)(fmi2Component c, fmi2FMUstate state)
{
    instance *x = c;
    return status_of(x, hci_fmu_return(x->model, state));
}

fmi2Status HCI_FMI2(fmi2FreeFMUstate)(fmi2Component c, fmi2FMUstate *state)
{
    (void)c;
    if (!state) return fmi2OK;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2SerializedFMUstateSize)(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    const hci_fmu_saved *saved = state;
    if (!saved) return status_of(c, "no state was given");
    *size = saved->size;
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2SerializeFMUstate)(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    const hci_fmu_saved *saved = state;
    if (!saved || size < saved->size) return status_of(c, "no state, or too little memory for it");
    memcpy(bytes, hci_fmu_bytes(saved), saved->size);
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2DeSerializeFMUstate)(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                             fmi2FMUstate *state)
{
    hci_fmu_saved *saved = *state;
    const char *words = hci_fmu_from_bytes(bytes, size, &saved);
    *state = saved;
    return status_of(c, words);
}

/* ---- steps ---- */

fmi2Status HCI_FMI2(fmi2DoStep)(fmi2Component c, fmi2Real from_s, fmi2Real duration_s,
                                fmi2Boolean no_way_back)
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
    return status_of(x, words);
}

fmi2Status HCI_FMI2(fmi2CancelStep)(fmi2Component c)
{
    return status_of(c, "no step is asynchronous here");
}

fmi2Status HCI_FMI2(fmi2GetRealStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    const instance *x = c;
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = x->time_s;
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2GetBooleanStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    (void)c;
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = fmi2False;
    return fmi2OK;
}

fmi2Status HCI_FMI2(fmi2GetStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)c;
    (void)kind;
    (void)value;
    return fmi2Discard;
}

fmi2Status HCI_FMI2(fmi2GetIntegerStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)c;
    (void)kind;
    (void)value;
    return fmi2Discard;
}

fmi2Status HCI_FMI2(fmi2GetStringStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)c;
    (void)kind;
    (void)value;
    return fmi2Discard;
}

fmi2Status HCI_FMI2(fmi2GetDirectionalDerivative)(fmi2Component c, const fmi2ValueReference unknown[],
                                                  size_t unknowns, const fmi2ValueReference known[],
                                                  size_t knowns, const fmi2Real change[], fmi2Real answer[])
{
    (void)unknown;
    (void)known;
    (void)knowns;
    (void)change;
    (void)answer;
    return none_of(c, unknowns);
}

fmi2Status HCI_FMI2(fmi2SetRealInputDerivatives)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                                 const fmi2Integer order[], const fmi2Real value[])
{
    (void)vr;
    (void)order;
    (void)value;
    return none_of(c, n);
}

fmi2Status HCI_FMI2(fmi2GetRealOutputDerivatives)(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                                  const fmi2Integer order[], fmi2Real value[])
{
    (void)vr;
    (void)order;
    (void)value;
    return none_of(c, n);
}
