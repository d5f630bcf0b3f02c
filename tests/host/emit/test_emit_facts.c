/* What the folder of a machine says for the head of a table. */
#include "hci/host/emit/emit_facts.h"

#include <string.h>

#include "hci/host/machine/machine.h"
#include "support/files.h"
#include "unity.h"

static hci_machine_data machine;
static hci_emit_facts facts;
static hci_note note;

void setUp(void)
{
    files_begin();
    files_write(files_path("machine.csv"), "name,value\npole_pairs,3\n");
    files_write(files_path("back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,0.5,0\n");
    memset(&facts, 0, sizeof facts);
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    hci_machine_release(&machine);
    files_end();
}

static void facts_read(void)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_emit_facts_read(files_root, &machine, &facts, &note),
                                  note.text);
    TEST_ASSERT_EQUAL_UINT64(3, facts.pole_pairs);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, facts.rated_speed_rad_per_s); /* is not given */
}

static void test_magnets(void)
{
    files_write(files_path("effects.csv"), "effect,parameter,value,unit,std_error\n"
                                           "magnet_temperature,emf_per_kelvin,-0.0011,1/K,0.0001\n"
                                           "magnet_temperature,reference,25,C,\n");
    facts_read();
    TEST_ASSERT_EQUAL_DOUBLE(-0.0011, facts.emf_per_kelvin);
    TEST_ASSERT_EQUAL_DOUBLE(25.0, facts.magnets_C);
}

static void test_nothing_of_magnets(void)
{
    facts_read();
    TEST_ASSERT_EQUAL_DOUBLE(0.0, facts.emf_per_kelvin);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, facts.magnets_C);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_magnets);
    RUN_TEST(test_nothing_of_magnets);
    return UNITY_END();
}
