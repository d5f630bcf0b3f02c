#include "host/diagnose/candidates/make_candidates.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/candidate_orders.h"
#include "host/diagnose/candidates/empirical_term.h"

enum {
    MOST_COGGING = 12,   /* orders of cogging that are looked into at a time */
    MOST_MECHANICAL = 6, /* of those that repeat with the mechanical turn only */
    MOST_EMF_ORDER = 25,
    MOST_SEQUENCE_ORDER = 7, /* of back-EMF in the sequences that a balanced machine does not have */
    UNKNOWN_LINES = 3
};

#define EXPECTED 0.2  /* ripple of one power of the currents, as a share of the largest that was measured */
#define FADING   0.25 /* of what is expected, from one degree to the next */
#define ALIKE    0.15 /* speeds that differ by less, as a share, are the same */

/* Of how many like it a candidate is chosen: what is usual in a machine is cheaper. */
#define USUAL_EMF       8.0 /* 6k ± 1 */
#define UNUSUAL_EMF     40.0
#define RELUCTANCE      12.0
#define MEAN_SATURATION 6.0
#define SATURATION      30.0
#define UNSYMMETRIC     60.0 /* a rotor that does not look alike both ways round */

/* What may be expected of a dataset that somebody has looked at: larger values have to be paid for. */
#define EXPECTED_COGGING      0.3  /* of the largest torque */
#define EXPECTED_IMBALANCE    0.2  /* of the back-EMF */
#define EXPECTED_ANGLE        0.1  /* rad */
#define EXPECTED_ECCENTRICITY 0.03 /* rad */
#define EXPECTED_DELAY        1e-3 /* s */
#define EXPECTED_GAIN         0.1
#define EXPECTED_OFFSET       0.05 /* of the largest current */
#define EXPECTED_ZERO         0.1  /* of the torque sensor, of the largest torque */

/* ---- a list that grows ---- */

static size_t parameter_of(const hci_effect_type *type, const char *name)
{
    size_t k = 0;
    while (k < type->parameter_count && strcmp(type->parameter[k].name, name) != 0)
        ++k;
    return k;
}

typedef struct {
    hci_candidates *list;
    size_t capacity;
    bool failed;
} builder;

static bool reserve(builder *b)
{
    if (b->list->count < b->capacity) return true;
    const size_t wanted = 2 * b->capacity + 64;
    hci_candidate *grown = hci_memory_resize(b->list->candidate, wanted, sizeof *grown);
    if (!grown) return false;
    b->list->candidate = grown;
    b->capacity = wanted;
    return true;
}

/* Terms of one type with these parameters that come in together. */
static void add(builder *b, const hci_effect_type *type, const char *const *names, size_t count, double order,
                double price)
{
    b->failed = b->failed || !reserve(b);
    if (b->failed) return;
    hci_candidate *s = &b->list->candidate[b->list->count++];
    memset(s, 0, sizeof *s);
    s->type = type;
    s->count = count;
    s->price = price;
    for (size_t k = 0; k < count; ++k)
        s->term[k] = (hci_effect_term){parameter_of(type, names[k]), order, 0.0, NAN};
}

static void add_one(builder *b, const char *effect, const char *name, double order, double price)
{
    add(b, hci_effect_type_find(effect), &name, 1, order, price);
}

static double price_of(double choices)
{
    return 2.0 * log(fmax(1.0, choices));
}

/* ---- kinds ---- */

static const char *const PAIR[] = {"sine", "cosine"};
static const char *const IQ_PAIR[] = {"iq_sine", "iq_cosine"};

static void add_lines(builder *b, const hci_candidate_orders *lines, int pole_pairs, bool slots)
{
    const hci_effect_type *type = hci_effect_type_find(slots ? "cogging" : "mechanical_order");
    const double price = price_of((double)lines->count);
    double under = INFINITY;
    for (int n = 0; n < (slots ? MOST_COGGING : MOST_MECHANICAL); ++n) {
        const size_t periods = hci_candidate_orders_next(lines, (size_t)pole_pairs, slots, &under);
        const double order = (double)periods / (double)pole_pairs;
        if (periods == 0) break;
        add(b, type, PAIR, 2, order, price);
        if (!slots) add(b, type, IQ_PAIR, 2, order, price);
    }
}

