/* The top of a smooth function near a sample of it. */
#ifndef HCI_SRC_HOST_NUMERIC_PEAK_H
#define HCI_SRC_HOST_NUMERIC_PEAK_H

typedef struct {
    double (*at)(const void *context, double x);
    const void *context;
} hci_peak_function;

/* Moves *x to the local maximum near it, by parabolas through three points that draw together once the top is
 * between them. width: distance of the samples. Returns the value there. Some 30 evaluations. */
double hci_peak_refine(const hci_peak_function *function, double width, double *x);

#endif
