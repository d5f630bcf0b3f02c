#include "cli/tune/tune_steps.h"

#include <math.h>
#include <stdio.h>

#include "cli/tune/tune_commands.h"
#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_read.h"
#include "cli/tune/tune_recorded.h"
#include "cli/tune/tune_waveforms.h"
#include "hci/host/base/number.h"
#include "hci/host/waveform/waveform.h"
#include "hci/math/harmonic.h"

/* Of the voltages, that of currents may drop and no more. */
#define DROP 0.01

/* Times what chance makes two recordings of noise have in common. */
#define CHANCE 3.0

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Of three phases, without what they have in common. */
static void star(const double phase[3], double without[3])
{
    for (int s = 0; s < 3; ++s)
        without[s] = phase[s] - (phase[0] + phase[1] + phase[2]) / 3.0;
}

/* The part of the voltages that follows the current, in phase with it or a quarter of a turn off, from 0 to
 * 1: at least the share of what the current drops in an unknown resistance, as long as the current itself is
 * not noise. */
static double share_that_follows(const hci_run *r)
{
    double v[3], i[3], along = 0.0, across = 0.0, vv = 0.0, ii = 0.0;
    for (size_t k = 0; k < r->count; ++k) {
        star(r->v_V + 3 * k, v);
        star(r->i_A + 3 * k, i);
        const double quarter[3] = {(i[1] - i[2]) / sqrt(3.0), (i[2] - i[0]) / sqrt(3.0),
                                   (i[0] - i[1]) / sqrt(3.0)};
        along += dot(v, i), across += dot(v, quarter);
        vv += dot(v, v), ii += dot(i, i);
    }
    return vv * ii > 0.0 ? hypot(along, across) / sqrt(vv * ii) : 0.0;
}

static double rms_voltage(const hci_run *r)
{
    double v[3], sum = 0.0;
    for (size_t k = 0; k < r->count; ++k) {
        star(r->v_V + 3 * k, v);
        sum += dot(v, v);
    }
    return sqrt(sum / (3.0 * (double)r->count));
}

/* Whether what the currents drop cannot matter in the voltages: by a known resistance, or because the
 * voltages do not follow the currents. */
static bool drops_nothing(const cli_tuning *t, const hci_run *r)
{
    const double ohm = t->declared.resistance_ohm;
    if (ohm > 0.0 && ohm * cli_tune_rms_A(r) <= DROP * rms_voltage(r)) return true;
    return share_that_follows(r) <= DROP + CHANCE / sqrt(2.0 * (double)r->count);
}

static bool is_held_load(const cli_tuning *t, const hci_run *r)
{
    return r->torque_source == HCI_TORQUE_HOLDING && hci_run_is_loaded(r, t->declared.model.pole_pairs);
}

static bool has_held_load(const cli_tuning *t)
{
    bool any = false;
    for (size_t k = 0; k < t->runs.count; ++k)
        any = any || is_held_load(t, &t->runs.run[k]);
    return any;
}

/* Whether a recording is one for the quantity. Cogging torque that a sensor has measured is left to diagnose,
 * which finds it in all recordings at once and knows what they leave open of it: from one of them alone it is
 * off by more than what would be stated. So is that of slow turns under a load, which makes a ripple of its
 * own, and of those without one beside it: what an encoder makes of cogging torque, the load tells from it.
 */
static bool is_for(const cli_tuning *t, const hci_run *r, hci_waveform_quantity quantity)
{
    if (quantity == HCI_WAVEFORM_BACK_EMF)
        return r->v_V && !r->is_point && cli_tune_has_no_current(t, r) && drops_nothing(t, r);
    return r->torque_source == HCI_TORQUE_HOLDING && !has_held_load(t);
}

/* The largest of them. */
static void say_waveform(cli_tuning *t, size_t run, const hci_waveform *w)
{
    const bool is_emf = w->quantity == HCI_WAVEFORM_BACK_EMF;
    double above = HUGE_VAL;
    if (w->remark.text[0])
        hci_tuning_say(&t->tuning, HCI_TUNING_READ, "  by %s turn: %s; what it leaves, diagnose looks at",
                       w->step < 1.0 ? "the mechanical" : "the electrical", w->remark.text);
    if (!is_emf) return; /* said when diagnose has added to it */
    hci_tuning_say(&t->tuning, HCI_TUNING_FOUND, "back-EMF, %zu orders, from %s", w->kept,
                   cli_tune_name_of(t, run));
    for (size_t shown = 0; shown < CLI_TUNE_ORDERS_SAID && shown < w->kept; ++shown) {
        const hci_waveform_order *most = NULL;
        for (size_t k = 0; k < w->count; ++k)
            if (w->order[k].kept && w->order[k].amplitude < above &&
                (!most || w->order[k].amplitude > most->amplitude))
                most = &w->order[k];
        if (!most) break;
        above = most->amplitude;
        hci_tuning_say(&t->tuning, HCI_TUNING_FOUND, "  order %.5g: %.4g ± %.1g V·s/rad (peak of a phase)",
                       most->order, most->amplitude, most->std_error);
    }
}

