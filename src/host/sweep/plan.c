/* In: what a grid is of; out: its points in their order. */
#include <math.h>

#include "hci/host/sweep/sweep.h"
#include "host/base/memory.h"

enum { MOST_STEPS = 40, MOST_POINTS = 1000000 };

#define LEAST_CURRENT 0.75 /* of the plain sine or of the peak without limits: square waves need 0.785 */
#define LEAST_COPPER  0.95 /* of the copper without limits or of the plain sine */
#define BEYOND        1.02 /* of what no ripple takes: where limits do not act any more */

/* ---- what a trade-off ranges over ---- */

hci_status hci_grid_span_find(const hci_grid_request *r, hci_grid_span *span, hci_note *note)
{
    hci_target_order mean = {{0.0, 0.0, r->torque_Nm.count ? r->torque_Nm.value[0] : 0.0}, 1.0};
    const hci_target target = {&mean, 1};
    hci_solve_options o = *r->options;
    hci_solution s;
    o.target = &target;
    o.progress = NULL;
    o.limits = (hci_solve_limits){.ignore_ratings = true};
    o.limit_current_A = o.limit_voltage_V = o.speed_rad_per_s = 0.0;
    o.minimise = HCI_MINIMISE_AUTO;
    const hci_status status = hci_solve(r->machine, &o, &s, note);
    if (status > HCI_NOT_REACHED) return status;
    *span = (hci_grid_span){s.plain_amplitude_A, s.peak_phase_current_A, s.loss_to_plain};
    hci_solution_release(&s);
    if (span->peak_A > 0.0 && span->plain_A > 0.0) return HCI_OK;
    if (span->peak_A > 0.0 && mean.torque_Nm.cosine > 0.0)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "a trade-off is beside the plain sine, and in this machine a sine makes no torque: its back-EMF "
            "has no fundamental; expected --map with --limit-current");
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "a trade-off is of the current that a torque takes, and this one takes none; expected a "
        "torque above 0 N·m");
}

/* ---- points ---- */

static hci_grid_point no_point(void)
{
    return (hci_grid_point){NAN, 0.0, NAN, NAN, NAN};
}

static hci_status reserve(hci_grid_plan *plan, size_t count, hci_note *note)
{
    if (count == 0 || count > MOST_POINTS)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "the grid has %zu points; expected 1 to %d", count,
                            (int)MOST_POINTS);
    plan->point = hci_memory_new(count, sizeof *plan->point);
    return plan->point ? HCI_OK : hci_note_memory(note, NULL, "the points of a grid");
}

/* The smallest of 1, 2, 5 times a power of ten that is not below `least`. */
static double round_step(double least)
{
    const double ten = pow(10.0, floor(log10(least))), share = least / ten;
    return ten * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
}

/* Appends a point for each value given, or for the multiples of a round step over a range. */
static void add_limits(hci_grid_plan *plan, const hci_grid_point *point, const hci_grid_axis *given,
                       const double range[2], bool is_copper)
{
    const double step = round_step((range[1] - range[0]) / MOST_STEPS), first = floor(range[0] / step);
    const size_t count = given->count ? given->count : (size_t)(ceil(range[1] / step) - first) + 1;
    for (size_t k = 0; k < count; ++k) {
        hci_grid_point *p = &plan->point[plan->count++];
        const double multiple = first + (double)k,
                     round = step < 1.0 ? multiple / floor(1.0 / step + 0.5) : multiple * step;
        *p = *point;
        *(is_copper ? &p->limit_copper : &p->limit_current_A) = given->count ? given->value[k] : round;
    }
}

