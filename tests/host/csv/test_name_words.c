/* Names of columns in plain words: what is read, what is not, the words of docs/files.md, and the text export
 * of TwinCAT Scope. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "host/csv/name_words.h"
#include "host/csv/parameter_name.h"
#include "host/csv/table.h"
#include "support/files.h"
#include "support/reference.h"
#include "support/texts.h"
#include "unity.h"

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static hci_status read_text(const char *text, hci_csv **csv, hci_note *note)
{
    files_write(files_path("table.csv"), text);
    return hci_csv_read_recording(files_path("table.csv"), csv, note);
}

static const char *const ASKED[] = {"time_s",
                                    "theta_m_rad",
                                    "theta_e_rad",
                                    "speed_rad_per_s",
                                    "speed_e_rad_per_s",
                                    "ia_A",
                                    "ib_A",
                                    "ic_A",
                                    "id_A",
                                    "iq_A",
                                    "torque_Nm",
                                    "torque_computed_Nm",
                                    "va_V",
                                    "vb_V",
                                    "vc_V",
                                    "vab_V",
                                    "vbc_V",
                                    "vca_V",
                                    "vd_V",
                                    "vq_V",
                                    "temperature_C"};
enum { ASKED_COUNT = sizeof ASKED / sizeof *ASKED };

/* is: the quantity, "unclear" for an angle of either kind, "" for nothing. */
static const struct {
    const char *header, *is;
} NAMES[] = {
    {"Uhrzeit", "time_s"},
    {"Heure", "time_s"},
    {"Zeit [hh:mm:ss]", "time_s"},
    {"Time (HH:MM:SS.fff)", "time_s"},
    {"Zeitstempel", "time_s"},
    {"Zeit  1 - Standardmessrate [s]", "time_s"},
    {"Time  1 - default sample rate [ms]", "time_s"},
    {"Rotorwinkel mech. [°]", "theta_m_rad"},
    {"Mech. Winkel [°]", "theta_m_rad"},
    {"Winkel (mech.) [Grad]", "theta_m_rad"},
    {"Angle mécanique rotor (°)", "theta_m_rad"},
    {"ANGLE MÉCANIQUE [°]", "theta_m_rad"},
    {"Läuferlage elektrisch [rad]", "theta_e_rad"},
    {"Drehwinkel [Grad]", "unclear"},
    {"Position angulaire [°]", "unclear"},
    {"Posición angular (°)", "unclear"},
    {"Lageistwert [°]", "unclear"},
    {"Position [mm]", ""},
    {"Posición", ""},
    {"Phase angle [°]", ""},
    {"Vitesse [tr/min]", "speed_rad_per_s"},
    {"Drehzahl [U/min]", "speed_rad_per_s"},
    {"Drehzahl in min⁻¹", "speed_rad_per_s"},
    {"Istdrehzahl", "speed_rad_per_s"},
    {"n_ist [1/min]", "speed_rad_per_s"},
    {"n_ist", ""},
    {"Geschwindigkeit [m/s]", ""},
    {"Drehzahl soll [U/min]", ""},
    {"Consigne vitesse [tr/min]", ""},
    {"Phasenstrom 1", "ia_A"},
    {"Phasenstrom2 [A]", "ib_A"},
    {"Courant phase 1", "ia_A"},
    {"Courant phase 3 [mA]", "ic_A"},
    {"Phase B Current (A)", "ib_A"},
    {"PhaseCurrentC [A]", "ic_A"},
    {"Strom L2 gemessen [A]", "ib_A"},
    {"Iq ist [A]", "iq_A"},
    {"Stromistwert momentenbildend [A]", "iq_A"},
    {"Corriente fase W (A)", "ic_A"},
    {"Strom [A]", ""},
    {"Strom_A", ""},
    {"Motorstrom [A]", ""},
    {"Batteriestrom 1 [A]", ""},
    {"Strangspannung U [V]", "va_V"},
    {"Tension composée U12 [V]", ""},
    {"Tension phase 2 [V]", "vb_V"},
    {"Spannung U-V [V]", "vab_V"},
    {"Couple mesuré", "torque_Nm"},
    {"Par medido (N·m)", "torque_Nm"},
    {"Coppia misurata [Nm]", "torque_Nm"},
    {"Drehmoment gemessen [N.m]", "torque_Nm"},
    {"T40B Drehmoment [N*m]", "torque_Nm"},
    {"M_Welle [Nm]", "torque_Nm"},
    {"Model Root/Bench/M_Welle [Nm]", "torque_Nm"},
    {"Model Root/Bench/theta_mech [rad]", "theta_m_rad"},
    {"Model Root/Bench/i_q [A]", "iq_A"},
    {"Drehmomentistwert [Nm]", "torque_computed_Nm"},
    {"Torque actual value shaft [Nm]", "torque_Nm"},
    {"Couple estimé [N.m]", "torque_computed_Nm"},
    {"Drehmoment soll [Nm]", ""},
    {"Drehmoment [A]", ""},
    {"Moment 2 [Nm]", ""},
    {"Temps écoulé (s)", "time_s"},
    {"fMechAngle [deg]", "theta_m_rad"},
    {"fIq [A]", "iq_A"},
    {"Md [Nm]", "torque_Nm"},
    {"Md", ""},
    {"Velocity Feedback (rpm)", "speed_rad_per_s"},
    {"Velocidad de giro (rpm)", "speed_rad_per_s"},
    {"Corrente di fase S (A)", "ib_A"},
    {"Intensidad fase 2 (A)", "ib_A"},
    {"External Torque (Nm)", "torque_Nm"},
    {"pos_turns", "theta_m_rad"},
    {"pos [rev]", "theta_m_rad"},
    {"motor position [turns]", "theta_m_rad"},
    {"pos_deg", "unclear"},
    {"pos [mm]", ""},
    {"pos", ""},
    {"Drehmoment (Messwelle)", "torque_Nm"},
    {"Messwelle Drehmoment [Nm]", "torque_Nm"},
    {"Drehmoment Messwelle", "torque_Nm"},
    {"Drehmoment (Messflansch T40B) [Nm]", "torque_Nm"},
    {"Moment (Drehmomentsensor)", "torque_Nm"},
    {"Couple (couplemètre) [N.m]", "torque_Nm"},
    {"Couple arbre (torque)", "torque_Nm"},
    {"Torque (T20WN) [Nm]", "torque_Nm"},
    {"Torque T2 [Nm]", ""},
    {"Drehmoment (Drehzahl)", ""},
    {"Drehzahl (Geschwindigkeit) [U/min]", "speed_rad_per_s"},
    {"Speed (velocity) [rpm]", "speed_rad_per_s"},
    {"Vitesse (régime) [tr/min]", "speed_rad_per_s"},
    {"Rotorwinkel (Winkel mech.) [°]", "theta_m_rad"},
    {"Winkel elektr. (Position) [°]", "theta_e_rad"},
    {"Position (angle méca) [°]", "theta_m_rad"},
    {"Strom U (Phasenstrom) [A]", "ia_A"},
    {"Phasenstrom (Strom L2) [A]", "ib_A"},
    {"Courant phase 1 (intensité) [A]", "ia_A"},
    {"Spannung U-V (Klemmenspannung) [V]", "vab_V"},
    {"Spannung V (Klemme) [V]", "vb_V"},
    {"Zeit (Zeitstempel)", "time_s"},
    {"Temperatur (Magnettemperatur)", ""},
    {"Temperatur (Temperature) Magnet [°C]", "temperature_C"},
    {"Temperatur Magnet [°C]", "temperature_C"},
    {"Temperatur Raum [°C]", ""},
    /* a group, a source or a device around the name */
    {"/'Messung'/'Drehmoment [Nm]'", "torque_Nm"},
    {"/'Group 1'/'Rotorwinkel mech [deg]'", "theta_m_rad"},
    {"/'Messung'/'torque_Nm'", "torque_Nm"},
    {"/'Sollwerte'/'Drehmoment [Nm]'", ""},
    {"Sollwerte/Drehmoment [Nm]", ""},
    {"timestamps", "time_s"},
    {"Trq_Shaft\\DAQ: 1", "torque_Nm"},
    {"Trq_Shaft\\DAQ: 1 [Nm]", "torque_Nm"},
    {"RotAgl_Mech\\DAQ: 1", "theta_m_rad"},
    {"IPhaB\\XCP: 2", "ib_A"},
    {"EngSpd\\XCP: 2", ""},
    {"Axis 1.ActVelo [deg/s]", "speed_rad_per_s"},
    {"Axis 1.ActVelo", ""},
    {"Axis 1.ActPos [deg]", "unclear"},
    {"Axis 1.SetVelo [deg/s]", ""},
    {"Axis 1.ActCurrentQ [A]", "iq_A"},
    {"MAIN.fbAxis.ActTorque [Nm]", "torque_computed_Nm"},
    {"Term 3 (EL3702).Drehmoment [Nm]", "torque_Nm"},
    {"GVL.fMechAngle [rad]", "theta_m_rad"},
    {"Setpoint.Torque [Nm]", ""},
    {"observer.speed", ""},
    {"Gear.Angle mech [deg]", ""},
    {"axis0.pos_vel_mapper.pos_rel", "theta_m_rad"},
    {"odrv0.axis0.pos_vel_mapper.vel", "speed_rad_per_s"},
    {"axis0.commutation_mapper.pos_rel", ""},
    {"1.servo_stats.position", "theta_m_rad"},
    {"servo_stats.velocity", "speed_rad_per_s"},
    {"1.servo_stats.q_A", "iq_A"},
    {"1.servo_stats.torque_Nm", "torque_computed_Nm"},
    {"1.servo_control.torque_Nm", ""},
    {"vel", ""},
    {"vel [rpm]", "speed_rad_per_s"},
    /* parameters of SINAMICS drives */
    {"r0063", "speed_rad_per_s"},
    {"r61[0] Actual speed value unsmoothed [rpm]", "speed_rad_per_s"},
    {"Drive_1.r0078[1]: Current actual value torque-generating [Arms]", "iq_A"},
    {"r76[0]", "id_A"},
    {"r0080[1] Torque actual value [Nm]", "torque_computed_Nm"},
    {"r93 Pole position angle electrically normalized [deg]", "theta_e_rad"},
    {"r69[1]", "ib_A"},
    {"r69[6]", ""},
    {"r89[2]", "vc_V"},
    {"Phase A (A)", "ia_A"},
    {"Motor phase 2 [mA]", "ib_A"},
    {"Phase B [V]", "vb_V"},
    {"Phase A", ""},
    {"Phase A [deg]", ""},
    {"Phase [A]", ""},
    {"r0060 Speed setpoint before the setpoint filter [rpm]", ""},
    {"r0062", ""},
    {"r0077", ""},
    {"r0079 Torque setpoint total [Nm]", ""},
    {"r632", ""},
    {"r63x", ""},
    /* units that say which turn */
    {"Rotor Position (EDeg)", "theta_e_rad"},
    {"Rotor Position (MDeg)", "theta_m_rad"},
    {"Rotor angle[deg]", "unclear"},
    {"theta [deg el]", "theta_e_rad"},
    {"theta_edeg", "theta_e_rad"},
    {"Rotorlage [° el.]", "theta_e_rad"},
    {"Winkel (°mech)", "theta_m_rad"},
    {"Mech. angle (EDeg)", "unclear"},
    {"Elec. position [deg]", "theta_e_rad"},
    /* words for an amplitude, of d and q alone */
    {"Id (Peak)", "id_A"},
    {"Iq (RMS)", "iq_A"},
    {"Iq rms [A]", "iq_A"},
    {"Id_peak_A", "id_A"},
    {"Strom q (eff) [A]", "iq_A"},
    {"Ia (Peak)", ""},
    {"Ia (RMS)", ""},
    {"Iq (max)", ""},
    /* what engineers write */
    {"Resolverwinkel", "unclear"},
    {"Resolver position [deg]", "unclear"},
    {"Geberwinkel [°]", "unclear"},
    {"Posizione rotore [°]", "unclear"},
    {"Drehzahl n [1/min]", "speed_rad_per_s"},
    {"Drehmoment M [Nm]", "torque_Nm"},
    {"Wellendrehmoment [Nm]", "torque_Nm"},
    {"Momento [Nm]", "torque_Nm"},
    {"Strom", ""},
};

