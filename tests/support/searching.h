/* A search that stands at a model of the test's choice, over the recordings of diagnosing.h. Include once in
 * a test, after `#define _XOPEN_SOURCE 700`. */
#ifndef SEARCHING_H
#define SEARCHING_H

#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/search/search.h"
#include "support/diagnosing.h"

static hci_dataset dataset;
static hci_attribute_options how;
static hci_search search;
static hci_fitted_model model;
static hci_note note;

/* The dataset of what has been recorded, and an empty model. */
static inline void search_start(void)
{
    static const hci_effects none = {NULL, 0};
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_dataset_make(&machine, &none, &runs, &dataset, &note));
    how = (hci_attribute_options){.runs = runs.run, .resolution_Nm = 5e-4, .reference_current_A = NAN};
    search = (hci_search){.regression = &dataset.regression, .options = &how, .richness = 1};
    search.residual_Nm = calloc(2 * dataset.samples.count + 1, sizeof *search.residual_Nm);
    search.variance = search.residual_Nm + dataset.samples.count;
}

static inline void search_end(void)
{
    free(search.residual_Nm);
    search.residual_Nm = NULL;
    hci_known_residuals_release(&search.residuals);
    hci_fitted_model_release(&search.disbelieved.model);
    hci_fitted_model_release(&model);
    hci_dataset_release(&dataset);
}

static inline size_t parameter_of(const hci_effect_type *type, const char *name)
{
    size_t k = 0;
    while (k < type->parameter_count && strcmp(type->parameter[k].name, name) != 0)
        ++k;
    TEST_ASSERT_TRUE(k < type->parameter_count);
    return k;
}

/* One or (second not NULL) two terms of an effect that come and go together. */
static inline hci_candidate candidate_of(const char *effect, const char *first, const char *second,
                                         double order)
{
    hci_candidate x = {.type = hci_effect_type_find(effect), .count = second ? 2 : 1, .in = true};
    x.term[0] = (hci_effect_term){parameter_of(x.type, first), order, 0.0, NAN};
    if (second) x.term[1] = (hci_effect_term){parameter_of(x.type, second), order, 0.0, NAN};
    return x;
}

static inline void model_add(const char *effect, const char *first, const char *second, double order)
{
    const hci_candidate x = candidate_of(effect, first, second, order);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&model.candidates, &x, &note));
}

/* Noise and values of the model. */
static inline void model_fit(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_renew(&search, &model, &note));
}

/* What has changed a model has found noise and values anew: to do so once more changes nothing. */
static inline void model_is_renewed(void)
{
    const double score = model.fit.score, noise_Nm = hci_search_noise_rms(&search);
    model_fit();
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * fabs(model.fit.score), model.fit.score, score);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * hci_search_noise_rms(&search), hci_search_noise_rms(&search), noise_Nm);
}

static inline bool model_has(const char *effect)
{
    return hci_candidates_have(&model.candidates, hci_effect_type_find(effect));
}

/* The term of a model; fails where it is not in. */
static inline const hci_effect_term *term_in(const hci_candidates *list, const char *effect,
                                             const char *parameter, double order)
{
    const hci_candidate wanted = candidate_of(effect, parameter, NULL, order);
    for (size_t k = 0; k < list->count; ++k)
        for (size_t j = 0; j < list->candidate[k].count && list->candidate[k].in; ++j) {
            const hci_effect_term *t = &list->candidate[k].term[j];
            if (list->candidate[k].type == wanted.type && t->parameter == wanted.term[0].parameter &&
                fabs(t->order - order) < 1e-6)
                return t;
        }
    TEST_FAIL_MESSAGE(parameter);
    return NULL;
}

#endif
