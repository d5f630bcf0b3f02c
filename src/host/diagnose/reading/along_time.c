#include "host/diagnose/reading/along_time.h"

#include <math.h>
#include <string.h>

#include "host/diagnose/prepare/turns.h"

enum { LEAST_LEAD = 4 /* samples, that inputs between samples are told from */ };

unsigned hci_effect_traits(const hci_effect *effect, size_t term)
{
    return effect->type->parameter[effect->term[term].parameter].traits;
}

/* A lag or a resonance; a time constant of 0 is none. */
bool hci_has_dynamics(const hci_effects *effects)
{
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *e = &effects->effect[k];
        for (size_t j = 0; j < e->count; ++j)
            if ((hci_effect_traits(e, j) & HCI_PARAMETER_ALONG_TIME) && e->term[j].value != 0.0) return true;
    }
    return false;
}

/* Lags and resonances that there are. */
static size_t stages_in(const hci_effects *effects)
{
    size_t stages = 0;
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *e = &effects->effect[k];
        stages += e->type->lag && hci_effect_value(e, e->type->lag[0]) > 0.0;
        stages += e->type->resonance && hci_effect_value(e, e->type->resonance[0]) > 0.0;
    }
    return stages;
}

double hci_settling_s(const hci_effects *effects)
{
    double sum_s = 0.0;
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *e = &effects->effect[k];
        const double tau_s = e->type->lag ? hci_effect_value(e, e->type->lag[0]) : 0.0;
        const double omega =
            e->type->resonance ? 2.0 * HCI_PI * hci_effect_value(e, e->type->resonance[0]) : 0.0;
        const double damping = e->type->resonance ? hci_effect_value(e, e->type->resonance[1]) : 0.0;
        const double slow = damping > 1.0 ? damping - sqrt(damping * damping - 1.0) : damping;
        sum_s += HCI_SETTLED * tau_s;
        if (omega > 0.0) sum_s += slow > 0.0 ? HCI_SETTLED / (slow * omega) : (double)INFINITY;
    }
    return sum_s;
}

size_t hci_settling_samples(const hci_binned_sample *sample, const hci_segment *s, double settling_s)
{
    const size_t most = (HCI_SETTLING_TURNS - 1) * s->count;
    const double turns = s->period_s > 0.0 ? settling_s / s->period_s : 0.0;
    if (!(turns < HCI_SETTLING_TURNS - 1)) return most;
    const double last_s = sample[0].time_s + s->period_s - (settling_s - floor(turns) * s->period_s);
    size_t of_turn = s->count;
    while (of_turn > 0 && sample[of_turn - 1].time_s >= last_s)
        --of_turn;
    const size_t lead = (size_t)turns * s->count + (s->count - of_turn) + LEAST_LEAD;
    return lead < most ? lead : most;
}

/* Rows of a segment whose steps are taken in parts. */
size_t hci_rows_in(const hci_segment *s, size_t parts)
{
    return s->turns > 0 ? s->count * parts : (s->count - 1) * parts + 1;
}

/* Keeps every so many'th of rows from one on, which are those of the samples. */
void hci_samples_keep(hci_predicted_reading *o, size_t n, size_t first, size_t parts)
{
    for (size_t k = 0; k < n; ++k) {
        const size_t from = first + k * parts;
        o->torque_Nm[k] = o->torque_Nm[from];
        if (o->current_Nm) o->current_Nm[k] = o->current_Nm[from];
        if (o->by_value)
            memmove(o->by_value + k * o->terms, o->by_value + from * o->terms,
                    o->terms * sizeof *o->by_value);
    }
}

/* Writes the first turn n samples long again behind it. */
void hci_turn_repeat(hci_predicted_reading *o, size_t n, size_t turn, double period_s)
{
    memcpy(o->torque_Nm + turn * n, o->torque_Nm, n * sizeof *o->torque_Nm);
    if (o->current_Nm) memcpy(o->current_Nm + turn * n, o->current_Nm, n * sizeof *o->current_Nm);
    if (o->by_value)
        memcpy(o->by_value + turn * n * o->terms, o->by_value, n * o->terms * sizeof *o->by_value);
    for (size_t k = 0; k < n; ++k)
        o->time_s[turn * n + k] = o->time_s[k] + (double)turn * period_s;
}

