/* Where a slip stands. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/check/convention_errors.h"

#define SQRT2 1.4142135623730951

/* The first recording with a cell of this kind. */
static const check_place *run_place(const check_figures *f, int where)
{
    for (size_t k = 0; k < f->runs; ++k) {
        const check_run *r = &f->run[k];
        const check_place *place = NULL;
        if (where == AT_THETA || where == (r->is_electrical ? AT_THETA_E : AT_THETA_M))
            place = &r->theta_cell;
        if (where == AT_CURRENT || (where == AT_ABC && r->has_abc) || (where == AT_DQ && r->has_dq))
            place = &r->current_cell;
        if (where == AT_DRIVE && r->has_dq && r->has_dq_voltage) place = &r->current_cell;
        if (where == AT_PHASES && r->theta_cell.path)
            place = r->has_abc ? &r->current_cell : r->has_phase_voltage ? &r->voltage_cell : NULL;
        if (where == AT_VOLTAGE || (where == AT_PHASE_VOLTAGE && r->has_phase_voltage))
            place = &r->voltage_cell;
        if (where == AT_TORQUE && r->has_torque) place = &r->torque_cell;
        if (where == AT_SPEED || (where == AT_SPEED_M && !r->speed_is_electrical)) place = &r->speed_cell;
        if (where == AT_TIME) place = &r->time_cell;
        if (place && place->path) return place;
    }
    return NULL;
}

static const check_place *place_of(const check_figures *f, int where)
{
    switch (where) {
    case AT_POLES:
        return &f->cell[CHECK_pole_pairs];
    case AT_EMF:
    case AT_EMF_SIGN:
        return &f->emf.amplitude_cell;
    case AT_EMF_ORDER:
        return &f->emf.order_cell;
    case AT_COGGING_ORDER:
        return &f->cogging.order_cell;
    case AT_PHASE:
        return f->emf.most_phase_rad >= f->cogging.most_phase_rad ? &f->emf.phase_cell
                                                                  : &f->cogging.phase_cell;
    case AT_EMF_PHASE:
    case AT_ZERO:
        return &f->emf.phase_cell;
    case AT_COGGING_PHASE:
        return &f->cogging.phase_cell;
    case AT_RATED_CURRENT:
        return &f->cell[CHECK_rated_current_A];
    case AT_RESISTANCE:
        return &f->cell[CHECK_resistance_ohm];
    case AT_SLOPE:
        return &f->inductance.cell;
    default:
        return run_place(f, where);
    }
}

static bool is_beyond(const check_table *t)
{
    return t->most_phase_rad > 2.0 * HCI_PI;
}

/* Poles are an even number; a motor with one pole pair has no electrical radians of its own; degrees show by
 * phases above 2π, and read as degrees all others would be near 0. */
bool hci_check_choice_applies(const check_choice *choice, const check_figures *f)
{
    const double p = f->value[CHECK_pole_pairs];
    const check_place *place = place_of(f, choice->where);
    if (!place || !place->path) return false;
    if (choice->where == AT_POLES) return fmod(p, 2.0) == 0.0;
    if (choice->where == AT_PHASE)
        return f->cogging.count > 0 && (is_beyond(&f->emf) || is_beyond(&f->cogging));
    if (choice->where == AT_EMF_PHASE) return is_beyond(&f->emf);
    if (choice->where == AT_COGGING_PHASE) return is_beyond(&f->cogging);
    if (choice->aspect == OF_THETA || choice->aspect == OF_EMF_ORDER || choice->aspect == OF_COGGING_ORDER ||
        choice->aspect == OF_SLOPE)
        return p > 1.0;
    return true;
}

/* The number that should stand at the place, NAN where there is none to tell. */
static double right_number(const check_choice *choice, const check_figures *f, const check_view *view)
{
    const check_view declared = hci_check_view_declared();
    const check_model as_read = hci_check_model_of(f, view), before = hci_check_model_of(f, &declared);
    const check_table *e = &f->emf, *c = &f->cogging;
    switch (choice->where) {
    case AT_POLES:
        return as_read.pole_pairs;
    case AT_EMF: {
        check_view poles = declared;
        poles.pole_pairs = view->pole_pairs;
        return e->amplitude[e->largest] * as_read.emf / hci_check_model_of(f, &poles).emf;
    }
    case AT_EMF_SIGN:
        return -e->amplitude[e->largest];
    case AT_EMF_ORDER:
        return e->order[e->largest] / as_read.pole_pairs;
    case AT_COGGING_ORDER:
        return c->order[c->largest] / as_read.pole_pairs;
    case AT_ZERO:
        return as_read.emf_phase_rad;
    case AT_RATED_CURRENT:
        return f->value[CHECK_rated_current_A] * SQRT2;
    case AT_RESISTANCE:
        return 0.5 * before.resistance_ohm;
    default:
        return NAN;
    }
}

/* Words around a number: "%s: every order divided by pole_pairs". */
static void fill(char out[HCI_CHECK_TEXT], const char *words, double number)
{
    const char *at = strstr(words, "%s");
    char text[32] = "";
    if (isfinite(number)) snprintf(text, sizeof text, "%.6g", number);
    if (!at)
        snprintf(out, HCI_CHECK_TEXT, "%s", words);
    else if (text[0] == '\0')
        snprintf(out, HCI_CHECK_TEXT, "%s", at[2] == ':' ? at + 4 : at + 2);
    else
        snprintf(out, HCI_CHECK_TEXT, "%.*s%s%s", (int)(at - words), words, text, at + 2);
}

void hci_check_choice_locate(const check_choice *choice, const check_figures *f, const check_view *view,
                             hci_check_finding *finding)
{
    const check_place *place = place_of(f, choice->where);
    finding->slip = choice->slip;
    finding->words = choice->words;
    finding->told_by = choice->told_by;
    snprintf(finding->file, sizeof finding->file, "%s", place->path);
    finding->line = place->line;
    memcpy(finding->column, place->column, sizeof finding->column);
    memcpy(finding->found, place->text, sizeof finding->found);
    fill(finding->should_be, choice->should_be, right_number(choice, f, view));
}
