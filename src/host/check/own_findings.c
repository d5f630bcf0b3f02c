#include "host/check/own_findings.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/check/relations.h"

/* Of what is proved. */
#define PROVED 0.999

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static void put_first(hci_check *check, const hci_check_finding *finding)
{
    if (check->findings == HCI_CHECK_MOST_FINDINGS) --check->findings;
    memmove(&check->finding[1], &check->finding[0], check->findings * sizeof check->finding[0]);
    check->finding[0] = *finding;
    ++check->findings;
    check->probability_as_declared *= 1.0 - PROVED;
}

static hci_check_finding finding_at(const char *slip, const check_place *place, const char *told_by)
{
    hci_check_finding f = {
        .slip = slip, .line = place->line, .probability = PROVED, .is_no_effect = true, .told_by = told_by};
    snprintf(f.file, sizeof f.file, "%s", place->path);
    memcpy(f.column, place->column, sizeof f.column);
    memcpy(f.found, place->text, sizeof f.found);
    return f;
}

/* ---- a channel */

/* So near to −1 a gain is a sign. */
#define A_SIGN 0.2

static const char PHASE[] = "abc";

/* "; in 1 of 5 recordings": files with a current, of which some have it. */
static void say_share(const check_data *data, const check_run *odd, hci_check_finding *f)
{
    const size_t used = strlen(f->words);
    const char *path = "";
    size_t all = 0, alike = 0;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (strcmp(r->path, path) == 0 || !r->has_abc || !hci_check_has_current(data, r)) continue;
        path = r->path;
        ++all;
        alike += r->channel.state == odd->channel.state && r->channel.phase == odd->channel.phase;
    }
    if (alike < all)
        snprintf(f->words + used, sizeof f->words - used, "; in %zu of %zu recordings, such as %.40s", alike,
                 all, name_of(odd->path));
}

static void say_odd(const check_run *r, hci_check_finding *f)
{
    const int odd = r->channel.phase;
    const char a = PHASE[(odd + 1) % 3], b = PHASE[(odd + 2) % 3], x = PHASE[odd];
    if (r->channel.state == CHECK_CHANNEL_DEAD)
        snprintf(f->words, sizeof f->words,
                 "the current of phase %c reads nothing, where %c and %c do not sum to 0", x, a, b);
    else if (fabs(r->channel.gain + 1.0) < A_SIGN)
        snprintf(
            f->words, sizeof f->words,
            "the current of phase %c has the other sign than those of %c and %c: its clamp sits the other "
            "way round",
            x, a, b);
    else
        snprintf(
            f->words, sizeof f->words,
            "the current of phase %c reads %.3g times what those of %c and %c leave for it: the range or "
            "unit of its probe",
            x, r->channel.gain, a, b);
}

static void say_remedy(const check_run *r, hci_check_finding *f)
{
    const int odd = r->channel.phase;
    const char x = PHASE[odd];
    if (r->channel.state == CHECK_CHANNEL_DEAD)
        snprintf(f->should_be, sizeof f->should_be, "left out, as it is 0 less the two others");
    else if (fabs(r->channel.gain + 1.0) < A_SIGN)
        snprintf(f->should_be, sizeof f->should_be, "with the opposite sign: --column 'i%c=-%.60s'", x,
                 f->column);
    else
        snprintf(f->should_be, sizeof f->should_be, "divided by %.3g: --column 'i%c=%.60s/%.3g'",
                 r->channel.gain, x, f->column, r->channel.gain);
}

static void say_twins(const check_run *r, hci_check_finding *f)
{
    const int other = r->channel.phase;
    snprintf(
        f->words, sizeof f->words,
        "the currents of phases %c and %c are the same, so that one of the two columns is of another phase",
        PHASE[(other + 1) % 3], PHASE[(other + 2) % 3]);
    snprintf(f->should_be, sizeof f->should_be, "the current of its own phase");
}

static void add_channel(const check_data *data, hci_check *check)
{
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (r->channel.state == CHECK_CHANNELS_AGREE || !r->channel_cell.path ||
            !hci_check_has_current(data, r))
            continue;
        hci_check_finding f = finding_at("current_channel", &r->channel_cell,
                                         "the three currents of a machine without neutral, which sum to 0");
        if (r->channel.state == CHECK_CHANNELS_TWINS) {
            say_twins(r, &f);
            check->findings = 0; /* of currents that are not those of the machine */
        } else {
            say_odd(r, &f);
            say_remedy(r, &f);
        }
        say_share(data, r, &f);
        put_first(check, &f);
        return;
    }
}

/* ---- the zero of the angle */

/* A torque falls short of k_t |i| by the cosine of the angle of the current, beside so much of other causes.
 */
#define BESIDE 0.04

/* By torques alone: a salient machine is turned by up to 45 degrees for the most torque. */
#define SALIENT_rad (HCI_PI / 4.0)
#define VOLTAGE_rad 0.25

/* Of the largest current: in less, friction is much of the torque. */
#define LOADED 0.3

typedef struct {
    const check_run *run; /* NULL: none */
    double zero_rad, error_rad;
} run_zero;

typedef struct {
    const check_data *data;
    const check_interpretation *as;
    const check_model *model;
    double drag_Nm; /* of friction, which stands against the motion */
    double most_A, most_Nm_per_A;
} run_zeros;

static double way_of(const run_zeros *z, const check_run *r)
{
    const double speed = hci_check_or_zero(hci_check_speed_of(r, z->as, z->model));
    return (speed > 0.0) - (speed < 0.0);
}

