/* The verdict of a diagnosis for people. */
#include <math.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/diagnose/diagnose.h"
#include "host/base/words.h"

#define SAME         0.02  /* change of an error, as a share, that is none */
#define NEAR_NOISE   1.5   /* times the noise: an error below it is not looked at in parts */
#define UNLOADED     0.05  /* of the largest mean torque, below which a run has none */
#define RIGHT        0.1   /* of what loaded runs leave of their means, below which others are right */
#define GOES         0.9   /* correlation of what is left of means with the torque, which is no zero */
#define OF_MEANS     0.5   /* of the mean square of an error, that is of the means of the runs */
#define PLAIN        100.0 /* ΔBIC of an effect that is not taken, and said all the same */
#define NOTHING_LEFT 1.1   /* times the noise: an error in which nothing else is left */
#define SHOWS        0.05  /* of the noise: torque that an effect has to make to be taken */
#define SAME_LOAD    0.2   /* of the largest mean torque, by which others differ and tell nothing more */
#define SEVERAL      0.3   /* of it, rms about the mean of a run, that loads one after the other make */
#define BELIEVABLE   0.5   /* of the declared torque per ampere */

static bool is_named(const hci_finding *f, hci_finding_verdict verdict)
{
    return f->verdict == verdict && strcmp(f->effect, "unknown") != 0;
}

static size_t count_of(const hci_diagnosis *d, hci_finding_verdict verdict)
{
    size_t count = 0;
    for (size_t k = 0; k < d->findings; ++k)
        count += is_named(&d->finding[k], verdict);
    return count;
}

static bool any(const hci_diagnosis *d, hci_finding_verdict verdict)
{
    return count_of(d, verdict) > 0;
}

/* Names of the findings of one verdict: "cogging, friction and reluctance". parts: those of them that are
 * only parts of others, or all but these. */
static void say_names_of(const hci_words *w, const hci_diagnosis *d, hci_finding_verdict verdict, bool parts,
                         const char *last)
{
    size_t count = 0, named[HCI_MOST_FINDINGS];
    for (size_t k = 0; k < d->findings; ++k)
        if (is_named(&d->finding[k], verdict) && hci_finding_is_part(d, &d->finding[k]) == parts)
            named[count++] = k;
    for (size_t k = 0; k < count; ++k)
        hci_words_say(w, "%s%s",
                      k == 0           ? ""
                      : k + 1 == count ? last
                                       : ", ",
                      hci_finding_title(d->finding[named[k]].effect));
}

static void say_names(const hci_words *w, const hci_diagnosis *d, hci_finding_verdict verdict,
                      const char *last)
{
    say_names_of(w, d, verdict, false, last);
}

/* Terms that were chosen together with others. */
static void say_parts_of_whole(const hci_words *w, const hci_diagnosis *d)
{
    bool any_part = false;
    for (size_t k = 0; k < d->findings; ++k)
        any_part = any_part || hci_finding_is_part(d, &d->finding[k]);
    if (!any_part) return;
    hci_words_say(w, " Terms of ");
    say_names_of(w, d, HCI_FINDING_ADDED, true, " and ");
    hci_words_say(w, " stand in the machine too, chosen together with these: the recordings would not miss "
                     "them alone.");
}

/* What became of an error. */
static void say_change(const hci_words *w, double before_Nm, double after_Nm)
{
    if (fabs(after_Nm - before_Nm) <= SAME * before_Nm)
        hci_words_say(w, "stays at %.3g N·m", after_Nm);
    else
        hci_words_say(w, "%s from %.3g to %.3g N·m", after_Nm < before_Nm ? "falls" : "rises", before_Nm,
                      after_Nm);
}

/* Mean and ripple apart, where one of them is most of what is left or only one of them falls. */
static void say_parts(const hci_words *w, const hci_diagnosis *d)
{
    const double mean_Nm = d->holdout_mean_after_Nm, ripple_Nm = d->holdout_ripple_after_Nm;
    if (!(d->holdout_after_Nm > NEAR_NOISE * d->holdout_noise_Nm)) return;
    hci_words_say(w, " Of it the mean of each run ");
    say_change(w, d->holdout_mean_before_Nm, mean_Nm);
    hci_words_say(w, ", the ripple about it ");
    say_change(w, d->holdout_ripple_before_Nm, ripple_Nm);
    hci_words_say(w, ".");
}

