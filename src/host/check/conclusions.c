#include "host/check/conclusions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "host/check/error_place.h"
#include "host/check/own_findings.h"
#include "host/check/relations/relations.h"
#include "host/check/relations/run_zero.h"

/* A relation is met up to so many standard deviations. */
#define MET 2.5

/* What the best interpretation is to have mended is met as well as this. */
#define MENDED 1.5

/* A relation whose tolerance has grown to more than this, by what is unknown in the recordings, is met by
 * slips as well. */
#define TOO_WIDE     0.25
#define TOO_WIDE_RAD 1.0
#define GROWN        1.5

/* A ratio that is off by this factor is nothing that agrees. */
#define FAR 1.5

/* A relation that is not met is nearer when less than this of its deviation is left. */
#define NEARER 0.5

/* A convention error leaves a trace where it changes what a relation costs by as much, in nats. */
#define TRACE 1.0

static bool has_error(const check_error_set *set, const char *name)
{
    for (int k = 0; k < CHECK_MOST_ERRORS; ++k)
        if (set->error[k] >= 0 && strcmp(HCI_CHECK_ERRORS[set->error[k]].name, name) == 0) return true;
    return false;
}

/* Of all combinations that have the error `name`, and have `other` (NULL: whatever) or not. */
static double probability(const check_posterior *p, const char *name, const char *other, bool with_other)
{
    double sum = 0.0;
    for (size_t k = 0; k < p->count; ++k)
        if (has_error(&p->list[k], name) && (!other || has_error(&p->list[k], other) == with_other))
            sum += p->list[k].probability;
    return sum;
}

/* The most probable combination with an error, and the form of the error in it. */
static const check_error_set *best_with(const check_posterior *p, const char *name, const check_error **error)
{
    const check_error_set *best = NULL;
    for (size_t k = 0; k < p->count; ++k)
        if (has_error(&p->list[k], name) && (!best || p->list[k].probability > best->probability))
            best = &p->list[k];
    for (int k = 0; best && k < CHECK_MOST_ERRORS; ++k)
        if (best->error[k] >= 0 && strcmp(HCI_CHECK_ERRORS[best->error[k]].name, name) == 0)
            *error = &HCI_CHECK_ERRORS[best->error[k]];
    return best;
}

static bool is_first_row(size_t k)
{
    for (size_t j = 0; j < k; ++j)
        if (strcmp(HCI_CHECK_ERRORS[j].name, HCI_CHECK_ERRORS[k].name) == 0) return false;
    return true;
}

/* What takes the place of this error in the combinations without it: at least a tenth as probable, and seldom
 * beside it. */
static void add_alternatives(const check_posterior *p, hci_check_finding *finding)
{
    for (size_t k = 0; k < HCI_CHECK_ERROR_COUNT && finding->alternatives < HCI_CHECK_MOST_ALTERNATIVES;
         ++k) {
        const char *other = HCI_CHECK_ERRORS[k].name;
        if (!is_first_row(k) || strcmp(other, finding->slip) == 0) continue;
        const double alone = probability(p, other, finding->slip, false);
        const double beside = probability(p, other, finding->slip, true);
        const check_error *error = &HCI_CHECK_ERRORS[k];
        if (!(alone > 0.1 * finding->probability && beside < 0.5 * alone)) continue;
        best_with(p, other, &error);
        finding->alternative_words[finding->alternatives] = error->words;
        finding->alternative[finding->alternatives++] = other;
    }
}

/* Whether no effect makes numbers like those of an error. A gain does those of a factor, and an angle that is
 * off those of another zero. */
static bool is_no_effect(const check_error *error)
{
    static const int ASPECTS[] = {
        CHECK_OF_POLES,        CHECK_OF_THETA,  CHECK_OF_THETA_UNIT,  CHECK_OF_DIRECTION, CHECK_OF_PHASES,
        CHECK_OF_CURRENT_SIGN, CHECK_OF_TORQUE, CHECK_OF_TORQUE_UNIT, CHECK_OF_SPEED,     CHECK_OF_EMF_ORDER};
    for (size_t k = 0; k < sizeof ASPECTS / sizeof *ASPECTS; ++k)
        if (error->aspect == ASPECTS[k]) return true;
    return false;
}

