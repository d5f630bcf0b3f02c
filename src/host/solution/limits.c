#include "host/solution/limits.h"

#include <math.h>

#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/numeric/peak.h"
#include "host/solve/task.h"

#define NEARLY  0.95 /* share of the largest sample from which a peak is looked at */
#define TOUCHED 1e-5 /* share of a limit below it that counts as touched */
#define KEPT    1e-9 /* share beyond a limit that is rounding */
#define FAR_OFF 1e-3 /* share below a limit from which it does not bind */

#define NOISE  1e-5 /* share of what all limits cost that is rounding */
#define PULL   0.05 /* the same of the pull of a bound on the distance, beside which there are no prices */
#define HOTTER 1e-3 /* share above the heat of rated_current that is spoken of */
#define HIGHER 0.1  /* the same of a peak, which lasts a moment */

enum { SAMPLES_PER_PERIOD = 64 };

const char *hci_limit_kind_name(hci_limit_kind kind)
{
    static const char *const NAME[] = {"current", "rms", "voltage", "copper"};
    return NAME[kind];
}

const char *hci_limit_place_name(const hci_limit *l, int phase)
{
    static const char *const PHASE[] = {"a", "b", "c"}, *const PAIR[] = {"ab", "bc", "ca"};
    if (l->kind == HCI_LIMIT_VOLTAGE && l->modulation == HCI_MODULATION_CIRCLE) return "vector";
    return (l->kind == HCI_LIMIT_VOLTAGE && l->modulation != HCI_MODULATION_SINUSOIDAL ? PAIR : PHASE)[phase];
}

const char *hci_limit_cost_name(hci_limit_cost cost)
{
    static const char *const NAME[] = {"none", "copper", "ripple", "torque", "limits"};
    return NAME[cost];
}

/* ---- the list ---- */

static hci_limit *add_limit(hci_solution *s, hci_limit_kind kind, int phase, double limit)
{
    hci_limit *l = &s->limit[s->limit_count++];
    *l = (hci_limit){.kind = kind, .phase = phase, .limit = limit};
    return l;
}

/* One entry where all phases are alike, else one for each phase that is limited. */
static void add_phases(hci_solution *s, hci_limit_kind kind, const double limit[3], const bool is_declared[3])
{
    const bool alike = limit[0] == limit[1] && limit[1] == limit[2];
    for (int phase = 0; phase < (alike ? 1 : 3); ++phase)
        if (limit[phase] < HUGE_VAL)
            add_limit(s, kind, alike ? -1 : phase, limit[phase])->is_declared = is_declared[phase];
}

void hci_limits_list(const hci_bounds *b, hci_solution *s)
{
    static const bool never[3] = {false, false, false};
    s->limit_count = 0;
    s->resistance_ohm = b->resistance_ohm;
    add_phases(s, HCI_LIMIT_CURRENT, b->current_A, b->current_is_declared);
    add_phases(s, HCI_LIMIT_RMS, b->rms_A, never);
    if (b->line_V < HUGE_VAL) {
        hci_limit *l = add_limit(s, HCI_LIMIT_VOLTAGE, -1, b->line_V);
        l->is_declared = b->voltage_is_declared;
        l->modulation = b->modulation;
    }
    if (b->mean_square_A2 < HUGE_VAL) add_limit(s, HCI_LIMIT_COPPER, -1, b->mean_square_A2);
}

/* A multiplier next to which others are many times as large is the rounding of the program. */
static void drop_noise(hci_solution *s)
{
    double sum = 0.0;
    for (size_t k = 0; k < s->limit_count; ++k)
        sum += fmax(s->limit[k].gain * s->limit[k].limit, 0.0);
    for (size_t k = 0; k < s->limit_count; ++k) {
        hci_limit *l = &s->limit[k];
        l->binds = l->gain * l->limit > NOISE * sum;
        if (!l->binds) l->gain = 0.0;
    }
}

/* Currents that only the distance from the last ones keeps from better ones are no optimum, whose slope a
 * multiplier would be. */
static void forget_prices(double pull, hci_solution *s)
{
    double sum = 0.0;
    for (size_t k = 0; k < s->limit_count; ++k)
        sum += s->limit[k].gain * s->limit[k].limit;
    for (size_t k = 0; k < s->limit_count && pull > PULL * sum; ++k)
        if (s->limit[k].binds) s->limit[k].gain = NAN;
}

