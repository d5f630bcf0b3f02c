/* Free shafts: the means of a run by sums that are written out here, and each limit from which a run drives
 * something, hardly accelerates or shows friction, from both sides. */
#include "host/recording/free_shaft.h"

#include "support/diagnosing.h"
#include "support/texts.h"

enum { N = 230 };

static const double CONSTANT = 1.5 * 0.2; /* N·m per A of i_q */
static const hci_effects NONE = {NULL, 0};

static hci_drag drag[MOST_RUNS];
static hci_note note;

void setUp(void)
{
    dataset_start();
    memset(&note, 0, sizeof note);
    machine.rated_torque_Nm = machine.rated_current_A = NAN;
}

void tearDown(void)
{
    dataset_end();
}

/* A shaft of some turns whose torque is inertia × acceleration; the current is that of i_q and an i_d of −0.7
 * A, which makes no torque. */
static hci_run *add(double turns)
{
    hci_run *r = add_run(N);
    r->torque_source = HCI_TORQUE_INERTIA;
    for (size_t k = 0; k < N; ++k) {
        r->theta_m_rad[k] = 0.3 + 2.0 * REF_PI * turns * (double)k / (N - 1);
        r->speed_rad_per_s[k] = turns < 0.0 ? -20.0 : 20.0;
    }
    return r;
}

static void set_current(hci_run *r, size_t k, double iq_A)
{
    rec_phases(-0.7, iq_A, P * r->theta_m_rad[k], r->i_A + 3 * k);
}

/* i_q and torque are a mean and what goes up and down from sample to sample. */
static hci_run *add_steady(double turns, double iq_A, double swing_A, double accelerating_Nm, double swing_Nm)
{
    hci_run *r = add(turns);
    for (size_t k = 0; k < N; ++k) {
        const double way = k % 2 ? -1.0 : 1.0;
        set_current(r, k, iq_A + way * swing_A);
        r->torque_Nm[k] = accelerating_Nm + way * swing_Nm;
    }
    return r;
}

static void find(bool asks_drag)
{
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_free_shafts_find(&machine, &NONE, run, runs.count, asks_drag ? drag : NULL, &note),
        note.text);
}

static void forget(void)
{
    for (size_t k = 0; k < runs.count; ++k)
        rec_release(&run[k]);
    runs.count = 0;
}

/* ---- what is free ---- */

/* More than a tenth of the rated torque, declared or of the rated current, and more than 3/4 of the rms
 * torque. */
static void test_the_largest_drag(void)
{
    static const struct {
        double rated_Nm, rated_A, iq_A, swing_A, accelerating_Nm;
        bool is_load;
    } CASE[] = {{NAN, NAN, 1.0, 0.0, 0.02, true},         {2.75, NAN, 1.0, 0.0, 0.02, true},
                {2.85, NAN, 1.0, 0.0, 0.02, false},       {NAN, 2.75 / 0.3, 1.0, 0.0, 0.02, true},
                {NAN, 2.85 / 0.3, 1.0, 0.0, 0.02, false}, {2.75, 2.85 / 0.3, 1.0, 0.0, 0.02, true},
                {NAN, NAN, 1.0, 0.0, 0.074, true},        {NAN, NAN, 1.0, 0.0, 0.076, false},
                {NAN, NAN, 1.0, 0.88, 0.0, true},         {NAN, NAN, 1.0, 0.89, 0.0, false},
                {NAN, NAN, -1.0, 0.87, 0.0, true}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        machine.rated_torque_Nm = CASE[k].rated_Nm;
        machine.rated_current_A = CASE[k].rated_A;
        const hci_run *r = add_steady(3.0, CASE[k].iq_A, CASE[k].swing_A, CASE[k].accelerating_Nm, 0.0);
        find(false);
        TEST_ASSERT_EQUAL_MESSAGE(CASE[k].is_load, r->mean_is_unknown, r->remark.text);
        TEST_ASSERT_EQUAL(CASE[k].is_load, strstr(r->remark.text, "no free shaft") != NULL);
        forget();
    }
}

static void test_the_words(void)
{
    machine.rated_torque_Nm = 2.0;
    const hci_run *r = add_steady(-3.0, 1.0, 0.0, -0.05, 0.0);
    find(false);
    text_has(
        "the current makes 0.3 N·m on average, but inertia x acceleration is -0.05 N·m, and a drag of its "
        "own is at most 0.225 N·m",
        r->remark.text);
}

/* More than half of what the model makes accelerates, with the sign of the speed or without. */
static void test_half_accelerates(void)
{
    for (int more = 0; more < 2; ++more)
        for (int back = 0; back < 2; ++back) {
            const hci_run *r = add_steady(back ? -3.0 : 3.0, 1.0, 0.0, more ? -0.151 : -0.149, 0.0);
            find(false); /* 0.45 N·m of drag, or none */
            TEST_ASSERT_EQUAL(!more, r->mean_is_unknown);
            forget();
        }
}

