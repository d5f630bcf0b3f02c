/* What is told of the rounds of a search: from nothing on in small steps, and never backward. */
#include "host/diagnose/search/rounds.h"

#include "support/searching.h"

static double told[1000];
static size_t count;

void setUp(void)
{
    dataset_start();
    count = 0;
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

static void tell(void *context, const char *doing, double share)
{
    (void)context;
    if (doing && count < sizeof told / sizeof *told) told[count++] = share;
}

static void test_it_rises_from_nothing_in_small_steps(void)
{
    record_map(0.3, 0.0);
    search_start();
    how.progress = tell;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_rounds(&search, &model, &note));
    model_is_renewed();
    TEST_ASSERT_TRUE(count > 2);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, told[0]);
    size_t first = 0;
    while (first + 1 < count && !(told[first] > 0.0))
        ++first;
    TEST_ASSERT_TRUE(told[first] > 0.0 && told[first] < 0.01);
    for (size_t k = 1; k < count; ++k)
        TEST_ASSERT_TRUE(told[k] >= told[k - 1] && told[k] < told[k - 1] + 0.06);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_rises_from_nothing_in_small_steps);
    return UNITY_END();
}