void hci_limits_take_gains(const hci_limit_optimum *c, hci_solution *s)
{
    for (size_t k = 0; k < s->limit_count; ++k) {
        hci_limit *l = &s->limit[k];
        const double *phases = l->kind == HCI_LIMIT_CURRENT ? c->current_gain : c->rms_gain;
        const double sum = l->phase < 0 ? phases[0] + phases[1] + phases[2] : phases[l->phase];
        l->gain = l->kind == HCI_LIMIT_VOLTAGE  ? c->voltage_gain
                  : l->kind == HCI_LIMIT_COPPER ? c->copper_gain
                                                : sum;
    }
    drop_noise(s);
    forget_prices(c->pull, s);
}

/* ---- peaks ---- */

/* A current or a voltage of one phase over the angle. */
typedef struct {
    const hci_solution *solution;
    const hci_voltage_model *voltage; /* NULL: the current */
    int phase;
    double step_rad;
    bool is_circle; /* the size of the voltage vector, in place of each phase */
} curve;

static void plane_of(const hci_solution *s, double theta_rad, hci_plane_current *i)
{
    double abc[3], change[3] = {0.0, 0.0, 0.0};
    hci_waves_at(s->current.wave, s->current.count, theta_rad, abc);
    hci_plane_from_abc(abc, i->x);
    for (size_t k = 0; k < s->current.count; ++k) {
        const hci_wave w = s->current.wave[k];
        const hci_wave slope = {w.order, w.sequence, -w.order * w.cosine, w.order * w.sine};
        hci_waves_at(&slope, 1, theta_rad, abc);
        for (int phase = 0; phase < 3; ++phase)
            change[phase] += abc[phase];
    }
    hci_plane_from_abc(change, i->slope);
}

/* Sizes of all three at one angle. */
static void sizes_at(const curve *c, double theta_rad, double size[3])
{
    hci_plane_current i;
    double v[2];
    if (c->voltage) {
        plane_of(c->solution, theta_rad, &i);
        hci_voltage_at(c->voltage, theta_rad, &i, v);
    } else {
        hci_waves_at(c->solution->current.wave, c->solution->current.count, theta_rad, size);
    }
    for (int k = 0; k < 3; ++k)
        size[k] = fabs(!c->voltage    ? size[k]
                       : c->is_circle ? hci_voltage_of_circle(v)
                                      : hci_voltage_of_link(c->voltage, v, k));
}

static double size_at(const void *context, double theta_rad)
{
    const curve *c = context;
    double size[3];
    sizes_at(c, theta_rad, size);
    return size[c->phase];
}

/* Angles in a period: so many in the shortest wave that no peak hides between two of them. */
static size_t samples_of(const hci_solution *s, double top)
{
    for (size_t k = 0; k < s->current.count; ++k)
        top = fmax(top, s->current.wave[k].order);
    return s->period_turns * (size_t)ceil(SAMPLES_PER_PERIOD * top);
}

/* Where a peak is near its limit. */
static void note_touch(hci_limit *l, int phase, double theta_rad, double value)
{
    const double turn = 2.0 * HCI_PI;
    if (!l || value < (1.0 - TOUCHED) * l->limit) return;
    if (l->touch_count < HCI_MOST_TOUCHES)
        l->touch[l->touch_count] = (hci_limit_touch){phase, theta_rad < 0.0 ? theta_rad + turn : theta_rad};
    ++l->touch_count;
}

/* The largest value over the period, and where it touches a limit (or NULL). value: that of every third place
 * is of this phase. */
static double peak_of(const curve *c, size_t samples, hci_limit *l, const double *value)
{
    const hci_peak_function f = {size_at, c};
    double most = 0.0;
    for (size_t k = 0; k < samples; ++k)
        most = fmax(most, value[3 * k]);
    for (size_t k = 0; k < samples; ++k) {
        const double before = value[3 * ((k + samples - 1) % samples)],
                     after = value[3 * ((k + 1) % samples)];
        double theta_rad = c->step_rad * (double)k, peak;
        if (value[3 * k] < before || value[3 * k] <= after || value[3 * k] < NEARLY * most) continue;
        peak = hci_peak_refine(&f, c->step_rad, &theta_rad);
        most = fmax(most, peak);
        note_touch(l, c->phase, theta_rad, peak);
    }
    return most;
}

