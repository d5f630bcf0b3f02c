/* Learning on the device against Fourier integrals in double precision: uneven speed, millions of samples,
 * noise, both directions, power cuts. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/learn.h"
#include "support/draws.h"
#include "support/reference.h"
#include "unity.h"

enum { ORDERS = 6, POINTS = 1536, MOST_BYTES = 1024 };

static const uint16_t ORDER[ORDERS] = {1, 6, 7, 24, 48, 96};

/* What the current is in truth: cogging and friction over the mechanical angle, cosine and sine. */
static const double COGGING[ORDERS][2] = {{0.02, -0.05}, {0.0, 0.0}, {0.3, 0.1},
                                          {-1.0, 2.0},   {0.4, 0.0}, {0.0, 0.2}};
static const double FRICTION[ORDERS][2] = {{0.1, 0.05},  {0.02, 0.0}, {0.0, 0.0},
                                           {0.01, 0.03}, {0.0, 0.0},  {0.0, 0.0}};
static const double LOAD = 0.25, COULOMB = 3.0;

static hci_learn learn;
static hci_learn_sums sums[ORDERS + 1];

void setUp(void)
{
    memset(&learn, 0xA5, sizeof learn); /* nothing of what was there before is left */
    hci_learn_start(&learn, ORDER, ORDERS, sums, 4096);
}
void tearDown(void)
{
}

static double current(double theta_rad, int direction)
{
    double i = LOAD + direction * COULOMB;
    for (int k = 0; k < ORDERS; ++k) {
        i += (COGGING[k][0] + direction * FRICTION[k][0]) * cos(ORDER[k] * theta_rad);
        i += (COGGING[k][1] + direction * FRICTION[k][1]) * sin(ORDER[k] * theta_rad);
    }
    return i;
}

/* How the shaft turns and is sampled. */
typedef struct {
    double samples_per_turn, unevenness; /* the speed varies by this share, in step with order 24 */
    double noise_A;
    uint32_t counts; /* of the encoder; 0: any angle */
    uint64_t seed;
} turning;

static uint32_t angle_of(double theta_rad, uint32_t counts)
{
    const double turns = theta_rad / (2.0 * REF_PI), share = turns - floor(turns);
    if (counts == 0) return (uint32_t)(int64_t)(share * 4294967296.0);
    return (uint32_t)((uint64_t)floor(share * counts) * (4294967296u / counts));
}

/* Turns from where the shaft stands until so many turns are whole, and an end that is not. */
static void turn(turning *t, double *theta_rad, int direction, double turns)
{
    const double end = *theta_rad + direction * (turns * 2.0 * REF_PI + 0.03);
    hci_learn_turn(&learn, direction);
    while (direction * (end - *theta_rad) > 0.0) {
        const double i = current(*theta_rad, direction) + t->noise_A * ref_normal(&t->seed);
        hci_learn_sample(&learn, angle_of(*theta_rad, t->counts), (float)i);
        (void)hci_learn_work(&learn);
        *theta_rad += direction * 2.0 * REF_PI / t->samples_per_turn *
                      (1.0 + t->unevenness * cos(24.0 * *theta_rad + 1.0));
    }
}

static void turn_both_ways(turning t, double turns)
{
    double theta_rad = 0.37;
    turn(&t, &theta_rad, 1, turns);
    turn(&t, &theta_rad, -1, turns);
}

/* Largest error of any coordinate of cogging and friction. */
static double worst_error(void)
{
    double worst = 0.0;
    hci_learn_result x;
    for (uint32_t k = 0; k < ORDERS; ++k) {
        TEST_ASSERT_TRUE(hci_learn_result_of(&learn, k + 1, &x));
        TEST_ASSERT_EQUAL_UINT32(ORDER[k], x.order);
        for (int a = 0; a < 2; ++a) {
            worst = ref_worse(worst, (double)x.cogging[a] - COGGING[k][a]);
            worst = ref_worse(worst, (double)x.friction[a] - FRICTION[k][a]);
        }
    }
    TEST_ASSERT_TRUE(hci_learn_result_of(&learn, 0, &x));
    worst = ref_worse(worst, (double)x.cogging[0] - LOAD);
    return ref_worse(worst, (double)x.friction[0] - COULOMB);
}

static void test_there_is_no_work_before_a_sample(void)
{
    TEST_ASSERT_EQUAL_INT(0, hci_learn_work(&learn));
}

