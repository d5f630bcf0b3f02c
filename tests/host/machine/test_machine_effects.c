/* effects.csv, and effects on a simulated drive. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hci/host/machine/effects.h"
#include "host/base/memory.h"
#include "support/effect_list.h"
#include "support/files.h"
#include "support/plant_machine.h"
#include "unity.h"

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    files_end();
}

static hci_status read_text(const char *text, hci_effects_data *effects, hci_note *note)
{
    files_write(files_path("effects.csv"), text);
    note->text[0] = '\0';
    return hci_effects_read(files_path("effects.csv"), effects, note);
}

static hci_status write_effects(const hci_effects *effects, hci_note *note)
{
    hci_output *output;
    hci_status status = hci_output_open(files_root, &output, note);
    if (status) return status;
    status = hci_effects_write(output, effects, note);
    if (!status) return hci_output_commit(output, note);
    hci_output_discard(output);
    return status;
}

/* ---- files ---- */

static const char EVERYTHING[] = "effect,parameter,value,unit,std_error\n"
                                 "cogging,sine_18,0.02,Nm,0.0013\n"
                                 "cogging,sine_36,-0.1,Nm,\n"
                                 "cogging,cosine_18,1e-7,Nm,0\n"
                                 "back_emf,sine_5,0.3333333333333333,Nm_per_A,0.1\n"
                                 "back_emf,neg_cosine_1,0.01,Nm_per_A,\n"
                                 "phase_imbalance,b,-0.02,1,0.001\n"
                                 "reluctance,dd_cosine_0,0.002,H,\n"
                                 "saturation,d1q2_cosine_0,-2.5,Nm,\n"
                                 "saturation,reference_current,12,A,\n"
                                 "magnet_temperature,emf_per_kelvin,-0.0011,1/K,0.0001\n"
                                 "magnet_temperature,reference,25,C,\n"
                                 "mechanical_order,sine_0.14285714285714285,0.02,Nm,\n"
                                 "mechanical_order,iq_cosine_0.5,0.001,Nm_per_A,\n"
                                 "friction,coulomb,0.01,Nm,\n"
                                 "friction,viscous,0.001,Nms_per_rad,\n"
                                 "friction,quadratic,1e-5,Nms2_per_rad2,\n"
                                 "channel_delay,current,2e-5,s,\n"
                                 "position_eccentricity,mech_sine_1,0.001,rad,\n"
                                 "position_offset,angle,0.02,rad,0.004\n"
                                 "current_gain,a,0.01,1,\n"
                                 "current_offset,c,-0.05,A,\n"
                                 "torque_sensor,time_constant,0.002,s,\n"
                                 "torque_sensor,natural_frequency,120,Hz,\n"
                                 "torque_sensor,offset,0.1,Nm,\n";

static void test_round_trip_to_the_byte(void)
{
    hci_effects_data effects;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_text(EVERYTHING, &effects, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(14, effects.list.count);
    TEST_ASSERT_EQUAL_UINT64(24, hci_effects_terms(&effects.list));
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, write_effects(&effects.list, &note), note.text);
    TEST_ASSERT_EQUAL_STRING(EVERYTHING, files_read(files_path("effects.csv")));
    hci_effects_release(&effects);
    TEST_ASSERT_NULL(effects.term);
}

static void test_values_units_and_order_of_rows(void)
{
    hci_effects_data effects;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK,
                              read_text("# by hand\r\n"
                                        "Effect;Parameter;Value;Unit;Std_error\r\n"
                                        "current_offset;b;50;mA;2\r\n"
                                        "cogging;cosine_6;12,5;mN·m;\r\n"
                                        "position_offset;angle;90;deg;1\r\n"
                                        "current_offset;a;-0,1;A;0,01\r\n"
                                        "cogging;sine_6;3;-;\r\n",
                                        &effects, &note),
                              note.text);
    const hci_effect *e = effects.list.effect;
    TEST_ASSERT_EQUAL_UINT64(3, effects.list.count);
    TEST_ASSERT_EQUAL_STRING("cogging", e[0].type->name);
    TEST_ASSERT_EQUAL_UINT64(2, e[0].count);
    TEST_ASSERT_EQUAL_DOUBLE(6.0, e[0].term[0].order);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, e[0].term[0].value);
    TEST_ASSERT_EQUAL_DOUBLE(12.5e-3, e[0].term[1].value);
    TEST_ASSERT_TRUE(isnan(e[0].term[1].std_error));
    TEST_ASSERT_EQUAL_STRING("position_offset", e[1].type->name);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, REF_PI / 2.0, e[1].term[0].value);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, REF_PI / 180.0, e[1].term[0].std_error);
    TEST_ASSERT_EQUAL_DOUBLE(-0.1, e[2].term[0].value);
    TEST_ASSERT_EQUAL_DOUBLE(0.05, e[2].term[1].value);
    TEST_ASSERT_EQUAL_DOUBLE(0.002, e[2].term[1].std_error);
    hci_effects_release(&effects);
}

