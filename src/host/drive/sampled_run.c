#include "host/drive/sampled_run.h"

#include <math.h>
#include <string.h>

#include "core/drive/table_code.h"

enum { MOST_SAMPLES = 20000, LEAST_SAMPLES = 100 };

/* Time constants until the start, which is the wanted current, is forgotten. */
static const double SETTLE = 3.0;

static bool has_effects(const hci_sampled_drive *d)
{
    return d->plant->effects && d->plant->effects->count > 0;
}

/* Of the plant to a sample: effects take most of the time. */
static unsigned steps_of(const hci_sampled_drive *d)
{
    return has_effects(d) ? 2 : 4;
}

typedef struct {
    hci_table_code code;
    hci_reference_code reference;
    hci_current_source source;
    hci_effects_plant context;
    hci_plant_effect effect;
    hci_drive drive;
    hci_drive_state state;
} run;

static void set_plant(const hci_sampled_drive *d, run *r)
{
    hci_plant *plant = &r->drive.plant;
    plant->table = d->plant->table;
    plant->resistance_ohm = d->plant->resistance_ohm;
    plant->inertia_kgm2 = HUGE_VAL;
    if (!has_effects(d)) return;
    r->context = (hci_effects_plant){&d->plant->machine, d->plant->effects, (double)NAN};
    r->effect = (hci_plant_effect){hci_effects_apply, &r->context};
    plant->effects = &r->effect;
    plant->effect_count = 1;
}

static void set_loop(const hci_drive_data *d, run *r)
{
    hci_current_pi *pi = &r->drive.control.current;
    pi->pi[0] = (hci_pi){d->kp_ohm, d->ki_ohm_per_s};
    pi->pi[1] = (hci_pi){d->kp_q_ohm, d->ki_q_ohm_per_s};
    pi->filter = hci_drive_filter_share(d);
    pi->decoupled = d->decoupling != HCI_DECOUPLING_NONE;
    pi->delay_steps =
        (unsigned)floor(d->computing_delay_s / d->sample_s * r->drive.control.current_every + 0.5);
    pi->modulation = d->modulation;
    r->drive.dead_time =
        (hci_dead_time){d->dc_link_voltage_V * hci_drive_dead_share(d), d->dead_time_crossing_A};
    if (d->dead_time_compensation > 0.5) pi->dead_time = r->drive.dead_time;
}

static void set_control(const hci_sampled_drive *d, run *r)
{
    hci_control *control = &r->drive.control;
    r->reference = (hci_reference_code){hci_table_code_at, &r->code};
    r->source.code = &r->reference;
    *control = (hci_control){.table = &d->known->table,
                             .step_s = d->drive->sample_s / steps_of(d),
                             .dc_link_V = d->drive->dc_link_voltage_V,
                             .torque_limit_Nm = HUGE_VAL,
                             .sources = &r->source,
                             .source_count = 1,
                             .current_every = steps_of(d),
                             .id_limit = HUGE_VAL,
                             .iq_limit = HUGE_VAL,
                             .peak_limit_A = HUGE_VAL,
                             .loop = HCI_CURRENT_PI};
    set_loop(d->drive, r);
}

static double torque_of(const hci_sampled_drive *d)
{
    return (double)d->loop->torque_low_Nm;
}

/* At angle 0, where d is −α and q is −β. */
static void start(const hci_sampled_drive *d, double speed_rad_per_s, run *r)
{
    const int p = d->plant->table.pole_pairs;
    memset(r, 0, sizeof *r);
    set_plant(d, r);
    set_control(d, r);
    r->code.pole_pairs = (uint32_t)p;
    hci_loop_start(&r->code.tables, d->loop, HCI_LOOP_FEEDFORWARD, d->memory);
    hci_loop_make(&r->code.tables, (float)speed_rad_per_s);
    const hci_loop_reference i =
        hci_loop_at(&r->code.tables, 0u, d->loop->torque_low_Nm, (float)speed_rad_per_s);
    r->state.plant.i[0] = -sqrt(1.5) * (double)i.id_A;
    r->state.plant.i[1] = -sqrt(1.5) * (double)i.iq_A;
    r->state.plant.speed_rad_per_s = speed_rad_per_s / p;
}

static size_t settling_samples(const hci_sampled_drive *d, double speed_rad_per_s)
{
    const hci_loop_model loop = hci_drive_loop(d->drive, d->known, speed_rad_per_s);
    const double *l = d->known->inductance_H;
    const double slow_s = fmax(fmax(l[0], l[1]) / d->known->resistance_ohm, hci_loop_slowest_s(&loop));
    return (size_t)fmin(SETTLE * slow_s / d->drive->sample_s + LEAST_SAMPLES, (double)MOST_SAMPLES);
}

/* Of two periods, of the table or where there are effects of the shaft, or more. */
static size_t seen_samples(const hci_sampled_drive *d, double speed_rad_per_s)
{
    const int turns = has_effects(d) ? d->plant->table.pole_pairs : (int)d->loop->period_turns;
    const double period = turns * 2.0 * HCI_PI / fabs(speed_rad_per_s) / d->drive->sample_s;
    return (size_t)fmin(fmax(2.0, ceil(LEAST_SAMPLES / period)) * period + 0.5, (double)MOST_SAMPLES);
}

hci_sampled_torque hci_sampled_run(const hci_sampled_drive *d, double speed_rad_per_s)
{
    run r;
    start(d, speed_rad_per_s, &r);
    const size_t before = settling_samples(d, speed_rad_per_s) * steps_of(d);
    const size_t seen = seen_samples(d, speed_rad_per_s) * steps_of(d);
    double sum = 0.0, least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t k = 0; k < before + seen; ++k) {
        hci_drive_step(&r.drive, &r.state, torque_of(d), 0.0);
        if (k < before) continue;
        sum += r.state.torque_Nm;
        least = fmin(least, r.state.torque_Nm);
        most = fmax(most, r.state.torque_Nm);
    }
    if (!isfinite(sum)) return (hci_sampled_torque){(double)NAN, (double)NAN};
    return (hci_sampled_torque){sum / (double)seen, most - least};
}