static void test_names_in_words(void)
{
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k) {
        char text[256];
        hci_note note = {{0}};
        hci_csv *csv;
        snprintf(text, sizeof text, "\"%s\";x\n1;2\n2;3\n", NAMES[k].header);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_text(text, &csv, &note), note.text);
        for (size_t j = 0; j < ASKED_COUNT; ++j)
            TEST_ASSERT_EQUAL_MESSAGE(strcmp(ASKED[j], NAMES[k].is) == 0, hci_csv_has(csv, ASKED[j]),
                                      NAMES[k].header);
        TEST_ASSERT_EQUAL_MESSAGE(strcmp("unclear", NAMES[k].is) != 0,
                                  hci_csv_check_clear(csv, &note) == HCI_OK, NAMES[k].header);
        hci_csv_free(csv);
    }
}

static void test_names_that_look_like_a_torque(void)
{
    const hci_unit *Nm = hci_unit_find("N*m", 3);
    TEST_ASSERT_TRUE(hci_name_words_like(HCI_LIKE_TORQUE, "Drehmoment XY7 (Kanal 3)", NULL));
    TEST_ASSERT_TRUE(hci_name_words_like(HCI_LIKE_TORQUE, "Kanal 3 [Nm]", NULL));
    TEST_ASSERT_TRUE(hci_name_words_like(HCI_LIKE_TORQUE, "Kanal 3", Nm));
    TEST_ASSERT_TRUE(hci_name_words_like(HCI_LIKE_TORQUE, "torque@shaft#2", NULL));
    TEST_ASSERT_FALSE(hci_name_words_like(HCI_LIKE_TORQUE, "Drehmoment soll [Nm]", NULL));
    TEST_ASSERT_FALSE(hci_name_words_like(HCI_LIKE_TORQUE, "torque_command_Nm", NULL));
    TEST_ASSERT_FALSE(hci_name_words_like(HCI_LIKE_TORQUE, "Temperatur Raum", NULL));
    TEST_ASSERT_FALSE(hci_name_words_like(HCI_LIKE_TORQUE, "", NULL));
    TEST_ASSERT_TRUE(hci_name_words_like(HCI_LIKE_CURRENT, "axis0.motor.current_control.Iq_meas", NULL));
    TEST_ASSERT_TRUE(hci_name_words_like(HCI_LIKE_CURRENT, "Iq_x", NULL));
    TEST_ASSERT_TRUE(hci_name_words_like(HCI_LIKE_CURRENT, "i_q_raw", NULL));
    TEST_ASSERT_TRUE(hci_name_words_like(HCI_LIKE_CURRENT, "current", NULL));
    TEST_ASSERT_FALSE(hci_name_words_like(HCI_LIKE_CURRENT, "bus_current", NULL));
    TEST_ASSERT_FALSE(hci_name_words_like(HCI_LIKE_CURRENT, "Iq_setpoint", NULL));
    TEST_ASSERT_FALSE(hci_name_words_like(HCI_LIKE_CURRENT, "index", NULL));
    TEST_ASSERT_TRUE(hci_name_words_like(HCI_LIKE_SPEED, "vel", NULL));
    TEST_ASSERT_FALSE(hci_name_words_like(HCI_LIKE_SPEED, "level", NULL));
    TEST_ASSERT_TRUE(hci_name_words_along_d("axis0.Id_meas"));
    TEST_ASSERT_FALSE(hci_name_words_along_d("Iq_meas"));
}