/* Times the back-EMF of the data sheet, of what was measured. */
static double to_sheet(const cli_tuning *t, const hci_waveform *w)
{
    for (size_t k = 0; k < w->count; ++k)
        if (fabs(w->order[k].order - 1.0) < HCI_ORDER_TOLERANCE)
            return 1.5 * w->order[k].amplitude / t->reading.run.torque_constant_Nm_per_A;
    return 1.0;
}

/* Without an angle, beside others that have one: its zero is not theirs. */
static bool has_other_zero(const cli_tuning *t, const hci_run *r)
{
    bool any = false;
    for (size_t k = 0; k < t->runs.count; ++k)
        any = any || t->runs.run[k].theta_m_rad;
    return any && !r->theta_m_rad;
}

static void say_size_alone(cli_tuning *t, size_t k)
{
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Where the back-EMF of %s lies beside the angle of the other logs, since it has none: its "
        "size, order 1, is taken, and its harmonics are left out of the table. Log the angle beside "
        "the voltages, which tells the electrical zero, too (docs/tutorials/zero.md).",
        cli_tune_name_of(t, k));
}

/* "--max-order" of a back-EMF: 1 where only its size is taken. */
static void add_max_order(cli_tuning *t, size_t k, bool is_emf, bool is_far, cli_tune_line *c)
{
    t->emf_is_size_alone = t->emf_is_size_alone || (is_emf && has_other_zero(t, &t->runs.run[k]));
    if (is_emf && t->emf_is_size_alone) {
        cli_tune_add_option(c, "max-order", "1");
        say_size_alone(t, k);
    } else if (is_far) {
        cli_tune_add_option(c, "max-order", "60");
    }
}

/* The numbers of a line, which has but pointers to them. */
typedef struct {
    char pole_pairs[16], constant[32], inertia[32];
} line_numbers;

/* What a holding test needs to tell cogging torque from its current. */
static void add_holding(const cli_tuning *t, const hci_run *r, line_numbers *n, cli_tune_line *c)
{
    const double inertia_kgm2 =
        t->declared.inertia_kgm2 > 0.0 ? t->declared.inertia_kgm2 : r->turns_inertia_kgm2;
    hci_number_text(t->reading.run.torque_constant_Nm_per_A, n->constant);
    hci_number_text(inertia_kgm2, n->inertia);
    cli_tune_add_option(c, "torque-constant", n->constant);
    if (inertia_kgm2 > 0.0) cli_tune_add_option(c, "inertia", n->inertia);
}

/* The call of `harmonics` for a recording. */
static cli_tune_line harmonics_line(cli_tuning *t, size_t k, bool is_emf, bool is_far, line_numbers *n)
{
    const hci_run *r = &t->runs.run[k];
    cli_tune_line c = {{"harmonics", cli_tune_log_of(t, k)}, 2};
    snprintf(n->pole_pairs, sizeof n->pole_pairs, "%d", t->declared.model.pole_pairs);
    cli_tune_add_option(&c, "quantity", is_emf ? "back_emf" : "cogging");
    cli_tune_add_option(&c, "pole-pairs", n->pole_pairs);
    if (!is_emf && r->torque_source == HCI_TORQUE_HOLDING) add_holding(t, r, n, &c);
    add_max_order(t, k, is_emf, is_far, &c);
    if (!is_emf && (t->arguments->given[TUNE_HOLDING] || r->slow_beside_others))
        cli_tune_add_option(&c, "holding", NULL);
    cli_tune_add_reading(&c, t);
    cli_tune_add(&c, "-o");
    cli_tune_add(&c, t->machine);
    return c;
}

/* Puts it into the machine in place of what the data sheet gave. */
static hci_status take_waveform(cli_tuning *t, size_t k, const hci_waveform *w, bool is_far, hci_note *note)
{
    const bool is_emf = w->quantity == HCI_WAVEFORM_BACK_EMF;
    line_numbers numbers;
    cli_tune_line c = harmonics_line(t, k, is_emf, is_far, &numbers);
    say_waveform(t, k, w);
    *(is_emf ? &t->has_emf : &t->has_cogging) = true;
    if (is_emf) t->emf_to_sheet = to_sheet(t, w);
    const hci_status status = cli_tune_run(t, t->commands.harmonics, &c, note);
    if (!status && is_emf && fabs(w->zero_rad) > 0.0) cli_tune_take_offset(t, w->zero_rad, "the voltages");
    return status ? status : cli_tune_read_inputs(t, note);
}

