#include "cli/emit/emit_options.h"

#include "cli/terminal/terminal.h"
#include "hci/host/emit/emit.h"
#include "hci/host/foreign/foreign_target.h"

enum { BEFORE_COMMON = EMIT_COMMON - 1, CLI_COMMON_KEYS };

static const cli_choice FORMATS[] = {
    [HCI_EMIT_F32] = {"f32", "f32 (default): float rows"},
    [HCI_EMIT_I16] = {"i16", "; i16: 16-bit knots, read as amperes"},
    [HCI_EMIT_Q15] = {"q15", "; q15: the same, read as integers"},
    [HCI_EMIT_I8] = {"i8", "; i8: 8-bit knots, read as those integers"},
    [HCI_EMIT_CSV] = {"csv", "; csv, json: the rows of f32 in ID.csv or ID.json, for other programs"},
    [HCI_EMIT_JSON] = {"json", ""},
    {NULL, NULL},
};
static const cli_choice SHAPES[] = {
    [HCI_EMIT_AUTO] = {"auto", "auto (default): the fewest instructions within 1 KiB, else the fewest bytes"},
    [HCI_EMIT_LINEAR] = {"linear", "; linear: the one shape of f32"},
    [HCI_EMIT_QUADRATIC] = {"quadratic", "; quadratic"},
    [HCI_EMIT_CUBIC] = {"cubic", "; cubic"},
    {NULL, NULL},
};
static const cli_choice FRAMES[] = {
    [HCI_TABLE_ABC] = {"abc", "abc (default): phase currents"},
    [HCI_TABLE_DQ] = {"dq", "; dq: rotor frame"},
    {NULL, NULL},
};

static const cli_choice TARGETS[] = {HCI_FOREIGN_TARGETS(CLI_CHOICE_OF){NULL, NULL}};
static const cli_choice WAVES[] = {
    [HCI_FOREIGN_SINE] = {"sine", "sine (default): sin(nx + phase)"},
    [HCI_FOREIGN_COSINE] = {"cosine", "; cosine"},
    [HCI_FOREIGN_SINE_LAG] = {"sine-lag", "; sine-lag: sin(nx - phase)"},
    [HCI_FOREIGN_COSINE_LAG] = {"cosine-lag", "; cosine-lag"},
    {NULL, NULL},
};
static const cli_choice DIRECTIONS[] = {
    {"1", "1 (default)"},
    {"-1", "; -1: its angle falls when the machine turns in its positive direction"},
    {NULL, NULL},
};