static void test_fewer_columns(void)
{
    hci_effects_data effects;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(HCI_OK, read_text("effect,parameter,value\ncogging,sine_6,0.02\n", &effects, &note));
    TEST_ASSERT_EQUAL_DOUBLE(0.02, effects.term[0].value);
    TEST_ASSERT_TRUE(isnan(effects.term[0].std_error));
    hci_effects_release(&effects);
    TEST_ASSERT_EQUAL(HCI_OK, read_text("effect,parameter,value,unit,std_error\n", &effects, &note));
    TEST_ASSERT_EQUAL_UINT64(0, effects.list.count);
    hci_effects_release(&effects);
}

typedef struct {
    const char *row, *line, *words[3];
} bad_file;

static const bad_file BAD[] = {
    {"coging,sine_6,1,Nm,", "effects.csv:2:", {"`coging`", "one of cogging, back_emf", "mechanical_order"}},
    {"unknown,sine_6,1,Nm,", "effects.csv:2:", {"`unknown`", "torque_sensor", "effect"}},
    {"cogging,sin_6,1,Nm,", "effects.csv:2:", {"`sin_6`", "sine_ORDER, cosine_ORDER", "parameter"}},
    {"cogging,sine,1,Nm,", "effects.csv:2:", {"`sine`", "sine_ORDER", "parameter"}},
    {"cogging,sine_six,1,Nm,", "effects.csv:2:", {"`sine_six`", "sine_ORDER", "parameter"}},
    {"cogging,sine_nan,1,Nm,", "effects.csv:2:", {"`sine_nan`", "sine_ORDER", "parameter"}},
    {"cogging,sine_-6,1,Nm,", "effects.csv:2:", {"`sine_-6`", "an order above 0", "parameter"}},
    {"cogging,cosine_0,1,Nm,", "effects.csv:2:", {"`cosine_0`", "an order above 0", "parameter"}},
    {"back_emf,sine_0.5,1,Nm_per_A,", "effects.csv:2:", {"`sine_0.5`", "an order from 1", "parameter"}},
    {"back_emf,sine_1.5,1,Nm_per_A,", "effects.csv:2:", {"`sine_1.5`", "a whole order", "mechanical_order"}},
    {"reluctance,dd_cosine_-1,1,H,",
     "effects.csv:2:",
     {"`dd_cosine_-1`", "an order of 0 or more", "parameter"}},
    {"friction,coulomb_1,1,Nm,",
     "effects.csv:2:",
     {"`coulomb_1`", "coulomb, viscous, quadratic", "parameter"}},
    {"cogging,sine_6,1,rad,", "effects.csv:2:", {"`rad`", "converts to Nm", "unit"}},
    {"magnet_temperature,emf_per_kelvin,1,C,", "effects.csv:2:", {"`C`", "converts to 1/K", "unit"}},
    {"cogging,sine_6,much,Nm,", "effects.csv:2:", {"`much`", "a finite number", "value"}},
    {"cogging,sine_6,,Nm,", "effects.csv:2:", {"an empty cell", "a finite number", "value"}},
    {"cogging,sine_6,1,Nm,-1", "effects.csv:2:", {"`-1`", "0 or more", "std_error"}},
    {"cogging,sine_6,1,Nm,x", "effects.csv:2:", {"`x`", "a finite number", "std_error"}},
    {"saturation,reference_current,0,A,", "effects.csv:2:", {"`0`", "at least 1e-06 in A", "value"}},
    {"torque_sensor,time_constant,-1,s,", "effects.csv:2:", {"`-1`", "at least 0 in s", "value"}},
    {"current_gain,a,-100,%,", "effects.csv:2:", {"`-100`", "at least -0.999 in 1", "value"}},
    {"cogging,sine_6,1,Nm,\ncogging,sine_6.0,2,Nm,", "effects.csv:3:", {"`sine_6.0`", "once", "join"}},
    {"cogging,sine_6,1,Nm,\nfriction,coulomb,2,Nm,\ncogging,sine_6.0000001,1,Nm,",
     "effects.csv:4:",
     {"once", "join", "parameter"}},
    {"cogging,sine_6,1", "effects.csv:2:", {"", "", ""}},
};

