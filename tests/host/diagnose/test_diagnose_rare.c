/* Effects that recordings tell only where they vary the right thing: each is hidden by its own equation, and
 * found where that varies, and not named where it is not there. */
#include "host/base/memory.h"
#include "host/numeric/derivative.h"

#include "support/diagnosing.h"

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* The value within three standard errors, which are a share of it at most. */
static void is_value(double expected, double share, const hci_effect_term *t)
{
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * t->std_error, expected, t->value);
    TEST_ASSERT_TRUE(t->std_error < share * fabs(expected));
}

static double sign_of(double x)
{
    return x < 0.0 ? -1.0 : 1.0;
}

/* ---- an angle that turns with the load ---- */

/* A machine with a 5th and a cogging torque, at many loads in both directions; the angle is read too much by
 * so much an ampere, and L_d − L_q is another one than declared by so much. */
static void record_twisted(double per_ampere, double saliency_H)
{
    static const double CURRENT_A[] = {0.0, 3.0, 9.0, -5.0, 6.0, -8.0, 4.0, -3.0};
    hci_note note = {{0}};
    files_write(files_path("back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n5,0.01,0.4\n");
    files_write(files_path("cogging.csv"), "order,amplitude_Nm,phase_rad\n6,0.05,0.3\n");
    hci_machine_release(&machine);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
    for (size_t r = 0; r < 8; ++r) {
        const double iq = CURRENT_A[r], id = saliency_H > 0.0 ? -0.5 * fabs(iq) : 0.0;
        record(900, &(point){(r % 2 ? -1.0 : 1.0) * (40.0 + 10.0 * (double)r), iq, 0.0, 0.0, 0.0});
        for (size_t k = 0; k < 900; ++k) {
            const double theta = P * run[r].theta_m_rad[k];
            rec_phases(id, iq, theta, run[r].i_A + 3 * k);
            run[r].torque_Nm[k] = hci_torque_at(&machine.model, theta, run[r].i_A + 3 * k) +
                                  1.5 * P * saliency_H * id * iq + NOISE_NM * ref_normal(&seed);
            run[r].theta_m_rad[k] += per_ampere * iq / P;
        }
    }
}

static void test_an_angle_that_turns_with_the_load(void)
{
    record_twisted(0.012, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("position_load")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    is_value(0.012, 0.05, term("position_load", "per_ampere", 0.0));
}

/* Its mean alone is what a salient rotor makes, which has no ripple. */
static void test_a_salient_rotor_does_not_turn_the_angle(void)
{
    record_twisted(0.0, 3e-4);
    diagnose(NULL);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("reluctance")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("position_load")->verdict);
}

/* ---- friction at low speed ---- */

static const double SPEEDS[] = {3.0, 7.0, 12.0, 25.0, 60.0, 150.0};

/* Twelve runs there and back: Coulomb and viscous friction, and an excess that fades like a Gauss curve. */
static void record_sliding(double excess_Nm)
{
    for (int k = 0; k < 12; ++k) {
        const double speed = (k % 2 ? -1.0 : 1.0) * SPEEDS[k / 2], u = speed / 15.0;
        const double brake_Nm = 0.03 + 1e-4 * fabs(speed) + excess_Nm * exp(-u * u);
        record(450, &(point){speed, k % 3 ? 2.0 : 0.0, 0.0, sign_of(speed) * brake_Nm, 0.0});
    }
}

static void test_stribeck_friction(void)
{
    record_sliding(0.05);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("stribeck_friction")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL_UINT64(2, count_of(HCI_FINDING_ADDED));
    is_value(0.05, 0.05, term("stribeck_friction", "excess", 0.0));
    is_value(15.0, 0.05, term("stribeck_friction", "speed", 0.0));
    is_value(0.03, 0.05, term("friction", "coulomb", 0.0));
}

static void test_plain_friction_has_no_excess(void)
{
    record_sliding(0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("stribeck_friction")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
}

/* ---- swings beside the turn ---- */

/* Of a frequency in Hz, or so often in a turn. */
static void record_beside(double frequency_Hz, double per_turn)
{
    for (int k = 0; k < 4; ++k) {
        record(1800, &(point){k < 2 ? 60.0 + 7.0 * k : -130.0 - 9.0 * k, k % 2 ? 9.0 : 2.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 1800; ++j)
            run[k].torque_Nm[j] += 0.05 * sin(2.0 * REF_PI * frequency_Hz * run[k].time_s[j] +
                                              per_turn * run[k].theta_m_rad[j] + k);
    }
    diagnose(NULL);
    TEST_ASSERT_EQUAL_UINT64(1, diagnosis.swings);
    TEST_ASSERT_EQUAL_UINT64(4, diagnosis.swing[0].runs);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
}

/* That of a load is none of the motor's; what goes with the rotor may be its bearing. */
static void test_swings_are_said(void)
{
    record_beside(13.1, 0.0);
    TEST_ASSERT_FALSE(diagnosis.swing[0].of_turn);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, diagnosis.verdict);
    tearDown();
    setUp();
    record_beside(0.0, 1.3717);
    TEST_ASSERT_TRUE(diagnosis.swing[0].of_turn);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 1.3717, diagnosis.swing[0].frequency);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
}

/* ---- a zero that creeps ---- */

/* Two currents there, two back and faster; n: samples, 300 a turn. */
static void record_creeping(size_t n, double rate_Nm_per_s)
{
    for (int k = 0; k < 4; ++k) {
        record(n, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < n; ++j)
            run[k].torque_Nm[j] += rate_Nm_per_s * (run[k].time_s[j] - run[k].time_s[0]);
    }
}

static void is_drift(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("torque_drift")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    is_value(0.03, 0.05, term("torque_drift", "rate", 0.0));
}

static void test_drift_of_the_torque_sensor(void)
{
    record_creeping(3000, 0.03);
    is_drift();
}

/* So long that only means over turns are kept of it. */
static void test_drift_in_long_runs(void)
{
    record_creeping(9000, 0.03);
    is_drift();
}

/* A wrong zero is none, and nothing is none. */
static void test_what_stands_still_does_not_drift(void)
{
    for (int k = 0; k < 4; ++k)
        record(3000, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, 0.0, 0.02, 0.0});
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("torque_drift")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("torque_sensor")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
}

