#include "cli/tune/tune_steps.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/tune/tune_commands.h"
#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_options.h"

/* What the header of the table that was emitted says of it; 0: nothing. */
typedef struct {
    unsigned long turns;
    double own_Nm, torque_Nm, with_Nm; /* ripple that its cut makes, at which torque, and all that is left */
} table_header;

static hci_status read_header(const char *folder, const char *name, table_header *h, hci_note *note)
{
    char path[2 * CLI_TUNE_PATH], line[512];
    memset(h, 0, sizeof *h);
    snprintf(path, sizeof path, "%s/%s.h", folder, name);
    FILE *f = fopen(path, "r");
    if (!f && errno == ENOMEM) return hci_note_memory(note, path, "reading it");
    if (!f) return hci_note_set(note, HCI_ERROR_INPUT, "%s: %s", path, strerror(errno));
    while (fgets(line, sizeof line, f)) {
        sscanf(line, " * Angle: uint32_t, 2^32 = %lu electrical turn", &h->turns);
        sscanf(line,
               " * Ripple: the cut to this table makes %lf N*m from peak to peak at %lf N*m; with it %lf N*m",
               &h->own_Nm, &h->torque_Nm, &h->with_Nm);
    }
    fclose(f);
    return HCI_OK;
}

/* Whether a recording tells it: by voltages or currents of the phases, since i_d and i_q, v_d and v_q are
 * turned by the angle of the drive itself. */
static bool tells_zero(const cli_tuning *t, const hci_run *r)
{
    const bool has_voltages = r->v_V && !r->voltage_is_dq, has_currents = r->has_sum || r->computed_phase > 0;
    if (!r->theta_m_rad || r->zero_is_unknown) return false;
    return r->is_electrical || r->zero_is_given || (t->has_emf && has_voltages) ||
           (t->has_load && r->torque_source == HCI_TORQUE_MEASURED && has_currents);
}

bool cli_tune_knows_zero(const cli_tuning *t)
{
    bool has_angle = false, knows = false;
    for (size_t k = 0; k < t->runs.count; ++k) {
        has_angle = has_angle || t->runs.run[k].theta_m_rad;
        knows = knows || tells_zero(t, &t->runs.run[k]);
    }
    if (!t->is_own) return true;
    return has_angle ? knows : t->has_emf; /* a table of voltages alone begins where they do */
}

/* Components that a current loop is asked to follow; a few are usual. */
#define MANY_COMPONENTS 24
#define THAT_COUNTS     1e-3 /* of the largest */

static void say_components(cli_tuning *t)
{
    const hci_currents *c = &t->solution.current;
    double largest_A = 0.0, most = 0.0;
    size_t count = 0;
    for (size_t k = 0; k < c->count; ++k)
        largest_A = fmax(largest_A, hci_amplitude(c->wave[k].sine, c->wave[k].cosine));
    for (size_t k = 0; k < c->count; ++k) {
        if (!(hci_amplitude(c->wave[k].sine, c->wave[k].cosine) > THAT_COUNTS * largest_A)) continue;
        most = fmax(most, c->wave[k].order);
        ++count;
    }
    hci_tuning_say(&t->tuning, HCI_TUNING_ELSE,
                   "The currents have %zu component%s of more than a thousandth of the largest, up to order "
                   "%.4g of a phase, which is %.3g Hz at 100 rpm (in i_d and i_q up to one order more)%s.",
                   count, count == 1 ? "" : "s", most, most * t->corrected.model.pole_pairs * 100.0 / 60.0,
                   count > MANY_COMPONENTS ? ": more than most current loops follow; hci-solve solve --auto "
                                             "6 finds the best six, and simulate --table --drive says what "
                                             "the loop makes of them"
                                           : "");
}

/* Where the solution is linear in the torque. */
static void say_per_torque(cli_tuning *t, const char *currents, const char *name, const char *machine)
{
    if (t->solution.per_Nm == NULL) return;
    hci_tuning_say(
        &t->tuning, HCI_TUNING_ELSE,
        "Where the torque changes, as in a joint that moves freely, load it in two parts, one of them times "
        "the torque, up to %.3g N·m, for which it was solved (tune --torque for more): hci-solve emit %s "
        "--name %s --frame dq --per-torque --machine %s%s%s%s -o FOLDER.",
        t->mean_Nm, currents, name, machine, cli_tune_knows_zero(t) ? "" : " --angle-of-logs",
        cli_tune_offset(t) ? " --angle-offset " : "", cli_tune_offset(t) ? cli_tune_offset(t) : "");
}

/* What the table is, and how its firmware reads it. */
static void say_table(cli_tuning *t, const char *name, const char *folder, const char *currents,
                      const table_header *h)
{
    hci_tuning_say(
        &t->tuning, HCI_TUNING_LOAD,
        "%s/%s.h and %s.c need hci/table.h alone: `hci_currents_dq i = hci_table_f32_dq(&%s, "
        "angle);`, where 2^32 of "
        "the angle is %lu electrical turn%s from %s%s%s%s. They are the whole "
        "reference for %.4g N·m (docs/controller.md). The figures above have the %.2g N·m of ripple that the "
        "cut to the table makes, those of %s/report.html do not.",
        folder, name, name, name, h->turns, h->turns == 1 ? "" : "s",
        cli_tune_is_without_angle(t) ? "where the back-EMF of phase a rises through zero, which no log shows "
                                       "an angle of"
                                     : "the zero of the logs",
        cli_tune_offset(t) ? " with --angle-offset " : "", cli_tune_offset(t) ? cli_tune_offset(t) : "",
        h->turns == 1 ? "" : ", not one: the angle goes on from turn to turn", cli_tune_made_Nm(t), h->own_Nm,
        currents);
}

