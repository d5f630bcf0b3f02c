/* modelDescription.xml of FMI 2.0. */
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
    hci_fmu_head(d, 2, "guid", " numberOfEventIndicators=\"0\"", text);
    hci_long_text_add(text, " canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\""
                            " canSerializeFMUstate=\"true\">\n    <SourceFiles>\n");
    for (size_t k = 0; k < d->source_count; ++k)
        hci_long_text_add(text, "      <File name=\"%s\"/>\n", d->sources[k]);
    hci_long_text_add(text, "    </SourceFiles>\n  </CoSimulation>\n");
}

static void add_variables(const hci_fmu_description *d, hci_long_text *text)
{
    static const char *const TYPES[] = {
        [HCI_FMU_REAL] = "Real", [HCI_FMU_BOOLEAN] = "Boolean", [HCI_FMU_INTEGER] = "Integer"};
    hci_long_text_add(text, "  <ModelVariables>\n");
    for (size_t k = 0; k < d->count; ++k) {
        if (d->left_out[k]) continue;
        hci_long_text_add(text, "    <ScalarVariable");
        hci_fmu_attribute(text, "name", d->list[k].name);
        hci_long_text_add(text, " valueReference=\"%zu\"", k);
        hci_fmu_attribute(text, "description", d->list[k].description);
        hci_fmu_causality_attributes(&d->list[k], text);
        hci_long_text_add(text, "><%s", TYPES[d->list[k].type]);
        hci_fmu_value_attributes(d, k, text);
        hci_long_text_add(text, "/></ScalarVariable>\n");
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
    hci_fmu_experiment(d, text);
    add_variables(d, text);
    add_structure(d, text);
}
