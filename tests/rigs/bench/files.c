/* The files of a case: what the engineer has, and what only the rig knows. */
#define _POSIX_C_SOURCE 200809L

#include "rig.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>

enum { PATH = 2048 };

/* ---- truth.csv ---- */

static void add(rig_truth *out, int *n, rig_effect effect, const char *parameter, double value,
                const char *unit)
{
    if (fabs(value) <= 0.0 || *n >= RIG_TRUTHS) return;
    out[*n].effect = RIG_EFFECT_NAME[effect];
    snprintf(out[*n].parameter, sizeof out[*n].parameter, "%s", parameter);
    out[*n].value = value;
    out[*n].unit = unit;
    ++*n;
}

/* `prefix`sine_N and `prefix`cosine_N */
static void add_wave(rig_truth *out, int *n, rig_effect effect, const char *prefix, const rig_wave *w,
                     double order, const char *unit)
{
    char name[48];
    snprintf(name, sizeof name, "%ssine_%.9g", prefix, order);
    add(out, n, effect, name, w->sine, unit);
    snprintf(name, sizeof name, "%scosine_%.9g", prefix, order);
    add(out, n, effect, name, w->cosine, unit);
}

static void add_phases(rig_truth *out, int *n, rig_effect effect, const double value[3], const char *unit)
{
    static const char *const PHASE[] = {"a", "b", "c"};
    for (int s = 0; s < 3; ++s)
        add(out, n, effect, PHASE[s], value[s], unit);
}

static void add_coenergies(const rig_case *c, rig_truth *out, int *n)
{
    const rig_hidden *h = &c->hidden;
    add(out, n, RIG_RELUCTANCE, "dd_cosine_0", h->dd_cosine_0, "H");
    add(out, n, RIG_RELUCTANCE, "qq_cosine_6", h->qq_cosine_6, "H");
    add(out, n, RIG_SATURATION, "d1q2_cosine_0", h->d1q2_cosine_0, "Nm");
    add(out, n, RIG_SATURATION, "d0q3_sine_6", h->d0q3_sine_6, "Nm");
    add(out, n, RIG_SATURATION, "d3q0_cosine_0", h->d3q0_cosine_0, "Nm");
    if (fabs(h->d1q2_cosine_0) > 0.0)
        add(out, n, RIG_SATURATION, "reference_current", c->machine.rated_current_A, "A");
}

static void add_instruments(const rig_hidden *h, rig_truth *out, int *n)
{
    add_phases(out, n, RIG_CURRENT_OFFSET, h->current_offset_A, "A");
    add_phases(out, n, RIG_CURRENT_GAIN, h->current_gain, "1");
    add(out, n, RIG_POSITION_OFFSET, "angle", h->position_offset_rad, "rad");
    for (int k = 0; k < 2; ++k)
        add_wave(out, n, RIG_POSITION_ECCENTRICITY, "mech_", &h->eccentricity[k], h->eccentricity[k].order,
                 "rad");
    add(out, n, RIG_CHANNEL_DELAY, "current", h->current_delay_s, "s");
    add(out, n, RIG_CHANNEL_DELAY, "angle", h->angle_delay_s, "s");
    add(out, n, RIG_FRICTION, "coulomb", h->coulomb, "Nm");
    add(out, n, RIG_FRICTION, "viscous", h->viscous, "Nms_per_rad");
    add(out, n, RIG_FRICTION, "quadratic", h->quadratic, "Nms2_per_rad2");
    add(out, n, RIG_TORQUE_SENSOR, "time_constant", h->time_constant_s, "s");
    add(out, n, RIG_TORQUE_SENSOR, "natural_frequency", h->natural_frequency_Hz, "Hz");
    add(out, n, RIG_TORQUE_SENSOR, "damping", h->damping, "1");
    add(out, n, RIG_TORQUE_SENSOR, "offset", h->torque_offset_Nm, "Nm");
}

int rig_truths(const rig_case *c, rig_truth out[RIG_TRUTHS])
{
    const rig_hidden *h = &c->hidden;
    const double p = c->machine.pole_pairs;
    int n = 0;
    for (int k = 0; k < 2; ++k)
        add_wave(out, &n, RIG_COGGING, "", &h->cogging[k], h->cogging[k].order, "Nm");
    add_wave(out, &n, RIG_BACK_EMF, "", &h->emf[0], h->emf[0].order, "Nm_per_A");
    add_phases(out, &n, RIG_PHASE_IMBALANCE, h->imbalance, "1");
    add_coenergies(c, out, &n);
    add(out, &n, RIG_MAGNET_TEMPERATURE, "emf_per_kelvin", h->emf_per_kelvin, "1/K");
    add_instruments(h, out, &n);
    add_wave(out, &n, RIG_MECHANICAL_ORDER, "", &h->turn[0], h->turn[0].order / p, "Nm");
    add_wave(out, &n, RIG_MECHANICAL_ORDER, "iq_", &h->turn_iq[0], h->turn_iq[0].order / p, "Nm_per_A");
    return n;
}