static void test_bad_files(void)
{
    for (size_t k = 0; k < sizeof BAD / sizeof *BAD; ++k) {
        char text[512];
        hci_effects_data effects;
        hci_note note = {{0}};
        snprintf(text, sizeof text, "effect,parameter,value,unit,std_error\n%s\n", BAD[k].row);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_INPUT, read_text(text, &effects, &note), BAD[k].row);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, BAD[k].line), note.text);
        for (int w = 0; w < 3; ++w)
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, BAD[k].words[w]), note.text);
        TEST_ASSERT_NULL(effects.effect);
        TEST_ASSERT_NULL(effects.term);
        TEST_ASSERT_EQUAL_UINT64(0, effects.list.count);
    }
}

static void test_missing_column(void)
{
    hci_effects_data effects;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_text("effect,value,unit\ncogging,1,Nm\n", &effects, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "`parameter`"), note.text);
}

/* The longest list of names fits into a note with what stands around it. */
static void test_the_longest_list_is_whole(void)
{
    hci_effects_data effects;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(
        HCI_ERROR_INPUT,
        read_text("effect,parameter,value,unit,std_error\nsaturation,x,1,Nm,\n", &effects, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "reference_current"), note.text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "sine_18"), note.text);
}

/* ---- the page for users ---- */

static void test_examples_of_the_page_can_be_read(void)
{
    char line[512], text[640];
    size_t examples = 0;
    FILE *page = fopen("docs/effects.md", "r");
    TEST_ASSERT_NOT_NULL(page);
    while (fgets(line, sizeof line, page)) {
        hci_effects_data effects;
        hci_note note = {{0}};
        if (strncmp(line, "    ", 4) != 0 || strstr(line, "parameter,value")) continue;
        snprintf(text, sizeof text, "effect,parameter,value,unit,std_error\n%s", line);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_text(text, &effects, &note), note.text);
        TEST_ASSERT_EQUAL_UINT64(1, effects.list.count);
        hci_effects_release(&effects);
        ++examples;
    }
    fclose(page);
    TEST_ASSERT_TRUE(examples >= 20);
}

static bool page_has(const char *words)
{
    return strstr(files_read("docs/effects.md"), words) != NULL;
}

static void test_the_page_names_every_effect_and_parameter(void)
{
    const hci_effect_type *type;
    for (size_t r = 0; (type = hci_effect_type_at(r)) != NULL; ++r) {
        char words[64];
        snprintf(words, sizeof words, "### %s\n", type->name);
        TEST_ASSERT_TRUE_MESSAGE(page_has(words), words);
        for (size_t k = 0; k < type->parameter_count; ++k) {
            const hci_effect_parameter *p = &type->parameter[k];
            const bool saturation = p->name[0] == 'd' && p->name[2] == 'q' && p->ordered;
            snprintf(words, sizeof words, p->ordered ? saturation ? "`%.4s`" : "`%s_" : "`%s`", p->name);
            TEST_ASSERT_TRUE_MESSAGE(page_has(words), words);
        }
    }
}

