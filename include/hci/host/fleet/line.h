/* Motors of one make side by side: how each parameter is distributed, which motors stand out and by what,
 * trends over time and from batch to batch, and the machine that they have in common. */
#ifndef HCI_HOST_FLEET_LINE_H
#define HCI_HOST_FLEET_LINE_H

#include "hci/host/fleet/fit.h"
#include "hci/host/fleet/results.h"

#ifdef __cplusplus
extern "C" {
#endif

/* No parameter. */
#define HCI_LINE_NONE ((size_t)-1)

/* Of a parameter, over the motors. NAN: not known. */
typedef struct {
    hci_fleet_parameter name; /* effect, parameter, unit; the last one of a line is the rms of what stays */
    size_t motors;            /* that tell it */
    double median, scale;     /* robust: median, and 1.4826 times the median distance from it */
    double low, high;         /* beyond them a motor stands out */
    size_t outside;           /* motors there */
    double noise;             /* median standard error of one motor */
    double mean, mean_std_error, between;    /* in common, of the motors that do not stand out: μ and τ */
    double per_day, per_day_std_error;       /* trend over the date, of the same; NAN: less than three days */
    double batch_deviation, batch_criterion; /* of the means of batches, beyond chance; normal deviate of the
                                              * F test of no difference; NAN: less than two batches */
    const char *batch; /* whose mean is furthest from that of all; of the line; NULL: less than two batches */
    double batch_beside;         /* by so much */
    bool has_trend, has_batches; /* more than chance, at the same rate of false alarms */
} hci_line_parameter;

/* A motor of the line. */
typedef struct {
    const char *row;                /* of fleet.csv; owned by the line */
    char name[HCI_FLEET_NAME_SIZE]; /* as in the list */
    char batch[64];                 /* of the production, or "" */
    char date[32];                  /* as in the list */
    double day;                     /* of the date, a count; NAN: not read */
    hci_fleet_state state;          /* how it came out */
    size_t worst;     /* parameter with the largest deviation; HCI_LINE_NONE: it has no parameters */
    double deviation; /* that one, in robust standard deviations, signed */
    bool stands_out;  /* beyond the limit */
    bool leaves_more; /* what stays is beyond its limit too: that parameter describes the fault in part, or
                       * where it is what stays itself, none does */
} hci_line_motor;

/* All of it. Start with {0}. */
typedef struct {
    hci_fleet_command command;     /* that was run */
    double false_alarms;           /* share of sound motors that stand out, of a normal distribution */
    double limit;                  /* of a deviation */
    hci_line_motor *motor;         /* by name */
    size_t motors;                 /* entries of motor */
    hci_line_parameter *parameter; /* in the order of parameters.csv; the last one is the rms of what stays */
    size_t parameters;             /* entries of parameter; 0: no motor has any */
    size_t dates_unread;  /* dates that are not read: no form that is known, or day and month may be either */
    char date_unread[32]; /* the first of them */
    double *value, *std_error; /* [motors][parameters]; NAN: not told */
    char **text;               /* the files that rows point into */
    size_t texts;              /* entries of text */
} hci_line;

/* Reads fleet.csv and the parameters of the motors of each folder. A motor that is in two with the same row
 * counts once. *line: out, to be given to hci_line_release even after a failure. HCI_ERROR_INPUT, _MEMORY. */
hci_status hci_line_read(const char *const *folder, size_t folders, hci_line *line, hci_note *note);

/* Fills in all that is concluded. false_alarms: 0 … 1. HCI_ERROR_MEMORY. O(motors·parameters). */
hci_status hci_line_conclude(double false_alarms, hci_line *line, hci_note *note);

/* The deviation of a motor in a parameter, in robust standard deviations; NAN: not told. */
double hci_line_deviation(const hci_line *line, size_t motor, size_t parameter);

/* How many stand out. */
size_t hci_line_outside(const hci_line *line);

/* Frees what it holds and empties it. */
void hci_line_release(hci_line *line);

#ifdef __cplusplus
}
#endif

#endif
