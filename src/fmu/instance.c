#include "fmu/instance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

hci_fmu_status hci_fmu_tell(const hci_fmu_instance *x, const char *words)
{
    if (!words) return HCI_FMU_OK;
    x->say(x, HCI_FMU_ERROR, words);
    return HCI_FMU_ERROR;
}

hci_fmu_status hci_fmu_none(const hci_fmu_instance *x, size_t asked)
{
    return hci_fmu_tell(x, asked == 0 ? NULL : "this FMU has nothing of the kind");
}

static hci_fmu_head *head_of(hci_fmu_model *m)
{
    return (hci_fmu_head *)m;
}

/* ---- from beginning to end ---- */

static void to_start_values(hci_fmu_model *m)
{
    memcpy(head_of(m)->value, hci_fmu_start, hci_fmu_count * sizeof *hci_fmu_start);
    head_of(m)->has_begun = false;
}

static hci_fmu_model *new_model(void)
{
    hci_fmu_model *m = calloc(1, hci_fmu_model_size);
    if (!m) return NULL;
    to_start_values(m);
    if (hci_fmu_make(m)) return m;
    hci_fmu_release(m);
    free(m);
    return NULL;
}

hci_fmu_status hci_fmu_open(hci_fmu_instance *x, const char *token, const char *words)
{
    if (!words && (!token || strcmp(token, hci_fmu_token) != 0))
        words = "the GUID or token is that of another model description";
    if (!words && !(x->model = new_model())) words = "memory is out";
    return hci_fmu_tell(x, words);
}

void hci_fmu_close(hci_fmu_instance *x)
{
    if (!x->model) return;
    hci_fmu_release(x->model);
    free(x->model);
}

hci_fmu_status hci_fmu_begin(hci_fmu_instance *x)
{
    const char *words = hci_fmu_to_initial_state(x->model);
    head_of(x->model)->has_begun = !words;
    return hci_fmu_tell(x, words);
}

hci_fmu_status hci_fmu_reset(hci_fmu_instance *x)
{
    to_start_values(x->model);
    x->time_s = 0.0;
    return HCI_FMU_OK;
}

hci_fmu_status hci_fmu_do_step(hci_fmu_instance *x, double from_s, double duration_s)
{
    const char *words = NULL;
    if (!head_of(x->model)->has_begun)
        words = "a step before the end of the initialization";
    else if (!(duration_s > 0.0))
        words = "a communication step that is not above 0";
    if (!words) words = hci_fmu_step(x->model, duration_s);
    if (!words) x->time_s = from_s + duration_s;
    return hci_fmu_tell(x, words);
}

/* ---- values ---- */

static const char *check(hci_fmu_type type, uint32_t reference)
{
    if (reference == hci_fmu_count && type == HCI_FMU_REAL) return NULL;
    if (reference >= hci_fmu_count) return "a value reference that the model description does not have";
    if (hci_fmu_list[reference].type != type) return "a value reference of another type";
    return NULL;
}

static const char *update(hci_fmu_model *m)
{
    const char *words = head_of(m)->has_begun ? NULL : hci_fmu_to_initial_state(m);
    return words ? words : hci_fmu_update(m);
}

/* "what": of a number that is none. */
static const char *not_finite(hci_fmu_model *m, uint32_t reference, const char *what)
{
    hci_fmu_head *h = head_of(m);
    snprintf(h->words, sizeof h->words, "%s %s", hci_fmu_list[reference].name, what);
    return h->words;
}

hci_fmu_status hci_fmu_get(hci_fmu_instance *x, hci_fmu_type type, const uint32_t *reference, size_t count,
                           double *value)
{
    const char *words = update(x->model);
    for (size_t k = 0; k < count && !words; ++k) {
        words = check(type, reference[k]);
        if (words) continue;
        value[k] = reference[k] == hci_fmu_count ? x->time_s : head_of(x->model)->value[reference[k]];
        if (!isfinite(value[k])) words = not_finite(x->model, reference[k], "left the finite numbers");
    }
    return hci_fmu_tell(x, words);
}

