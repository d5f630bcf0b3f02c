/* The reader of name, value, unit: conversion, what stands for the wanted unit, and what is refused. */
#include "host/csv/name_values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "unity.h"

static char path[64];
static hci_csv *csv;
static hci_note note;

void setUp(void)
{
    snprintf(path, sizeof path, "/tmp/hci-test-name-values-XXXXXX");
    close(mkstemp(path));
    note.text[0] = '\0';
    csv = NULL;
}

void tearDown(void)
{
    hci_csv_free(csv);
    unlink(path);
}

static void read_text(const char *text)
{
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fputs(text, file);
    fclose(file);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_csv_read(path, &csv, &note), note.text);
}

static void expect_value(size_t row, const char *unit, double wanted)
{
    double value = NAN;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_value_read(csv, row, unit, &value, &note), note.text);
    TEST_ASSERT_EQUAL_DOUBLE(wanted, value);
}

static void expect_refused(size_t row, const char *unit, const char *words)
{
    double value;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_value_read(csv, row, unit, &value, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, words), note.text);
}

static void test_values_come_in_the_unit_that_is_wanted(void)
{
    read_text("name,value,unit\nspeed,1500,rpm\ninductance,12,mH\nangle,180,deg\n");
    expect_value(0, "rad_per_s", 1500.0 * (2.0 * 3.14159265358979323846 / 60.0));
    expect_value(1, "H", 12e-3);
    expect_value(2, "rad", 3.14159265358979323846);
}

static void test_no_unit_stands_for_the_wanted_one(void)
{
    read_text("name,value,unit\na,3,\nb,4,1\nc,5,-\nd,6,count\n");
    expect_value(0, "A", 3.0);
    expect_value(1, "A", 4.0);
    expect_value(2, "A", 5.0);
    expect_value(3, "count", 6.0);
}

static void test_the_column_of_units_may_be_missing(void)
{
    read_text("name,value\na,3\n");
    expect_value(0, "A", 3.0);
}

static void test_a_unit_of_another_quantity_is_refused(void)
{
    read_text("name,value,unit\nspeed,1500,ohm\n");
    expect_refused(0, "rad_per_s", "a unit that converts to rad_per_s");
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, ":2:"), note.text);
}

static void test_what_is_no_number_is_refused(void)
{
    read_text("name,value,unit\nspeed,fast,rpm\n");
    expect_refused(0, "rad_per_s", "a finite number");
}

static void test_a_name_is_found_once(void)
{
    double speed = NAN, torque = NAN;
    const hci_named_value list[] = {{"speed", "rad_per_s", &speed}, {"torque", "Nm", &torque}};
    size_t at = 99;
    read_text("name,value\ntorque,2\nother,1\ntorque,3\n");
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_named_value_find(csv, 0, list, 2, &at, &note));
    TEST_ASSERT_EQUAL_UINT(1, at);
    TEST_ASSERT_TRUE(isnan(torque));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_value_read(csv, 0, list[at].unit, list[at].value, &note));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, torque);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_named_value_find(csv, 1, list, 2, &at, &note));
    TEST_ASSERT_EQUAL_UINT(2, at);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_named_value_find(csv, 2, list, 2, &at, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "each name once"), note.text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_values_come_in_the_unit_that_is_wanted);
    RUN_TEST(test_no_unit_stands_for_the_wanted_one);
    RUN_TEST(test_the_column_of_units_may_be_missing);
    RUN_TEST(test_a_unit_of_another_quantity_is_refused);
    RUN_TEST(test_what_is_no_number_is_refused);
    RUN_TEST(test_a_name_is_found_once);
    return UNITY_END();
}
