#include "host/recording/effort.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

/* A recording is cut into so many windows; each has so many samples at least. As few and long ones as follow
 * the motion: what a control answers to cogging torque late may be against the acceleration that it makes,
 * and is a mean of 0 in long windows. */
enum { FEW_WINDOWS = 32, MOST_WINDOWS = 512, LEAST_WINDOWS = 16, LEAST_SAMPLES = 4 };

/* Share of the mean square of the speed about its mean that windows have which follow the motion. */
#define FOLLOWED 0.5

/* Of the rms of the speed, that it varies by where a motion is more than what cogging torque leaves in it. */
#define MOVES 0.3

/* Standard errors beyond which a sign is told; those of a fit to samples that follow each other are rough. */
#define SURE 6.0

/* Of the rms of the current, a friction that stands out. */
#define STANDS_OUT 0.1

/* Of the rms of all samples: a shaft that its cogging torque slows down and hastens is longer where it is
 * slow, and so has a mean of the current that answers it, which turns round with the motion too. */
#define OF_ALL 0.05

/* Of windows in one direction that are the other: noise of a speed near 0. */
#define OTHER_WAY 0.05

/* A window in which the shaft goes one way has a mean sign of more, and a mean speed of more than this share
 * of the rms. In others it waits or turns round, and friction takes of the current what it has to: at rest
 * anything up to what it brakes with. */
#define DECIDED 0.9
#define GOES    0.1

enum { WAVES = 4 }; /* sine and cosine of once and twice a turn */

typedef struct {
    double time, speed, iq, sign; /* means over a window */
    double wave[WAVES];           /* likewise; 0 without an angle */
    bool is_told;                 /* what friction does in it: the shaft goes one way */
} window;

/* One row of the fit, about its mean where a constant is fitted too. */
typedef struct {
    double acceleration, sign, iq;
    double wave[WAVES];
} row;

static void add_waves(double theta_m_rad, double share, double wave[WAVES])
{
    for (int n = 1; n <= WAVES / 2; ++n) {
        wave[2 * n - 2] += share * sin(n * theta_m_rad);
        wave[2 * n - 1] += share * cos(n * theta_m_rad);
    }
}

static size_t cut(const hci_effort_samples *s, size_t wanted, window out[MOST_WINDOWS])
{
    const size_t most = s->count / LEAST_SAMPLES, count = most < wanted ? most : wanted;
    const double rms_speed = sqrt(hci_mean_square_about(s->speed, s->count, 0.0));
    for (size_t j = 0; j < count; ++j) {
        const size_t from = j * s->count / count, to = (j + 1) * s->count / count;
        const double share = 1.0 / (double)(to - from);
        out[j] = (window){0};
        for (size_t k = from; k < to; ++k) {
            out[j].time += share * s->time[k];
            out[j].speed += share * s->speed[k];
            out[j].iq += share * s->iq[k];
            out[j].sign += share * ((s->speed[k] > 0.0) - (s->speed[k] < 0.0));
            if (s->theta_m_rad) add_waves(s->theta_m_rad[k], share, out[j].wave);
        }
        out[j].is_told = fabs(out[j].sign) > DECIDED && fabs(out[j].speed) > GOES * rms_speed;
    }
    return count;
}

/* Windows between two others of which friction is told in all three. */
static size_t told_of(const window *w, size_t count)
{
    size_t told = 0;
    for (size_t j = 1; j + 1 < count; ++j)
        told += w[j - 1].is_told && w[j].is_told && w[j + 1].is_told;
    return told;
}

static double varies_by(const window *w, size_t count)
{
    double sum = 0.0, square = 0.0;
    for (size_t j = 0; j < count; ++j) {
        sum += w[j].speed / (double)count;
        square += w[j].speed * w[j].speed / (double)count;
    }
    return fmax(0.0, square - sum * sum);
}

/* Whether the shaft gets faster and slower while it goes one way, by more than cogging torque makes of it:
 * what is left of a steady way there and back, without where it turns round, does not accelerate. */
static bool moves_on_its_way(const window *w, size_t count)
{
    double sum = 0.0, square = 0.0, told = 0.0;
    for (size_t j = 0; j < count; ++j) {
        if (!w[j].is_told) continue;
        sum += fabs(w[j].speed);
        square += w[j].speed * w[j].speed;
        told += 1.0;
    }
    return told > 0.0 && square / told - sum * sum / (told * told) > MOVES * MOVES * square / told;
}

