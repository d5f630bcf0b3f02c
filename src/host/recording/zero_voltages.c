#include "host/recording/zero_voltages.h"

#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/base/quote.h"

/* Columns of one kind follow each other. */
typedef struct {
    hci_run_column first, last;
} kind;

static const kind KINDS[] = {{HCI_RUN_VA, HCI_RUN_VC}, {HCI_RUN_VAB, HCI_RUN_VCA}, {HCI_RUN_VD, HCI_RUN_VQ}};

static bool is_zero(const double *value, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (value[k] != 0.0) return false;
    return count > 0;
}

/* Whether the file has such columns, all of them read and 0. */
static bool are_zero(const hci_run_columns *c, const kind *x)
{
    bool any = false;
    for (unsigned which = x->first; which <= x->last; ++which) {
        if (!c->has[which]) continue;
        if (!c->ready[which] || !is_zero(c->ready[which], c->count)) return false;
        any = true;
    }
    return any;
}

static void set_has(hci_run_columns *c, const kind *x, const bool has[HCI_RUN_COLUMN_COUNT])
{
    for (unsigned which = x->first; which <= x->last; ++which)
        c->has[which] = has != NULL && has[which];
}

/* Frees the values of columns that are none any more, and says so. */
static void forget(hci_run_columns *c, const kind *x, const bool had[HCI_RUN_COLUMN_COUNT])
{
    char names[256] = "", quoted[HCI_QUOTE_SIZE];
    for (unsigned which = x->first; which <= x->last; ++which) {
        if (!had[which]) continue;
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%s", used > 0 ? ", " : "",
                 hci_quote(hci_csv_name(c->csv, c->at[which]), quoted));
        c->used[c->at[which]] = true;
        hci_memory_free(c->ready[which]);
        c->ready[which] = NULL;
    }
    hci_note_add(c->remark, "%s: 0 in every row, which no voltage is that was measured; not used", names);
}

void hci_zero_voltages_leave(hci_run_columns *c)
{
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; ++k) {
        bool had[HCI_RUN_COLUMN_COUNT];
        if (!are_zero(c, &KINDS[k])) continue;
        memcpy(had, c->has, sizeof had);
        set_has(c, &KINDS[k], NULL);
        if (hci_run_columns_suffice(c))
            forget(c, &KINDS[k], had);
        else
            set_has(c, &KINDS[k], had);
    }
}
