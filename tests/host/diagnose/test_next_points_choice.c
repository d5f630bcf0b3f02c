/* Which points are chosen to tell effects apart, from tables of χ² by hand, and what is said of them. */
#include "host/diagnose/next_points.c"

#include "unity.h"

enum { POINTS = 6 };

static comparison c;
static hci_diagnosis d;
static hci_verdict verdict[MOST_PAIRS];
static double numbers[MOST_PAIRS][2][POINTS];
static hci_attribution a;

/* Two pairs: friction that may be a drag, and a cogging torque that hangs on one run. Each point is another
 * current. */
void setUp(void)
{
    memset(&c, 0, sizeof c);
    memset(&d, 0, sizeof d);
    memset(&a, 0, sizeof a);
    memset(verdict, 0, sizeof verdict);
    memset(numbers, 0, sizeof numbers);
    c.playable.source = HCI_TORQUE_MEASURED;
    c.points = POINTS, c.pairs = 2;
    for (size_t k = 0; k < POINTS; ++k)
        c.point[k] = (hci_operating_point){-1.0, (double)k, 50.0};
    verdict[0] = (hci_verdict){.type = hci_effect_type_find("iron_drag"),
                               .rival_of = hci_effect_type_find("friction"),
                               .ambiguous = true};
    verdict[1] =
        (hci_verdict){.type = hci_effect_type_find("cogging"), .in = true, .stays = 2, .left_out = 3};
    for (size_t j = 0; j < 2; ++j) {
        c.pair[j] =
            (pair){.verdict = &verdict[j], .chi_square = numbers[j][0], .turns = numbers[j][1], .wanted = 2};
        for (size_t k = 0; k < POINTS; ++k)
            numbers[j][1][k] = HCI_LEAST_TURNS;
    }
}

void tearDown(void)
{
}

/* ---- the choice ---- */

/* χ² up to five times what tells, for each of the pairs that want one; of more turns less. */
static void test_what_a_point_tells(void)
{
    numbers[0][0][3] = 1.01 * HCI_NOTHING, numbers[1][0][3] = 0.99 * HCI_NOTHING;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.01 * HCI_NOTHING, told_at(&c, 3));
    numbers[1][0][3] = 1e9;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.01 * HCI_NOTHING + 5.0 * HCI_TELLS, told_at(&c, 3));
    numbers[1][1][3] = 4.0 * HCI_LEAST_TURNS;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.01 * HCI_NOTHING + 1.25 * HCI_TELLS, told_at(&c, 3));
    c.pair[1].wanted = 0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.01 * HCI_NOTHING, told_at(&c, 3));
}

/* The best first, of those alike the first one, until each pair has two. */
static void test_points_are_chosen_in_turn(void)
{
    const double first[] = {0.0, 3.0, 1.5, 3.0, 2.0, 0.0}, second[] = {0.0, 0.0, 0.0, 0.0, 4.0, 1.2};
    for (size_t k = 0; k < POINTS; ++k)
        numbers[0][0][k] = HCI_TELLS * first[k], numbers[1][0][k] = HCI_TELLS * second[k];
    numbers[0][1][1] = 2.0 * HCI_LEAST_TURNS;
    points_choose(&c, &d);
    TEST_ASSERT_EQUAL_UINT64(3, d.next_points);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, d.next[0].iq_A); /* 6 of both */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 6.0 * HCI_TELLS, d.next[0].chi_square);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, d.next[1].iq_A); /* 3 in fewer turns */
    TEST_ASSERT_EQUAL_DOUBLE(5.0, d.next[2].iq_A); /* what the second pair wants still */
    TEST_ASSERT_NOT_NULL(strstr(d.next[0].why, "tells friction from iron_drag"));
    TEST_ASSERT_NOT_NULL(strstr(d.next[0].why, "; shows whether there is cogging"));
    TEST_ASSERT_TRUE(c.pair[0].wanted == 0 && c.pair[1].wanted == 0);
}

static void test_a_point_takes_the_longest_turns(void)
{
    numbers[0][0][2] = numbers[1][0][2] = 9.0 * HCI_TELLS;
    numbers[0][1][2] = 5.0 * HCI_LEAST_TURNS, numbers[1][1][2] = 2.0 * HCI_LEAST_TURNS;
    point_take(&c, 2, &d);
    TEST_ASSERT_EQUAL_DOUBLE(5.0 * HCI_LEAST_TURNS, d.next[0].turns);
    TEST_ASSERT_EQUAL_UINT64(1, c.pair[0].wanted);
    point_take(&c, 2, &d);
    TEST_ASSERT_EQUAL_UINT64(1, d.next_points);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 36.0 * HCI_TELLS, d.next[0].chi_square);
    point_take(&c, 2, &d); /* nobody wants it */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 36.0 * HCI_TELLS, d.next[0].chi_square);
}

static void test_rows_are_one_for_a_point(void)
{
    hci_operating_point x = {0.0, NAN, 3.0};
    hci_next_point *row = row_of(&d, &c.playable, &x);
    TEST_ASSERT_EQUAL_PTR(row, row_of(&d, &c.playable, &x));
    TEST_ASSERT_TRUE(row->turns == HCI_LEAST_TURNS && row->source == HCI_TORQUE_MEASURED);
    x.speed_rad_per_s = -3.0;
    TEST_ASSERT_TRUE(row != row_of(&d, &c.playable, &x));
    for (size_t k = 2; k <= HCI_MOST_NEXT_POINTS; ++k) {
        x.id_A = (double)k;
        TEST_ASSERT_EQUAL(k < HCI_MOST_NEXT_POINTS, row_of(&d, &c.playable, &x) != NULL);
    }
}

/* ---- which pairs ---- */