/* *follows: out, whether the windows tell how the speed changes; else they are few, and tell the rest. */
static size_t cut_to_motion(const hci_effort_samples *s, window out[MOST_WINDOWS], bool *follows)
{
    const double mean = hci_mean(s->speed, s->count), square = hci_mean_square_about(s->speed, s->count, 0.0),
                 varies = hci_mean_square_about(s->speed, s->count, mean);
    *follows = true;
    for (size_t wanted = FEW_WINDOWS; varies > MOVES * MOVES * square && wanted <= MOST_WINDOWS;
         wanted *= 2) {
        const size_t count = cut(s, wanted, out);
        const bool is_enough = told_of(out, count) >= LEAST_WINDOWS - 2;
        if (!is_enough || !(varies_by(out, count) > FOLLOWED * varies)) continue;
        if (moves_on_its_way(out, count)) return count;
    }
    *follows = false;
    return cut(s, FEW_WINDOWS, out);
}

/* Of three windows in a row: a slope over them, and means with the weights that it has. */
static size_t rows_of(const window *w, size_t count, row *out)
{
    size_t rows = 0;
    for (size_t j = 1; j + 1 < count; ++j) {
        const double span = w[j + 1].time - w[j - 1].time;
        if (!(span > 0.0 && w[j - 1].is_told && w[j].is_told && w[j + 1].is_told)) continue;
        out[rows] = (row){.acceleration = (w[j + 1].speed - w[j - 1].speed) / span,
                          .sign = 0.25 * w[j - 1].sign + 0.5 * w[j].sign + 0.25 * w[j + 1].sign,
                          .iq = 0.25 * w[j - 1].iq + 0.5 * w[j].iq + 0.25 * w[j + 1].iq};
        for (int n = 0; n < WAVES; ++n)
            out[rows].wave[n] = 0.25 * w[j - 1].wave[n] + 0.5 * w[j].wave[n] + 0.25 * w[j + 1].wave[n];
        ++rows;
    }
    return rows;
}

static bool turns_both_ways(const row *r, size_t rows)
{
    size_t back = 0;
    for (size_t j = 0; j < rows; ++j)
        back += r[j].sign < 0.0;
    return (double)back > OTHER_WAY * (double)rows && (double)(rows - back) > OTHER_WAY * (double)rows;
}

static row mean_of(const row *r, size_t rows)
{
    row mean = {0};
    for (size_t j = 0; j < rows; ++j) {
        mean.acceleration += r[j].acceleration / (double)rows;
        mean.sign += r[j].sign / (double)rows;
        mean.iq += r[j].iq / (double)rows;
    }
    return mean;
}

/* The normal equations of two unknowns: of the acceleration and of the sign. */
typedef struct {
    double aa, as, ss, ay, sy;
} equations;

static equations equations_of(const row *r, size_t rows)
{
    equations e = {0};
    for (size_t j = 0; j < rows; ++j) {
        e.aa += r[j].acceleration * r[j].acceleration;
        e.as += r[j].acceleration * r[j].sign;
        e.ss += r[j].sign * r[j].sign;
        e.ay += r[j].acceleration * r[j].iq;
        e.sy += r[j].sign * r[j].iq;
    }
    return e;
}

/* Variance of a row, raised by what it has in common with the one before it. */
static double variance_of(const row *r, size_t rows, size_t unknowns, double a, double c)
{
    double square = 0.0, beside = 0.0, before = 0.0;
    for (size_t j = 0; j < rows; ++j) {
        const double rest = r[j].iq - a * r[j].acceleration - c * r[j].sign;
        square += rest * rest;
        beside += rest * before;
        before = rest;
    }
    const double alike = square > 0.0 ? fmin(0.95, fmax(0.0, beside / square)) : 0.0;
    return square / (double)(rows - unknowns) * (1.0 + alike) / (1.0 - alike);
}

/* Of a fit without noise a sign is as sure as can be. */
static double in_errors(double value, double variance)
{
    return fmax(-1e6, fmin(1e6, value / sqrt(fmax(variance, 1e-12 * value * value))));
}

/* Of rows about what else they have; square: mean of i_q², of which c is a share. */
static hci_effort fit(const row *r, size_t rows, size_t unknowns, double square)
{
    hci_effort effort = {0};
    const equations e = equations_of(r, rows);
    const double det = e.aa * e.ss - e.as * e.as;
    if (!(square > 0.0) || !(e.ss > 0.0)) return effort;
    const bool has_slope = det > 1e-9 * e.aa * e.ss;
    const double a = has_slope ? (e.ss * e.ay - e.as * e.sy) / det : 0.0;
    const double c = (e.sy - e.as * a) / e.ss, variance = variance_of(r, rows, unknowns, a, c);
    if (has_slope && fabs(a) > 0.0) {
        effort.accelerating = in_errors(a, variance * e.ss / det);
        effort.slope = a;
    }
    if (fabs(c) > 0.0) effort.braking = in_errors(c, variance * (has_slope ? e.aa / det : 1.0 / e.ss));
    effort.share = fmax(-1.0, fmin(1.0, c / sqrt(square)));
    effort.of_all = c; /* for now */
    return effort;
}