/* A map of one electrical turn, where that is all that the currents have; else of the mechanical one. */
static void say_other_drives(cli_tuning *t, const char *currents, const char *machine, unsigned long turns)
{
    const char *name = t->arguments->value[TUNE_NAME] ? t->arguments->value[TUNE_NAME] : "tuned";
    hci_tuning_say(&t->tuning, HCI_TUNING_ELSE,
                   "For a drive whose firmware is somebody else's: hci-solve emit %s --name %s --for %s "
                   "--machine %s%s -o FOLDER, a new one, or another drive of docs/drives.",
                   currents, name, turns > 1 ? "moteus" : "simplefoc", machine,
                   cli_tune_knows_zero(t) ? "" : " --angle-of-logs");
    if (cli_tune_offset(t))
        hci_tuning_say(&t->tuning, HCI_TUNING_ELSE,
                       "The zero of the logs is not the machine's: a map over the encoder's turn takes "
                       "--encoder-offset %.6g besides (mechanical degrees, of the encoder that was logged).",
                       -strtod(cli_tune_offset(t), NULL) / t->declared.model.pole_pairs);
}

static void say_first_turn(cli_tuning *t, const char *machine, const char *currents)
{
    hci_tuning_say(&t->tuning, HCI_TUNING_LOAD,
                   "First turn on the bench: log angle and currents while the table is played, and run "
                   "hci-solve check %s LOG --table %s%s%s, which tells an angle that is off.",
                   machine, currents, cli_tune_offset(t) ? " --angle-offset " : "",
                   cli_tune_offset(t) ? cli_tune_offset(t) : "");
}

/* How to install a table that helps nobody is not asked for. */
static hci_status say_nothing(cli_tuning *t, const char *folder, const char *name)
{
    hci_tuning_say(&t->tuning, HCI_TUNING_LOAD,
                   "Nothing: the table in %s/%s.c takes no ripple away; a sine of the same current does as "
                   "well.",
                   folder, name);
    return HCI_OK;
}

/* Of a bound, below which a part of it is not spoken of. */
#define COUNTS 0.05

/* Half of the largest step in which an angle was recorded, electrical. */
static double half_step_rad(const cli_tuning *t)
{
    double step_rad = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k)
        step_rad = fmax(step_rad, t->runs.run[k].angle_step_rad);
    return 0.5 * step_rad * t->corrected.model.pole_pairs;
}

/* What the table makes where it is played half a step early or late, by its harmonics in the rotor frame on
 * the fundamental of the back-EMF, in phase with each other at worst. */
static void add_angle(cli_tuning *t)
{
    const hci_currents *c = &t->solution.current;
    const double constant = fabs(hci_machine_torque_constant(&t->corrected)), turned_rad = half_step_rad(t);
    double moved_A = 0.0;
    for (size_t k = 0; k < c->count; ++k)
        if (c->wave[k].sequence != 0)
            moved_A += hci_amplitude(c->wave[k].sine, c->wave[k].cosine) *
                       fmin(2.0, fabs(c->wave[k].order - c->wave[k].sequence) * turned_rad);
    const double moved_Nm = 2.0 * constant * moved_A;
    if (moved_Nm > COUNTS * t->solution.expected.peak_to_peak_Nm)
        hci_expected_ripple_add_angle(&t->solution.expected, moved_Nm, t->mean_Nm);
}

hci_status cli_tune_emit(cli_tuning *t, hci_note *note)
{
    const char *name = t->arguments->value[TUNE_NAME] ? t->arguments->value[TUNE_NAME] : "tuned";
    char currents[CLI_TUNE_PATH], folder[CLI_TUNE_PATH], machine[CLI_TUNE_PATH];
    if (!t->is_solved || t->size == CLI_TUNE_EXCESS) return HCI_OK;
    cli_tune_path(t, "currents", currents);
    cli_tune_path(t, "table", folder);
    cli_tune_path(t, "diagnose/machine", machine);
    cli_tune_line c = {
        {"emit", currents, "--name", name, "--frame", "dq", "--machine", machine, "-o", folder}, 10};
    if (!cli_tune_knows_zero(t)) cli_tune_add_option(&c, "angle-of-logs", NULL);
    if (cli_tune_offset(t)) cli_tune_add_option(&c, "angle-offset", cli_tune_offset(t));
    table_header header;
    hci_status status = cli_tune_run(t, t->commands.emit, &c, note);
    t->is_emitted = !status;
    if (!status) status = read_header(folder, name, &header, note);
    if (status) return status;
    t->tuning.table_Nm = header.with_Nm;
    t->cut_Nm = header.own_Nm;
    if (t->solution.expected.state == HCI_RIPPLE_KNOWN) {
        hci_expected_ripple_add_table(&t->solution.expected, header.own_Nm, t->mean_Nm);
        add_angle(t);
    }
    if (cli_tune_is_of_no_use(t) || cli_tune_is_never_seen(t)) return say_nothing(t, folder, name);
    say_table(t, name, folder, currents, &header);
    say_first_turn(t, machine, currents);
    say_other_drives(t, currents, machine, header.turns);
    say_components(t);
    say_per_torque(t, currents, name, machine);
    return HCI_OK;
}
