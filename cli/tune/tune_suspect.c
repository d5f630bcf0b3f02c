#define _XOPEN_SOURCE 700
#include "cli/tune/tune_suspect.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_current.h"
#include "hci/math/harmonic.h"

/* ---- the folder ---- */

static bool is_own(const char *name)
{
    static const char *const NAMES[] = {"machine",  "runs.csv", "check",       "diagnose",     "target.csv",
                                        "currents", "table",    "report.html", "summary.json", "commands.sh"};
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k)
        if (strcmp(name, NAMES[k]) == 0) return true;
    return name[0] == '.'; /* itself, the one above, and what is being written */
}

hci_status cli_tune_claim_folder(const char *folder, hci_note *note)
{
    hci_status status = HCI_OK;
    DIR *open = opendir(folder);
    if (!open && errno == ENOMEM) return hci_note_memory(note, folder, "looking into it");
    if (!open) return HCI_OK; /* new; what else it is, the first file that is written tells */
    for (struct dirent *at; !status && (at = readdir(open)) != NULL;)
        if (!is_own(at->d_name))
            status =
                hci_note_set(note, HCI_ERROR_ARGUMENT,
                             "tune: %s has files in it that tune did not write, such as %s; expected a new "
                             "folder for the results: give --out another one",
                             folder, at->d_name);
    closedir(open);
    return status;
}

/* ---- an angle that jumps ---- */

#define JUMP_RAD (HCI_PI / 6.0) /* of the electrical or the mechanical turn: less tells order 3 and more */
enum { STANDS = 4, LEAST_JUMPS = 6 };

/* The mean jump, in rad of a mechanical turn, of an angle that stands for some rows between; 0: of another.
 */
static double jump_of(const hci_run *r)
{
    double sum = 0.0;
    size_t jumps = 0;
    for (size_t k = 1; k < r->count && r->theta_m_rad; ++k) {
        const double step = fabs(r->theta_m_rad[k] - r->theta_m_rad[k - 1]);
        jumps += step > 0.0;
        sum += step;
    }
    return jumps >= LEAST_JUMPS && jumps * STANDS <= r->count ? sum / (double)jumps : 0.0;
}

static void judge_jumps(cli_tuning *t, const hci_run *r)
{
    const double jump_rad = jump_of(r);
    if (!r->time_s || r->zero_is_unknown) return; /* a holding test in steps has no time */
    if (jump_rad * r->pole_pairs > JUMP_RAD) t->jump_rad = fmax(t->jump_rad, jump_rad * r->pole_pairs);
}

/* ---- an angle that goes elsewhere ---- */

#define ELSEWHERE 0.5 /* of the way that angle and speed go, rms over parts of a recording */
enum { PARTS = 16 };

/* Its direction is left to check, which knows a speed without a sign. *ratio: out, of the ways. */
static bool goes_elsewhere(const hci_run *r, double *ratio)
{
    double difference = 0.0, way = 0.0, all_turned = 0.0, all_led = 0.0;
    if (!r->time_s || !r->theta_m_rad || !r->speed_rad_per_s || r->speed_window > 0 || r->zero_is_unknown ||
        r->count < PARTS * PARTS)
        return false;
    for (size_t part = 0; part < PARTS; ++part) {
        const size_t from = part * (r->count - 1) / PARTS, to = (part + 1) * (r->count - 1) / PARTS;
        const double turned = fabs(r->theta_m_rad[to] - r->theta_m_rad[from]);
        double led = 0.0;
        for (size_t k = from; k < to; ++k)
            led +=
                0.5 * (r->speed_rad_per_s[k] + r->speed_rad_per_s[k + 1]) * (r->time_s[k + 1] - r->time_s[k]);
        all_turned += turned;
        all_led += fabs(led);
        difference += (turned - fabs(led)) * (turned - fabs(led));
        way += fmax(turned * turned, led * led);
    }
    *ratio = all_led > 0.0 ? all_turned / all_led : 0.0;
    return difference > ELSEWHERE * ELSEWHERE * way;
}

void cli_tune_suspect(cli_tuning *t)
{
    t->jump_rad = 0.0;
    t->is_not_followed = false;
    for (size_t k = 0; k < t->runs.count; ++k) {
        judge_jumps(t, &t->runs.run[k]);
        if (!t->is_not_followed) t->is_not_followed = goes_elsewhere(&t->runs.run[k], &t->angle_to_speed);
    }
}

/* ---- a torque of friction that drives ---- */

#define OF_RIPPLE 0.1  /* rms: less is what the ends of the turns leave of a ripple, or a zero */
#define A_WAY     0.05 /* of the samples: fewer are no direction */

/* Sums over one direction. */
typedef struct {
    double torque_Nm, square_Nm2, samples;
} way_sum;

static void add_way(way_sum way[2], const hci_run *r)
{
    for (size_t n = 0; n < r->count; ++n) {
        way_sum *w = &way[r->speed_rad_per_s[n] > 0.0 ? 0 : 1];
        if (r->speed_rad_per_s[n] == 0.0) continue;
        w->torque_Nm += r->torque_Nm[n];
        w->square_Nm2 += r->torque_Nm[n] * r->torque_Nm[n];
        w->samples += 1.0;
    }
}