/* The largest rms torque is that of all runs; one that drives a load takes those along that hardly
 * accelerate, and neither those that do nor those whose torque is another. */
static void test_runs_together(void)
{
    hci_run *load = add_steady(3.0, 1.0, 0.0, 0.0, 0.0), *beside = add_steady(3.0, 0.4, 0.0, 0.01, 0.0),
            *moved = add_steady(3.0, 0.4, 0.0, 0.1, 0.0), *measured = add_steady(3.0, 1.0, 0.0, 0.0, 0.0),
            *known = add_steady(3.0, 1.0, 0.0, 0.0, 0.0);
    measured->torque_source = HCI_TORQUE_MEASURED;
    known->mean_is_unknown = true;
    find(false);
    TEST_ASSERT_TRUE(load->mean_is_unknown && beside->mean_is_unknown && known->mean_is_unknown);
    TEST_ASSERT_FALSE(moved->mean_is_unknown || measured->mean_is_unknown);
    TEST_ASSERT_EQUAL_STRING(
        "another run drives a load that is not known, and this one hardly accelerates: only "
        "what varies is used",
        beside->remark.text);
    TEST_ASSERT_EQUAL_STRING("", known->remark.text);
    TEST_ASSERT_EQUAL_STRING("", moved->remark.text);
    TEST_ASSERT_TRUE(load->hardly_accelerates && beside->hardly_accelerates && known->hardly_accelerates);
    forget();
    load = add_steady(3.0, 1.0, 0.0, 0.0, 0.0);
    beside = add_steady(3.0, 0.4, 1.4, 0.0, 0.0); /* its rms torque is 0.437: three quarters are 0.328 */
    find(false);
    TEST_ASSERT_FALSE(load->mean_is_unknown || beside->mean_is_unknown);
    TEST_ASSERT_FALSE(load->hardly_accelerates || beside->hardly_accelerates);
}

/* Neither the mean, to a tenth of that of i_q, nor what varies, to a tenth of its square. */
static void test_what_hardly_accelerates(void)
{
    static const struct {
        double swing_A, accelerating_Nm, swing_Nm;
        bool hardly;
    } CASE[] = {{0.0, 0.0299, 0.0, true},   {0.0, 0.0301, 0.0, false},  {0.0, -0.0299, 0.0, true},
                {0.0, -0.0301, 0.0, false}, {0.5, 0.0, 0.0749, true},   {0.5, 0.0, 0.0751, false},
                {0.5, 0.0, -0.0749, true},  {0.5, 0.0, -0.0751, false}, {0.5, 0.029, 0.01, true}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k)
        for (int back = 0; back < 2; ++back) {
            hci_run *r = add_steady(back ? -3.0 : 3.0, back ? -1.0 : 1.0, CASE[k].swing_A,
                                    CASE[k].accelerating_Nm, CASE[k].swing_Nm);
            r->mean_is_unknown = true;
            find(false);
            TEST_ASSERT_EQUAL(CASE[k].hardly, r->hardly_accelerates);
            forget();
        }
}

/* ---- friction ---- */

/* T = 0.12 sign ω + 0.004 ω both ways; the speed swings by an eighth, and the weight of a sample is its
 * speed. */
static hci_run *add_rubbed(double turns, double at_rad_per_s)
{
    hci_run *r = add(turns);
    for (size_t k = 0; k < N; ++k) {
        const double way = at_rad_per_s < 0.0 ? -1.0 : 1.0;
        r->speed_rad_per_s[k] = at_rad_per_s * (1.0 + 0.125 * sin(0.17 * (double)(k * k)));
        set_current(r, k, (way * 0.12 + 0.004 * r->speed_rad_per_s[k]) / CONSTANT);
        r->torque_Nm[k] = 0.003 + 0.001 * way;
    }
    return r;
}

/* The means over whole turns, weighted with |ω|; of less than one turn over all samples. */
static void drag_is(const hci_run *r, double turns, const hci_drag *d)
{
    double sum = 0.0, speed = 0.0, square = 0.0, made = 0.0;
    for (size_t k = 0; k < N; ++k) {
        const double w = r->speed_rad_per_s[k], share = fabs(w), done = fabs(turns) * (double)k / (N - 1);
        if (fabs(turns) >= 1.0 && done >= floor(fabs(turns)) * (1.0 - 1e-12)) continue;
        sum += share;
        speed += share * w;
        square += share * w * fabs(w);
        made += share * ((w < 0.0 ? -0.12 : 0.12) + 0.004 * w - (w < 0.0 ? 0.002 : 0.004));
    }
    const double way = r->speed_rad_per_s[0] < 0.0 ? -1.0 : 1.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, made / sum, d->drag_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, way, d->sign);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, d->constant);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * fabs(speed / sum), speed / sum, d->speed_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * fabs(square / sum), square / sum, d->square);
}

