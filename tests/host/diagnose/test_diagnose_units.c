/* A servo motor and a watch's: with currents in another unit, and torques in another, which are powers of two
 * and change no digit, a diagnosis is the same one: its verdicts, its relative errors, and its values but for
 * powers of two. Nothing compares a current or a torque with a number of its own. */
#include <math.h>

#include "support/diagnosing.h"

void setUp(void)
{
}

void tearDown(void)
{
}

typedef struct {
    double current, torque; /* powers of two */
} units;

static const units PLAIN = {1.0, 1.0}, SMALL = {0x1p-7, 0x1p-10};

static void scale_runs(const units *u)
{
    for (size_t r = 0; r < runs.count; ++r)
        for (size_t k = 0; k < run[r].count; ++k) {
            for (int s = 0; s < 3; ++s)
                run[r].i_A[3 * k + (size_t)s] *= u->current;
            run[r].torque_Nm[k] *= u->torque;
        }
}

static void declare(const units *u, double cogging_Nm)
{
    char text[200];
    hci_note note = {{0}};
    snprintf(text, sizeof text, "order,amplitude_Nm_per_A,phase_rad\n1,%.17g,0\n",
             0.2 * u->torque / u->current);
    files_write(files_path("back_emf.csv"), text);
    snprintf(text, sizeof text, "order,amplitude_Nm,phase_rad\n6,%.17g,0.3\n", cogging_Nm * u->torque);
    if (cogging_Nm > 0.0) files_write(files_path("cogging.csv"), text);
    hci_machine_release(&machine);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
}

/* ---- what is recorded ---- */

/* A machine with a cogging torque that is declared; a 5th of the back-EMF and a 12th of cogging that are not.
 */
static void record_waves(const units *u)
{
    declare(u, 0.05);
    for (size_t r = 0; r < 6; ++r) {
        const double iq = (double[]){2.0, 9.0, -5.0, 0.0, 6.0, 4.0}[r];
        record(600, &(point){(r % 2 ? -1.0 : 1.0) * (40.0 + 20.0 * (double)r), iq, 0.0, 0.0, 0.0});
        for (size_t k = 0; k < 600; ++k) {
            const double theta = P * run[r].theta_m_rad[k];
            run[r].torque_Nm[k] += 0.05 * sin(6.0 * theta + 0.3) + 0.04 * cos(12.0 * theta);
            for (int s = 0; s < 3; ++s)
                run[r].torque_Nm[k] +=
                    0.01 * sin(5.0 * (theta - 2.0 * REF_PI * s / 3.0)) * run[r].i_A[3 * k + (size_t)s];
        }
    }
}

static void record_offset(const units *u)
{
    declare(u, 0.0);
    record_map(0.3, 0.0);
}

/* An angle that turns with the load, and a brake. */
static void record_angle(const units *u)
{
    declare(u, 0.0);
    for (size_t r = 0; r < 8; ++r) {
        const double iq = (double[]){0.0, 3.0, 9.0, -5.0, 6.0, -8.0, 4.0, -3.0}[r],
                     speed = 40.0 + 10.0 * (double)r;
        record(600, &(point){r % 2 ? -speed : speed, iq, 0.0, r % 2 ? -0.02 : 0.02, 0.0});
        for (size_t k = 0; k < 600; ++k)
            run[r].theta_m_rad[k] += 0.012 * iq / P;
    }
}

/* A rotor that is salient, loads with an i_d. */
static void record_salient(const units *u)
{
    declare(u, 0.0);
    for (size_t r = 0; r < 8; ++r) {
        const double iq = (double[]){0.0, 3.0, 9.0, -5.0, 6.0, -8.0, 4.0, -3.0}[r], id = -0.5 * fabs(iq);
        record(600, &(point){(r % 2 ? -1.0 : 1.0) * (40.0 + 10.0 * (double)r), iq, 0.0, 0.0, 0.0});
        for (size_t k = 0; k < 600; ++k) {
            const double theta = P * run[r].theta_m_rad[k];
            rec_phases(id, iq, theta, run[r].i_A + 3 * k);
            run[r].torque_Nm[k] += 1.5 * P * 3e-4 * id * iq * (1.0 + 0.3 * cos(6.0 * theta));
        }
    }
}

