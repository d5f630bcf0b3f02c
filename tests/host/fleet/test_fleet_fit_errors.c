/* The fit of what motors have in common beside least squares that are written here: of recordings with hardly
 * a current the torque is linear in friction, the zeros of the sensors and the constant of the torque sensor.
 */
#define _XOPEN_SOURCE 700
#include "hci/host/fleet/fit.h"

#include "support/diagnosing.h"

/* Columns: friction, drag by the speed, zeros of i_a and i_b, zero of the torque sensor. TERMS: all that are
 * asked for, which count as used up. */
enum {
    ROWS = 60,
    RUNS = 4,
    ALL = ROWS * RUNS,
    COULOMB = 0,
    VISCOUS,
    ZERO_A,
    ZERO_B,
    OFFSET,
    COLUMNS,
    TERMS = 15
};

static const char *const EFFECT[] = {"friction", "friction", "current_offset", "current_offset",
                                     "torque_sensor"},
                         *const PARAMETER[] = {"coulomb", "viscous", "a", "b", "offset"};

static const double CURRENT_A = 0.003;
static hci_fleet_fit fit;
static double x[ALL][COLUMNS], inverse[COLUMNS][COLUMNS], residual[ALL];

void setUp(void)
{
    dataset_start();
    memset(&fit, 0, sizeof fit);
}

void tearDown(void)
{
    dataset_end();
}

/* ---- recordings ---- */

/* Both ways at two speeds, angles that repeat nowhere. */
static void columns_fill(double slow, double fast)
{
    for (size_t r = 0; r < RUNS; ++r) {
        const double sign = r % 2 ? -1.0 : 1.0, speed = sign * (r < 2 ? slow : fast);
        hci_run *to = add_run(ROWS);
        for (size_t k = 0; k < ROWS; ++k) {
            const double theta_m = sign * 2.0 * REF_PI * (double)k / 50.3 + 0.2 * (double)r;
            to->theta_m_rad[k] = theta_m;
            to->time_s[k] = (double)k / 50.3 * 2.0 * REF_PI / fabs(speed);
            to->speed_rad_per_s[k] = speed;
            double *row = x[ROWS * r + k];
            row[COULOMB] = -sign;
            row[VISCOUS] = -speed;
            row[ZERO_A] = -K_NM_PER_A * sin(P * theta_m);
            row[ZERO_B] = -K_NM_PER_A * sin(P * theta_m - 2.0 * REF_PI / 3.0);
            row[OFFSET] = 1.0;
            rec_phases(0.0, CURRENT_A, P * theta_m, to->i_A + 3 * k);
        }
    }
}

/* (XᵀX)⁻¹ by Gauss and Jordan; of the columns below `columns`. */
static void invert(size_t columns)
{
    double a[COLUMNS][2 * COLUMNS] = {{0.0}};
    for (size_t i = 0; i < columns; ++i) {
        a[i][COLUMNS + i] = 1.0;
        for (size_t j = 0; j < columns; ++j)
            for (size_t k = 0; k < ALL; ++k)
                a[i][j] += x[k][i] * x[k][j];
    }
    for (size_t i = 0; i < columns; ++i)
        for (size_t j = 0; j < columns; ++j) {
            const double by = j == i ? 1.0 - 1.0 / a[i][i] : a[j][i] / a[i][i];
            for (size_t k = 0; k < 2 * COLUMNS; ++k)
                a[j][k] -= by * a[i][k];
        }
    for (size_t i = 0; i < columns; ++i)
        memcpy(inverse[i], a[i] + COLUMNS, sizeof inverse[i]);
}

/* What stays of some numbers beside all columns. */
static void residual_project(void)
{
    for (int pass = 0; pass < 2; ++pass) {
        double moment[COLUMNS] = {0.0};
        for (size_t i = 0; i < COLUMNS; ++i)
            for (size_t k = 0; k < ALL; ++k)
                moment[i] += x[k][i] * residual[k];
        for (size_t k = 0; k < ALL; ++k)
            for (size_t i = 0; i < COLUMNS; ++i)
                for (size_t j = 0; j < COLUMNS; ++j)
                    residual[k] -= x[k][i] * inverse[i][j] * moment[j];
    }
}

static double rms_of_residual(void)
{
    double sum = 0.0;
    for (size_t k = 0; k < ALL; ++k)
        sum += residual[k] * residual[k];
    return sqrt(sum / ALL);
}

/* By which standard errors are wider: neighbours of one run whose products are a share ρ of the squares. */
static double deviation(void)
{
    double square = 0.0, beside = 0.0;
    for (size_t k = 0; k < ALL; ++k) {
        square += residual[k] * residual[k];
        if (k % ROWS > 0) beside += residual[k] * residual[k - 1];
    }
    const double rho = fmax(beside / square, 0.0);
    return sqrt(square / (ALL - TERMS) * (1.0 + rho) / (1.0 - rho));
}