static const char *check_set(const hci_fmu_head *h, hci_fmu_type type, uint32_t reference)
{
    const char *words = check(type, reference);
    if (words) return words;
    if (reference == hci_fmu_count) return "the time cannot be set";
    const hci_fmu_causality causality = hci_fmu_list[reference].causality;
    if (causality == HCI_FMU_OUTPUT) return "an output cannot be set";
    if (causality == HCI_FMU_PARAMETER && h->has_begun)
        return "parameters are fixed: set them before the initialization ends";
    return NULL;
}

hci_fmu_status hci_fmu_set(hci_fmu_instance *x, hci_fmu_type type, const uint32_t *reference, size_t count,
                           const double *value)
{
    hci_fmu_model *m = x->model;
    const char *words = NULL;
    for (size_t k = 0; k < count && !words; ++k)
        words = check_set(head_of(m), type, reference[k]);
    if (words) return hci_fmu_tell(x, words);
    for (size_t k = 0; k < count; ++k) {
        if (isfinite(value[k])) continue;
        if (x->logs)
            x->say(x, HCI_FMU_DISCARD,
                   not_finite(m, reference[k], "keeps its value: found no finite number"));
        return HCI_FMU_DISCARD;
    }
    for (size_t k = 0; k < count; ++k)
        head_of(m)->value[reference[k]] = value[k];
    return HCI_FMU_OK;
}

/* ---- states ---- */

/* A state that was taken; `size` bytes follow it: this head, and the state of the model. */
typedef struct {
    size_t size;
} saved;

typedef struct {
    double time_s, value[HCI_FMU_MOST_VARIABLES];
    bool has_begun;
} saved_head;

static hci_fmu_status new_saved(const hci_fmu_instance *x, size_t size, void **state)
{
    saved *s = realloc(*state, sizeof *s + size);
    if (!s) return hci_fmu_tell(x, "memory is out");
    s->size = size;
    *state = s;
    return HCI_FMU_OK;
}

hci_fmu_status hci_fmu_take(const hci_fmu_instance *x, void **state)
{
    const hci_fmu_head *h = head_of(x->model);
    saved_head head;
    const hci_fmu_status status = new_saved(x, sizeof head + hci_fmu_state_size(x->model), state);
    if (status) return status;
    memset(&head, 0, sizeof head);
    head.time_s = x->time_s;
    memcpy(head.value, h->value, sizeof head.value);
    head.has_begun = h->has_begun;
    char *bytes = (char *)*state + sizeof(saved);
    memcpy(bytes, &head, sizeof head);
    hci_fmu_state_save(x->model, bytes + sizeof head);
    return HCI_FMU_OK;
}

hci_fmu_status hci_fmu_return(hci_fmu_instance *x, const void *state)
{
    const saved *s = state;
    saved_head head;
    if (!s) return hci_fmu_tell(x, "no state was given");
    if (s->size < sizeof head) return hci_fmu_tell(x, "these bytes are no state of this FMU");
    memcpy(&head, s + 1, sizeof head);
    x->time_s = head.time_s;
    memcpy(head_of(x->model)->value, head.value, sizeof head.value);
    head_of(x->model)->has_begun = head.has_begun;
    if (!head.has_begun) return HCI_FMU_OK;
    return hci_fmu_tell(
        x, hci_fmu_state_load(x->model, (const char *)(s + 1) + sizeof head, s->size - sizeof head));
}

void hci_fmu_drop(void **state)
{
    if (!state) return;
    free(*state);
    *state = NULL;
}

hci_fmu_status hci_fmu_bytes_size(const hci_fmu_instance *x, const void *state, size_t *size)
{
    const saved *s = state;
    if (!s) return hci_fmu_tell(x, "no state was given");
    *size = s->size;
    return HCI_FMU_OK;
}

hci_fmu_status hci_fmu_to_bytes(const hci_fmu_instance *x, const void *state, void *bytes, size_t size)
{
    const saved *s = state;
    if (!s || size < s->size) return hci_fmu_tell(x, "no state, or too little memory for it");
    memcpy(bytes, s + 1, s->size);
    return HCI_FMU_OK;
}

hci_fmu_status hci_fmu_from_bytes(const hci_fmu_instance *x, const void *bytes, size_t size, void **state)
{
    const hci_fmu_status status = new_saved(x, size, state);
    if (!status) memcpy((char *)*state + sizeof(saved), bytes, size);
    return status;
}