static void test_friction(void)
{
    static const double TURNS[] = {2.7, -3.4, 0.6, -1.3}, AT[] = {20.0, -35.0, 60.0, -50.0};
    for (int k = 0; k < 4; ++k)
        (void)add_rubbed(TURNS[k], AT[k]);
    hci_run *moved = add_steady(3.0, 1.0, 0.0, 0.2, 0.0);
    find(true);
    for (int k = 0; k < 4; ++k) {
        TEST_ASSERT_TRUE(run[k].mean_is_unknown && run[k].hardly_accelerates);
        drag_is(&run[k], TURNS[k], &drag[k]);
        text_has("on average by the declared torque per ampere, and nothing accelerates", run[k].remark.text);
    }
    TEST_ASSERT_TRUE(isnan(drag[4].drag_Nm));
    TEST_ASSERT_FALSE(moved->mean_is_unknown || moved->hardly_accelerates);
    TEST_ASSERT_EQUAL_STRING("", moved->remark.text);
}

/* In one direction, or asked for nothing, it is no friction that is known. */
static void test_no_friction(void)
{
    (void)add_rubbed(2.7, 20.0);
    (void)add_rubbed(3.4, 35.0);
    find(true);
    TEST_ASSERT_TRUE(isnan(drag[0].drag_Nm) && isnan(drag[1].drag_Nm));
    TEST_ASSERT_NULL(strstr(run[0].remark.text, "nothing accelerates"));
    forget();
    (void)add_rubbed(2.7, 20.0);
    (void)add_rubbed(-3.4, -35.0);
    find(false);
    TEST_ASSERT_NULL(strstr(run[0].remark.text, "nothing accelerates"));
}

/* A run that turns both ways: the mean with the sign of the speed is what drags, and the larger one. */
static void test_a_run_both_ways(void)
{
    hci_run *r = add(2.3);
    double sum = 0.0, speed = 0.0, square = 0.0, sign = 0.0, made = 0.0;
    for (size_t k = 0; k < N; ++k) {
        const double w = k % 10 == 4   ? 0.0
                         : k % 10 == 9 ? 0.2
                                       : (k % 5 < 2 ? -1.0 : 1.0) * (10.0 + 0.02 * (double)k);
        const double way = (w > 0.0) - (w < 0.0);
        r->speed_rad_per_s[k] = w;
        set_current(r, k, (0.1 * way + 0.003 * w) / CONSTANT);
        if (2.3 * (double)k >= 2.0 * (N - 1)) continue;
        sum += fabs(w);
        sign += fabs(w) * way;
        speed += fabs(w) * fabs(w);
        square += fabs(w) * w * w;
        made += fabs(w) * (0.1 * fabs(way) + 0.003 * fabs(w));
    }
    (void)add_rubbed(-3.4, -35.0);
    (void)add_rubbed(3.4, 30.0);
    find(true);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, made / sum, drag[0].drag_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, drag[0].sign);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sign / sum, drag[0].constant);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, speed / sum, drag[0].speed_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, square / sum, drag[0].square);
}

/* A shaft that stands weighs all samples alike: a load is the mean over time. */
static void test_a_shaft_that_stands(void)
{
    hci_run *r = add(0.0);
    memset(r->speed_rad_per_s, 0, N * sizeof *r->speed_rad_per_s);
    for (size_t k = 0; k < N; ++k)
        set_current(r, k, k < N / 2 ? 0.2 : 0.8);
    machine.rated_torque_Nm = 1.0; /* 3/4 of the rms of 0.175 N·m are 0.131 */
    find(false);
    text_has("makes 0.15 N·m on average", r->remark.text);
}

static void test_without_memory(void)
{
    (void)add_rubbed(2.7, 20.0);
    (void)add_rubbed(-3.4, -35.0);
    for (long k = 0; k < 100; ++k) {
        memset(&note, 0, sizeof note);
        for (size_t j = 0; j < runs.count; ++j) {
            run[j].mean_is_unknown = false;
            memset(&run[j].remark, 0, sizeof run[j].remark);
        }
        hci_memory_fail_after(k);
        const hci_status status = hci_free_shafts_find(&machine, &NONE, run, runs.count, drag, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
        TEST_ASSERT_EQUAL(status != HCI_OK, note.text[0] != '\0');
        if (status == HCI_OK) return;
    }
    TEST_FAIL_MESSAGE("it never succeeds");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_largest_drag);
    RUN_TEST(test_the_words);
    RUN_TEST(test_half_accelerates);
    RUN_TEST(test_runs_together);
    RUN_TEST(test_what_hardly_accelerates);
    RUN_TEST(test_friction);
    RUN_TEST(test_no_friction);
    RUN_TEST(test_a_run_both_ways);
    RUN_TEST(test_a_shaft_that_stands);
    RUN_TEST(test_without_memory);
    return UNITY_END();
}
