#define _XOPEN_SOURCE 700
#include "cli/tune/tune_suspect.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_recorded.h"
#include "hci/math/harmonic.h"

/* ---- the folder ---- */

static bool is_own(const char *name)
{
    static const char *const NAMES[] = {"machine",  "runs.csv", "check",       "diagnose",     "target.csv",
                                        "currents", "table",    "report.html", "summary.json", "commands.sh"};
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k)
        if (strcmp(name, NAMES[k]) == 0) return true;
    return false;
}

/* Names in a folder: of one that tune does not write, of one that it does, "" for none; whether summary.json
 * is there, which it writes last. */
typedef struct {
    char foreign[256], own[256];
    bool is_finished;
} folder_names;

static hci_status look_into(const char *folder, folder_names *x, hci_note *note)
{
    *x = (folder_names){"", "", false};
    DIR *open = opendir(folder);
    if (!open && errno == ENOMEM) return hci_note_memory(note, folder, "looking into it");
    if (!open) return HCI_OK; /* new; what else it is, the first file that is written tells */
    for (struct dirent *at; (at = readdir(open)) != NULL;) {
        if (at->d_name[0] == '.') continue; /* itself, the one above, and what is being written */
        snprintf(is_own(at->d_name) ? x->own : x->foreign, sizeof x->own, "%s", at->d_name);
        x->is_finished = x->is_finished || strcmp(at->d_name, "summary.json") == 0;
    }
    closedir(open);
    return HCI_OK;
}

hci_status cli_tune_claim_folder(const char *folder, hci_note *note)
{
    folder_names x;
    struct stat there;
    if (stat(folder, &there) == 0 && !S_ISDIR(there.st_mode))
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "tune: --out %s is a file, expected a new folder for the results; give another name", folder);
    const hci_status status = look_into(folder, &x, note);
    if (status || !x.foreign[0]) return status;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "tune: %s has files in it that tune did not write, such as %s; expected a new "
                        "folder for the results: give --out another one",
                        folder, x.foreign);
}

hci_status cli_tune_expect_finished(const char *folder, hci_note *note)
{
    folder_names x;
    const hci_status status = look_into(folder, &x, note);
    if (status || !x.own[0] || x.is_finished) return status;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "tune: %s has %s in it and no summary.json, which tune writes last: a call was broken "
        "off there, or it is of something else; expected a new folder, or one that tune has "
        "finished: delete what is in it, or give --out another one",
        folder, x.own);
}

/* ---- columns in another unit ---- */

void cli_tune_say_column(const char *quantity, const char *column, char text[CLI_TUNE_COLUMN_WORDS])
{
    snprintf(text, CLI_TUNE_COLUMN_WORDS, "--column '%s=%s'", quantity, column[0] ? column : "COLUMN");
}

const char *cli_tune_unit_of_angle(const hci_run *r)
{
    static const struct {
        double rad;
        const char *name;
    } UNITS[] = {{1.0, "rad"}, {HCI_PI / 180.0, "deg"}, {2.0 * HCI_PI, "turn"}};
    for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS; ++k)
        if (fabs(r->angle_unit_rad / UNITS[k].rad - 1.0) < 1e-9) return UNITS[k].name;
    return NULL;
}

/* ---- what a ratio says ---- */

#define OF_A_UNIT 0.02 /* of a ratio, which units make */

/* The column of angle, speed or time in the first recording that has one, as hci_run keeps it; read_as: out,
 * a 1 of it in rad or rad/s, 0: not told. "": none. */
static const char *header_of(const cli_tuning *t, char of, double *read_as)
{
    *read_as = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        const char *header = of == 'a' ? r->angle_column : of == 's' ? r->speed_column : r->time_column;
        if (!header[0]) continue;
        *read_as = of == 'a' ? r->angle_unit_rad : of == 's' ? r->speed_unit_rad_per_s : 0.0;
        return header;
    }
    return "";
}

#define TURN (2.0 * HCI_PI)
#define RPM  (HCI_PI / 30.0)

