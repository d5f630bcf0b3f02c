/* Into how many parts recordings are cut, and which samples each part has. */
#include "host/diagnose/fit/run_parts.h"

#include <string.h>

#include "host/base/memory.h"
#include "unity.h"

enum { MOST_RUNS = 5, SEGMENTS = 4, MOST_VISITS = 12 };

static hci_run run[MOST_RUNS];
static bool use[MOST_RUNS];
static hci_segment segment[SEGMENTS];
static hci_binned_samples samples;
static hci_regression regression;
static hci_run_statistics statistics[MOST_RUNS];

void setUp(void)
{
    memset(run, 0, sizeof run);
    memset(use, 0, sizeof use);
    memset(segment, 0, sizeof segment);
    memset(statistics, 0, sizeof statistics);
    samples = (hci_binned_samples){.segment = segment, .segment_count = SEGMENTS, .statistics = statistics};
    regression = (hci_regression){.samples = &samples, .runs = run, .use = use};
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

/* `in_use` runs of that kind before the others, which are not in use. */
static void runs_set(size_t count, size_t in_use, hci_torque_source source)
{
    samples.run_count = count;
    for (size_t r = 0; r < count; ++r) {
        run[r] = (hci_run){.torque_source = source};
        use[r] = r < in_use;
    }
}

/* ---- how many */

static void test_few_runs_are_cut(void)
{
    static const size_t PARTS[] = {1, 4, 2, 1, 1, 1}; /* 3 parts or more, of 1, 2 ... runs */
    for (size_t count = 0; count <= MOST_RUNS; ++count) {
        runs_set(count, count, HCI_TORQUE_MEASURED);
        TEST_ASSERT_EQUAL(PARTS[count], hci_run_parts(&regression, 2));
        runs_set(MOST_RUNS, count, HCI_TORQUE_MEASURED);
        TEST_ASSERT_EQUAL(PARTS[count], hci_run_parts(&regression, 2));
    }
    runs_set(MOST_RUNS, 3, HCI_TORQUE_MEASURED);
    TEST_ASSERT_EQUAL(2, hci_run_parts(&regression, 3));
    runs_set(MOST_RUNS, 4, HCI_TORQUE_MEASURED);
    TEST_ASSERT_EQUAL(1, hci_run_parts(&regression, 3));
    TEST_ASSERT_EQUAL(2, hci_run_parts(&regression, 4));
    runs_set(MOST_RUNS, 5, HCI_TORQUE_MEASURED);
    TEST_ASSERT_EQUAL(2, hci_run_parts(&regression, 5));
}

/* Idle both ways and three loads: each is alone; each of the four differences makes it so. */
static void test_runs_that_are_alone(void)
{
    static const double SPEED[] = {6.0, -6.0, 6.0, 6.0, 6.0}, IQ[] = {0.0, 0.0, 28.0, 53.0, 68.0};
    runs_set(5, 5, HCI_TORQUE_MEASURED);
    for (size_t r = 0; r < 5; ++r) {
        statistics[r].mean_speed_rad_per_s = SPEED[r];
        statistics[r].mean_iq_A = statistics[r].current_A = IQ[r];
    }
    for (size_t r = 0; r < 5; ++r)
        TEST_ASSERT_TRUE(hci_run_is_alone(&regression, r));
    statistics[1].mean_speed_rad_per_s = 4.1;
    TEST_ASSERT_FALSE(hci_run_is_alone(&regression, 0) || hci_run_is_alone(&regression, 1));
    TEST_ASSERT_TRUE(hci_run_is_alone(&regression, 2));
    statistics[1].mean_speed_rad_per_s = 3.9; /* the other is more than half as fast again */
    TEST_ASSERT_TRUE(hci_run_is_alone(&regression, 0));
    statistics[1].mean_speed_rad_per_s = 6.0;
    use[1] = false;
    TEST_ASSERT_TRUE(hci_run_is_alone(&regression, 0));
    statistics[3].mean_iq_A = statistics[3].current_A = 62.0; /* within 6.8 of the largest */
    TEST_ASSERT_FALSE(hci_run_is_alone(&regression, 3));
    statistics[3].mean_id_A = -40.0;
    TEST_ASSERT_TRUE(hci_run_is_alone(&regression, 3));
    run[4].torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_FALSE(hci_run_is_alone(&regression, 3));
}

/* Any of them may be the one that is alone, and each of the two differences makes it so. */
static void test_one_without_a_sensor_that_is_alone(void)
{
    for (size_t alone = 0; alone < 4; ++alone) {
        runs_set(4, 4, HCI_TORQUE_INERTIA);
        TEST_ASSERT_EQUAL(1, hci_run_parts(&regression, 2));
        run[alone].torque_source = HCI_TORQUE_HOLDING;
        TEST_ASSERT_EQUAL(3, hci_run_parts(&regression, 2));
        run[(alone + 1) % 4].torque_source = HCI_TORQUE_HOLDING; /* now there are two */
        TEST_ASSERT_EQUAL(1, hci_run_parts(&regression, 2));
        runs_set(4, 4, HCI_TORQUE_INERTIA);
        run[alone].hardly_accelerates = true;
        TEST_ASSERT_EQUAL(3, hci_run_parts(&regression, 2));
    }
}

static void test_one_with_a_sensor_tells_for_all(void)
{
    runs_set(4, 4, HCI_TORQUE_INERTIA);
    run[0].torque_source = HCI_TORQUE_HOLDING;
    run[3].torque_source = HCI_TORQUE_MEASURED;
    TEST_ASSERT_EQUAL(1, hci_run_parts(&regression, 2));
    use[3] = false; /* it does not, where it is not in use */
    TEST_ASSERT_EQUAL(3, hci_run_parts(&regression, 2));
}

static void test_one_that_is_not_in_use_keeps_no_company(void)
{
    runs_set(5, 4, HCI_TORQUE_INERTIA);
    run[0].torque_source = run[4].torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_EQUAL(3, hci_run_parts(&regression, 2));
}

/* ---- which samples */

typedef struct {
    size_t count, run[MOST_VISITS];
    hci_segment segment[MOST_VISITS][SEGMENTS];
    size_t fails_at;
} visits;

static hci_status visit(void *context, const hci_regression *part, size_t of_run, hci_note *note)
{
    visits *v = context;
    (void)note;
    TEST_ASSERT_TRUE(part->known == NULL && part->columns == NULL);
    TEST_ASSERT_TRUE(v->count < MOST_VISITS && part->runs == run && part->use == use);
    TEST_ASSERT_EQUAL(SEGMENTS, part->samples->segment_count);
    memcpy(v->segment[v->count], part->samples->segment, sizeof segment);
    v->run[v->count] = of_run;
    return ++v->count == v->fails_at ? HCI_ERROR_NUMERIC : HCI_OK;
}

/* Segments of 10, 7, 5 and 8 samples, of run 0, 1, 0 and 2; the last but one is a mean of turns. */
static void segments_set(void)
{
    static const size_t RUN[] = {0, 1, 0, 2}, COUNT[] = {10, 7, 5, 8};
    size_t first = 0;
    for (size_t k = 0; k < SEGMENTS; first += COUNT[k++])
        segment[k] = (hci_segment){.run = RUN[k], .first = first, .count = COUNT[k], .turns = k == 2 ? 9 : 0};
    regression.known = (hci_known_equations *)&samples;
    regression.columns = (void *)&samples;
}

/* The parts of a run follow each other without a gap, and nothing is in two of them. */
static void test_parts_of_a_run_make_it_up(void)
{
    visits v = {0};
    hci_note note = {{0}};
    runs_set(3, 2, HCI_TORQUE_MEASURED);
    segments_set();
    TEST_ASSERT_EQUAL(
        HCI_OK, hci_run_parts_each(&regression, hci_run_parts(&regression, 2), false, visit, &v, &note));
    TEST_ASSERT_EQUAL(4, v.count);
    for (size_t k = 0; k < SEGMENTS; ++k) {
        size_t next[] = {segment[k].first, segment[k].first};
        for (size_t j = 0; j < v.count; ++j) {
            const hci_segment *s = &v.segment[j][k];
            TEST_ASSERT_EQUAL(j / 2, v.run[j]);
            TEST_ASSERT_EQUAL(segment[k].run, s->run);
            TEST_ASSERT_EQUAL(0, s->turns);
            if (s->run != v.run[j]) {
                TEST_ASSERT_EQUAL(0, s->count);
                continue;
            }
            TEST_ASSERT_EQUAL(next[v.run[j]], s->first);
            TEST_ASSERT_EQUAL(j % 2 ? segment[k].count - segment[k].count / 2 : segment[k].count / 2,
                              s->count);
            next[v.run[j]] += s->count;
        }
        if (segment[k].run < 2) TEST_ASSERT_EQUAL(segment[k].first + segment[k].count, next[segment[k].run]);
    }
    TEST_ASSERT_EQUAL(10, segment[0].count); /* the caller's own are as they were */
    TEST_ASSERT_EQUAL(9, segment[2].turns);
}

static void test_whole_runs_keep_their_turns(void)
{
    visits v = {0};
    hci_note note = {{0}};
    runs_set(4, 4, HCI_TORQUE_MEASURED);
    use[1] = false;
    segments_set();
    TEST_ASSERT_EQUAL(
        HCI_OK, hci_run_parts_each(&regression, hci_run_parts(&regression, 2), false, visit, &v, &note));
    TEST_ASSERT_EQUAL(3, v.count);
    TEST_ASSERT_EQUAL(0, v.run[0]);
    TEST_ASSERT_EQUAL(2, v.run[1]);
    TEST_ASSERT_EQUAL(3, v.run[2]);
    TEST_ASSERT_EQUAL(5, v.segment[0][2].count);
    TEST_ASSERT_EQUAL(9, v.segment[0][2].turns);
    TEST_ASSERT_EQUAL(8, v.segment[1][3].count);
}

/* Of runs of which two are alike, those two stay whole. */
static void test_runs_that_are_not_alone_stay_whole(void)
{
    static const double SPEED[] = {6.0, -6.0, -5.0};
    static const size_t RUN[] = {0, 0, 1, 2};
    visits v = {0};
    hci_note note = {{0}};
    runs_set(3, 3, HCI_TORQUE_MEASURED);
    for (size_t r = 0; r < 3; ++r)
        statistics[r].mean_speed_rad_per_s = SPEED[r];
    segments_set();
    TEST_ASSERT_EQUAL(HCI_OK, hci_run_parts_each(&regression, 2, true, visit, &v, &note));
    TEST_ASSERT_EQUAL(4, v.count);
    TEST_ASSERT_EQUAL_MEMORY(RUN, v.run, sizeof RUN);
    TEST_ASSERT_EQUAL(5, v.segment[0][0].count);
    TEST_ASSERT_EQUAL(7, v.segment[2][1].count);
    TEST_ASSERT_EQUAL(8, v.segment[3][3].count);
}

/* What stands behind the last run is none, and keeps none company. */
static void test_behind_the_last_run(void)
{
    visits v = {0};
    hci_note note = {{0}};
    runs_set(5, 5, HCI_TORQUE_INERTIA);
    run[0].torque_source = run[3].torque_source = HCI_TORQUE_HOLDING;
    segments_set();
    samples.run_count = 3;
    TEST_ASSERT_EQUAL(3, hci_run_parts(&regression, 2));
    TEST_ASSERT_EQUAL(
        HCI_OK, hci_run_parts_each(&regression, hci_run_parts(&regression, 2), false, visit, &v, &note));
    TEST_ASSERT_EQUAL(9, v.count);
    TEST_ASSERT_EQUAL(2, v.run[8]);
}

static void test_a_failure_ends_it(void)
{
    visits v = {.fails_at = 2};
    hci_note note = {{0}};
    runs_set(3, 3, HCI_TORQUE_MEASURED);
    segments_set();
    TEST_ASSERT_EQUAL(HCI_ERROR_NUMERIC, hci_run_parts_each(&regression, hci_run_parts(&regression, 2), false,
                                                            visit, &v, &note));
    TEST_ASSERT_EQUAL(2, v.count);
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_run_parts_each(&regression, hci_run_parts(&regression, 2), false,
                                                           visit, &v, &note));
    TEST_ASSERT_EQUAL(2, v.count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_few_runs_are_cut);
    RUN_TEST(test_runs_that_are_alone);
    RUN_TEST(test_one_without_a_sensor_that_is_alone);
    RUN_TEST(test_one_with_a_sensor_tells_for_all);
    RUN_TEST(test_one_that_is_not_in_use_keeps_no_company);
    RUN_TEST(test_parts_of_a_run_make_it_up);
    RUN_TEST(test_whole_runs_keep_their_turns);
    RUN_TEST(test_runs_that_are_not_alone_stay_whole);
    RUN_TEST(test_behind_the_last_run);
    RUN_TEST(test_a_failure_ends_it);
    return UNITY_END();
}