static void sample(const curve *c, size_t samples, double *value)
{
    for (size_t k = 0; k < samples; ++k)
        sizes_at(c, c->step_rad * (double)k, value + 3 * k);
}

static hci_limit *find_limit(hci_solution *s, hci_limit_kind kind, int phase)
{
    for (size_t k = 0; k < s->limit_count; ++k)
        if (s->limit[k].kind == kind && (s->limit[k].phase < 0 || s->limit[k].phase == phase))
            return &s->limit[k];
    return NULL;
}

static void take_value(hci_limit *l, double value)
{
    if (l) l->value = fmax(l->value, value);
}

/* Peak and rms currents. value: workspace of 3·samples. */
static void check_currents(hci_solution *s, size_t samples, double *value)
{
    curve c = {s, NULL, 0, 2.0 * HCI_PI * (double)s->period_turns / (double)samples, false};
    sample(&c, samples, value);
    s->peak_phase_current_A = s->rms_phase_current_A = 0.0;
    for (; c.phase < 3; ++c.phase) {
        hci_limit *l = find_limit(s, HCI_LIMIT_CURRENT, c.phase);
        const double peak_A = peak_of(&c, samples, l, value + c.phase);
        double sum = 0.0;
        for (size_t k = 0; k < samples; ++k)
            sum += value[3 * k + (size_t)c.phase] * value[3 * k + (size_t)c.phase];
        const double rms_A = sqrt(sum / (double)samples);
        take_value(l, peak_A);
        take_value(find_limit(s, HCI_LIMIT_RMS, c.phase), rms_A);
        s->peak_phase_current_A = fmax(s->peak_phase_current_A, peak_A);
        s->rms_phase_current_A = fmax(s->rms_phase_current_A, rms_A);
    }
}

static double neutral_at(const void *context, double theta_rad)
{
    const curve *c = context;
    double abc[3];
    hci_waves_at(c->solution->current.wave, c->solution->current.count, theta_rad, abc);
    return fabs(abc[0] + abc[1] + abc[2]);
}

static void check_neutral(hci_solution *s, size_t samples)
{
    const curve c = {s, NULL, 0, 2.0 * HCI_PI * (double)s->period_turns / (double)samples, false};
    const hci_peak_function f = {neutral_at, &c};
    double sum = 0.0, most_A = 0.0, at_rad = 0.0;
    for (size_t k = 0; k < samples; ++k) {
        const double size_A = neutral_at(&c, c.step_rad * (double)k);
        sum += size_A * size_A;
        if (size_A > most_A) at_rad = c.step_rad * (double)k;
        most_A = fmax(most_A, size_A);
    }
    s->peak_neutral_A = s->rms_neutral_A = 0.0;
    if (most_A <= KEPT * s->peak_phase_current_A) return; /* rounding */
    s->rms_neutral_A = sqrt(sum / (double)samples);
    s->peak_neutral_A = fmax(most_A, hci_peak_refine(&f, c.step_rad, &at_rad));
}

/* The largest of the voltages that the inverter makes, which is returned, and of those that open phases show.
 * limited: they are what has to stay within the dc link. */
static double check_link(const hci_voltage_model *v, const hci_bounds *b, bool limited, hci_solution *s,
                         size_t samples, double *value)
{
    curve c = {s, v, 0, 2.0 * HCI_PI * (double)s->period_turns / (double)samples, false};
    double most_V = 0.0;
    sample(&c, samples, value);
    for (; c.phase < 3; ++c.phase) {
        const bool driven = hci_bounds_drive_pair(b, c.phase);
        hci_limit *l = driven && limited ? find_limit(s, HCI_LIMIT_VOLTAGE, c.phase) : NULL;
        const double peak_V = peak_of(&c, samples, l, value + c.phase);
        take_value(l, peak_V);
        if (driven)
            most_V = fmax(most_V, peak_V);
        else
            s->peak_open_voltage_V = fmax(s->peak_open_voltage_V, peak_V);
    }
    return most_V;
}

/* The same of the vector, which is limited. */
static void check_circle(const hci_voltage_model *v, hci_solution *s, size_t samples, double *value)
{
    const curve c = {s, v, 0, 2.0 * HCI_PI * (double)s->period_turns / (double)samples, true};
    hci_limit *l = find_limit(s, HCI_LIMIT_VOLTAGE, 0);
    sample(&c, samples, value);
    take_value(l, peak_of(&c, samples, l, value));
}

