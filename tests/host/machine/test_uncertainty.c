/* uncertainty.csv and measured.csv, and the ripple that is expected of them, which has a closed form where
 * one order is uncertain: 2√(S² + C²) from peak to peak, and for S and C with the standard deviation σ an
 * amplitude of σ√(−2 ln 0.05) that one in twenty exceeds. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/machine/machine.h"
#include "hci/host/machine/uncertainty.h"
#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/machine/expected_ripple.h"
#include "host/solution/expect.h"
#include "support/files.h"
#include "support/reference.h"
#include "unity.h"

enum { POLE_PAIRS = 2, SAMPLES = 256, MACHINES = 199 };

#define MEAN_NM 3.0

static const hci_wave EMF = {1.0, 1, 0.2, 0.0};
static const hci_machine MACHINE = {.pole_pairs = POLE_PAIRS, .back_emf = &EMF, .back_emf_count = 1};

static hci_uncertainty uncertainty;
static hci_sample sample[SAMPLES];
static double torque_Nm[SAMPLES];
static hci_note note;

void setUp(void)
{
    files_begin();
    note.text[0] = '\0';
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_uncertainty_release(&uncertainty);
    files_end();
}

/* ---- files ---- */

static const char TERMS[] = "effect,parameter,value,unit,departures\n"
                            "cogging,sine_18,0.02,Nm,0.001 -0.0002 0\n"
                            "saturation,d1q2_cosine_0,0,Nm,1e-7 0 -0.5\n"
                            "saturation,reference_current,12,A,0 0 0\n";

static const char RUNS[] =
    "file,id_least_A,id_most_A,iq_least_A,iq_most_A,speed_least_rad_per_s,speed_most_rad_per_s,"
    "misfit\n"
    "\"runs/a,b.csv\",-3,0,0,6,10,12,1.25\n"
    "runs/c.csv,0,2.5,-1,1,,,\n";

/* One more, which covers nothing that those do not. */
static const char THREE_RUNS[] =
    "file,id_least_A,id_most_A,iq_least_A,iq_most_A,speed_least_rad_per_s,speed_most_rad_per_s,"
    "misfit\n"
    "\"runs/a,b.csv\",-3,0,0,6,10,12,1.25\n"
    "runs/c.csv,0,2.5,-1,1,,,\n"
    "runs/d.csv,0,0,0,0,,,1\n";

static hci_status read_texts(const char *terms, const char *measured)
{
    note.text[0] = '\0';
    files_write(files_path("uncertainty.csv"), terms);
    files_write(files_path("measured.csv"), measured);
    return hci_uncertainty_read_machine(files_root, &uncertainty, &note);
}

static void write_all(void)
{
    hci_output *output;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_output_open(files_root, &output, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_uncertainty_write(output, &uncertainty, &note));
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_output_commit(output, &note), note.text);
}

static void check_file(const char *name, const char *text)
{
    char *found = files_read(files_path(name));
    TEST_ASSERT_EQUAL_STRING(text, found);
    free(found);
}

static void test_what_is_read_is_written_again(void)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_texts(TERMS, RUNS), note.text);
    TEST_ASSERT_EQUAL_UINT(3, uncertainty.machines);
    TEST_ASSERT_EQUAL_UINT(2, uncertainty.runs);
    TEST_ASSERT_EQUAL_STRING("runs/a,b.csv", uncertainty.run[0].file);
    TEST_ASSERT_TRUE(isnan(uncertainty.run[1].misfit));
    files_remove(files_path("uncertainty.csv"));
    files_remove(files_path("measured.csv"));
    write_all();
    check_file("uncertainty.csv", TERMS);
    check_file("measured.csv", RUNS);
}

/* Rows may stand in any order; departures stay with their term. */
static void test_rows_in_any_order(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, read_texts("effect,parameter,value,unit,departures\n"
                                             "cogging,sine_24,0.5,Nm,7 8\n"
                                             "cogging,sine_18,0.25,Nm,5 6\n",
                                             RUNS));
    TEST_ASSERT_EQUAL_DOUBLE(0.25, uncertainty.effects.term[0].value);
    TEST_ASSERT_EQUAL_DOUBLE(6.0, uncertainty.departure[1]);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, uncertainty.departure[2]);
}

