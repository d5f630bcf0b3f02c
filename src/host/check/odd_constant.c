#include "host/check/own_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/check/data/dead_torque.h"
#include "host/check/relations/relations.h"

/* i_q of the current, at least, where the torque is that of i_q. */
#define ALONG_Q 0.7

/* Times, by which recordings of one motor differ at most: magnets, sensors, iron; and those of another at
 * least. */
#define ALIKE   1.5
#define ANOTHER 2.5

/* Of the largest torque, that friction and the zero of a sensor do not make. */
#define NO_FRICTION 0.25

/* Of the largest torque, that a load has at least where another recording lets its current look like none. */
#define A_LOAD 0.1

static double largest_torque_Nm(const check_data *data)
{
    double most_Nm = 0.0;
    for (size_t k = 0; k < data->runs; ++k)
        if (hci_check_torque_is_measured(&data->run[k]))
            most_Nm = fmax(most_Nm, fabs(data->run[k].torque_mean));
    return most_Nm;
}

static bool is_load(const check_data *data, const check_run *r)
{
    const bool is_steady =
        (r->has_dq && r->dq_is_steady) || (r->has_abc && isfinite(r->current_order) && r->current_is_steady);
    return is_steady &&
           (hci_check_has_current(data, r) || fabs(r->torque_mean) > A_LOAD * largest_torque_Nm(data));
}

/* Torque for what the magnets make of the current, of a load; NAN: no load, or the angle does not let it be
 * told. */
static double ratio_of(const check_data *data, const check_run *r)
{
    const check_interpretation as = hci_check_as_declared();
    const check_model m = hci_check_model_of(data, &as);
    if (!hci_check_torque_is_measured(r) || !is_load(data, r)) return NAN;
    const check_vector i = hci_check_current_of(r, &as, &m);
    const double made_Nm = 1.5 * m.emf_Nm_per_A * i.im;
    return fabs(i.im) > ALONG_Q * hci_check_length(i) ? fabs(r->torque_mean / made_Nm) : (double)NAN;
}

/* Recordings whose ratio is on one side of a limit. */
typedef struct {
    const check_run *first;
    double least, most, most_Nm;
    size_t files;
} side;

static side side_of(const check_data *data, double limit, bool is_above)
{
    side x = {NULL, INFINITY, 0.0, 0.0, 0};
    const char *path = "";
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        const double ratio = ratio_of(data, r);
        if (!isfinite(ratio) || (ratio > limit) != is_above) continue;
        if (!x.first) x.first = r;
        x.least = fmin(x.least, ratio);
        x.most = fmax(x.most, ratio);
        x.most_Nm = fmax(x.most_Nm, fabs(r->torque_mean));
        x.files += strcmp(path, r->path) != 0;
        path = r->path;
    }
    return x;
}

/* Whether the sides are two constants: each in itself alike, and no friction between them. */
static bool are_two(const side *below, const side *above)
{
    if (!below->first || !above->first || strcmp(below->first->path, above->first->path) == 0) return false;
    const double largest_Nm = fmax(below->most_Nm, above->most_Nm),
                 off_Nm = below->most_Nm * (above->least / below->most - 1.0),
                 short_Nm = above->most_Nm * (1.0 - below->most / above->least);
    return below->most < ALIKE * below->least && above->most < ALIKE * above->least &&
           above->least > ANOTHER * below->most && fmax(off_Nm, short_Nm) > NO_FRICTION * largest_Nm;
}

/* "a.csv", "a.csv and 2 others" */
static void say_files(const side *x, char text[64])
{
    const char *name = hci_check_name_of(x->first->path);
    if (x->files == 1)
        snprintf(text, 64, "%.40s", name);
    else
        snprintf(text, 64, "%.32s and %u other%s", name, (unsigned)x->files - 1, x->files > 2 ? "s" : "");
}

static void say_two(const side *odd, const side *rest, hci_check_finding *f)
{
    char those[64], others[64], by[24];
    const double times = sqrt(odd->least * odd->most / (rest->least * rest->most));
    say_files(odd, those);
    say_files(rest, others);
    snprintf(by, sizeof by, times < 100.0 ? "%.2g" : "%.0f", fmin(times, 1e15));
    snprintf(f->words, sizeof f->words,
             "the torque for each ampere in %s is %s times that in %s: a log of another motor, or its "
             "torque or its currents are in another unit or range",
             those, by, others);
    snprintf(
        f->should_be, sizeof f->should_be,
        "of the same motor and in the same units; its own names stand in `columns` of its row of a list");
}

/* Those that differ are the fewer ones; of as many, those whose constant is further from the declared one. */
void hci_check_add_constant(const check_data *data, hci_check *check)
{
    for (size_t k = 0; k < data->runs; ++k) {
        const double limit = ALIKE * ratio_of(data, &data->run[k]);
        if (!isfinite(limit)) continue;
        const side below = side_of(data, limit, false), above = side_of(data, limit, true);
        if (!are_two(&below, &above)) continue;
        const bool is_below = below.files != above.files ? below.files < above.files
                                                         : fabs(log(below.most)) > fabs(log(above.least));
        const side *odd = is_below ? &below : &above, *rest = is_below ? &above : &below;
        hci_check_finding f = hci_check_finding_at("constant_differs", &odd->first->torque_cell,
                                                   "the torque for each ampere of each recording");
        say_two(odd, rest, &f);
        check->findings = 0; /* of one unit for all */
        hci_check_put_first(check, &f);
        return;
    }
}
