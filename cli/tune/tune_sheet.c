/* Numbers of the data sheet that are in another unit, or have their point at another place. */
#include "cli/tune/tune_sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_recorded.h"
#include "cli/tune/tune_size.h"
#include "hci/host/machine/init.h"
#include "hci/math/harmonic.h"

/* How a sheet states the strength of the magnets, by the options that say it. */
typedef struct {
    int key;
    const char *option, *of; /* of: what has to be said beside it; "" */
    hci_sheet_reading reading;
} strength;

static const strength STRENGTHS[] = {
    {TUNE_KV, "--kv", "", HCI_SHEET_KV_LINE_PEAK},
    {TUNE_VOLT, "--volt-per-krpm", "", HCI_SHEET_VOLT_LINE_RMS},
    {TUNE_VOLT, "--volt-per-krpm", " --volt-of line-peak", HCI_SHEET_VOLT_LINE_PEAK},
    {TUNE_VOLT, "--volt-per-krpm", " --volt-of phase-peak", HCI_SHEET_VOLT_PHASE_PEAK},
    {TUNE_CONSTANT, "--torque-constant", "", HCI_SHEET_TORQUE_PEAK},
    {TUNE_CONSTANT, "--torque-constant", " --torque-of rms", HCI_SHEET_TORQUE_RMS},
    {TUNE_FLUX, "--flux", "", HCI_SHEET_FLUX}};

static const double FACTORS[] = {1.0, 1e-3, 1e3, 0.1, 10.0, 0.01, 100.0};

/* Flux linkage of a phase, Wb, of motors from those of toys to those of ships; and of usual ones. */
#define LEAST_FLUX       5e-5
#define MOST_FLUX        3.0
#define LEAST_USUAL_FLUX 2e-4
#define MOST_USUAL_FLUX  0.5

#define OFF_SHEET_TORQUE 1.35 /* times, by which no magnets, sensor or saliency are another figure */
#define NEAR_STRENGTH    1.1  /* within that factor it is the one that is meant */

static const strength *strength_given(const cli_tuning *t)
{
    for (size_t k = 0; k < sizeof STRENGTHS / sizeof *STRENGTHS && t->is_own; ++k)
        if (t->arguments->given[STRENGTHS[k].key]) return &STRENGTHS[k];
    return NULL;
}

static double declared_emf(const cli_tuning *t)
{
    return t->reading.run.torque_constant_Nm_per_A / 1.5;
}

/* The reading of the same number, or of one whose point is at another place, that has this k_e; from: of what
 * is given. NULL: none has. */
static const strength *reading_near(const cli_tuning *t, const strength *given, double number, double emf,
                                    double *value)
{
    const strength *best = NULL;
    double least = log(NEAR_STRENGTH);
    for (size_t k = 0; k < sizeof STRENGTHS / sizeof *STRENGTHS; ++k)
        for (size_t f = 0; f < sizeof FACTORS / sizeof *FACTORS; ++f) {
            const strength *x = &STRENGTHS[k];
            if ((x->key == given->key) == (f == 0))
                continue; /* the number as it is, or another one as it was meant */
            const double off =
                fabs(log(hci_sheet_emf(x->reading, FACTORS[f] * number, t->declared.model.pole_pairs) / emf));
            if (!(off < least)) continue;
            least = off;
            best = x;
            *value = FACTORS[f] * number;
        }
    return best;
}

/* The same number a thousand times as large or as small, where that is a usual motor; 0: neither is. */
static double usual_value(const cli_tuning *t, const strength *given, double number)
{
    for (size_t f = 1; f < 3; ++f) {
        const double flux = hci_sheet_emf(given->reading, FACTORS[f] * number, t->declared.model.pole_pairs) /
                            t->declared.model.pole_pairs;
        if (flux > LEAST_USUAL_FLUX && flux < MOST_USUAL_FLUX) return FACTORS[f] * number;
    }
    return 0.0;
}

static double number_of(const cli_tuning *t, const strength *x)
{
    return strtod(t->arguments->value[x->key], NULL);
}

/* What the recordings tell of k_e, to the declared one; 1: nothing that is far from it. */
static double ratio_of_recordings(const cli_tuning *t)
{
    const double ratio = cli_tune_is_off_sheet(t) ? t->emf_to_sheet : t->torque_to_sheet;
    return ratio > 0.0 && fabs(log(ratio)) > log(OFF_SHEET_TORQUE) ? ratio : 1.0;
}