static void test_all_recordings_together(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, read_texts(TERMS, RUNS));
    const hci_measured_run all = hci_uncertainty_measured(&uncertainty);
    TEST_ASSERT_EQUAL_DOUBLE(-3.0, all.id_A.least);
    TEST_ASSERT_EQUAL_DOUBLE(2.5, all.id_A.most);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, all.iq_A.least);
    TEST_ASSERT_EQUAL_DOUBLE(6.0, all.iq_A.most);
    TEST_ASSERT_EQUAL_DOUBLE(12.0, all.speed_rad_per_s.most);
}

static void test_no_files_are_no_knowledge(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_uncertainty_read_machine(files_root, &uncertainty, &note));
    TEST_ASSERT_EQUAL_UINT(0, uncertainty.machines);
    read_texts(TERMS, RUNS);
    hci_uncertainty_release(&uncertainty);
    write_all();
    TEST_ASSERT_EQUAL_INT(0, files_count(files_root));
}

/* ---- diagnosis.csv ---- */

static hci_status read_diagnosis(const char *text)
{
    note.text[0] = '\0';
    hci_uncertainty_release(&uncertainty);
    files_write(files_path("diagnosis.csv"), text);
    return hci_uncertainty_read_machine(files_root, &uncertainty, &note);
}

static const char PARTLY[] =
    "name,value,unit\nverdict,partly explained,\nsearch,limited,\nunexplained_ripple,0.0123,Nm\n";

static void test_origin_is_written_again(void)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_diagnosis(PARTLY), note.text);
    TEST_ASSERT_EQUAL_STRING("limited", uncertainty.origin.search);
    TEST_ASSERT_TRUE(hci_machine_origin_is_doubtful(&uncertainty.origin));
    files_remove(files_path("diagnosis.csv"));
    write_all();
    check_file("diagnosis.csv", PARTLY);
    TEST_ASSERT_EQUAL_INT(HCI_OK, read_diagnosis("name,value,unit\nverdict,explained,\nsearch,complete,\n"));
    TEST_ASSERT_FALSE(hci_machine_origin_is_doubtful(&uncertainty.origin));
    TEST_ASSERT_TRUE(isnan(uncertainty.origin.unexplained_Nm));
}

static void test_origin_that_is_wrong(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, read_diagnosis("name,value,unit\nverdict,perhaps,\n"));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "diagnosis.csv:2"), note.text);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, read_diagnosis("name,value,unit\nsearch,limited,\nveredict,x,\n"));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "veredict"), note.text);
}

static void check_refused(const char *terms, const char *measured, const char *words)
{
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, read_texts(terms, measured));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, words), note.text);
    TEST_ASSERT_NULL(uncertainty.departure);
}

static void test_files_that_are_wrong(void)
{
    check_refused("effect,parameter,value,unit,departures\ncogging,sine_18,0.02,Nm,0.1 x\n", RUNS,
                  "uncertainty.csv:2: column 5 `departures`");
    check_refused(
        "effect,parameter,value,unit,departures\ncogging,sine_18,0.02,Nm,1 2\ncogging,sine_6,0,Nm,1\n", RUNS,
        "uncertainty.csv:3: column 5 `departures`");
    check_refused("effect,parameter,value,unit,departures\ncogging,sine_18,0.02,Nm,\n", RUNS, "departures");
    check_refused("effect,parameter,value,unit,departures\n", RUNS, "no rows");
    check_refused("effect,parameter,value,unit\ncogging,sine_18,0.02,Nm\n", RUNS, "departures");
    check_refused("effect,parameter,value,unit,departures\ngremlin,sine_18,0.02,Nm,1\n", RUNS, "gremlin");
    check_refused(TERMS, "file,id_least_A\nruns/a.csv,1\n", "id_most_A");
    files_remove(files_path("measured.csv"));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_uncertainty_read_machine(files_root, &uncertainty, &note));
}

