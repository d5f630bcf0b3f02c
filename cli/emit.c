#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/currents/solution_folder.h"
#include "hci/host/emit/emit.h"
#include "hci/host/emit/emit_foreign.h"
#include "hci/host/emit/emit_loop.h"
#include "hci/host/report/summary.h"

enum {
    NAME,
    FORMAT,
    SHAPE,
    FRAME,
    MAX_ERROR,
    POINTS,
    MAX_BYTES,
    MAX_INSTRUCTIONS,
    PER_TORQUE,
    REFERENCE,
    MACHINE,
    DRIVE,
    SPEED,
    FOR,
    ENCODER_OFFSET,
    ENCODER_DIRECTION,
    TORQUE_CONSTANT,
    COUNTS,
    WAVE,
    BLOB,
    OUT,
    CLI_COMMON_KEYS
};

static const cli_choice FORMATS[] = {
    [HCI_EMIT_F32] = {"f32", "f32 (default): float rows"},
    [HCI_EMIT_I16] = {"i16", "; i16: 16-bit knots, read as amperes"},
    [HCI_EMIT_Q15] = {"q15", "; q15: the same, read as integers"},
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

static const cli_option OPTIONS[] =
    {[NAME] = {"name", 0, CLI_TEXT, "ID", .help = "of the table and its files, a C identifier"},
     [FORMAT] = {"format", 0, CLI_CHOICE, "NAME", NULL, .choices = FORMATS},
     [SHAPE] = {"shape", 0, CLI_CHOICE, "NAME", NULL, .choices = SHAPES},
     [FRAME] = {"frame", 0, CLI_CHOICE, "NAME", NULL, .choices = FRAMES},
     [MAX_ERROR] = {"max-error", 0, CLI_NUMBER, "A",
                    .help = "the fewest points that keep every current within it (1 % of the peak)",
                    .low = 1e-12, .high = 1e9},
     [POINTS] =
         {"points", 0, CLI_WHOLE, "N",
          .help =
              "instead: rows of a period; of i16 and q15 steps in the part that is kept; with --for a power "
              "of two",
          .low = 1.0, .high = HCI_EMIT_MAX_POINTS},
     [MAX_BYTES] = {"max-bytes", 0, CLI_WHOLE, "N",
                    .help = "of rows or knots; without --max-error: the least error in so many", .low = 1.0,
                    .high = 1e9},
     [MAX_INSTRUCTIONS] = {"max-instructions", 0, CLI_WHOLE, "N", .help = "of one call on a Cortex-M4F",
                           .low = 1.0, .high = 1e6},
     [PER_TORQUE] = {"per-torque", 0, CLI_FLAG, NULL,
                     .help = "two parts, i = T*A + B, for every mean torque T (needs a folder)"},
     [REFERENCE] = {"reference-torque", 0, CLI_NUMBER, "NM",
                    .help = "with --per-torque: the largest T (default: the one solved for)", .low = 1e-9,
                    .high = 1e9},
     [MACHINE] = {"machine", 0, CLI_FOLDER, "FOLDER",
                  .help =
                      "the machine of the currents: its name and pole pairs go into the header; needed with "
                      "--drive and --for"},
     [DRIVE] =
         {"drive", 0, CLI_FILE, "FILE",
          .help = "drive.csv: orders of current and voltage for hci/loop.h, which a current loop can follow; "
                  "several folders are levels of torque"},
     [SPEED] =
         {"speed", 0, CLI_NUMBER, "RPM",
          .help =
              "with --drive: up to which orders are used (default: as far as the voltage and the sampling "
              "do)",
          .low = 1e-3, .high = 1e6},
     [FOR] = {"for", 0, CLI_CHOICE, "TARGET",
              .help = "the compensation map of this drive instead, in its own form:", .choices = TARGETS},
     [ENCODER_OFFSET] = {"encoder-offset", 0, CLI_NUMBER, "DEG",
                         .help = "with --for: the drive's angle where that of the machine is 0 (0); of its "
                                 "encoder, or electrical",
                         .low = -1e6, .high = 1e6},
     [ENCODER_DIRECTION] = {"encoder-direction", 0, CLI_CHOICE, "SIGN",
                            .help = "with --for:", .choices = DIRECTIONS},
     [TORQUE_CONSTANT] = {"torque-constant", 0, CLI_NUMBER, "NM_PER_A",
                          .help =
                              "with --for: torque of 1 A of i_q as the drive has it (that of the machine)",
                          .low = 1e-9, .high = 1e6},
     [COUNTS] = {"counts-per-ampere", 0, CLI_NUMBER, "N",
                 .help = "with --for: the drive's scale of the current", .low = 1e-6, .high = 1e9},
     [WAVE] = {"wave", 0, CLI_CHOICE, "NAME",
               .help = "with --for beckhoff: what its amplitude and phase mean:", .choices = WAVES},
     [BLOB] = {"blob", 0, CLI_FLAG, NULL,
               .help = "ID.bin too: the table as bytes that a bootloader or a bus brings, for hci/blob.h"},
     [OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where ID.h and ID.c go (default: here)"},
     CLI_COMMON_OPTIONS};

/* The last part of a path, without slashes at its end. */
static void folder_name(const char *path, char *name, size_t size)
{
    size_t end = strlen(path), begin;
    while (end > 1 && path[end - 1] == '/')
        --end;
    for (begin = end; begin > 0 && path[begin - 1] != '/'; --begin)
        continue;
    snprintf(name, size, "%.*s", (int)(end - begin), path + begin);
}

typedef struct {
    hci_currents current, per_Nm;
    char provenance[2][160];
    const char *lines[2];
    hci_emit_request request;
    hci_machine_data machine; /* empty where it is not given */
    char machine_name[64];
} inputs;

/* What the header and the blob say of the machine, and the torque of a folder that was solved for one. */
static hci_status read_facts(const cli_arguments *a, inputs *in, hci_note *note)
{
    hci_emit_facts *facts = &in->request.facts;
    hci_note none = {{0}};
    hci_status status = HCI_OK;
    in->request.blob = a->given[BLOB];
    if (hci_solution_is_folder(a->word[0]) &&
        hci_solution_read_mean_torque(a->word[0], &facts->mean_torque_Nm, &none) != HCI_OK)
        facts->mean_torque_Nm = 0.0;
    if (!a->given[MACHINE]) return HCI_OK;
    status = hci_machine_read(a->value[MACHINE], &in->machine, note);
    if (status) return status;
    facts->pole_pairs = (size_t)in->machine.pole_pairs;
    folder_name(a->value[MACHINE], in->machine_name, sizeof in->machine_name);
    facts->machine = in->machine_name;
    return HCI_OK;
}

static hci_status read_parts(const cli_arguments *a, inputs *in, hci_note *note)
{
    const char *from = a->word[0];
    hci_status status;
    if (!hci_solution_is_folder(from))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "--per-torque needs the folder that `solve` wrote, not one file: %s", from);
    if (!hci_solution_has_parts(from))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: no currents_per_Nm.csv: these currents are not linear in the mean torque (a held "
            "fundamental, or reluctance torque); leave out --per-torque",
            from);
    status = hci_solution_read_currents(from, HCI_SOLUTION_CURRENTS_CONSTANT, &in->current, note);
    if (!status) status = hci_solution_read_currents(from, HCI_SOLUTION_CURRENTS_PER_NM, &in->per_Nm, note);
    in->request.reference_torque_Nm = cli_number_or(a, REFERENCE, 0.0);
    if (!status && !a->given[REFERENCE])
        status = hci_solution_read_mean_torque(from, &in->request.reference_torque_Nm, note);
    in->request.reference_torque_Nm = fabs(in->request.reference_torque_Nm);
    in->request.per_Nm = in->per_Nm.wave;
    in->request.per_Nm_count = in->per_Nm.count;
    return status;
}

/* Whether any of the options is given. */
static bool any_of(const cli_arguments *a, const int *key, size_t count)
{
    bool any = false;
    for (size_t k = 0; k < count; ++k)
        any = any || a->given[key[k]];
    return any;
}

#define ANY(a, ...) any_of(a, (const int[]){__VA_ARGS__}, sizeof(const int[]){__VA_ARGS__} / sizeof(int))

/* Options that exclude or need each other; the first that is broken is said. */
static hci_status check_together(const cli_arguments *a, hci_note *note)
{
    const bool drive = a->given[DRIVE], target = a->given[FOR], machine = a->given[MACHINE];
    const struct {
        bool broken;
        const char *words;
    } rule[] = {
        {!a->value[NAME], "the table has no name; add --name ID"},
        {drive && target,
         "--drive is for hci/loop.h, --for TARGET for another maker's drive; give one of them"},
        {target && !machine, "--for TARGET needs --machine FOLDER"},
        {drive && !machine, "--drive FILE needs --machine FOLDER"},
        {a->given[BLOB] && (drive || target),
         "--blob is a table for hci/table.h or hci/table_i16.h; leave out --drive and --for"},
        {!target && ANY(a, ENCODER_OFFSET, ENCODER_DIRECTION, TORQUE_CONSTANT, COUNTS, WAVE),
         "--encoder-offset, --encoder-direction, --torque-constant, --counts-per-ampere and --wave go with "
         "--for TARGET"},
        {target && ANY(a, FORMAT, SHAPE, FRAME, MAX_ERROR, MAX_BYTES, MAX_INSTRUCTIONS, SPEED),
         "the form of a map --for TARGET is that of the drive; leave out --format, --shape, --frame, "
         "--max-error, --max-bytes, --max-instructions and --speed"},
        {a->given[SPEED] && !drive, "--speed goes with --drive"},
        {a->words > 1 && !drive, "several folders are levels of torque, which need --drive and --machine"},
        {drive && ANY(a, POINTS, REFERENCE, FORMAT, SHAPE, MAX_BYTES, MAX_INSTRUCTIONS),
         "--drive makes its tables in RAM, of floats; give --max-error alone of what says their size, and no "
         "--format, --shape or --reference-torque"},
        {drive && a->given[FRAME] && a->choice[FRAME] != HCI_TABLE_DQ,
         "--drive is in the rotor frame; give --frame dq, or none"},
        {a->value[POINTS] && a->value[MAX_ERROR], "give --points or --max-error, not both"},
        {a->given[REFERENCE] && !a->given[PER_TORQUE], "--reference-torque goes with --per-torque"},
    };
    for (size_t k = 0; k < sizeof rule / sizeof *rule; ++k)
        if (rule[k].broken) return hci_note_set(note, HCI_ERROR_ARGUMENT, "emit: %s", rule[k].words);
    return HCI_OK;
}

static hci_status read_options(const cli_arguments *a, hci_emit_request *r, hci_note *note)
{
    r->name = a->value[NAME];
    r->format = (hci_emit_format)a->choice[FORMAT];
    r->shape = (hci_emit_shape)a->choice[SHAPE];
    r->frame = (hci_table_frame)a->choice[FRAME];
    r->points = (size_t)cli_number_or(a, POINTS, 0.0);
    r->max_error_A = cli_number_or(a, MAX_ERROR, 0.0);
    r->max_bytes = (size_t)cli_number_or(a, MAX_BYTES, 0.0);
    r->max_instructions = (size_t)cli_number_or(a, MAX_INSTRUCTIONS, 0.0);
    return check_together(a, note);
}

static bool has_zero_sequence(const hci_currents *c)
{
    for (size_t k = 0; k < c->count; ++k)
        if (c->wave[k].sequence == 0) return true;
    return false;
}

static hci_status read_inputs(const cli_arguments *a, inputs *in, hci_note *note)
{
    hci_status status = read_options(a, &in->request, note);
    if (!status && a->given[PER_TORQUE])
        status = read_parts(a, in, note);
    else if (!status)
        status = hci_solution_read_currents(a->word[0], HCI_SOLUTION_CURRENTS, &in->current, note);
    if (status) return status;
    in->request.currents = in->current.wave;
    in->request.current_count = in->current.count;
    in->request.has_neutral = has_zero_sequence(&in->current) || has_zero_sequence(&in->per_Nm);
    in->request.input_hash = in->current.hash ^ (in->per_Nm.hash * 31u);
    snprintf(in->provenance[0], sizeof in->provenance[0], "%zu current components, solved by hci-solve",
             in->current.count);
    in->lines[0] = in->provenance[0];
    in->lines[1] = hci_solution_verdict_words(hci_solution_read_verdict(a->word[0]));
    in->request.provenance = in->lines;
    in->request.provenance_count = in->lines[1][0] != '\0' ? 2 : 1;
    return HCI_OK;
}

/* Currents that are not what was asked of `solve`. */
static void remark_currents(const cli_arguments *a)
{
    for (size_t k = 0; k < a->words; ++k) {
        hci_note remark = {{0}};
        hci_solution_remark(a->word[k], &remark);
        cli_remark(&remark);
    }
}

/* What was looked at, the one that was written marked. */
static void show_choices(const hci_emit_result *result)
{
    cli_say("               format shape      points   bytes   error A  Cortex-M4F  M0+ (instructions)\n");
    for (size_t k = 0; k < result->choices; ++k) {
        const hci_emit_choice *c = &result->choice[k];
        const bool chosen = c->format == result->chosen.format && c->shape == result->chosen.shape;
        cli_say("  %-11s  %-6s %-9s %7zu %7zu  %8.3g  %10u  %3u\n",
                chosen    ? "written"
                : c->fits ? "possible"
                          : "too much",
                hci_emit_format_name(c->format), hci_emit_shape_name(c->shape), c->points, c->bytes,
                c->max_error_A, c->cortex_m4f, c->cortex_m0_plus);
    }
}

static void show(const hci_emit_request *r, const hci_emit_result *result, const char *folder)
{
    const bool is_data = r->format == HCI_EMIT_CSV || r->format == HCI_EMIT_JSON;
    if (is_data)
        cli_say(CLI_GOOD "emitted" CLI_PLAIN ": %s/%s.%s\n", folder, r->name,
                hci_emit_format_name(r->format));
    else
        cli_say(CLI_GOOD "emitted" CLI_PLAIN ": %s/%s.h and %s.c\n", folder, r->name, r->name);
    show_choices(result);
    cli_say("  table        %zu values in %zu part%s in a row, frame %s; period %zu electrical turn%s",
            result->columns, result->parts, result->parts == 1 ? "" : "s",
            r->frame == HCI_TABLE_ABC ? "abc" : "dq", result->period_turns,
            result->period_turns == 1 ? "" : "s");
    if (result->sectors > 1) cli_say(", 1/%zu kept", result->sectors);
    cli_say("\n  error        at most %.3g A of a peak of %.4g A", result->chosen.max_error_A,
            result->peak_A);
    if (r->per_Nm) cli_say(", up to %.4g N·m", r->reference_torque_Nm);
    if (r->blob) cli_say("\n  blob         %s.bin, for hci/blob.h", r->name);
    if (is_data)
        cli_say("\n  rows         straight lines between them; after the last comes the first\n");
    else
        cli_say("\n  runtime      hci/%s\n", r->format == HCI_EMIT_F32 ? "table.h" : "table_i16.h");
}

/* ---- for a drive ---- */

typedef struct {
    hci_machine_data machine;
    hci_drive_data drive;
    hci_loop_levels levels;
    hci_emit_loop_request request;
} drive_inputs;

static hci_status read_drive_inputs(const cli_arguments *a, drive_inputs *in, hci_note *note)
{
    hci_status status = check_together(a, note);
    if (!status) status = hci_machine_read(a->value[MACHINE], &in->machine, note);
    if (!status) status = hci_drive_read(a->value[DRIVE], &in->drive, note);
    if (!status) status = hci_loop_levels_read(a->word, a->words, a->given[PER_TORQUE], &in->levels, note);
    in->request = (hci_emit_loop_request){.name = a->value[NAME],
                                          .machine = &in->machine,
                                          .drive = &in->drive,
                                          .levels = in->levels.level,
                                          .level_count = in->levels.count,
                                          .max_error_A = cli_number_or(a, MAX_ERROR, 0.0),
                                          .speed_rad_per_s = cli_number_or(a, SPEED, 0.0) * HCI_PI / 30.0,
                                          .input_hash = in->levels.hash};
    return status;
}

static void show_speed(const char *what, double speed_rad_per_s)
{
    if (isfinite(speed_rad_per_s))
        cli_say("  %s all orders up to %.4g rpm\n", what, speed_rad_per_s * 30.0 / HCI_PI);
}

static void show_loop(const hci_emit_loop_request *r, const hci_emit_loop_result *result, const char *folder)
{
    cli_say(CLI_GOOD "emitted" CLI_PLAIN ": %s/%s.h and %s.c\n", folder, r->name, r->name);
    cli_say(
        "  orders       %zu up to %.4g, %zu level%s of torque from %.4g to %.4g N·m, %zu bytes of flash\n",
        result->orders, result->highest_order, result->levels, result->levels == 1 ? "" : "s",
        result->torque_low_Nm, result->torque_high_Nm, result->flash_bytes);
    cli_say("  table        %zu points, %zu times in %zu electrical turn%s; %zu bytes of RAM, %zu with "
            "feedforward\n",
            result->points, result->repeats, result->period_turns, result->period_turns == 1 ? "" : "s",
            result->ram_bytes, result->feedforward_ram_bytes);
    cli_say("  error        at most %.3g A of a current vector of %.4g A\n", result->max_error_A,
            result->peak_A);
    cli_say("  lead         %.4g us\n", 1e6 * result->lead_s);
    show_speed("voltage     ", result->voltage_rad_per_s);
    show_speed("sampling    ", result->sampled_rad_per_s);
    cli_say("  runtime      hci/loop.h and hci/table.h\n");
}

static int run_for_drive(const cli_arguments *a)
{
    const char *folder = a->value[OUT] ? a->value[OUT] : ".";
    hci_emit_loop_result result;
    hci_note note = {{0}};
    drive_inputs in;
    memset(&in, 0, sizeof in);
    hci_drive_init(&in.drive);
    hci_status status = read_drive_inputs(a, &in, &note);
    if (!status) status = hci_emit_loop(folder, &in.request, &result, &note);
    if (!status && cli_is_wordy()) show_loop(&in.request, &result, folder);
    if (!status) remark_currents(a);
    if (!status && a->given[JSON]) status = cli_print_json(hci_emit_loop_json(&in.request, &result), &note);
    hci_loop_levels_release(&in.levels);
    hci_drive_release(&in.drive);
    hci_machine_release(&in.machine);
    return status ? cli_fail(status, &note) : 0;
}

/* ---- for another maker's drive ---- */

typedef struct {
    inputs currents;
    hci_machine_data machine;
    hci_emit_foreign_request request;
} foreign_inputs;

static hci_status read_foreign_inputs(const cli_arguments *a, foreign_inputs *in, hci_note *note)
{
    const hci_emit_request *currents = &in->currents.request;
    hci_status status = read_inputs(a, &in->currents, note);
    if (!status) status = hci_machine_read(a->value[MACHINE], &in->machine, note);
    in->request =
        (hci_emit_foreign_request){.name = currents->name,
                                   .target = (hci_foreign_name)a->choice[FOR],
                                   .machine_folder = a->value[MACHINE],
                                   .machine = &in->machine,
                                   .currents = currents->currents,
                                   .current_count = currents->current_count,
                                   .per_Nm = currents->per_Nm,
                                   .per_Nm_count = currents->per_Nm_count,
                                   .reference_torque_Nm = currents->reference_torque_Nm,
                                   .points = currents->points,
                                   .torque_constant_Nm_per_A = cli_number_or(a, TORQUE_CONSTANT, 0.0),
                                   .wave = (hci_foreign_wave)a->choice[WAVE],
                                   .counts_per_A = cli_number_or(a, COUNTS, 0.0),
                                   .encoder_offset_deg = cli_number_or(a, ENCODER_OFFSET, 0.0),
                                   .encoder_direction = a->choice[ENCODER_DIRECTION] == 1 ? -1 : 1,
                                   .input_hash = currents->input_hash};
    return status;
}

static void show_foreign(const hci_emit_foreign_request *r, const hci_emit_foreign_result *x,
                         const char *folder)
{
    const char *unit = hci_foreign_is_torque(r->target) ? "N·m" : "A";
    cli_say(CLI_GOOD "emitted" CLI_PLAIN " for %s into %s: %s\n", hci_foreign_word(r->target), folder,
            x->files);
    cli_say("  holds        %s\n  not          %s\n  form         %s\n", x->carries, x->lacks, x->samples);
    if (x->unit > 0.0)
        cli_say("  rounding     to whole numbers of %.4g %s; the largest value is %.4g %s\n", x->unit, unit,
                x->peak, unit);
    if (x->cut) cli_say("  cut          %zu values that are too large for it\n", x->cut);
    if (x->left_out)
        cli_say("  left out     %zu orders for which it has no room, the largest %.4g %s\n", x->left_out,
                x->left_out_amplitude, unit);
    cli_say("  ripple       peak to peak, N·m         sine    with this map\n");
    for (size_t k = 0; k < x->ripples; ++k)
        cli_say("               at %8.4g N·m    %10.4g   %10.4g\n", x->ripple[k].torque_Nm,
                x->ripple[k].without_Nm, x->ripple[k].with_Nm);
}

static int run_for_foreign(const cli_arguments *a)
{
    const char *folder = a->value[OUT] ? a->value[OUT] : ".";
    hci_emit_foreign_result result;
    hci_note note = {{0}};
    foreign_inputs in;
    memset(&in, 0, sizeof in);
    hci_status status = read_foreign_inputs(a, &in, &note);
    if (!status) status = hci_emit_foreign(folder, &in.request, &result, &note);
    if (!status && cli_is_wordy()) show_foreign(&in.request, &result, folder);
    if (!status) remark_currents(a);
    if (!status && a->given[JSON])
        status = cli_print_json(hci_emit_foreign_json(&in.request, &result), &note);
    hci_machine_release(&in.machine);
    hci_currents_release(&in.currents.current);
    hci_currents_release(&in.currents.per_Nm);
    return status ? cli_fail(status, &note) : 0;
}

static int run(const cli_arguments *a)
{
    if (a->given[DRIVE]) return run_for_drive(a);
    if (a->given[FOR]) return run_for_foreign(a);
    const char *folder = a->value[OUT] ? a->value[OUT] : ".";
    hci_emit_result result;
    hci_note note = {{0}};
    hci_status status;
    inputs in;
    memset(&in, 0, sizeof in);
    status = read_inputs(a, &in, &note);
    if (!status) status = read_facts(a, &in, &note);
    if (!status) status = hci_emit(folder, &in.request, &result, &note);
    if (!status && cli_is_wordy()) show(&in.request, &result, folder);
    if (!status) remark_currents(a);
    if (!status && a->given[JSON]) status = cli_print_json(hci_emit_json(&in.request, &result), &note);
    hci_machine_release(&in.machine);
    hci_currents_release(&in.current);
    hci_currents_release(&in.per_Nm);
    return status ? cli_fail(status, &note) : 0;
}

const cli_command cli_emit = {
    .name = "emit",
    .words = "CURRENTS_OR_FOLDER... --name ID",
    .does = "Turns currents into C tables for a microcontroller.\n"
            "Writes ID.h and ID.c, which need hci/table.h (f32) or hci/table_i16.h and nothing else; with "
            "--drive\n"
            "hci/loop.h too.",
    .options = OPTIONS,
    .words_needed = 1,
    .takes_more_words = true,
    .word_kind = CLI_FILE,
    .example =
        "  hci-solve solve data/machine_a --target data/scenarios/02/target.csv --auto -o out/machine_a\n"
        "  hci-solve emit out/machine_a --name machine_a --frame dq --max-error 0.01 -o out/machine_a\n"
        "  hci-solve emit out/machine_a --name machine_a_linear --frame dq --points 512 --per-torque -o "
        "out/machine_a\n"
        "  hci-solve emit out/machine_a --name machine_a_drive --machine data/machine_a --drive "
        "data/drive/machine_a_10kHz.csv -o out/machine_a\n"
        "\nExit codes: 0 done; " CLI_EXIT_ERRORS,
    .source = "cli/emit.c",
    .guide = "drive.md",
    .run = run,
};
