/* How far a current loop of first order follows the currents of a solution. In: the currents and the machine;
 * out: the speed, for each Hz of the loop's bandwidth, up to which what it misses is a tenth of the
 * ripple of a plain sine. In the rotor frame a component (n, σ) turns with ν = (n − σ)ω, and flows
 * 1/(1 + jν/ω_b) times; the back-EMF of that order drives −ωE jν/((R + jνL)(ω_b + jν)) besides, by a PI loop
 * with k_p = ω_b L and k_i = ω_b R. Without a bandwidth R is left out, and both depend on x = ω/ω_b alone. */
#include "host/solution/loop_reach.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/solve/torque_spectrum.h"

#define SHARE      0.1  /* of the ripple of a plain sine */
#define NEAR       0.01 /* of the allowed torque, at which the search for x ends */
#define SMALLEST   1e-7 /* of the largest component, below which one is left out */
#define LEAST_X    1e-4
#define MOST_X     10.0 /* nothing of a harmonic flows any more */
#define MOST_STEPS 24

/* The currents of a solution as a loop makes them, but for the smallest. current, wave: of work, [current]
 * and [current + back-EMF]. */
typedef struct {
    const hci_task *task;
    const hci_solution *s;
    hci_wave *current;
    size_t currents;
    double per_H;  /* 1/(p L): of the back-EMF per mechanical speed; 0: not known */
    double corner; /* R/(L ω_b); 0: R or ω_b is not known */
    hci_wave *wave;
    size_t count;
} followed;

static double order_in_rotor(const hci_wave *w)
{
    return w->order - w->sequence;
}

/* A wave times a + jb. */
static hci_wave times(const hci_wave *w, double a, double b)
{
    return (hci_wave){w->order, w->sequence, a * w->sine - b * w->cosine, b * w->sine + a * w->cosine};
}

/* What flows of a current: (e^jt or 1)/(1 + jt). */
static hci_wave followed_of(const hci_wave *w, double t, bool has_lead)
{
    const double ahead = has_lead ? t : 0.0, share = 1.0 / (1.0 + t * t);
    return times(w, share * (cos(ahead) + t * sin(ahead)), share * (sin(ahead) - t * cos(ahead)));
}

/* What a back-EMF drives: -scale jt/((corner + jt)(1 + jt)). */
static hci_wave driven_of(const hci_wave *e, double t, double scale, double corner)
{
    const double a = corner - t * t, b = t * (1.0 + corner), share = -scale * t / (a * a + b * b);
    return times(e, share * b, share * a);
}

/* All that is found at angles alone has thousands of components, of which few are more than rounding. */
static void take_currents(const hci_currents *c, followed *f)
{
    double largest_A = 0.0;
    for (size_t k = 0; k < c->count; ++k)
        largest_A = fmax(largest_A, hci_amplitude(c->wave[k].sine, c->wave[k].cosine));
    for (size_t k = 0; k < c->count; ++k)
        if (hci_amplitude(c->wave[k].sine, c->wave[k].cosine) > SMALLEST * largest_A)
            f->current[f->currents++] = c->wave[k];
}

static bool is_harmonic(const hci_wave *w)
{
    return w->sequence != 0 && fabs(order_in_rotor(w)) > HCI_ORDER_TOLERANCE;
}

static void fill(followed *f, double x, bool has_lead)
{
    const hci_machine *m = f->task->machine;
    f->count = 0;
    for (size_t k = 0; k < f->currents; ++k)
        f->wave[f->count++] = followed_of(&f->current[k], order_in_rotor(&f->current[k]) * x, has_lead);
    for (size_t k = 0; k < m->back_emf_count && f->per_H > 0.0; ++k) {
        const hci_wave *e = &m->back_emf[k];
        if (is_harmonic(e))
            f->wave[f->count++] = driven_of(e, order_in_rotor(e) * x, x * f->per_H, f->corner);
    }
}

/* *missed_Nm: out, peak to peak of what the loop makes of the torque less what is asked for. */
static hci_status miss(followed *f, double x, bool has_lead, double *missed_Nm, hci_note *note)
{
    hci_torque_spectra torque;
    fill(f, x, has_lead);
    const hci_wave_view exact = {f->current, f->currents}, through = {f->wave, f->count};
    hci_status status = hci_torque_spectra_make(f->task, through, exact, &torque, note);
    for (size_t k = 0; k < torque.count && !status; ++k) {
        torque.first[k].sine -= torque.second[k].sine;
        torque.first[k].cosine -= torque.second[k].cosine;
    }
    const hci_harmonic_list missed = {torque.first, torque.count};
    if (!status) status = hci_torque_swing(&missed, f->s->period_turns, missed_Nm, note);
    hci_torque_spectra_release(&torque);
    return status;
}