static void test_cogging_and_friction_apart(void)
{
    turn_both_ways((turning){40000.0, 0.0, 0.0, 0, 1}, 2.0);
    TEST_ASSERT_EQUAL_UINT32(2, learn.turns_forward);
    TEST_ASSERT_EQUAL_UINT32(2, learn.turns_backward);
    TEST_ASSERT_DOUBLE_WITHIN(2e-5, 0.0, worst_error());
}

/* A speed that varies by a third in step with the cogging would make order 24 out of friction where samples
 * counted alike. */
static void test_uneven_speed(void)
{
    turn_both_ways((turning){40000.0, 0.33, 0.0, 0, 2}, 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.0, worst_error());
}

/* Few samples: each is a step of its own, some are two. What the ends of steps lose is put back. */
static void test_few_samples(void)
{
    turn_both_ways((turning){3000.0, 0.0, 0.0, 0, 3}, 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 0.0, worst_error());
    setUp();
    turn_both_ways((turning){6000.0, 0.3, 0.0, 0, 3}, 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-2, 0.0, worst_error());
}

/* A million samples a turn, and the angle in whole counts. */
static void test_rounding_does_not_add_up(void)
{
    turn_both_ways((turning){1e6, 0.1, 0.0, 0, 4}, 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.0, worst_error());
}

static void test_encoder_of_whole_counts(void)
{
    turn_both_ways((turning){40000.0, 0.1, 0.0, 4096, 5}, 2.0);
    /* half a count turns order 24, whose amplitude is √5 A, by 24π/4096 */
    TEST_ASSERT_DOUBLE_WITHIN(1.02 * sqrt(5.0) * 24.0 * REF_PI / 4096.0, 0.0, worst_error());
}

/* A shaft that stands for a long time, and goes on: the mean of a step is that of its samples. */
static void test_standing_for_long(void)
{
    hci_learn_turn(&learn, 1);
    for (int k = 0; k < 1000000; ++k)
        hci_learn_sample(&learn, 5u, 1.7f);
    hci_learn_sample(&learn, 5u + learn.step, 1.7f);
    TEST_ASSERT_TRUE(learn.done.full);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 1.7f, learn.done.value);
}

/* The shaft stands, shakes, and goes back by a step: nothing is counted twice. */
static void test_standing_and_shaking(void)
{
    turning t = {20000.0, 0.0, 0.0, 0, 6};
    double theta_rad = 0.37;
    for (int direction = 1; direction >= -1; direction -= 2) {
        hci_learn_turn(&learn, direction);
        for (int k = 0; k < 60000; ++k) {
            const double shaken = theta_rad + 0.0015 * sin(0.5 * k);
            hci_learn_sample(&learn, angle_of(shaken, 0), (float)current(shaken, direction));
            (void)hci_learn_work(&learn);
            if (k % 3000 < 2500) theta_rad += direction * 2.0 * REF_PI / t.samples_per_turn;
        }
    }
    TEST_ASSERT_EQUAL_UINT32(2, learn.turns_forward);
    TEST_ASSERT_DOUBLE_WITHIN(5e-2, 0.0, worst_error());
}

/* A hand turns the shaft back by a tenth: the turn begins anew, and the sums are none the worse. */
static void test_a_turn_that_is_lost(void)
{
    turning t = {40000.0, 0.0, 0.0, 0, 7};
    double theta_rad = 0.37;
    hci_learn_turn(&learn, 1);
    for (int k = 0; k < 110000; ++k) {
        if (k % 1000 == 7) hci_learn_sample(&learn, angle_of(theta_rad, 0), k % 2000 == 7 ? NAN : -INFINITY);
        if (k == 30000) theta_rad -= 0.6;
        if (k == 60000) theta_rad += 0.6;
        hci_learn_sample(&learn, angle_of(theta_rad, 0), (float)current(theta_rad, 1));
        (void)hci_learn_work(&learn);
        theta_rad += 2.0 * REF_PI / t.samples_per_turn;
    }
    TEST_ASSERT_EQUAL_UINT32(1, learn.turns_forward);
    turn(&t, &theta_rad, -1, 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(5e-5, 0.0, worst_error());
    hci_learn_turn(&learn, 0);
    hci_learn_sample(&learn, 0u, 1e9f);
    TEST_ASSERT_EQUAL_INT(0, hci_learn_work(&learn));
}

/* A background that comes late makes steps wider, and loses nothing. */
static void test_late_background(void)
{
    double theta_rad = 0.0;
    for (int direction = 1; direction >= -1; direction -= 2) {
        hci_learn_turn(&learn, direction);
        for (int k = 0; k < 81000; ++k) {
            hci_learn_sample(&learn, angle_of(theta_rad, 0), (float)current(theta_rad, direction));
            if (k % 27 == 0) (void)hci_learn_work(&learn);
            theta_rad += direction * 2.0 * REF_PI / 40000.0;
        }
    }
    TEST_ASSERT_EQUAL_UINT32(2, learn.turns_forward);
    TEST_ASSERT_EQUAL_UINT32(2, learn.turns_backward);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.0, worst_error());
}

