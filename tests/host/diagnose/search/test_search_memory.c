/* Memory that is short at any place of a step of the search: it says so and leaves nothing behind, which the
 * sanitizers see. Steps of a few hundred allocations at each of the first ones, and at some of the rest. */
#include "host/base/memory.h"
#include "host/diagnose/attribute/attribute.h"
#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/belief.h"
#include "host/diagnose/search/few_values.h"
#include "host/diagnose/search/forward.h"
#include "host/diagnose/search/no_load.h"
#include "host/diagnose/search/rivals.h"
#include "host/diagnose/search/rounds.h"
#include "host/diagnose/search/scaled.h"
#include "host/diagnose/search/sensor_zeros.h"
#include "host/diagnose/attribute/settle.h"
#include "host/diagnose/search/stability.h"
#include "support/searching.h"

enum { SAMPLES = 150, EACH = 20 };

static hci_attribution attribution;
static bool flag;
static double number;

/* Runs there and back, one of them without a current, of a machine with friction and a wrong zero. */
void setUp(void)
{
    dataset_start();
    for (int k = 0; k < 7; ++k) {
        const double direction = k % 2 ? -1.0 : 1.0;
        record(SAMPLES,
               &(point){(40.0 + 15.0 * k) * direction, (double[]){3.0, 9.0, 0.0, 6.0, 2.0, 0.0, 5.0}[k], 0.2,
                        0.05 * direction, 0.0});
    }
}

void tearDown(void)
{
    dataset_end();
}

/* ---- steps ---- */

static const hci_effect_type *type(const char *name)
{
    return hci_effect_type_find(name);
}

static hci_status explain(void)
{
    return hci_search_explained_by(&search, &model, type("friction"), &number, &note);
}

static hci_status notice(void)
{
    static const hci_candidates none;
    return hci_search_noticeable(&search, &model.candidates, &none, &flag, &note);
}

static hci_status leave_out(void)
{
    hci_fitted_model without = {0};
    const hci_status status = hci_search_without(&search, &model, type("friction"), &without, &note);
    if (!status) hci_fitted_model_release(&without);
    return status;
}

static hci_status renew(void)
{
    return hci_search_renew(&search, &model, &note);
}

static hci_status prune(void)
{
    return hci_search_prune(&search, &model, &note);
}

static hci_status drop(void)
{
    return hci_search_drop(&search, &model, &flag, &note);
}

static hci_status drop_unsure(void)
{
    return hci_search_drop_unsure(&search, &model, &note);
}

static hci_status go_forward(void)
{
    return hci_search_forward(&search, &model, &flag, &note);
}

static hci_status forward_few(void)
{
    return hci_search_forward_few(&search, &model, model.fit.score, &flag, &note);
}

static hci_status swap(void)
{
    return hci_search_swap(&search, &model, &flag, &note);
}

static hci_status rival(void)
{
    return hci_search_rivals(&search, type("friction"), &attribution, &note);
}

static hci_status tell(void)
{
    return hci_search_is_told(&search, &model, type("friction"), &flag, &note);
}

static hci_status ask_angle(void)
{
    return hci_search_is_of_angle(&search, &model, type("friction"), &flag, &note);
}

static hci_status instead(void)
{
    hci_fitted_model other = {0};
    const hci_status status =
        hci_search_instead(&search, &model, type("friction"), type("torque_sensor"), &other, &note);
    if (!status) hci_fitted_model_release(&other);
    return status;
}

static hci_status predict(void)
{
    return hci_search_keep_predictive(&search, &model, &note);
}

static hci_status left_out(void)
{
    return hci_search_left_out(&search, &model.candidates, &number, &note);
}

static hci_status unpredicted(void)
{
    return hci_search_unpredicted(&search, &model.candidates, &number, &note);
}

static hci_status stability(void)
{
    return hci_search_stability(&search, &attribution, &note);
}

static hci_status sensor_zeros(void)
{
    return hci_search_sensor_zeros(&search, &model, &flag, &note);
}

static hci_status torque_gain(void)
{
    return hci_search_torque_gain(&search, &model, &flag, &note);
}

static hci_status opposite(void)
{
    return hci_search_opposite(&search, &flag, &note);
}

static hci_status scaled(void)
{
    return hci_search_scaled_leave(&search, &model, 0.1, &note);
}

static hci_status brakes(void)
{
    return hci_search_keep_brakes(&search, &model, &note);
}

static hci_status settle(void)
{
    return hci_search_settle(&search, &attribution, &note);
}

static hci_status rounds(void)
{
    return hci_search_rounds(&search, &model, &note);
}

static hci_status whole(void)
{
    hci_attribution found;
    const hci_status status = hci_attribute(&dataset.regression, &how, &found, &note);
    if (!status) hci_attribution_release(&found);
    return status;
}

static const struct {
    hci_status (*step)(void);
    const char *name;
} STEP[] = {{explain, "explain"},
            {notice, "notice"},
            {leave_out, "leave out"},
            {renew, "renew"},
            {prune, "prune"},
            {drop, "drop"},
            {drop_unsure, "drop unsure"},
            {go_forward, "forward"},
            {forward_few, "forward few"},
            {swap, "swap"},
            {rival, "rivals"},
            {tell, "told"},
            {ask_angle, "of the angle"},
            {instead, "instead"},
            {predict, "predictive"},
            {left_out, "left out"},
            {unpredicted, "unpredicted"},
            {stability, "stability"},
            {sensor_zeros, "sensor zeros"},
            {torque_gain, "torque gain"},
            {opposite, "opposite"},
            {scaled, "scaled"},
            {brakes, "brakes"},
            {settle, "settle"},
            {rounds, "rounds"},
            {whole, "whole"}};

/* ---- memory ---- */

static void start(void)
{
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("cogging", "sine", "cosine", 6.0);
    model_add("torque_sensor", "offset", NULL, 0.0);
    model_fit();
    memset(&attribution, 0, sizeof attribution);
    attribution.types = hci_candidate_types();
    for (size_t r = 0; r < attribution.types; ++r) {
        attribution.verdict[r].type = hci_candidate_type(r);
        attribution.verdict[r].in = hci_candidates_have(&model.candidates, hci_candidate_type(r));
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fitted_model_copy(&model, &attribution.model, &note));
}

static void finish(void)
{
    hci_fitted_model_release(&search.single);
    hci_attribution_release(&attribution);
    search_end();
}

/* Once, or from there on. */
static hci_status step_with(size_t k, long allocations, bool once)
{
    start();
    if (once)
        hci_memory_fail_once_after(allocations);
    else
        hci_memory_fail_after(allocations);
    const hci_status status = STEP[k].step();
    hci_memory_fail_after(-1);
    if (status) {
        TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_ERROR_MEMORY, status, STEP[k].name);
        TEST_ASSERT_TRUE_MESSAGE(note.text[0] != '\0', STEP[k].name);
    }
    finish();
    return status;
}

static void test_memory_is_short_at_any_place(void)
{
    for (size_t k = 0; k < sizeof STEP / sizeof *STEP; ++k) {
        hci_status status = HCI_ERROR_MEMORY;
        long n = 0;
        for (; status; n += 1 + (n > EACH ? n / 2 : 0)) {
            status = step_with(k, n, false);
            if (status) (void)step_with(k, n, true);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_memory_is_short_at_any_place);
    return UNITY_END();
}