static hci_status plan_trade_off(const hci_grid_request *r, const hci_grid_span *span, hci_grid_plan *plan,
                                 hci_note *note)
{
    const double current_A[2] = {LEAST_CURRENT * fmin(span->plain_A, span->peak_A), BEYOND * span->peak_A};
    const double copper[2] = {LEAST_COPPER * fmin(1.0, span->copper), BEYOND * span->copper};
    const size_t most = 2 * (MOST_STEPS + 3) + r->limit_current_A.count + r->limit_copper.count;
    hci_grid_point point = no_point();
    const hci_status status = reserve(plan, most, note);
    if (status) return status;
    point.torque_Nm = r->torque_Nm.value[0];
    if (r->speed_rad_per_s.count) point.speed_rad_per_s = r->speed_rad_per_s.value[0];
    add_limits(plan, &point, &r->limit_current_A, current_A, false);
    plan->by_current = plan->count;
    add_limits(plan, &point, &r->limit_copper, copper, true);
    return HCI_OK;
}

/* Torque runs fastest, then speed, then dc link; an axis without values has one that is not asked for. */
static hci_status plan_product(const hci_grid_request *r, hci_grid_plan *plan, hci_note *note)
{
    const bool is_map = r->kind == HCI_GRID_MAP;
    const size_t torques = is_map ? r->torque_Nm.count : 1, links = r->link_V.count ? r->link_V.count : 1;
    const double most = (double)torques * (double)r->speed_rad_per_s.count * (double)links;
    const hci_status status =
        reserve(plan, most <= MOST_POINTS ? (size_t)most : (size_t)MOST_POINTS + 1, note);
    if (status) return status;
    for (size_t l = 0; l < links; ++l)
        for (size_t w = 0; w < r->speed_rad_per_s.count; ++w)
            for (size_t t = 0; t < torques; ++t) {
                hci_grid_point *p = &plan->point[plan->count++];
                *p = no_point();
                p->speed_rad_per_s = r->speed_rad_per_s.value[w];
                if (is_map) p->torque_Nm = r->torque_Nm.value[t];
                if (r->link_V.count) p->link_V = r->link_V.value[l];
            }
    return HCI_OK;
}

static hci_status plan_given(const hci_grid_request *r, hci_grid_plan *plan, hci_note *note)
{
    const hci_status status = reserve(plan, r->point_count, note);
    for (size_t k = 0; k < r->point_count && !status; ++k)
        plan->point[plan->count++] = r->point[k];
    return status;
}

static hci_status check(const hci_grid_request *r, const hci_grid_span *span, hci_note *note)
{
    const char *wrong = NULL;
    if (r->kind == HCI_GRID_TRADE_OFF && (r->torque_Nm.count != 1 || r->speed_rad_per_s.count > 1 || !span))
        wrong = "a trade-off is of one torque, at one speed";
    else if (r->kind == HCI_GRID_ENVELOPE && r->speed_rad_per_s.count == 0)
        wrong = "an envelope is over the speed; give the speeds";
    else if (r->kind == HCI_GRID_ENVELOPE && r->options->limits.copper_ratio > 0.0)
        wrong = "an envelope looks for the torque, so copper over that of the plain sine of a torque is no "
                "limit of it; give the limit in W";
    else if (r->kind == HCI_GRID_MAP && !r->point && (!r->torque_Nm.count || !r->speed_rad_per_s.count))
        wrong = "a map is over torque and speed; give both";
    return wrong ? hci_note_set(note, HCI_ERROR_ARGUMENT, "%s", wrong) : HCI_OK;
}

hci_status hci_grid_plan_make(const hci_grid_request *request, const hci_grid_span *span, hci_grid_plan *plan,
                              hci_note *note)
{
    const hci_status status = check(request, span, note);
    *plan = (hci_grid_plan){0};
    if (status) return status;
    if (request->kind == HCI_GRID_TRADE_OFF) return plan_trade_off(request, span, plan, note);
    return request->point ? plan_given(request, plan, note) : plan_product(request, plan, note);
}

void hci_grid_plan_release(hci_grid_plan *plan)
{
    hci_memory_free(plan->point);
    *plan = (hci_grid_plan){0};
}