/* Even harmonics take poles that are not alike, which the declared back-EMF would show already. */
static bool has_even_emf(const hci_machine *machine)
{
    for (size_t k = 0; k < machine->back_emf_count; ++k)
        if (fabs(fmod(machine->back_emf[k].order, 2.0)) < HCI_ORDER_TOLERANCE) return true;
    return false;
}

static void add_back_emf(builder *b, const hci_machine *machine)
{
    static const char *const POSITIVE[] = {"pos_sine", "pos_cosine"};
    static const char *const NEGATIVE[] = {"neg_sine", "neg_cosine"};
    const hci_effect_type *type = hci_effect_type_find("back_emf");
    const int step = has_even_emf(machine) ? 1 : 2;
    add_one(b, "back_emf", "sine", 1.0, price_of(2.0));
    add_one(b, "back_emf", "cosine", 1.0, price_of(2.0));
    for (int n = 1 + step; n <= MOST_EMF_ORDER; n += step)
        add(b, type, PAIR, 2, n, price_of(n % 6 == 1 || n % 6 == 5 ? USUAL_EMF : UNUSUAL_EMF));
    for (int n = 1; n <= MOST_SEQUENCE_ORDER; n += step) {
        const int sequence = hci_sequence_of_order(n);
        if (sequence != 1) add(b, type, POSITIVE, 2, n, price_of(UNUSUAL_EMF));
        if (sequence != -1) add(b, type, NEGATIVE, 2, n, price_of(UNUSUAL_EMF));
    }
}

static void add_unknown(builder *b, const hci_candidates_source *s, const hci_candidate_orders *lines)
{
    size_t taken[UNKNOWN_LINES], growth = 0;
    for (size_t n = 0; n < UNKNOWN_LINES; ++n) {
        taken[n] = hci_candidate_orders_empirical(lines, s->samples, taken, n, &growth);
        if (taken[n] == 0) return;
        add(b, &hci_empirical_type, PAIR, 2, (double)(taken[n] * lines->stride) / s->machine->pole_pairs,
            price_of((double)lines->count * HCI_GROWTH_LAWS));
        if (b->failed) return;
        hci_candidate *x = &b->list->candidate[b->list->count - 1];
        x->term[0].parameter = 2 * growth;
        x->term[1].parameter = 2 * growth + 1;
    }
}

static void add_phases(builder *b, const char *effect)
{
    add_one(b, effect, "a", 0.0, price_of(3.0));
    add_one(b, effect, "b", 0.0, price_of(3.0));
    add_one(b, effect, "c", 0.0, price_of(3.0));
}

static void add_reluctance(builder *b, int richness)
{
    static const char *const EVEN[] = {"dd_cosine", "qq_cosine", "dq_sine"};
    static const char *const ODD[] = {"dd_sine", "qq_sine", "dq_cosine"};
    add_one(b, "reluctance", "dd_cosine", 0.0, 0.0);
    add_one(b, "reluctance", "dq_cosine", 0.0, price_of(4.0));
    for (int n = 2; n <= (richness > 0 ? 60 : 24); n += n == 2 ? 4 : 6)
        for (int k = 0; k < 3; ++k) {
            add_one(b, "reluctance", EVEN[k], n, price_of(n == 2 ? UNSYMMETRIC : RELUCTANCE));
            add_one(b, "reluctance", ODD[k], n, price_of(UNSYMMETRIC));
        }
}

/* Largest torque, and the reference current as a share of the largest current that was measured. */
typedef struct {
    double torque_Nm, reference_share;
    int pole_pairs;
} expectation;

/* High powers of the currents resemble each other: without an expectation they would grow against each other.
 */
