/* Types of a model that have left another one come back to it, of whatever kind, and no others. */
#include "host/diagnose/search/no_load.c"

#include "unity.h"

static hci_note note;

void setUp(void)
{
}

void tearDown(void)
{
}

static void put(hci_candidates *list, size_t type, double value)
{
    hci_candidate x = {.type = hci_candidate_type(type), .count = 1, .in = true};
    x.term[0].value = value;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(list, &x, &note));
}

static void test_each_type_comes_back_once(void)
{
    for (size_t there = 0; there < hci_candidate_types(); ++there) {
        hci_candidates from = {0}, to = {0};
        for (size_t r = 0; r < hci_candidate_types(); ++r)
            put(&from, r, 1.0 + (double)r);
        put(&to, there, -1.0);
        TEST_ASSERT_EQUAL_INT(HCI_OK, lost_add(&from, &to, &note));
        TEST_ASSERT_EQUAL_UINT64(hci_candidate_types(), to.count);
        for (size_t k = 0; k < to.count; ++k) {
            size_t r = 0;
            while (hci_candidate_type(r) != to.candidate[k].type)
                ++r;
            TEST_ASSERT_EQUAL_DOUBLE(r == there ? -1.0 : 1.0 + (double)r, to.candidate[k].term[0].value);
        }
        hci_candidates_release(&from);
        hci_candidates_release(&to);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_type_comes_back_once);
    return UNITY_END();
}