static void test_machine_folder(void)
{
    hci_effects_data effects;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_effects_read_machine(files_root, &effects, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(0, effects.list.count);
    hci_effects_release(&effects);
    files_write(files_path("effects.csv"), EVERYTHING);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_effects_read_machine(files_root, &effects, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(14, effects.list.count);
    hci_effects_release(&effects);
    files_write(files_path("effects.csv"), "nonsense\n1\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_effects_read_machine(files_root, &effects, &note));
}

static void test_a_value_that_is_not_finite_is_not_written(void)
{
    el_list l = {0};
    hci_note note = {{0}};
    files_write(files_path("effects.csv"), "before");
    el_add(&l, "cogging", "sine", 6.0, INFINITY);
    TEST_ASSERT_EQUAL(HCI_ERROR_NOT_FINITE, write_effects(&l.list, &note));
    TEST_ASSERT_EQUAL_STRING("before", files_read(files_path("effects.csv")));
}

/* ---- a simulated drive ---- */

enum { POINTS = 4096, MOST_DELAY = 64, STEPS = 3000 };

static double rows[12 * (POINTS + 1)];
static double rings[HCI_SENSE_COUNT][MOST_DELAY];

/* From so far in a turn that the angle wraps on the way. */
static const double STEP = 20e-6, SPEED = 70.0, START = 5.0;

typedef struct {
    pm_lists lists;
    el_list effects;
    hci_drive drive;
    hci_sensor sensors[HCI_SENSE_COUNT];
    hci_sensor_state sensed[HCI_SENSE_COUNT];
    hci_plant_state plant;
    hci_effects_attachment *attachment;
} bench;

static void bench_make(bench *b)
{
    memset(b, 0, sizeof *b);
    pm_list(&PM_SINE, &b->lists);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_plant_table_fill(&b->lists.machine, &b->lists.given, POINTS, rows,
                                                       &b->drive.plant.table));
    b->drive.plant.resistance_ohm = 0.5;
    b->drive.plant.inertia_kgm2 = INFINITY;
    b->drive.control.step_s = STEP;
    b->plant.speed_rad_per_s = SPEED;
    b->plant.theta_m_rad = START;
}

static hci_status attach(bench *b, hci_note *note)
{
    const hci_effects_plant plant = {&b->lists.machine, &b->effects.list, 90.0};
    const hci_status status =
        hci_effects_attach(&plant, &b->plant, &b->drive, b->sensors, &b->attachment, note);
    for (int s = 0; s < HCI_SENSE_COUNT && !status; ++s) {
        TEST_ASSERT_TRUE(hci_sensor_workspace(&b->sensors[s]) <= MOST_DELAY);
        hci_sensor_start(&b->sensors[s], &b->sensed[s], rings[s], 1, 0.0);
    }
    return status;
}

static double angle_at(double t)
{
    return START + SPEED * t;
}

static double current_at(int s, double t)
{
    return 6.0 * sin(3.0 * angle_at(t) - 2.0 * REF_PI * s / 3.0 + 0.4);
}

/* One step with a sine of current in the true frame; what the sensors read at its start. */
static void bench_step(bench *b, int k, hci_sample *reading, double *torque)
{
    double abc[3];
    for (int s = 0; s < 3; ++s)
        abc[s] = current_at(s, k * STEP);
    hci_plane_from_abc(abc, b->plant.i);
    const double truth = hci_plant_torque_Nm(&b->drive.plant, &b->plant), angle = b->plant.theta_m_rad;
    const double i[2] = {b->plant.i[0], b->plant.i[1]};
    for (int s = 0; s < 3; ++s)
        reading->i_abc[s] = hci_sensor_read(&b->sensors[s], &b->sensed[s], abc[s], angle);
    reading->theta_m_rad =
        hci_sensor_read(&b->sensors[HCI_SENSE_ANGLE], &b->sensed[HCI_SENSE_ANGLE], angle, angle);
    *torque = hci_sensor_read(&b->sensors[HCI_SENSE_TORQUE], &b->sensed[HCI_SENSE_TORQUE], truth, angle);
    hci_plant_step_imposed(&b->drive.plant, &b->plant, i, 0.0, STEP);
}

static void all_on_the_bench(el_list *l)
{
    el_add(l, "cogging", "sine", 6.0, 0.3);
    el_add(l, "reluctance", "qq_sine", 6.0, 1e-3);
    el_add(l, "saturation", "d1q2_cosine", 0.0, -3e-4);
    el_add(l, "magnet_temperature", "emf_per_kelvin", 0.0, -0.001);
    el_add(l, "friction", "coulomb", 0.0, 0.2);
    el_add(l, "friction", "viscous", 0.0, 0.002);
    el_add(l, "friction", "quadratic", 0.0, 1e-5);
    el_add(l, "current_gain", "a", 0.0, 0.02);
    el_add(l, "current_offset", "b", 0.0, 0.1);
    el_add(l, "position_offset", "angle", 0.0, 0.05);
    el_add(l, "position_eccentricity", "mech_cosine", 1.0, 0.01);
    el_add(l, "channel_delay", "current", 0.0, 50e-6); /* two and a half steps */
    el_add(l, "channel_delay", "angle", 0.0, 130e-6);
    el_add(l, "channel_delay", "torque", 0.0, 215e-6);
    el_add(l, "torque_sensor", "time_constant", 0.0, 1e-3);
    el_add(l, "torque_sensor", "natural_frequency", 0.0, 400.0);
    el_add(l, "torque_sensor", "damping", 0.0, 0.5);
    el_add(l, "torque_sensor", "offset", 0.0, 0.15);
}

static double folded(double angle)
{
    return angle - 2.0 * REF_PI * floor(angle / (2.0 * REF_PI) + 0.5);
}

/* Between two steps a sensor interpolates: (3·70·20e-6)²/8 of 6 A is 1.3e-5 A. */
static void test_sensors_of_a_drive(void)
{
    static bench b;
    hci_note note = {{0}};
    bench_make(&b);
    all_on_the_bench(&b.effects);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, attach(&b, &note), note.text);
    TEST_ASSERT_EQUAL_PTR(b.sensors, b.drive.sensors);
    TEST_ASSERT_EQUAL_DOUBLE(0.2, b.drive.plant.coulomb_Nm);
    for (int k = 0; k < STEPS; ++k) {
        hci_sample x;
        double torque;
        bench_step(&b, k, &x, &torque);
        if (k < 20) continue;
        const double t = k * STEP, theta = angle_at(t - 130e-6);
        TEST_ASSERT_DOUBLE_WITHIN(2e-5, 1.02 * current_at(0, t - 50e-6), x.i_abc[0]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-5, current_at(1, t - 50e-6) + 0.1, x.i_abc[1]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-5, current_at(2, t - 50e-6), x.i_abc[2]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, 0.0, folded(theta + 0.01 * cos(theta) + 0.05 / 3.0 - x.theta_m_rad));
    }
    hci_effects_detach(b.attachment);
}

/* Simulating and predicting are one: from the readings of a drive its torque reading. */
static void test_prediction_of_a_simulated_drive(void)
{
    static bench b;
    static double time[STEPS], read[STEPS], predicted[STEPS];
    hci_note note = {{0}};
    bench_make(&b);
    all_on_the_bench(&b.effects);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, attach(&b, &note), note.text);
    for (int k = 0; k < STEPS; ++k) {
        hci_sample x = {0};
        bench_step(&b, k, &x, &read[k]);
        x.speed_rad_per_s = SPEED;
        x.temperature_C = 90.0;
        time[k] = k * STEP;
        predicted[k] = hci_effects_predict(&b.lists.machine, &b.effects.list, &x, NULL);
    }
    hci_effects_filter(&b.effects.list, time, STEPS, predicted, NULL);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = STEPS / 2; k < STEPS; ++k) { /* 30 ms: the lag of 1 ms has settled */
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, read[k], predicted[k]);
        low = fmin(low, read[k]);
        high = fmax(high, read[k]);
    }
    TEST_ASSERT_TRUE(high - low > 0.3);
    hci_effects_detach(b.attachment);
}