/* ---- whose it is ---- */

static hci_effect_term terms_of_18[] = {{0, 18.0, 0.02, NAN}, {0, 24.0, 0.0, NAN}};

static hci_effects cogging_of(double value, size_t count)
{
    static hci_effect effect;
    terms_of_18[0].value = value;
    effect = (hci_effect){hci_effect_type_find("cogging"), terms_of_18, count};
    return (hci_effects){&effect, 1};
}

static void test_belongs_to_one_list_of_effects(void)
{
    const hci_effects none = {NULL, 0};
    TEST_ASSERT_EQUAL_INT(HCI_OK, read_texts(TERMS, RUNS));
    hci_effects same = cogging_of(0.02, 1);
    TEST_ASSERT_TRUE(hci_uncertainty_is_of(&uncertainty, &same));
    same = cogging_of(0.0201, 1);
    TEST_ASSERT_FALSE(hci_uncertainty_is_of(&uncertainty, &same));
    same = cogging_of(0.02, 2);
    terms_of_18[1].value = 1e-9;
    TEST_ASSERT_FALSE(hci_uncertainty_is_of(&uncertainty, &same));
    terms_of_18[1].value = 0.0;
    TEST_ASSERT_FALSE(hci_uncertainty_is_of(&uncertainty, &none));
}

/* ---- ripple ---- */

/* Machines with cogging torque of order 12 whose amplitudes are those that 1/200, 2/200 … of all fall below
 * where sine and cosine have the standard deviation σ. */
static void allow_cogging(double sigma_Nm)
{
    char text[8192] = "effect,parameter,value,unit,departures\ncogging,sine_12,0,Nm,";
    for (int of_cosine = 0; of_cosine < 2; ++of_cosine) {
        for (int m = 1; m <= MACHINES; ++m) {
            const double amplitude = sigma_Nm * sqrt(-2.0 * log(1.0 - m / (MACHINES + 1.0)));
            const size_t used = strlen(text);
            snprintf(text + used, sizeof text - used, " %.9g",
                     amplitude * (of_cosine ? cos(2.0 * m) : sin(2.0 * m)));
        }
        strcat(text, of_cosine ? "\n" : "\ncogging,cosine_12,0,Nm,");
    }
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_texts(text, THREE_RUNS), note.text);
}

/* A constant current in the rotor frame over one turn, and the mean torque alone. */
static hci_ripple_path path_of(double d, double q)
{
    static const hci_effects NONE = {NULL, 0};
    for (size_t k = 0; k < SAMPLES; ++k) {
        const double theta = 2.0 * REF_PI * (double)k / SAMPLES;
        sample[k] = (hci_sample){.theta_m_rad = theta / POLE_PAIRS};
        hci_clarke_inverse(hci_park_inverse((hci_dq){d, q, 0.0}, theta), sample[k].i_abc);
        torque_Nm[k] = MEAN_NM;
    }
    return (hci_ripple_path){.machine = &MACHINE,
                             .effects = &NONE,
                             .sample = sample,
                             .torque_Nm = torque_Nm,
                             .count = SAMPLES,
                             .turns = 1,
                             .speed_rad_per_s = NAN};
}

static hci_expected_ripple expect(const hci_ripple_path *path)
{
    hci_expected_ripple e;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_expected_ripple_find(path, &uncertainty, &e, &note));
    return e;
}

static void test_one_uncertain_order(void)
{
    const double sigma_Nm = 0.01, amplitude_Nm = sigma_Nm * sqrt(-2.0 * log(0.05));
    const hci_ripple_path path = path_of(0.0, 1.0);
    allow_cogging(sigma_Nm);
    const hci_expected_ripple e = expect(&path);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_KNOWN, e.state);
    /* 21 samples in a period: less than 1 − cos(π/21) is between them */
    TEST_ASSERT_DOUBLE_WITHIN(0.012 * 2.0 * amplitude_Nm, 2.0 * amplitude_Nm, e.peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, e.peak_to_peak_Nm, e.error_peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 * e.peak_to_peak_Nm / MEAN_NM, e.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * e.T_ripple_percent, e.T_ripple_percent * sqrt(log(0.5) / log(0.05)),
                              e.middle_percent);
    TEST_ASSERT_EQUAL_DOUBLE(12.0, e.worst_order);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, amplitude_Nm, e.worst_order_Nm);
}