/* Squared errors of order 24 by the squared standard errors that are stated, both coordinates, many times
 * over. */
static void test_standard_error_is_that_of_the_noise(void)
{
    double sum = 0.0, stated = 0.0;
    int stand_out = 0;
    enum { TIMES = 60 };
    for (int n = 0; n < TIMES; ++n) {
        hci_learn_result x = {0};
        setUp();
        turn_both_ways((turning){8192.0, 0.0, 2.0, 0, 100 + (uint64_t)n}, 3.0);
        TEST_ASSERT_TRUE(hci_learn_result_of(&learn, 4, &x));
        for (int a = 0; a < 2; ++a)
            sum += pow((double)x.cogging[a] - COGGING[3][a], 2.0);
        stated += 2.0 * (double)x.error * (double)x.error;
        TEST_ASSERT_TRUE(hci_learn_result_of(&learn, 2, &x));
        stand_out += hci_learn_stands_out(&x, 3.0f);
    }
    /* An order that is not there is beyond 3 errors in (1 + 9/8)^−4 = 4.9 % of all cases with 8 degrees of
     * freedom: in 60 cases 2.9 ± 1.7. */
    TEST_ASSERT_INT_WITHIN(5, 3, stand_out);
    TEST_ASSERT_TRUE(stand_out > 0);
    /* 120 squared normal numbers have a deviation of 13 %, the 8 degrees of freedom of each estimate 6 % */
    TEST_ASSERT_DOUBLE_WITHIN(0.4, 1.0, sum / stated);
    /* and by theory: white noise of 2 A in 6 turns of 8192 samples, the coordinate of a sum of two */
    TEST_ASSERT_DOUBLE_WITHIN(0.25, 1.0, sqrt(stated / (2 * TIMES)) / (2.0 * sqrt(2.0 / (6.0 * 8192.0))));
}

static void test_too_few_turns(void)
{
    turning t = {20000.0, 0.0, 0.0, 0, 8};
    hci_learn_result x;
    double theta_rad = 0.0;
    float row[2 * (POINTS + 1)];
    hci_table_f32 table;
    const hci_learn_table_options options = {POINTS, 2, 1, 3.0f, 0};
    turn(&t, &theta_rad, 1, 2.0);
    TEST_ASSERT_FALSE(hci_learn_result_of(&learn, 1, &x));
    TEST_ASSERT_EQUAL_UINT32(0, hci_learn_table(&learn, &options, row, &table));
    setUp();
    turn_both_ways(t, 1.0);
    TEST_ASSERT_TRUE(hci_learn_result_of(&learn, 4, &x));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, x.error);
}

/* Whole turns in one direction alone, or one in each: nothing is known, or no error. */
static void test_turns_of_one_direction(void)
{
    hci_learn_result x = {0, {1.0f, 0.0f}, {0.0f, 0.0f}, -1.0f};
    static const uint32_t TURNS[4][2] = {{0, 0}, {3, 0}, {0, 3}, {1, 1}};
    for (int k = 0; k < 4; ++k) {
        learn.turns_forward = TURNS[k][0];
        learn.turns_backward = TURNS[k][1];
        TEST_ASSERT_EQUAL_FLOAT(-1.0f, hci_learn_error(&learn, 1));
        TEST_ASSERT_EQUAL(k == 3, hci_learn_result_of(&learn, 1, &x));
        TEST_ASSERT_EQUAL_FLOAT(0.0f, hci_learn_square_of(&learn, 1, k == 3 ? -1.0f : 1.0f));
    }
    TEST_ASSERT_TRUE(hci_learn_stands_out(&x, 6.0f)); /* an error that is not known leaves no order out */
}