static void add_power(builder *b, const char *name, int degree, int order, double price, const expectation *e)
{
    const size_t before = b->list->count;
    const double most = e->torque_Nm * pow(e->reference_share, degree);
    add_one(b, "saturation", name, order, price);
    if (b->failed) return;
    b->list->candidate[before].deviation =
        order == 0 ? most * pow(FADING, degree > 4 ? degree - 4 : 0) / (3.0 * e->pole_pairs)
                   : EXPECTED * most * pow(FADING, degree - 3) / (e->pole_pairs * (double)order);
}

/* The order of one power d^(degree − q) q^q. A rotor that looks alike both ways round has cos for even and
 * sin for odd powers of i_q; the others are looked into at low orders only. The mean has no sine. */
static void add_power_order(builder *b, int degree, int q, int order, bool others, const expectation *e)
{
    static const char *const WAVE[] = {"cosine", "sine"};
    char name[32];
    const int usual = q % 2;
    for (int k = 0; k < (others ? 2 : 1); ++k) {
        const int wave = k == 0 ? usual : 1 - usual;
        const double choices = k == 1 ? UNSYMMETRIC : order == 0 ? MEAN_SATURATION : SATURATION;
        if (order == 0 && wave == 1) continue;
        snprintf(name, sizeof name, "d%dq%d_%s", degree - q, q, WAVE[wave]);
        add_power(b, name, degree, order, price_of(choices), e);
    }
}

static void add_saturation(builder *b, int richness, const expectation *e)
{
    const int degrees = richness > 1 ? 6 : 4, orders = richness > 0 ? 60 : 12;
    for (int degree = 3; degree <= degrees; ++degree)
        for (int q = 0; q <= degree; ++q)
            for (int order = 0; order <= orders; order += 6)
                add_power_order(b, degree, q, order, richness == 0, e);
}

static void expect(builder *b, const char *effect, const char *parameter, double deviation)
{
    const hci_effect_type *type = hci_effect_type_find(effect);
    for (size_t k = 0; k < b->list->count; ++k) {
        hci_candidate *s = &b->list->candidate[k];
        if (s->type == type && (!parameter || s->term[0].parameter == parameter_of(type, parameter)))
            s->deviation = deviation;
    }
}

static void expect_all(builder *b, double torque_Nm, double current_A)
{
    expect(b, "cogging", NULL, EXPECTED_COGGING * torque_Nm);
    expect(b, "phase_imbalance", NULL, EXPECTED_IMBALANCE);
    expect(b, "position_offset", NULL, EXPECTED_ANGLE);
    expect(b, "position_eccentricity", NULL, EXPECTED_ECCENTRICITY);
    expect(b, "channel_delay", NULL, EXPECTED_DELAY);
    expect(b, "current_gain", NULL, EXPECTED_GAIN);
    expect(b, "current_offset", NULL, EXPECTED_OFFSET * current_A);
    expect(b, "torque_sensor", "offset", EXPECTED_ZERO * torque_Nm);
}

static void add_bench(builder *b, bool timed, bool turns)
{
    static const char *const FIRST[] = {"mech_sine", "mech_cosine"};
    const char *const lag = "time_constant";
    if (timed) {
        add_one(b, "channel_delay", "current", 0.0, price_of(2.0));
        add_one(b, "channel_delay", "angle", 0.0, price_of(2.0));
    }
    for (int n = 1; n <= 2 && turns; ++n)
        add(b, hci_effect_type_find("position_eccentricity"), FIRST, 2, n, price_of(2.0));
    add_one(b, "position_offset", "angle", 0.0, 0.0);
    add_phases(b, "current_gain");
    add_phases(b, "current_offset");
    add_one(b, "torque_sensor", "offset", 0.0, 0.0);
    if (timed) add(b, hci_effect_type_find("torque_sensor"), &lag, 1, 0.0, 0.0);
}