const cli_option cli_emit_options[] = {
    [EMIT_NAME] = {"name", 0, CLI_TEXT, "ID", .help = "of the table and its files, a C identifier"},
    [EMIT_FORMAT] = {"format", 0, CLI_CHOICE, "NAME", NULL, .choices = FORMATS,
                     .remedy = "q31 is not made: q15 keeps 0.01 % of the peak, a tenth of what a current "
                               "sensor tells"},
    [EMIT_SHAPE] = {"shape", 0, CLI_CHOICE, "NAME", NULL, .choices = SHAPES},
    [EMIT_FRAME] = {"frame", 0, CLI_CHOICE, "NAME", NULL, .choices = FRAMES},
    [EMIT_MAX_ERROR] =
        {"max-error", 0, CLI_NUMBER, "A",
         .help = "the fewest points that keep every current within it (1 % of the peak; with --machine "
                 "what adds a tenth or less to the ripple to expect)",
         .low = 1e-12, .high = 1e9},
    [EMIT_POINTS] = {"points", 0, CLI_WHOLE, "N",
                     .help = "instead: rows of a period; of i16, q15 and i8 steps in the part that is kept; "
                             "with --for a power "
                             "of two",
                     .low = 1.0, .high = HCI_EMIT_MAX_POINTS},
    [EMIT_MAX_BYTES] = {"max-bytes", 0, CLI_WHOLE, "N",
                        .help = "of rows or knots; without --max-error: the least error in so many",
                        .low = 1.0, .high = 1e9},
    [EMIT_MAX_INSTRUCTIONS] = {"max-instructions", 0, CLI_WHOLE, "N", .help = "of one call on a Cortex-M4F",
                               .low = 1.0, .high = 1e6},
    [EMIT_PER_TORQUE] = {"per-torque", 0, CLI_FLAG, NULL,
                         .help = "two parts, i = T*A + B, for every mean torque T (needs a folder)"},
    [EMIT_REFERENCE] = {"reference-torque", 0, CLI_NUMBER, "NM",
                        .help = "with --per-torque: the largest T (default: the one solved for)", .low = 1e-9,
                        .high = 1e9},
    [EMIT_MACHINE] =
        {"machine", 0, CLI_FOLDER, "FOLDER",
         .help = "the machine of the currents: its name and pole pairs go into the header, and the ripple "
                 "that the table leaves is told; needed with --drive and --for"},
    [EMIT_DRIVE] =
        {"drive", 0, CLI_FILE, "FILE",
         .help = "drive.csv: orders of current and voltage for hci/loop.h, which a current loop can follow; "
                 "several folders are levels of torque"},
    [EMIT_SPEED] =
        {"speed", 0, CLI_NUMBER, "RPM",
         .help = "with --drive: up to which orders are used (default: as far as the voltage and the sampling "
                 "do)",
         .low = 1e-3, .high = 1e6},
    [EMIT_FOR] = {"for", 0, CLI_CHOICE, "TARGET",
                  .help = "the compensation map of this drive instead, in its own form:", .choices = TARGETS},
    [EMIT_ENCODER_OFFSET] = {"encoder-offset", 0, CLI_NUMBER, "DEG",
                             .help =
                                 "with --for: the drive's angle where that of the machine is 0 (0); of its "
                                 "encoder, or electrical",
                             .low = -1e6, .high = 1e6},
    [EMIT_ENCODER_DIRECTION] = {"encoder-direction", 0, CLI_CHOICE, "SIGN",
                                .help = "with --for:", .choices = DIRECTIONS},
    [EMIT_TORQUE_CONSTANT] =
        {"torque-constant", 0, CLI_NUMBER, "NM_PER_A",
         .help = "with --for: torque of 1 A of i_q as the drive has it (that of the machine)", .low = 1e-9,
         .high = 1e6},
    [EMIT_COUNTS] = {"counts-per-ampere", 0, CLI_NUMBER, "N",
                     .help = "with --for: the drive's scale of the current", .low = 1e-6, .high = 1e9},
    [EMIT_WAVE] = {"wave", 0, CLI_CHOICE, "NAME",
                   .help = "with --for beckhoff: what its amplitude and phase mean:", .choices = WAVES},
    [EMIT_BLOB] = {"blob", 0, CLI_FLAG, NULL,
                   .help = "ID.bin too: the table as bytes that a bootloader or a bus brings, for "
                           "hci/blob.h; with --drive for "
                           "hci/loop_blob.h"},
    [EMIT_ANGLE_OF_LOGS] =
        {"angle-of-logs", 0, CLI_FLAG, NULL,
         .help = "the header, or with --drive and --for a remark, says that the angle is that of "
                 "the logs, and where the electrical zero is, is not known"},
    [EMIT_ANGLE_OFFSET] = {"angle-offset", 0, CLI_NUMBER, "DEG",
                           .help =
                               "the header says that theta is the electrical angle of the logs plus this, "
                               "in degrees, as they were read",
                           .low = -1e6, .high = 1e6},
    [EMIT_ORDER_BASE] = CLI_TABLE_ORDER_BASE_OPTION,
    [EMIT_OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where ID.h and ID.c go (default: here)"},
    CLI_COMMON_OPTIONS};

/* Options of which any is refused with any of the others, or without all of them; END behind the last. */
enum { END = -1, MOST_KEYS = 9 };

static const struct {
    int any[MOST_KEYS];
    bool is_with;
    int other[3];
    const char *words;
} RULE[] = {
    {{EMIT_DRIVE, END},
     true,
     {EMIT_FOR, END},
     "--drive is for hci/loop.h, --for TARGET for another maker's drive; give one of them"},
    {{EMIT_FOR, END}, false, {EMIT_MACHINE, END}, "--for TARGET needs --machine FOLDER"},
    {{EMIT_DRIVE, END}, false, {EMIT_MACHINE, END}, "--drive FILE needs --machine FOLDER"},
    {{EMIT_BLOB, END},
     true,
     {EMIT_FOR, END},
     "--blob is for hci/table.h, hci/table_i16.h or hci/loop.h; leave out --for"},
    {{EMIT_ENCODER_OFFSET, EMIT_ENCODER_DIRECTION, EMIT_TORQUE_CONSTANT, EMIT_COUNTS, EMIT_WAVE, END},
     false,
     {EMIT_FOR, END},
     "--encoder-offset, --encoder-direction, --torque-constant, --counts-per-ampere and --wave go with --for "
     "TARGET"},
    {{EMIT_FORMAT, EMIT_SHAPE, EMIT_FRAME, EMIT_MAX_ERROR, EMIT_MAX_BYTES, EMIT_MAX_INSTRUCTIONS, EMIT_SPEED,
      END},
     true,
     {EMIT_FOR, END},
     "the form of a map --for TARGET is that of the drive; leave out --format, --shape, --frame, "
     "--max-error, --max-bytes, --max-instructions and --speed"},
    {{EMIT_ANGLE_OFFSET, END},
     true,
     {EMIT_FOR, EMIT_DRIVE, END},
     "--angle-offset is a line in the header of a table; a map takes --encoder-offset, and the angle that "
     "goes to hci/loop.h the offset itself"},
    {{EMIT_SPEED, END}, false, {EMIT_DRIVE, END}, "--speed goes with --drive"},
    {{EMIT_POINTS, EMIT_REFERENCE, EMIT_FORMAT, EMIT_SHAPE, EMIT_MAX_BYTES, EMIT_MAX_INSTRUCTIONS, END},
     true,
     {EMIT_DRIVE, END},
     "--drive makes its tables in RAM, of floats; give --max-error alone of what says their size, and no "
     "--format, --shape or --reference-torque"},
    {{EMIT_POINTS, END}, true, {EMIT_MAX_ERROR, END}, "give --points or --max-error, not both"},
    {{EMIT_REFERENCE, END}, false, {EMIT_PER_TORQUE, END}, "--reference-torque goes with --per-torque"},
};

/* Whether any of the options is given. */
static bool is_any(const cli_arguments *a, const int *key)
{
    for (; *key != END; ++key)
        if (a->given[*key]) return true;
    return false;
}

/* The first rule that is broken; NULL: none. */
static const char *broken_rule(const cli_arguments *a)
{
    const bool drive = a->given[EMIT_DRIVE];
    if (!a->value[EMIT_NAME]) return "the table has no name; add --name ID";
    for (size_t k = 0; k < sizeof RULE / sizeof *RULE; ++k)
        if (is_any(a, RULE[k].any) && is_any(a, RULE[k].other) == RULE[k].is_with) return RULE[k].words;
    if (a->words > 1 && !drive)
        return "several folders are levels of torque, which need --drive and --machine";
    if (drive && a->given[EMIT_FRAME] && a->choice[EMIT_FRAME] != HCI_TABLE_DQ)
        return "--drive is in the rotor frame; give --frame dq, or none";
    return NULL;
}

hci_status cli_emit_check(const cli_arguments *a, hci_note *note)
{
    const char *words = broken_rule(a);
    return words ? hci_note_set(note, HCI_ERROR_ARGUMENT, "emit: %s", words) : HCI_OK;
}

const char *cli_emit_folder(const cli_arguments *a)
{
    return a->value[EMIT_OUT] ? a->value[EMIT_OUT] : ".";
}

bool cli_emit_wants_json(const cli_arguments *a)
{
    return a->given[JSON];
}