static bool drives_all(const hci_bounds *b)
{
    return hci_bounds_drive_pair(b, 0) && hci_bounds_drive_pair(b, 1) && hci_bounds_drive_pair(b, 2);
}

/* The line voltages; other modulations limit the phases or the vector in their place. */
static void check_voltages(const hci_voltage_model *v, const hci_bounds *b, hci_solution *s, size_t samples,
                           double *value)
{
    hci_voltage_model lines = *v;
    hci_bounds of_lines = *b;
    const bool of_phases = b->modulation == HCI_MODULATION_SINUSOIDAL,
               of_vector = b->modulation == HCI_MODULATION_CIRCLE && drives_all(b);
    lines.modulation = of_lines.modulation = HCI_MODULATION_SPACE_VECTOR;
    if (of_phases) check_link(v, b, true, s, samples, value);
    if (of_vector) check_circle(v, s, samples, value);
    s->peak_line_voltage_V = check_link(&lines, &of_lines, !of_phases && !of_vector, s, samples, value);
}

static double top_of_voltage(const hci_machine_data *m, const hci_effects *effects)
{
    double top = 1.0;
    for (size_t k = 0; k < m->model.back_emf_count; ++k)
        top = fmax(top, m->model.back_emf[k].order);
    return effects ? fmax(top, hci_effects_top_order(effects)) : top;
}

/* A limit that is far off costs nothing: a gain is then rounding, as is the current of an open phase. */
static void clean(const hci_solution *s, hci_limit *l)
{
    if (l->limit == 0.0 && l->value <= KEPT * s->peak_phase_current_A) l->value = 0.0;
    if (l->value >= (1.0 - FAR_OFF) * l->limit) return;
    l->gain = 0.0;
    l->binds = false;
}

static void judge(hci_solution *s)
{
    hci_limit *copper = find_limit(s, HCI_LIMIT_COPPER, 0);
    take_value(copper, hci_waves_mean_square(s->current.wave, s->current.count));
    for (size_t k = 0; k < s->limit_count; ++k)
        clean(s, &s->limit[k]);
    s->within_limits = true;
    for (size_t k = 0; k < s->limit_count; ++k)
        if (s->limit[k].value > s->limit[k].limit * (1.0 + KEPT) + KEPT * s->peak_phase_current_A)
            s->within_limits = false;
}

hci_status hci_limits_check(const hci_machine_data *m, const hci_solve_options *o, const hci_bounds *b,
                            hci_solution *s, hci_note *note)
{
    const bool has_voltage = b->line_V < HUGE_VAL;
    const size_t samples = samples_of(s, has_voltage ? top_of_voltage(m, o->effects) : 1.0);
    double *value = hci_memory_new(3 * samples, sizeof *value);
    hci_voltage_model voltage;
    hci_status status = value ? HCI_OK : hci_note_memory(note, NULL, "checking limits");
    s->peak_line_voltage_V = s->peak_open_voltage_V = s->peak_neutral_A = s->rms_neutral_A = NAN;
    for (size_t k = 0; k < s->limit_count; ++k) {
        s->limit[k].value = 0.0;
        s->limit[k].touch_count = 0;
    }
    if (!status) check_currents(s, samples, value);
    if (!status && m->has_neutral) check_neutral(s, samples);
    if (!status && has_voltage) status = hci_voltage_model_make(m, o, &voltage, note);
    if (!status && has_voltage) check_voltages(&voltage, b, s, samples, value);
    if (!status) judge(s);
    hci_memory_free(value);
    return status;
}

/* ---- the rated current ---- */

static bool is_limited(const hci_solution *s, hci_limit_kind kind)
{
    for (size_t k = 0; k < s->limit_count; ++k)
        if (s->limit[k].kind == kind) return true;
    return false;
}