static double second_number(const hci_csv *csv, const char *column)
{
    double values[8] = {0};
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_numbers(csv, column, values, &note), note.text);
    return values[1];
}

static void test_units_of_other_languages(void)
{
    static const struct {
        const char *header, *column;
        double factor;
    } UNITS[] = {{"Drehzahl [U/min]", "speed_rad_per_s", REF_PI / 30},
                 {"Vitesse [tr/min]", "speed_rad_per_s", REF_PI / 30},
                 {"Velocità [giri/min]", "speed_rad_per_s", REF_PI / 30},
                 {"Drehzahl [min-1]", "speed_rad_per_s", REF_PI / 30},
                 {"Drehzahl [min⁻¹]", "speed_rad_per_s", REF_PI / 30},
                 {"Mech. Winkel [Grad]", "theta_m_rad", REF_PI / 180},
                 {"Angle mécanique [degrés]", "theta_m_rad", REF_PI / 180},
                 {"Couple mesuré [N.m]", "torque_Nm", 1}};
    for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS; ++k) {
        char text[128];
        hci_note note = {{0}};
        hci_csv *csv;
        snprintf(text, sizeof text, "%s;x\n1;2\n3;4\n", UNITS[k].header);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_text(text, &csv, &note), note.text);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 3 * UNITS[k].factor, second_number(csv, UNITS[k].column));
        hci_csv_free(csv);
    }
}