/* Something else in each turn and each run. */
static void record_drift(const units *u)
{
    declare(u, 0.0);
    record_map(0.0, 0.1);
}

static void record_held(const units *u)
{
    declare(u, 0.0);
    record_holding(2000, 0.02, 0.05, 0.0);
}

static void (*const RECORDED[])(const units *) = {record_waves,   record_offset, record_angle,
                                                  record_salient, record_drift,  record_held};

/* ---- what is found ---- */

enum { MOST_TERMS = 100 };

typedef struct {
    hci_status status;
    hci_diagnosis_verdict verdict;
    size_t findings, terms;
    hci_finding_verdict finding[64];
    const char *name[MOST_TERMS];
    double order[MOST_TERMS], value[MOST_TERMS], share[MOST_TERMS];
} outcome;

static void note_terms(outcome *o)
{
    o->terms = 0;
    for (size_t k = 0; k < diagnosis.effects.list.count; ++k) {
        const hci_effect *e = &diagnosis.effects.list.effect[k];
        for (size_t j = 0; j < e->count && o->terms < MOST_TERMS; ++j, ++o->terms) {
            o->name[o->terms] = e->type->parameter[e->term[j].parameter].name;
            o->order[o->terms] = e->term[j].order;
            o->value[o->terms] = e->term[j].value;
            o->share[o->terms] = e->term[j].std_error / fabs(e->term[j].value);
        }
    }
}

static outcome outcome_in(void (*recorded)(const units *), const units *u)
{
    outcome o;
    memset(&o, 0, sizeof o);
    dataset_start();
    recorded(u);
    scale_runs(u);
    o.status = diagnose(NULL);
    o.verdict = diagnosis.verdict;
    o.findings = diagnosis.findings;
    for (size_t k = 0; k < o.findings && k < 64; ++k)
        o.finding[k] = diagnosis.finding[k].verdict;
    note_terms(&o);
    dataset_end();
    return o;
}

static void compare(const outcome *a, const outcome *b)
{
    TEST_ASSERT_EQUAL_INT(a->status, b->status);
    TEST_ASSERT_EQUAL_INT(a->verdict, b->verdict);
    TEST_ASSERT_EQUAL_UINT64(a->findings, b->findings);
    for (size_t k = 0; k < a->findings; ++k)
        TEST_ASSERT_EQUAL_INT(a->finding[k], b->finding[k]);
    TEST_ASSERT_EQUAL_UINT64(a->terms, b->terms);
    for (size_t k = 0; k < a->terms; ++k) {
        const double power = log2(fabs(b->value[k] / a->value[k]));
        TEST_ASSERT_EQUAL_STRING(a->name[k], b->name[k]);
        TEST_ASSERT_EQUAL_DOUBLE(a->order[k], b->order[k]);
        if (a->value[k] == 0.0) TEST_ASSERT_EQUAL_DOUBLE(0.0, b->value[k]);
        if (a->value[k] == 0.0) continue;
        TEST_ASSERT_TRUE(a->value[k] * b->value[k] > 0.0);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-6, round(power), power, a->name[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * a->share[k], a->share[k], b->share[k]);
    }
}

static void test_a_diagnosis_has_no_units(void)
{
    size_t terms = 0;
    for (size_t n = 0; n < sizeof RECORDED / sizeof *RECORDED; ++n) {
        const outcome plain = outcome_in(RECORDED[n], &PLAIN);
        terms += plain.terms;
        const outcome small = outcome_in(RECORDED[n], &SMALL);
        compare(&plain, &small);
    }
    TEST_ASSERT_TRUE(terms >= 8);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_diagnosis_has_no_units);
    return UNITY_END();
}