/* ---- a rotor before the torque sensor ---- */

/* The load machine's speed swings three times a turn. */
static void record_swinging(double speed, double iq, double inertia_kgm2)
{
    const double swing_rad = 0.02;
    record(450, &(point){speed, iq, 0.0, 0.0, 0.0});
    hci_run *r = &run[runs.count - 1];
    for (size_t k = 0; k < r->count; ++k) {
        const double turned = 3.0 * speed * r->time_s[k];
        r->theta_m_rad[k] = speed * r->time_s[k] + swing_rad * sin(turned);
        r->speed_rad_per_s[k] = speed * (1.0 + 3.0 * swing_rad * cos(turned));
        rec_phases(0.0, iq, P * r->theta_m_rad[k], r->i_A + 3 * k);
        r->torque_Nm[k] += inertia_kgm2 * swing_rad * 9.0 * speed * speed * sin(turned);
    }
}

static void test_the_rotor_takes_its_part(void)
{
    for (int k = 0; k < 4; ++k)
        record_swinging(k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, 2e-4);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("rotor_inertia")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * 2e-4, 2e-4, term("rotor_inertia", "inertia", 0.0)->value);
}

/* No current, and no speed but the slope of an angle that is read with noise. */
static void record_ramp(double speed, double acceleration, double inertia_kgm2)
{
    hci_run *r = add_run(2400);
    for (size_t k = 0; k < r->count; ++k) {
        const double s = (double)k / 1500.0;
        r->time_s[k] = s;
        r->theta_m_rad[k] = speed * s + 0.5 * acceleration * s * s + 2e-4 * ref_normal(&seed);
        rec_phases(0.0, 0.0, 0.0, r->i_A + 3 * k);
        r->torque_Nm[k] = NOISE_NM * ref_normal(&seed) - inertia_kgm2 * acceleration;
    }
    r->speed_window = hci_derivative_window(r->time_s, r->theta_m_rad, r->count);
    hci_derivative_over(r->time_s, r->theta_m_rad, r->count, r->speed_window, r->speed_rad_per_s);
}

