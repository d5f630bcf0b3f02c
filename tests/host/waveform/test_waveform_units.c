/* A recorded waveform in other units of current, torque and time has the same orders: nothing compares a
 * torque, a voltage or a time with a number of its own. */
#include "hci/host/waveform/waveform.h"

#include <string.h>

#include "support/other_units.h"
#include "support/reference.h"

enum { N = 3000, P = 3 };

static double time_s[N], theta_m[N], speed[N], current[3 * N], torque[N], voltage[3 * N];
static hci_run run;
static hci_waveform_options options;

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- what is recorded ---- */

static void start(hci_waveform_quantity quantity)
{
    memset(&run, 0, sizeof run);
    memset(current, 0, sizeof current);
    memset(torque, 0, sizeof torque);
    options = (hci_waveform_options){quantity, P, NULL, 0, 12.0, NAN};
    run.name = "run.csv";
    run.count = N;
    run.turn_known = true;
    run.torque_source = HCI_TORQUE_MEASURED;
    run.i_A = current;
}

/* A turn there and back at one speed. */
static void record_strokes(void)
{
    uint64_t seed = 5;
    start(HCI_WAVEFORM_COGGING);
    for (int k = 0; k < N; ++k) {
        const double within = 2.06 * REF_PI * (double)(k % (N / 2)) / (N / 2), sign = k < N / 2 ? 1.0 : -1.0;
        time_s[k] = 1e-3 * k;
        speed[k] = sign * 2.06 * REF_PI / (1e-3 * N / 2);
        theta_m[k] = sign > 0.0 ? within : 2.06 * REF_PI - within;
        torque[k] = 0.05 * sin(6.0 * P * theta_m[k] + 0.4) + 0.02 * sin(2.0 * P * theta_m[k]) - 0.03 * sign +
                    0.002 * ref_normal(&seed);
    }
    run.time_s = time_s, run.theta_m_rad = theta_m, run.speed_rad_per_s = speed, run.torque_Nm = torque;
}

/* The same held by a current. */
static void record_held(void)
{
    record_strokes();
    run.torque_source = HCI_TORQUE_HOLDING;
    options.torque_constant_Nm_per_A = 0.3;
    for (int k = 0; k < N; ++k) {
        for (int s = 0; s < 3; ++s)
            current[3 * k + s] = -torque[k] / 0.3 * sin(P * theta_m[k] - 2.0 * REF_PI * s / 3.0);
        torque[k] = 0.0;
    }
}

/* A back-EMF of orders 1, 5 and 7 with a channel that is off. */
static void record_emf(bool with_angle)
{
    uint64_t seed = 7;
    start(HCI_WAVEFORM_BACK_EMF);
    for (int k = 0; k < N; ++k) {
        time_s[k] = 1e-4 * k;
        speed[k] = 60.0;
        theta_m[k] = 0.3 + 60.0 * time_s[k];
        for (int s = 0; s < 3; ++s) {
            const double theta = P * theta_m[k] - 2.0 * REF_PI * s / 3.0;
            voltage[3 * k + s] =
                60.0 * (0.2 * sin(theta) + 0.01 * sin(5.0 * theta + 0.3) + 0.004 * sin(7.0 * theta)) +
                0.02 * ref_normal(&seed) + (s == 1 ? 0.1 : 0.0);
        }
    }
    run.v_V = voltage, run.time_s = time_s;
    if (with_angle) run.theta_m_rad = theta_m, run.speed_rad_per_s = speed;
}

static void record_turned(void)
{
    record_emf(true);
}

static void record_voltages_alone(void)
{
    record_emf(false);
}

static void (*const RECORDED[])(void) = {record_strokes, record_held, record_turned, record_voltages_alone};

/* ---- the same orders ---- */

static void record_in(size_t n, const units *u)
{
    RECORDED[n]();
    options.torque_constant_Nm_per_A *= u->torque / u->current;
    for (int k = 0; k < N; ++k) {
        time_s[k] /= u->speed;
        speed[k] *= u->speed;
        torque[k] *= u->torque;
        for (int s = 0; s < 3; ++s) {
            current[3 * k + s] *= u->current;
            voltage[3 * k + s] *= units_V(u);
        }
    }
}

static hci_waveform found_in(size_t n, const units *u)
{
    hci_waveform w;
    hci_note note = {{0}};
    record_in(n, u);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_waveform_find(&run, &options, &w, &note), note.text);
    return w;
}

static void same_orders(const hci_waveform *a, const hci_waveform *b, double by)
{
    TEST_ASSERT_EQUAL_UINT64(a->count, b->count);
    TEST_ASSERT_EQUAL_UINT64(a->kept, b->kept);
    TEST_ASSERT_TRUE(a->kept >= 2);
    for (size_t k = 0; k < a->count; ++k) {
        const hci_waveform_order *x = &a->order[k], *y = &b->order[k];
        TEST_ASSERT_EQUAL_DOUBLE(x->order, y->order);
        TEST_ASSERT_EQUAL_INT(x->kept, y->kept);
        units_same(x->amplitude, y->amplitude, by, 0.05, "amplitude");
        units_same(x->std_error, y->std_error, by, 0.0, "standard error");
        units_same(x->chance, y->chance, 1.0, 1e-3, "chance");
    }
    units_same(a->largest_left, b->largest_left, 1.0, 1.0, "largest that is left");
}

static void same_waveform(const hci_waveform *a, const hci_waveform *b, const units *u)
{
    same_orders(a, b, a->quantity == HCI_WAVEFORM_COGGING ? u->torque : u->torque / u->current);
    units_same(a->mean_Nm, b->mean_Nm, u->torque, 1e-3, "mean");
    units_same(a->friction_Nm, b->friction_Nm, u->torque, 0.0, "friction");
    units_same(a->friction_error_Nm, b->friction_error_Nm, u->torque, 0.0, "its error");
    units_same(a->frequency_Hz, b->frequency_Hz, u->speed, 0.0, "frequency");
    units_same(a->drift_Hz_per_s, b->drift_Hz_per_s, u->speed * u->speed, 100.0, "drift");
    units_same(a->speed_rad_per_s, b->speed_rad_per_s, u->speed, 0.0, "speed");
    units_same(a->zero_rad, b->zero_rad, 1.0, 1.0, "zero");
    for (int s = 0; s < 3 && a->quantity == HCI_WAVEFORM_BACK_EMF; ++s) {
        units_same(a->channel[s].offset_V, b->channel[s].offset_V, units_V(u), 1e-3, "offset");
        units_same(a->channel[s].offset_error_V, b->channel[s].offset_error_V, units_V(u), 0.0, "its error");
        units_same(a->channel[s].ratio, b->channel[s].ratio, 1.0, 0.0, "ratio");
        TEST_ASSERT_EQUAL_INT(a->channel[s].left_out, b->channel[s].left_out);
    }
}

static void test_a_waveform_has_no_units(void)
{
    const units *const others[] = {&SMALL, &LARGE, &COILS};
    units_share = 1e-6;
    for (size_t n = 0; n < sizeof RECORDED / sizeof *RECORDED; ++n) {
        hci_waveform plain = found_in(n, &PLAIN);
        for (size_t k = 0; k < sizeof others / sizeof *others; ++k) {
            snprintf(units_place, sizeof units_place, "recording %zu, units %zu", n, k);
            hci_waveform other = found_in(n, others[k]);
            same_waveform(&plain, &other, others[k]);
            hci_waveform_release(&other);
        }
        hci_waveform_release(&plain);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_waveform_has_no_units);
    return UNITY_END();
}