/* An order without any current makes a table of zeros, one that is exactly known too. */
static void test_table_of_nothing(void)
{
    float row[2 * (POINTS + 1)];
    hci_table_f32 table;
    const hci_learn_table_options options = {POINTS, 2, 1, 0.0f, 0};
    learn.turns_forward = learn.turns_backward = 3;
    TEST_ASSERT_EQUAL_UINT32(ORDERS, hci_learn_table(&learn, &options, row, &table));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, table.peak_A);
    for (int k = 0; k < 2 * (POINTS + 1); ++k)
        TEST_ASSERT_EQUAL_FLOAT(0.0f, row[k]);
}

/* 3 sin + 4 cos is 5: at six errors it stands out, below it does not; with an error that nobody knows it
 * does. */
static void test_what_stands_out(void)
{
    hci_learn_result x = {0};
    x.cogging[0] = 3.0f;
    x.cogging[1] = -4.0f;
    x.error = 1.25f;
    TEST_ASSERT_EQUAL_INT(1, hci_learn_stands_out(&x, 4.0f));
    TEST_ASSERT_EQUAL_INT(0, hci_learn_stands_out(&x, 4.01f));
    x.cogging[1] = -3.99f;
    TEST_ASSERT_EQUAL_INT(0, hci_learn_stands_out(&x, 4.0f));
    x.error = 0.0f;
    TEST_ASSERT_EQUAL_INT(1, hci_learn_stands_out(&x, 4.0f));
    x.error = -1.0f;
    TEST_ASSERT_EQUAL_INT(1, hci_learn_stands_out(&x, 1000.0f));
}

static float table_rows[2 * (POINTS + 1)];

/* The table is the cogging, within the error that it states; friction is not in it, nor what is only noise.
 */
static void test_table(void)
{
    hci_table_f32 table;
    for (int with_mean = 0; with_mean <= 1; ++with_mean) {
        const hci_learn_table_options options = {POINTS, 4, 1, 6.0f, with_mean};
        setUp();
        turn_both_ways((turning){40000.0, 0.1, 0.2, 0, 9}, 3.0);
        const uint32_t taken = hci_learn_table(&learn, &options, table_rows, &table);
        TEST_ASSERT_EQUAL_UINT32(5u + (uint32_t)with_mean, taken); /* order 6 has friction alone */
        TEST_ASSERT_EQUAL(HCI_TABLE_GOOD, hci_table_f32_check(&table));
        TEST_ASSERT_EQUAL_UINT32(4, table.period_turns);
        for (uint32_t k = 0; k < 5000; ++k) {
            const double theta = 2.0 * REF_PI * k / 5000.0;
            const hci_currents_dq i = hci_table_f32_dq(&table, angle_of(theta, 0));
            const double exact = 0.5 * (current(theta, 1) + current(theta, -1)) - (with_mean ? 0.0 : LOAD);
            TEST_ASSERT_EQUAL_FLOAT(0.0f, i.id_A);
            TEST_ASSERT_DOUBLE_WITHIN((double)table.max_error_A + 0.01, exact, (double)i.iq_A);
        }
        double peak_A = 0.0,
               error_A = 0.0; /* a straight line between points, of a sine of n periods in a turn */
        for (int j = 0; j < ORDERS; ++j) {
            const double amplitude_A = hypot(COGGING[j][0], COGGING[j][1]),
                         way = 2.0 * REF_PI * ORDER[j] / POINTS;
            peak_A += amplitude_A;
            error_A += way * way / 8.0 * amplitude_A;
        }
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * error_A, error_A, (double)table.max_error_A);
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * peak_A, peak_A + (with_mean ? LOAD : 0.0), (double)table.peak_A);
    }
}

/* Orders that repeat need a part of the turn. */
static void test_table_of_a_part(void)
{
    const hci_learn_table_options options = {256, 4, 24, 6.0f, 0};
    hci_table_f32 table;
    turn_both_ways((turning){40000.0, 0.1, 0.2, 0, 11}, 3.0);
    TEST_ASSERT_EQUAL_UINT32(3, hci_learn_table(&learn, &options, table_rows, &table));
    TEST_ASSERT_EQUAL_UINT32(0, table.period_turns);
    for (uint32_t k = 0; k < 5000; ++k) {
        const double theta = 2.0 * REF_PI * k / 5000.0;
        double exact = 0.0;
        for (int j = 3; j < ORDERS; ++j)
            exact += COGGING[j][0] * cos(ORDER[j] * theta) + COGGING[j][1] * sin(ORDER[j] * theta);
        const hci_currents_dq i = hci_table_f32_dq(&table, 24u * angle_of(theta, 0));
        TEST_ASSERT_DOUBLE_WITHIN((double)table.max_error_A + 0.005, exact, (double)i.iq_A);
    }
}