static void say_errors(const hci_words *w, const hci_diagnosis *d)
{
    const bool tested = isfinite(d->holdout_after_Nm);
    hci_words_say(w, " On the runs that were %s the error (rms of measured less modelled torque) ",
                  tested ? "held out" : "fitted");
    say_change(w, tested ? d->holdout_before_Nm : d->rms_before_Nm,
               tested ? d->holdout_after_Nm : d->rms_after_Nm);
    hci_words_say(w, "; their noise is %.3g N·m.", tested ? d->holdout_noise_Nm : d->noise_Nm);
    if (tested)
        say_parts(w, d);
    else
        hci_words_say(w, " No run was held out, so this is not a test.");
}

/* Whether the means of the runs are most of what the declared machine leaves. */
static bool is_of_means(const hci_diagnosis *d)
{
    double means = 0.0, all = 0.0;
    for (size_t k = 0; k < d->runs; ++k) {
        means += d->run[k].error_mean_before_Nm * d->run[k].error_mean_before_Nm;
        all += d->run[k].rms_before_Nm * d->run[k].rms_before_Nm;
    }
    return means > OF_MEANS * all;
}

enum { LEAST_MEANS = 4 };

static bool has_sensor(const hci_diagnosis *d)
{
    bool any = d->runs == 0;
    for (size_t k = 0; k < d->runs; ++k)
        any = any || d->run[k].source == HCI_TORQUE_MEASURED;
    return any;
}

/* Whether what is left of the means goes with the torque of the runs. */
static bool goes_with_torque(const hci_diagnosis *d)
{
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    for (size_t k = 0; k < d->runs; ++k, n += 1.0) {
        const double torque = d->run[k].mean_torque_Nm, left = d->run[k].error_mean_after_Nm;
        x += torque;
        y += left;
        xx += torque * torque;
        xy += torque * left;
        yy += left * left;
    }
    const double across = n * xy - x * y;
    return n >= LEAST_MEANS && across * across > GOES * GOES * (n * xx - x * x) * (n * yy - y * y);
}

/* Whether runs without a torque have their mean right, and those with one have not. */
static bool is_right_unloaded(const hci_diagnosis *d)
{
    double most = 0.0, idle = 0.0, idles = 0.0, loaded = 0.0, loads = 0.0;
    for (size_t k = 0; k < d->runs; ++k)
        most = fmax(most, fabs(d->run[k].mean_torque_Nm));
    for (size_t k = 0; k < d->runs; ++k) {
        const double left = d->run[k].error_mean_after_Nm;
        const bool is_idle = fabs(d->run[k].mean_torque_Nm) < UNLOADED * most;
        *(is_idle ? &idle : &loaded) += left * left;
        *(is_idle ? &idles : &loads) += 1.0;
    }
    return idles > 0.0 && loads >= LEAST_MEANS && idle * loads < RIGHT * RIGHT * loaded * idles;
}

/* What may make the mean of each run another one. */
static const char *means_words(const hci_diagnosis *d)
{
    if (goes_with_torque(d))
        return ". What is left of them grows with the torque, as where a current, the torque or the magnets "
               "are scaled otherwise from run to run.";
    if (is_right_unloaded(d))
        return ". Without a torque the means are right, so no zero is another one each time; it may be the "
               "scale of a current or of the torque, or magnets whose temperature was not recorded.";
    return has_sensor(d) ? ", as where the zero of a sensor is another one each time."
                         : ", as where a load or the friction is another one each time.";
}