void hci_limits_remark_rated(const hci_machine_data *m, hci_solution *s)
{
    const double rated_A = m->rated_current_A, heat_A = rated_A / sqrt(2.0), peak_A = s->peak_phase_current_A,
                 rms_A = s->rms_phase_current_A;
    const bool heats = rms_A > (1.0 + HOTTER) * heat_A && !is_limited(s, HCI_LIMIT_RMS),
               is_high = peak_A > (1.0 + HIGHER) * rated_A && !is_limited(s, HCI_LIMIT_CURRENT);
    if (heats)
        hci_note_add(
            &s->remark,
            "the rms current of a phase, %.4g A, is that of a sine of %.4g A: more heat than that of "
            "rated_current, %.4g A; --limit-rms %.4g holds the heat",
            rms_A, rms_A * sqrt(2.0), rated_A, heat_A);
    if (is_high)
        hci_note_add(
            &s->remark,
            "the peak, %.4g A, is above rated_current, %.4g A, which is the peak of a sine and no "
            "limit; where the drive gives no more, --limit-current %.4g or `max_current` in machine.csv",
            peak_A, rated_A, rated_A);
}

void hci_limits_remark_declared(const hci_machine_data *m, const hci_bounds *b, hci_solution *s)
{
    double most_A = 0.0;
    const double link_V = b->line_V < HUGE_VAL ? b->line_V / b->line_V_per_V : 0.0;
    for (int phase = 0; phase < 3; ++phase)
        if (b->current_A[phase] < HUGE_VAL) most_A = fmax(most_A, b->current_A[phase]);
    if (m->max_current_A > 0.0 && most_A > m->max_current_A)
        hci_note_add(&s->remark, "a limit of %.4g A was given, above max_current of machine.csv, %.4g A",
                     most_A, m->max_current_A);
    if (m->dc_link_voltage_V > 0.0 && link_V > (1.0 + 1e-9) * m->dc_link_voltage_V)
        hci_note_add(&s->remark, "a limit of %.4g V was given, above dc_link_voltage of machine.csv, %.4g V",
                     link_V, m->dc_link_voltage_V);
}

/* ---- an open phase ---- */

void hci_limits_remark_open(const hci_bounds *b, hci_solution *s)
{
    const double link_V = b->line_V / b->line_V_per_V;
    if (!(s->peak_open_voltage_V > link_V)) return;
    hci_note_add(
        &s->remark,
        "the open phase shows up to %.4g V against the others, more than the dc link of %.4g V: it has to "
        "be disconnected, since of a leg that is only switched off the diodes would conduct",
        s->peak_open_voltage_V, link_V);
}

/* ---- the same currents for less torque ---- */

/* Narrows the means low … high to those with |mean × slope + rest| <= limit. */
static void narrow(double slope, double rest, double limit, double *low, double *high)
{
    const double one = (limit - rest) / slope, other = (-limit - rest) / slope;
    if (slope == 0.0) return;
    *low = fmax(*low, fmin(one, other));
    *high = fmin(*high, fmax(one, other));
}

/* The same with the currents mean × per_Nm + constant of all phases at one angle; false where no current of
 * mean 0 keeps the limit. */
static bool narrow_at(const hci_bounds *b, const hci_solution *s, double theta_rad, double *low, double *high)
{
    double per_Nm[3], rest[3];
    bool is_kept = true;
    hci_waves_at(s->per_Nm, s->current.count, theta_rad, per_Nm);
    hci_waves_at(s->constant, s->current.count, theta_rad, rest);
    for (int phase = 0; phase < 3; ++phase) {
        is_kept = is_kept && fabs(rest[phase]) <= b->current_A[phase];
        narrow(per_Nm[phase], rest[phase], b->current_A[phase], low, high);
    }
    return is_kept;
}

static bool exceeds_current(const hci_solution *s)
{
    for (size_t k = 0; k < s->limit_count; ++k)
        if (s->limit[k].kind == HCI_LIMIT_CURRENT && s->limit[k].value > s->limit[k].limit) return true;
    return false;
}

void hci_limits_scale(const hci_bounds *b, double wanted_Nm, hci_solution *s)
{
    const size_t samples = samples_of(s, 1.0);
    double low = -HUGE_VAL, high = HUGE_VAL;
    s->torque_at_limit_Nm = NAN;
    if (!exceeds_current(s) || !s->per_Nm) return;
    for (size_t k = 0; k < samples; ++k)
        if (!narrow_at(b, s, 2.0 * HCI_PI * (double)(s->period_turns * k) / (double)samples, &low, &high))
            return;
    s->torque_at_limit_Nm = fmax(low, fmin(high, wanted_Nm));
}