/* MATLAB's writetimetable puts the unit into each cell of a duration. */
static void test_cells_with_their_unit(void)
{
    hci_note note = {{0}};
    hci_csv *csv;
    double value;
    TEST_ASSERT_EQUAL(HCI_OK, read_text("Time,i_q\n1.001 sec,2 A\n1.5e3 ms,20 mA\n", &csv, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5, second_number(csv, "time_s"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.02, second_number(csv, "iq_A"));
    hci_csv_free(csv);
    TEST_ASSERT_EQUAL(HCI_OK, read_text("Time,i_q\n1.001 sec,2 V\n", &csv, &note));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_numbers(csv, "iq_A", &value, &note));
    hci_csv_free(csv);
}

static void told_is(const hci_csv *csv, const char *column, const char *words)
{
    hci_note told = {{0}};
    TEST_ASSERT_TRUE(hci_csv_told(csv, column, &told));
    text_has(words, told.text);
}

/* Motor-CAD: names with their amplitude, units in a row of their own. */
static void test_amplitudes_and_electrical_degrees(void)
{
    hci_note note = {{0}};
    hci_csv *csv;
    TEST_ASSERT_EQUAL(HCI_OK, read_text("Rotor Position (EDeg);Id (Peak);Iq (RMS);Torque\n"
                                        "EDeg;Amps;Amps;Nm\n0;-90;1;2\n1;-80;3;4\n",
                                        &csv, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, REF_PI / 180.0, second_number(csv, "theta_e_rad"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -80.0, second_number(csv, "id_A"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0 * 1.4142135623730951, second_number(csv, "iq_A"));
    told_is(csv, "theta_e_rad", "`Rotor Position (EDeg)` is read as the electrical angle");
    told_is(csv, "iq_A", "`Iq (RMS)` is read as the rms of a sine: times √2 for the peak");
    TEST_ASSERT_FALSE(hci_csv_told(csv, "id_A", &note));
    hci_csv_free(csv);
}

static void rms_is(const char *table, double iq_A)
{
    hci_note note = {{0}};
    hci_csv *csv;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_text(table, &csv, &note), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, iq_A, second_number(csv, "iq_A"));
    hci_csv_free(csv);
}

/* √2 comes once, whichever of name and unit says rms. */
static void test_rms_said_once(void)
{
    rms_is("t,Iq rms [Arms]\n0,1\n1,2\n", 2.0 * 1.4142135623730951);
    rms_is("t,Iq rms [mA]\n0,1\n1,2\n", 2e-3 * 1.4142135623730951);
    rms_is("t,Iq peak [A]\n0,1\n1,2\n", 2.0);
}

/* A name of the user's says nothing of the amplitude, one with a unit does. */
static void test_rms_of_a_given_column(void)
{
    hci_note note = {{0}};
    hci_csv *csv;
    TEST_ASSERT_EQUAL(HCI_OK, read_text("t,Iq (RMS)\n0,1\n1,2\n", &csv, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_give(csv, "iq", 1, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * 1.4142135623730951, second_number(csv, "iq_A"));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_give(csv, "iq_A", 1, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, second_number(csv, "iq_A"));
    hci_csv_free(csv);
}

static void test_a_resolver_may_be_either(void)
{
    hci_note note = {{0}};
    hci_csv *csv;
    TEST_ASSERT_EQUAL(HCI_OK, read_text("Resolverwinkel [deg],torque\n0,1\n1,2\n", &csv, &note));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_check_clear(csv, &note));
    text_has("--column \"theta_m=Resolverwinkel [deg]\"", note.text);
    text_has("a resolver of one pole pair has the mechanical angle", note.text);
    hci_csv_free(csv);
}

/* SINAMICS: i_q is logged as an rms value, the unsmoothed speed beside the smoothed one. */
static void test_units_of_parameters(void)
{
    hci_note note = {{0}};
    hci_csv *csv;
    TEST_ASSERT_EQUAL(HCI_OK, read_text("r78[0],r61,r63\n0,0,0\n1,30,60\n", &csv, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.4142135623730951, second_number(csv, "iq_A"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, REF_PI, second_number(csv, "speed_rad_per_s"));
    hci_csv_free(csv);
}

static void test_rows_without_names(void)
{
    static const char MONITOR[] =
        "MOT: Monitor enabled!\nMOT: Ready.\n0.8\t0.1\t1\n0.8\t0.2\t2\n0.8\t0.1\t3\n";
    hci_note note = {{0}};
    hci_csv *csv;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_text(MONITOR, &csv, &note));
    text_has("table.csv:3: found rows of 3 numbers and no line of names above them", note.text);
    text_has("shaft_velocity, shaft_angle", note.text);
}

static void test_a_clock_below_its_format(void)
{
    hci_note note = {{0}};
    hci_csv *csv;
    TEST_ASSERT_EQUAL(HCI_OK, read_text("Zeit [hh:mm:ss];x\n09:12:58,500;1\n09:13:00,250;2\n", &csv, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 33180.25, second_number(csv, "time_s"));
    hci_csv_free(csv);
}

/* What the words leave open is told, the rest is not. */
static void test_what_is_told(void)
{
    hci_note note = {{0}}, told = {{0}};
    hci_csv *csv;
    TEST_ASSERT_EQUAL(HCI_OK,
                      read_text("Couple mesuré;Vitesse arbre [tr/min];Istmoment x\n1;2;3\n", &csv, &note));
    TEST_ASSERT_TRUE(hci_csv_told(csv, "torque_Nm", &told));
    text_has("is read as the torque, in N*m", told.text);
    TEST_ASSERT_FALSE(hci_csv_told(csv, "speed_rad_per_s", &told));
    hci_csv_free(csv);
}

static void test_two_of_one_quantity_are_refused(void)
{
    hci_note note = {{0}};
    hci_csv *csv;
    double value;
    TEST_ASSERT_EQUAL(HCI_OK, read_text("Drehmoment gemessen;Couple mesuré\n1;2\n", &csv, &note));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_numbers(csv, "torque_Nm", &value, &note));
    text_has("a second time", note.text);
    hci_csv_free(csv);
}

static void test_the_page_lists_every_word_and_parameter(void)
{
    char *page = malloc(1 << 20);
    const char *kind, *words;
    FILE *f = fopen("docs/files.md", "r");
    TEST_ASSERT_NOT_NULL(f);
    page[fread(page, 1, (1 << 20) - 1, f)] = '\0';
    fclose(f);
    size_t kinds = 0;
    for (; (words = hci_name_words_known(kinds, &kind)) != NULL; ++kinds) {
        char row[1200];
        snprintf(row, sizeof row, "| %s | %s |", kind, words);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(page, row), row);
    }
    TEST_ASSERT_TRUE(kinds > 10);
    const hci_alias *said;
    char name[16];
    for (size_t k = 0; hci_parameter_known(k, name, &said); ++k) {
        char row[80];
        snprintf(row, sizeof row, "| `%s` | `%s` | %s |", name, said->column, said->unit);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(page, row), row);
    }
    free(page);
}

/* ---- TwinCAT Scope ---- */

#define SCOPE(times, first)                                                                                  \
    "Name\tscope\r\nStarttime of export\t1\tMontag, 2. Mai 2022\t15:56\r\n\r\n"                              \
    "Name\tDrehmoment\tName\tMech. Winkel\r\nSymbolComment\t\tSymbolComment\t\r\n"                           \
    "Data-Type\tREAL32\tData-Type\tREAL32\r\nSampleTime[ms]\t2\tSampleTime[ms]\t" times "\r\n"               \
    "Unit\tmNm (Torque)\tUnit\t° (Angle)\r\nUnit Offset\t0\tUnit Offset\t0\r\n\r\n" first                    \
    "\t5\t0\t10\r\n2\t6\t2\t20\r\n4\t7\t4\t30\r\nEOF\r\n"

static void test_scope_of_twincat(void)
{
    hci_note note = {{0}};
    hci_csv *csv;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_text(SCOPE("2", "0"), &csv, &note), note.text);
    TEST_ASSERT_EQUAL(3, hci_csv_rows(csv));
    TEST_ASSERT_EQUAL_STRING("Drehmoment", hci_csv_name(csv, 1));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.002, second_number(csv, "time_s"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.006, second_number(csv, "torque_Nm"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, REF_PI / 9, second_number(csv, "theta_m_rad"));
    hci_csv_free(csv);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_text(SCOPE("2", "86400000.5"), &csv, &note),
                              note.text); /* a day */
    hci_csv_free(csv);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_text(SCOPE("5", "0"), &csv, &note));
    text_has("several sample times", note.text);
    note.text[0] = '\0';
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_text(SCOPE("2", "132959733843760000"), &csv, &note));
    text_has("full time stamps", note.text);
}