void cli_tune_say_unit_of_ratio(const cli_tuning *t, double ratio, char text[CLI_TUNE_COLUMN_WORDS])
{
    const struct {
        double ratio, read_as;
        const char *words, *quantity;
        char of;
    } UNITS[] = {
        {360.0, TURN, "360 is degrees in a column that is read in turns", "theta_m_deg", 'a'},
        {180.0 / HCI_PI, 1.0, "180/π is degrees in a column that is read in rad", "theta_m_deg", 'a'},
        {0.5 / HCI_PI, TURN, "1/2π is rad/s in a column that is read in turn/s", "speed_rad_per_s", 's'},
        {0.5 / HCI_PI, 1.0, "1/2π is turns in a column that is read in rad", "theta_m_turn", 'a'},
        {30.0 / HCI_PI, RPM, "30/π is rad/s in a column that is read in rpm", "speed_rad_per_s", 's'},
        {HCI_PI / 30.0, 1.0, "π/30 is rpm in a column that is read in rad/s", "speed_rpm", 's'},
        {TURN, 1.0, "2π is turn/s in a column that is read in rad/s", "speed_turn_per_s", 's'},
        {HCI_PI / 180.0, 1.0, "π/180 is deg/s in a column that is read in rad/s", "speed_deg_per_s", 's'},
        {1e-3, 0.0, "0.001 is ms in a column that is read in s", "time_ms", 't'},
        {1e-6, 0.0, "a millionth is µs in a column that is read in s", "time_us", 't'},
        {1e3, 0.0, "1000 is s in a column that is read in ms", "time_s", 't'},
        {1e6, 0.0, "a million is s in a column that is read in µs", "time_s", 't'},
        {1.0 / (60.0 * t->declared.model.pole_pairs), TURN,
         "1/60 over the pole pairs is electrical rpm in a column that is read in turn/s", "speed_e_rpm",
         's'}};
    char column[CLI_TUNE_COLUMN_WORDS];
    text[0] = '\0';
    for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS && text[0] == '\0'; ++k) {
        double read_as;
        const char *header = header_of(t, UNITS[k].of, &read_as);
        if (fabs(ratio / UNITS[k].ratio - 1.0) >= OF_A_UNIT) continue;
        if (read_as > 0.0 && fabs(read_as / UNITS[k].read_as - 1.0) > 1e-9) continue;
        cli_tune_say_column(UNITS[k].quantity, header, column);
        snprintf(text, CLI_TUNE_COLUMN_WORDS, "%s; say %.200s", UNITS[k].words, column);
    }
}

/* ---- turns ---- */

/* A speed that goes with an angle in turns is in turns, too: one that was recorded in another unit speaks
 * against it. */
static bool may_be_in_turns(const hci_run *r)
{
    const bool has_speed = r->speed_unit_rad_per_s > 0.0 && r->speed_window == 0;
    return r->angle_unit_rad == 1.0 && !r->is_electrical && r->angle_column[0] &&
           (!has_speed || r->speed_unit_rad_per_s == 1.0);
}

/* Of the number of turns, that whole ones are off. */
#define NEAR_WHOLE 0.01

