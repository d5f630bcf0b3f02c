/* Limits, who stands out, the machine in common, trends: docs/theory.md, section 17. */
#include <math.h>
#include <string.h>

#include "hci/host/fleet/line.h"
#include "host/base/memory.h"
#include "host/fleet/pooled.h"
#include "host/fleet/trends.h"
#include "host/numeric/statistics.h"

#define ROBUST 1.4826 /* standard deviation of a normal distribution over its median distance */

/* ---- one parameter ---- */

/* The values that there are, without their order. */
static size_t gather(const hci_line *l, const double *from, size_t parameter, double *to)
{
    size_t count = 0;
    for (size_t k = 0; k < l->motors; ++k)
        if (!isnan(l->value[k * l->parameters + parameter]))
            to[count++] = from[k * l->parameters + parameter];
    return count;
}

static void describe(const hci_line *l, size_t parameter, double *work)
{
    hci_line_parameter *p = &l->parameter[parameter];
    p->motors = gather(l, l->value, parameter, work);
    p->median = p->scale = p->noise = p->low = p->high = NAN;
    if (p->motors == 0) return;
    p->median = hci_median(work, p->motors);
    for (size_t k = 0; k < p->motors; ++k)
        work[k] = fabs(work[k] - p->median);
    p->scale = ROBUST * hci_median(work, p->motors);
    gather(l, l->std_error, parameter, work);
    p->noise = hci_median(work, p->motors);
    p->low = p->median - l->limit * p->scale;
    p->high = p->median + l->limit * p->scale;
}

/* Parameters by which motors are compared. */
static size_t told(const hci_line *l)
{
    size_t count = 0;
    for (size_t k = 0; k < l->parameters; ++k) {
        size_t motors = 0;
        for (size_t j = 0; j < l->motors; ++j)
            motors += isnan(l->value[j * l->parameters + k]) ? 0 : 1;
        count += motors > 1 ? 1 : 0;
    }
    return count;
}

/* The spread that the motors have has the usual noise in it; one that was recorded worse, with so much more
 * noise, has more. */
static double deviation_of(const hci_line *l, size_t motor, size_t parameter, double own_noise)
{
    const hci_line_parameter *p = &l->parameter[parameter];
    const double s = own_noise * l->std_error[motor * l->parameters + parameter];
    const double more = fmax(s * s - p->noise * p->noise, 0.0);
    const double scale = sqrt(p->scale * p->scale + (isnan(more) ? 0.0 : more));
    const double off = l->value[motor * l->parameters + parameter] - p->median;
    if (isnan(off)) return NAN; /* not told, of this motor or of all */
    return scale > 0.0 ? off / scale : off == 0.0 ? 0.0 : off > 0.0 ? HUGE_VAL : -HUGE_VAL;
}

double hci_line_deviation(const hci_line *l, size_t motor, size_t parameter)
{
    return deviation_of(l, motor, parameter, 1.0);
}

/* ---- motors ---- */

#define OWN_ERRORS 3.0

static void take_worst(hci_line_motor *m, size_t parameter, double deviation)
{
    if (m->worst != HCI_LINE_NONE && fabs(deviation) <= fabs(m->deviation)) return;
    m->worst = parameter;
    m->deviation = deviation;
}

/* What stays unexplained, the last parameter, widens all standard errors. It is a fault that the parameters
 * describe in part where one of them is beyond its limit by the usual noise, and three of its own standard
 * errors off: that one names it. */
static void name_residual(const hci_line *l, hci_line_motor *m, size_t motor)
{
    const size_t last = l->parameters - 1;
    const double usual = l->parameter[last].median / l->value[motor * l->parameters + last];
    hci_line_motor named = {.worst = HCI_LINE_NONE};
    for (size_t k = 0; k < last; ++k) {
        const double deviation = deviation_of(l, motor, k, usual);
        if (isnan(deviation) || l->parameter[k].motors < 2) continue;
        if (fabs(deviation) > l->limit && fabs(hci_line_deviation(l, motor, k)) > OWN_ERRORS)
            take_worst(&named, k, deviation);
    }
    take_worst(m, last, hci_line_deviation(l, motor, last));
    if (named.worst == HCI_LINE_NONE) return;
    m->worst = named.worst;
    m->deviation = named.deviation;
}

