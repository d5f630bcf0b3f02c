/* Every host path with an allocator that fails after n allocations, for n = 0, 1, 2, … until the path
 * succeeds. Under -fsanitize=address the same run shows that nothing leaks. SuiteSparse and cJSON allocate
 * through the same functions. */
#include <cjson/cJSON.h>
#include <dlfcn.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hci/host/emit/emit.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "hci/host/solve/solve.h"
#include "host/base/memory.h"
#include "host/numeric/sparse.h"
#include "support/files.h"
#include "unity.h"

static hci_machine_data machine;
static hci_target target;
static hci_component_set set;
static hci_wave fundamental;

/* ---- the hooks of SuiteSparse
 * ------------------------------------------------------------------------------------ */

/* The first members of SuiteSparse_config up to version 5, where it is a variable; later versions have
 * functions that set them. Both are looked up in the running program, so that one test serves both. */
typedef struct {
    void *(*malloc_func)(size_t);
    void *(*calloc_func)(size_t, size_t);
    void *(*realloc_func)(void *, size_t);
    void (*free_func)(void *);
} suitesparse_memory;

static const suitesparse_memory HOOKS = {hci_memory_malloc, hci_memory_new, hci_memory_realloc,
                                         hci_memory_free};

static void set_by_function(void *program, const char *name, const void *function)
{
    void (*setter)(void *) = NULL;
    void *argument = NULL;
    void *symbol = dlsym(program, name);
    TEST_ASSERT_NOT_NULL_MESSAGE(symbol, name);
    memcpy(&setter, &symbol, sizeof symbol);
    memcpy(&argument, function, sizeof argument);
    setter(argument);
}

static void route_suitesparse(void)
{
    void *program = dlopen(NULL, RTLD_NOW);
    suitesparse_memory *variable = dlsym(program, "SuiteSparse_config");
    if (variable != NULL) {
        *variable = HOOKS;
    } else {
        set_by_function(program, "SuiteSparse_config_malloc_func_set", &HOOKS.malloc_func);
        set_by_function(program, "SuiteSparse_config_calloc_func_set", &HOOKS.calloc_func);
        set_by_function(program, "SuiteSparse_config_realloc_func_set", &HOOKS.realloc_func);
        set_by_function(program, "SuiteSparse_config_free_func_set", &HOOKS.free_func);
    }
    dlclose(program);
}

/* ---- the sweep
 * -------------------------------------------------------------------------------------------------- */

/* Does something from beginning to end and leaves nothing behind. figure: out on success, a number that a
 * hidden failure would change. */
typedef hci_status path(double *figure);

/* So many first allocations fail one by one, later ones in steps of this part of their number. With the word
 * `every` on the command line it is every one of most paths, and the paths that take long are tried, too. */
static bool every;
static long one_by_one = 12, part = 3;

/* A path as it is when memory is there; then with n allocations for n = 0, 1, 2, …. What does not fail must
 * give the same figure. Returns how many allocations it took (the callers ask for a third of what it was when
 * written, so that hooks that are not used are noticed). */
static long sweep(path *run)
{
    double expected = 0.0, figure = 0.0;
    const hci_status good = run(&expected);
    long n = 0;
    TEST_ASSERT_TRUE(good == HCI_OK || good == HCI_NOT_REACHED);
    for (;; n += n < one_by_one ? 1 : n / part) {
        hci_status status;
        hci_memory_fail_after(n);
        status = run(&figure);
        hci_memory_fail_after(-1);
        if (status == good) break;
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, status);
    }
    TEST_ASSERT_EQUAL_DOUBLE(expected, figure);
    return n;
}

/* A failure has said why. */
static hci_status noted(hci_status status, const hci_note *note)
{
    TEST_ASSERT_EQUAL_INT(status > HCI_NOT_REACHED, note->text[0] != '\0');
    return status;
}

/* ---- fixtures
 * --------------------------------------------------------------------------------------------------- */