/* Whether a torque sensor has seen one load alone, as far as means tell, whatever ran without one. */
static bool has_one_load(const hci_diagnosis *d)
{
    double least = INFINITY, most = -INFINITY, largest = 0.0;
    for (size_t k = 0; k < d->runs; ++k)
        largest = fmax(largest, fabs(d->run[k].mean_torque_Nm));
    for (size_t k = 0; k < d->runs; ++k) {
        const double mean = d->run[k].mean_torque_Nm;
        if (d->run[k].source != HCI_TORQUE_MEASURED) return false;
        if (!(fabs(mean) > UNLOADED * largest)) continue;
        if (d->run[k].torque_varies_Nm > SEVERAL * largest) return false;
        least = fmin(least, mean);
        most = fmax(most, mean);
    }
    return least <= most && most - least < SAME_LOAD * largest;
}

/* An explanation that was left out, and what it may come from. */
static void say_disbelieved(const hci_words *w, const hci_diagnosis *d)
{
    if (!d->disbelieved) return;
    hci_words_say(w, " The recordings would fit %s, but with values that are not plausible",
                  hci_finding_title(d->disbelieved));
    if (d->disbelieved_share < BELIEVABLE)
        hci_words_say(w, " (it would leave %.2g of the declared torque per ampere of i_q)",
                      d->disbelieved_share);
    if (d->disbelieved_share >= BELIEVABLE && is_of_means(d))
        hci_words_say(
            w, ", so it was left out: most of what the declared machine leaves is the mean of each run%s",
            is_right_unloaded(d) ? "."
            : has_sensor(d)      ? ", as where the zero of the torque sensor or the friction is another one "
                                   "from run to run."
                                 : ", as where a load or the friction is another one from run to run.");
    else
        hci_words_say(w, ", so it was left out: see with `check` whether signs, units, angle and motor are "
                         "those of the machine folder.");
    if (has_one_load(d))
        hci_words_say(w, " All loads are of one size, at which several effects look alike and take values "
                         "from each other: another load, at half of it or so, tells them apart.");
}

/* ---- what is decisive and was not taken ---- */

static bool is_unfinished(const hci_diagnosis *d)
{
    return d->search != HCI_WORK_COMPLETE;
}

static bool is_plain(const hci_finding *f)
{
    return f->verdict == HCI_FINDING_REJECTED && f->delta_bic > PLAIN && strcmp(f->effect, "unknown") != 0;
}

/* The three largest: they are in the order of their evidence. */
static void say_not_taken(const hci_words *w, const hci_diagnosis *d)
{
    const bool settled =
        d->verdict == HCI_DIAGNOSIS_COMPLETE || d->drowned_Nm > 0.0 || d->verdict == HCI_DIAGNOSIS_EXPLAINED;
    size_t said = 0;
    if (d->disbelieved || d->not_searched) return;
    for (size_t k = 0; k < d->findings && said < 3; ++k) {
        const hci_finding *f = &d->finding[k];
        if (!is_plain(f)) continue;
        hci_words_say(w, "%s %s (%.3g)", said == 0 ? " Decisive by ΔBIC and not taken:" : ",",
                      hci_finding_title(f->effect), f->delta_bic);
        ++said;
    }
    if (said > 0)
        hci_words_say(w, "%s",
                      is_unfinished(d) && !settled ? "; none of them was confirmed as far as was looked."
                      : settled
                          ? "; what each would explain beside the rest is small beside the noise, or does "
                            "not hold in runs left out."
                          : "; none of them explains enough of it, or holds in runs left out.");
}

/* What a slip makes, and no effect. */
static void say_slip(const hci_words *w, const hci_diagnosis *d)
{
    if (d->slip && !d->not_searched)
        hci_words_say(w,
                      " %s: see with `check` whether signs, angle, pole pairs and motor are those of the "
                      "machine folder.",
                      d->slip);
}

/* Effects that hang on one run. */
static void say_unstable(const hci_words *w, const hci_diagnosis *d)
{
    for (size_t k = 0; k < d->findings; ++k) {
        const hci_finding *f = &d->finding[k];
        if (f->verdict == HCI_FINDING_REJECTED || f->stays == f->left_out) continue;
        if (hci_finding_is_part(d, f)) continue; /* said already */
        hci_words_say(w, " With one run, or part of one, left out %s is found in %zu of %zu cases.",
                      hci_finding_title(f->effect), f->stays, f->left_out);
    }
}

