/* modelDescription.xml of both versions for a model of seven variables, letter by letter. */
#include "host/fmu/description.h"

#include <string.h>

#include "hci/version.h"
#include "support/texts.h"
#include "unity.h"

enum { COUNT = 7 };

static const hci_fmu_variable LIST[COUNT] = {
    {"resistance", HCI_FMU_REAL, HCI_FMU_PARAMETER, "Ohm", "of a phase"},
    {"gone", HCI_FMU_REAL, HCI_FMU_INPUT, "degC", "left out"},
    {"va", HCI_FMU_REAL, HCI_FMU_INPUT, "V", "a < b & c > \"d\""},
    {"load", HCI_FMU_REAL, HCI_FMU_INPUT, "N.m", "on the shaft"},
    {"remedy", HCI_FMU_INTEGER, HCI_FMU_PARAMETER, "", "which"},
    {"held", HCI_FMU_BOOLEAN, HCI_FMU_PARAMETER, "", "whether"},
    {"torque", HCI_FMU_REAL, HCI_FMU_OUTPUT, "N.m", "of the air gap"}};
static const double START[COUNT] = {0.25, 1.0, -3.0, 0.0, 2.0, 1.0, 9.0};
static const bool LEFT_OUT[COUNT] = {false, true, false, false, false, false, false};
static const char *const SOURCES[] = {"a.c", "b.c"};

static hci_long_text text;
static hci_fmu_description d;

static bool both(const void *context, size_t input, size_t output)
{
    TEST_ASSERT_EQUAL_PTR(&d, context);
    TEST_ASSERT_EQUAL_UINT64(6, output);
    return input < 6;
}

static bool none(const void *context, size_t input, size_t output)
{
    (void)context, (void)input, (void)output;
    return false;
}

void setUp(void)
{
    d = (hci_fmu_description){.identifier = "hub",
                              .name = "Hub & co",
                              .what = "A motor",
                              .token = "{1-2}",
                              .list = LIST,
                              .count = COUNT,
                              .start = START,
                              .left_out = LEFT_OUT,
                              .choices = 4,
                              .feeds = both,
                              .context = &d,
                              .step_s = 1e-5,
                              .sources = SOURCES,
                              .source_count = 2};
}

void tearDown(void)
{
    hci_long_text_release(&text);
}

#define HEAD(version, token)                                                                                 \
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"" version                 \
    ".0\" modelName=\"Hub &amp; co\" " token "=\"{1-2}\" description=\"A motor\" "                           \
    "generationTool=\"hci-solve " HCI_VERSION_STRING "\" variableNamingConvention=\"flat\""

#define UNITS                                                                                                \
    "  <UnitDefinitions>\n"                                                                                  \
    "    <Unit name=\"V\"><BaseUnit kg=\"1\" m=\"2\" s=\"-3\" A=\"-1\"/></Unit>\n"                           \
    "    <Unit name=\"Ohm\"><BaseUnit kg=\"1\" m=\"2\" s=\"-3\" A=\"-2\"/></Unit>\n"                         \
    "    <Unit name=\"N.m\"><BaseUnit kg=\"1\" m=\"2\" s=\"-2\"/></Unit>\n"                                  \
    "    <Unit name=\"s\"><BaseUnit s=\"1\"/></Unit>\n"                                                      \
    "  </UnitDefinitions>\n"                                                                                 \
    "  <LogCategories>\n    <Category name=\"logStatusError\"/>\n"                                           \
    "    <Category name=\"logStatusDiscard\"/>\n  </LogCategories>\n"                                        \
    "  <DefaultExperiment startTime=\"0.0\" stepSize=\"1e-5\"/>\n  <ModelVariables>\n"

#define PARAMETER " causality=\"parameter\" variability=\"fixed\""
#define INPUT     " causality=\"input\" variability=\"continuous\""
#define OUTPUT    " causality=\"output\" variability=\"continuous\" initial=\"calculated\""

