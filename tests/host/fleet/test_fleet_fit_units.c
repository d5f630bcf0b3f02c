/* What is fitted to the recordings of a motor in other units of current, torque and time is the same in these
 * units. */
#define _XOPEN_SOURCE 700
#include "hci/host/fleet/fit.h"

#include "support/diagnosing.h"
#include "support/other_units.h"

static hci_fleet_fit fit;

void setUp(void)
{
}

void tearDown(void)
{
}

/* There and back at two loads: friction, a phase that makes more, a cogging torque that is declared and is
 * another one. */
static void record_motor(void)
{
    hci_note note = {{0}};
    hci_machine_release(&machine);
    files_write(files_path("cogging.csv"), "order,amplitude_Nm,phase_rad\n6,0.03,0.3\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
    for (int k = 0; k < 4; ++k) {
        const double way = k % 2 ? -1.0 : 1.0;
        record(900, &(point){way * (60.0 + 20.0 * k), k < 2 ? 9.0 : 3.0, 0.0, way * (0.05 + 0.01 * k), 0.0});
        for (size_t j = 0; j < 900; ++j) {
            const double theta = P * run[k].theta_m_rad[j];
            run[k].torque_Nm[j] +=
                0.1 * K_NM_PER_A * sin(theta) * run[k].i_A[3 * j] + 0.05 * sin(6.0 * theta + 0.2);
        }
    }
}

static void scale(const units *u)
{
    units_machine(&machine, u);
    for (size_t r = 0; r < runs.count; ++r)
        for (size_t k = 0; k < run[r].count; ++k) {
            run[r].time_s[k] /= u->speed;
            run[r].speed_rad_per_s[k] *= u->speed;
            run[r].torque_Nm[k] *= u->torque;
            for (int s = 0; s < 3; ++s)
                run[r].i_A[3 * k + (size_t)s] *= u->current;
        }
}

static double unit_of(const char *name, const units *u)
{
    if (strcmp(name, "Nm") == 0) return u->torque;
    if (strcmp(name, "Nms_per_rad") == 0 || strcmp(name, "Nm*s/rad") == 0) return u->torque / u->speed;
    if (strcmp(name, "Nm_per_A") == 0 || strcmp(name, "Nm/A") == 0) return u->torque / u->current;
    if (strcmp(name, "A") == 0) return u->current;
    return 1.0;
}

static hci_fleet_fit fit_in(const units *u)
{
    const hci_effects none = {NULL, 0};
    hci_note note = {{0}};
    dataset_start();
    record_motor();
    scale(u);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_fleet_fit_runs(&machine, &none, &runs, &fit, &note), note.text);
    dataset_end();
    return fit;
}

static void test_a_fit_has_no_units(void)
{
    const units *const others[] = {&SMALL, &LARGE, &COILS};
    const hci_fleet_fit plain = fit_in(&PLAIN);
    size_t told = 0;
    units_share = 1e-6;
    TEST_ASSERT_TRUE(plain.is_found);
    for (size_t n = 0; n < sizeof others / sizeof *others; ++n) {
        const hci_fleet_fit other = fit_in(others[n]);
        TEST_ASSERT_EQUAL_UINT64(plain.count, other.count);
        TEST_ASSERT_EQUAL_STRING(plain.remark.text, other.remark.text);
        units_same(plain.rms_before_Nm, other.rms_before_Nm, others[n]->torque, 0.0, "rms before");
        units_same(plain.rms_after_Nm, other.rms_after_Nm, others[n]->torque, 0.0, "rms after");
        for (size_t k = 0; k < plain.count; ++k) {
            const hci_fleet_parameter *x = &plain.parameter[k], *y = &other.parameter[k];
            const double by = unit_of(x->unit, others[n]);
            TEST_ASSERT_EQUAL_STRING(x->parameter, y->parameter);
            snprintf(units_place, sizeof units_place, "%.30s %.30s, units %zu", x->effect, x->parameter, n);
            units_same(x->value, y->value, by, 1e-3, x->unit);
            units_same(x->std_error, y->std_error, by, 0.0, x->unit);
            told += isfinite(x->value) != 0;
        }
    }
    TEST_ASSERT_TRUE(told >= 10);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_fit_has_no_units);
    return UNITY_END();
}
