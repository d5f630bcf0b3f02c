/* The plant against SUNDIALS CVODE on equations written once more in the phase frame, with nothing of the
 * library: three phases, L(θ) 3×3, star point eliminated by line voltages. Needs SUNDIALS 6 and
 * HCI_TEST_SUNDIALS; else it is skipped. */
#ifndef HCI_TEST_SUNDIALS

int main(void)
{
    return 77;
}

#else

#include <math.h>
#include <string.h>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "hci/drive/plant.h"
#include "support/plant_machine.h"
#include "unity.h"

enum { POINTS = 65536, SEGMENTS = 48 };

static const double RESISTANCE_ohm = 1.5, INERTIA_kgm2 = 0.004, VISCOUS_Nms = 0.02, LOAD_Nm = 1.0;
static const double SEGMENT_s = 0.025, DC_LINK_V = 40.0;

/* Six-step operation by the clock: legs of each segment, one electrical turn in six. */
static const unsigned char LEGS[6] = {1, 3, 2, 6, 4, 5};

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- reference ---- */

typedef struct {
    const pm_machine *machine;
    double leg_V[3];
} reference;

/* Phase a's equation less phase c's, and b's less c's; unknown di_a, di_b with di_c = −di_a − di_b. y = i_a,
 * i_b, ω, θ_m. */
static int reference_rate(double t, N_Vector state, N_Vector rate, void *context)
{
    const reference *r = context;
    const pm_machine *m = r->machine;
    const double *y = N_VGetArrayPointer(state);
    double *dy = N_VGetArrayPointer(rate), l[3][3], side[3], e[3];
    const double i[3] = {y[0], y[1], -y[0] - y[1]}, speed = y[2], theta = m->pole_pairs * y[3];
    double torque = pm_cogging(m, theta);
    (void)t;
    for (int s = 0; s < 3; ++s) {
        e[s] = pm_emf(m, s, theta);
        torque += e[s] * i[s];
        side[s] = r->leg_V[s] - RESISTANCE_ohm * i[s] - speed * e[s];
        for (int k = 0; k < 3; ++k) {
            const double slope = m->pole_pairs * pm_inductance_slope(m, s, k, theta);
            l[s][k] = pm_inductance(m, s, k, theta);
            torque += 0.5 * i[s] * slope * i[k];
            side[s] -= speed * slope * i[k];
        }
    }
    const double aa = l[0][0] - l[0][2] - l[2][0] + l[2][2], ab = l[0][1] - l[0][2] - l[2][1] + l[2][2];
    const double ba = l[1][0] - l[1][2] - l[2][0] + l[2][2], bb = l[1][1] - l[1][2] - l[2][1] + l[2][2];
    const double u = side[0] - side[2], w = side[1] - side[2];
    dy[0] = (bb * u - ab * w) / (aa * bb - ab * ba);
    dy[1] = (aa * w - ba * u) / (aa * bb - ab * ba);
    dy[2] = (torque - LOAD_Nm - VISCOUS_Nms * speed) / INERTIA_kgm2;
    dy[3] = speed;
    return 0;
}

static void set_legs(reference *r, int segment)
{
    for (int s = 0; s < 3; ++s)
        r->leg_V[s] = LEGS[segment % 6] >> s & 1 ? DC_LINK_V : 0.0;
}