/* The largest x at which no more is missed: by the slope of ln(missed) over ln(x). */
static hci_status reach(followed *f, bool has_lead, double allowed_Nm, double *x, hci_note *note)
{
    double missed_Nm = 0.0, before_Nm = 0.0, before_x = 0.0, slope = has_lead ? 2.0 : 1.0;
    hci_status status = HCI_OK;
    *x = LEAST_X;
    for (int step = 0; step < MOST_STEPS; ++step) {
        status = miss(f, *x, has_lead, &missed_Nm, note);
        if (status || (missed_Nm <= allowed_Nm && missed_Nm > (1.0 - 2.0 * NEAR) * allowed_Nm)) return status;
        if (*x >= MOST_X && missed_Nm <= allowed_Nm) break;
        if (before_Nm > 0.0 && fabs(*x - before_x) > 1e-9 * *x)
            slope = fmax(0.3, fmin(4.0, log(missed_Nm / before_Nm) / log(*x / before_x)));
        before_Nm = missed_Nm, before_x = *x;
        const double factor = missed_Nm > 0.0 ? pow((1.0 - NEAR) * allowed_Nm / missed_Nm, 1.0 / slope) : 1e3;
        *x = fmin(MOST_X, *x * fmax(1e-3, fmin(1e3, factor)));
    }
    *x = missed_Nm <= allowed_Nm ? (double)HUGE_VAL : 0.0;
    return HCI_OK;
}

/* ---- of a solution ---- */

static double mean_of(const hci_solution *s)
{
    return s->order_count > 0 && s->order[0].torque_Nm.order < HCI_ORDER_TOLERANCE
               ? fabs(s->order[0].torque_Nm.cosine)
               : 0.0;
}

/* NAN: of no mean. */
static double allowed_of(const hci_solution *s)
{
    return SHARE * 0.01 * fabs(s->T_ripple_before_percent) * mean_of(s);
}

/* What the machine declares of its winding. */
static void take_winding(const hci_machine_data *m, double bandwidth_Hz, followed *f)
{
    const double least_H = fmin(m->inductance_d_H, m->inductance_q_H);
    if (!(least_H > 0.0)) return;
    f->per_H = 1.0 / (m->model.pole_pairs * least_H);
    if (bandwidth_Hz > 0.0 && m->resistance_ohm > 0.0)
        f->corner = m->resistance_ohm / (least_H * 2.0 * HCI_PI * bandwidth_Hz);
}

static bool has_harmonics(const hci_machine *m)
{
    for (size_t k = 0; k < m->back_emf_count; ++k)
        if (is_harmonic(&m->back_emf[k])) return true;
    return false;
}

static hci_status find(followed *f, const hci_machine_data *m, hci_loop_reach *loop, hci_note *note)
{
    const double rpm_per_Hz = 60.0 / m->model.pole_pairs; /* of x */
    const double x = loop->bandwidth_Hz > 0.0 ? fabs(loop->speed_rpm) / loop->bandwidth_Hz / rpm_per_Hz : 0.0;
    hci_status status = reach(f, false, loop->allowed_Nm, &loop->rpm_per_Hz, note);
    if (!status) status = reach(f, true, loop->allowed_Nm, &loop->lead_rpm_per_Hz, note);
    if (!status && x > 0.0) status = miss(f, x, false, &loop->added_Nm, note);
    if (!status && x > 0.0) status = miss(f, x, true, &loop->lead_added_Nm, note);
    loop->rpm_per_Hz *= rpm_per_Hz;
    loop->lead_rpm_per_Hz *= rpm_per_Hz;
    return status;
}

hci_status hci_loop_reach_find(const hci_task *task, const hci_machine_data *machine,
                               const hci_solve_options *options, hci_solution *s, hci_note *note)
{
    hci_loop_reach *loop = &s->loop;
    *loop = (hci_loop_reach){options->loop_bandwidth_Hz, 0.0, NAN, NAN, NAN, NAN, NAN, false};
    if (!options->uncertainty && !(loop->bandwidth_Hz > 0.0)) return HCI_OK;
    if (loop->bandwidth_Hz > 0.0) loop->speed_rpm = options->speed_rad_per_s * 30.0 / HCI_PI;
    loop->allowed_Nm = allowed_of(s);
    if (!(loop->allowed_Nm > s->tolerance_Nm * SHARE) || s->current.count == 0) {
        loop->allowed_Nm = NAN;
        return HCI_OK;
    }
    followed f = {.task = task, .s = s};
    take_winding(machine, loop->bandwidth_Hz, &f);
    loop->leaves_out_back_emf = !(f.per_H > 0.0) && has_harmonics(task->machine);
    f.current = hci_memory_new(2 * s->current.count + task->machine->back_emf_count, sizeof *f.wave);
    if (!f.current) return hci_note_memory(note, NULL, "the currents as a loop makes them");
    f.wave = f.current + s->current.count;
    take_currents(&s->current, &f);
    const hci_status status = find(&f, machine, loop, note);
    hci_memory_free(f.current);
    if (!status && s->expected.state == HCI_RIPPLE_KNOWN && isfinite(loop->added_Nm))
        hci_expected_ripple_add_loop(&s->expected, loop->added_Nm, mean_of(s));
    return status;
}
