/* The constants of an FMU as C, letter by letter, and the text that they grow in. */
#include "host/fmu/data_code.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "unity.h"

static hci_long_text text;

static const hci_wave EMF[] = {{1.0, 1, 0.5, 0.0}, {5.0, -1, 0.025, -0.125}};
static const hci_harmonic COGGING[] = {{6.0, 0.25, -1e-3}};
static const hci_inductance SLOPE[] = {
    {2.0, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, {0.0, 0.5, 0.0, 0.0, 0.0, -0.5}}};
static const hci_inductance L[] = {{0.0, {0.0}, {0.125, 0.125, 0.125, 0.0, 0.0, 0.0}},
                                   {2.0, {0.25, 0.0, 0.0, 0.0, 0.0, 0.0}, {0.0}}};
static const hci_machine MACHINE = {7, EMF, 2, COGGING, 1, SLOPE, 1};
static const hci_plant_inductance INDUCTANCE = {L, 2, 0.5, 0.75};

void setUp(void)
{
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    (void)hci_memory_was_short();
    hci_long_text_release(&text);
}

static void test_arrays(void)
{
    hci_fmu_code_arrays("OWN", &MACHINE, &INDUCTANCE, &text);
    TEST_ASSERT_EQUAL_STRING("/* order, sequence, sine and cosine in N.m/A */\n"
                             "static const hci_wave OWN_BACK_EMF[] = {\n"
                             "    {1.0, 1, 0.5, 0.0},\n    {5.0, -1, 0.025, -0.125},\n};\n\n"
                             "/* order, sine and cosine in N.m */\n"
                             "static const hci_harmonic OWN_COGGING[] = {\n    {6.0, 0.25, -0.001},\n};\n\n"
                             "/* order, sine and cosine of aa, bb, cc, ab, bc, ca in H/rad */\n"
                             "static const hci_inductance OWN_SLOPE[] = {\n    {2.0,\n"
                             "     {1.0, 2.0, 3.0, 4.0, 5.0, 6.0},\n     {0.0, 0.5, 0.0, 0.0, 0.0, -0.5}},\n"
                             "};\n\n"
                             "/* order, sine and cosine of aa, bb, cc, ab, bc, ca in H */\n"
                             "static const hci_inductance OWN_INDUCTANCE[] = {\n"
                             "    {0.0,\n     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},\n"
                             "     {0.125, 0.125, 0.125, 0.0, 0.0, 0.0}},\n"
                             "    {2.0,\n     {0.25, 0.0, 0.0, 0.0, 0.0, 0.0},\n"
                             "     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}},\n};\n\n",
                             text.text);
}

static void test_initialisers(void)
{
    hci_fmu_code_machine("OWN", &MACHINE, &text);
    TEST_ASSERT_EQUAL_STRING("{7, OWN_BACK_EMF, 2, OWN_COGGING, 1, OWN_SLOPE, 1}", text.text);
    hci_long_text_release(&text);
    hci_fmu_code_inductance("OWN", &INDUCTANCE, &text);
    TEST_ASSERT_EQUAL_STRING("{OWN_INDUCTANCE, 2, 0.5, 0.75}", text.text);
}

/* What is empty has neither an array nor a name. */
static void test_a_machine_of_nothing(void)
{
    static const hci_machine NONE = {.pole_pairs = 2};
    static const hci_plant_inductance PLAIN = {NULL, 0, 1e-3, 2e-3};
    hci_fmu_code_arrays("OWN", &NONE, &PLAIN, &text);
    TEST_ASSERT_NULL(text.text);
    hci_fmu_code_machine("OWN", &NONE, &text);
    hci_fmu_code_inductance("OWN", &PLAIN, &text);
    TEST_ASSERT_EQUAL_STRING("{2, 0, 0, 0, 0, 0, 0}{0, 0, 0.001, 0.002}", text.text);
}

static void test_starts(void)
{
    hci_fmu_code_start((const double[]){0.0, -2.5, 1e300}, 3, &text);
    TEST_ASSERT_EQUAL_STRING("/* Of each variable, in the order of the list of the model. */\n"
                             "const double hci_fmu_start[] = {\n    0.0,\n    -2.5,\n    1e300,\n};\n\n",
                             text.text);
}

/* Numbers read back to the same double and are no integers; what is not finite is 0. */
static void test_numbers(void)
{
    static const struct {
        double value;
        const char *words;
    } CASES[] = {{3.0, "3.0"},   {0.1, "0.1"},         {1e-9, "1e-9"},
                 {-7.0, "-7.0"}, {(double)NAN, "0.0"}, {HUGE_VAL, "0.0"}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        hci_long_text_release(&text);
        hci_long_text_number(&text, CASES[k].value);
        TEST_ASSERT_EQUAL_STRING(CASES[k].words, text.text);
    }
}

/* It grows by parts of any size, and stays whole. */
static void test_a_text_that_grows(void)
{
    static char part[5001];
    size_t size = 0;
    memset(part, 'x', sizeof part - 1);
    for (int k = 0; k < 40; ++k) {
        const int length = k % 2 ? 4095 + k : k;
        hci_long_text_add(&text, "%.*s|", length, part);
        size += (size_t)length + 1;
        TEST_ASSERT_EQUAL_UINT64(size, text.size);
        TEST_ASSERT_EQUAL_UINT64(size, strlen(text.text));
        TEST_ASSERT_TRUE(text.room > text.size && text.text[size - 1] == '|' && !text.failed);
    }
}

/* Without memory it has failed, and nothing is added from there on. */
static void test_memory(void)
{
    hci_long_text_add(&text, "begin");
    hci_memory_fail_after(0);
    for (int k = 0; k < 3; ++k)
        hci_long_text_add(&text, "%5000d", k);
    hci_memory_fail_after(-1);
    TEST_ASSERT_TRUE(text.failed);
    hci_long_text_add(&text, "end");
    TEST_ASSERT_EQUAL_STRING("begin", text.text);
    TEST_ASSERT_EQUAL_UINT64(5, text.size);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_arrays);
    RUN_TEST(test_initialisers);
    RUN_TEST(test_a_machine_of_nothing);
    RUN_TEST(test_starts);
    RUN_TEST(test_numbers);
    RUN_TEST(test_a_text_that_grows);
    RUN_TEST(test_memory);
    return UNITY_END();
}
