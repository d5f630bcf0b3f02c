/* Names of an FMU, which sources it has, and what its archive holds. */
#include "host/fmu/export.c"

#include "unity.h"

static export e;
static hci_fmu_request request;
static hci_fmu_result result;
static hci_note note;
static char text[HCI_MACHINE_NAME + 24];

void setUp(void)
{
    memset(&e, 0, sizeof e);
    memset(&request, 0, sizeof request);
    memset(&result, 0, sizeof result);
    e.request = &request, e.result = &result, e.note = &note;
    request.fmi_version = 2;
}

void tearDown(void)
{
}

static const char *identifier(const char *name, const char *end)
{
    make_identifier(name, end, text);
    return text;
}

static void test_identifiers(void)
{
    TEST_ASSERT_EQUAL_STRING("hub_a9", identifier("hub_a9", ""));
    TEST_ASSERT_EQUAL_STRING("a_b_c_controller", identifier("a-b c", "_controller"));
    TEST_ASSERT_EQUAL_STRING("machine_7pole", identifier("7pole", ""));
    TEST_ASSERT_EQUAL_STRING("machine_", identifier("", ""));
    TEST_ASSERT_EQUAL_STRING("m7", identifier("m7", ""));
}

static void test_beginnings_and_ends(void)
{
    TEST_ASSERT_TRUE(begins("fmu_fmi2.c", "fmu_fmi") && !begins("fmu_fm", "fmu_fmi"));
    TEST_ASSERT_TRUE(ends("a.c", ".c") && ends(".c", ".c") && !ends("c", ".c") && !ends("a.h", ".c"));
}

/* Of two versions and two models one. */
static void test_which_sources_are_wanted(void)
{
    TEST_ASSERT_TRUE(is_wanted(&e, "fmu_fmi2.c") && !is_wanted(&e, "fmu_fmi3.c"));
    TEST_ASSERT_TRUE(is_wanted(&e, "fmu_machine.c") && !is_wanted(&e, "fmu_controller.c") &&
                     is_wanted(&e, "lu.c"));
    request.fmi_version = 3, request.level_count = 1;
    TEST_ASSERT_TRUE(!is_wanted(&e, "fmu_fmi2.c") && is_wanted(&e, "fmu_fmi3.c"));
    TEST_ASSERT_TRUE(!is_wanted(&e, "fmu_machine.c") && is_wanted(&e, "fmu_controller.c"));
}

static void test_sources_are_added(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, add_source(&e, "a.h", "xyz", 3));
    TEST_ASSERT_EQUAL_INT(HCI_OK, add_source(&e, "b.c", "xy", 2));
    TEST_ASSERT_TRUE(e.sources == 2 && e.codes == 1 && strcmp(e.code[0], "b.c") == 0);
    TEST_ASSERT_TRUE(e.source[1].size == 2 && e.source[0].bytes != NULL);
    while (e.sources < MOST_FILES)
        TEST_ASSERT_EQUAL_INT(HCI_OK, add_source(&e, "c.h", "", 0));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, add_source(&e, "d.h", "", 0));
}

/* Another byte of any source, or of the data, makes another token. */
static void test_tokens_are_of_all_that_is_compiled(void)
{
    char before[48], bytes[] = "abc";
    add_source(&e, "a.c", bytes, 3);
    add_source(&e, "b.c", "xy", 2);
    make_token(&e);
    memcpy(before, e.token, sizeof before);
    TEST_ASSERT_EQUAL_UINT64(38, strlen(before));
    TEST_ASSERT_TRUE(before[0] == '{' && before[9] == '-' && before[14] == '-' && before[19] == '-' &&
                     before[24] == '-' && before[37] == '}');
    make_token(&e);
    TEST_ASSERT_EQUAL_STRING(before, e.token);
    bytes[2] = 'd';
    make_token(&e);
    TEST_ASSERT_TRUE(strcmp(before, e.token) != 0);
    for (int k = 1; k < 37; k += 12) /* in all of its parts */
        TEST_ASSERT_TRUE(strncmp(before + k, e.token + k, 8) != 0);
    bytes[2] = 'c', e.sources = 1;
    make_token(&e);
    TEST_ASSERT_TRUE(strcmp(before, e.token) != 0);
}

static void test_what_an_archive_holds(void)
{
    static archive a;
    static char binary[] = "elf", xml[] = "<a/>", build[] = "<b/>";
    memset(&a, 0, sizeof a);
    strcpy(result.identifier, "hub");
    add_source(&e, "a.c", "abc", 3);
    e.description.text = xml, e.description.size = 4;
    fill_archive(&e, &a);
    TEST_ASSERT_EQUAL_UINT64(2, a.count);
    TEST_ASSERT_EQUAL_STRING("modelDescription.xml", a.entry[0].path);
    TEST_ASSERT_EQUAL_STRING("sources/a.c", a.entry[1].path);
    TEST_ASSERT_EQUAL_UINT64(3, a.entry[1].size);
    memset(&a, 0, sizeof a);
    e.binary = binary, e.binary_bytes = 3, e.build.text = build, e.build.size = 4;
    if (!binary_folder(2)) return;
    fill_archive(&e, &a);
    TEST_ASSERT_EQUAL_UINT64(4, a.count);
    TEST_ASSERT_NOT_NULL(strstr(a.entry[1].path, "/hub.so"));
    TEST_ASSERT_EQUAL_STRING("sources/buildDescription.xml", a.entry[3].path);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_identifiers);
    RUN_TEST(test_beginnings_and_ends);
    RUN_TEST(test_which_sources_are_wanted);
    RUN_TEST(test_sources_are_added);
    RUN_TEST(test_tokens_are_of_all_that_is_compiled);
    RUN_TEST(test_what_an_archive_holds);
    return UNITY_END();
}
