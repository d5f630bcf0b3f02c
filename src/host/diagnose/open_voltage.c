#include "host/diagnose/open_voltage.h"

#include <math.h>

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/prepare/run_statistics.h"

#define WELL_KNOWN 2e-3 /* standard error of a scale */

typedef struct {
    double off, rough, expected; /* Σ of squares: of the difference, of its steps, of speed × back-EMF */
} sums;

static bool is_open(const hci_run *run)
{
    bool open = run->v_V && run->theta_m_rad && run->speed_rad_per_s && run->i_A;
    for (size_t k = 0; open && k < 3 * run->count; ++k)
        open = !(fabs(run->i_A[k]) > 0.0);
    return open;
}

/* Voltage less speed × back-EMF of a sample, without its mean over the phases. Returns the square of the
 * latter. */
static double difference_at(const hci_machine *machine, const hci_run *run, size_t k, double off_V[3])
{
    double e[3], by_angle[3], square = 0.0, mean_V = 0.0, mean_e = 0.0;
    hci_torque_back_emf_at(machine, machine->pole_pairs * run->theta_m_rad[k], e, by_angle);
    for (size_t s = 0; s < 3; ++s) {
        mean_V += run->v_V[3 * k + s] / 3.0;
        mean_e += e[s] / 3.0;
    }
    for (size_t s = 0; s < 3; ++s) {
        const double expected_V = run->speed_rad_per_s[k] * (e[s] - mean_e);
        off_V[s] = run->v_V[3 * k + s] - mean_V - expected_V;
        square += expected_V * expected_V;
    }
    return square;
}

static void run_add(const hci_machine *machine, const hci_run *run, sums *sum)
{
    double before_V[3] = {0.0}, off_V[3];
    for (size_t k = 0; k < run->count; ++k) {
        sum->expected += difference_at(machine, run, k, off_V);
        for (size_t s = 0; s < 3; ++s) {
            const double step_V = k > 0 ? off_V[s] - before_V[s] : 0.0;
            sum->off += off_V[s] * off_V[s];
            sum->rough += 0.5 * step_V * step_V; /* of white noise: its square */
            before_V[s] = off_V[s];
        }
    }
}

static sums sums_of(const hci_machine *machine, const hci_runs *runs)
{
    sums sum = {0.0, 0.0, 0.0};
    for (size_t r = 0; r < runs->count; ++r)
        if (is_open(&runs->run[r])) run_add(machine, &runs->run[r], &sum);
    return sum;
}

static double share_of(const sums *sum)
{
    return sum->expected > 0.0 ? sqrt(fmax(0.0, sum->off - sum->rough) / sum->expected) : 0.0;
}

double hci_open_voltage_off(const hci_machine *machine, const hci_runs *runs)
{
    const sums sum = sums_of(machine, runs);
    return share_of(&sum);
}

bool hci_open_voltage_agrees(const hci_machine *machine, const hci_runs *runs)
{
    const sums sum = sums_of(machine, runs);
    return sum.expected > 0.0 && share_of(&sum) < HCI_OPEN_VOLTAGE_OFF;
}

/* ---- how large they are ---- */

bool hci_open_voltage_is_in(const hci_machine *machine, const hci_run *run)
{
    if (!run->v_V || !run->theta_m_rad || !run->speed_rad_per_s || !run->i_A) return false;
    return is_open(run) || hci_run_statistics_of(run, machine->pole_pairs).no_current;
}

typedef struct {
    double along, square, off, count; /* Σ of products and squares, and of the squares of the difference */
} scale_sums;

static void scale_add(const hci_machine *machine, const hci_run *run, scale_sums *sum)
{
    double off_V[3];
    for (size_t k = 0; k < run->count; ++k) {
        sum->square += difference_at(machine, run, k, off_V);
        for (size_t s = 0; s < 3; ++s) {
            const double expected_V =
                run->v_V[3 * k + s] - off_V[s]; /* and the mean, of which off_V has none */
            sum->along += off_V[s] * expected_V;
            sum->off += off_V[s] * off_V[s];
            sum->count += 1.0;
        }
    }
}

double hci_open_voltage_scale(const hci_machine *machine, const hci_runs *runs)
{
    scale_sums sum = {0.0, 0.0, 0.0, 0.0};
    for (size_t r = 0; r < runs->count; ++r)
        if (hci_open_voltage_is_in(machine, &runs->run[r])) scale_add(machine, &runs->run[r], &sum);
    const bool known = sum.square > 0.0 && sum.off < WELL_KNOWN * WELL_KNOWN * sum.square * sum.count;
    return known ? 1.0 + sum.along / sum.square : (double)NAN;
}

double hci_open_voltage_scale_fitted(const hci_machine *machine, const hci_runs *runs, double *std_error)
{
    scale_sums sum = {0.0, 0.0, 0.0, 0.0};
    *std_error = NAN;
    for (size_t r = 0; r < runs->count; ++r)
        if (runs->role[r] == HCI_ROLE_FIT && hci_open_voltage_is_in(machine, &runs->run[r]))
            scale_add(machine, &runs->run[r], &sum);
    if (!(sum.square > 0.0)) return NAN;
    const double beside = sum.along / sum.square;
    /* two of three phases are free: their mean is taken out */
    *std_error = sqrt(1.5 * fmax(0.0, sum.off - beside * sum.along) / sum.count / sum.square);
    return 1.0 + beside;
}