/* ---- the blob ---- */

static unsigned char bytes[MOST_BYTES];
static const hci_learn_facts FACTS = {5, 2, HCI_LEARN_AMPERE, 0.2f};

static uint32_t write_blob(void)
{
    turn_both_ways((turning){20000.0, 0.1, 0.5, 0, 10}, 2.0);
    const uint32_t size = hci_learn_write(&learn, &FACTS, bytes, MOST_BYTES);
    TEST_ASSERT_EQUAL_UINT32(hci_learn_bytes(ORDERS), size);
    TEST_ASSERT_EQUAL_UINT32(size, hci_learn_write(&learn, &FACTS, bytes, size));
    TEST_ASSERT_EQUAL_UINT32(0, hci_learn_write(&learn, &FACTS, bytes + 500, size - 1));
    return size;
}

static void test_blob_restores_what_was_learnt(void)
{
    const uint32_t size = write_blob();
    hci_learn_sums other[ORDERS + 1];
    hci_learn_facts facts;
    hci_learn again;
    memset(&facts, 0xA5, sizeof facts);
    hci_learn_start(&again, ORDER, ORDERS, other, 4096);
    TEST_ASSERT_EQUAL(HCI_BLOB_GOOD, hci_learn_check(bytes, size, &facts));
    TEST_ASSERT_EQUAL_MEMORY(&FACTS, &facts, sizeof facts);
    TEST_ASSERT_EQUAL(HCI_BLOB_GOOD, hci_learn_restore(&again, bytes, MOST_BYTES));
    for (uint32_t k = 0; k <= ORDERS; ++k) {
        hci_learn_result x, y;
        TEST_ASSERT_TRUE(hci_learn_result_of(&learn, k, &x) && hci_learn_result_of(&again, k, &y));
        TEST_ASSERT_EQUAL_FLOAT_ARRAY(x.cogging, y.cogging, 2);
        TEST_ASSERT_EQUAL_FLOAT_ARRAY(x.friction, y.friction, 2);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f * x.error, x.error, y.error);
    }
    static const uint16_t others[ORDERS] = {1, 6, 7, 24, 48, 97};
    hci_learn_start(&again, others, ORDERS, other, 4096);
    TEST_ASSERT_EQUAL(HCI_BLOB_OTHER_KIND, hci_learn_restore(&again, bytes, size));
    hci_learn_start(&again, ORDER, ORDERS - 1, other, 4096);
    TEST_ASSERT_EQUAL(HCI_BLOB_OTHER_KIND, hci_learn_restore(&again, bytes, size));
    TEST_ASSERT_EQUAL_UINT32(0, again.turns_forward);
}