/* Nothing is left of the torques: what contradicts are voltages. */
static bool is_of_voltages(const hci_diagnosis *d)
{
    return d->open_voltage_off > HCI_OPEN_VOLTAGE_OFF && !any(d, HCI_FINDING_ADDED) && !d->wanders &&
           !d->means_open && d->unexplained_count == 0 && !d->disbelieved && !d->contradicted;
}

/* No effect was looked for. */
static void say_not_searched(const hci_words *w, const hci_diagnosis *d)
{
    hci_words_say(
        w,
        "No effect was looked for, since none makes what is wrong with the files: %s. As declared the "
        "machine leaves %.3g N·m rms of what was measured. Mend that first: see with `check`.",
        d->slip, d->rms_before_Nm);
}

/* Nothing was found in the ripple, and the means are of a load. */
static bool is_of_loads(const hci_diagnosis *d)
{
    return d->unknown_loads > 0 && !any(d, HCI_FINDING_ADDED) && !d->wanders && !d->means_open &&
           d->unexplained_count == 0 && !d->disbelieved && !d->contradicted && !is_unfinished(d);
}

/* Nothing was found but that the torque drifts. */
static bool is_of_drifts(const hci_diagnosis *d)
{
    return d->drifts > 0 && d->verdict == HCI_DIAGNOSIS_UNKNOWN && d->unexplained_count == 0 &&
           !d->disbelieved && !d->contradicted && !is_unfinished(d) &&
           d->rms_after_Nm < NOTHING_LEFT * d->noise_Nm;
}

static void say_not_known(const hci_words *w, const hci_diagnosis *d)
{
    hci_words_say(
        w, is_of_voltages(d) ? "What the model lacks does not show in these torques."
           : is_of_loads(d)  ? "Nothing is missing in the ripple, and the mean of the torque is an "
                               "unknown load, of which nothing is told."
           : is_of_drifts(d)
               ? "Nothing is missing beside a drift, of which no recording says whether it is the sensor's."
           : is_unfinished(d) ? "What the model lacks is not known yet."
                              : "No known effect explains what the model lacks.");
}

static void say_partly(const hci_words *w, const hci_diagnosis *d)
{
    hci_words_say(w, "Partly explained: the model lacked ");
    say_names(w, d, HCI_FINDING_ADDED, " and ");
    if (!any(d, HCI_FINDING_ADDED)) say_names(w, d, HCI_FINDING_AMBIGUOUS, " or ");
    if (d->no_load_alone) hci_words_say(w, ", which the runs without a current show by themselves");
    hci_words_say(w, "; what else it lacks is not known%s.", is_unfinished(d) ? " yet" : "");
    say_parts_of_whole(w, d);
    if (d->no_load_against)
        hci_words_say(
            w, " Under load the ripple is larger with it: something that is not known makes the same orders "
               "there and works against it.");
    else if (d->no_load_alone && !d->no_load_denied &&
             d->holdout_after_Nm > (1.0 + SAME) * d->holdout_before_Nm)
        hci_words_say(w, " Under load that does not hold by itself: there the error rises with it.");
}

static void say_orders_left(const hci_words *w, const hci_diagnosis *d)
{
    for (size_t k = 0; k < d->unexplained_count; ++k) {
        const hci_unexplained *u = &d->unexplained[k];
        hci_words_say(w, " Order %.6g (up to %.3g N·m) grows as |i|^%.3g |ω|^%.3g%s.", u->order,
                      u->amplitude_Nm, u->current_exponent, u->speed_exponent,
                      u->turns_sign ? " and turns its sign with the direction" : "");
    }
}