static double twice(const void *context, double value, double theta_m_rad)
{
    (void)theta_m_rad;
    return *(const double *)context * value;
}

/* What a sensor did before, it still does first. */
static void test_a_sensor_keeps_its_own_modification(void)
{
    static bench b;
    static const double factor = 2.0;
    hci_note note = {{0}};
    hci_sample x;
    double torque;
    bench_make(&b);
    b.sensors[HCI_SENSE_TORQUE].modify = twice;
    b.sensors[HCI_SENSE_TORQUE].context = &factor;
    b.sensors[HCI_SENSE_TORQUE].gain_error = 0.5;
    el_add(&b.effects, "friction", "viscous", 0.0, 0.01);
    el_add(&b.effects, "torque_sensor", "offset", 0.0, 0.1);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, attach(&b, &note), note.text);
    bench_step(&b, 0, &x, &torque);
    const double machine = 0.9 * 1.5 * 6.0 * cos(0.4);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5 * (2.0 * machine - 0.7) + 0.1, torque);
    hci_effects_detach(b.attachment);
}

static void test_no_effects_change_nothing(void)
{
    static bench b;
    hci_note note = {{0}};
    hci_sample x;
    double torque;
    bench_make(&b);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, attach(&b, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(0, b.drive.plant.effect_count);
    bench_step(&b, 0, &x, &torque);
    TEST_ASSERT_EQUAL_DOUBLE(START, x.theta_m_rad);
    TEST_ASSERT_EQUAL_DOUBLE(current_at(0, 0.0), x.i_abc[0]);
    hci_effects_detach(b.attachment);
    hci_effects_detach(NULL);
}

static void refused(const char *effect, const char *parameter, double value, const char *words)
{
    static bench b, before;
    hci_note note = {{0}};
    bench_make(&b);
    el_add(&b.effects, effect, parameter, 0.0, value);
    el_add(&b.effects, "current_offset", "a", 0.0, 1.0);
    before = b;
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, attach(&b, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, words), note.text);
    TEST_ASSERT_NULL(b.attachment);
    TEST_ASSERT_EQUAL_MEMORY(&before.drive, &b.drive, sizeof b.drive);
    TEST_ASSERT_EQUAL_MEMORY(before.sensors, b.sensors, sizeof b.sensors);
}