/* Keeps n samples from one on: of the last turn, in which a sensor has settled, or of one between others. */
void hci_turn_keep(hci_predicted_reading *o, size_t n, size_t first)
{
    memmove(o->torque_Nm, o->torque_Nm + first, n * sizeof *o->torque_Nm);
    if (o->current_Nm) memmove(o->current_Nm, o->current_Nm + first, n * sizeof *o->current_Nm);
    if (o->by_value) memmove(o->by_value, o->by_value + first * o->terms, n * o->terms * sizeof *o->by_value);
}

/* Puts as many samples before a steady turn of n as those of the turns before it. */
static void turns_before(hci_predicted_reading *o, size_t n, size_t lead, double period_s)
{
    memmove(o->torque_Nm + lead, o->torque_Nm, n * sizeof *o->torque_Nm);
    memmove(o->time_s + lead, o->time_s, n * sizeof *o->time_s);
    if (o->by_value) memmove(o->by_value + lead * o->terms, o->by_value, n * o->terms * sizeof *o->by_value);
    for (size_t k = lead; k-- > 0;) {
        o->torque_Nm[k] = o->torque_Nm[k + n];
        o->time_s[k] = o->time_s[k + n] - period_s;
        if (o->by_value)
            memcpy(o->by_value + k * o->terms, o->by_value + (k + n) * o->terms,
                   o->terms * sizeof *o->by_value);
    }
}

/* Samples of the first period of a segment; 0 where it is shorter than that. */
static size_t first_period(const hci_binned_sample *sample, size_t count, double period_rad)
{
    for (size_t k = 1; k < count; ++k)
        if (fabs(sample[k].reading.theta_m_rad - sample[0].reading.theta_m_rad) >= period_rad) return k;
    return 0;
}

/* A sensor that swings has been swinging before a steady recording began: its first turn, or where it has
 * none its first electrical period, is run through before. Returns of how many samples that is. */
static size_t lead_in(const hci_regression *e, const hci_segment *s, size_t parts, hci_predicted_reading *o)
{
    const hci_binned_sample *sample = e->samples->sample + s->first;
    const size_t count = hci_rows_in(s, parts);
    const int p = e->machine->pole_pairs;
    double period_rad = hci_turn_rad(&e->runs[s->run], p);
    size_t lead = first_period(sample, s->count, period_rad);
    if (lead == 0) lead = first_period(sample, s->count, period_rad = 2.0 * HCI_PI / p);
    if (lead == 0) return 0;
    const double beyond = fabs(sample[lead].reading.theta_m_rad - sample[0].reading.theta_m_rad) - period_rad;
    const double step = fabs(sample[lead].reading.theta_m_rad - sample[lead - 1].reading.theta_m_rad);
    const double period_s = sample[lead].time_s -
                            beyond / step * (sample[lead].time_s - sample[lead - 1].time_s) -
                            sample[0].time_s;
    lead *= parts;
    hci_turn_repeat(o, count, 1, 0.0);
    memmove(o->torque_Nm + lead, o->torque_Nm + count, count * sizeof *o->torque_Nm);
    memmove(o->time_s + lead, o->time_s + count, count * sizeof *o->time_s);
    if (o->by_value)
        memmove(o->by_value + lead * o->terms, o->by_value + count * o->terms,
                count * o->terms * sizeof *o->by_value);
    for (size_t k = 0; k < lead; ++k)
        o->time_s[k] -= period_s;
    return lead;
}

/* Through the sensor's dynamics, of rows `parts` to a step. Returns how many rows are before the first. */
size_t hci_reading_along_time(const hci_regression *e, const hci_effects *effects, const hci_segment *s,
                              size_t parts, hci_predicted_reading *o)
{
    const size_t rows = hci_rows_in(s, parts);
    size_t lead = 0;
    if (s->turns > 0) {
        lead = parts * hci_settling_samples(e->samples->sample + s->first, s, hci_settling_s(effects));
        turns_before(o, rows, lead, s->period_s);
    } else
        lead = lead_in(e, s, parts, o);
    o->filtered = stages_in(effects) * (lead + rows) / parts; /* one between samples takes little */
    hci_effects_filter(effects, o->time_s, lead + rows, o->torque_Nm, o->by_value);
    return lead;
}
