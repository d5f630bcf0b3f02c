/* modelDescription.xml of FMI 2.0. */
#include "hci/version.h"
#include "host/fmu/description_parts.h"

/* Variables are counted from 1 here, in the order of the file. */
static size_t place_of(const hci_fmu_description *d, size_t variable)
{
    size_t place = 1;
    for (size_t k = 0; k < variable; ++k)
        place += !d->left_out[k];
    return place;
}

static void add_head(const hci_fmu_description *d, hci_long_text *text)
{
    hci_long_text_add(text,
                      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"2.0\"");
    hci_fmu_attribute(text, "modelName", d->name);
    hci_fmu_attribute(text, "guid", d->token);
    hci_fmu_attribute(text, "description", d->what);
    hci_long_text_add(text, " generationTool=\"hci-solve " HCI_VERSION_STRING
                            "\" variableNamingConvention=\"flat\" numberOfEventIndicators=\"0\">\n"
                            "  <CoSimulation");
    hci_fmu_attribute(text, "modelIdentifier", d->identifier);
    hci_long_text_add(text, " canHandleVariableCommunicationStepSize=\"true\""
                            " canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\""
                            " canSerializeFMUstate=\"true\">\n    <SourceFiles>\n");
    for (size_t k = 0; k < d->source_count; ++k)
        hci_long_text_add(text, "      <File name=\"%s\"/>\n", d->sources[k]);
    hci_long_text_add(text, "    </SourceFiles>\n  </CoSimulation>\n");
}

static void add_choices(const hci_fmu_description *d, hci_long_text *text)
{
    if (!d->choices) return;
    hci_long_text_add(text, "  <TypeDefinitions>\n    <SimpleType name=\"Choice\"><Enumeration>\n");
    for (int k = 0; d->choices[k]; ++k)
        hci_long_text_add(text, "      <Item name=\"%s\" value=\"%d\"/>\n", d->choices[k], k + 1);
    hci_long_text_add(text, "    </Enumeration></SimpleType>\n  </TypeDefinitions>\n");
}

static void add_type(const hci_fmu_description *d, size_t k, hci_long_text *text)
{
    const hci_fmu_variable *v = &d->list[k];
    const bool starts = v->causality != HCI_FMU_OUTPUT;
    if (v->type == HCI_FMU_REAL) {
        hci_long_text_add(text, "<Real");
        if (v->unit[0]) hci_fmu_attribute(text, "unit", v->unit);
        if (starts) hci_fmu_attribute_number(text, "start", d->start[k]);
    } else if (v->type == HCI_FMU_BOOLEAN) {
        hci_long_text_add(text, "<Boolean start=\"%s\"", d->start[k] > 0.0 ? "true" : "false");
    } else {
        hci_long_text_add(text, "<Enumeration declaredType=\"Choice\" start=\"%d\"", (int)d->start[k]);
    }
    hci_long_text_add(text, "/>");
}

static void add_variables(const hci_fmu_description *d, hci_long_text *text)
{
    hci_long_text_add(text, "  <ModelVariables>\n");
    for (size_t k = 0; k < d->count; ++k) {
        if (d->left_out[k]) continue;
        hci_long_text_add(text, "    <ScalarVariable");
        hci_fmu_attribute(text, "name", d->list[k].name);
        hci_long_text_add(text, " valueReference=\"%zu\"", k);
        hci_fmu_attribute(text, "description", d->list[k].description);
        hci_fmu_causality_attributes(&d->list[k], text);
        hci_long_text_add(text, ">");
        add_type(d, k, text);
        hci_long_text_add(text, "</ScalarVariable>\n");
    }
    hci_long_text_add(text, "  </ModelVariables>\n");
}

static void add_structure(const hci_fmu_description *d, hci_long_text *text)
{
    hci_long_text_add(text, "  <ModelStructure>\n    <Outputs>\n");
    for (size_t k = 0; k < d->count; ++k) {
        if (d->left_out[k] || d->list[k].causality != HCI_FMU_OUTPUT) continue;
        hci_long_text_add(text, "      <Unknown index=\"%zu\"", place_of(d, k));
        hci_fmu_dependencies(d, k, place_of, text);
        hci_long_text_add(text, "/>\n");
    }
    hci_long_text_add(text, "    </Outputs>\n    <InitialUnknowns>\n");
    for (size_t k = 0; k < d->count; ++k)
        if (!d->left_out[k] && d->list[k].causality == HCI_FMU_OUTPUT)
            hci_long_text_add(text, "      <Unknown index=\"%zu\"/>\n", place_of(d, k));
    hci_long_text_add(text, "    </InitialUnknowns>\n  </ModelStructure>\n</fmiModelDescription>\n");
}

void hci_fmu_describe_2(const hci_fmu_description *d, hci_long_text *text)
{
    add_head(d, text);
    hci_fmu_units(d, text);
    add_choices(d, text);
    hci_fmu_experiment(d, text);
    add_variables(d, text);
    add_structure(d, text);
}