/* What is left of the squares about the mean. */
static double about_mean_Nm2(const way_sum *w)
{
    return w->samples > 0.0 ? w->square_Nm2 - w->torque_Nm * w->torque_Nm / w->samples : 0.0;
}

cli_tune_torque_way cli_tune_torque_way_of(const cli_tuning *t)
{
    way_sum way[2] = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    cli_tune_torque_way x = {0.0, 0.0, false, t->runs.count};
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source != HCI_TORQUE_MEASURED || !r->torque_Nm || !r->speed_rad_per_s || !r->time_s ||
            !cli_tune_has_no_current(t, r))
            continue;
        if (x.run == t->runs.count) x.run = k;
        add_way(way, r);
    }
    const double samples = way[0].samples + way[1].samples;
    if (!(samples > 0.0)) return x;
    const double forward_Nm = way[0].torque_Nm / fmax(way[0].samples, 1.0),
                 back_Nm = way[1].torque_Nm / fmax(way[1].samples, 1.0),
                 ripple_Nm = sqrt((about_mean_Nm2(&way[0]) + about_mean_Nm2(&way[1])) / samples);
    x.mean_Nm = way[0].samples > way[1].samples ? forward_Nm : back_Nm;
    x.has_both = fmin(way[0].samples, way[1].samples) > A_WAY * samples;
    x.drives_Nm = x.has_both                        ? 0.5 * (forward_Nm - back_Nm)
                  : way[0].samples > way[1].samples ? forward_Nm
                                                    : -back_Nm;
    if (x.drives_Nm < OF_RIPPLE * ripple_Nm) x.drives_Nm = 0.0;
    return x;
}

/* ---- a turn that is not slow ---- */

#define SLOW_rpm   20.0
#define LEAST_rpm  1.0
#define COUNTS_rpm 1000.0 /* encoders have hundreds of counts in a turn, or more */

/* Mean size of the speed of a recording of currents alone, in rpm; 0: of another one. */
static double speed_of_current_rpm(const hci_run *r)
{
    double sum = 0.0, current = 0.0;
    if (r->torque_source != HCI_TORQUE_NONE || r->torque_is_typed || !r->time_s || !r->speed_rad_per_s ||
        !r->theta_m_rad || r->v_V || r->zero_is_unknown)
        return 0.0;
    for (size_t k = 0; k < r->count; ++k) {
        sum += fabs(r->speed_rad_per_s[k]) / (double)r->count;
        current += fabs(r->i_A[3 * k]);
    }
    return current > 0.0 ? sum * 30.0 / HCI_PI : 0.0;
}

bool cli_tune_say_fast(const cli_tuning *t, char *text, size_t size)
{
    const double p = t->declared.model.pole_pairs;
    double rpm = 0.0;
    char degrees[80] = "", electrical[80] = "";
    for (size_t k = 0; k < t->runs.count; ++k)
        rpm = fmax(rpm, speed_of_current_rpm(&t->runs.run[k]));
    if (!(rpm > SLOW_rpm)) return false;
    if (rpm * HCI_PI / 180.0 < SLOW_rpm && rpm * HCI_PI / 180.0 > LEAST_rpm)
        snprintf(degrees, sizeof degrees, " in degrees (%.3g rpm; --column theta_m_deg=COLUMN),",
                 rpm * HCI_PI / 180.0);
    if (rpm / p < SLOW_rpm)
        snprintf(electrical, sizeof electrical, " electrical (%.3g rpm; --column theta_e_rad=COLUMN),",
                 rpm / p);
    snprintf(
        text, size,
        "By its angle the shaft turns at %.3g rpm, and without a torque sensor the current tells cogging "
        "torque only of a shaft that is turned at %.0f rpm or less, so nothing was solved; if it was, the "
        "angle is%s%s %sof a shaft behind a gear",
        rpm, SLOW_rpm, degrees, electrical,
        rpm > COUNTS_rpm ? "in counts of an encoder (--column theta_m=COLUMN/COUNTS_OF_A_TURN), or " : "or ");
    return true;
}

size_t cli_tune_clipped(const cli_tuning *t)
{
    size_t clipped = 0;
    for (size_t k = 0; k < t->runs.count; ++k)
        clipped += t->runs.run[k].is_clipped;
    return clipped;
}

size_t cli_tune_torque_clipped(const cli_tuning *t)
{
    size_t clipped = 0;
    for (size_t k = 0; k < t->runs.count; ++k)
        clipped += t->runs.run[k].torque_is_clipped && t->runs.run[k].torque_source == HCI_TORQUE_MEASURED;
    return clipped;
}

bool cli_tune_all_torque_clipped(const cli_tuning *t)
{
    size_t measured = 0;
    for (size_t k = 0; k < t->runs.count; ++k)
        measured += t->runs.run[k].torque_source == HCI_TORQUE_MEASURED;
    return measured > 0 && cli_tune_torque_clipped(t) == measured;
}

bool cli_tune_is_typed(const cli_tuning *t)
{
    bool typed = false;
    for (size_t k = 0; k < t->runs.count; ++k) {
        if (t->runs.run[k].torque_source == HCI_TORQUE_MEASURED) return false;
        typed = typed || t->runs.run[k].torque_is_typed;
    }
    return typed;
}