void setUp(void)
{
    hci_note note = {{0}};
    const cJSON_Hooks hooks = {hci_memory_malloc, hci_memory_free};
    cJSON_Hooks copy = hooks;
    cJSON_InitHooks(&copy);
    files_begin();
    files_write(files_path("target.csv"),
                "order,amplitude_Nm,phase_rad,weight\n0,2.5,1.5707963267948966,1\n6,0.1,0.3,0.5\n12,0,0,0\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_a", &machine, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_target_read("data/scenarios/02/target.csv", &target, &note),
                              note.text);
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_component_set_read("data/scenarios/02/harmonics.csv", false, &set, &note), note.text);
    fundamental = hci_wave_polar(1.0, 1, 12.0, 0.2);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_machine_release(&machine);
    hci_target_release(&target);
    hci_component_set_release(&set);
    files_end();
    cJSON_InitHooks(NULL);
}

/* ---- reading
 * ---------------------------------------------------------------------------------------------------- */

static hci_status read_machine(double *figure)
{
    hci_machine_data m;
    hci_note note = {{0}};
    const hci_status status = hci_machine_read("data/machine_a", &m, &note);
    if (status == HCI_OK) {
        *figure = m.back_emf[4].sine + m.cogging[5].cosine;
    } else {
        TEST_ASSERT_NULL(m.back_emf);
        TEST_ASSERT_NULL(m.cogging);
    }
    hci_machine_release(&m);
    return noted(status, &note);
}

static hci_status read_interior(double *figure)
{
    hci_machine_data m;
    hci_note note = {{0}};
    const hci_status status = hci_machine_read("data/machine_c", &m, &note);
    if (status == HCI_OK) {
        *figure = m.slope[1].sine[HCI_AB] + m.inductance[0].cosine[HCI_AA];
    } else {
        TEST_ASSERT_NULL(m.slope);
        TEST_ASSERT_NULL(m.inductance);
    }
    hci_machine_release(&m);
    return noted(status, &note);
}

static hci_status read_target(double *figure)
{
    hci_target t;
    hci_note note = {{0}};
    const hci_status status = hci_target_read(files_path("target.csv"), &t, &note);
    if (status == HCI_OK) {
        *figure = t.order[1].torque_Nm.sine + t.order[1].weight;
    } else {
        TEST_ASSERT_NULL(t.order);
    }
    hci_target_release(&t);
    return noted(status, &note);
}

static hci_status read_set(double *figure)
{
    hci_component_set s;
    hci_note note = {{0}};
    const hci_status status = hci_component_set_read("data/scenarios/05/harmonics.csv", false, &s, &note);
    *figure = (double)s.count;
    if (status != HCI_OK) {
        TEST_ASSERT_NULL(s.component);
    }
    hci_component_set_release(&s);
    return noted(status, &note);
}

static hci_status read_currents(double *figure)
{
    hci_currents c;
    hci_note note = {{0}};
    const hci_status status = hci_currents_read("data/example_currents/currents.csv", false, &c, &note);
    *figure = (double)(c.hash >> 12);
    if (status != HCI_OK) {
        TEST_ASSERT_NULL(c.wave);
    }
    hci_currents_release(&c);
    return noted(status, &note);
}

static void test_reading(void)
{
    TEST_ASSERT_TRUE(sweep(read_machine) > 10);
    TEST_ASSERT_TRUE(sweep(read_interior) > 15);
    TEST_ASSERT_TRUE(sweep(read_target) > 5);
    TEST_ASSERT_TRUE(sweep(read_set) > 5);
    TEST_ASSERT_TRUE(sweep(read_currents) > 5);
}

/* ---- sparse solvers
 * --------------------------------------------------------------------------------------------- */

/* [4 1 0; 1 3 1; 0 1 2] */
static hci_sparse matrix(void)
{
    static int64_t start[] = {0, 2, 5, 7}, row[] = {0, 1, 0, 1, 2, 1, 2};
    static double value[] = {4.0, 1.0, 1.0, 3.0, 1.0, 1.0, 2.0};
    return (hci_sparse){3, 3, start, row, value};
}

static hci_status by_umfpack(double *figure)
{
    const double b[3] = {1.0, 2.0, 3.0};
    const hci_sparse a = matrix();
    double x[3] = {0.0}, condition = 0.0;
    hci_note note = {{0}};
    const hci_status status = hci_sparse_lu_solve(&a, b, 1, x, &condition, &note);
    *figure = x[0] + condition;
    return noted(status, &note);
}

static hci_status by_spqr(double *figure)
{
    const double b[3] = {1.0, 2.0, 3.0};
    const hci_sparse a = matrix();
    double x[3] = {0.0};
    hci_sparse_rank found = {0};
    hci_note note = {{0}};
    const hci_status status = hci_sparse_qr_solve(&a, b, 1, x, &found, &note);
    *figure = x[0] + found.condition + (double)found.rank;
    return noted(status, &note);
}

