#include "host/emit/table_ripple.h"

#include <math.h>

#include "host/emit/foreign_ripple.h"

/* Angles of a turn: primes, so that they meet all parts of all steps of a table. The torque of the plant is
 * smooth, that of the table is not. */
enum { FEW_ANGLES = 10007, MANY_ANGLES = 40009, PLANT_ANGLES = 2003, ANGLES_IN_STEP = 6 };

typedef struct {
    double low, high;
} range;

static const range EMPTY = {HUGE_VAL, -HUGE_VAL};

static void widen(range *r, double x)
{
    r->low = fmin(r->low, x);
    r->high = fmax(r->high, x);
}

/* A place in the mechanical turn: of the machine, and of the table. */
typedef struct {
    double theta_rad;
    uint32_t angle;
} place;

static place place_of(const hci_emission *e, double share)
{
    const double turns = share * hci_machine_plant_pole_pairs(e->plant);
    const double periods = turns / (double)e->tabulation.period_turns;
    return (place){2.0 * HCI_PI * turns, (uint32_t)((periods - floor(periods)) * 4294967296.0)};
}

static void to_phases(const hci_emission *e, double theta_rad, const double current[3], double abc[3])
{
    if (e->request->frame == HCI_TABLE_DQ)
        hci_machine_plant_phases(theta_rad, current, abc);
    else
        for (int s = 0; s < 3; ++s)
            abc[s] = current[s];
}

static double exact_torque(const hci_emission *e, place at, double torque_Nm, double slope[3])
{
    double current[3], abc[3];
    hci_tabulation_exact(&e->tabulation, at.angle, torque_Nm, current, NULL);
    to_phases(e, at.theta_rad, current, abc);
    return hci_machine_plant_torque_at(e->plant, at.theta_rad, abc, slope);
}

/* ---- what an error of the table makes ---- */

/* Σ |∂T/∂current| over the columns; of a star i_c follows from the other two. */
static double per_error(const hci_emission *e, place at)
{
    const bool dq = e->request->frame == HCI_TABLE_DQ;
    double slope[3], sum = 0.0;
    exact_torque(e, at, e->tabulation.torque_Nm, slope);
    for (size_t j = 0; j < e->tabulation.columns; ++j) {
        const double one[2] = {j == 0 ? 1.0 : 0.0, j == 1 ? 1.0 : 0.0};
        double abc[3] = {one[0], one[1], j == 2 ? 1.0 : 0.0};
        if (dq)
            hci_machine_plant_phases(at.theta_rad, one, abc);
        else if (e->tabulation.columns == 2)
            abc[2] = -1.0;
        sum += fabs(slope[0] * abc[0] + slope[1] * abc[1] + slope[2] * abc[2]);
    }
    return sum;
}

double hci_table_torque_per_error(const hci_emission *e)
{
    double most = 0.0;
    for (int k = 0; k < PLANT_ANGLES; ++k)
        most = fmax(most, per_error(e, place_of(e, (double)k / PLANT_ANGLES)));
    return most;
}

/* ---- the table as it is read ---- */

static void read_units(const hci_emission *e, uint32_t angle, double torque_Nm, double current[3])
{
    int16_t units[3];
    const double share = e->spline.parts == 2u ? torque_Nm / e->tabulation.torque_Nm : 0.0;
    hci_table_i16_currents_q15(&e->spline, angle, (int16_t)lround(32767.0 * share), units);
    for (int s = 0; s < 3; ++s)
        current[s] = units[s] * (double)e->spline.unit_A;
}

static void read_amperes(const hci_emission *e, uint32_t angle, double torque_Nm, double current[3])
{
    float value_A[3];
    if (hci_emit_has_rows(e->request->format))
        hci_table_f32_currents(&e->table, angle, (float)torque_Nm, value_A);
    else
        hci_table_i16_currents(&e->spline, angle, (float)torque_Nm, value_A);
    for (int s = 0; s < 3; ++s)
        current[s] = (double)value_A[s];
}

static double table_torque(const hci_emission *e, place at, double torque_Nm)
{
    double current[3], abc[3];
    if (hci_emit_is_integer(e->request->format))
        read_units(e, at.angle, torque_Nm, current);
    else
        read_amperes(e, at.angle, torque_Nm, current);
    to_phases(e, at.theta_rad, current, abc);
    return hci_machine_plant_torque_at(e->plant, at.theta_rad, abc, NULL);
}

/* ---- ripple ---- */

static int angles_of(const hci_emission *e)
{
    const double periods = hci_machine_plant_pole_pairs(e->plant) / (double)e->tabulation.period_turns;
    const double steps = (double)(e->result.chosen.points * (e->result.sectors > 0 ? e->result.sectors : 1));
    return ANGLES_IN_STEP * steps * fmax(1.0, periods) > FEW_ANGLES ? MANY_ANGLES : FEW_ANGLES;
}

static hci_table_ripple ripple_at(const hci_emission *e, double torque_Nm)
{
    const int angles = angles_of(e);
    range with = EMPTY, own = EMPTY;
    double sum = 0.0;
    for (int k = 0; k < angles; ++k) {
        const place at = place_of(e, (k + 0.5) / angles);
        const double exact = exact_torque(e, at, torque_Nm, NULL), read = table_torque(e, at, torque_Nm);
        widen(&with, read);
        widen(&own, read - exact);
        sum += exact;
    }
    const double mean_Nm = sum / angles;
    return (hci_table_ripple){mean_Nm, hci_emit_sine_ripple_Nm(e->plant, mean_Nm), with.high - with.low,
                              own.high - own.low};
}

void hci_table_ripples(hci_emission *e)
{
    const double torque_Nm[HCI_TABLE_RIPPLES] = {0.0, e->tabulation.torque_Nm, -e->tabulation.torque_Nm};
    hci_emit_result *x = &e->result;
    x->ripples = e->tabulation.parts == 2 ? HCI_TABLE_RIPPLES : 1;
    for (size_t k = 0; k < x->ripples; ++k)
        x->ripple[k] = ripple_at(e, torque_Nm[k]);
}
