/* The rows of a table as data for other programs: NAME.csv, a row for each angle, and NAME.json, the same
 * with what NAME.h says. Straight lines between rows keep the error that is stated; after the last row comes
 * the first. */
#include "host/emit/text.h"

#include "hci/version.h"

enum { MOST_COLUMNS = 7 };

/* A column of the file: the angle, or a current of one part. */
typedef struct {
    const char *name;
    size_t part, current;
} column;

static size_t columns_of(const hci_emission *e, column to[MOST_COLUMNS])
{
    static const char *const ABC[2][3] = {{"ia_A", "ib_A", "ic_A"},
                                          {"ia_A_per_Nm", "ib_A_per_Nm", "ic_A_per_Nm"}};
    static const char *const DQ[2][3] = {{"id_A", "iq_A", ""}, {"id_A_per_Nm", "iq_A_per_Nm", ""}};
    const bool abc = e->table.frame == HCI_TABLE_ABC;
    size_t count = 0;
    for (size_t part = 0; part < e->table.parts; ++part)
        for (size_t j = 0; j < (abc ? 3u : 2u); ++j)
            to[count++] = (column){abc ? ABC[part][j] : DQ[part][j], part, j};
    return count;
}

/* The current of a row; rows hold what is proportional to the torque first, and of a star two phases. */
static double value_at(const hci_emission *e, size_t row, const column *c)
{
    const hci_table_f32 *t = &e->table;
    const size_t part = t->parts == 2 ? 1 - c->part : 0;
    const float *values = e->rows + (row * t->parts + part) * t->columns;
    if (c->current < t->columns) return (double)values[c->current];
    return -(double)values[0] - (double)values[1];
}

static double angle_at(const hci_emission *e, size_t row)
{
    return 2.0 * HCI_PI * (double)e->table.period_turns * (double)row / (double)e->table.points;
}

static void write_row(const hci_emission *e, size_t row, const column *list, size_t count, hci_output *out)
{
    char text[32];
    hci_output_text(out, "%s", hci_emission_number(angle_at(e, row), text));
    for (size_t j = 0; j < count; ++j)
        hci_output_text(out, ",%s", hci_emission_number(value_at(e, row, &list[j]), text));
}

void hci_emission_write_csv(const hci_emission *e, hci_output *out)
{
    column list[MOST_COLUMNS];
    const size_t count = columns_of(e, list);
    hci_output_text(out, "theta_e_rad");
    for (size_t j = 0; j < count; ++j)
        hci_output_text(out, ",%s", list[j].name);
    hci_output_text(out, "\n");
    for (size_t k = 0; k < e->table.points; ++k) {
        write_row(e, k, list, count, out);
        hci_output_text(out, "\n");
    }
}

static void write_member(hci_output *out, const char *name, double value)
{
    char text[32];
    hci_output_text(out, "  \"%s\": %s,\n", name, hci_emission_number(value, text));
}

static void write_facts(const hci_emission *e, hci_output *out)
{
    const hci_table_f32 *t = &e->table;
    hci_output_text(out, "  \"name\": \"%s\",\n  \"written_by\": \"hci-solve " HCI_VERSION_STRING "\",\n",
                    e->request->name);
    hci_output_text(out, "  \"period_turns\": %u,\n  \"points\": %u,\n", (unsigned)t->period_turns,
                    (unsigned)t->points);
    if (e->request->facts.pole_pairs > 0)
        hci_output_text(out, "  \"pole_pairs\": %zu,\n", e->request->facts.pole_pairs);
    write_member(out, "max_error_A", (double)t->max_error_A);
    write_member(out, "peak_A", (double)t->peak_A);
    if (e->result.ripples > 0)
        write_member(out, "ripple_of_the_table_Nm", e->result.ripple[e->result.ripples > 1 ? 1 : 0].own_Nm);
    if (t->parts == 2) write_member(out, "reference_torque_Nm", (double)t->reference_torque_Nm);
}

void hci_emission_write_json(const hci_emission *e, hci_output *out)
{
    column list[MOST_COLUMNS];
    const size_t count = columns_of(e, list);
    hci_output_text(out, "{\n");
    write_facts(e, out);
    hci_output_text(out, "  \"columns\": [\"theta_e_rad\"");
    for (size_t j = 0; j < count; ++j)
        hci_output_text(out, ", \"%s\"", list[j].name);
    hci_output_text(out, "],\n  \"rows\": [");
    for (size_t k = 0; k < e->table.points; ++k) {
        hci_output_text(out, k > 0 ? ",\n    [" : "\n    [");
        write_row(e, k, list, count, out);
        hci_output_text(out, "]");
    }
    hci_output_text(out, "\n  ]\n}\n");
}