/* Machines whose torque per ampere is off by 1, 2 … ten-thousandths, one way and the other: that is their
 * mean, and no ripple. */
static void test_the_mean_is_told_apart(void)
{
    static char text[16384] = "effect,parameter,value,unit,departures\nback_emf,sine_1,0,Nm_per_A,";
    char words[1024];
    hci_ripple_path path = path_of(0.0, 2.0);
    for (int m = 1; m <= MACHINES; ++m)
        snprintf(text + strlen(text), 32, " %.9g", (m % 2 ? -1e-4 : 1e-4) * m);
    strcat(text, "\ncogging,sine_12,0,Nm,");
    for (int m = 1; m <= MACHINES; ++m)
        strcat(text, m % 3 ? " 1e-5" : " -1e-5");
    strcat(text, "\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_texts(text, THREE_RUNS), note.text);
    hci_expected_ripple e = expect(&path);
    const double off_Nm = 1.5 * 2.0 * 1e-4 * ceil(0.95 * (MACHINES + 1));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, MEAN_NM, e.mean_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, off_Nm, e.mean_error_Nm);
    TEST_ASSERT_TRUE(e.error_peak_to_peak_Nm < 2.1e-5);
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "Mean torque 3 N·m, at most 0.057 N·m off (95 %)"), words);
    path.turns = 0; /* a mean of a part of a turn is none */
    e = expect(&path);
    TEST_ASSERT_TRUE(isnan(e.mean_Nm) && isnan(e.mean_error_Nm));
}

/* Ripple of the model is part of the torque's, and none of the error's; what is wanted is no error of an
 * order. */
static void test_ripple_of_the_model(void)
{
    hci_ripple_path path = path_of(0.0, 1.0);
    allow_cogging(1e-6);
    for (size_t k = 0; k < SAMPLES; ++k)
        torque_Nm[k] += 0.3 * sin(6.0 * 2.0 * REF_PI * (double)k / SAMPLES);
    hci_expected_ripple e = expect(&path);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.6, e.peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.0, e.error_peak_to_peak_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(6.0, e.worst_order);
    path.wanted_Nm = torque_Nm;
    e = expect(&path);
    TEST_ASSERT_EQUAL_DOUBLE(12.0, e.worst_order);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.6, e.peak_to_peak_Nm);
}

/* Order 512, of which 1024 samples of a turn would see the zeros alone. */
static void test_an_order_above_those_of_a_solution(void)
{
    static char text[4096] = "effect,parameter,value,unit,departures\ncogging,sine_512,0,Nm,";
    hci_solved_order mean = {.torque_Nm = {0.0, 0.0, MEAN_NM}, .target_Nm = {0.0, 0.0, MEAN_NM}};
    hci_wave sine = {1.0, 1, 1.0, 0.0};
    hci_solution s = {.order = &mean, .order_count = 1, .period_turns = 1};
    s.current.wave = &sine;
    s.current.count = 1;
    for (int m = 1; m <= MACHINES; ++m)
        strcat(text, m % 2 ? " 0.01" : " -0.01");
    strcat(text, "\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_texts(text, THREE_RUNS), note.text);
    hci_solve_options options = {.uncertainty = &uncertainty};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_solution_expect(&MACHINE, &options, &s, &note));
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_KNOWN, s.expected.state);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.02, 0.02, s.expected.peak_to_peak_Nm);
}

/* RUNS: i_d −3 … 2.5 A, i_q −1 … 6 A. */
static void test_currents_outside(void)
{
    hci_ripple_path path = path_of(-3.0, 6.0);
    allow_cogging(0.01);
    hci_expected_ripple e = expect(&path);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, e.outside_share);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, e.outside_A);
    TEST_ASSERT_FALSE(e.speed_outside);
    path = path_of(-6.0, 10.0);
    path.speed_rad_per_s = 13.0;
    e = expect(&path);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, e.outside_share);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 5.0, e.outside_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -6.0, e.id_A.least);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0, e.iq_A.most);
    TEST_ASSERT_TRUE(e.speed_outside);
}