static void torques_write(const double value[COLUMNS])
{
    for (size_t k = 0; k < ALL; ++k) {
        double *torque_Nm = &run[k / ROWS].torque_Nm[k % ROWS];
        *torque_Nm = residual[k] + 1.5 * K_NM_PER_A * CURRENT_A;
        for (size_t i = 0; i < COLUMNS; ++i)
            *torque_Nm += value[i] * x[k][i];
    }
}

/* Noise in which each sample has a share of the one before. */
static void make(double slow, double fast, double share, const double value[COLUMNS])
{
    columns_fill(slow, fast);
    invert(COLUMNS);
    for (size_t k = 0; k < ALL; ++k)
        residual[k] = NOISE_NM * ref_normal(&seed) + (k % ROWS > 0 ? share * residual[k - 1] : 0.0);
    residual_project();
    torques_write(value);
}

static void fit_runs(const hci_effects *declared)
{
    const hci_effects none = {NULL, 0};
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT_MESSAGE(
        HCI_OK, hci_fleet_fit_runs(&machine, declared ? declared : &none, &runs, &fit, &note), note.text);
    TEST_ASSERT_TRUE(fit.is_found);
}

/* ---- what was found ---- */

static const hci_fleet_parameter *found_of(size_t column)
{
    for (size_t k = 0; k < fit.count; ++k)
        if (strcmp(fit.parameter[k].effect, EFFECT[column]) == 0 &&
            strcmp(fit.parameter[k].parameter, PARAMETER[column]) == 0)
            return &fit.parameter[k];
    TEST_FAIL_MESSAGE(PARAMETER[column]);
    return NULL;
}

static void expect(const double value[COLUMNS])
{
    for (size_t i = 0; i < COLUMNS; ++i) {
        const double error = deviation() * sqrt(inverse[i][i]);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-6 * error, value[i], found_of(i)->value, PARAMETER[i]);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-6 * error, error, found_of(i)->std_error, PARAMETER[i]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, rms_of_residual(), fit.rms_after_Nm);
    TEST_ASSERT_EQUAL_UINT64(ALL, fit.samples);
}

static const double VALUE[COLUMNS] = {0.05, 3e-4, 0.0, 0.0, -0.02};

static void test_values_and_errors_of_white_noise(void)
{
    double square = 0.0;
    make(60.0, 150.0, 0.0, VALUE);
    for (size_t k = 0; k < ALL; ++k) {
        const double beside_Nm = run[k / ROWS].torque_Nm[k % ROWS] - 1.5 * K_NM_PER_A * CURRENT_A;
        square += beside_Nm * beside_Nm;
    }
    fit_runs(NULL);
    expect(VALUE);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(square / ALL), fit.rms_before_Nm);
}

static void test_noise_that_lasts_counts_as_fewer_samples(void)
{
    make(60.0, 150.0, 0.6, VALUE);
    fit_runs(NULL);
    expect(VALUE);
}

/* Noise that changes its sign from sample to sample counts as white. */
static void test_noise_that_alternates_is_no_better(void)
{
    make(60.0, 150.0, -0.6, VALUE);
    fit_runs(NULL);
    expect(VALUE);
}

/* ---- declared effects ---- */

static size_t parameter_of(const char *effect, const char *name)
{
    const hci_effect_type *type = hci_effect_type_find(effect);
    size_t k = 0;
    while (strcmp(type->parameter[k].name, name) != 0)
        ++k;
    return k;
}

/* Values are beyond what is declared, of which the second effect of the list is a friction. */
static void test_values_are_beyond_the_declared_ones(void)
{
    hci_effect_term zero = {parameter_of("torque_sensor", "offset"), 0.0, 0.01, NAN};
    hci_effect_term friction[2] = {{0, 0.0, 0.02, NAN}, {1, 0.0, 1e-4, NAN}};
    const hci_effect effect[2] = {{hci_effect_type_find("torque_sensor"), &zero, 1},
                                  {hci_effect_type_find("friction"), friction, 2}};
    const hci_effects declared = {effect, 2};
    const double beyond[COLUMNS] = {0.03, 2e-4, 0.0, 0.0, -0.03};
    make(60.0, 150.0, 0.0, VALUE);
    fit_runs(&declared);
    expect(beyond);
}

/* ---- what is told ---- */

/* A friction that drives by more than three standard errors is none; by less it may be. Of a declared one
 * less is left, and it may be less by so much more. */
static void test_a_friction_that_drives_is_left_out(void)
{
    hci_effect_term term = {COULOMB, 0.0, 0.04, NAN};
    const hci_effect effect = {hci_effect_type_find("friction"), &term, 1};
    const hci_effects none = {NULL, 0}, one = {&effect, 1};
    for (int k = 0; k < 4; ++k) {
        runs.count = 0;
        make(60.0, 150.0, 0.0, VALUE);
        double value[COLUMNS] = {0.0, 3e-4, 0.0, 0.0, -0.02};
        value[COULOMB] = (k % 2 ? -3.1 : -2.9) * deviation() * sqrt(inverse[COULOMB][COULOMB]);
        torques_write(value);
        fit_runs(k < 2 ? &none : &one);
        if (k >= 2) value[COULOMB] -= 0.04;
        if (k % 2 == 0) expect(value);
        TEST_ASSERT_EQUAL(k % 2, isnan(found_of(COULOMB)->value));
        TEST_ASSERT_EQUAL(k % 2, isnan(found_of(COULOMB)->std_error));
        for (size_t r = 0; r < RUNS; ++r)
            rec_release(&run[r]);
    }
}