static bool is_of_motor(const cli_tuning *t, double emf)
{
    const double flux = emf / t->declared.model.pole_pairs;
    return flux > LEAST_FLUX && flux < MOST_FLUX;
}

/* Magnets that no motor has are another unit of the recordings, and no figure of the sheet. */
static void say_no_motor(const cli_tuning *t, const strength *x, double ratio, char *text, size_t size)
{
    const char *column = cli_tune_is_off_sheet(t) ? "" : cli_tune_torque_unit(ratio);
    snprintf(
        text, size,
        "the %s of the logs are %.3g times those of %s %.6g, which magnets of no motor make: a column is "
        "in another unit%s%s%s",
        cli_tune_is_off_sheet(t) ? "voltages" : "torques", ratio, x->option, number_of(t, x),
        column[0] ? ", and --column " : "", column, column[0] ? "=COLUMN reads it in that" : "");
}

static bool say_measured(const cli_tuning *t, const strength *x, char *text, size_t size)
{
    const double ratio = ratio_of_recordings(t), number = number_of(t, x);
    const char *by = cli_tune_is_off_sheet(t) ? "voltages" : "torques";
    double value = 0.0;
    if (!(fabs(ratio - 1.0) > 0.0)) return false;
    const double emf = ratio * declared_emf(t);
    if (!is_of_motor(t, emf)) {
        if (!t->slip_is_of_unit) say_no_motor(t, x, ratio, text, size);
        return !t->slip_is_of_unit;
    }
    const strength *other = reading_near(t, x, number, emf, &value);
    if (!other && t->has_slip) return false;
    if (other)
        snprintf(
            text, size,
            "the %s of the logs are %.3g times those of %s %.6g, and %s %.6g%s fits: begin again with it if "
            "that is meant",
            by, ratio, x->option, number, other->option, value, other->of);
    else
        snprintf(text, size,
                 "the %s of the logs are %.3g times those of %s %.6g, and no other unit of that number makes "
                 "them: they would be those of %s %.3g",
                 by, ratio, x->option, number, x->option,
                 hci_sheet_value(x->reading, emf, t->declared.model.pole_pairs));
    return true;
}

static bool say_unusual(const cli_tuning *t, const strength *x, char *text, size_t size)
{
    const double flux = declared_emf(t) / t->declared.model.pole_pairs, number = number_of(t, x);
    char proposed[96] = "";
    if (is_of_motor(t, declared_emf(t))) return false;
    const double value = usual_value(t, x, number);
    if (value > 0.0)
        snprintf(proposed, sizeof proposed, ": is %s %.6g meant, in another unit by a factor of 1000?",
                 x->option, value);
    snprintf(text, size, "magnets of %s %.6g link %.2g Wb with a phase, and those of motors link %g to %g%s",
             x->option, number, flux, LEAST_FLUX, MOST_FLUX, proposed);
    return true;
}

/* Times all torque that is found or asked for. */
#define MUCH_RATED 1000.0

/* To two digits, of a number above 1. */
static double two_digits(double x)
{
    const double unit = pow(10.0, floor(log10(x)) - 1.0);
    return unit * round(x / unit);
}

/* Where no current turned with the rotor. */
static bool say_rated_torque(const cli_tuning *t, char *text, size_t size)
{
    const double asked_Nm = t->arguments->given[TUNE_TORQUE] ? t->arguments->number[TUNE_TORQUE] : 0.0;
    const double rated_A = t->declared.rated_current_A, most_Nm = fmax(asked_Nm, t->open_swing_Nm),
                 rated_Nm = rated_A * t->reading.run.torque_constant_Nm_per_A;
    if (!(most_Nm > 0.0) || !(rated_Nm > MUCH_RATED * most_Nm) ||
        rated_A < MUCH_RATED * cli_tune_largest_recorded_A(t))
        return false;
    snprintf(
        text, size,
        "a rated current of %.4g A would make %.0f times all torque that is found or asked for: is it in "
        "mA (--rated-current %.4g)?",
        rated_A, two_digits(rated_Nm / most_Nm), rated_A / 1000.0);
    return true;
}

