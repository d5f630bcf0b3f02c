#include "host/fmu/description_parts.h"

#include <string.h>

#include "hci/version.h"

void hci_fmu_attribute(hci_long_text *text, const char *name, const char *value)
{
    hci_long_text_add(text, " %s=\"", name);
    for (; *value; ++value) {
        const char *const escaped = *value == '&'   ? "&amp;"
                                    : *value == '<' ? "&lt;"
                                    : *value == '>' ? "&gt;"
                                    : *value == '"' ? "&quot;"
                                                    : NULL;
        if (escaped)
            hci_long_text_add(text, "%s", escaped);
        else
            hci_long_text_add(text, "%c", *value);
    }
    hci_long_text_add(text, "\"");
}

static void attribute_number(hci_long_text *text, const char *name, double value)
{
    hci_long_text_add(text, " %s=\"", name);
    hci_long_text_number(text, value);
    hci_long_text_add(text, "\"");
}

/* ---- head ---- */

void hci_fmu_head(const hci_fmu_description *d, int version, const char *token, const char *more,
                  hci_long_text *text)
{
    hci_long_text_add(text,
                      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"%d.0\"",
                      version);
    hci_fmu_attribute(text, "modelName", d->name);
    hci_fmu_attribute(text, token, d->token);
    hci_fmu_attribute(text, "description", d->what);
    hci_long_text_add(text,
                      " generationTool=\"hci-solve " HCI_VERSION_STRING
                      "\" variableNamingConvention=\"flat\"%s>\n  <CoSimulation",
                      more);
    hci_fmu_attribute(text, "modelIdentifier", d->identifier);
    hci_long_text_add(text, " canHandleVariableCommunicationStepSize=\"true\"");
}

/* ---- units ---- */

static const struct {
    const char *name, *base;
} UNITS[] = {
    {"A", "A=\"1\""},
    {"V", "kg=\"1\" m=\"2\" s=\"-3\" A=\"-1\""},
    {"Ohm", "kg=\"1\" m=\"2\" s=\"-3\" A=\"-2\""},
    {"N.m", "kg=\"1\" m=\"2\" s=\"-2\""},
    {"N.m.s/rad", "kg=\"1\" m=\"2\" s=\"-1\" rad=\"-1\""},
    {"kg.m2", "kg=\"1\" m=\"2\""},
    {"rad", "rad=\"1\""},
    {"rad/s", "rad=\"1\" s=\"-1\""},
    {"s", "s=\"1\""},
    {"degC", "K=\"1\" offset=\"273.15\""},
    {"V/A", "kg=\"1\" m=\"2\" s=\"-3\" A=\"-2\""},
    {"V/(A.s)", "kg=\"1\" m=\"2\" s=\"-4\" A=\"-2\""},
};

static bool is_used(const hci_fmu_description *d, const char *unit)
{
    if (strcmp(unit, "s") == 0) return true;
    for (size_t k = 0; k < d->count; ++k)
        if (!d->left_out[k] && strcmp(d->list[k].unit, unit) == 0) return true;
    return false;
}

void hci_fmu_units(const hci_fmu_description *d, hci_long_text *text)
{
    hci_long_text_add(text, "  <UnitDefinitions>\n");
    for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS; ++k)
        if (is_used(d, UNITS[k].name))
            hci_long_text_add(text, "    <Unit name=\"%s\"><BaseUnit %s/></Unit>\n", UNITS[k].name,
                              UNITS[k].base);
    hci_long_text_add(text, "  </UnitDefinitions>\n");
}

/* ---- the rest ---- */

void hci_fmu_value_attributes(const hci_fmu_description *d, size_t k, hci_long_text *text)
{
    const hci_fmu_variable *v = &d->list[k];
    if (v->unit[0]) hci_fmu_attribute(text, "unit", v->unit);
    if (v->type == HCI_FMU_INTEGER)
        hci_long_text_add(text, " min=\"1\" max=\"%d\" start=\"%d\"", d->choices, (int)d->start[k]);
    else if (v->type == HCI_FMU_BOOLEAN)
        hci_long_text_add(text, " start=\"%s\"", d->start[k] > 0.0 ? "true" : "false");
    else if (v->causality != HCI_FMU_OUTPUT)
        attribute_number(text, "start", d->start[k]);
}

void hci_fmu_experiment(const hci_fmu_description *d, hci_long_text *text)
{
    hci_long_text_add(text, "  <LogCategories>\n    <Category name=\"logStatusError\"/>\n"
                            "    <Category name=\"logStatusDiscard\"/>\n  </LogCategories>\n"
                            "  <DefaultExperiment startTime=\"0.0\"");
    attribute_number(text, "stepSize", d->step_s);
    hci_long_text_add(text, "/>\n");
}

void hci_fmu_causality_attributes(const hci_fmu_variable *variable, hci_long_text *text)
{
    static const char *const WORDS[] = {
        [HCI_FMU_PARAMETER] = " causality=\"parameter\" variability=\"fixed\"",
        [HCI_FMU_INPUT] = " causality=\"input\" variability=\"continuous\"",
        [HCI_FMU_OUTPUT] = " causality=\"output\" variability=\"continuous\" initial=\"calculated\"",
    };
    hci_long_text_add(text, "%s", WORDS[variable->causality]);
}

void hci_fmu_dependencies(const hci_fmu_description *d, size_t output,
                          size_t (*reference)(const hci_fmu_description *, size_t), hci_long_text *text)
{
    const char *between = "";
    hci_long_text_add(text, " dependencies=\"");
    for (size_t k = 0; k < d->count; ++k) {
        if (d->left_out[k] || d->list[k].causality != HCI_FMU_INPUT || !d->feeds(d->context, k, output))
            continue;
        hci_long_text_add(text, "%s%zu", between, reference(d, k));
        between = " ";
    }
    hci_long_text_add(text, "\"");
}
