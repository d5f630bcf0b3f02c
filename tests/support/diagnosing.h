/* A machine with a sinusoidal back-EMF of 0.2 N·m/A and three pole pairs in a folder, recordings of it whose
 * equations are written here, and their diagnosis. Include once in a test.
 */
#ifndef DIAGNOSING_H
#define DIAGNOSING_H

#include "hci/host/diagnose/diagnose.h"
#include "host/base/memory.h"
#include "support/files.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 3, MOST_RUNS = 12 };

static const double K_NM_PER_A = 0.2, NOISE_NM = 0.01;

static hci_machine_data machine;
static hci_run run[MOST_RUNS];
static hci_role role[MOST_RUNS];
static hci_runs runs;
static hci_diagnosis diagnosis;
static hci_diagnose_options options;
static uint64_t seed;

/* ---- files ---- */

static inline void dataset_start(void)
{
    hci_note note = {{0}};
    seed = 99;
    files_begin();
    files_write(files_path("machine.csv"),
                "name,value,unit,source\npole_pairs,3,1,test\nconnection,star,,test\n");
    files_write(files_path("back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
    runs = (hci_runs){.run = run, .role = role};
    memset(&options, 0, sizeof options);
}

static inline void dataset_end(void)
{
    hci_memory_fail_after(-1);
    hci_diagnosis_release(&diagnosis);
    for (size_t k = 0; k < MOST_RUNS; ++k)
        rec_release(&run[k]);
    hci_machine_release(&machine);
    files_end();
}

/* ---- recordings ---- */

static inline hci_run *add_run(size_t n)
{
    hci_run *r = &run[runs.count];
    *r = rec_make(n);
    snprintf(r->name, 16, "run_%zu.csv", runs.count);
    role[runs.count++] = HCI_ROLE_FIT;
    return r;
}

/* One operating point. offset_A: of phase a's reading. brake_Nm: what the sensor reads too little. drift_Nm:
 * of what is another torque in each turn and each run. */
typedef struct {
    double speed, iq, offset_A, brake_Nm, drift_Nm;
} point;

static inline void record(size_t n, const point *x)
{
    hci_run *r = add_run(n);
    const double phase = ref_uniform(&seed, 0.0, 6.0);
    for (size_t k = 0; k < n; ++k) {
        const double theta_m = (x->speed < 0.0 ? -1.0 : 1.0) * 2.0 * REF_PI * (double)k / 300.0;
        r->theta_m_rad[k] = theta_m;
        r->time_s[k] = theta_m / x->speed;
        r->speed_rad_per_s[k] = x->speed;
        rec_phases(0.0, x->iq, P * theta_m, r->i_A + 3 * k);
        for (int s = 0; s < 3; ++s)
            r->torque_Nm[k] +=
                K_NM_PER_A * sin(P * theta_m - 2.0 * REF_PI * s / 3.0) * r->i_A[3 * k + (size_t)s];
        r->i_A[3 * k] += x->offset_A;
        r->torque_Nm[k] += x->drift_Nm * sin(0.37 * theta_m + 5.0 * sin(0.211 * theta_m) + phase);
        r->torque_Nm[k] += NOISE_NM * ref_normal(&seed) - x->brake_Nm;
    }
}

/* Two currents there, two back and faster. */
static inline void record_map(double offset_A, double drift_Nm)
{
    for (int k = 0; k < 4; ++k)
        record(450, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, offset_A, 0.0, drift_Nm});
}

/* The current that holds a shaft against a torque, turned slowly there and back twice round; none is
 * measured. */
static inline void record_holding(size_t n, double coulomb_Nm, double cogging_Nm, double irregular_Nm)
{
    hci_run *r = add_run(n);
    const double turn = 0.25 * (double)n; /* samples */
    r->torque_source = HCI_TORQUE_HOLDING;
    for (size_t k = 0; k < r->count; ++k) {
        const bool back = k >= r->count / 2;
        const double x = (double)(back ? n - 1 - k : k) / turn, theta_m = 2.0 * REF_PI * x;
        const double turns = (double)k / turn; /* there and back */
        const double torque = (back ? -coulomb_Nm : coulomb_Nm) - cogging_Nm * sin(6.0 * P * theta_m) -
                              0.5 * cogging_Nm * cos(2.0 * P * theta_m) +
                              irregular_Nm * sin(1.2 * turns + 9.0 * sin(0.42 * turns));
        r->time_s[k] = 0.02 * (double)k;
        r->theta_m_rad[k] = theta_m;
        r->speed_rad_per_s[k] = (back ? -2.0 : 2.0) * REF_PI / turn / 0.02;
        rec_phases(0.0, torque / (1.5 * K_NM_PER_A) + 0.01 * ref_normal(&seed), P * theta_m, r->i_A + 3 * k);
    }
}

/* ---- diagnosing ---- */

static inline const hci_finding *found(const char *effect)
{
    static const hci_finding none = {.effect = "", .verdict = HCI_FINDING_REJECTED};
    for (size_t k = 0; k < diagnosis.findings; ++k)
        if (strcmp(diagnosis.finding[k].effect, effect) == 0) return &diagnosis.finding[k];
    return &none;
}

static inline size_t count_of(hci_finding_verdict verdict)
{
    size_t count = 0;
    for (size_t k = 0; k < diagnosis.findings; ++k)
        count += diagnosis.finding[k].verdict == verdict;
    return count;
}

/* The term of an effect in the corrected machine; fails where there is none. */
static inline const hci_effect_term *term(const char *effect, const char *parameter, double order)
{
    for (size_t k = 0; k < diagnosis.effects.list.count; ++k) {
        const hci_effect *e = &diagnosis.effects.list.effect[k];
        for (size_t j = 0; j < e->count && strcmp(e->type->name, effect) == 0; ++j)
            if (strcmp(e->type->parameter[e->term[j].parameter].name, parameter) == 0 &&
                fabs(e->term[j].order - order) < 1e-6)
                return &e->term[j];
    }
    TEST_FAIL_MESSAGE(parameter);
    return NULL;
}

/* As a user would: whatever is found, what stands in the corrected machine is no rejected effect, and a
 * failure says why. */
static inline hci_status diagnose(const hci_effects *declared)
{
    const hci_effects none = {NULL, 0};
    hci_note note = {{0}};
    hci_diagnosis_release(&diagnosis);
    const hci_status status =
        hci_diagnose(&machine, declared ? declared : &none, &runs, &options, &diagnosis, &note);
    TEST_ASSERT_EQUAL_MESSAGE(status > HCI_NOT_REACHED, note.text[0] != '\0', note.text);
    for (size_t k = 0; !declared && k < diagnosis.effects.list.count; ++k)
        TEST_ASSERT_NOT_EQUAL(HCI_FINDING_REJECTED,
                              found(diagnosis.effects.list.effect[k].type->name)->verdict);
    return status;
}

/* The same when so many allocations succeed: whatever fails, nothing is left and the note says why. */
static inline hci_status diagnose_with(long allocations)
{
    const hci_effects none = {NULL, 0};
    hci_note note = {{0}};
    hci_memory_fail_after(allocations);
    const hci_status status = hci_diagnose(&machine, &none, &runs, &options, &diagnosis, &note);
    hci_memory_fail_after(-1);
    TEST_ASSERT_EQUAL(status > HCI_NOT_REACHED, note.text[0] != '\0');
    TEST_ASSERT_TRUE(status <= HCI_NOT_REACHED || status == HCI_ERROR_MEMORY);
    if (status == HCI_ERROR_MEMORY) {
        TEST_ASSERT_TRUE(!diagnosis.run && !diagnosis.effects.term && diagnosis.findings == 0);
    }
    hci_diagnosis_release(&diagnosis);
    return status;
}

#endif
