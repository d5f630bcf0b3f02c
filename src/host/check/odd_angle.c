#include "host/check/own_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/check/relations/relations.h"

/* ---- the way it turns */

/* 1: the currents turn with the angle, -1: against it, 0: the recording does not tell. */
static int sequence_of(const check_data *data, const check_run *r)
{
    if (!r->has_abc || !r->theta || !hci_check_has_vector_current(data, r)) return 0;
    return (r->current_order > 0.0) - (r->current_order < 0.0);
}

/* Files whose currents turn so, the first of them, and a second one. */
typedef struct {
    const check_run *first, *second;
    size_t files;
} sequences;

static sequences sequences_of(const check_data *data, int way)
{
    sequences x = {NULL, NULL, 0};
    const char *path = "";
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (sequence_of(data, r) != way || strcmp(r->path, path) == 0) continue;
        path = r->path;
        if (!x.first)
            x.first = r;
        else if (!x.second)
            x.second = r;
        ++x.files;
    }
    return x;
}

/* "a.csv", "a.csv and b.csv", "a.csv and 3 others". */
static void say_files(const sequences *x, char text[80])
{
    if (x->files == 1)
        snprintf(text, 80, "%.32s", hci_check_name_of(x->first->path));
    else if (x->files == 2)
        snprintf(text, 80, "%.32s and %.32s", hci_check_name_of(x->first->path),
                 hci_check_name_of(x->second->path));
    else
        snprintf(text, 80, "%.32s and %zu others", hci_check_name_of(x->first->path), x->files - 1);
}

static void say_sequence(const sequences *odd, const sequences *rest, hci_check_finding *f)
{
    char those[80], others[80];
    const check_place *cell = odd->first->phase_cell;
    say_files(odd, those);
    say_files(rest, others);
    snprintf(f->words, sizeof f->words,
             "the currents of %.72s turn the other way than those of %.72s: two phases are swapped there, or "
             "the angle is backward",
             those, others);
    if (cell[1].path && cell[2].path)
        snprintf(f->should_be, sizeof f->should_be,
                 "b and c exchanged in that log alone: `ib=%.20s;ic=%.20s` as `columns` in its row of a list",
                 cell[2].column, cell[1].column);
    else
        snprintf(f->should_be, sizeof f->should_be, "two phases exchanged in that log alone");
}

/* Those that differ are the fewer ones; of as many, those that turn against the angle. */
void hci_check_add_sequence(const check_data *data, hci_check *check)
{
    const sequences with = sequences_of(data, 1), against = sequences_of(data, -1);
    if (with.files == 0 || against.files == 0) return;
    const sequences *odd = with.files < against.files ? &with : &against,
                    *rest = odd == &with ? &against : &with;
    hci_check_finding f = hci_check_finding_at("phases_differ", &odd->first->current_cell,
                                               "the currents of each recording, with its angle");
    say_sequence(odd, rest, &f);
    check->findings = 0; /* of one order of the phases for all */
    hci_check_put_first(check, &f);
}

/* ---- its unit */

/* Of a scale: a wave that is found at whole orders alone is that near. */
#define NEAR 0.02

/* What a column of an angle holds for an angle in radians of the rotor, and what its name then says. */
typedef struct {
    double times;
    const char *words, *unit;
} angle_unit;

/* Electrical turns for a recorded radian over those of the declared machine; NAN: not told. */
static double scale_of(const check_data *data, const check_run *r)
{
    const double expected = r->is_electrical ? 1.0 : data->value[CHECK_pole_pairs];
    return sequence_of(data, r) != 0 ? fabs(r->current_order) / expected : (double)NAN;
}

/* NULL: it is none of these. */
static const angle_unit *unit_of(double scale)
{
    static const angle_unit UNITS[] = {{180.0 / HCI_PI, "degrees", "_deg"}, {0.5 / HCI_PI, "turns", "_turn"}};
    for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS; ++k)
        if (fabs(scale * UNITS[k].times - 1.0) < NEAR) return &UNITS[k];
    return NULL;
}

/* The first recording with an angle in radians; NULL: none. */
static const check_run *run_in_radians(const check_data *data)
{
    for (size_t k = 0; k < data->runs; ++k)
        if (fabs(scale_of(data, &data->run[k]) - 1.0) < NEAR) return &data->run[k];
    return NULL;
}

static void say_scale(const check_run *odd, const check_run *rest, const angle_unit *unit,
                      hci_check_finding *f)
{
    snprintf(f->words, sizeof f->words,
             "the angle in %.40s counts %.3g times as far for a turn of the currents as that in %.40s: it is "
             "in %s there",
             hci_check_name_of(odd->path), unit->times, hci_check_name_of(rest->path), unit->words);
    snprintf(f->should_be, sizeof f->should_be, "%s%s in the header of that log alone",
             odd->is_electrical ? "theta_e" : "theta_m", unit->unit);
}

void hci_check_add_scale(const check_data *data, hci_check *check)
{
    const check_run *rest = run_in_radians(data);
    for (size_t k = 0; rest && k < data->runs; ++k) {
        const check_run *odd = &data->run[k];
        const angle_unit *unit = unit_of(scale_of(data, odd));
        if (!unit) continue;
        hci_check_finding f = hci_check_finding_at("angle_unit_differs", &odd->theta_cell,
                                                   "the currents of each recording, with its angle");
        say_scale(odd, rest, unit, &f);
        check->findings = 0; /* of one unit for all */
        hci_check_put_first(check, &f);
        return;
    }
}