/* A power of the current that is uncertain: the third grows 2³ times from one current to twice that. */
/* A mean torque is bounded along what was recorded: two runs, one of them without a current, are a line of
 * the plane, and not all of the box around it; without a load nothing bounds it. */
static void test_mean_of_currents_that_were_not_recorded(void)
{
    static const char HEAD[] =
        "file,id_least_A,id_most_A,iq_least_A,iq_most_A,speed_least_rad_per_s,speed_most_rad_per_s,misfit\n";
    static const char *const REST[2] = {
        "a.csv,0,0,0,0,1,1,1\nb.csv,-30,-30,52,52,1,1,1\nc.csv,0,0,0,0,1,1,1\n",
        "a.csv,0,0,0,0,1,1,1\nb.csv,0,0,0,0,1,1,1\nc.csv,0,0,0,0,1,1,1\n"};
    static const struct {
        int runs;
        double d_A, q_A;
        bool is_bounded;
        const char *words;
    } CASE[] = {{0, -15.0, 26.0, true, "at most"},
                {0, -30.0, 20.0, false, "3 N·m in the model: how far it is off is not known"},
                {0, 0.0, 40.0, false, "no torque of such currents was recorded"},
                {1, 0.0, 4.0, false, "no torque under load was recorded"}};
    char terms[16384], words[1024];
    int m;
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        char runs[512];
        hci_ripple_path path = path_of(CASE[k].d_A, CASE[k].q_A);
        snprintf(runs, sizeof runs, "%s%s", HEAD, REST[CASE[k].runs]);
        strcpy(terms, "effect,parameter,value,unit,departures\ncogging,sine_12,0,Nm,");
        for (m = 1; m <= MACHINES; ++m)
            strcat(terms, m % 3 ? " 1e-3" : " -1e-3");
        strcat(terms, "\n");
        hci_uncertainty_release(&uncertainty);
        TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_texts(terms, runs), note.text);
        const hci_expected_ripple e = expect(&path);
        TEST_ASSERT_EQUAL_INT(CASE[k].is_bounded, isfinite(e.mean_error_Nm));
        hci_expected_ripple_words(&e, words, sizeof words);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, CASE[k].words), words);
    }
}

static void test_grows_with_the_current(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, read_texts("effect,parameter,value,unit,departures\n"
                                             "saturation,d0q3_sine_12,0,Nm,0.001 -0.002 0.0005\n"
                                             "saturation,reference_current,1,A,0 0 0\n",
                                             RUNS));
    hci_ripple_path path = path_of(0.0, 1.0);
    const double once = expect(&path).error_peak_to_peak_Nm;
    path = path_of(0.0, 2.0);
    TEST_ASSERT_TRUE(once > 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8.0 * once, expect(&path).error_peak_to_peak_Nm);
}

static void test_not_known(void)
{
    const hci_effects other = cogging_of(0.5, 1);
    char words[1024];
    hci_ripple_path path = path_of(0.0, 1.0);
    hci_expected_ripple e = expect(&path);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_NO_RECORDINGS, e.state);
    TEST_ASSERT_TRUE(isnan(e.T_ripple_percent) && isnan(e.peak_to_peak_Nm) && isnan(e.outside_A));
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL(strstr(words, "not known: no recordings"));
    TEST_ASSERT_NULL(strpbrk(words, "0123456789"));
    allow_cogging(0.01);
    path.effects = &other;
    e = expect(&path);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_OTHER_EFFECTS, e.state);
    TEST_ASSERT_TRUE(isnan(e.T_ripple_percent));
}

