#include "host/fmu/data_code.h"

static void add_numbers(hci_long_text *text, const double *value, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        if (k > 0) hci_long_text_add(text, ", ");
        hci_long_text_number(text, value[k]);
    }
}

static void open_array(hci_long_text *text, const char *type, const char *prefix, const char *name)
{
    hci_long_text_add(text, "static const %s %s_%s[] = {\n", type, prefix, name);
}

static void add_waves(const char *prefix, const hci_machine *m, hci_long_text *text)
{
    if (m->back_emf_count == 0) return;
    hci_long_text_add(text, "/* order, sequence, sine and cosine in N.m/A */\n");
    open_array(text, "hci_wave", prefix, "BACK_EMF");
    for (size_t k = 0; k < m->back_emf_count; ++k) {
        const hci_wave *w = &m->back_emf[k];
        hci_long_text_add(text, "    {");
        hci_long_text_number(text, w->order);
        hci_long_text_add(text, ", %d, ", w->sequence);
        add_numbers(text, (const double[]){w->sine, w->cosine}, 2);
        hci_long_text_add(text, "},\n");
    }
    hci_long_text_add(text, "};\n\n");
}

static void add_harmonics(const char *prefix, const hci_machine *m, hci_long_text *text)
{
    if (m->cogging_count == 0) return;
    hci_long_text_add(text, "/* order, sine and cosine in N.m */\n");
    open_array(text, "hci_harmonic", prefix, "COGGING");
    for (size_t k = 0; k < m->cogging_count; ++k) {
        hci_long_text_add(text, "    {");
        add_numbers(text, (const double[]){m->cogging[k].order, m->cogging[k].sine, m->cogging[k].cosine}, 3);
        hci_long_text_add(text, "},\n");
    }
    hci_long_text_add(text, "};\n\n");
}

static void add_matrices(const char *prefix, const char *name, const hci_inductance *x, size_t count,
                         hci_long_text *text)
{
    if (count == 0) return;
    hci_long_text_add(text, "/* order, sine and cosine of aa, bb, cc, ab, bc, ca in H%s */\n",
                      name[0] == 'S' ? "/rad" : "");
    open_array(text, "hci_inductance", prefix, name);
    for (size_t k = 0; k < count; ++k) {
        hci_long_text_add(text, "    {");
        hci_long_text_number(text, x[k].order);
        hci_long_text_add(text, ",\n     {");
        add_numbers(text, x[k].sine, HCI_PHASE_MATRIX);
        hci_long_text_add(text, "},\n     {");
        add_numbers(text, x[k].cosine, HCI_PHASE_MATRIX);
        hci_long_text_add(text, "}},\n");
    }
    hci_long_text_add(text, "};\n\n");
}

void hci_fmu_code_arrays(const char *prefix, const hci_machine *machine,
                         const hci_plant_inductance *inductance, hci_long_text *text)
{
    add_waves(prefix, machine, text);
    add_harmonics(prefix, machine, text);
    add_matrices(prefix, "SLOPE", machine->slope, machine->slope_count, text);
    add_matrices(prefix, "INDUCTANCE", inductance->terms, inductance->count, text);
}

/* `PREFIX_NAME, count`, or `0, 0`. */
static void add_array(hci_long_text *text, const char *prefix, const char *name, size_t count)
{
    if (count > 0)
        hci_long_text_add(text, "%s_%s, %zu", prefix, name, count);
    else
        hci_long_text_add(text, "0, 0");
}

void hci_fmu_code_machine(const char *prefix, const hci_machine *m, hci_long_text *text)
{
    hci_long_text_add(text, "{%d, ", m->pole_pairs);
    add_array(text, prefix, "BACK_EMF", m->back_emf_count);
    hci_long_text_add(text, ", ");
    add_array(text, prefix, "COGGING", m->cogging_count);
    hci_long_text_add(text, ", ");
    add_array(text, prefix, "SLOPE", m->slope_count);
    hci_long_text_add(text, "}");
}

void hci_fmu_code_inductance(const char *prefix, const hci_plant_inductance *x, hci_long_text *text)
{
    hci_long_text_add(text, "{");
    add_array(text, prefix, "INDUCTANCE", x->count);
    hci_long_text_add(text, ", ");
    add_numbers(text, (const double[]){x->d_H, x->q_H}, 2);
    hci_long_text_add(text, "}");
}

void hci_fmu_code_start(const double *start, size_t count, hci_long_text *text)
{
    hci_long_text_add(text, "/* Of each variable, in the order of the list of the model. */\n"
                            "const double hci_fmu_start[] = {\n");
    for (size_t k = 0; k < count; ++k) {
        hci_long_text_add(text, "    ");
        hci_long_text_number(text, start[k]);
        hci_long_text_add(text, ",\n");
    }
    hci_long_text_add(text, "};\n\n");
}