void cli_tune_say_turns(const cli_tuning *t, char text[CLI_TUNE_COLUMN_WORDS])
{
    char column[CLI_TUNE_COLUMN_WORDS];
    text[0] = '\0';
    for (size_t k = 0; k < t->runs.count && text[0] == '\0'; ++k) {
        const hci_run *r = &t->runs.run[k];
        const double turns = fmax(cli_tune_cover_of(r).turns * 2.0 * HCI_PI, r->swept_rad),
                     whole = round(turns);
        if (!may_be_in_turns(r) || whole < 1.0 || fabs(turns - whole) > NEAR_WHOLE * whole) continue;
        char speed[CLI_TUNE_COLUMN_WORDS] = "";
        cli_tune_say_column("theta_m_turn", r->angle_column, column);
        if (r->speed_unit_rad_per_s > 0.0) cli_tune_say_column("speed_turn_per_s", r->speed_column, speed);
        snprintf(text, CLI_TUNE_COLUMN_WORDS,
                 ", or it is %.0f whole turn%s and `%.90s` is in turns and not in rad: %.120s %.120s", whole,
                 whole > 1.0 ? "s" : "", r->angle_column, column, speed);
        while (text[0] && text[strlen(text) - 1] == ' ')
            text[strlen(text) - 1] = '\0';
    }
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

/* From sample k to the next one, by the angle and by the speed; nothing over a gap of the clock, in which the
 * shaft went where nobody knows. */
static void add_step(const hci_run *r, size_t k, double *turned, double *led)
{
    const double step_s = r->time_s[k + 1] - r->time_s[k];
    if (r->gap_s > 0.0 && step_s > r->gap_s) return;
    *turned += r->theta_m_rad[k + 1] - r->theta_m_rad[k];
    *led += 0.5 * (r->speed_rad_per_s[k] + r->speed_rad_per_s[k + 1]) * step_s;
}

/* Its direction is left to check, which knows a speed without a sign. *ratio: out, of the ways. */
static bool goes_elsewhere(const hci_run *r, double *ratio)
{
    double difference = 0.0, way = 0.0, all_turned = 0.0, all_led = 0.0;
    if (!r->time_s || !r->theta_m_rad || !r->speed_rad_per_s || r->speed_window > 0 || r->zero_is_unknown ||
        r->count < PARTS * PARTS)
        return false;
    for (size_t part = 0; part < PARTS; ++part) {
        const size_t from = part * (r->count - 1) / PARTS, to = (part + 1) * (r->count - 1) / PARTS;
        double turned = 0.0, led = 0.0;
        for (size_t k = from; k < to; ++k)
            add_step(r, k, &turned, &led);
        turned = fabs(turned), led = fabs(led);
        all_turned += turned;
        all_led += led;
        difference += (turned - led) * (turned - led);
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
        if (t->is_not_followed) continue;
        t->is_not_followed = goes_elsewhere(&t->runs.run[k], &t->angle_to_speed);
        t->not_followed = k;
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

/* The fastest of such recordings, and its speed; NULL: there is none. */
static const hci_run *fastest(const cli_tuning *t, double *rpm)
{
    const hci_run *fast = NULL;
    *rpm = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const double is_rpm = speed_of_current_rpm(&t->runs.run[k]);
        if (!(is_rpm > *rpm)) continue;
        fast = &t->runs.run[k];
        *rpm = is_rpm;
    }
    return fast;
}

/* " in degrees (5.7 rpm; --column 'theta_m_deg=angle')," of an angle that was read in rad. */
static void say_degrees(const hci_run *r, double rpm, char *text, size_t size)
{
    char column[CLI_TUNE_COLUMN_WORDS];
    rpm *= HCI_PI / 180.0;
    text[0] = '\0';
    if (r->angle_unit_rad != 1.0 || !(rpm < SLOW_rpm && rpm > LEAST_rpm)) return;
    cli_tune_say_column(r->is_electrical ? "theta_e_deg" : "theta_m_deg", r->angle_column, column);
    snprintf(text, size, " in degrees (%.3g rpm; %s),", rpm, column);
}

static void say_electrical(const hci_run *r, double rpm, char *text, size_t size)
{
    const char *unit = cli_tune_unit_of_angle(r);
    char quantity[32], column[CLI_TUNE_COLUMN_WORDS];
    text[0] = '\0';
    if (r->is_electrical || !unit || !(rpm / r->pole_pairs < SLOW_rpm)) return;
    snprintf(quantity, sizeof quantity, "theta_e_%s", unit);
    cli_tune_say_column(quantity, r->angle_column, column);
    snprintf(text, size, " electrical (%.3g rpm; %s),", rpm / r->pole_pairs, column);
}

static void say_counts(const hci_run *r, double rpm, char *text, size_t size)
{
    const bool is_fast = r->angle_unit_rad == 1.0 && rpm > COUNTS_rpm;
    text[0] = '\0';
    if (r->is_electrical || !cli_tune_unit_of_angle(r) || !(r->angle_is_counted || is_fast)) return;
    snprintf(text, size, " in counts of an encoder (--column 'theta_m=%.90s/COUNTS_OF_A_TURN'),",
             r->angle_column[0] ? r->angle_column : "COLUMN");
}

bool cli_tune_say_fast(const cli_tuning *t, char *text, size_t size)
{
    double rpm;
    char degrees[CLI_TUNE_COLUMN_WORDS + 40], electrical[CLI_TUNE_COLUMN_WORDS + 40],
        counts[CLI_TUNE_COLUMN_WORDS];
    const hci_run *r = fastest(t, &rpm);
    if (!r || !(rpm > SLOW_rpm)) return false;
    say_degrees(r, rpm, degrees, sizeof degrees);
    say_electrical(r, rpm, electrical, sizeof electrical);
    say_counts(r, rpm, counts, sizeof counts);
    const bool is_any = degrees[0] || electrical[0] || counts[0];
    snprintf(
        text, size,
        "By its angle the shaft turns at %.*f rpm, and without a torque sensor the current tells cogging "
        "torque only of a shaft that is turned at %.0f rpm or less, so nothing was solved; if it was, the "
        "angle is%s%s%s%s of a shaft behind a gear",
        rpm < 100.0 ? 1 : 0, rpm, SLOW_rpm, degrees, electrical, counts, is_any ? " or" : "");
    return true;
}

/* ---- a slow turn that does not turn back ---- */

#define OTHER_WAY 0.05 /* of the samples */

static bool is_one_way(const hci_run *r)
{
    size_t forward = 0, back = 0;
    const double rpm = speed_of_current_rpm(r);
    if (!(rpm > 0.0) || rpm > SLOW_rpm) return false;
    for (size_t k = 0; k < r->count; ++k) {
        forward += r->speed_rad_per_s[k] > 0.0;
        back += r->speed_rad_per_s[k] < 0.0;
    }
    return (double)(forward < back ? forward : back) < OTHER_WAY * (double)r->count;
}

bool cli_tune_is_one_way(const cli_tuning *t)
{
    bool is_any = false;
    for (size_t k = 0; k < t->runs.count; ++k)
        is_any = is_any || is_one_way(&t->runs.run[k]);
    return is_any;
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
