/* The C interface of FMI 2.0 for co-simulation, as far as an FMU has to provide it: types, numbers and
 * signatures as the standard (2.0.4, sections 2.1 and 4.2) states them. */
#ifndef HCI_SRC_FMU_FMI2_H
#define HCI_SRC_FMU_FMI2_H

#include <stddef.h>

typedef void *fmi2Component;
typedef void *fmi2ComponentEnvironment;
typedef void *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char *fmi2String;
typedef char fmi2Byte;

enum { fmi2False = 0, fmi2True = 1 };

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef struct {
    void (*logger)(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                   fmi2String category, fmi2String message, ...);
    void *(*allocateMemory)(size_t count, size_t size);
    void (*freeMemory)(void *memory);
    void (*stepFinished)(fmi2ComponentEnvironment environment, fmi2Status status);
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

/* Where several FMUs are linked into one program, each is compiled with a prefix of its own. */
#ifdef FMI2_FUNCTION_PREFIX
#define HCI_FMI2_JOINED(prefix, name) prefix##name
#define HCI_FMI2_JOIN(prefix, name)   HCI_FMI2_JOINED(prefix, name)
#define HCI_FMI2(name)                HCI_FMI2_JOIN(FMI2_FUNCTION_PREFIX, name)
#else
#define HCI_FMI2(name) name
#endif

#if defined _WIN32
#define HCI_FMI2_EXPORT __declspec(dllexport)
#elif defined __GNUC__
#define HCI_FMI2_EXPORT __attribute__((visibility("default")))
#else
#define HCI_FMI2_EXPORT
#endif

/* Declaration of a function. */
#define HCI_FMI2_FUNCTION(result, name) HCI_FMI2_EXPORT result HCI_FMI2(name)

HCI_FMI2_FUNCTION(const char *, fmi2GetTypesPlatform)(void);
HCI_FMI2_FUNCTION(const char *, fmi2GetVersion)(void);
HCI_FMI2_FUNCTION(fmi2Status, fmi2SetDebugLogging)
(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[]);
HCI_FMI2_FUNCTION(fmi2Component, fmi2Instantiate)
(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
 const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging);
HCI_FMI2_FUNCTION(void, fmi2FreeInstance)(fmi2Component c);
HCI_FMI2_FUNCTION(fmi2Status, fmi2SetupExperiment)
(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance, fmi2Real start, fmi2Boolean stop_defined,
 fmi2Real stop);
HCI_FMI2_FUNCTION(fmi2Status, fmi2EnterInitializationMode)(fmi2Component c);
HCI_FMI2_FUNCTION(fmi2Status, fmi2ExitInitializationMode)(fmi2Component c);
HCI_FMI2_FUNCTION(fmi2Status, fmi2Terminate)(fmi2Component c);
HCI_FMI2_FUNCTION(fmi2Status, fmi2Reset)(fmi2Component c);

HCI_FMI2_FUNCTION(fmi2Status, fmi2GetReal)
(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[]);
HCI_FMI2_FUNCTION(fmi2Status, fmi2GetInteger)
(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer value[]);
HCI_FMI2_FUNCTION(fmi2Status, fmi2GetBoolean)
(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Boolean value[]);
HCI_FMI2_FUNCTION(fmi2Status, fmi2GetString)
(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2String value[]);
HCI_FMI2_FUNCTION(fmi2Status, fmi2SetReal)
(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[]);
HCI_FMI2_FUNCTION(fmi2Status, fmi2SetInteger)
(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer value[]);
HCI_FMI2_FUNCTION(fmi2Status, fmi2SetBoolean)
(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Boolean value[]);
HCI_FMI2_FUNCTION(fmi2Status, fmi2SetString)
(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2String value[]);

HCI_FMI2_FUNCTION(fmi2Status, fmi2GetFMUstate)(fmi2Component c, fmi2FMUstate *state);
HCI_FMI2_FUNCTION(fmi2Status, fmi2SetFMUstate)(fmi2Component c, fmi2FMUstate state);
HCI_FMI2_FUNCTION(fmi2Status, fmi2FreeFMUstate)(fmi2Component c, fmi2FMUstate *state);
HCI_FMI2_FUNCTION(fmi2Status, fmi2SerializedFMUstateSize)
(fmi2Component c, fmi2FMUstate state, size_t *size);
HCI_FMI2_FUNCTION(fmi2Status, fmi2SerializeFMUstate)
(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size);
HCI_FMI2_FUNCTION(fmi2Status, fmi2DeSerializeFMUstate)
(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state);
HCI_FMI2_FUNCTION(fmi2Status, fmi2GetDirectionalDerivative)
(fmi2Component c, const fmi2ValueReference unknown[], size_t unknowns, const fmi2ValueReference known[],
 size_t knowns, const fmi2Real change[], fmi2Real answer[]);

HCI_FMI2_FUNCTION(fmi2Status, fmi2SetRealInputDerivatives)
(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer order[], const fmi2Real value[]);
HCI_FMI2_FUNCTION(fmi2Status, fmi2GetRealOutputDerivatives)
(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer order[], fmi2Real value[]);
HCI_FMI2_FUNCTION(fmi2Status, fmi2DoStep)
(fmi2Component c, fmi2Real from_s, fmi2Real duration_s, fmi2Boolean no_way_back);
HCI_FMI2_FUNCTION(fmi2Status, fmi2CancelStep)(fmi2Component c);
HCI_FMI2_FUNCTION(fmi2Status, fmi2GetStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value);
HCI_FMI2_FUNCTION(fmi2Status, fmi2GetRealStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value);
HCI_FMI2_FUNCTION(fmi2Status, fmi2GetIntegerStatus)
(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value);
HCI_FMI2_FUNCTION(fmi2Status, fmi2GetBooleanStatus)
(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value);
HCI_FMI2_FUNCTION(fmi2Status, fmi2GetStringStatus)
(fmi2Component c, const fmi2StatusKind kind, fmi2String *value);

#endif