/* The noise of an acceleration is none of the torque: a lag of the sensor that smooths it is not there. */
static void test_an_inertia_on_ramps(void)
{
    record_ramp(5.0, 50.0, 1e-3);
    record_ramp(-5.0, -50.0, 1e-3);
    record_ramp(100.0, -50.0, 1e-3);
    record_ramp(-100.0, 50.0, 1e-3);
    record_ramp(40.0, 0.0, 1e-3);
    record_ramp(-40.0, 0.0, 1e-3);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("rotor_inertia")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * 1e-3, 1e-3, term("rotor_inertia", "inertia", 0.0)->value);
    for (size_t k = 0; k < 6; ++k)
        TEST_ASSERT_TRUE(diagnosis.run[k].rms_after_Nm < 1.1 * NOISE_NM);
}

/* ---- a weak magnet ---- */

/* The flux around the turn, as one coil a phase and pole pair sees it a third of a pole pair later each. */
static double flux_at(double theta_m)
{
    return 0.95 + 0.06 * cos(theta_m - 1.0) + 0.05 * cos(2.0 * theta_m + 0.5) +
           0.04 * cos(3.0 * theta_m - 2.0);
}

/* T = Σ e_s i_s flux_s, with i_d and i_q of both signs. */
static void record_weak_magnet(double speed, double id, double iq)
{
    record(1500, &(point){speed, 0.0, 0.0, 0.0, 0.0});
    hci_run *r = &run[runs.count - 1];
    for (size_t k = 0; k < r->count; ++k) {
        const double theta_m = r->theta_m_rad[k];
        rec_phases(id, iq, P * theta_m, r->i_A + 3 * k);
        for (int s = 0; s < 3; ++s)
            r->torque_Nm[k] += K_NM_PER_A * sin(P * theta_m - 2.0 * REF_PI * s / 3.0) *
                               flux_at(theta_m - 2.0 * REF_PI * s / (3.0 * P)) * r->i_A[3 * k + (size_t)s];
    }
}

/* Its torque goes with i_d as with i_q, at fractional orders and, since poles differ, at the third. Where the
 * flux varies once a turn by 0.06, i_d makes −K i_d 0.06/4 Σ_s sin(7 θ_m − 1 − s 14π/9) of seven a turn. */
static void test_a_magnet_that_phases_see_in_turn(void)
{
    record_weak_magnet(60.0, 0.0, 0.0);
    record_weak_magnet(60.0, -1.0, 9.0);
    record_weak_magnet(-150.0, 5.0, 7.0);
    record_weak_magnet(150.0, -6.0, 4.0);
    record_weak_magnet(-60.0, 1.0, -8.0);
    record_weak_magnet(100.0, 0.5, 2.5);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("mechanical_order")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("back_emf")->verdict);
    TEST_ASSERT_EQUAL_UINT64(2, count_of(HCI_FINDING_ADDED));
    is_value(-0.05 * K_NM_PER_A, 0.1, term("back_emf", "sine", 1.0));
    is_value(-0.00373, 0.3, term("mechanical_order", "id_sine", 7.0 / 3.0));
}

/* ---- a low pass ---- */

/* Six runs at three speeds, with i_d too; what is read of the currents is the answer of a low pass to a sine.
 */