/* ---- LabVIEW ---- */

static void test_the_column_of_comments_may_be_missing(void)
{
    hci_note note = {{0}};
    hci_csv *csv;
    TEST_ASSERT_EQUAL(HCI_OK,
                      read_text("X_Value\tMoment (Nm)\tComment\n0\t1\n0,5\t2\t\n1\t3\tend\n", &csv, &note));
    TEST_ASSERT_EQUAL(3, hci_csv_rows(csv));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, second_number(csv, "time_s"));
    hci_csv_free(csv);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_names_in_words);
    RUN_TEST(test_names_that_look_like_a_torque);
    RUN_TEST(test_units_of_other_languages);
    RUN_TEST(test_cells_with_their_unit);
    RUN_TEST(test_units_of_parameters);
    RUN_TEST(test_amplitudes_and_electrical_degrees);
    RUN_TEST(test_rms_said_once);
    RUN_TEST(test_rms_of_a_given_column);
    RUN_TEST(test_a_resolver_may_be_either);
    RUN_TEST(test_rows_without_names);
    RUN_TEST(test_a_clock_below_its_format);
    RUN_TEST(test_what_is_told);
    RUN_TEST(test_two_of_one_quantity_are_refused);
    RUN_TEST(test_the_page_lists_every_word_and_parameter);
    RUN_TEST(test_scope_of_twincat);
    RUN_TEST(test_the_column_of_comments_may_be_missing);
    return UNITY_END();
}