/* Of one or two recordings parts tell how large errors are: nothing of far away. */
static void test_too_far_for_two_recordings(void)
{
    char words[1024];
    TEST_ASSERT_EQUAL_INT(HCI_OK, read_texts("effect,parameter,value,unit,departures\n"
                                             "cogging,sine_12,0,Nm,0.001 -0.002 0.0005\n",
                                             RUNS));
    hci_ripple_path path = path_of(0.0, 8.9); /* half as much again as 6 A is 9 A */
    hci_expected_ripple e = expect(&path);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_KNOWN, e.state);
    TEST_ASSERT_EQUAL_UINT(2, e.recordings);
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "by parts of 2 recordings"), words);
    path = path_of(0.0, 9.1);
    e = expect(&path);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_TOO_FAR, e.state);
    TEST_ASSERT_TRUE(isnan(e.peak_to_peak_Nm));
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "far outside of what one or two recordings show"), words);
}

/* What the cut of a table adds is in the bound and in the words; of one order it is no more than of a square
 * wave. */
static void test_a_table_is_in_the_bound(void)
{
    char words[1024];
    hci_ripple_path path = path_of(0.0, 1.0);
    allow_cogging(0.01);
    const hci_expected_ripple bare = expect(&path);
    hci_expected_ripple e = bare;
    hci_expected_ripple_add_table(&e, 0.003, 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bare.peak_to_peak_Nm + 0.003, e.peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bare.error_peak_to_peak_Nm + 0.003, e.error_peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bare.T_ripple_percent + 0.15, e.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bare.worst_order_Nm + 0.006 / HCI_PI, e.worst_order_Nm);
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "makes 0.003 N\xC2\xB7m"), words);
    hci_expected_ripple_words(&bare, words, sizeof words);
    TEST_ASSERT_NULL_MESSAGE(strstr(words, "the table"), words);
}

/* And so are the steps of a recorded angle. */
static void test_steps_of_the_angle_are_in_the_bound(void)
{
    char words[1024];
    hci_ripple_path path = path_of(0.0, 1.0);
    allow_cogging(0.01);
    const hci_expected_ripple bare = expect(&path);
    hci_expected_ripple e = bare;
    hci_expected_ripple_add_angle(&e, 0.004, 2.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.004, e.angle_peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bare.peak_to_peak_Nm + 0.004, e.peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, bare.T_ripple_percent + 0.2, e.T_ripple_percent);
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "Of that 0.004 N·m are for the steps of the recorded angle"),
                                 words);
    hci_expected_ripple_words(&bare, words, sizeof words);
    TEST_ASSERT_NULL(strstr(words, "recorded angle"));
}

/* No bound beside a load that turns with the shaft, whoever asks: it is in the file, and is written again. */
static void test_turning_load(void)
{
    static const char TURNING[] = "name,value,unit\nverdict,explained,\nsearch,complete,\n"
                                  "unexplained_ripple,0,Nm\nturning_load,0.4,Nm\n";
    char words[1024];
    const hci_ripple_path path = path_of(0.0, 1.0);
    files_write(files_path("diagnosis.csv"), TURNING);
    allow_cogging(0.01);
    const hci_expected_ripple e = expect(&path);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_SWAYED, e.state);
    TEST_ASSERT_TRUE(isnan(e.peak_to_peak_Nm) && isnan(e.mean_error_Nm));
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "a load once or twice a turn"), words);
    files_remove(files_path("diagnosis.csv"));
    write_all();
    check_file("diagnosis.csv", TURNING);
}

/* Where the means of the recordings alone are not explained, the ripple is, and is said to be. */
static void test_left_means(void)
{
    static const char MEANS[] = "name,value,unit\nverdict,partly explained,\nsearch,complete,\n"
                                "unexplained_ripple,0,Nm\nleft_means,0.3,Nm\n";
    char words[1024];
    const hci_ripple_path path = path_of(0.0, 1.0);
    files_write(files_path("diagnosis.csv"), MEANS);
    allow_cogging(0.01);
    const hci_expected_ripple e = expect(&path);
    TEST_ASSERT_FALSE(hci_expected_ripple_is_doubtful(&e));
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_KNOWN, e.state);
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "of their mean torques 0.3 N\xC2\xB7m rms are not"), words);
    TEST_ASSERT_NULL_MESSAGE(strstr(words, "the model alone"), words);
    files_remove(files_path("diagnosis.csv"));
    write_all();
    check_file("diagnosis.csv", MEANS);
}

