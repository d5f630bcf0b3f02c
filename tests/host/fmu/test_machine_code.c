/* Which variables the FMU of a machine has: those of the inverter belong to voltages, not to imposed
 * currents, and a temperature to magnets that depend on it; what they are to begin with, what acts at once,
 * and its effects as C. */
#include "host/fmu/machine_code.h"

#include <math.h>
#include <string.h>

#include "hci/host/machine/machine.h"
#include "support/texts.h"
#include "unity.h"

static hci_machine_data machine;
static hci_fmu_machine_model model;
static hci_note note;

void setUp(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_c", &machine, &note), note.text);
}

void tearDown(void)
{
    hci_fmu_machine_release(&model);
    hci_machine_release(&machine);
}

static void test_variables_that_are_left_out(void)
{
    static const int OF_VOLTAGES[] = {HCI_FMU_MACHINE_VA,
                                      HCI_FMU_MACHINE_VA + 1,
                                      HCI_FMU_MACHINE_VA + 2,
                                      HCI_FMU_MACHINE_RESISTANCE,
                                      HCI_FMU_MACHINE_DEAD_TIME_VOLTAGE,
                                      HCI_FMU_MACHINE_DEAD_TIME_CROSSING};
    for (int imposed = 0; imposed < 2; ++imposed) {
        const hci_fmu_request request = {.fmi_version = 2, .machine = &machine, .imposed = imposed};
        hci_fmu_machine_release(&model);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_fmu_machine_make(&request, &machine, &model, &note), note.text);
        for (size_t k = 0; k < sizeof OF_VOLTAGES / sizeof *OF_VOLTAGES; ++k)
            TEST_ASSERT_EQUAL(imposed, model.left_out[OF_VOLTAGES[k]]);
        for (int k = 0; k < 3; ++k) {
            TEST_ASSERT_EQUAL(!imposed, model.left_out[HCI_FMU_MACHINE_IA_IMPOSED + k]);
            TEST_ASSERT_FALSE(model.left_out[HCI_FMU_MACHINE_IA + k]);
        }
        TEST_ASSERT_TRUE(model.left_out[HCI_FMU_MACHINE_TEMPERATURE]);
        TEST_ASSERT_FALSE(model.left_out[HCI_FMU_MACHINE_TORQUE]);
        TEST_ASSERT_FALSE(model.left_out[HCI_FMU_MACHINE_INERTIA]);
    }
}

/* ---- effects ---- */

static hci_effect_term term[4];
static hci_effect effect[2];
static const hci_effects EFFECTS = {effect, 2};

/* Magnets that are declared at 25 °C, and two values of friction. */
static void make_with_effects(hci_fmu_request *request)
{
    const hci_effect_type *magnets = hci_effect_type_find("magnet_temperature"),
                          *friction = hci_effect_type_find("friction");
    for (size_t j = 0; j < 2; ++j) {
        const bool is_reference = strcmp(magnets->parameter[j].unit, "C") == 0;
        term[j] = (hci_effect_term){j, 0.0, is_reference ? 25.0 : -0.001, 0.5};
        term[2 + j] = (hci_effect_term){j, 0.0, 0.25 + (double)j, 0.5};
    }
    effect[0] = (hci_effect){magnets, term, 2};
    effect[1] = (hci_effect){friction, term + 2, 2};
    *request = (hci_fmu_request){.fmi_version = 2, .machine = &machine, .effects = &EFFECTS};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_fmu_machine_make(request, &machine, &model, &note), note.text);
}

static void test_effects_as_code(void)
{
    hci_fmu_request request;
    hci_long_text text = {0};
    char expected[1024];
    make_with_effects(&request);
    hci_fmu_machine_code(&model, &text);
    snprintf(expected, sizeof expected,
             "/* parameter, order, value, standard error (not used) */\n"
             "static const hci_effect_term TERMS[] = {\n"
             "    {0, 0.0, %s, 0.0}, /* magnet_temperature %s */\n"
             "    {1, 0.0, %s, 0.0}, /* magnet_temperature %s */\n"
             "    {0, 0.0, 0.25, 0.0}, /* friction %s */\n    {1, 0.0, 1.25, 0.0}, /* friction %s */\n};\n\n"
             "static const hci_effect EFFECTS[] = {\n"
             "    {&hci_effect_magnet_temperature, TERMS + 0, 2},\n"
             "    {&hci_effect_friction, TERMS + 2, 2},\n};\n\n",
             term[0].value > 0.0 ? "25.0" : "-0.001", effect[0].type->parameter[0].name,
             term[1].value > 0.0 ? "25.0" : "-0.001", effect[0].type->parameter[1].name,
             effect[1].type->parameter[0].name, effect[1].type->parameter[1].name);
    text_has(expected, text.text);
    text_has(",\n    {EFFECTS, 2},\n", text.text);
    text_has(" /* points */\n    false\n};\n", text.text);
    hci_long_text_release(&text);
}