static void say_unknown(const hci_words *w, const hci_diagnosis *d)
{
    if (d->verdict == HCI_DIAGNOSIS_UNKNOWN) say_not_known(w, d);
    if (d->verdict == HCI_DIAGNOSIS_PARTLY) say_partly(w, d);
    say_slip(w, d);
    if (d->no_load_denied) hci_words_say(w, " %s.", d->no_load_denied);
    if (is_unfinished(d)) return; /* what is left may be what was not looked for */
    say_disbelieved(w, d);
    if (d->contradicted)
        hci_words_say(w, " Effects that describe the runs that were fitted and not those that were held out "
                         "were dropped.");
    if (d->means_open)
        hci_words_say(w, "%s%s",
                      d->means_alone
                          ? " The mean of each run is off by something else: what would explain all of "
                            "them says nothing of a run left out"
                          : " What would explain all runs says nothing of a run left out.",
                      d->means_alone ? means_words(d) : "");
    if (d->wanders) hci_words_say(w, " Something in it does not repeat with the turn of the rotor.");
    say_orders_left(w, d);
}

/* What was taken out, since it is none of the motor's. */
static void say_swings(const hci_words *w, const hci_diagnosis *d)
{
    for (size_t k = 0; k < d->swings; ++k) {
        const hci_free_swing *x = &d->swing[k];
        hci_words_say(w, "%s swing of %.3g N·m %s %.5g ± %.1g %s (%zu of %zu runs)",
                      k == 0               ? " The torque has a"
                      : k + 1 == d->swings ? " and a"
                                           : ", a",
                      x->amplitude_Nm, x->of_turn ? "that comes" : "at", x->frequency, x->error,
                      x->of_turn ? "times a turn" : "Hz", x->runs, d->runs);
    }
    if (d->swings > 0 && d->not_searched)
        hci_words_say(w, ".");
    else if (d->swings > 0)
        hci_words_say(w, ", which does not repeat with the turn of the rotor, as of a load, a bearing, a "
                         "belt or the mains: "
                         "it was taken out.");
}

/* The size of what was taken out, and what it costs. */
static void say_drifts(const hci_words *w, const hci_diagnosis *d)
{
    if (d->drifts > 0)
        hci_words_say(
            w,
            " The torque drifts by up to %.2g N·m along %zu of %zu runs, as the zero of a sensor does that "
            "gets warm: that was taken out of its ripple, and the means of these runs count as far as "
            "they are known beside it.",
            d->drift_Nm, d->drifts, d->runs);
}

static void say_zeros(const hci_words *w, const hci_diagnosis *d)
{
    if (d->zeros_read > 0)
        hci_words_say(w,
                      " In %zu of %zu runs what was read as current, up to %.2g A, stands still while the "
                      "rotor turns: zeros of the sensors, taken as no current.",
                      d->zeros_read, d->runs, d->zeros_read_A);
}

static bool any_measured(const hci_diagnosis *d)
{
    for (size_t k = 0; k < d->runs; ++k)
        if (d->run[k].source == HCI_TORQUE_MEASURED) return true;
    return false;
}

/* Of a shaft that is held or turned slowly its current says it by itself. */
static void say_zero_or_cogging(const hci_words *w, const hci_diagnosis *d)
{
    const double zero_Nm = d->uncertainty.origin.sensor_zero_Nm;
    if (zero_Nm > 0.0 && any_measured(d))
        hci_words_say(
            w,
            " Whether order 1, %.2g N·m, is cogging torque or of current sensors whose zeros are off, "
            "these recordings do not tell, since a drive may have made a current in all of them: one "
            "of a shaft that is turned with the drive disconnected, logged without currents, tells.",
            zero_Nm);
}

/* What was not looked for, and what would show it. */
static void say_magnetic_only(const hci_words *w, const hci_diagnosis *d)
{
    if (d->magnetic_only)
        hci_words_say(
            w, " Direct current in a rotor that is held does not tell iron that saturates from errors of the "
               "sensors, or from a torque without current: these were not looked for. Runs with a rotor that "
               "turns, one of them without current, tell them.");
}

/* Runs whose torque is inertia × acceleration. */
static size_t free_shafts(const hci_diagnosis *d)
{
    size_t count = 0;
    for (size_t k = 0; k < d->runs; ++k)
        count += d->run[k].source == HCI_TORQUE_INERTIA;
    return count;
}