/* By recordings without current, forward and back: the zero of the sensor is in both. */
static double drag_of(const run_zeros *z)
{
    double torque_Nm[2] = {0.0, 0.0}, count[2] = {0.0, 0.0};
    for (size_t k = 0; k < z->data->runs; ++k) {
        const check_run *r = &z->data->run[k];
        const double way = way_of(z, r);
        if (!r->has_torque || hci_check_has_current(z->data, r) || !(fabs(way) > 0.0)) continue;
        torque_Nm[way < 0.0] += r->torque_mean * z->as->torque;
        count[way < 0.0] += 1.0;
    }
    return count[0] * count[1] > 0.0 ? 0.5 * (torque_Nm[1] / count[1] - torque_Nm[0] / count[0]) : 0.0;
}

static double torque_per_ampere(const run_zeros *z, const check_run *r)
{
    const double i_A = hci_check_length(hci_check_current_of(r, z->as, z->model));
    const bool is_of_use = r->has_abc && r->has_torque && r->theta &&
                           hci_check_has_vector_current(z->data, r) && i_A > LOADED * z->most_A;
    return is_of_use ? (r->torque_mean * z->as->torque + way_of(z, r) * z->drag_Nm) / i_A : (double)NAN;
}

static bool by_voltage(const run_zeros *z, const check_run *r, run_zero *out)
{
    check_emf emf;
    if (!r->has_phase_voltage || !r->theta || !hci_check_has_emf(z->data, r, z->model)) return false;
    hci_check_emf_of(z->data, r, z->as, z->model, &emf);
    const check_vector turn = hci_check_product(emf.found, hci_check_conjugate(emf.expected));
    *out = (run_zero){r, atan2(turn.im, turn.re), VOLTAGE_rad + emf.unknown};
    return hci_check_length(turn) > 0.0;
}

/* The torque says how far from q the current flows at most, in the true frame: so far the angle in the
 * recorded one is that of the zero. */
static bool by_torque(const run_zeros *z, const check_run *r, run_zero *out)
{
    const double per_A = torque_per_ampere(z, r), share = fabs(per_A) / z->most_Nm_per_A - BESIDE;
    if (isnan(per_A)) return false;
    const check_vector i = hci_check_current_of(r, z->as, z->model), q = {0.0, per_A > 0.0 ? 1.0 : -1.0},
                       turn = hci_check_product(i, hci_check_conjugate(q));
    *out = (run_zero){r, atan2(turn.im, turn.re), 0.5 * SALIENT_rad + acos(fmax(0.0, share))};
    return share > 0.0;
}

static run_zero zero_of(const run_zeros *z, const check_run *r)
{
    run_zero zero = {NULL, 0.0, 0.0};
    const bool is_told = by_voltage(z, r, &zero) || by_torque(z, r, &zero);
    if (!is_told) zero.run = NULL;
    return zero;
}

static void scale_zeros(run_zeros *z)
{
    z->drag_Nm = drag_of(z);
    for (size_t k = 0; k < z->data->runs; ++k)
        z->most_A =
            fmax(z->most_A, hci_check_length(hci_check_current_of(&z->data->run[k], z->as, z->model)));
    for (size_t k = 0; k < z->data->runs; ++k) /* of NAN and a number the number */
        z->most_Nm_per_A = fmax(z->most_Nm_per_A, fabs(torque_per_ampere(z, &z->data->run[k])));
}

/* Half a turn is a sign as well, and a third the columns of other phases. */
static const char *instead(double degrees)
{
    return fabs(degrees - 180.0) < 20.0   ? ", or the sign of its currents or torque"
           : fabs(degrees - 120.0) < 20.0 ? ", or other phases in its columns"
                                          : "";
}

static void say_moved(const run_zero *a, const run_zero *b, hci_check *check)
{
    const double degrees = fabs(remainder(a->zero_rad - b->zero_rad, 2.0 * HCI_PI)) * 180.0 / HCI_PI;
    hci_check_finding f = finding_at("angle_zero_moved", &b->run->theta_cell,
                                     "voltages of the open machine in each recording, with its angle");
    snprintf(f.words, sizeof f.words,
             "the electrical zero of the angle in %.32s is some %.0f degrees from that in %.32s, as after a "
             "restart of the encoder%s",
             name_of(b->run->path), degrees, name_of(a->run->path), instead(degrees));
    snprintf(f.should_be, sizeof f.should_be, "an angle that is counted on through all recordings");
    put_first(check, &f);
}

static void add_moved(const check_posterior *p, hci_check *check)
{
    const check_interpretation as = hci_check_interpretation_of(p->data, &p->list[p->best]);
    const check_model model = hci_check_model_of(p->data, &as);
    run_zeros z = {p->data, &as, &model, 0.0, 0.0, 0.0};
    double most = 0.0;
    run_zero first = {NULL, 0.0, 0.0}, second = first;
    scale_zeros(&z);
    for (size_t k = 0; k < p->data->runs; ++k)
        for (size_t j = 0; j < k; ++j) {
            const run_zero a = zero_of(&z, &p->data->run[j]), b = zero_of(&z, &p->data->run[k]);
            if (!a.run || !b.run || strcmp(a.run->path, b.run->path) == 0) continue;
            const double beyond =
                fabs(remainder(a.zero_rad - b.zero_rad, 2.0 * HCI_PI)) - a.error_rad - b.error_rad;
            if (!(beyond > most)) continue;
            most = beyond;
            first = a, second = b;
        }
    if (!first.run) return;
    check->findings = 0; /* of one zero for all */
    say_moved(&first, &second, check);
}

void hci_check_own_findings(const check_posterior *p, hci_check *check)
{
    add_moved(p, check);
    add_channel(p->data, check);
}