/* How many different speeds the runs have, at most three. */
static size_t speeds_of(const hci_candidates_source *s)
{
    double known[3];
    size_t count = 0;
    for (size_t r = 0; r < s->samples->run_count && count < 3; ++r) {
        const double speed = fabs(s->samples->statistics[r].mean_speed_rad_per_s);
        bool is_new = s->use[r] && (speed > 0.0 || count == 0);
        for (size_t k = 0; k < count; ++k)
            is_new = is_new && fabs(speed - known[k]) > ALIKE * fmax(speed, known[k]);
        if (is_new) known[count++] = speed;
    }
    return count;
}

/* All of the law that the speeds can tell: a part left out would go into the others. */
static void add_friction(builder *b, const hci_candidates_source *s)
{
    static const char *const PARTS[] = {"coulomb", "viscous", "quadratic"};
    add(b, hci_effect_type_find("friction"), PARTS, speeds_of(s), 0.0, 0.0);
}

/* What the recordings are like as a whole. */
typedef struct {
    bool timed, moving, warm, turns;
    double torque_Nm, current_A; /* largest rms of a run */
} survey;

static survey survey_of(const hci_candidates_source *s)
{
    survey x = {false, false, false, false, 0.0, 0.0};
    for (size_t r = 0; r < s->samples->run_count; ++r) {
        const hci_run_statistics *f = &s->samples->statistics[r];
        x.timed = x.timed || (s->runs[r].time_s && s->runs[r].speed_rad_per_s);
        x.moving = x.moving || f->mean_speed_rad_per_s != 0.0;
        x.warm = x.warm || isfinite(f->temperature_C);
        x.turns = x.turns || s->runs[r].turn_known;
        x.torque_Nm = fmax(x.torque_Nm, f->rms_torque_Nm);
        x.current_A = fmax(x.current_A, f->current_A);
    }
    return x;
}

static void add_all(builder *b, const hci_candidates_source *s, const survey *x,
                    const hci_candidate_orders *lines)
{
    const double reference_A = b->list->reference_current_A;
    const expectation e = {x->torque_Nm, x->current_A > 0.0 ? reference_A / x->current_A : 1.0,
                           s->machine->pole_pairs};
    add_lines(b, lines, s->machine->pole_pairs, true);
    add_back_emf(b, s->machine);
    add_phases(b, "phase_imbalance");
    add_reluctance(b, s->richness);
    if (reference_A > 0.0) add_saturation(b, s->richness, &e); /* a series in currents relative to it */
    if (x->warm) add_one(b, "magnet_temperature", "emf_per_kelvin", 0.0, 0.0);
    add_lines(b, lines, s->machine->pole_pairs, false);
    if (x->moving || x->timed) add_friction(b, s);
    add_bench(b, x->timed, lines->stride == 1);
    expect_all(b, x->torque_Nm, x->current_A);
    add_unknown(b, s, lines);
}

/* ---- the list ---- */

/* What is in the model stays in the list, in its place. */
static hci_status keep_known(const hci_candidates *known, hci_candidates *list, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; known && k < known->count && !status; ++k) {
        const hci_candidate *x = &known->candidate[k];
        size_t at = 0;
        if (!x->in) continue;
        while (at < list->count && !hci_candidate_same(x, &list->candidate[at]))
            ++at;
        if (at < list->count)
            list->candidate[at] = *x;
        else
            status = hci_candidates_add(list, x, note);
    }
    return status;
}

hci_status hci_candidates_make(const hci_candidates_source *source, const hci_candidates *known,
                               hci_candidates *candidates, hci_note *note)
{
    const survey x = survey_of(source);
    builder b = {candidates, 0, false};
    hci_candidate_orders lines;
    memset(candidates, 0, sizeof *candidates);
    candidates->reference_current_A =
        source->reference_current_A > 0.0 ? source->reference_current_A : x.current_A;
    b.failed = !hci_candidate_orders_make(source, x.turns ? 1 : (size_t)source->machine->pole_pairs, &lines);
    if (!b.failed) add_all(&b, source, &x, &lines);
    hci_candidate_orders_release(&lines);
    const hci_status status =
        b.failed ? hci_note_memory(note, NULL, "the list of effects") : keep_known(known, candidates, note);
    if (status) hci_candidates_release(candidates);
    return status;
}
