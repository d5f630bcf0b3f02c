/* What may be asked of a waveform: pole pairs and orders, each bound from both sides. A run without an angle
 * is refused behind that, which tells the ones that may. */
#include <math.h>
#include <string.h>

#include "hci/host/waveform/waveform.h"
#include "hci/math/harmonic.h"
#include "unity.h"

static char name[] = "a.csv";
static hci_run run;
static hci_waveform_options options;
static hci_waveform waveform;
static hci_note note;
static double orders[3];

void setUp(void)
{
    memset(&run, 0, sizeof run);
    run.name = name;
    options = (hci_waveform_options){
        .quantity = HCI_WAVEFORM_COGGING, .pole_pairs = 1, .max_order = NAN, .torque_constant_Nm_per_A = NAN};
}

void tearDown(void)
{
}

static void expect(hci_status status, const char *text)
{
    memset(&note, 0, sizeof note);
    memset(&waveform, 7, sizeof waveform);
    TEST_ASSERT_EQUAL_INT(status, hci_waveform_find(&run, &options, &waveform, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, text), note.text);
    TEST_ASSERT_TRUE(waveform.count == 0 && !waveform.order && waveform.remark.text[0] == '\0');
}

static void expect_orders(double a, double b, double c, const char *refused)
{
    orders[0] = a;
    orders[1] = b;
    orders[2] = c;
    options.orders = orders;
    options.order_count = 3;
    expect(refused ? HCI_ERROR_ARGUMENT : HCI_ERROR_INPUT, refused ? refused : "no angle");
}

static void test_pole_pairs(void)
{
    expect(HCI_ERROR_INPUT, "no angle");
    options.pole_pairs = 0;
    expect(HCI_ERROR_ARGUMENT, "found 0 pole pairs, expected 1 or more");
}

/* Above the tolerance of an order, up to the highest there is. */
static void test_bounds_of_orders(void)
{
    expect_orders(1.01 * HCI_ORDER_TOLERANCE, 2.0, HCI_MOST_ORDER, NULL);
    expect_orders(0.99 * HCI_ORDER_TOLERANCE, 2.0, 3.0, "expected one above 0, at most");
    expect_orders(1.0, 2.0, 1.001 * HCI_MOST_ORDER, "expected one above 0, at most");
    expect_orders(1.0, NAN, 3.0, "order nan: expected one above 0");
    expect_orders(-1.0, 2.0, 3.0, "order -1: expected one above 0");
}

/* Each once, apart by more than the tolerance, wherever they stand. */
static void test_orders_that_ascend(void)
{
    expect_orders(1.0, 2.0, 2.0 + 1.01 * HCI_ORDER_TOLERANCE, NULL);
    expect_orders(1.0, 2.0, 2.0 + 0.99 * HCI_ORDER_TOLERANCE, "order 2: expected each once and ascending");
    expect_orders(5.0, 3.0, 6.0, "order 3: expected each once and ascending");
    expect_orders(5.0, 6.0, 4.0, "order 4: expected each once and ascending");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_pole_pairs);
    RUN_TEST(test_bounds_of_orders);
    RUN_TEST(test_orders_that_ascend);
    return UNITY_END();
}