/* What no machine that the recordings allow has is in the bound, and said: an order that may be of the
 * current sensors, of which the table adds both sides where it is not there, and what the model leaves. */
static void test_untold(void)
{
    static const char UNTOLD[] = "name,value,unit\nverdict,explained,\nsearch,complete,\n"
                                 "unexplained_ripple,0,Nm\nsensor_zero,0.2,Nm\nleft_orders,0.05,Nm\n";
    char words[1024];
    const hci_ripple_path path = path_of(0.0, 1.0);
    allow_cogging(0.01);
    const hci_expected_ripple bare = expect(&path);
    files_write(files_path("diagnosis.csv"), UNTOLD);
    hci_uncertainty_release(&uncertainty);
    allow_cogging(0.01);
    const hci_expected_ripple e = expect(&path);
    const double left_Nm = 0.05 - bare.error_peak_to_peak_Nm;
    TEST_ASSERT_TRUE(left_Nm > 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, left_Nm, e.left_peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bare.peak_to_peak_Nm + 0.4 + left_Nm, e.peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.4 + 0.05, e.error_peak_to_peak_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bare.mean_error_Nm, e.mean_error_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, e.worst_order);
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "0.4 N\xC2\xB7m are for order 1"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "N\xC2\xB7m are for orders that"), words);
    hci_expected_ripple_words(&bare, words, sizeof words);
    TEST_ASSERT_NULL_MESSAGE(strstr(words, "are for order"), words);
    files_remove(files_path("diagnosis.csv"));
    write_all();
    check_file("diagnosis.csv", UNTOLD);
}

/* No exponent, and no zero: a limit is rounded up, so that what is said is no less than what was found. */
/* A rectangular wave has a fifth of its fundamental at order 5: twice that is where belief ends. */
static void test_what_holds_for_the_model_alone(void)
{
    hci_effects_data data = {0};
    char words[1024];
    files_write(files_path("effects.csv"),
                "effect,parameter,value,unit,std_error\nback_emf,sine_5,0.079,Nm_per_A,\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_effects_read_machine(files_root, &data, &note), note.text);
    hci_ripple_path path = path_of(0.0, 1.0);
    path.effects = &data.list;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_diagnosis(PARTLY), note.text);
    hci_expected_ripple e = expect(&path);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_UNEXPLAINED, e.state);
    TEST_ASSERT_TRUE(hci_expected_ripple_is_doubtful(&e) && isnan(e.unbelievable_order));
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "is partly explained, and its search ended early"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "another 0.012 N\xC2\xB7m rms"), words);
    strcpy(e.origin.verdict, "explained"); /* as far as the search came */
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NULL_MESSAGE(strstr(words, "has not explained"), words);
    TEST_ASSERT_NULL_MESSAGE(strstr(words, "diagnosis is explained"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "ended before all had been compared"), words);
    files_remove(files_path("diagnosis.csv"));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_uncertainty_read_machine(files_root, &uncertainty, &note));
    e = expect(&path);
    TEST_ASSERT_FALSE(hci_expected_ripple_is_doubtful(&e));
    data.term[0].value = 0.081;
    e = expect(&path);
    hci_effects_release(&data);
    TEST_ASSERT_TRUE(hci_expected_ripple_is_doubtful(&e));
    TEST_ASSERT_EQUAL_DOUBLE(5.0, e.unbelievable_order);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.405, e.unbelievable_share);
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "order 5 is 40 % of the fundamental"), words);
}

static void test_figures_in_words(void)
{
    char words[1024];
    hci_ripple_path path = path_of(0.0, 1.0);
    allow_cogging(0.01);
    hci_expected_ripple e = expect(&path);
    e.T_ripple_percent = 261.0;
    e.peak_to_peak_Nm = 0.0000312;
    e.middle_percent = 99.6;
    e.worst_order_Nm = 1200.0;
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "at most 270 % of"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "0.000032 N·m from"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "stay below 100 %."), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "at most 1200 N·m off"), words);
    e.T_ripple_percent = 2.0;
    e.peak_to_peak_Nm = 0.10000000000001;
    e.middle_percent = 0.6;
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "at most 2 % of"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "0.1 N·m from"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "below 0.6 %."), words);
}

