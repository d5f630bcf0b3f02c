/* Values of a drive that a slip of a unit makes: usual ones say nothing, and each slip says what it may be.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/drive/drive.h"
#include "support/texts.h"
#include "unity.h"

static hci_drive_data drive;
static hci_machine_data machine;
static hci_inductance inductance[2];
static hci_wave emf;
static hci_note remark;

/* 0.5 mH and 0.3 Ω: 1.7 ms; 10 A of them make 0.05 of the flux of 0.1 Wb. 100 us, a PWM in each; k_p of 0.5
 * Ω: 159 Hz. */
void setUp(void)
{
    memset(&drive, 0, sizeof drive);
    memset(&machine, 0, sizeof machine);
    emf = (hci_wave){1.0, 1, 0.4, 0.0}; /* V·s per mechanical radian: 0.1 Wb of four pole pairs */
    drive.sample_s = 1e-4;
    drive.pwm_frequency_Hz = 1e4;
    drive.kp_ohm = 0.5;
    drive.bandwidth_Hz = NAN;
    drive.resistance_ohm = drive.inductance_d_H = drive.inductance_q_H = NAN;
    machine.model = (hci_machine){.pole_pairs = 4, .back_emf = &emf, .back_emf_count = 1};
    machine.resistance_ohm = 0.3;
    machine.inductance_d_H = 0.4e-3;
    machine.inductance_q_H = 0.6e-3;
    machine.rated_current_A = 10.0;
}

void tearDown(void)
{
}

static const char *said(void)
{
    memset(&remark, 0, sizeof remark);
    hci_drive_remark_units(&drive, &machine, &remark);
    return remark.text;
}

static void says_nothing(void)
{
    TEST_ASSERT_EQUAL_STRING("", said());
}

static void test_usual_values(void)
{
    says_nothing();
    drive.pwm_frequency_Hz = 5e3; /* both edges are sampled */
    says_nothing();
    drive.sample_s = NAN; /* 100 us */
    says_nothing();
}

static void test_samples_in_another_unit(void)
{
    drive.sample_s = 1.9e-3;
    drive.pwm_frequency_Hz = 1e3;
    drive.kp_ohm = 5.0;
    says_nothing();
    drive.sample_s = 2.1e-3;
    text_has("drive.csv: `current_sample_time` of 0.0021 s", said());
    text_has("such as 2.1 us?", said());
    text_lacks("pwm", said());
    snprintf(drive.path, sizeof drive.path, "bench/d.csv");
    text_has("bench/d.csv: `current_sample_time`", said());
}

static void test_a_frequency_in_another_unit(void)
{
    drive.pwm_frequency_Hz = 2.1e3;
    says_nothing();
    drive.pwm_frequency_Hz = 1.9e3;
    drive.dead_time_s = 1e-6;
    text_has("`pwm_frequency` of 1900 Hz is 0.19 periods in a `current_sample_time` of 0.0001 s", said());
    text_has("is it in kHz?", said());
    text_has("by it a dead time of 1e-06 s is 0.19 % of a period", said());
    drive.pwm_frequency_Hz = 4.9e5;
    says_nothing();
    drive.pwm_frequency_Hz = 5.1e5;
    drive.dead_time_s = 0.0;
    text_has("is 51 periods", said());
    text_has("is one of the two in another unit?", said());
    text_lacks("dead time", said());
}

/* The bandwidth is k_p/(2πL), where both are known; else as it is declared. 0.0005 of 10 kHz is 5 Hz. */
static void test_a_bandwidth_in_another_unit(void)
{
    drive.kp_ohm = 5.1 * 2.0 * HCI_PI * 0.5e-3;
    says_nothing();
    drive.kp_ohm = 4.9 * 2.0 * HCI_PI * 0.5e-3;
    text_has("the bandwidth of the current loop is 4.9 Hz by k_p and L, a sample is 0.0001 s", said());
    text_has("such as 320 Hz", said());
    drive.kp_ohm = NAN;
    drive.bandwidth_Hz = 5.1;
    says_nothing();
    drive.bandwidth_Hz = 4.9;
    text_has("the bandwidth of the current loop is 4.9 Hz, a sample", said());
    drive.bandwidth_Hz = 0.0;
    says_nothing();
}

/* L/R and L i/ψ: 2 s and 20 are too much, 10 us too little, 100 us where the current makes below 0.003 of the
 * flux. */
static void test_an_inductance_in_another_unit(void)
{
    static const struct {
        double inductance_mH, resistance_ohm;
        const char *words;
    } CASE[] = {{190.0, 0.1, ""},
                {190.0, 0.0951, ""},
                {190.0, 0.0949, "is the inductance in mH, or the resistance"},
                {199.0, 100.0, ""},
                {201.0, 100.0, "is the inductance in mH, or the resistance"},
                {0.5, 49.0, ""},
                {0.5, 51.0, "is the inductance a thousand times as large"},
                {0.029, 0.28, ""},
                {0.029, 0.3, "is the inductance a thousand times as large"},
                {0.031, 0.35, ""}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        machine.inductance_d_H = machine.inductance_q_H = 1e-3 * CASE[k].inductance_mH;
        machine.resistance_ohm = CASE[k].resistance_ohm;
        drive.kp_ohm = 1000.0 * machine.inductance_d_H;
        if (CASE[k].words[0])
            text_has(CASE[k].words, said());
        else
            says_nothing();
    }
    machine.inductance_d_H = machine.inductance_q_H = 0.201;
    text_has("at the rated current of 10 A it makes 20.1 times the flux", said());
    machine.rated_current_A = NAN;
    machine.resistance_ohm = 0.05;
    text_has("an inductance of 0.201 H with a resistance of 0.05 ohm has a time constant of 4.02 s", said());
    text_lacks("rated current", said());
}

/* What machine.csv does not tell the drive may; inductance.csv goes first: that of a phase less that between
 * two. */
static void test_where_the_inductance_is_from(void)
{
    machine.inductance_d_H = machine.inductance_q_H = machine.resistance_ohm = NAN;
    says_nothing();
    drive.inductance_d_H = 0.2;
    drive.inductance_q_H = 0.3;
    drive.resistance_ohm = 0.1;
    drive.kp_ohm = 1e3;
    text_has("an inductance of 0.25 H with a resistance of 0.1 ohm", said());
    inductance[0].order = 2.0;
    inductance[0].cosine[HCI_AA] = 7.0;
    inductance[1].order = 0.0;
    inductance[1].cosine[HCI_AA] = 0.3;
    inductance[1].cosine[HCI_AB] = -0.1;
    machine.inductance = inductance;
    machine.inductance_count = 2;
    text_has("an inductance of 0.4 H with a resistance of 0.1 ohm", said());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_usual_values);
    RUN_TEST(test_samples_in_another_unit);
    RUN_TEST(test_a_frequency_in_another_unit);
    RUN_TEST(test_a_bandwidth_in_another_unit);
    RUN_TEST(test_an_inductance_in_another_unit);
    RUN_TEST(test_where_the_inductance_is_from);
    return UNITY_END();
}