static bool say_rated(const cli_tuning *t, char *text, size_t size)
{
    const double rated_A = t->declared.rated_current_A, most_A = cli_tune_turning_A(t);
    if (!t->arguments->given[TUNE_CURRENT]) return false;
    if (!cli_tune_is_overrated(t)) return say_rated_torque(t, text, size);
    snprintf(text, size,
             "a rated current of %.4g A is %.0f times the largest that was recorded, %.3g A: is it in mA "
             "(--rated-current %.4g)?",
             rated_A, rated_A / most_A, most_A, rated_A / 1000.0);
    return true;
}

/* 1 g·cm², in which data sheets state it. */
#define GRAM_CM2 1e-7

#define MOST_OHM 300.0 /* of a winding */

static bool say_resistance(const cli_tuning *t, char *text, size_t size)
{
    const double ohm = t->declared.resistance_ohm;
    if (!t->arguments->given[TUNE_RESISTANCE] || !(ohm > MOST_OHM)) return false;
    snprintf(text, size, "a winding of %.4g Ω is none of a motor: is it in mΩ (--resistance %.4g)?", ohm,
             ohm / 1000.0);
    return true;
}

#define LEAST_SHORT 0.1 /* of the current that is rated or recorded, that a short circuit carries */

static bool say_inductance(const cli_tuning *t, char *text, size_t size)
{
    const double flux = declared_emf(t) / t->declared.model.pole_pairs, l_H = t->declared.inductance_d_H,
                 usual_A = fmax(t->declared.rated_current_A, cli_tune_turning_A(t));
    if (!t->arguments->given[TUNE_INDUCTANCE_D] || !(flux < LEAST_SHORT * usual_A * l_H)) return false;
    snprintf(
        text, size,
        "with --inductance-d %.4g a short circuit of this motor would carry %.2g A, and %.3g A are rated "
        "or recorded: is it in mH (--inductance-d %.4g, and the other likewise)?",
        l_H, flux / l_H, usual_A, l_H / 1000.0);
    return true;
}

#define LEAST_RAD_PER_S2 0.1 /* that a motor gives its shaft */

static bool say_inertia(const cli_tuning *t, char *text, size_t size)
{
    const double kgm2 = t->declared.inertia_kgm2, torque_Nm = fmax(cli_tune_rated_Nm(t), t->mean_Nm);
    if (!t->arguments->given[TUNE_INERTIA] || !(torque_Nm < LEAST_RAD_PER_S2 * kgm2)) return false;
    snprintf(text, size,
             "with --inertia %.4g a torque of %.3g N·m would turn the shaft at 1 rpm after %.2g s: is it in "
             "g·cm² (--inertia %.4g)?",
             kgm2, torque_Nm, HCI_PI / 30.0 * kgm2 / torque_Nm, GRAM_CM2 * kgm2);
    return true;
}

/* Magnets of usual motors, and within which factor of them the most are. */
#define MIDDLE_FLUX 0.03
#define USUAL_FLUX  30.0

static double off_usual(const cli_tuning *t, double emf)
{
    return fabs(log(emf / t->declared.model.pole_pairs / MIDDLE_FLUX));
}

/* Whether magnets are usual, or more usual than those of the number as it is. */
static bool is_likelier(const cli_tuning *t, double emf)
{
    return off_usual(t, emf) < fmax(log(USUAL_FLUX), off_usual(t, declared_emf(t)));
}

bool cli_tune_say_meant_strength(const cli_tuning *t, char *text, size_t size)
{
    const strength *x = strength_given(t);
    const double emf = ratio_of_recordings(t) * declared_emf(t);
    double value;
    return x && is_likelier(t, emf) && reading_near(t, x, number_of(t, x), emf, &value) &&
           say_measured(t, x, text, size);
}

/* Beside a slip: no number of magnets that are less usual. */
static bool say_beside_slip(const cli_tuning *t, const strength *x, char *text, size_t size)
{
    const double emf = ratio_of_recordings(t) * declared_emf(t);
    return (!is_of_motor(t, emf) || is_likelier(t, emf)) && say_measured(t, x, text, size);
}

bool cli_tune_say_sheet(const cli_tuning *t, char *text, size_t size)
{
    const strength *x = strength_given(t);
    if (x && t->has_slip) return say_beside_slip(t, x, text, size);
    if (t->is_own && t->out_of_reach[0]) return say_inductance(t, text, size);
    if (!t->is_own || !t->is_solved) return false;
    return (x && (say_measured(t, x, text, size) || say_unusual(t, x, text, size))) ||
           say_rated(t, text, size) || say_resistance(t, text, size) || say_inductance(t, text, size) ||
           say_inertia(t, text, size);
}
