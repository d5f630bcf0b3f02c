#define _POSIX_C_SOURCE 200809L

#include "cli/terminal/chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/terminal/bar.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/base/utf8.h"

enum { MOST_CELLS = 40, LEAST_CELLS = 8, LEAST_NAME = 12, LINE_SIZE = 1024 };

#define MOST_DECADES 4.0

void cli_number_text(double value, double largest, char *text, size_t size)
{
    const double digits = largest > 0.0 ? 4.0 - floor(log10(largest)) : 4.0;
    if (digits > 8.0 || digits < -4.0)
        snprintf(text, size, "%.4g", value);
    else
        snprintf(text, size, "%.*f", digits > 0.0 ? (int)digits : 0, value);
}

typedef struct {
    const cli_chart *chart;
    double low, high;                /* ends of the bars; of logarithms where the scale is one */
    size_t width[CLI_MOST_COLUMNS];  /* columns of the terminal */
    cli_cell cell[CLI_MOST_COLUMNS]; /* of one row */
} layout;

static const cli_cell *row_of(layout *l, size_t row)
{
    for (size_t c = 0; c < l->chart->columns; ++c)
        l->cell[c] = (cli_cell){"", NAN, NAN};
    l->chart->fill(l->chart->context, row, l->cell);
    return l->cell;
}

static void measure(layout *l)
{
    double least = HUGE_VAL, most = 0.0;
    for (size_t c = 0; c < l->chart->columns; ++c)
        l->width[c] = l->chart->column[c].kind == CLI_BAR ? 0 : cli_text_width(l->chart->column[c].head);
    for (size_t row = 0; row < l->chart->rows; ++row) {
        const cli_cell *cell = row_of(l, row);
        for (size_t c = 0; c < l->chart->columns; ++c) {
            const size_t width = cli_text_width(cell[c].text);
            if (width > l->width[c]) l->width[c] = width;
            if (cell[c].value > 0.0) least = fmin(least, cell[c].value);
            if (cell[c].value > 0.0) most = fmax(most, cell[c].value);
        }
    }
    l->low = 0.0;
    l->high = most;
    if (!l->chart->logarithmic || most <= 0.0) return;
    l->high = log10(most);
    l->low = floor(fmin(fmax(log10(least), l->high - MOST_DECADES), l->high - 1e-6));
}

/* Bars share what the texts leave; a long name in the first column gives way to them. */
static void share_width(layout *l)
{
    const int width = cli_width(STDOUT_FILENO);
    int used = 1, bars = 0, cells;
    for (size_t c = 0; c < l->chart->columns; ++c) {
        used += (int)l->width[c] + 1;
        bars += l->chart->column[c].kind == CLI_BAR;
    }
    const int missing = used + bars * LEAST_CELLS - width, spare = (int)l->width[0] - LEAST_NAME;
    if (l->chart->column[0].kind == CLI_LEFT && missing > 0 && spare > 0) {
        const int less = missing < spare ? missing : spare;
        l->width[0] -= (size_t)less;
        used -= less;
    }
    cells = bars > 0 ? (width - used) / bars : 0;
    for (size_t c = 0; c < l->chart->columns; ++c)
        if (l->chart->column[c].kind == CLI_BAR)
            l->width[c] = (size_t)(cells < 1 ? 1 : cells > MOST_CELLS ? MOST_CELLS : cells);
}

static double along(const layout *l, double value)
{
    const double at = l->chart->logarithmic ? (value > 0.0 ? log10(value) : -HUGE_VAL) : value;
    return l->high > l->low ? (at - l->low) / (l->high - l->low) : 0.0;
}

/* The end of a name says more than its beginning. */
static const char *shortened(const char *text, size_t width, const char **mark)
{
    size_t columns = cli_text_width(text);
    *mark = columns > width ? (cli_is_ascii(STDOUT_FILENO) ? "~" : "…") : "";
    for (columns += **mark != '\0'; columns > width; --columns)
        do
            ++text;
        while (!hci_utf8_begins(*text));
    return text;
}

static void add_text(char line[LINE_SIZE], cli_column_kind kind, size_t width, const char *text)
{
    const char *mark;
    const size_t used = strlen(line);
    text = shortened(text, width, &mark);
    const int blanks = (int)(width - cli_text_width(text) - cli_text_width(mark));
    snprintf(line + used, LINE_SIZE - used, " %*s%s%s%*s", kind == CLI_RIGHT ? blanks : 0, "", mark, text,
             kind == CLI_RIGHT ? 0 : blanks, "");
}

static void show_line(char line[LINE_SIZE])
{
    size_t length = strlen(line);
    while (length > 0 && line[length - 1] == ' ')
        --length;
    line[length] = '\0';
    cli_say("%s\n", line);
}

static void draw_row(layout *l, size_t row)
{
    char line[LINE_SIZE] = " ", bar[4 * MOST_CELLS + 1];
    const cli_cell *cell = row_of(l, row);
    for (size_t c = 0; c < l->chart->columns; ++c) {
        const cli_column_kind kind = l->chart->column[c].kind;
        if (kind == CLI_BAR)
            cli_bar_text(along(l, cell[c].value), along(l, cell[c].mark), (int)l->width[c],
                         cli_is_ascii(STDOUT_FILENO), bar);
        add_text(line, kind, l->width[c], kind == CLI_BAR ? bar : cell[c].text);
    }
    show_line(line);
}

static void draw_heads(const layout *l)
{
    char line[LINE_SIZE] = " ", caption[512];
    const char *unit = l->chart->unit;
    if (l->chart->logarithmic)
        snprintf(caption, sizeof caption, "%s; bars: logarithmic, %.3g to %.3g %s", l->chart->caption,
                 pow(10.0, l->low), pow(10.0, l->high), unit);
    else
        snprintf(caption, sizeof caption, "%s; bars: linear, 0 to %.3g %s", l->chart->caption, l->high, unit);
    cli_say("\n");
    cli_say_paragraph(2, caption);
    for (size_t c = 0; c < l->chart->columns; ++c)
        add_text(line, l->chart->column[c].kind, l->width[c], l->chart->column[c].head);
    show_line(line);
}

void cli_draw(const cli_chart *chart)
{
    layout l = {.chart = chart};
    measure(&l);
    if (chart->rows == 0) return;
    share_width(&l);
    draw_heads(&l);
    for (size_t row = 0; row < chart->rows; ++row)
        draw_row(&l, row);
}