/* Up to the usual order; where the samples of a turn do not reach it, those of turns are put together. */
static hci_status find_far(const hci_run *r, const hci_waveform_options *options, hci_waveform *w,
                           bool *is_far, hci_note *why)
{
    hci_waveform_options far = *options;
    hci_waveform more = {0};
    hci_note unused = {{0}};
    const hci_status status = hci_waveform_find(r, options, w, why);
    *is_far = false;
    if (status || (double)w->count * w->step > HCI_USUAL_ORDER - 1.0) return status;
    far.max_order = HCI_USUAL_ORDER;
    if (hci_waveform_find(r, &far, &more, &unused)) return HCI_OK;
    hci_waveform_release(w);
    *w = more;
    *is_far = true;
    return HCI_OK;
}

static hci_waveform_options options_of(const cli_tuning *t, const hci_run *r, hci_waveform_quantity quantity)
{
    const bool holds = quantity == HCI_WAVEFORM_COGGING && r->torque_source == HCI_TORQUE_HOLDING;
    return (hci_waveform_options){.quantity = quantity,
                                  .pole_pairs = t->declared.model.pole_pairs,
                                  .max_order = (double)NAN,
                                  .torque_constant_Nm_per_A =
                                      holds ? t->reading.run.torque_constant_Nm_per_A : (double)NAN};
}

/* Takes note of how far cogging torque was looked at. Whether the order of slots and poles is in that. Where
 * a slow turn does not tell it each way, as with rows missing, but has samples all round in both ways
 * together, it is left to diagnose, which takes friction out by itself. */
static bool reaches_slots(cli_tuning *t, const hci_waveform *w)
{
    const double reach = (double)w->count * w->step;
    const bool reaches =
        cli_tune_order_of_slots(t) <= reach + HCI_ORDER_TOLERANCE || cli_tune_has_high_slots(t);
    t->has_alias = !reaches && cli_tune_least_gap_rad(t) > cli_tune_widest_gap_rad(t);
    t->cogging_reach = reaches || t->has_alias ? reach : 0.0;
    return reaches; /* or until another recording shows it */
}

static hci_status find_waveform(cli_tuning *t, size_t k, hci_waveform_quantity quantity, bool *found,
                                hci_note *note)
{
    const hci_waveform_options options = options_of(t, &t->runs.run[k], quantity);
    const bool is_cogging = quantity == HCI_WAVEFORM_COGGING;
    hci_waveform w = {0};
    hci_note why = {{0}};
    bool is_far = false;
    hci_status status = find_far(&t->runs.run[k], &options, &w, &is_far, &why);
    *found = !status && w.kept > 0;
    if (*found && is_cogging) *found = reaches_slots(t, &w);
    if (status) hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN, "%s", why.text);
    status = *found ? take_waveform(t, k, &w, is_far, note) : HCI_OK;
    if (*found && is_cogging && !status)
        t->cogging = w;
    else
        hci_waveform_release(&w);
    return status;
}

/* Voltages that nothing was taken from. */
static void say_not_open(cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count && !t->has_emf; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (!r->v_V || is_for(t, r, HCI_WAVEFORM_BACK_EMF)) continue;
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "The back-EMF is not taken from the voltages of %s: currents of %.3g A rms flow, and "
                       "%.0f %% of the voltage follows them. Record voltages with open terminals, turned by "
                       "another motor.",
                       cli_tune_name_of(t, k), cli_tune_rms_A(r), 100.0 * share_that_follows(r));
    }
}

/* Of each quantity the first recording that shows it, of those with an angle before others. */
hci_status cli_tune_waveforms(cli_tuning *t, hci_note *note)
{
    static const hci_waveform_quantity QUANTITIES[] = {HCI_WAVEFORM_BACK_EMF, HCI_WAVEFORM_COGGING};
    hci_status status = HCI_OK;
    for (int q = 0; q < 2 && t->is_own && !cli_tune_is_blocked(t); ++q) {
        bool found = false;
        for (size_t n = 0; n < 2 * t->runs.count && !found && !status; ++n) {
            const size_t k = n % t->runs.count;
            const hci_run *r = &t->runs.run[k];
            if ((r->theta_m_rad != NULL) == (n < t->runs.count) && is_for(t, r, QUANTITIES[q]))
                status = find_waveform(t, k, QUANTITIES[q], &found, note);
        }
    }
    if (!status && t->is_own && !cli_tune_is_blocked(t)) say_not_open(t);
    return status;
}