/* The state after all segments; CVODE starts anew at each, where the voltage jumps. */
static void integrate_reference(const pm_machine *machine, double y[4])
{
    reference r = {machine, {0.0, 0.0, 0.0}};
    SUNContext context = NULL;
    double t;
    TEST_ASSERT_EQUAL_INT(0, SUNContext_Create(NULL, &context));
    N_Vector state = N_VMake_Serial(4, y, context);
    SUNNonlinearSolver solver = SUNNonlinSol_FixedPoint(state, 0, context);
    void *cvode = CVodeCreate(CV_ADAMS, context);
    set_legs(&r, 0);
    TEST_ASSERT_EQUAL_INT(CV_SUCCESS, CVodeInit(cvode, reference_rate, 0.0, state));
    TEST_ASSERT_EQUAL_INT(CV_SUCCESS, CVodeSStolerances(cvode, 1e-12, 1e-12));
    TEST_ASSERT_EQUAL_INT(CV_SUCCESS, CVodeSetUserData(cvode, &r));
    TEST_ASSERT_EQUAL_INT(CV_SUCCESS, CVodeSetNonlinearSolver(cvode, solver));
    TEST_ASSERT_EQUAL_INT(CV_SUCCESS, CVodeSetMaxNumSteps(cvode, 100000));
    for (int k = 0; k < SEGMENTS; ++k) {
        set_legs(&r, k);
        if (k > 0) TEST_ASSERT_EQUAL_INT(CV_SUCCESS, CVodeReInit(cvode, k * SEGMENT_s, state));
        TEST_ASSERT_EQUAL_INT(CV_SUCCESS, CVodeSetStopTime(cvode, (k + 1) * SEGMENT_s));
        TEST_ASSERT_TRUE(CVode(cvode, (k + 1) * SEGMENT_s, state, &t, CV_NORMAL) >= 0);
    }
    CVodeFree(&cvode);
    SUNNonlinSolFree(solver);
    N_VDestroy(state);
    SUNContext_Free(&context);
}

/* ---- comparison ---- */

static const double START[4] = {0.0, 0.0, 6.0, 0.5};

static void integrate_plant(const hci_plant *plant, int steps_per_segment, double y[4])
{
    hci_plant_state state = {{0.0, 0.0}, START[2], START[3], 0.0};
    double v[2], abc[3];
    for (int k = 0; k < SEGMENTS; ++k) {
        hci_inverter_switched(DC_LINK_V, LEGS[k % 6], v);
        for (int j = 0; j < steps_per_segment; ++j)
            hci_plant_step(plant, &state, v, LOAD_Nm, SEGMENT_s / steps_per_segment);
    }
    hci_plane_to_abc(state.i, abc);
    y[0] = abc[0];
    y[1] = abc[1];
    y[2] = state.speed_rad_per_s;
    y[3] = hci_plant_angle_rad(&state);
}

static double difference(const double a[4], const double b[4])
{
    double most = 0.0;
    for (int k = 0; k < 4; ++k)
        most = fmax(most, fabs(a[k] - b[k]));
    return most;
}

/* 1.2 s, eight electrical turns on average. */
static void compare(const pm_machine *machine, const int steps[3], double most, double least_order)
{
    static double rows[12 * (POINTS + 1)];
    static pm_lists lists;
    hci_plant plant = {
        .resistance_ohm = RESISTANCE_ohm, .inertia_kgm2 = INERTIA_kgm2, .viscous_Nms = VISCOUS_Nms};
    double expected[4], y[4], error[3];
    memcpy(expected, START, sizeof expected);
    integrate_reference(machine, expected);
    TEST_ASSERT_TRUE(expected[3] > 20.0); /* it has turned */
    pm_list(machine, &lists);
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_plant_table_fill(&lists.machine, &lists.given, POINTS, rows, &plant.table));
    for (int k = 0; k < 3; ++k) {
        integrate_plant(&plant, steps[k], y);
        error[k] = difference(y, expected);
    }
    TEST_ASSERT_TRUE(error[2] < most);
    TEST_ASSERT_TRUE(log2(error[0] / error[1]) > least_order && log2(error[1] / error[2]) > least_order);
}

/* Twice what is seen at the finest step, 0.3 and 0.08 ms; CVODE with 1e-12 a step is itself within about
 * 1e-10 at the end. */
static void test_smooth_machine(void)
{
    static const int steps[3] = {20, 40, 80};
    compare(&PM_SMOOTH, steps, 2e-8, 3.8);
}

static void test_machine_full_of_harmonics(void)
{
    static const int steps[3] = {80, 160, 320};
    compare(&PM_INTERIOR, steps, 2e-9, 3.7);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_smooth_machine);
    RUN_TEST(test_machine_full_of_harmonics);
    return UNITY_END();
}

#endif