static void judge(hci_line *l, size_t motor)
{
    hci_line_motor *m = &l->motor[motor];
    m->worst = HCI_LINE_NONE;
    m->leaves_more = false;
    for (size_t k = 0; k < l->parameters; ++k) {
        const double deviation = hci_line_deviation(l, motor, k);
        const bool is_residual = k + 1 == l->parameters;
        if (isnan(deviation) || l->parameter[k].motors < 2) continue;
        if (fabs(deviation) > l->limit) ++l->parameter[k].outside;
        if (is_residual && deviation > l->limit) {
            m->leaves_more = true;
            name_residual(l, m, motor);
        } else {
            take_worst(m, k, deviation);
        }
    }
    m->stands_out = m->worst != HCI_LINE_NONE && fabs(m->deviation) > l->limit;
}

size_t hci_line_outside(const hci_line *line)
{
    size_t count = 0;
    for (size_t k = 0; k < line->motors; ++k)
        count += line->motor[k].stands_out;
    return count;
}

/* ---- what they have in common ---- */

/* Of the motors that do not stand out. */
static size_t gather_sound(const hci_line *l, size_t parameter, hci_trend_point *point)
{
    size_t count = 0;
    for (size_t k = 0; k < l->motors; ++k) {
        const size_t at = k * l->parameters + parameter;
        if (isnan(l->value[at]) || l->motor[k].stands_out) continue;
        point[count++] =
            (hci_trend_point){l->value[at], l->std_error[at], l->motor[k].day, l->motor[k].batch};
    }
    return count;
}

static void pool(const hci_line *l, size_t parameter, hci_trend_point *point, double *work)
{
    hci_line_parameter *p = &l->parameter[parameter];
    const size_t count = gather_sound(l, parameter, point);
    double *value = work, *std_error = work + l->motors;
    p->mean = p->mean_std_error = p->between = NAN;
    p->per_day = p->per_day_std_error = p->batch_deviation = p->batch_criterion = NAN;
    if (count < 2) return;
    for (size_t k = 0; k < count; ++k) {
        value[k] = point[k].value;
        std_error[k] = point[k].std_error;
    }
    if (p->scale > 0.0) {
        const hci_pooled in_common = hci_pooled_find(value, std_error, count);
        p->mean = in_common.mean;
        p->mean_std_error = in_common.mean_std_error;
        p->between = in_common.between;
        hci_trend_find(point, count, p->between, &p->per_day, &p->per_day_std_error);
        const hci_trend_of_batches batches = hci_trend_batches(point, count);
        p->batch_deviation = batches.deviation;
        p->batch_criterion = batches.criterion;
        p->batch = batches.furthest;
        p->batch_beside = batches.beside;
        p->per_day_std_error *= batches.widening;
    }
    p->has_trend = fabs(p->per_day) > l->limit * p->per_day_std_error;
    p->has_batches = p->batch_criterion > l->limit;
}

/* ---- all of it ---- */

hci_status hci_line_conclude(double false_alarms, hci_line *line, hci_note *note)
{
    const double many = fmax((double)told(line), 1.0);
    double *work = hci_memory_new(2 * line->motors + 2, sizeof *work);
    hci_trend_point *point = hci_memory_new(line->motors + 1, sizeof *point);
    line->false_alarms = false_alarms;
    line->limit = hci_normal_limit(1.0 - pow(1.0 - false_alarms, 1.0 / many));
    for (size_t k = 0; k < line->parameters && work && point; ++k)
        describe(line, k, work);
    for (size_t k = 0; k < line->motors && work && point; ++k)
        judge(line, k);
    for (size_t k = 0; k < line->parameters && work && point; ++k)
        pool(line, k, point, work);
    const bool is_done = work && point;
    hci_memory_free(work);
    hci_memory_free(point);
    return is_done ? HCI_OK : hci_note_memory(note, NULL, "the parameters of a fleet");
}