/* Of a torque that a unit takes there, the rest: a sensor's error. */
#define A_UNIT 0.03

/* Per cent of a rated torque are any number of N·m. */
static void say_other_scale(const check_posterior *p, const check_interpretation *as, hci_check_finding *f)
{
    const size_t used = strlen(f->words);
    for (size_t k = 0; k < hci_check_relation_count(); ++k) {
        const check_relation *r = hci_check_relation(k);
        const double left = hci_check_relation_value(p->data, r, as).found - 1.0;
        if (strcmp(r->name, "torque_size") == 0 && fabs(left) > A_UNIT)
            snprintf(
                f->words + used, sizeof f->words - used,
                ", or of another scale, such as per cent of a rated torque: with that unit it is %.0f %% "
                "%s what the currents make",
                100.0 * fabs(left), left < 0.0 ? "below" : "above");
    }
}

static void add_finding(const check_posterior *p, const char *name, hci_check *check)
{
    hci_check_finding finding = {.probability = probability(p, name, NULL, false)};
    const check_error *error = NULL;
    size_t at = check->findings;
    if (finding.probability < HCI_CHECK_POSSIBLE || at == HCI_CHECK_MOST_FINDINGS) return;
    const check_error_set *best = best_with(p, name, &error);
    const check_interpretation as = hci_check_interpretation_of(p->data, best);
    hci_check_error_locate(error, p->data, &as, &finding);
    if (error->aspect == CHECK_OF_TORQUE_UNIT) say_other_scale(p, &as, &finding);
    finding.is_no_effect = is_no_effect(error);
    add_alternatives(p, &finding);
    for (; at > 0 && check->finding[at - 1].probability < finding.probability; --at)
        check->finding[at] = check->finding[at - 1];
    check->finding[at] = finding;
    ++check->findings;
}

/* ---- evidence */

static hci_check_state state_of(double declared, double as_read)
{
    if (declared <= MET) return as_read <= MET ? HCI_CHECK_AGREES : HCI_CHECK_WORSE;
    if (as_read <= MENDED) return HCI_CHECK_MENDED;
    return as_read < fmax(MET, NEARER * declared) ? HCI_CHECK_BETTER : HCI_CHECK_UNMENDED;
}

/* Both values agree, and would agree with a slip; or the tolerance has let one pass that is far off. */
static bool is_too_wide(const check_relation *r, check_value declared, check_value as_read)
{
    const double spread = fmax(declared.spread, as_read.spread), ratio = declared.found / r->expected;
    const bool is_ratio = r->kind != CHECK_ANGLE && r->kind != CHECK_SHARE && r->kind != CHECK_MOST;
    const double too_wide = r->kind == CHECK_ANGLE ? TOO_WIDE_RAD : TOO_WIDE;
    return (spread > GROWN && r->tolerance * spread > too_wide) ||
           (is_ratio && !(ratio > 1.0 / FAR && ratio < FAR));
}

static bool is_used(const check_posterior *p, const char *relation)
{
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        if (p->used[k] && strcmp(hci_check_relation(k)->name, relation) == 0) return true;
    return false;
}

static bool possible_mends(const check_posterior *p, const hci_check *check, const check_relation *r)
{
    const check_error *error;
    for (size_t k = 0; k < check->findings; ++k) {
        const check_interpretation as =
            hci_check_interpretation_of(p->data, best_with(p, check->finding[k].slip, &error));
        if (hci_check_deviation(r, hci_check_relation_value(p->data, r, &as)) <= MET) return true;
    }
    return false;
}

static hci_check_evidence evidence_of(const check_posterior *p, const check_relation *r)
{
    const check_interpretation declared = hci_check_as_declared(),
                               as = hci_check_interpretation_of(p->data, &p->list[p->best]);
    const check_value before = hci_check_relation_value(p->data, r, &declared),
                      after = hci_check_relation_value(p->data, r, &as);
    hci_check_state state = state_of(hci_check_deviation(r, before), hci_check_deviation(r, after));
    if (state == HCI_CHECK_AGREES && is_too_wide(r, before, after)) state = HCI_CHECK_UNJUDGED;
    return (hci_check_evidence){.name = r->name,
                                .words = r->words,
                                .declared = before.found,
                                .expected = r->expected,
                                .at_most = r->kind == CHECK_MOST,
                                .as_read = after.found,
                                .tolerance = r->tolerance * after.spread,
                                .state = state};
}