static bool write_truth(const rig_case *c, FILE *f, double noise_Nm)
{
    rig_truth truth[RIG_TRUTHS];
    const int n = rig_truths(c, truth);
    fputs("effect,parameter,value,unit\n", f);
    for (int k = 0; k < n; ++k)
        fprintf(f, "%s,%s,%.9g,%s\n", truth[k].effect, truth[k].parameter, truth[k].value, truth[k].unit);
    if (c->invented.kind != RIG_KNOWN)
        fprintf(f, "%s,amplitude,%.9g,Nm\n", RIG_INVENTION_NAME[c->invented.kind], c->invented.amplitude_Nm);
    fprintf(f, "noise,rms,%.9g,Nm\n", noise_Nm);
    return !ferror(f);
}

/* ---- machine/ ---- */

static void write_machine(const rig_machine *m, FILE *f)
{
    fprintf(f, "name,value,unit,source\npole_pairs,%d,1,data sheet\nconnection,star,,data sheet\n",
            m->pole_pairs);
    fprintf(f, "rated_current,%.9g,A,data sheet\n", m->rated_current_A);
    fprintf(f, "rated_torque,%.9g,Nm,data sheet\n", m->rated_torque_Nm);
    fprintf(f, "rated_speed,%.9g,rpm,data sheet\n", m->rated_speed_rad_per_s * 30.0 / RIG_PI);
    fprintf(f, "inductance_d,%.9g,H,measured\ninductance_q,%.9g,H,measured\n", m->ld_H, m->lq_H);
    if (m->emf_frequency_Hz > 0.0) fprintf(f, "emf_frequency,%.9g,Hz,measured\n", m->emf_frequency_Hz);
}

static void write_waves(const rig_wave *w, int count, double factor, FILE *f)
{
    for (int k = 0; k < count; ++k)
        fprintf(f, "%.9g,%.9g,%.9g\n", w[k].order, factor * hypot(w[k].sine, w[k].cosine),
                atan2(w[k].cosine, w[k].sine));
}

static void write_emf(const rig_machine *m, FILE *f)
{
    const bool volts = m->emf_frequency_Hz > 0.0;
    const double factor = volts ? 2.0 * RIG_PI * m->emf_frequency_Hz / m->pole_pairs : 1.0;
    fprintf(f, "order,amplitude_%s,phase_rad\n", volts ? "V" : "Nm_per_A");
    write_waves(m->emf, m->emf_count, factor, f);
}

static void write_cogging(const rig_machine *m, FILE *f)
{
    fputs("order,amplitude_Nm,phase_rad\n", f);
    write_waves(m->cogging, m->cogging_count, 1.0, f);
}

static void write_inductances(const rig_machine *m, FILE *f)
{
    enum { ROWS = 90 };
    fputs("theta_e_rad,La_H,Lb_H,Lc_H,Mab_H,Mbc_H,Mca_H\n", f);
    for (int k = 0; k < ROWS; ++k) {
        const double theta_e_rad = 2.0 * RIG_PI * k / ROWS;
        double l[6];
        rig_inductances(m, theta_e_rad, l);
        fprintf(f, "%.12g", theta_e_rad);
        for (int j = 0; j < 6; ++j)
            fprintf(f, ",%.12g", l[j]);
        fputc('\n', f);
    }
}

/* ---- runs/ ---- */

/* Wrapped into 0 … 2π, or not, in the form's angle and unit. */
static double angle_in_form(const rig_case *c, double theta_m_rad)
{
    const double turn = 2.0 * RIG_PI;
    double angle = theta_m_rad * (c->form.electrical ? c->machine.pole_pairs : 1);
    if (c->form.wrapped) angle -= turn * floor(angle / turn + 1e-12);
    return c->form.degrees ? angle * 180.0 / RIG_PI : angle;
}

static void write_header(const rig_case *c, const rig_run *run, char separator, FILE *f)
{
    const rig_form *o = &c->form;
    fprintf(f, "time_s%ctheta_%c_%s", separator, o->electrical ? 'e' : 'm', o->degrees ? "deg" : "rad");
    if (o->speed) fprintf(f, "%cspeed_%s", separator, o->rpm ? "rpm" : "rad_per_s");
    if (o->dq)
        fprintf(f, "%cid_A%ciq_A", separator, separator);
    else
        fprintf(f, "%cia_A%cib_A%cic_A", separator, separator, separator);
    fprintf(f, "%ctorque_Nm", separator);
    if (run->has_temperature) fprintf(f, "%ctemperature_C", separator);
    fputc('\n', f);
}