static void record_filtered(double tau_s)
{
    static const double SPEED[] = {40.0, -80.0, 150.0};
    for (int k = 0; k < 6; ++k) {
        const double speed = SPEED[k / 2], phi = atan(P * speed * tau_s), gain = cos(phi);
        const double d = k % 2 ? -6.0 : 5.0, q = k % 2 ? 8.0 : 3.0;
        record(450, &(point){speed, q, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 450; ++j) /* i_d makes no torque here */
            rec_phases(gain * (d * cos(phi) + q * sin(phi)), gain * (q * cos(phi) - d * sin(phi)),
                       P * run[k].theta_m_rad[j], run[k].i_A + 3 * j);
    }
}

static void test_filter_of_the_currents(void)
{
    record_filtered(1.5e-3);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("current_filter")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL_UINT64(0, count_of(HCI_FINDING_AMBIGUOUS));
    is_value(1.5e-3, 0.01, term("current_filter", "time_constant", 0.0));
}

/* A short one is a delay for all that the recordings show, and is called so. */
static void test_a_short_filter_is_a_delay(void)
{
    record_filtered(3e-5);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("channel_delay")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL_UINT64(0, count_of(HCI_FINDING_AMBIGUOUS));
    TEST_ASSERT_DOUBLE_WITHIN(3e-6, 3e-5, term("channel_delay", "current", 0.0)->value);
}

/* ---- a torque sensor that is calibrated wrong ---- */

static void declare_cogging(void)
{
    hci_note note = {{0}};
    files_write(files_path("cogging.csv"), "order,amplitude_Nm,phase_rad\n12,0.1,0\n");
    hci_machine_release(&machine);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
}

/* Four runs; the torque of the currents and the cogging torque are read by factors of their own. */
static void record_gains(double of_current, double of_cogging)
{
    declare_cogging();
    for (int k = 0; k < 4; ++k) {
        record(450, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 450; ++j)
            run[k].torque_Nm[j] += (of_current - 1.0) * 1.5 * K_NM_PER_A * (k % 2 ? 9.0 : 2.0) +
                                   of_cogging * 0.1 * sin(12.0 * P * run[k].theta_m_rad[j]);
    }
    diagnose(NULL);
}

/* Weak magnets take twice as much from cogging, to first order. */
static void test_weak_magnets_are_no_calibration(void)
{
    record_gains(0.9, 0.81);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("torque_gain")->verdict);
}