static double square_of(const row *r, size_t rows)
{
    double square = 0.0;
    for (size_t j = 0; j < rows; ++j)
        square += r[j].iq * r[j].iq / (double)rows;
    return square;
}

/* Acceleration, friction, and a weight where the shaft turns both ways. */
static hci_effort fit_motion(row *r, size_t rows)
{
    const bool has_both_ways = turns_both_ways(r, rows);
    const double square = square_of(r, rows);
    const row mean = mean_of(r, rows);
    for (size_t j = 0; j < rows && has_both_ways; ++j)
        r[j].acceleration -= mean.acceleration, r[j].sign -= mean.sign, r[j].iq -= mean.iq;
    hci_effort effort = fit(r, rows, 3, square);
    effort.has_both_ways = has_both_ways;
    return effort;
}

/* Takes one column of the rows, whose squares sum to `square`, out of another. */
static void take_out(row *r, size_t rows, int column, double square)
{
    double acceleration = 0.0, sign = 0.0, iq = 0.0;
    for (size_t j = 0; j < rows; ++j) {
        acceleration += r[j].wave[column] * r[j].acceleration / square;
        sign += r[j].wave[column] * r[j].sign / square;
        iq += r[j].wave[column] * r[j].iq / square;
    }
    for (size_t j = 0; j < rows; ++j) {
        r[j].acceleration -= acceleration * r[j].wave[column];
        r[j].sign -= sign * r[j].wave[column];
        r[j].iq -= iq * r[j].wave[column];
    }
}

/* One wave at right angles to those before it, which are; out: the sum of its squares. */
static double make_square(row *r, size_t rows, int column)
{
    double mean = 0.0, square = 0.0;
    for (size_t j = 0; j < rows; ++j)
        mean += r[j].wave[column] / (double)rows;
    for (size_t j = 0; j < rows; ++j)
        r[j].wave[column] -= mean;
    for (int before = 0; before < column; ++before) {
        double along = 0.0, of = 0.0;
        for (size_t j = 0; j < rows; ++j)
            along += r[j].wave[before] * r[j].wave[column], of += r[j].wave[before] * r[j].wave[before];
        for (size_t j = 0; j < rows && of > 0.0; ++j)
            r[j].wave[column] -= along / of * r[j].wave[before];
    }
    for (size_t j = 0; j < rows; ++j)
        square += r[j].wave[column] * r[j].wave[column];
    return square;
}

#define LEAST_WAVE 1e-3 /* mean square of a wave that the way does not make of the others */

/* The friction beside what comes once or twice a turn; rows about their means. What accelerates a shaft then
 * may be the load, against the current. */
static hci_effort fit_beside_load(row *r, size_t rows)
{
    for (int n = 0; n < WAVES; ++n) {
        const double square = make_square(r, rows, n);
        if (square < LEAST_WAVE * (double)rows) return (hci_effort){0};
        take_out(r, rows, n, square);
    }
    hci_effort effort = fit(r, rows, 3 + WAVES, square_of(r, rows));
    effort.accelerating = 0.0;
    effort.has_both_ways = true;
    return effort;
}

/* Mean square of i_q that one wave of the turn has. */
static double square_of_wave(const hci_effort_samples *s, int column)
{
    double along = 0.0, of = 0.0;
    for (size_t k = 0; k < s->count; ++k) {
        double wave[WAVES] = {0.0};
        add_waves(s->theta_m_rad[k], 1.0, wave);
        along += wave[column] * s->iq[k];
        of += wave[column] * wave[column];
    }
    return of > 0.0 ? along * along / of / (double)s->count : 0.0;
}

/* beside_load: without what comes once or twice a turn. */
static hci_effort over_all(hci_effort effort, const hci_effort_samples *s, bool beside_load)
{
    double square = hci_mean_square_about(s->iq, s->count, 0.0);
    for (int n = 0; n < WAVES && beside_load; ++n)
        square -= square_of_wave(s, n);
    effort.of_all = square > 0.0 ? effort.of_all / sqrt(square) : 0.0;
    return effort;
}