static void write_number(double value, int digits, const char *before, bool comma, FILE *f)
{
    char text[40];
    snprintf(text, sizeof text, "%.*g", digits, value);
    for (char *at = text; comma && *at; ++at)
        if (*at == '.') *at = ',';
    fprintf(f, "%s%s", before, text);
}

static void write_reading(const rig_case *c, const rig_run *run, const rig_reading *x, FILE *f)
{
    const rig_form *o = &c->form;
    const char *separator = o->semicolon ? ";" : ",";
    double i_A[3] = {x->i_A[0], x->i_A[1], x->i_A[2]};
    if (o->dq) rig_dq_of(c->machine.pole_pairs * x->theta_m_rad, x->i_A, &i_A[0], &i_A[1]);
    write_number(x->time_s, 10, "", o->semicolon, f);
    write_number(angle_in_form(c, x->theta_m_rad), 11, separator, o->semicolon, f);
    if (o->speed)
        write_number(x->omega_rad_per_s * (o->rpm ? 30.0 / RIG_PI : 1.0), 7, separator, o->semicolon, f);
    for (int k = 0; k < (o->dq ? 2 : 3); ++k)
        write_number(i_A[k], 7, separator, o->semicolon, f);
    write_number(x->torque_Nm, 7, separator, o->semicolon, f);
    if (run->has_temperature) write_number(x->temperature_C, 5, separator, o->semicolon, f);
    fputc('\n', f);
}

/* ---- the folder ---- */

static FILE *opened(const char *folder, const char *name)
{
    char path[PATH];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    if (!f) fprintf(stderr, "rig: %s: %s\n", path, strerror(errno));
    return f;
}

static bool closed(FILE *f)
{
    const bool good = !ferror(f);
    return fclose(f) == 0 && good;
}

/* name: "" for the folder itself. */
static bool made(const char *folder, const char *name)
{
    char path[PATH];
    snprintf(path, sizeof path, "%s%s%s", folder, *name ? "/" : "", name);
    if (mkdir(path, 0777) == 0 || errno == EEXIST) return true;
    fprintf(stderr, "rig: %s: %s\n", path, strerror(errno));
    return false;
}

static bool write_table(const char *folder, const char *name, const rig_machine *m,
                        void (*write)(const rig_machine *, FILE *))
{
    FILE *f = opened(folder, name);
    if (!f) return false;
    write(m, f);
    return closed(f);
}

static bool write_machine_folder(const rig_machine *m, const char *folder)
{
    return write_table(folder, "machine/machine.csv", m, write_machine) &&
           write_table(folder, "machine/back_emf.csv", m, write_emf) &&
           write_table(folder, "machine/cogging.csv", m, write_cogging) &&
           (!m->salient || write_table(folder, "machine/inductance.csv", m, write_inductances));
}

/* Adds the mean square of the noise to *square. */
static bool write_run(const rig_case *c, int k, const char *folder, double *square)
{
    const rig_run *run = &c->run[k];
    char name[32];
    snprintf(name, sizeof name, "runs/%02d.csv", k + 1);
    rig_reading *reading = malloc((size_t)run->samples * sizeof *reading);
    FILE *f = reading ? opened(folder, name) : NULL;
    if (f) {
        const int count = rig_run_read(c, run, reading);
        write_header(c, run, c->form.semicolon ? ';' : ',', f);
        for (int j = 0; j < count; ++j) {
            write_reading(c, run, &reading[j], f);
            *square += reading[j].noise_Nm * reading[j].noise_Nm / count;
        }
    }
    free(reading);
    return f && closed(f);
}

static bool write_list(const rig_case *c, const char *folder)
{
    FILE *f = opened(folder, "runs.csv");
    if (!f) return false;
    fputs("file,role\n", f);
    for (int k = 0; k < c->run_count; ++k)
        fprintf(f, "runs/%02d.csv,%s\n", k + 1, c->run[k].holdout ? "holdout" : "fit");
    return closed(f);
}

bool rig_case_write(const rig_case *c, const char *folder)
{
    double square = 0.0;
    int holdouts = 0;
    bool good = made(folder, "") && made(folder, "machine") && made(folder, "runs") &&
                write_machine_folder(&c->machine, folder) && write_list(c, folder);
    for (int k = 0; k < c->run_count && good; ++k) {
        double of_run = 0.0;
        good = write_run(c, k, folder, &of_run);
        if (c->run[k].holdout) square += of_run, ++holdouts;
    }
    FILE *f = good ? opened(folder, "truth.csv") : NULL;
    return f && write_truth(c, f, sqrt(square / holdouts)) && closed(f);
}