/* A torque that no sensor has read is right only where the shaft drives nothing. */
static void say_free_shafts(const hci_words *w, const hci_diagnosis *d)
{
    const size_t count = free_shafts(d);
    if (count > 0)
        hci_words_say(w, " The torque of %zu of %zu runs is inertia x acceleration, as of a free shaft.",
                      count, d->runs);
    if (d->of_mean_currents > 0)
        hci_words_say(w, " The mean currents of %zu of them, at constant speed, are friction.",
                      d->of_mean_currents);
    if (d->held_constant_Nm_per_A != 0.0)
        hci_words_say(w,
                      " No run tells the torque per ampere: torques are currents times the declared %.4g "
                      "N·m/A, and where that "
                      "is off by 5 %%, so are they; ± leaves that out.",
                      d->held_constant_Nm_per_A);
}

/* Effects are found in the torque, which says nothing of the back-EMF without a current. */
static void say_open_voltage(const hci_words *w, const hci_diagnosis *d)
{
    if (d->against_voltages)
        hci_words_say(w,
                      " The torques ask for another torque per ampere, but the voltages that were recorded "
                      "without a current are those of the declared back-EMF: inertia, or the scale of "
                      "torque or current, may be wrong.");
    else if (fabs(d->beyond_voltages) > HCI_BEYOND_VOLTAGES && d->verdict == HCI_DIAGNOSIS_EXPLAINED)
        hci_words_say(
            w,
            " Its torque per ampere is %s %% %s what the voltages that were recorded without a "
            "current show: %s, magnets that are %s under load, and a gain of the torque or current "
            "sensors look the same.",
            HCI_PERCENT(100.0 * fabs(d->beyond_voltages), 2), d->beyond_voltages > 0.0 ? "above" : "below",
            d->beyond_voltages > 0.0 ? "a reluctance torque where an i_d flows" : "iron that saturates",
            d->beyond_voltages > 0.0 ? "colder" : "warmer");
    if (!(d->open_voltage_off > HCI_OPEN_VOLTAGE_OFF)) return;
    hci_words_say(w,
                  " The voltages that were recorded without a current differ from speed x back_emf.csv by %s "
                  "%%; no effect is looked for in voltages: take the back-EMF from `harmonics`, or see with "
                  "`check` what is meant otherwise.",
                  HCI_PERCENT(100.0 * d->open_voltage_off, 2));
}

static void say_search(const hci_words *w, const hci_diagnosis *d)
{
    const bool limited = d->search == HCI_WORK_LIMITED;
    const char *end = limited ? "The search reached the limit of its work" : "The search was interrupted";
    if (d->search == HCI_WORK_COMPLETE) return;
    if (d->verdict <= HCI_DIAGNOSIS_EXPLAINED && d->rms_after_Nm < NOTHING_LEFT * d->noise_Nm) {
        hci_words_say(
            w,
            "%s: nothing but noise is left, yet others that may describe the recordings as well have not "
            "been compared with it, so that this is not called sure (exit code 1)",
            end);
        if (limited) hci_words_say(w, "; --work %g lets it take up to four times as long", d->further_work);
    } else {
        hci_words_say(
            w, "%s: this is the best model that it had found; others have not been compared with it", end);
        if (limited)
            hci_words_say(
                w,
                " (it gets further with --work %g, which takes up to four times as long, with fewer "
                "runs, or where effects.csv declares what is known)",
                d->further_work);
    }
    hci_words_say(w, ". ");
}

static void say_nothing_measured(const hci_words *w)
{
    hci_words_say(w, "Nothing can be said: no recording to fit to has an angle and a torque. Add "
                     "torque_Nm as a sensor "
                     "read it in each row (0 for a holding test without a load), or `inertia` to machine.csv "
                     "for a free shaft; "
                     "a torque that a drive has computed from its current, or one number typed into every "
                     "row, is none, and a "
                     "shaft that drives a load of its own, which is not recorded, tells none.");
}

