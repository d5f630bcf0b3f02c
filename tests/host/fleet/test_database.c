/* fleet.sqlite with one of SQLite's allocations failing: the status of memory that is short, or the rows as
 * they are with enough of it. */
#include <sqlite3.h>
#include <string.h>
#include <sys/stat.h>

#include "host/fleet/row.h"
#include "support/files.h"
#include "unity.h"

enum { MOTORS = 2, TEXT = 8192 };

static sqlite3_mem_methods usual;
static long calls, failing; /* the allocation that fails; 0: none */

static void *sometimes(int size)
{
    return ++calls == failing ? NULL : usual.xMalloc(size);
}

static void *sometimes_again(void *before, int size)
{
    return ++calls == failing ? NULL : usual.xRealloc(before, size);
}

static hci_fleet_list list;
static hci_fleet_results results;
static char rows[MOTORS][HCI_FLEET_ROW_SIZE];
static hci_note note;

void setUp(void)
{
    files_begin();
    files_write(files_path("list.csv"), "motor\none\ntwo\n");
    memset(&list, 0, sizeof list);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_fleet_list_read(files_path("list.csv"), &list, &note),
                                  note.text);
    mkdir(files_path("motors"), 0700);
    mkdir(files_path("motors/one"), 0700);
    files_write(files_path("motors/one/parameters.csv"),
                "effect,parameter,value,unit,std_error\ncogging,sine_12,0.02,Nm,0.001\n");
    results = (hci_fleet_results){files_root, HCI_FLEET_FIT, &list};
    for (size_t k = 0; k < MOTORS; ++k) {
        const hci_fleet_outcome outcome = {k ? HCI_FLEET_FAILED : HCI_FLEET_DONE, k ? 3 : 0, "a reason"};
        const hci_fleet_digest digest = {"0123456789abcdef"};
        hci_fleet_row_make(&results, k, &outcome, &digest, files_path("motors/one"), rows[k]);
    }
}

void tearDown(void)
{
    hci_fleet_list_release(&list);
    files_end();
}

static hci_status store(long fail_at)
{
    char *row[MOTORS] = {rows[0], rows[1]};
    double seconds[MOTORS] = {1.5, 2.5};
    bool is_stored[MOTORS] = {false, false};
    hci_fleet_stored stored = {seconds, is_stored, false, true};
    note.text[0] = '\0';
    calls = 0, failing = fail_at;
    const hci_status status = hci_fleet_store(&results, row, &stored, &note);
    failing = 0;
    TEST_ASSERT_EQUAL(status == HCI_OK, is_stored[0] && is_stored[1]);
    return status;
}

static int append(void *text, int columns, char **value, char **name)
{
    for (int k = 0; k < columns; ++k) {
        strncat(text, name[k], TEXT - 1 - strlen(text));
        strncat(text, value[k] ? value[k] : "(null)", TEXT - 1 - strlen(text));
    }
    return 0;
}

/* All cells of both tables; "" where there are none. */
static void cells(char text[TEXT])
{
    sqlite3 *file;
    text[0] = '\0';
    TEST_ASSERT_EQUAL_INT(SQLITE_OK, sqlite3_open(files_path("fleet.sqlite"), &file));
    sqlite3_exec(file, "SELECT * FROM motor ORDER BY motor", append, text, NULL);
    sqlite3_exec(file, "SELECT * FROM parameter", append, text, NULL);
    sqlite3_close(file);
}

/* Of many allocations at the start one in a while; of the rows, which are put in last, all. */
static void test_a_failing_allocation_is_memory_that_is_short(void)
{
    enum { ROWS = 80, ONE_OF = 11 };
    char whole[TEXT], found[TEXT];
    long refused = 0;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, store(0), note.text);
    const long all = calls;
    cells(whole);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(whole, "parametersine_12value0.02"), whole);
    for (long at = 1; at <= all; at += at + ROWS < all ? ONE_OF : 1) {
        remove(files_path("fleet.sqlite"));
        const hci_status status = store(at);
        char what[80];
        snprintf(what, sizeof what, "allocation %ld of %ld, status %d", at, all, (int)status);
        TEST_ASSERT_TRUE_MESSAGE(status == HCI_OK || status == HCI_ERROR_MEMORY,
                                 note.text[0] ? note.text : what);
        cells(found);
        TEST_ASSERT_EQUAL_STRING_MESSAGE(status ? "" : whole, found, what);
        refused += status != HCI_OK;
    }
    TEST_ASSERT_TRUE(refused > 20);
}

/* The first call takes out what is not done; a later one adds to what the earlier ones have stored. */
static void test_later_calls_add_to_the_first(void)
{
    char text[TEXT], *row[MOTORS] = {rows[0], NULL};
    double seconds[MOTORS] = {1.5, 2.5};
    bool is_stored[MOTORS] = {false, false};
    hci_fleet_stored stored = {seconds, is_stored, false, true};
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_fleet_store(&results, row, &stored, &note), note.text);
    TEST_ASSERT_TRUE(stored.is_begun && is_stored[0] && !is_stored[1]);
    row[0] = NULL, row[1] = rows[1];
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_fleet_store(&results, row, &stored, &note), note.text);
    cells(text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, "motorone"), text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, "motortwo"), text);
    stored.is_begun = is_stored[1] = false; /* another start */
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_fleet_store(&results, row, &stored, &note), note.text);
    cells(text);
    TEST_ASSERT_NULL_MESSAGE(strstr(text, "motorone"), text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, "motortwo"), text);
}

int main(void)
{
    sqlite3_config(SQLITE_CONFIG_GETMALLOC, &usual);
    sqlite3_mem_methods mine = usual;
    mine.xMalloc = sometimes, mine.xRealloc = sometimes_again;
    sqlite3_config(SQLITE_CONFIG_MALLOC, &mine);
    sqlite3_config(SQLITE_CONFIG_LOOKASIDE, 0, 0);
    UNITY_BEGIN();
    RUN_TEST(test_a_failing_allocation_is_memory_that_is_short);
    RUN_TEST(test_later_calls_add_to_the_first);
    return UNITY_END();
}
