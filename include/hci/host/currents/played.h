/* Whether the currents in a recording are those that were solved, and whether its torque is as smooth as was
 * promised of them. */
#ifndef HCI_HOST_CURRENTS_PLAYED_H
#define HCI_HOST_CURRENTS_PLAYED_H

#include "hci/host/currents/currents.h"
#include "hci/host/currents/table_beside.h"
#include "hci/host/currents/table_rotation.h"
#include "hci/host/recording/run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes of a path. */
enum { HCI_SOLVED_PATH_SIZE = 1024 };

/* Currents that were solved for the machine of a diagnosis. Start with {0}. */
typedef struct {
    char folder[HCI_SOLVED_PATH_SIZE];  /* of the solution; "": none is known */
    char machine[HCI_SOLVED_PATH_SIZE]; /* folder of the machine */
    char why[HCI_SOLVED_PATH_SIZE];     /* in words, why none is known; or "" */
    hci_currents table;                 /* they */
    double promised_Nm; /* ripple that was promised, peak to peak in N·m, 95 %, with what `tune` adds for the
                         * table; NAN: none was */
} hci_solved_currents;

/* Those in LAST/solution (diagnose --target), or else in the folder currents beside LAST, if they were solved
 * for LAST/machine. That there are none is no error, and told in why. last: the --out of a diagnosis.
 * HCI_ERROR_MEMORY. */
hci_status hci_solved_currents_find(const char *last, hci_solved_currents *solved, hci_note *note);

/* Frees what it holds and empties it. */
void hci_solved_currents_release(hci_solved_currents *solved);

/* What flows in a recording, against what was solved. */
typedef enum {
    HCI_PLAYED_UNKNOWN,   /* no currents were solved, or the run has no angle or no current */
    HCI_PLAYED_AS_SOLVED, /* they, at their angle */
    HCI_PLAYED_TURNED,    /* they, at another angle or backwards */
    HCI_PLAYED_RESIZED,   /* they, of another size */
    HCI_PLAYED_OTHERS,    /* others, such as a plain sine */
    HCI_PLAYED_BESIDE     /* what they have beside their sine, and another sine, as of a load */
} hci_played_currents;

/* What became of the promised ripple. */
typedef enum {
    HCI_PROMISE_NOT_JUDGED, /* the currents are not those that were solved, or nothing was promised or
                             * measured */
    HCI_PROMISE_KEPT,       /* the measured ripple and twice its error are within the bound */
    HCI_PROMISE_NOT_KEPT,   /* less twice its error it is beyond */
    HCI_PROMISE_NOT_TOLD,   /* neither: the noise is too large */
    HCI_PROMISE_UNCORRECTED /* beyond the bound, but of sensors that were not corrected as the table needs */
} hci_promise;

/* A word: not_known, as_solved, turned, another_size, others, beside; a static string. */
const char *hci_played_currents_name(hci_played_currents currents);

/* A word: not_judged, kept, not_kept, not_told, uncorrected; a static string. */
const char *hci_promise_name(hci_promise promise);

/* One recording. */
typedef struct {
    hci_played_currents currents; /* what flows */
    hci_table_rotation rotation;  /* as of `check --table`; all 0 where not known */
    hci_table_beside beside;      /* and what that does not tell; likewise */
    bool is_of_control;     /* the shaft was turned slowly by control, which makes the currents itself */
    double ripple_Nm;       /* measured, peak to peak, of the orders that stand out of the noise; NAN: not
                             * told */
    double ripple_error_Nm; /* standard error of the difference of two angles, of all orders looked at */
    double ripple_order;    /* electrical order up to which that was looked at */
    hci_promise promise;    /* what became of it */
} hci_played;

/* Judges one run. pole_pairs, effects: of the machine that was solved for; effects may be NULL.
 * HCI_ERROR_MEMORY. */
hci_status hci_played_judge(const hci_solved_currents *solved, const hci_run *run, int pole_pairs,
                            const hci_effects *effects, hci_played *played, hci_note *note);

/* Whether it speaks against the promise: not kept, or the table is played at another angle, or by sensors
 * that were not corrected, and not as smooth. */
bool hci_played_is_bad(const hci_played *played);

/* In a few sentences, each with a blank before it. file: the path of the run, for the command that tells
 * more. size: of text, 1024 will do with short paths; it is cut. */
void hci_played_words(const hci_solved_currents *solved, const hci_played *played, const char *file,
                      char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