/* The noise is as large as what matters. */
static void say_drowned(const hci_words *w, const hci_diagnosis *d)
{
    hci_words_say(w,
                  "Whether something is missing is not known: the noise of the recordings, %.3g N·m rms, is "
                  "%.2g of the torque that matters (%.3g N·m). ",
                  d->noise_Nm, d->noise_Nm / d->drowned_Nm, d->drowned_Nm);
    if (free_shafts(d) > 0)
        hci_words_say(
            w, "No effect stands out of it, nor one that varies more slowly than this noise of a slope; ");
    else
        hci_words_say(w, "An effect is taken only where it makes more than %.2g N·m rms; ",
                      SHOWS * d->noise_Nm);
    hci_words_say(w, "longer runs, a slower slope or a torque sensor show less.");
}

static void say_complete(const hci_words *w, const hci_diagnosis *d)
{
    if (d->rms_after_Nm > NEAR_NOISE * d->noise_Nm)
        hci_words_say(w,
                      "Nothing is missing that matters at the resolution of %.3g N·m: what the model leaves "
                      "is %.3g N·m rms, %.2g times the noise of the recordings (%.3g N·m).",
                      d->resolution_Nm, d->rms_after_Nm, d->rms_after_Nm / d->noise_Nm, d->noise_Nm);
    else
        hci_words_say(w,
                      "Nothing is missing: what the model leaves, %.3g N·m rms, is the noise of the "
                      "recordings (%.3g N·m).",
                      d->rms_after_Nm, d->noise_Nm);
    if (d->holdout_after_Nm > NEAR_NOISE * d->holdout_noise_Nm)
        hci_words_say(w, " But on the runs that were held out it is %.3g N·m, and their noise is %.3g N·m.",
                      d->holdout_after_Nm, d->holdout_noise_Nm);
}

static void say_added(const hci_words *w, const hci_diagnosis *d)
{
    if (!any(d, HCI_FINDING_ADDED)) return;
    hci_words_say(w, "The model lacked ");
    say_names(w, d, HCI_FINDING_ADDED, " and ");
    hci_words_say(w, ".");
    say_parts_of_whole(w, d);
}

enum { THESE_TWO = 2 };

#define BELIEVABLE_SHARE 0.3 /* of the torque per ampere: iron in the model takes a part of a larger one */

/* Where each direction of the turn has one load. */
static void say_standing(const hci_words *w, const hci_diagnosis *d)
{
    hci_words_say(w,
                  "%sWhether %s, as is taken, or %s is in the means is not told, since each direction of the "
                  "turn has one load alone: with the other one the torque per ampere, and the mean torque of "
                  "any currents, is ",
                  any(d, HCI_FINDING_ADDED) ? " " : "", d->standing_taken, d->standing_instead);
    if (fabs(d->standing_share) < BELIEVABLE_SHARE)
        hci_words_say(w, "%s %% ", HCI_PERCENT(100.0 * fabs(d->standing_share), 2));
    hci_words_say(w, "%s. A turn of each load the other way, or idle turns both ways, would tell.",
                  d->standing_share > 0.0 ? "larger" : "smaller");
}

static void say_ambiguous(const hci_words *w, const hci_diagnosis *d)
{
    say_added(w, d);
    if (d->standing_taken) {
        say_standing(w, d);
        if (count_of(d, HCI_FINDING_AMBIGUOUS) <= THESE_TWO) return;
    }
    hci_words_say(w, "%sThese recordings do not tell ",
                  d->standing_taken || any(d, HCI_FINDING_ADDED) ? " " : "");
    say_names(w, d, HCI_FINDING_AMBIGUOUS, d->inertia_as_well ? ", " : " and ");
    hci_words_say(w, "%s",
                  d->sensors_as_well
                      ? " from current sensors that read a part of each other's current: these "
                        "explain them equally well."
                  : d->inertia_as_well ? " and a wrong inertia apart: each explains them equally well."
                                       : " apart: each explains them equally well.");
    if (d->inertia_as_well)
        hci_words_say(w, " A free shaft shows torque per ampere and inertia as their ratio only.");
}