static void test_sparse_solvers(void)
{
    TEST_ASSERT_TRUE(sweep(by_umfpack) > 40);
    TEST_ASSERT_TRUE(sweep(by_spqr) > 40);
}

/* ---- solving
 * ---------------------------------------------------------------------------------------------------- */

static hci_solve_options options;

static hci_status run_solve(double *figure)
{
    hci_solution s;
    hci_note note = {{0}};
    const hci_status status = hci_solve(&machine, &options, &s, &note);
    if (status <= HCI_NOT_REACHED) {
        *figure =
            s.mean_square_A2 + s.worst_error_Nm + (isnan(s.condition) ? 0.0 : s.condition) + (double)s.rank;
    } else {
        TEST_ASSERT_NULL(s.current.wave);
        TEST_ASSERT_NULL(s.order);
        TEST_ASSERT_NULL(s.per_Nm);
        TEST_ASSERT_EQUAL_UINT64(0, s.order_count);
    }
    hci_solution_release(&s);
    return noted(status, &note);
}

static void wish(const hci_component_set *of, const hci_wave *held, hci_method method)
{
    memset(&options, 0, sizeof options);
    options.target = &target;
    options.set = of;
    options.held = held;
    options.method = method;
}

static void test_solving_a_square_system(void)
{
    static const hci_method METHOD[] = {HCI_METHOD_AUTO, HCI_METHOD_LU, HCI_METHOD_UMFPACK, HCI_METHOD_QR};
    hci_component component[2] = {{5.0, -1}, {11.0, -1}};
    hci_set name[2] = {HCI_SET_NEG, HCI_SET_NEG};
    const hci_component_set two = {component, name, 2, {{0}}};
    for (size_t k = 0; k < 4; ++k) {
        wish(&two, &fundamental, METHOD[k]);
        options.compare = HCI_COMPARE_SQUARE;
        TEST_ASSERT_TRUE(sweep(run_solve) > 15);
    }
}

static void test_solving_a_deficient_system(void)
{
    wish(&set, &fundamental, HCI_METHOD_AUTO);
    TEST_ASSERT_TRUE(sweep(run_solve) > 100);
    wish(&set, NULL, HCI_METHOD_QR);
    TEST_ASSERT_TRUE(sweep(run_solve) > 100);
}

/* A sine and cogging up to order 12, so that there are few candidates and every allocation can fail. */
static void test_choosing(void)
{
    machine.model.back_emf_count = 1;
    machine.model.cogging_count = 2;
    wish(NULL, NULL, HCI_METHOD_AUTO);
    TEST_ASSERT_TRUE(sweep(run_solve) > 100);
    options.choose_at_most = 3;
    TEST_ASSERT_TRUE(sweep(run_solve) > 100);
}

static void test_pointwise(void)
{
    wish(NULL, NULL, HCI_METHOD_POINTWISE);
    options.strategy = HCI_STRATEGY_MTPA;
    TEST_ASSERT_TRUE(sweep(run_solve) > 5);
}

static void test_pointwise_without_i_d(void)
{
    wish(NULL, NULL, HCI_METHOD_POINTWISE);
    options.strategy = HCI_STRATEGY_ID0;
    TEST_ASSERT_TRUE(sweep(run_solve) > 5);
}

/* Newton's method on machine C cut down to its largest orders. A run takes a tenth of a second, so fewer of
 * the allocations fail. */
static void interior(const hci_component_set *of, size_t choose_at_most)
{
    hci_note note = {{0}};
    const long usual_one_by_one = one_by_one, usual_part = part;
    hci_machine_release(&machine);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_c", &machine, &note), note.text);
    machine.model.back_emf_count = machine.model.slope_count = 1;
    machine.model.cogging_count = 0;
    wish(of, NULL, HCI_METHOD_AUTO);
    options.choose_at_most = choose_at_most;
    one_by_one = part = every ? 8 : 1;
    TEST_ASSERT_TRUE(sweep(run_solve) > 100);
    one_by_one = usual_one_by_one;
    part = usual_part;
}

