#include "suspects.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/frames.h"
#include "memory.h"
#include "unknown.h"

enum {
    MOST_COGGING = 12,   /* orders of cogging that are looked into at a time */
    MOST_MECHANICAL = 6, /* of those that repeat with the mechanical turn only */
    MOST_EMF_ORDER = 25,
    UNKNOWN_LINES = 3,
    MOST_PERIODS = 1200 /* in a mechanical turn */
};

#define EXPECTED   0.2  /* ripple of one power of the currents, as a share of the largest that was measured */
#define FADING     0.25 /* of what is expected, from one degree to the next */
#define STANDS_OUT 12.0 /* of a χ² with two degrees of freedom: once in 400 by chance */

/* ---- the list ---- */

const hci_effect_room *hci_suspect_room(size_t k)
{
    const hci_effect_room *room = hci_effect_room_at(k);
    return room || (k > 0 && !hci_effect_room_at(k - 1)) ? room : &hci_unknown_room;
}

bool hci_suspect_same(const hci_suspect *a, const hci_suspect *b)
{
    if (a->room != b->room || a->count != b->count) return false;
    for (size_t k = 0; k < a->count; ++k)
        if (a->term[k].parameter != b->term[k].parameter ||
            fabs(a->term[k].order - b->term[k].order) > HCI_ORDER_TOLERANCE)
            return false;
    return true;
}

static size_t parameter_of(const hci_effect_room *room, const char *name)
{
    size_t k = 0;
    while (k < room->parameter_count && strcmp(room->parameter[k].name, name) != 0)
        ++k;
    return k;
}

/* Terms are named `PREFIX_sine` and so on. */
typedef struct {
    hci_suspects *list;
    size_t room;
    bool failed;
} builder;

static void add(builder *b, const hci_effect_room *room, const char *const *names, size_t count, double order,
                double start, double price)
{
    hci_suspect *s;
    if (b->failed) return;
    if (b->list->count == b->room) {
        hci_suspect *grown = hci_memory_resize(b->list->suspect, b->room = 2 * b->room + 64, sizeof *grown);
        if (!grown) {
            b->failed = true;
            return;
        }
        b->list->suspect = grown;
    }
    s = &b->list->suspect[b->list->count++];
    memset(s, 0, sizeof *s);
    s->room = room;
    s->count = count;
    s->price = price;
    for (size_t k = 0; k < count; ++k)
        s->term[k] = (hci_effect_term){parameter_of(s->room, names[k]), order, start, NAN};
}

static void add_one(builder *b, const char *effect, const char *name, double order, double price)
{
    add(b, hci_effect_room_find(effect), &name, 1, order, 0.0, price);
}

static double price_of(double choices)
{
    return 2.0 * log(fmax(1.0, choices));
}

/* ---- orders that stand out ---- */

/* For each period in a mechanical turn, how much a torque of that order, alone or in proportion to i_q, and
 * in phase in all runs, would explain. */
typedef struct {
    size_t count; /* periods 0 … count − 1 */
    double *still, *with_current;
    double *of_run; /* [run][count][2]: weighted sums with cos and sin */
    double *weight; /* of each run */
} line_spectrum;

/* The finest order that half of the steps of angle resolve. */
static size_t most_periods(const hci_suspects_source *s)
{
    double sum = 0.0, turns = 0.0;
    for (size_t k = 0; k < s->cells->stretch_count; ++k) {
        const hci_stretch *x = &s->cells->stretch[k];
        const hci_cell *first = &s->cells->cell[x->first], *last = first + x->count - 1;
        sum += (double)x->count;
        turns += fabs(last->reading.theta_m_rad - first->reading.theta_m_rad) / (2.0 * HCI_PI);
    }
    const double resolved = turns > 0.0 ? 0.48 * sum / turns : 1.0;
    const double wanted = fmin(resolved, 96.0 * s->machine->pole_pairs);
    return (size_t)fmax(1.0, fmin(wanted, MOST_PERIODS)) + 1;
}

