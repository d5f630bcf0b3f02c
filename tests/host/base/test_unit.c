/* Conversion of units, each factor by its definition. */
#include "hci/host/base/unit.h"

#include "support/draws.h"
#include "unity.h"

/* One rounding in the factor, one in the product. */
#define CONVERSION 4e-16

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_units_convert_by_their_definition(void)
{
    static const struct {
        const char *from, *to;
        double factor;
    } known[] = {
        {"deg", "rad", REF_PI / 180},
        {"rad", "deg", 180 / REF_PI},
        {"\xC2\xB0", "rad", REF_PI / 180},
        {"rev", "deg", 360},
        {"rpm", "rad/s", REF_PI / 30},
        {"1/min", "rpm", 1},
        {"rad_per_s", "rpm", 30 / REF_PI},
        {"RPM", "rad/s", REF_PI / 30},
        {"rad/s", "rad_per_s", 1},
        {"rad_s", "rad/s", 1},
        {"rev_s", "rad/s", 2 * REF_PI},
        {"turn_s", "rad/s", 2 * REF_PI},
        {"turns_s", "rad/s", 2 * REF_PI},
        {"rev_min", "rad/s", REF_PI / 30},
        {"rev/s", "rpm", 60},
        {"mA", "A", 1e-3},
        {"Arms", "A", 1.4142135623730951},
        {"A_rms", "A", 1.4142135623730951},
        {"A", "mA", 1e3},
        {"mV", "kV", 1e-6},
        {"ms", "us", 1e3},
        {"\xC2\xB5s", "s", 1e-6},
        {"\xCE\xBCs", "s", 1e-6},
        {"mNm", "Nm", 1e-3},
        {"N\xC2\xB7m", "Nm", 1},
        {"N*m", "N m", 1},
        {"N-m", "N.m", 1},
        {"N_m", "N\xE2\x8B\x85m", 1},
        {"Nm_per_A", "V\xC2\xB7s/rad", 1},
        {"Vs/rad", "Nm/A", 1},
        {"V_s_per_rad", "N\xC2\xB7m/A", 1},
        {"V*s/rad", "mNm/A", 1e3},
        {"mH", "H", 1e-3},
        {"uH", "mH", 1e-3},
        {"\xC2\xB5H", "H", 1e-6},
        {"H/rad", "H_per_rad", 1},
        {"\xCE\xA9", "ohm", 1},
        {"\xE2\x84\xA6", "mohm", 1e3},
        {"m\xCE\xA9", "ohm", 1e-3},
        {"Ohm", "ohm", 1},
        {"V/A", "ohm", 1},
        {"kg\xC2\xB7m\xC2\xB2", "kgm2", 1},
        {"kg*m^2", "kg_m2", 1},
        {"kg m2", "kg\xC2\xB7m\xC2\xB2", 1},
        {"Nms_per_rad", "N\xC2\xB7m\xC2\xB7s/rad", 1},
        {"Nm\xC2\xB7s/rad", "Nms/rad", 1},
        {"N_m_s_per_rad", "N m s / rad", 1},
        {"degC", "C", 1},
        {"\xC2\xB0"
         "C",
         "degC", 1},
        {"kHz", "Hz", 1e3},
        {"kW", "W", 1e3},
        {"%", "1", 0.01},
        {"", "1", 1},
        {"-", "1", 1},
    };
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        double factor = 0;
        TEST_ASSERT_TRUE_MESSAGE(hci_unit_factor(known[k].from, known[k].to, &factor), known[k].from);
        TEST_ASSERT_DOUBLE_WITHIN(CONVERSION * known[k].factor, known[k].factor, factor);
    }
}

static void test_units_of_other_dimensions_do_not_convert(void)
{
    static const char *const pairs[][2] = {
        {"A", "V"},
        {"rad", "rad/s"},
        {"Hz", "rad/s"},
        {"Nm", "Nm/A"},
        {"H", "H/rad"},
        {"1", "rad"},
        {"MA", "A"},
        {"m", "1"},
        {"m_rad", "rad"},
        {"furlong", "furlong"},
        {"rad", ""},
        {"Nm ", "A"},
        {"kilogram times metre squared", "kgm2"},
    };
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++) {
        double factor = 7;
        TEST_ASSERT_FALSE_MESSAGE(hci_unit_factor(pairs[k][0], pairs[k][1], &factor), pairs[k][0]);
        TEST_ASSERT_EQUAL_DOUBLE(7, factor);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_units_convert_by_their_definition);
    RUN_TEST(test_units_of_other_dimensions_do_not_convert);
    return UNITY_END();
}