static void test_version_2(void)
{
    hci_fmu_describe_2(&d, &text);
    TEST_ASSERT_EQUAL_STRING(
        HEAD(
            "2",
            "guid") " numberOfEventIndicators=\"0\">\n"
                    "  <CoSimulation modelIdentifier=\"hub\" canHandleVariableCommunicationStepSize=\"true\""
                    " canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\""
                    " canSerializeFMUstate=\"true\">\n    <SourceFiles>\n      <File name=\"a.c\"/>\n"
                    "      <File name=\"b.c\"/>\n    </SourceFiles>\n  </CoSimulation>\n" UNITS
                    "    <ScalarVariable name=\"resistance\" valueReference=\"0\" description=\"of a "
                    "phase\"" PARAMETER "><Real unit=\"Ohm\" start=\"0.25\"/></ScalarVariable>\n"
                    "    <ScalarVariable name=\"va\" valueReference=\"2\" description=\"a &lt; b &amp; c "
                    "&gt; "
                    "&quot;d&quot;\"" INPUT "><Real unit=\"V\" start=\"-3.0\"/></ScalarVariable>\n"
                    "    <ScalarVariable name=\"load\" valueReference=\"3\" description=\"on the "
                    "shaft\"" INPUT "><Real unit=\"N.m\" start=\"0.0\"/></ScalarVariable>\n"
                    "    <ScalarVariable name=\"remedy\" valueReference=\"4\" description=\"which\"" PARAMETER
                    "><Integer min=\"1\" max=\"4\" start=\"2\"/></ScalarVariable>\n"
                    "    <ScalarVariable name=\"held\" valueReference=\"5\" description=\"whether\"" PARAMETER
                    "><Boolean start=\"true\"/></ScalarVariable>\n"
                    "    <ScalarVariable name=\"torque\" valueReference=\"6\" description=\"of the air "
                    "gap\"" OUTPUT "><Real unit=\"N.m\"/></ScalarVariable>\n"
                    "  </ModelVariables>\n  <ModelStructure>\n    <Outputs>\n"
                    "      <Unknown index=\"6\" dependencies=\"2 3\"/>\n    </Outputs>\n    "
                    "<InitialUnknowns>\n"
                    "      <Unknown index=\"6\"/>\n    </InitialUnknowns>\n  "
                    "</ModelStructure>\n</fmiModelDescription>\n",
        text.text);
    TEST_ASSERT_EQUAL_UINT64(strlen(text.text), text.size);
}

static void test_version_3(void)
{
    hci_fmu_describe_3(&d, &text);
    TEST_ASSERT_EQUAL_STRING(
        HEAD(
            "3",
            "instantiationToken") ">\n"
                                  "  <CoSimulation modelIdentifier=\"hub\" "
                                  "canHandleVariableCommunicationStepSize=\"true\""
                                  " canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\"/>\n" UNITS
                                  "    <Float64 name=\"time\" valueReference=\"7\" causality=\"independent\" "
                                  "variability=\"continuous\" unit=\"s\" description=\"Simulation time\"/>\n"
                                  "    <Float64 name=\"resistance\" valueReference=\"0\" description=\"of a "
                                  "phase\"" PARAMETER " unit=\"Ohm\" start=\"0.25\"/>\n"
                                  "    <Float64 name=\"va\" valueReference=\"2\" description=\"a &lt; b "
                                  "&amp; c &gt; &quot;d&quot;\"" INPUT " unit=\"V\" start=\"-3.0\"/>\n"
                                  "    <Float64 name=\"load\" valueReference=\"3\" description=\"on the "
                                  "shaft\"" INPUT " unit=\"N.m\" start=\"0.0\"/>\n"
                                  "    <Int32 name=\"remedy\" valueReference=\"4\" "
                                  "description=\"which\"" PARAMETER " min=\"1\" max=\"4\" start=\"2\"/>\n"
                                  "    <Boolean name=\"held\" valueReference=\"5\" "
                                  "description=\"whether\"" PARAMETER " start=\"true\"/>\n"
                                  "    <Float64 name=\"torque\" valueReference=\"6\" description=\"of the "
                                  "air gap\"" OUTPUT " unit=\"N.m\"/>\n"
                                  "  </ModelVariables>\n  <ModelStructure>\n"
                                  "    <Output valueReference=\"6\" dependencies=\"2 3\"/>\n"
                                  "    <InitialUnknown valueReference=\"6\"/>\n  "
                                  "</ModelStructure>\n</fmiModelDescription>\n",
        text.text);
}

/* Where nothing acts at once there are no dependencies; a truth that is not one is false. */
static void test_what_acts_later(void)
{
    static const double LATER[COUNT] = {0.25, 1.0, -3.0, 0.0, 2.0, 0.0, 9.0};
    d.feeds = none;
    d.start = LATER;
    hci_fmu_describe_3(&d, &text);
    text_has("<Output valueReference=\"6\" dependencies=\"\"/>", text.text);
    text_has(PARAMETER " start=\"false\"/>", text.text);
}

static void test_what_is_built(void)
{
    hci_fmu_describe_build(&d, &text);
    TEST_ASSERT_EQUAL_STRING(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiBuildDescription fmiVersion=\"3.0\">\n"
        "  <BuildConfiguration modelIdentifier=\"hub\">\n    <SourceFileSet language=\"C99\">\n"
        "      <SourceFile name=\"a.c\"/>\n      <SourceFile name=\"b.c\"/>\n    </SourceFileSet>\n"
        "    <Library name=\"m\"/>\n  </BuildConfiguration>\n</fmiBuildDescription>\n",
        text.text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_version_2);
    RUN_TEST(test_version_3);
    RUN_TEST(test_what_acts_later);
    RUN_TEST(test_what_is_built);
    return UNITY_END();
}