/* Means of the residual of each run, by weight. */
static void means_of(const hci_suspects_source *s, double *mean, double *weight)
{
    for (size_t k = 0; k < s->cells->stretch_count; ++k) {
        const hci_stretch *x = &s->cells->stretch[k];
        for (size_t j = x->first; j < x->first + x->count; ++j) {
            const double w = 1.0 / s->variance[j];
            mean[x->run] += w * s->residual_Nm[j];
            weight[x->run] += w;
        }
    }
    for (size_t r = 0; r < s->cells->run_count; ++r)
        if (weight[r] > 0.0) mean[r] /= weight[r];
}

/* sums: [count][2] with i_q, of_run: the same without; cosine and sine. */
static void cell_into_sums(const hci_cell *c, double r, double w, double iq, double step_rad, size_t count,
                           double *sums, double *of_run)
{
    const double a = c->reading.theta_m_rad * step_rad, cs = cos(a), sn = sin(a);
    double x = 1.0, y = 0.0;
    for (size_t k = 0; k < count; ++k) {
        of_run[2 * k] += w * r * x;
        of_run[2 * k + 1] += w * r * y;
        sums[2 * k] += w * r * iq * x;
        sums[2 * k + 1] += w * r * iq * y;
        const double next = cs * x - sn * y;
        y = sn * x + cs * y;
        x = next;
    }
}

static void lines_sum(const hci_suspects_source *s, size_t stride, const double *mean, line_spectrum *lines,
                      double *sums)
{
    double total = 0.0, total_iq = 0.0;
    for (size_t k = 0; k < s->cells->stretch_count; ++k) {
        const hci_stretch *x = &s->cells->stretch[k];
        for (size_t j = x->first; j < x->first + x->count; ++j) {
            const hci_cell *c = &s->cells->cell[j];
            const double w = 1.0 / s->variance[j];
            const double iq =
                hci_park(hci_clarke(c->reading.i_abc), s->machine->pole_pairs * c->reading.theta_m_rad).q;
            cell_into_sums(c, s->residual_Nm[j] - mean[x->run], w, iq, (double)stride, lines->count, sums,
                           lines->of_run + 2 * lines->count * x->run);
            lines->weight[x->run] += w;
            total += w;
            total_iq += w * iq * iq;
        }
    }
    for (size_t k = 0; k < lines->count; ++k) {
        double cosine = 0.0, sine = 0.0;
        for (size_t r = 0; r < s->cells->run_count; ++r) {
            cosine += lines->of_run[2 * (lines->count * r + k)];
            sine += lines->of_run[2 * (lines->count * r + k) + 1];
        }
        lines->still[k] = 2.0 * (cosine * cosine + sine * sine) / total;
        lines->with_current[k] =
            total_iq > 0.0 ? 2.0 * (sums[2 * k] * sums[2 * k] + sums[2 * k + 1] * sums[2 * k + 1]) / total_iq
                           : 0.0;
    }
}

/* Everything in one block, which begins at `still`. */
static bool lines_find(const hci_suspects_source *s, size_t stride, line_spectrum *lines)
{
    const size_t runs = s->cells->run_count, count = most_periods(s) / stride + 1;
    double *work;
    lines->count = count;
    lines->still = hci_memory_new(4 * count + 2 * runs * count + 3 * runs, sizeof *lines->still);
    if (!lines->still) return false;
    lines->with_current = lines->still + count;
    lines->of_run = lines->with_current + count;
    lines->weight = lines->of_run + 2 * runs * count;
    work = lines->weight + runs;
    means_of(s, work, work + runs);
    lines_sum(s, stride, work, lines, work + 2 * runs);
    return true;
}