hci_effort hci_effort_find(const hci_effort_samples *samples)
{
    window w[MOST_WINDOWS];
    row r[MOST_WINDOWS];
    bool follows = false;
    if (samples->count < LEAST_SAMPLES * LEAST_WINDOWS) return (hci_effort){0};
    const size_t count = cut_to_motion(samples, w, &follows), rows = rows_of(w, count, r);
    hci_effort effort = rows < LEAST_WINDOWS - 2 ? (hci_effort){0} : fit_motion(r, rows);
    if (!follows) effort.accelerating = 0.0;
    effort = over_all(effort, samples, false);
    if (hci_effort_way(&effort) != 0 || !effort.has_both_ways || !samples->theta_m_rad) return effort;
    const hci_effort beside = over_all(fit_beside_load(r, rows), samples, true);
    return hci_effort_way(&beside) != 0 ? beside : effort;
}

bool hci_effort_accelerates(const hci_effort *effort)
{
    return fabs(effort->accelerating) > SURE;
}

int hci_effort_way(const hci_effort *effort)
{
    if (hci_effort_accelerates(effort)) return effort->accelerating > 0.0 ? 1 : -1;
    if (fabs(effort->braking) > SURE && fabs(effort->share) > STANDS_OUT && fabs(effort->of_all) > OF_ALL)
        return effort->braking > 0.0 ? 1 : -1;
    return 0;
}

static bool has_phases(const hci_run *run)
{
    return run->has_sum || run->computed_phase > 0;
}

/* From i_q, of currents that are one. */
#define ALONG_IQ_RAD (HCI_PI / 9.0)

/* i_q of phase currents hangs on the zero of the angle: it is the drive's where that is right, or half a turn
 * off. */
static bool tells_iq(const hci_run *run)
{
    double angle_rad;
    if (run->i_A == NULL || run->theta_m_rad == NULL || run->speed_rad_per_s == NULL) return false;
    return !has_phases(run) || (hci_run_currents_in_line(run, &angle_rad) && fabs(angle_rad) < ALONG_IQ_RAD);
}

/* Where they lie on another line, the drive has another zero of the angle, unless it makes an i_d. */
static double off_iq(const hci_run *run)
{
    double angle_rad;
    if (!has_phases(run) || run->i_A == NULL || !hci_run_currents_in_line(run, &angle_rad)) return 0.0;
    return fabs(angle_rad) > ALONG_IQ_RAD ? angle_rad : 0.0;
}

/* A number of pole pairs that is not the motor's makes phase currents turn round in the rotor frame. */
static bool counts_pole_pairs(const hci_run *run)
{
    double angle_rad;
    return has_phases(run) && run->turn_known && !run->is_electrical && run->i_A != NULL &&
           hci_run_currents_in_line(run, &angle_rad);
}

/* work: twice the samples. */
static hci_effort effort_of(const hci_run *run, double *work)
{
    double *iq_A = work, *number = work + run->count;
    for (size_t k = 0; k < run->count; ++k) {
        iq_A[k] = hci_run_dq(run, run->pole_pairs, k).q;
        number[k] = (double)k;
    }
    return hci_effort_find(&(hci_effort_samples){run->time_s ? run->time_s : number, run->speed_rad_per_s,
                                                 iq_A, run->turn_known ? run->theta_m_rad : NULL,
                                                 run->count});
}

hci_status hci_run_effort_set(hci_run *run, hci_note *note)
{
    run->counts_pole_pairs = counts_pole_pairs(run);
    run->off_iq_rad = off_iq(run);
    if (!tells_iq(run)) return HCI_OK;
    double *work = hci_memory_new(run->count, 2 * sizeof *work);
    if (work == NULL) return hci_note_memory(note, run->name, "%zu samples", run->count);
    const hci_effort effort = effort_of(run, work);
    run->current_way = hci_effort_way(&effort);
    if (run->time_s && effort.accelerating > SURE) {
        run->iq_per_acceleration = effort.slope;
        run->iq_per_acceleration_error = effort.slope / effort.accelerating;
    }
    hci_memory_free(work);
    if (run->current_way < 0)
        hci_note_add(&run->remark,
                     "i_q works against the motion, as that of no motor does which turns by itself: %s, or "
                     "angle and speed together, have the opposite sign, or another machine turns the shaft",
                     has_phases(run) ? "the zero of the angle is half an electrical turn off, or the phase "
                                       "currents"
                                     : "i_q");
    return HCI_OK;
}
