/* The C interface of FMI 3.0, as far as an FMU has to provide it: types, numbers and signatures as the
 * standard (3.0.1, sections 2.2, 3.3, 4.3 and 5.3) states them. */
#ifndef HCI_SRC_FMU_FMI3_H
#define HCI_SRC_FMU_FMI3_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "fmu/fmi3_absent.h"

typedef void *fmi3Instance;
typedef void *fmi3InstanceEnvironment;
typedef void *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean;
typedef char fmi3Char;
typedef const fmi3Char *fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte *fmi3Binary;
typedef bool fmi3Clock;

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum {
    fmi3Independent,
    fmi3Constant,
    fmi3Fixed,
    fmi3Tunable,
    fmi3Discrete,
    fmi3Dependent
} fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;

typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment environment, fmi3Status status,
                                       fmi3String category, fmi3String message);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment environment);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment environment, fmi3Float64 time_s,
                                               fmi3Boolean set_requested, fmi3Boolean get_allowed,
                                               fmi3Boolean step_finished, fmi3Boolean can_return,
                                               fmi3Boolean *return_requested, fmi3Float64 *return_time_s);
typedef void (*fmi3LockPreemptionCallback)(void);
typedef void (*fmi3UnlockPreemptionCallback)(void);

/* Where several FMUs are linked into one program, each is compiled with a prefix of its own. */
#ifdef FMI3_FUNCTION_PREFIX
#define HCI_FMI3_JOINED(prefix, name) prefix##name
#define HCI_FMI3_JOIN(prefix, name)   HCI_FMI3_JOINED(prefix, name)
#define HCI_FMI3(name)                HCI_FMI3_JOIN(FMI3_FUNCTION_PREFIX, name)
#else
#define HCI_FMI3(name) name
#endif

#if defined _WIN32
#define HCI_FMI3_EXPORT __declspec(dllexport)
#elif defined __GNUC__
#define HCI_FMI3_EXPORT __attribute__((visibility("default")))
#else
#define HCI_FMI3_EXPORT
#endif

/* Declaration of a function. */
#define HCI_FMI3_FUNCTION(result, name) HCI_FMI3_EXPORT result HCI_FMI3(name)

/* A getter and a setter. */
#define HCI_FMI3_VALUES(type)                                                                                \
    HCI_FMI3_FUNCTION(fmi3Status, fmi3Get##type)                                                             \
    (fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3##type value[], size_t values);            \
    HCI_FMI3_FUNCTION(fmi3Status, fmi3Set##type)                                                             \
    (fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3##type value[], size_t values);

HCI_FMI3_FUNCTION(const char *, fmi3GetVersion)(void);
HCI_FMI3_FUNCTION(fmi3Status, fmi3SetDebugLogging)
(fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String categories[]);
HCI_FMI3_FUNCTION(fmi3Instance, fmi3InstantiateModelExchange)
(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
 fmi3InstanceEnvironment environment, fmi3LogMessageCallback log);
HCI_FMI3_FUNCTION(fmi3Instance, fmi3InstantiateCoSimulation)
(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
 fmi3Boolean events, fmi3Boolean early_return, const fmi3ValueReference required[], size_t required_count,
 fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update);
HCI_FMI3_FUNCTION(fmi3Instance, fmi3InstantiateScheduledExecution)
(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
 fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
 fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock);
HCI_FMI3_FUNCTION(void, fmi3FreeInstance)(fmi3Instance c);
HCI_FMI3_FUNCTION(fmi3Status, fmi3EnterInitializationMode)
(fmi3Instance c, fmi3Boolean tolerance_defined, fmi3Float64 tolerance, fmi3Float64 start,
 fmi3Boolean stop_defined, fmi3Float64 stop);
HCI_FMI3_FUNCTION(fmi3Status, fmi3ExitInitializationMode)(fmi3Instance c);
HCI_FMI3_FUNCTION(fmi3Status, fmi3Terminate)(fmi3Instance c);
HCI_FMI3_FUNCTION(fmi3Status, fmi3Reset)(fmi3Instance c);

HCI_FMI3_VALUES(Float64)
HCI_FMI3_VALUES(Int32)
HCI_FMI3_VALUES(Boolean)

HCI_FMI3_FUNCTION(fmi3Status, fmi3GetFMUState)(fmi3Instance c, fmi3FMUState *state);
HCI_FMI3_FUNCTION(fmi3Status, fmi3SetFMUState)(fmi3Instance c, fmi3FMUState state);
HCI_FMI3_FUNCTION(fmi3Status, fmi3FreeFMUState)(fmi3Instance c, fmi3FMUState *state);
HCI_FMI3_FUNCTION(fmi3Status, fmi3SerializedFMUStateSize)(fmi3Instance c, fmi3FMUState state, size_t *size);
HCI_FMI3_FUNCTION(fmi3Status, fmi3SerializeFMUState)
(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size);
HCI_FMI3_FUNCTION(fmi3Status, fmi3DeserializeFMUState)
(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state);

HCI_FMI3_FUNCTION(fmi3Status, fmi3GetNumberOfEventIndicators)(fmi3Instance c, size_t *n);
HCI_FMI3_FUNCTION(fmi3Status, fmi3GetNumberOfContinuousStates)(fmi3Instance c, size_t *n);

HCI_FMI3_FUNCTION(fmi3Status, fmi3EnterStepMode)(fmi3Instance c);
HCI_FMI3_FUNCTION(fmi3Status, fmi3DoStep)
(fmi3Instance c, fmi3Float64 from_s, fmi3Float64 duration_s, fmi3Boolean no_way_back, fmi3Boolean *event,
 fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *last_s);

/* Those that are there and answer that they are not. */
#define HCI_FMI3_DECLARE(name, asked, parameters) HCI_FMI3_FUNCTION(fmi3Status, name) parameters;
HCI_FMI3_ABSENT(HCI_FMI3_DECLARE)
#undef HCI_FMI3_DECLARE

#endif
