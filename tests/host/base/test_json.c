/* The JSON writer: its text is read back by the parser of cJSON, and every allocation may fail. */
#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#include "host/base/json.h"
#include "host/base/memory.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    cJSON_InitHooks(NULL);
}

/* An object with a list of objects and a list of lists in it. */
static char *write_nested(void)
{
    hci_json json;
    hci_json_begin(&json);
    hci_json_text(&json, "first", "a \"quoted\"\nµ");
    hci_json_object(&json, "inner");
    hci_json_array(&json, "items");
    for (int k = 0; k < 2; ++k) {
        hci_json_object(&json, NULL);
        hci_json_number(&json, "k", k);
        hci_json_close(&json);
    }
    hci_json_close(&json);
    hci_json_bool(&json, "after_items", true);
    hci_json_close(&json);
    hci_json_array(&json, "pairs");
    hci_json_array(&json, NULL);
    hci_json_number(&json, NULL, 1.5);
    hci_json_number(&json, NULL, NAN);
    hci_json_close(&json);
    hci_json_close(&json);
    hci_json_number(&json, "last", INFINITY);
    return hci_json_end(&json);
}

static void test_what_is_closed_gets_no_more(void)
{
    char *text = write_nested();
    TEST_ASSERT_NOT_NULL(text);
    cJSON *root = cJSON_Parse(text);
    TEST_ASSERT_NOT_NULL_MESSAGE(root, text);
    const cJSON *inner = cJSON_GetObjectItem(root, "inner"), *items = cJSON_GetObjectItem(inner, "items");
    TEST_ASSERT_EQUAL_INT(4, cJSON_GetArraySize(root));
    TEST_ASSERT_EQUAL_INT(2, cJSON_GetArraySize(inner));
    TEST_ASSERT_EQUAL_INT(2, cJSON_GetArraySize(items));
    TEST_ASSERT_EQUAL_DOUBLE(1.0,
                             cJSON_GetNumberValue(cJSON_GetObjectItem(cJSON_GetArrayItem(items, 1), "k")));
    TEST_ASSERT_TRUE(cJSON_IsTrue(cJSON_GetObjectItem(inner, "after_items")));
    cJSON_Delete(root);
    hci_json_free(text);
}

static void test_members_come_in_the_order_of_the_calls(void)
{
    char *text = write_nested();
    const char *first = strstr(text, "first"), *inner = strstr(text, "inner"), *last = strstr(text, "last");
    TEST_ASSERT_TRUE(first && inner && last && first < inner && inner < last);
    hci_json_free(text);
}

static void test_texts_are_escaped(void)
{
    char *text = write_nested();
    TEST_ASSERT_NOT_NULL(strstr(text, "\"a \\\"quoted\\\"\\nµ\""));
    hci_json_free(text);
}

static void test_a_number_that_does_not_exist_is_null(void)
{
    char *text = write_nested();
    TEST_ASSERT_NOT_NULL(strstr(text, "[1.5, null]"));
    TEST_ASSERT_NOT_NULL(strstr(text, "\"last\":\tnull"));
    hci_json_free(text);
}

static void test_an_empty_object_is_one(void)
{
    hci_json json;
    hci_json_begin(&json);
    char *text = hci_json_end(&json);
    cJSON *root = cJSON_Parse(text);
    TEST_ASSERT_TRUE(cJSON_IsObject(root));
    TEST_ASSERT_EQUAL_INT(0, cJSON_GetArraySize(root));
    cJSON_Delete(root);
    hci_json_free(text);
}

/* After a failure the calls that follow do nothing, and the end says so; nothing leaks. */
static void test_every_allocation_may_fail(void)
{
    cJSON_Hooks hooks = {hci_memory_malloc, hci_memory_free};
    char *text = NULL;
    long n = 0;
    cJSON_InitHooks(&hooks);
    for (; !text; ++n) {
        hci_memory_fail_after(n);
        text = write_nested();
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(n < 1000);
    }
    TEST_ASSERT_TRUE(n > 20);
    TEST_ASSERT_NOT_NULL(strstr(text, "last"));
    hci_json_free(text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_closed_gets_no_more);
    RUN_TEST(test_members_come_in_the_order_of_the_calls);
    RUN_TEST(test_texts_are_escaped);
    RUN_TEST(test_a_number_that_does_not_exist_is_null);
    RUN_TEST(test_an_empty_object_is_one);
    RUN_TEST(test_every_allocation_may_fail);
    return UNITY_END();
}