static void say_verdict(const hci_words *w, const hci_diagnosis *d)
{
    switch (d->verdict) {
    case HCI_DIAGNOSIS_COMPLETE:
        say_complete(w, d);
        return;
    case HCI_DIAGNOSIS_UNKNOWN:
        if (d->drowned_Nm > 0.0)
            say_drowned(w, d);
        else if (d->not_searched)
            say_not_searched(w, d);
        else
            say_unknown(w, d);
        return;
    case HCI_DIAGNOSIS_PARTLY:
        say_unknown(w, d);
        break;
    case HCI_DIAGNOSIS_EXPLAINED:
        say_added(w, d);
        break;
    case HCI_DIAGNOSIS_AMBIGUOUS:
        say_ambiguous(w, d);
        break;
    }
    say_errors(w, d);
    say_unstable(w, d);
}

static void say_odd_mean(const hci_words *w, const hci_odd_run *o)
{
    hci_words_say(w,
                  "Only the mean torque of %s disagrees with the others: it is %.3g ± %.1g N·m %s that of "
                  "the machine that explains all of them, a constant, as of another zero of the torque "
                  "sensor",
                  o->file, fabs(o->mean_Nm),
                  o->mean_is_untold ? o->mean_error_Nm : hypot(o->mean_error_Nm, o->mean_open_Nm),
                  o->mean_Nm > 0.0 ? "above" : "below");
    if (o->mean_is_untold)
        hci_words_say(w,
                      " (at least: what brakes more at its speed, which no other recording has, hides a part "
                      "of it)");
    hci_words_say(w, ". It was taken out: read the sensor without a torque before and after, and record it "
                     "again. Of the others: ");
}

#define DESCRIBED 1.5 /* times its noise: a recording that is left so much is described */

static void say_aside(const hci_words *w, const hci_odd_run *o)
{
    hci_words_say(w,
                  "With %s the recordings are not explained, and without it they are: it is set aside. The "
                  "machine of the others leaves %.3g N·m rms there, of which %.3g N·m are noise",
                  o->file, o->rms_Nm, o->noise_Nm);
    hci_words_say(w, o->rms_Nm <= DESCRIBED * o->noise_Nm
                         ? ", and so describes it nearly as well. Of the others: "
                         : ": what is different there is not known. Of the others: ");
}

/* The one that disagrees comes first. */
static void say_odd(const hci_words *w, const hci_diagnosis *d)
{
    const hci_odd_run *o = &d->odd;
    if (!o->file) return;
    if (fabs(o->mean_Nm) > 0.0) {
        say_odd_mean(w, o);
        return;
    }
    if (o->is_aside) {
        say_aside(w, o);
        return;
    }
    hci_words_say(w, "Only %s disagrees with the others: its error is %.3g N·m rms, theirs %.3g N·m", o->file,
                  o->rms_Nm, o->others_Nm);
    if (o->mended)
        hci_words_say(w, "; it is as if %s: with that mended its error is %.3g N·m", o->slip, o->mended_Nm);
    else if (o->slip[0])
        hci_words_say(w, "; most of that goes if %s", o->slip);
    else
        hci_words_say(w, "; a swapped phase, another index, unit or sign in that file would do it, and so "
                         "would whatever happened in it alone");
    hci_words_say(w, ". It was taken out: look at that file. Of the others: ");
}

void hci_diagnosis_words(const hci_diagnosis *d, char *text, size_t size)
{
    const hci_words w = {text, size};
    text[0] = '\0';
    say_odd(&w, d);
    say_search(&w, d);
    if (d->nothing_measured)
        say_nothing_measured(&w);
    else
        say_verdict(&w, d);
    say_not_taken(&w, d);
    say_swings(&w, d);
    say_drifts(&w, d);
    say_zeros(&w, d);
    say_zero_or_cogging(&w, d);
    say_magnetic_only(&w, d);
    say_open_voltage(&w, d);
    say_free_shafts(&w, d);
}
