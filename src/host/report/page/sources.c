/* Where the numbers of a page come from. */
#include <stdio.h>
#include <string.h>

#include "host/draw/html.h"
#include "host/report/page/page.h"

enum { SOURCES = 7 };

typedef struct {
    const char *what, *file;
} source;

static void list_sources(const hci_report_sources *s, source list[SOURCES])
{
    const source all[SOURCES] = {
        {"Machine", s->machine},   {"Wanted torque", s->target},      {"Harmonics to use", s->harmonics},
        {"Scenario", s->scenario}, {"Imposed currents", s->currents}, {"List of runs", s->runs},
        {"Drive", s->drive}};
    memcpy(list, all, sizeof all);
}

void hci_page_origin(char text[HCI_PAGE_ORIGIN_SIZE], const hci_report_sources *sources)
{
    source list[SOURCES];
    list_sources(sources, list);
    text[0] = '\0';
    for (size_t k = 0; k < SOURCES; ++k) {
        const size_t used = strlen(text);
        if (list[k].file && used + 5 < HCI_PAGE_ORIGIN_SIZE)
            snprintf(text + used, HCI_PAGE_ORIGIN_SIZE - used, "%s%s", used > 0 ? ", " : "", list[k].file);
    }
}

void hci_page_show_sources(hci_output *out, const hci_report_sources *sources)
{
    source list[SOURCES];
    list_sources(sources, list);
    hci_html_section(out, "Made from");
    for (size_t k = 0; k < SOURCES; ++k)
        if (list[k].file) hci_html_say(out, "quiet", "%s: %s", list[k].what, list[k].file);
    hci_html_section_end(out);
}