/* How the relations stand, or what those would need that could not be checked. */
static void add_evidence(const check_posterior *p, hci_check *check)
{
    for (size_t k = 0; k < hci_check_relation_count(); ++k) {
        const check_relation *r = hci_check_relation(k);
        if (!p->used[k] && !is_used(p, r->instead))
            check->gap[check->gaps++] = (hci_check_gap){r->name, r->words, r->needs};
        if (!p->used[k]) continue;
        hci_check_evidence e = evidence_of(p, r);
        if (e.state == HCI_CHECK_UNMENDED && possible_mends(p, check, r)) e.state = HCI_CHECK_MENDABLE;
        check->evidence[check->evidences++] = e;
    }
}

/* ---- what leaves no trace */

/* A combination with one error more, or with it in the place of the one about the same thing. */
static check_interpretation with_error(const check_data *data, const check_error_set *set, size_t error)
{
    check_interpretation as = hci_check_as_declared();
    for (int k = 0; k < CHECK_MOST_ERRORS; ++k)
        if (set->error[k] >= 0 && HCI_CHECK_ERRORS[set->error[k]].aspect != HCI_CHECK_ERRORS[error].aspect)
            hci_check_error_apply(&as, &HCI_CHECK_ERRORS[set->error[k]]);
    hci_check_error_apply(&as, &HCI_CHECK_ERRORS[error]);
    hci_check_take_run_zero(data, &as);
    return as;
}

static bool leaves_a_trace(const check_posterior *p, const check_error_set *in, size_t error)
{
    const check_interpretation before = hci_check_interpretation_of(p->data, in),
                               after = with_error(p->data, in, error);
    for (size_t k = 0; k < hci_check_relation_count(); ++k) {
        const check_relation *r = hci_check_relation(k);
        if (p->used[k] && fabs(hci_check_loss(r, hci_check_relation_value(p->data, r, &after)) -
                               hci_check_loss(r, hci_check_relation_value(p->data, r, &before))) > TRACE)
            return true;
    }
    return false;
}

static bool knows_zero(const check_data *data)
{
    const check_interpretation declared = hci_check_as_declared();
    const check_run_zero zero = hci_check_run_zero(data, &declared);
    return zero.is_known && !zero.is_of_drive;
}

static bool has_angle(const check_data *data)
{
    bool has = false;
    for (size_t k = 0; k < data->runs; ++k)
        has = has || data->run[k].theta != NULL;
    return has;
}

/* An error that can stand in these files, and in none of its forms changes anything, neither in the files as
 * declared nor in the best interpretation. */
static bool is_untold(const check_posterior *p, const char *name)
{
    const check_error_set *best = &p->list[p->best];
    bool applies = false;
    if (strcmp(name, HCI_CHECK_RUN_OFFSET) == 0) return !knows_zero(p->data) && has_angle(p->data);
    if (has_error(best, name)) return false;
    for (size_t k = 0; k < HCI_CHECK_ERROR_COUNT; ++k) {
        if (strcmp(HCI_CHECK_ERRORS[k].name, name) != 0 ||
            !hci_check_error_applies(&HCI_CHECK_ERRORS[k], p->data))
            continue;
        if (leaves_a_trace(p, best, k) || leaves_a_trace(p, &p->list[0], k)) return false;
        applies = true;
    }
    return applies;
}

static void add_untold(const check_posterior *p, hci_check *check)
{
    for (size_t k = 0; k < HCI_CHECK_ERROR_COUNT && check->untolds < HCI_CHECK_MOST_UNTOLD; ++k)
        if (is_first_row(k) && is_untold(p, HCI_CHECK_ERRORS[k].name))
            check->untold[check->untolds++] = HCI_CHECK_ERRORS[k].name;
}