static void test_newton(void)
{
    hci_component component[2] = {{1.0, 1}, {5.0, -1}};
    hci_set name[2] = {HCI_SET_POS, HCI_SET_NEG};
    const hci_component_set two = {component, name, 2, {{0}}};
    interior(&two, 0);
}

static void test_newton_with_all_components(void)
{
    interior(NULL, 0);
}

static void test_newton_with_few_components(void)
{
    interior(NULL, 2);
}

/* ---- writing
 * ---------------------------------------------------------------------------------------------------- */

static hci_solution solution;

static hci_status write_solution(double *figure)
{
    hci_note note = {{0}};
    const hci_status status = hci_solution_write(&machine, &solution, HCI_OK, files_path("out"), &note);
    *figure = (double)files_count(files_path("out"));
    if (status != HCI_OK) {
        TEST_ASSERT_EQUAL_INT(-1, files_count(files_path("out")));
    }
    files_remove(files_path("out"));
    return noted(status, &note);
}

static hci_status write_json(double *figure)
{
    char *text = hci_solution_json(&solution, HCI_OK);
    if (text == NULL) return HCI_ERROR_MEMORY;
    *figure = (double)strlen(text);
    hci_text_free(text);
    return HCI_OK;
}

static hci_status write_emit_json(double *figure)
{
    const hci_emit_request request = {.name = "memory"};
    const hci_emit_result result = {.choices = 1};
    char *text = hci_emit_json(&request, &result);
    if (text == NULL) return HCI_ERROR_MEMORY;
    *figure = (double)strlen(text);
    hci_text_free(text);
    return HCI_OK;
}

static hci_status emit(double *figure)
{
    hci_note note = {{0}};
    hci_emit_request request = {0};
    hci_emit_result result = {0};
    hci_status status;
    request.name = "memory";
    request.currents = solution.constant;
    request.per_Nm = solution.per_Nm;
    request.current_count = request.per_Nm_count = solution.current.count;
    request.reference_torque_Nm = 3.0;
    request.points = 32;
    status = hci_emit(files_path("out"), &request, &result, &note);
    *figure = result.chosen.max_error_A + (double)result.crc32;
    if (status != HCI_OK) {
        TEST_ASSERT_EQUAL_INT(-1, files_count(files_path("out")));
    }
    files_remove(files_path("out"));
    return noted(status, &note);
}

static void test_writing(void)
{
    hci_note note = {{0}};
    wish(&set, NULL, HCI_METHOD_AUTO);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_solve(&machine, &options, &solution, &note), note.text);
    TEST_ASSERT_TRUE(sweep(write_json) > 40);
    TEST_ASSERT_TRUE(sweep(write_emit_json) > 15);
    TEST_ASSERT_TRUE(sweep(write_solution) > 40);
    TEST_ASSERT_TRUE(sweep(emit) > 5);
    hci_solution_release(&solution);
}

/* Of a text that has no 0 behind the part. */
static void test_a_part_of_a_text(void)
{
    char *begin = hci_memory_text_part("torque_Nm", 6), *none = hci_memory_text_part("x", 0);
    char *all = hci_memory_text("torque_Nm");
    TEST_ASSERT_EQUAL_STRING("torque", begin);
    TEST_ASSERT_EQUAL_STRING("", none);
    TEST_ASSERT_EQUAL_STRING("torque_Nm", all);
    hci_memory_free(begin);
    hci_memory_free(none);
    hci_memory_free(all);
    hci_memory_fail_after(0);
    TEST_ASSERT_NULL(hci_memory_text("torque_Nm"));
    hci_memory_fail_after(-1);
}

int main(int argc, char **argv)
{
    every = argc > 1 && strcmp(argv[1], "every") == 0;
    if (every) {
        one_by_one = 1000;
        part = 50;
    }
    UNITY_BEGIN();
    route_suitesparse();
    RUN_TEST(test_a_part_of_a_text);
    RUN_TEST(test_reading);
    RUN_TEST(test_sparse_solvers);
    RUN_TEST(test_solving_a_square_system);
    RUN_TEST(test_solving_a_deficient_system);
    RUN_TEST(test_choosing);
    RUN_TEST(test_pointwise);
    RUN_TEST(test_newton);
    RUN_TEST(test_writing);
    if (every) {
        RUN_TEST(test_pointwise_without_i_d);
        RUN_TEST(test_newton_with_all_components);
        RUN_TEST(test_newton_with_few_components);
    }
    return UNITY_END();
}
