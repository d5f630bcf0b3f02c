/* Values that were interpolated: along straight lines between nodes at equal distances, of which fewer were
 * measured than rows are there. A wave of frequency f then has sin²(π f s)/(π f s)² of its amplitude, s the
 * distance of the nodes; the values of the nodes have all of it. */
#ifndef HCI_SRC_HOST_NUMERIC_STRAIGHT_LINES_H
#define HCI_SRC_HOST_NUMERIC_STRAIGHT_LINES_H

#include <stdbool.h>
#include <stddef.h>

/* Node k, of count, stands at row first + k·step. */
typedef struct {
    double first, step;
    size_t count;
} hci_line_nodes;

/* Looks for nodes 1.4 to 25 rows apart between which values of n rows are straight lines; the widest, where
 * several are. row: [n], ascends from row to row by 1 but for those that are left out. Values that are
 * smooth, or held over several rows, are none. False: none are found, or memory is out
 * (hci_memory_was_short). n from 200. Time: some ms, and some 200 n where there are some. */
bool hci_line_nodes_find(const double *row, const double *value, size_t n, hci_line_nodes *nodes);

/* The values of the nodes by least squares. at_node: out, [nodes->count]. Returns what the lines leave, as a
 * share of the noise from row to row: about 1 where the values are no such lines, 0 where they are exactly.
 * INFINITY: memory is out. O(n). */
double hci_line_nodes_fit(const double *row, const double *value, size_t n, const hci_line_nodes *nodes,
                          double *at_node);

/* Up to here they are lines: what a jitter of the nodes by a tenth of a row leaves. */
extern const double hci_line_nodes_most_left;

#endif
