/* modelDescription.xml and buildDescription.xml of FMI 3.0. */
#include "host/fmu/description_parts.h"

static size_t reference_of(const hci_fmu_description *d, size_t variable)
{
    (void)d;
    return variable;
}

static void add_variable(const hci_fmu_description *d, size_t k, hci_long_text *text)
{
    static const char *const TYPES[] = {
        [HCI_FMU_REAL] = "Float64", [HCI_FMU_BOOLEAN] = "Boolean", [HCI_FMU_INTEGER] = "Int32"};
    const hci_fmu_variable *v = &d->list[k];
    hci_long_text_add(text, "    <%s", TYPES[v->type]);
    hci_fmu_attribute(text, "name", v->name);
    hci_long_text_add(text, " valueReference=\"%zu\"", k);
    hci_fmu_attribute(text, "description", v->description);
    hci_fmu_causality_attributes(v, text);
    hci_fmu_value_attributes(d, k, text);
    hci_long_text_add(text, "/>\n");
}

static void add_variables(const hci_fmu_description *d, hci_long_text *text)
{
    hci_long_text_add(text,
                      "  <ModelVariables>\n    <Float64 name=\"time\" valueReference=\"%zu\""
                      " causality=\"independent\" variability=\"continuous\" unit=\"s\""
                      " description=\"Simulation time\"/>\n",
                      d->count);
    for (size_t k = 0; k < d->count; ++k)
        if (!d->left_out[k]) add_variable(d, k, text);
    hci_long_text_add(text, "  </ModelVariables>\n");
}

static void add_structure(const hci_fmu_description *d, hci_long_text *text)
{
    hci_long_text_add(text, "  <ModelStructure>\n");
    for (size_t k = 0; k < d->count; ++k) {
        if (d->left_out[k] || d->list[k].causality != HCI_FMU_OUTPUT) continue;
        hci_long_text_add(text, "    <Output valueReference=\"%zu\"", k);
        hci_fmu_dependencies(d, k, reference_of, text);
        hci_long_text_add(text, "/>\n");
    }
    for (size_t k = 0; k < d->count; ++k)
        if (!d->left_out[k] && d->list[k].causality == HCI_FMU_OUTPUT)
            hci_long_text_add(text, "    <InitialUnknown valueReference=\"%zu\"/>\n", k);
    hci_long_text_add(text, "  </ModelStructure>\n</fmiModelDescription>\n");
}

void hci_fmu_describe_3(const hci_fmu_description *d, hci_long_text *text)
{
    hci_fmu_head(d, 3, "instantiationToken", "", text);
    hci_long_text_add(text, " canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\"/>\n");
    hci_fmu_units(d, text);
    hci_fmu_experiment(d, text);
    add_variables(d, text);
    add_structure(d, text);
}

void hci_fmu_describe_build(const hci_fmu_description *d, hci_long_text *text)
{
    hci_long_text_add(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                            "<fmiBuildDescription fmiVersion=\"3.0\">\n  <BuildConfiguration");
    hci_fmu_attribute(text, "modelIdentifier", d->identifier);
    hci_long_text_add(text, ">\n    <SourceFileSet language=\"C99\">\n");
    for (size_t k = 0; k < d->source_count; ++k)
        hci_long_text_add(text, "      <SourceFile name=\"%s\"/>\n", d->sources[k]);
    hci_long_text_add(text, "    </SourceFileSet>\n    <Library name=\"m\"/>\n  </BuildConfiguration>\n"
                            "</fmiBuildDescription>\n");
}
