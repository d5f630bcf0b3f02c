/* Tables with bars, on standard output. Uses terminal, text, say and bar. */
#ifndef HCI_CLI_CHART_H
#define HCI_CLI_CHART_H

#include <stdbool.h>
#include <stddef.h>

enum { CLI_MOST_COLUMNS = 8 };

typedef enum { CLI_LEFT, CLI_RIGHT, CLI_BAR } cli_column_kind;

typedef struct {
    cli_column_kind kind;
    const char *head;
} cli_column;

/* A bar is as long as its value from 0 on (NAN: no bar); mark: a line across it, such as noise (NAN: none).
 */
typedef struct {
    char text[48];
    double value, mark;
} cli_cell;

typedef struct {
    const char *caption; /* what is drawn, its unit, and what it is compared with */
    const cli_column *column;
    size_t columns, rows;
    void (*fill)(const void *context, size_t row, cli_cell cell[]);
    const void *context;
    bool logarithmic;
    const char *unit;
} cli_chart;

/* Draws it as wide as the terminal is; nothing where there are no rows. */
void cli_draw(const cli_chart *chart);

/* With as many decimals as give five digits to the largest value of the column. */
void cli_number_text(double value, double largest, char *text, size_t size);

#endif