/* Machines that differ in nothing that makes torque here promise no ripple of 0. */
static void test_no_order_is_told(void)
{
    char words[1024];
    TEST_ASSERT_EQUAL_INT(HCI_OK, read_texts("effect,parameter,value,unit,departures\n"
                                             "reluctance,dd_cosine_0,0,H,0.001 -0.002 0.0005\n",
                                             RUNS));
    hci_ripple_path path = path_of(0.0, 1.0);
    const hci_expected_ripple e = expect(&path);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_UNTOLD, e.state);
    TEST_ASSERT_TRUE(isnan(e.T_ripple_percent) && isnan(e.peak_to_peak_Nm));
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "not known: the recordings tell of no order"), words);
}

static void test_words(void)
{
    char words[1024];
    hci_ripple_path path = path_of(0.0, 1.0);
    allow_cogging(0.01);
    hci_expected_ripple e = expect(&path);
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "at most 1.7 % of the mean torque (95 %)"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "lie within what was recorded (i_d -3 … 2.5 A"), words);
    path = path_of(0.0, 10.0);
    e = expect(&path);
    hci_expected_ripple_words(&e, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "At 100 % of the angle"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "by up to 4 A"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "further outside than such a bound has been checked"), words);
}

static void test_memory(void)
{
    hci_expected_ripple e;
    const hci_ripple_path path = path_of(0.0, 1.0);
    files_write(files_path("uncertainty.csv"), TERMS);
    files_write(files_path("measured.csv"), RUNS);
    hci_status status = HCI_ERROR_MEMORY;
    for (long count = 0; status == HCI_ERROR_MEMORY; ++count) {
        hci_memory_fail_after(count);
        status = hci_uncertainty_read_machine(files_root, &uncertainty, &note);
        TEST_ASSERT_TRUE(!status || !uncertainty.departure);
    }
    hci_memory_fail_after(-1);
    TEST_ASSERT_EQUAL_INT(HCI_OK, status);
    hci_uncertainty_release(&uncertainty);
    allow_cogging(0.01);
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, hci_expected_ripple_find(&path, &uncertainty, &e, &note));
    hci_memory_fail_after(1);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, hci_expected_ripple_find(&path, &uncertainty, &e, &note));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_table_is_in_the_bound);
    RUN_TEST(test_steps_of_the_angle_are_in_the_bound);
    RUN_TEST(test_what_is_read_is_written_again);
    RUN_TEST(test_rows_in_any_order);
    RUN_TEST(test_all_recordings_together);
    RUN_TEST(test_no_files_are_no_knowledge);
    RUN_TEST(test_files_that_are_wrong);
    RUN_TEST(test_origin_is_written_again);
    RUN_TEST(test_turning_load);
    RUN_TEST(test_left_means);
    RUN_TEST(test_untold);
    RUN_TEST(test_origin_that_is_wrong);
    RUN_TEST(test_belongs_to_one_list_of_effects);
    RUN_TEST(test_one_uncertain_order);
    RUN_TEST(test_the_mean_is_told_apart);
    RUN_TEST(test_ripple_of_the_model);
    RUN_TEST(test_an_order_above_those_of_a_solution);
    RUN_TEST(test_currents_outside);
    RUN_TEST(test_mean_of_currents_that_were_not_recorded);
    RUN_TEST(test_grows_with_the_current);
    RUN_TEST(test_not_known);
    RUN_TEST(test_too_far_for_two_recordings);
    RUN_TEST(test_what_holds_for_the_model_alone);
    RUN_TEST(test_figures_in_words);
    RUN_TEST(test_no_order_is_told);
    RUN_TEST(test_words);
    RUN_TEST(test_memory);
    return UNITY_END();
}