/* Two speeds that are nearly the same tell the drag by the speed so badly that its error moves the torque by
 * more than the noise: a variance inflation of as many as there are samples less terms. The last of the two
 * is left out. */
static void test_what_two_speeds_hardly_tell(void)
{
    for (int told = 0; told < 2; ++told) {
        const double apart = 100.0 / sqrt((told ? 0.95 : 1.05) * (ALL - TERMS) - 1.0);
        runs.count = 0;
        make(100.0 - apart, 100.0 + apart, -0.6, VALUE);
        fit_runs(NULL);
        if (told) expect(VALUE);
        TEST_ASSERT_EQUAL(!told, isnan(found_of(VISCOUS)->value));
        TEST_ASSERT_FALSE(isnan(found_of(COULOMB)->value));
        for (size_t r = 0; r < RUNS; ++r)
            rec_release(&run[r]);
    }
}

/* ---- what is used ---- */

/* Of the runs to be fitted the second and the third cannot be; one is to be tested on. Rows that are not
 * samples are counted where they stand between some. */
static void test_what_is_not_used_is_told(void)
{
    size_t rows[RUNS][ROWS];
    make(60.0, 150.0, 0.0, VALUE);
    for (size_t r = 0; r < RUNS; ++r) {
        for (size_t k = 0; k < ROWS; ++k)
            rows[r][k] = k < 20 ? k : k + 2 + r;
        run[r].row = rows[r];
    }
    run[1].mean_is_unknown = true;
    run[2].torque_source = HCI_TORQUE_NONE;
    hci_run *extra = add_run(ROWS);
    role[4] = HCI_ROLE_HOLDOUT;
    extra->row = rows[3];
    fit_runs(NULL);
    TEST_ASSERT_EQUAL_UINT64(4, fit.recordings);
    TEST_ASSERT_EQUAL_UINT64(2, fit.recordings_unused);
    TEST_ASSERT_EQUAL_UINT64(2 * ROWS, fit.samples);
    TEST_ASSERT_EQUAL_UINT64(2 + 5, fit.rows_unused);
    TEST_ASSERT_EQUAL_STRING(
        "2 of 4 recordings are not used; the first, run_1.csv, is with an unknown constant load; "
        "7 rows of the recordings have a hole or repeat the one before, and are not used",
        fit.remark.text);
    for (size_t r = 0; r < RUNS + 1; ++r)
        run[r].row = NULL;
}

static const char *remark_of_first(void)
{
    memset(&fit, 0, sizeof fit);
    fit_runs(NULL);
    return fit.remark.text;
}

static void test_why_a_recording_is_not_used(void)
{
    make(60.0, 150.0, 0.0, VALUE);
    TEST_ASSERT_EQUAL_STRING("", remark_of_first());
    run[0].torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_EQUAL_STRING(
        "1 of 4 recordings are not used; the first, run_0.csv, is a turn that is held, whose "
        "current is the reading",
        remark_of_first());
    run[0].torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_EQUAL_STRING(
        "1 of 4 recordings are not used; the first, run_0.csv, is without a measured torque",
        remark_of_first());
    run[0].torque_source = HCI_TORQUE_MEASURED;
    double *theta_m_rad = run[0].theta_m_rad;
    run[0].theta_m_rad = NULL;
    TEST_ASSERT_EQUAL_STRING("1 of 4 recordings are not used; the first, run_0.csv, is without an angle",
                             remark_of_first());
    run[0].theta_m_rad = theta_m_rad;
}

static void test_without_any_torque_there_is_no_fit(void)
{
    const hci_effects none = {NULL, 0};
    hci_note note = {{0}};
    make(60.0, 150.0, 0.0, VALUE);
    for (size_t r = 0; r < RUNS; ++r)
        run[r].torque_source = HCI_TORQUE_NONE;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_fleet_fit_runs(&machine, &none, &runs, &fit, &note));
    TEST_ASSERT_EQUAL_STRING(
        "recordings: found no run to be fitted with an angle and a measured torque; expected one "
        "at least",
        note.text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_values_and_errors_of_white_noise);
    RUN_TEST(test_noise_that_lasts_counts_as_fewer_samples);
    RUN_TEST(test_noise_that_alternates_is_no_better);
    RUN_TEST(test_values_are_beyond_the_declared_ones);
    RUN_TEST(test_a_friction_that_drives_is_left_out);
    RUN_TEST(test_what_two_speeds_hardly_tell);
    RUN_TEST(test_what_is_not_used_is_told);
    RUN_TEST(test_why_a_recording_is_not_used);
    RUN_TEST(test_without_any_torque_there_is_no_fit);
    return UNITY_END();
}
