/* The options of `emit`, and which of them go together. Uses the folder command. */
#ifndef HCI_CLI_EMIT_OPTIONS_H
#define HCI_CLI_EMIT_OPTIONS_H

#include "cli/command/option.h"
#include "hci/host/base/note.h"

/* Places of the options. */
typedef enum {
    EMIT_NAME,
    EMIT_FORMAT,
    EMIT_SHAPE,
    EMIT_FRAME,
    EMIT_MAX_ERROR,
    EMIT_POINTS,
    EMIT_MAX_BYTES,
    EMIT_MAX_INSTRUCTIONS,
    EMIT_PER_TORQUE,
    EMIT_REFERENCE,
    EMIT_MACHINE,
    EMIT_DRIVE,
    EMIT_SPEED,
    EMIT_FOR,
    EMIT_ENCODER_OFFSET,
    EMIT_ENCODER_DIRECTION,
    EMIT_TORQUE_CONSTANT,
    EMIT_COUNTS,
    EMIT_WAVE,
    EMIT_BLOB,
    EMIT_ANGLE_OF_LOGS,
    EMIT_ANGLE_OFFSET,
    EMIT_ORDER_BASE,
    EMIT_OUT,
    EMIT_COMMON /* those of all commands begin here */
} cli_emit_key;

extern const cli_option cli_emit_options[];

/* Options that exclude or need each other; the first that is broken is said. HCI_ERROR_ARGUMENT. */
hci_status cli_emit_check(const cli_arguments *arguments, hci_note *note);

/* --out, or where one is. */
const char *cli_emit_folder(const cli_arguments *arguments);

/* --json. */
bool cli_emit_wants_json(const cli_arguments *arguments);

#endif