/* Without current a smaller cogging torque tells no gain. */
static void test_cogging_alone_is_no_calibration(void)
{
    declare_cogging();
    for (int k = 0; k < 4; ++k) {
        record(450, &(point){k < 2 ? 60.0 : -150.0, 0.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 450; ++j)
            run[k].torque_Nm[j] += 0.09 * sin(12.0 * P * run[k].theta_m_rad[j]);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("torque_gain")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("cogging")->verdict);
}

static void test_a_wrong_calibration(void)
{
    record_gains(0.9, 0.9);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("torque_gain")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_EXPLAINED, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    is_value(-0.1, 0.02, term("torque_gain", "gain", 0.0));
}

/* ---- an encoder that errs between its lines ---- */

/* Encoder of lines that are no multiple of the pole pairs: it errs twice and four times in each. */
static void record_lines(double lines, double error_rad)
{
    declare_cogging();
    for (int k = 0; k < 6; ++k) {
        const double d = k % 2 ? 4.0 : -5.0, q = 2.0 * k;
        record(1500, &(point){k < 3 ? 60.0 : -150.0, q, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 1500; ++j) {
            const double theta_m = run[k].theta_m_rad[j];
            rec_phases(k ? d : 0.0, q, P * theta_m, run[k].i_A + 3 * j);
            run[k].torque_Nm[j] += 0.1 * sin(12.0 * P * theta_m);
            run[k].theta_m_rad[j] +=
                error_rad / P * (sin(2.0 * lines * theta_m + 0.4) + 0.5 * sin(4.0 * lines * theta_m + 1.0));
        }
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
}

/* Orders of torque on both sides of the cogging order, and with i_d, are no cogging torque. */
static void test_an_encoder_between_its_lines(void)
{
    record_lines(10.0, 0.02);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("position_harmonics")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL_UINT64(0, count_of(HCI_FINDING_AMBIGUOUS));
    is_value(0.02 * cos(0.4), 0.05, term("position_harmonics", "sine", 20.0 / P));
    is_value(0.01 * sin(1.0), 0.05, term("position_harmonics", "cosine", 40.0 / P));
}

/* ---- magnets that are not equal ---- */

/* Four runs; torque of the currents and cogging torque vary with the turn, each by a share of its own. */
static void record_magnets(double of_load, double of_cogging)
{
    declare_cogging();
    for (int k = 0; k < 4; ++k) {
        record(1200, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 1.2 : 0.4, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 1200; ++j) {
            const double theta_m = run[k].theta_m_rad[j], m = 0.05 * sin(theta_m + 0.5);
            run[k].torque_Nm[j] += of_load * m * 1.5 * K_NM_PER_A * (k % 2 ? 1.2 : 0.4) +
                                   (1.0 + 2.0 * of_cogging * m) * 0.1 * sin(12.0 * P * theta_m);
        }
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL_UINT64(0, count_of(HCI_FINDING_AMBIGUOUS));
}

static void test_unequal_magnets(void)
{
    record_magnets(1.0, 1.0);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("unequal_magnets")->verdict);
    is_value(0.05 * cos(0.5), 0.05, term("unequal_magnets", "sine", 1.0 / P));
    is_value(0.05 * sin(0.5), 0.05, term("unequal_magnets", "cosine", 1.0 / P));
}

/* An eccentric rotor leaves the cogging torque as it was. */
static void test_an_eccentric_rotor_has_equal_magnets(void)
{
    record_magnets(1.0, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("mechanical_order")->verdict);
}

/* ---- a torque sensor that is slow ---- */

/* The torque of a sine current of another order in the rotor frame answers with its amplitude and phase: at
 * each speed another one, up to 60 degrees late. samples: of a turn. */
static void record_slow_sensor(double tau_s, double samples)
{
    static const double SPEED[] = {8.0, -16.0, 30.0, -40.0};
    for (int k = 0; k < 4; ++k) {
        const double w = 12.0 * P * SPEED[k], phi = atan(w * tau_s), gain = cos(phi);
        record(2000, &(point){SPEED[k], 4.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 2000; ++j) {
            const double theta_m = sign_of(SPEED[k]) * 2.0 * REF_PI * (double)j / samples;
            run[k].torque_Nm[j] = 1.5 * K_NM_PER_A * 4.0 + NOISE_NM * ref_normal(&seed) +
                                  0.1 * gain * sin(12.0 * P * theta_m - phi);
            run[k].theta_m_rad[j] = theta_m;
            run[k].time_s[j] = theta_m / SPEED[k];
            rec_phases(0.0, 4.0 + 0.02 * ref_normal(&seed), P * theta_m, run[k].i_A + 3 * j);
        }
    }
}

static void is_slow(double tau_s)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("torque_sensor")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL_UINT64(0, count_of(HCI_FINDING_AMBIGUOUS));
    is_value(tau_s, 0.05, term("torque_sensor", "time_constant", 0.0));
}

static void test_a_long_lag_is_no_delay(void)
{
    declare_cogging();
    record_slow_sensor(3e-3, 1200.0);
    is_slow(3e-3);
}

/* Two thirds of a turn, in which the currents are no series of orders of the turn. */
static void test_a_lag_within_an_arc(void)
{
    declare_cogging();
    record_slow_sensor(3e-3, 3000.0);
    is_slow(3e-3);
}

/* ---- zeros that are another one in each run ---- */

static void record_zeros(double offset_A)
{
    static const double ZERO_NM[] = {0.05, -0.08, 0.09, -0.02, 0.07, -0.06, -0.09, 0.03};
    static const double SPEED[] = {20.0, -20.0, 60.0, -60.0, 110.0, -110.0, 150.0, -40.0};
    static const double IQ_A[] = {0.0, 0.0, 9.0, 6.0, 3.0, -9.0, 5.0, -4.0};
    for (int k = 0; k < 8; ++k)
        record(900, &(point){SPEED[k], IQ_A[k], offset_A, ZERO_NM[k], 0.0});
}

/* Six numbers for eight means: friction, drag of the iron and a gain describe them nearly, and say nothing of
 * the one that is left out. */
static void test_zeros_of_their_own_are_no_effect(void)
{
    record_zeros(0.0);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    TEST_ASSERT_TRUE(diagnosis.means_open);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
}

/* An offset of a current sensor makes a ripple of order 1, and stands there. */
static void test_beside_such_zeros_ripple_is_explained(void)
{
    record_zeros(0.3);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_PARTLY, diagnosis.verdict);
    TEST_ASSERT_TRUE(diagnosis.means_open);
    TEST_ASSERT_EQUAL_UINT64(1, diagnosis.effects.list.count);
    is_value(0.3, 0.05, term("current_offset", "a", 0.0));
}

/* ---- a sensor that answers otherwise in one direction ---- */

/* 3 % too much forward and too little back, of the cogging torque without a current as well. */
static void record_crosstalk(void)
{
    static const double SPEED[] = {20.0, -20.0, 20.0, -100.0, 100.0, -20.0, 100.0};
    static const double IQ_A[] = {0.0, 0.0, 9.0, 4.0, 8.0, -9.0, 3.0};
    static const double ID_A[] = {0.0, 0.0, 0.0, -3.0, 4.0, 0.0, 0.0};
    declare_cogging();
    for (int k = 0; k < 7; ++k) {
        record(900, &(point){SPEED[k], IQ_A[k], 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 900; ++j) {
            const double theta = P * run[k].theta_m_rad[j], cogging_Nm = 0.1 * sin(12.0 * theta);
            run[k].torque_Nm[j] += cogging_Nm + 0.03 * fabs(1.5 * K_NM_PER_A * IQ_A[k] + cogging_Nm);
            rec_phases(ID_A[k], IQ_A[k], theta, run[k].i_A + 3 * j);
        }
    }
}

/* A torque that keeps its sign with the load is none of the iron, nor is what the sensor reads too much
 * without a current its zero. */
static void test_crosstalk_is_no_effect(void)
{
    record_crosstalk();
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_swings_are_said);
    RUN_TEST(test_an_angle_that_turns_with_the_load);
    RUN_TEST(test_a_salient_rotor_does_not_turn_the_angle);
    RUN_TEST(test_stribeck_friction);
    RUN_TEST(test_plain_friction_has_no_excess);
    RUN_TEST(test_drift_of_the_torque_sensor);
    RUN_TEST(test_drift_in_long_runs);
    RUN_TEST(test_what_stands_still_does_not_drift);
    RUN_TEST(test_the_rotor_takes_its_part);
    RUN_TEST(test_an_inertia_on_ramps);
    RUN_TEST(test_a_magnet_that_phases_see_in_turn);
    RUN_TEST(test_filter_of_the_currents);
    RUN_TEST(test_a_short_filter_is_a_delay);
    RUN_TEST(test_weak_magnets_are_no_calibration);
    RUN_TEST(test_cogging_alone_is_no_calibration);
    RUN_TEST(test_a_wrong_calibration);
    RUN_TEST(test_an_encoder_between_its_lines);
    RUN_TEST(test_unequal_magnets);
    RUN_TEST(test_an_eccentric_rotor_has_equal_magnets);
    RUN_TEST(test_a_long_lag_is_no_delay);
    RUN_TEST(test_a_lag_within_an_arc);
    RUN_TEST(test_zeros_of_their_own_are_no_effect);
    RUN_TEST(test_beside_such_zeros_ripple_is_explained);
    RUN_TEST(test_crosstalk_is_no_effect);
    return UNITY_END();
}