static void test_a_machine_without_effects_as_code(void)
{
    const hci_fmu_request request = {.fmi_version = 2, .machine = &machine, .imposed = true};
    hci_long_text text = {0};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_fmu_machine_make(&request, &machine, &model, &note), note.text);
    hci_fmu_machine_code(&model, &text);
    text_lacks("TERMS", text.text);
    text_has(",\n    {0, 0},\n", text.text);
    text_has(" /* points */\n    true\n};\n", text.text);
    hci_long_text_release(&text);
}

/* To begin with the magnets have the temperature at which they are declared; what is not declared is 0, and
 * without an inertia the speed is prescribed. */
static void test_values_to_begin_with(void)
{
    hci_fmu_request request;
    machine.resistance_ohm = 0.5;
    machine.inertia_kgm2 = 0.125;
    machine.viscous_friction_Nms_per_rad = 0.25;
    machine.coulomb_friction_Nm = (double)NAN;
    make_with_effects(&request);
    TEST_ASSERT_FALSE(model.left_out[HCI_FMU_MACHINE_TEMPERATURE]);
    TEST_ASSERT_EQUAL_DOUBLE(25.0, model.start[HCI_FMU_MACHINE_TEMPERATURE]);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, model.start[HCI_FMU_MACHINE_RESISTANCE]);
    TEST_ASSERT_EQUAL_DOUBLE(0.125, model.start[HCI_FMU_MACHINE_INERTIA]);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, model.start[HCI_FMU_MACHINE_VISCOUS]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, model.start[HCI_FMU_MACHINE_COULOMB]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, model.start[HCI_FMU_MACHINE_IS_PRESCRIBED]);
    TEST_ASSERT_EQUAL_DOUBLE(1e-5, model.start[HCI_FMU_MACHINE_STEP]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, model.start[HCI_FMU_MACHINE_DEAD_TIME_VOLTAGE]);
    hci_fmu_machine_release(&model);
    machine.inertia_kgm2 = (double)NAN;
    request.effects = NULL;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_fmu_machine_make(&request, &machine, &model, &note), note.text);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, model.start[HCI_FMU_MACHINE_TEMPERATURE]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, model.start[HCI_FMU_MACHINE_INERTIA]);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, model.start[HCI_FMU_MACHINE_IS_PRESCRIBED]);
}

/* Imposed currents are the currents at once, and make the torque; so do the magnets. A voltage does not. */
static void test_what_acts_at_once(void)
{
    const hci_fmu_request request = {.fmi_version = 2, .machine = &machine, .imposed = true};
    hci_fmu_description d = {0};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_fmu_machine_make(&request, &machine, &model, &note), note.text);
    hci_fmu_machine_describe(&model, &d);
    TEST_ASSERT_EQUAL_UINT64(HCI_FMU_MACHINE_COUNT, d.count);
    TEST_ASSERT_EQUAL_DOUBLE(1e-5, d.step_s);
    text_has("imposed", d.what);
    for (size_t input = HCI_FMU_MACHINE_VA; input <= HCI_FMU_MACHINE_TEMPERATURE; ++input) {
        const bool is_current =
            input >= HCI_FMU_MACHINE_IA_IMPOSED && input <= HCI_FMU_MACHINE_IA_IMPOSED + 2;
        for (size_t output = HCI_FMU_MACHINE_TORQUE; output <= HCI_FMU_MACHINE_TORQUE_MEASURED; ++output) {
            const bool is_of_current = output >= HCI_FMU_MACHINE_IA && output <= HCI_FMU_MACHINE_IQ;
            const bool is_of_magnets =
                output == HCI_FMU_MACHINE_TORQUE && input == HCI_FMU_MACHINE_TEMPERATURE;
            const bool acts = is_current && (is_of_current || output == HCI_FMU_MACHINE_TORQUE);
            TEST_ASSERT_EQUAL(acts || is_of_magnets, d.feeds(d.context, input, output));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_variables_that_are_left_out);
    RUN_TEST(test_effects_as_code);
    RUN_TEST(test_a_machine_without_effects_as_code);
    RUN_TEST(test_values_to_begin_with);
    RUN_TEST(test_what_acts_at_once);
    return UNITY_END();
}