static size_t common_divisor(size_t a, size_t b)
{
    while (b > 0) {
        const size_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* Whether an order of the mechanical turn is one of slots and poles: a whole electrical order, or one that a
 * group of the poles shares with a group of the slots. */
static bool is_of_slots(size_t periods, size_t pole_pairs)
{
    if (periods % pole_pairs == 0) return true;
    return periods > pole_pairs && periods % 3 == 0 && common_divisor(periods, pole_pairs) > 1;
}

static double strength(const line_spectrum *lines, size_t k, bool slots)
{
    return slots ? lines->still[k] : fmax(lines->still[k], lines->with_current[k]);
}

/* The next strongest order of its kind below `under`; 0: none. */
static size_t next_line(const line_spectrum *lines, size_t stride, size_t p, bool slots, double *under)
{
    size_t best = 0;
    double most = STANDS_OUT;
    for (size_t k = 1; k < lines->count; ++k) {
        const double x = strength(lines, k, slots);
        if (is_of_slots(k * stride, p) != slots || x >= *under || x <= most) continue;
        most = x;
        best = k;
    }
    *under = most;
    return best * stride;
}

/* ---- kinds ---- */

static const char *const PAIR[] = {"sine", "cosine"};
static const char *const IQ_PAIR[] = {"iq_sine", "iq_cosine"};

static void add_lines(builder *b, const line_spectrum *lines, size_t stride, size_t p, bool slots)
{
    const double choices = (double)lines->count;
    double under = INFINITY;
    for (int n = 0; n < (slots ? MOST_COGGING : MOST_MECHANICAL); ++n) {
        const size_t k = next_line(lines, stride, p, slots, &under);
        if (k == 0) break;
        add(b, hci_effect_room_find(slots ? "cogging" : "mechanical_order"), PAIR, 2, (double)k / (double)p,
            0.0, price_of(choices));
        if (!slots)
            add(b, hci_effect_room_find("mechanical_order"), IQ_PAIR, 2, (double)k / (double)p, 0.0,
                price_of(choices));
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
    const hci_effect_room *room = hci_effect_room_find("back_emf");
    const int step = has_even_emf(machine) ? 1 : 2;
    add_one(b, "back_emf", "sine", 1.0, price_of(2.0));
    add_one(b, "back_emf", "cosine", 1.0, price_of(2.0));
    for (int n = 1 + step; n <= MOST_EMF_ORDER; n += step)
        add(b, room, PAIR, 2, n, 0.0, price_of(n % 6 == 1 || n % 6 == 5 ? 8.0 : 40.0));
    for (int n = 1; n <= 7; n += step) {
        const int sequence = hci_sequence_of_order(n);
        if (sequence != 1) add(b, room, POSITIVE, 2, n, 0.0, price_of(40.0));
        if (sequence != -1) add(b, room, NEGATIVE, 2, n, 0.0, price_of(40.0));
    }
}

/* What a torque of one order and growth would explain, and the best growths of it. */
static double growth_gain(const hci_suspects_source *s, const line_spectrum *lines, size_t k, size_t g)
{
    double cosine = 0.0, sine = 0.0, weight = 0.0;
    for (size_t r = 0; r < s->cells->run_count; ++r) {
        const hci_run_figures *f = &s->cells->figures[r];
        const double *sum = lines->of_run + 2 * (lines->count * r + k);
        const double x = hci_growth_at(g, f->current_A, f->mean_speed_rad_per_s);
        cosine += x * sum[0];
        sine += x * sum[1];
        weight += x * x * lines->weight[r];
    }
    return weight > 0.0 ? 2.0 * (cosine * cosine + sine * sine) / weight : 0.0;
}

static void add_unknown(builder *b, const hci_suspects_source *s, const line_spectrum *lines, size_t stride)
{
    double taken[UNKNOWN_LINES] = {0.0};
    for (int n = 0; n < UNKNOWN_LINES; ++n) {
        double most = 2.0 * STANDS_OUT;
        size_t best = 0, growth = 0;
        for (size_t k = 1; k < lines->count; ++k) {
            bool free = true;
            for (int j = 0; j < n; ++j)
                free = free && taken[j] != (double)k;
            for (size_t g = 0; g < HCI_GROWTHS && free; ++g) {
                if (hci_growth_is_known(g, (double)k)) continue;
                const double gain = growth_gain(s, lines, k, g);
                if (gain > most) {
                    most = gain;
                    best = k;
                    growth = g;
                }
            }
        }
        if (best == 0) return;
        taken[n] = (double)best;
        add(b, &hci_unknown_room, PAIR, 2, (double)(best * stride) / s->machine->pole_pairs, 0.0,
            price_of((double)lines->count * HCI_GROWTHS));
        if (b->failed) return;
        b->list->suspect[b->list->count - 1].term[0].parameter = 2 * growth;
        b->list->suspect[b->list->count - 1].term[1].parameter = 2 * growth + 1;
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
            add_one(b, "reluctance", EVEN[k], n, price_of(n == 2 ? 60.0 : 12.0));
            add_one(b, "reluctance", ODD[k], n, price_of(60.0));
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
    b->list->suspect[before].deviation =
        order == 0 ? most * pow(FADING, degree > 4 ? degree - 4 : 0) / (3.0 * e->pole_pairs)
                   : EXPECTED * most * pow(FADING, degree - 3) / (e->pole_pairs * (double)order);
}

/* A rotor that looks alike both ways round has cos for even and sin for odd powers of i_q. */
static void add_saturation(builder *b, int richness, const expectation *e)
{
    const int degrees = richness > 1 ? 6 : 4, orders = richness > 0 ? 60 : 12;
    for (int degree = 3; degree <= degrees; ++degree) {
        for (int q = 0; q <= degree; ++q) {
            for (int n = 0; n <= orders; n += 6) {
                char name[32];
                const double price = price_of(n == 0 ? 6.0 : 30.0);
                const bool cosine = q % 2 == 0;
                snprintf(name, sizeof name, "d%dq%d_%s", degree - q, q, cosine ? "cosine" : "sine");
                if (n > 0 || cosine) add_power(b, name, degree, n, price, e);
                snprintf(name, sizeof name, "d%dq%d_%s", degree - q, q, cosine ? "sine" : "cosine");
                if (richness == 0 && (n > 0 || !cosine)) add_power(b, name, degree, n, price_of(60.0), e);
            }
        }
    }
}

/* What may be expected of a bench that somebody has looked at: larger values have to be paid for. */
static void expect(builder *b, const char *effect, const char *parameter, double deviation)
{
    const hci_effect_room *room = hci_effect_room_find(effect);
    for (size_t k = 0; k < b->list->count; ++k) {
        hci_suspect *s = &b->list->suspect[k];
        if (s->room == room && (!parameter || s->term[0].parameter == parameter_of(room, parameter)))
            s->deviation = deviation;
    }
}

static void expect_all(builder *b, double torque_Nm, double current_A)
{
    expect(b, "cogging", NULL, 0.3 * torque_Nm);
    expect(b, "phase_imbalance", NULL, 0.2);
    expect(b, "position_offset", NULL, 0.1);
    expect(b, "position_eccentricity", NULL, 0.03);
    expect(b, "channel_delay", NULL, 1e-3);
    expect(b, "current_gain", NULL, 0.1);
    expect(b, "current_offset", NULL, 0.05 * current_A);
    expect(b, "torque_sensor", "offset", 0.1 * torque_Nm);
}

static void add_bench(builder *b, const hci_suspects_source *s, bool timed, bool turns)
{
    static const char *const FIRST[] = {"mech_sine", "mech_cosine"};
    const char *const lag = "time_constant";
    if (timed) {
        add_one(b, "channel_delay", "current", 0.0, price_of(2.0));
        add_one(b, "channel_delay", "angle", 0.0, price_of(2.0));
    }
    for (int n = 1; n <= 2 && turns; ++n)
        add(b, hci_effect_room_find("position_eccentricity"), FIRST, 2, n, 0.0, price_of(2.0));
    add_one(b, "position_offset", "angle", 0.0, 0.0);
    add_phases(b, "current_gain");
    add_phases(b, "current_offset");
    add_one(b, "torque_sensor", "offset", 0.0, 0.0);
    if (timed) add(b, hci_effect_room_find("torque_sensor"), &lag, 1, 0.0, 0.0, 0.0);
    (void)s;
}

/* How many different speeds the runs have, at most three. */
static size_t speeds_of(const hci_suspects_source *s)
{
    double known[3];
    size_t count = 0;
    for (size_t r = 0; r < s->cells->run_count && count < 3; ++r) {
        const double speed = fabs(s->cells->figures[r].mean_speed_rad_per_s);
        bool is_new = speed > 0.0 || count == 0;
        for (size_t k = 0; k < count; ++k)
            is_new = is_new && fabs(speed - known[k]) > 0.15 * fmax(speed, known[k]);
        if (is_new) known[count++] = speed;
    }
    return count;
}

/* All of the law that the speeds can tell: a part left out would go into the others. */
static void add_friction(builder *b, const hci_suspects_source *s)
{
    static const char *const PARTS[] = {"coulomb", "viscous", "quadratic"};
    add(b, hci_effect_room_find("friction"), PARTS, speeds_of(s), 0.0, 0.0, 0.0);
}

static void add_all(builder *b, const hci_suspects_source *s, const line_spectrum *lines, size_t stride)
{
    const size_t p = (size_t)s->machine->pole_pairs;
    bool timed = false, moving = false, warm = false;
    double torque_Nm = 0.0, most_A = 0.0;
    for (size_t r = 0; r < s->cells->run_count; ++r) {
        const hci_run_figures *f = &s->cells->figures[r];
        timed = timed || (s->runs[r].time_s && s->runs[r].speed_rad_per_s);
        moving = moving || f->mean_speed_rad_per_s != 0.0;
        warm = warm || isfinite(f->temperature_C);
        torque_Nm = fmax(torque_Nm, f->rms_torque_Nm);
        most_A = fmax(most_A, f->current_A);
    }
    const expectation e = {torque_Nm, most_A > 0.0 ? b->list->reference_current_A / most_A : 1.0,
                           s->machine->pole_pairs};
    add_lines(b, lines, stride, p, true);
    add_back_emf(b, s->machine);
    add_phases(b, "phase_imbalance");
    add_reluctance(b, s->richness);
    add_saturation(b, s->richness, &e);
    if (warm) add_one(b, "magnet_temperature", "emf_per_kelvin", 0.0, 0.0);
    add_lines(b, lines, stride, p, false);
    if (moving || timed) add_friction(b, s);
    add_bench(b, s, timed, stride == 1);
    expect_all(b, torque_Nm, most_A);
    add_unknown(b, s, lines, stride);
}

hci_status hci_suspects_add(hci_suspects *suspects, const hci_suspect *suspect, hci_note *note)
{
    size_t at = suspects->count;
    hci_suspect *grown = hci_memory_resize(suspects->suspect, suspects->count + 1, sizeof *grown);
    if (!grown) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the list of effects");
    suspects->suspect = grown;
    while (at > 0 && grown[at - 1].room != suspect->room)
        --at;
    if (at == 0) at = suspects->count;
    memmove(grown + at + 1, grown + at, (suspects->count - at) * sizeof *grown);
    grown[at] = *suspect;
    ++suspects->count;
    return HCI_OK;
}

/* What is in the model stays in the list, in its place. */
static hci_status keep_known(const hci_suspects *known, hci_suspects *list, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; known && k < known->count && !status; ++k) {
        const hci_suspect *x = &known->suspect[k];
        size_t at = 0;
        if (!x->in) continue;
        while (at < list->count && !hci_suspect_same(x, &list->suspect[at]))
            ++at;
        if (at < list->count)
            list->suspect[at] = *x;
        else
            status = hci_suspects_add(list, x, note);
    }
    return status;
}

hci_status hci_suspects_make(const hci_suspects_source *source, const hci_suspects *known,
                             hci_suspects *suspects, hci_note *note)
{
    builder b = {suspects, 0, false};
    line_spectrum lines = {0, NULL, NULL, NULL, NULL};
    bool turns = false;
    size_t stride;
    memset(suspects, 0, sizeof *suspects);
    for (size_t r = 0; r < source->cells->run_count; ++r) {
        suspects->reference_current_A =
            fmax(suspects->reference_current_A, source->cells->figures[r].current_A);
        turns = turns || source->runs[r].turn_known;
    }
    if (source->reference_current_A > 0.0) suspects->reference_current_A = source->reference_current_A;
    stride = turns ? 1 : (size_t)source->machine->pole_pairs;
    b.failed = !lines_find(source, stride, &lines);
    if (!b.failed) add_all(&b, source, &lines, stride);
    hci_memory_free(lines.still);
    const hci_status status =
        b.failed ? hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the list of effects")
                 : keep_known(known, suspects, note);
    if (status) hci_suspects_release(suspects);
    return status;
}

void hci_suspects_release(hci_suspects *suspects)
{
    hci_memory_free(suspects->suspect);
    memset(suspects, 0, sizeof *suspects);
}