static void test_what_is_unstable(void)
{
    TEST_ASSERT_TRUE(is_unstable(&verdict[1]) && !is_unstable(&verdict[0]));
    verdict[1].stays = 3;
    TEST_ASSERT_FALSE(is_unstable(&verdict[1]));
    verdict[1].stays = 2, verdict[1].ambiguous = true;
    TEST_ASSERT_FALSE(is_unstable(&verdict[1]));
}

/* Of effects of the current runs without one tell nothing. */
static void test_points_without_a_current(void)
{
    verdict[0].type = hci_effect_type_find("reluctance"),
    verdict[0].rival_of = hci_effect_type_find("back_emf");
    c.point[0].id_A = 0.0; /* and no i_q */
    c.point[1] = (hci_operating_point){0.0, NAN, 50.0};
    for (size_t k = 0; k < POINTS; ++k)
        numbers[0][0][k] = 7.0;
    leave_currentless_out(&c, &c.pair[0]);
    for (size_t k = 0; k < POINTS; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(k == 0 ? 0.0 : 7.0, numbers[0][0][k]);
    numbers[0][0][0] = 7.0;
    verdict[0].rival_of = hci_effect_type_find("friction");
    leave_currentless_out(&c, &c.pair[0]);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, numbers[0][0][0]);
    numbers[1][0][0] = 7.0; /* cogging torque is there without any */
    leave_currentless_out(&c, &c.pair[1]);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, numbers[1][0][0]);
}

/* ---- advice ---- */

static void test_advice_of_a_pair(void)
{
    numbers[0][0][1] = 2.0 * HCI_TELLS, numbers[0][0][3] = 3.0 * HCI_TELLS;
    point_take(&c, 1, &d);
    point_take(&c, 3, &d);
    advice_of_pair(&c, &c.pair[0], &d);
    TEST_ASSERT_EQUAL_STRING_LEN("friction or iron_drag: ", d.advice, 23);
    TEST_ASSERT_NOT_NULL(
        strstr(d.advice, "turns at i_d -1 A, i_q 3 A, 477.5 rpm (50 rad/s) would tell them apart (χ² "));
    advice_of_pair(&c, &c.pair[1], &d);
    TEST_ASSERT_NOT_NULL(strstr(d.advice, "; cogging: no steady run"));
    for (int k = 0; k < 40; ++k)
        advice_of_pair(&c, &c.pair[1], &d);
    TEST_ASSERT_TRUE(strlen(d.advice) < sizeof d.advice);
}

static void test_advice_of_slow_turns(void)
{
    hci_next_point p = {0.0, NAN, 2.0, 10.0, HCI_TORQUE_HOLDING, 0.0, ""};
    advice_of_point(&d, &p);
    TEST_ASSERT_EQUAL_STRING("10 turns under slow control, i_q as it comes, at 2 rad/s (mechanical)",
                             d.advice);
    TEST_ASSERT_TRUE(is_at_hand(&p));
    p.id_A = -2.0, d.advice[0] = '\0';
    advice_of_point(&d, &p);
    TEST_ASSERT_NOT_NULL(strstr(d.advice, " with i_d -2 A"));
    TEST_ASSERT_FALSE(is_at_hand(&p));
    p.source = HCI_TORQUE_INERTIA, d.advice[0] = '\0';
    advice_of_point(&d, &p);
    TEST_ASSERT_EQUAL_STRING("10 turns at i_d -2 A, i_q as it comes, 19.1 rpm (2 rad/s)", d.advice);
    TEST_ASSERT_TRUE(is_at_hand(&p));
}

static void test_advice_of_terms_that_are_the_same(void)
{
    a.verdict[0] = verdict[0], a.verdict[1] = verdict[1], a.types = 2;
    advice_of_same(&a, &d);
    TEST_ASSERT_EQUAL_STRING_LEN("friction or iron_drag: a run with ", d.advice, 34);
    TEST_ASSERT_NULL(strstr(d.advice, "cogging"));
    d.advice[0] = '\0', a.verdict[0].ambiguous = false, a.inertia_as_well = true;
    advice_of_same(&a, &d);
    TEST_ASSERT_EQUAL_STRING_LEN("torque per ampere or inertia: ", d.advice, 30);
    TEST_ASSERT_NULL(strstr(d.advice, "friction"));
}

static void test_advice_of_the_first_that_is_at_hand(void)
{
    d.next_points = 3;
    d.next[0] = (hci_next_point){-1.0, NAN, 2.0, 10.0, HCI_TORQUE_HOLDING, 0.0, "a"};
    d.next[1] = (hci_next_point){0.0, NAN, 2.0, 10.0, HCI_TORQUE_HOLDING, 0.0, "b"};
    advice_of_unknown(&d, 0);
    TEST_ASSERT_NOT_NULL(strstr(d.advice, " would say more (b)"));
    d.advice[0] = '\0';
    advice_of_unknown(&d, 1);
    TEST_ASSERT_NOT_NULL(strstr(d.advice, " would say most (b)"));
    d.next_points = 1, d.advice[0] = '\0';
    advice_of_unknown(&d, 0);
    TEST_ASSERT_EQUAL_STRING("", d.advice);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_a_point_tells);
    RUN_TEST(test_points_are_chosen_in_turn);
    RUN_TEST(test_a_point_takes_the_longest_turns);
    RUN_TEST(test_rows_are_one_for_a_point);
    RUN_TEST(test_what_is_unstable);
    RUN_TEST(test_points_without_a_current);
    RUN_TEST(test_advice_of_a_pair);
    RUN_TEST(test_advice_of_slow_turns);
    RUN_TEST(test_advice_of_terms_that_are_the_same);
    RUN_TEST(test_advice_of_the_first_that_is_at_hand);
    return UNITY_END();
}
