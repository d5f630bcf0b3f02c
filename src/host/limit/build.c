#include "host/limit/build.h"

#include <string.h>

#include "host/base/memory.h"

bool hci_limit_is_swing(const hci_limit_build *b)
{
    return b->of->minimise == HCI_MINIMISE_PEAK_TO_PEAK;
}

size_t hci_limit_objective(const hci_limit_build *b)
{
    return b->coordinates;
}

static size_t unknowns_of(const hci_limit_build *b)
{
    if (b->stage == HCI_STAGE_FIT || b->stage == HCI_STAGE_MEAN) return b->coordinates + 1;
    return b->coordinates + (hci_limit_is_swing(b) ? 3 : b->stage == HCI_STAGE_RIPPLE ? 1 : 0);
}

bool hci_limit_build_begin(const hci_limit_program *of, hci_limit_stage stage, hci_limit_build *b)
{
    const size_t system_rows = of->field.system ? of->field.system->rows : 0;
    memset(b, 0, sizeof *b);
    b->of = of;
    b->stage = stage;
    b->coordinates = 2 * of->field.set->count;
    b->n = unknowns_of(b);
    b->width = b->n + 1;
    b->equal = hci_memory_new((system_rows + 3 * b->coordinates) * b->width, sizeof *b->equal);
    b->p = hci_memory_new(b->n * b->n, sizeof *b->p);
    b->c = hci_memory_new(b->n, sizeof *b->c);
    return b->equal && b->p && b->c;
}

void hci_limit_build_release(hci_limit_build *b)
{
    hci_memory_free(b->row);
    hci_memory_free(b->low);
    hci_memory_free(b->limit_of);
    hci_memory_free(b->at);
    hci_memory_free(b->cone);
    hci_memory_free(b->equal);
    hci_memory_free(b->p);
    hci_memory_free(b->c);
}

static bool grow(hci_limit_build *b)
{
    const size_t room = 2 * b->room + 64;
    double *row = hci_memory_resize(b->row, room * b->width, sizeof *row);
    if (row) b->row = row;
    double *low = hci_memory_resize(b->low, room, sizeof *low);
    if (low) b->low = low;
    size_t *limit_of = hci_memory_resize(b->limit_of, room, sizeof *limit_of);
    if (limit_of) b->limit_of = limit_of;
    hci_limit_point *at = hci_memory_resize(b->at, room, sizeof *at);
    if (at) b->at = at;
    size_t *cone = hci_memory_resize(b->cone, room, sizeof *cone);
    if (cone) b->cone = cone;
    b->is_full = b->is_full || !row || !low || !limit_of || !at || !cone;
    if (!b->is_full) b->room = room;
    return !b->is_full;
}

double *hci_limit_row_add(hci_limit_build *b)
{
    double *row;
    if (b->is_full || (b->rows == b->room && !grow(b))) return NULL;
    row = b->row + b->rows * b->width;
    memset(row, 0, b->width * sizeof *row);
    b->low[b->rows] = 0.0;
    b->at[b->rows] = (hci_limit_point){.kind = HCI_POINT_NONE};
    b->limit_of[b->rows++] = 0;
    return row;
}

void hci_limit_cone_begin(hci_limit_build *b)
{
    if (b->is_full || (b->rows == b->room && !grow(b))) return;
    b->cone[b->cones++] = b->rows;
}

void hci_limit_cone_end(hci_limit_build *b)
{
    if (!b->is_full) b->cone[b->cones - 1] = b->rows - b->cone[b->cones - 1];
}

double *hci_limit_equation_add(hci_limit_build *b)
{
    return b->equal + b->equalities++ * b->width;
}

size_t hci_limit_tag(hci_limit_kind kind, int phase)
{
    return 1 + 4 * (size_t)kind + (size_t)phase;
}

size_t hci_limit_tag_of(const hci_limit_point *p)
{
    return hci_limit_tag(p->kind == HCI_POINT_CURRENT ? HCI_LIMIT_CURRENT : HCI_LIMIT_VOLTAGE, p->phase);
}

void hci_limit_of_tag(size_t tag, hci_limit_kind *kind, int *phase)
{
    *kind = (hci_limit_kind)((tag - 1) / 4);
    *phase = (int)((tag - 1) % 4);
}
