/* What the page of a simulation says of its orders: the floor, the heading, and what stands beside a plain
 * sine. */
#include "host/report/page/simulation_spectrum.c"

#include <string.h>

#include "support/texts.h"
#include "unity.h"

enum { ORDERS = 9 };

static hci_simulation s;
static hci_plot_order order[ORDERS];
static hci_harmonic spectrum[ORDERS + 1], plain[2];

/* Orders 1 … 9 of 0.01 … 0.09 N·m, beside a torque of 2 ± 0.1 N·m. */
void setUp(void)
{
    memset(&s, 0, sizeof s);
    s.torque_Nm.most = 2.1;
    s.torque_Nm.least = 1.9;
    s.spectrum_Nm = spectrum;
    s.spectrum_count = ORDERS + 1;
    spectrum[0] = (hci_harmonic){0.0, 0.0, 2.0};
    for (size_t k = 0; k < ORDERS; ++k) {
        const double size_Nm = 0.01 * (double)(k + 1);
        order[k] = (hci_plot_order){
            .order = (double)(k + 1), .before_Nm = (double)NAN, .after_Nm = size_Nm, .noise_Nm = NAN};
        spectrum[k + 1] = (hci_harmonic){(double)(k + 1), 0.6 * size_Nm, -0.8 * size_Nm};
    }
}

void tearDown(void)
{
}

/* A plain sine has 0.3 N·m of order 6, and the same mean. */
static void compare(void)
{
    plain[0] = (hci_harmonic){0.0, 0.0, 2.0};
    plain[1] = (hci_harmonic){6.0, 0.18, 0.24};
    s.plain.torque_Nm = plain;
    s.plain.order_count = 2;
    for (size_t k = 0; k < ORDERS; ++k)
        order[k].before_Nm = hci_page_before_Nm(&s, order[k].order);
}

static void test_what_was_before(void)
{
    TEST_ASSERT_TRUE(isnan(hci_page_before_Nm(&s, 6.0)));
    compare();
    TEST_ASSERT_EQUAL_DOUBLE(2.0, hci_page_before_Nm(&s, 0.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3, hci_page_before_Nm(&s, 6.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_page_before_Nm(&s, 5.0));
}

static void test_the_heading(void)
{
    char text[256];
    heading_of(&s, order, text);
    TEST_ASSERT_EQUAL_STRING("The largest order, 9, has 0.09 N·m", text);
    order[0].after_Nm = order[1].after_Nm = 0.4;
    heading_of(&s, order, text);
    TEST_ASSERT_EQUAL_STRING("The largest order, 1, has 0.4 N·m", text);
    order[2].after_Nm = 0.5;
    heading_of(&s, order, text);
    TEST_ASSERT_EQUAL_STRING("The largest order, 3, has 0.5 N·m", text);
    compare();
    heading_of(&s, order, text);
    TEST_ASSERT_EQUAL_STRING("The largest order, 3, has 0.5 N·m; that of a plain sine has 0.3 N·m", text);
    for (size_t k = 0; k < ORDERS; ++k)
        order[k].after_Nm = 2e-12;
    heading_of(&s, order, text);
    TEST_ASSERT_EQUAL_STRING("No order is left; the largest of a plain sine has 0.3 N·m", text);
    order[4].after_Nm = 2.2e-12; /* 1e-12 of 2.1 N·m is rounding */
    heading_of(&s, order, text);
    TEST_ASSERT_EQUAL_STRING("The largest order, 5, has 2.2 pN·m; that of a plain sine has 0.3 N·m", text);
    s.plain.order_count = 0;
    order[4].after_Nm = 1e-12;
    heading_of(&s, order, text);
    TEST_ASSERT_EQUAL_STRING("No order is there", text);
}

/* The median of eight orders or more, unless it is rounding; they stay in their order. */
static void test_the_floor(void)
{
    order[0].after_Nm = 0.2;
    set_floor(order, 7, 1e-12);
    TEST_ASSERT_TRUE(isnan(order[0].noise_Nm));
    set_floor(order, ORDERS, 1e-12);
    for (size_t k = 0; k < ORDERS; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE((double)(k + 1), order[k].order);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.06, order[k].noise_Nm); /* 2 3 4 5 [6] 7 8 9 20 */
        order[k].noise_Nm = NAN;
    }
    set_floor(order, 8, 1e-12);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.06,
                              order[7].noise_Nm); /* 2 3 4 5 [6] 7 8 20, the first of which is 20 */
    order[0].noise_Nm = NAN;
    set_floor(order, ORDERS, 0.061);
    TEST_ASSERT_TRUE(isnan(order[0].noise_Nm));
    set_floor(order, ORDERS, 0.06);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.06, order[8].noise_Nm);
}

static void test_the_caption(void)
{
    char text[CAPTION_SIZE];
    caption_of(text, &s, NAN);
    TEST_ASSERT_EQUAL_STRING(
        "Over whole periods of the angle; the picture leaves the mean out. A strategy asks "
        "for a constant torque: it wants none of these orders.",
        text);
    compare();
    s.imposed = true;
    caption_of(text, &s, 0.06);
    text_has("leaves the mean out, and what is more than four decades below the largest. The currents are "
             "imposed",
             text);
    text_has("The floor is the median of all orders, 0.06 N·m: about what switching and noise", text);
}

/* The mean first, then by the larger of both; not what is rounding. */
static void test_which_orders_weigh(void)
{
    TEST_ASSERT_TRUE(order_weight(&s, 0) > 1e99);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.06, order_weight(&s, 6));
    compare();
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3, order_weight(&s, 6));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.09, order_weight(&s, 9));
    spectrum[3] = (hci_harmonic){3.0, 2e-12, 0.0};
    TEST_ASSERT_EQUAL_DOUBLE(0.0, order_weight(&s, 3));
    s.torque_Nm.most = 0.0; /* of a torque of −1.9 N·m as well */
    s.torque_Nm.least = -1.9;
    TEST_ASSERT_TRUE(order_weight(&s, 3) > 0.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_was_before);
    RUN_TEST(test_the_heading);
    RUN_TEST(test_the_floor);
    RUN_TEST(test_the_caption);
    RUN_TEST(test_which_orders_weigh);
    return UNITY_END();
}