static void test_what_cannot_be_attached(void)
{
    refused("channel_delay", "angle", -1e-5, "channel_delay");
    refused("channel_delay", "torque", 1e3, "channel_delay");
    refused("friction", "coulomb", -0.1, "friction");
    static bench b;
    hci_note note = {{0}};
    const hci_plant_effect other = {hci_effects_apply, NULL};
    bench_make(&b);
    b.drive.plant.effects = &other;
    b.drive.plant.effect_count = 1;
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, attach(&b, &note));
}

/* ---- memory ---- */

typedef hci_status path(void);

static hci_status do_read(void)
{
    hci_effects_data effects;
    hci_note note = {{0}};
    const hci_status status = hci_effects_read(files_path("effects.csv"), &effects, &note);
    TEST_ASSERT_EQUAL(status == HCI_OK, note.text[0] == '\0');
    TEST_ASSERT_EQUAL(status == HCI_OK, effects.term != NULL);
    hci_effects_release(&effects);
    return status;
}

static hci_status do_write(void)
{
    el_list l = {0};
    hci_note note = {{0}};
    el_add(&l, "cogging", "sine", 6.0, 1.0);
    const hci_status status = write_effects(&l.list, &note);
    TEST_ASSERT_EQUAL(status == HCI_OK, note.text[0] == '\0');
    return status;
}

static hci_status do_attach(void)
{
    static bench b;
    hci_note note = {{0}};
    bench_make(&b);
    el_add(&b.effects, "cogging", "sine", 6.0, 1.0);
    const hci_status status = attach(&b, &note);
    TEST_ASSERT_EQUAL(status == HCI_OK, note.text[0] == '\0');
    TEST_ASSERT_EQUAL(status == HCI_OK, b.attachment != NULL);
    hci_effects_detach(b.attachment);
    return status;
}

/* How many allocations it takes; every fewer number is HCI_ERROR_MEMORY, and the sanitizer sees no leak. */
static long sweep(path *run)
{
    for (long n = 0;; ++n) {
        hci_memory_fail_after(n);
        const hci_status status = run();
        hci_memory_fail_after(-1);
        if (status == HCI_OK) return n;
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, status);
    }
}

static void test_memory(void)
{
    files_write(files_path("effects.csv"), EVERYTHING);
    TEST_ASSERT_TRUE(sweep(do_read) >= 4);
    TEST_ASSERT_TRUE(sweep(do_write) >= 2);
    TEST_ASSERT_TRUE(sweep(do_attach) >= 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_round_trip_to_the_byte);
    RUN_TEST(test_values_units_and_order_of_rows);
    RUN_TEST(test_fewer_columns);
    RUN_TEST(test_bad_files);
    RUN_TEST(test_missing_column);
    RUN_TEST(test_the_longest_list_is_whole);
    RUN_TEST(test_examples_of_the_page_can_be_read);
    RUN_TEST(test_the_page_names_every_effect_and_parameter);
    RUN_TEST(test_machine_folder);
    RUN_TEST(test_a_value_that_is_not_finite_is_not_written);
    RUN_TEST(test_sensors_of_a_drive);
    RUN_TEST(test_prediction_of_a_simulated_drive);
    RUN_TEST(test_a_sensor_keeps_its_own_modification);
    RUN_TEST(test_no_effects_change_nothing);
    RUN_TEST(test_what_cannot_be_attached);
    RUN_TEST(test_memory);
    return UNITY_END();
}