/* More orders than there may be make no blob, whatever the room; a blob that is none restores nothing. */
static void test_no_blob(void)
{
    static unsigned char room[HCI_LEARN_HEAD + 1100 * HCI_LEARN_ORDER];
    const hci_learn before = learn;
    learn.order_count = HCI_LEARN_MOST_ORDERS + 1;
    TEST_ASSERT_EQUAL_UINT32(0, hci_learn_write(&learn, &FACTS, room, sizeof room));
    learn.order_count = ORDERS;
    TEST_ASSERT_EQUAL(HCI_BLOB_NONE, hci_learn_restore(&learn, room, sizeof room));
    TEST_ASSERT_EQUAL(HCI_BLOB_NONE, hci_learn_check(room, 12, NULL)); /* what tells one is there */
    TEST_ASSERT_EQUAL(HCI_BLOB_CUT_OFF, hci_learn_check(room, 11, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&before, &learn, sizeof learn);
}

/* As many orders as there may be. */
static void test_blob_of_the_most_orders(void)
{
    static unsigned char room[HCI_LEARN_HEAD + 1100 * HCI_LEARN_ORDER];
    static uint16_t order[HCI_LEARN_MOST_ORDERS];
    static hci_learn_sums many[HCI_LEARN_MOST_ORDERS + 1];
    for (uint16_t k = 0; k < HCI_LEARN_MOST_ORDERS; ++k)
        order[k] = (uint16_t)(k + 1);
    hci_learn_start(&learn, order, HCI_LEARN_MOST_ORDERS, many, 4096);
    const uint32_t size = hci_learn_write(&learn, &FACTS, room, sizeof room);
    TEST_ASSERT_EQUAL_UINT32(hci_learn_bytes(HCI_LEARN_MOST_ORDERS), size);
    TEST_ASSERT_EQUAL(HCI_BLOB_GOOD, hci_learn_check(room, size, NULL));
}

static void test_every_damage_is_refused(void)
{
    const uint32_t size = write_blob();
    for (uint32_t k = 0; k < size; ++k) {
        unsigned char *part = malloc(k > 0 ? k : 1); /* a byte too far is seen by the sanitizer */
        memcpy(part, bytes, k);
        TEST_ASSERT_TRUE(hci_learn_check(part, k, NULL) == HCI_BLOB_CUT_OFF);
        free(part);
    }
    for (uint32_t bit = 0; bit < 8 * size; ++bit) {
        bytes[bit / 8] = (unsigned char)(bytes[bit / 8] ^ 1u << bit % 8);
        TEST_ASSERT_TRUE(hci_learn_check(bytes, MOST_BYTES, NULL) != HCI_BLOB_GOOD);
        bytes[bit / 8] = (unsigned char)(bytes[bit / 8] ^ 1u << bit % 8);
    }
    TEST_ASSERT_EQUAL(HCI_BLOB_GOOD, hci_learn_check(bytes, size, NULL));
    bytes[6] += 1; /* more orders than bytes, and a CRC that is right */
    hci_learn_put_u32(bytes, size - 4, hci_blob_crc32(bytes, size - 4));
    TEST_ASSERT_EQUAL(HCI_BLOB_DAMAGED, hci_learn_check(bytes, MOST_BYTES, NULL));
    bytes[4] = 2;
    TEST_ASSERT_EQUAL(HCI_BLOB_NEWER, hci_learn_check(bytes, size, NULL));
    memset(bytes, 0xFF, sizeof bytes);
    TEST_ASSERT_EQUAL(HCI_BLOB_NONE, hci_learn_check(bytes, size, NULL));
}

/* Two places in flash, written in turn: wherever the power fails, the last that was whole is found. */
static void test_power_cut_at_every_byte(void)
{
    const uint32_t size = write_blob();
    static unsigned char place[2][MOST_BYTES], next[MOST_BYTES];
    hci_learn_facts facts = FACTS;
    memset(place, 0xFF, sizeof place);
    TEST_ASSERT_NULL(hci_learn_newest(place[0], place[1], MOST_BYTES));
    memcpy(place[0], bytes, size);
    for (facts.sequence = 6; facts.sequence < 9; ++facts.sequence) {
        unsigned char *to = place[facts.sequence % 2 == 0], *old = place[facts.sequence % 2];
        TEST_ASSERT_EQUAL_UINT32(size, hci_learn_write(&learn, &facts, next, MOST_BYTES));
        for (uint32_t cut = 0; cut <= size; ++cut) {
            memset(to, 0xFF, MOST_BYTES);
            memcpy(to, next, cut);
            const void *found = hci_learn_newest(place[0], place[1], MOST_BYTES);
            TEST_ASSERT_TRUE(found == (cut == size ? to : old));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_there_is_no_work_before_a_sample);
    RUN_TEST(test_cogging_and_friction_apart);
    RUN_TEST(test_uneven_speed);
    RUN_TEST(test_few_samples);
    RUN_TEST(test_rounding_does_not_add_up);
    RUN_TEST(test_encoder_of_whole_counts);
    RUN_TEST(test_standing_for_long);
    RUN_TEST(test_standing_and_shaking);
    RUN_TEST(test_a_turn_that_is_lost);
    RUN_TEST(test_late_background);
    RUN_TEST(test_standard_error_is_that_of_the_noise);
    RUN_TEST(test_too_few_turns);
    RUN_TEST(test_turns_of_one_direction);
    RUN_TEST(test_table_of_nothing);
    RUN_TEST(test_what_stands_out);
    RUN_TEST(test_table);
    RUN_TEST(test_table_of_a_part);
    RUN_TEST(test_blob_restores_what_was_learnt);
    RUN_TEST(test_no_blob);
    RUN_TEST(test_blob_of_the_most_orders);
    RUN_TEST(test_every_damage_is_refused);
    RUN_TEST(test_power_cut_at_every_byte);
    return UNITY_END();
}