static hci_check_verdict verdict_of(const hci_check *check)
{
    if (check->findings > 0 && check->finding[0].probability >= HCI_CHECK_FOUND) return HCI_CHECK_SLIPS;
    if (check->probability_as_declared < 0.5) return HCI_CHECK_AMBIGUOUS;
    for (size_t k = 0; k < check->evidences; ++k)
        if (check->evidence[k].state == HCI_CHECK_UNMENDED || check->evidence[k].state == HCI_CHECK_MENDABLE)
            return HCI_CHECK_NOT_UNDERSTOOD;
    return HCI_CHECK_CONSISTENT;
}

/* Of a zero by the currents, what is below is rounding. */
#define FINEST_RAD 1e-6

/* As declared, in the numbers as they are. */
static void conclude_zero(const check_posterior *p, hci_check *check)
{
    const check_interpretation declared = hci_check_as_declared();
    const check_run_zero zero = hci_check_run_zero(p->data, &declared);
    const double error_rad = hci_check_zero_error(p->data, &declared, zero);
    const bool is_measured = zero.is_known && !zero.is_of_drive;
    check->given_zero_rad = hci_check_given_zero_rad(p->data);
    check->zero_rad = is_measured ? zero.zero_rad : (double)NAN;
    check->zero_error_rad = is_measured ? zero.std_error_rad : (double)NAN;
    check->zero_reach_rad = is_measured ? error_rad : (double)NAN;
    check->zero_is_told = is_measured && hci_check_zero_is_told(p->data, &declared, zero.zero_rad);
    check->drive_zero_rad =
        zero.is_of_drive ? round(zero.zero_rad / FINEST_RAD) * FINEST_RAD + 0.0 : (double)NAN;
    check->drive_zero_reach_rad = zero.is_of_drive ? error_rad : (double)NAN;
}

/* Of the magnets' torque: a reluctance torque that is more than their tolerances and what currents beside q
 * make of noise. */
#define SALIENT 0.15

/* A reading as probable as this is one of those that would do. */
#define LEAST_DECLARED 0.05

/* A scale that is known so well is told from every slip. */
#define SCALE_TOLD 0.09

static void conclude_saliency(const check_posterior *p, hci_check *check)
{
    const check_interpretation declared = hci_check_as_declared();
    const check_saliency x = hci_check_saliency(p->data, &declared);
    const bool is_asked_for = x.share > SALIENT && check->probability_as_declared > LEAST_DECLARED;
    check->saliency_H = is_asked_for ? x.small_H : (double)NAN;
    check->saliency_at_load_H = is_asked_for ? x.large_H : (double)NAN;
    check->scale_left_open = is_asked_for ? x.left_open : (double)NAN;
}

const char *hci_check_saliency_words(const hci_check *check, char *text, size_t size)
{
    *text = '\0';
    if (isnan(check->saliency_H)) return text;
    const int used =
        snprintf(text, size,
                 "a reluctance torque that no inductance of the machine declares is in the torques, as of "
                 "L_q - L_d = %.2g H (%.2g H at the largest i_q)",
                 check->saliency_H, check->saliency_at_load_H);
    if (used < 0 || (size_t)used >= size) return text;
    if (check->verdict != HCI_CHECK_CONSISTENT)
        snprintf(text + used, size - (size_t)used, ", if nothing is read wrongly");
    else if (check->scale_left_open < SCALE_TOLD)
        snprintf(text + used, size - (size_t)used,
                 "; beside it the torque per ampere is that of the tables within %s %%, and another scale "
                 "is none that is needed",
                 HCI_PERCENT(100.0 * check->scale_left_open, 2));
    else
        snprintf(
            text + used, size - (size_t)used,
            ", or another scale of back-EMF, currents or torque (%.0f %% of it are left open): a load at "
            "another i_d, best 0, or voltages of the open machine, tell them apart",
            100.0 * check->scale_left_open);
    return text;
}

void hci_check_conclude(const check_posterior *p, hci_check *check)
{
    check->probability_as_declared = p->list[0].probability;
    for (size_t k = 0; k < HCI_CHECK_ERROR_COUNT; ++k)
        if (is_first_row(k)) add_finding(p, HCI_CHECK_ERRORS[k].name, check);
    add_evidence(p, check);
    add_untold(p, check);
    hci_check_own_findings(p, check);
    check->verdict = verdict_of(check);
    conclude_zero(p, check);
    conclude_saliency(p, check);
}
