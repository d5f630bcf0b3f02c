/* Broken conventions in a machine's tables and recordings: which interpretation of the numbers makes them
 * agree. Files and reports call an interpretation a reading, and a broken convention a slip. */
#ifndef HCI_HOST_CHECK_CHECK_H
#define HCI_HOST_CHECK_CHECK_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"
#include "hci/host/recording/run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Capacities. */
enum {
    HCI_CHECK_MOST_RUNS = 64,        /* recordings */
    HCI_CHECK_MOST_FINDINGS = 12,    /* slips */
    HCI_CHECK_MOST_EVIDENCE = 40,    /* relations */
    HCI_CHECK_MOST_ALTERNATIVES = 8, /* slips that mend the same */
    HCI_CHECK_MOST_UNTOLD = 64,      /* slips that leave no trace */
    HCI_CHECK_TEXT = 128,            /* bytes of a text */
    HCI_CHECK_WORDS = 320,           /* bytes of the words of a slip */
    HCI_CHECK_PATH = 512             /* bytes of a path */
};

/* A slip is beyond doubt from this probability on. */
#define HCI_CHECK_SURE 0.99

/* A slip is found from this probability on. */
#define HCI_CHECK_FOUND 0.8

/* And possible from this one on. */
#define HCI_CHECK_POSSIBLE 0.2

/* What can be said of a machine and its recordings as a whole. */
typedef enum {
    HCI_CHECK_CONSISTENT,    /* everything that could be checked agrees as declared */
    HCI_CHECK_SLIPS,         /* at least one slip is found */
    HCI_CHECK_AMBIGUOUS,     /* something is read wrongly, and several readings mend it */
    HCI_CHECK_NOT_UNDERSTOOD /* something disagrees that no known slip explains */
} hci_check_verdict;

/* One slip that is found or possible. */
typedef struct {
    const char *slip;               /* name as in docs/check.md; a static string */
    char file[HCI_CHECK_PATH];      /* where it stands */
    size_t line;                    /* from 1 */
    char column[HCI_CHECK_TEXT];    /* as the header spells it */
    char found[HCI_CHECK_TEXT];     /* what stands there */
    char should_be[HCI_CHECK_TEXT]; /* what it should be */
    bool names_unit;                /* it is a column that says its unit, by header, row of units or user */
    double probability;             /* of all readings with this slip */
    bool is_no_effect;           /* no effect of a machine or a bench makes numbers like these: poles for pole
                                  * pairs, swapped phases, a sign, a unit of the angle */
    char words[HCI_CHECK_WORDS]; /* what it means */
    const char *told_by;         /* what would tell it from its alternatives; static */
    const char *alternative[HCI_CHECK_MOST_ALTERNATIVES];       /* slips that mend the same things */
    const char *alternative_words[HCI_CHECK_MOST_ALTERNATIVES]; /* what they mean; static */
    size_t alternatives;                                        /* entries of alternative in use */
} hci_check_finding;

/* How a relation stands. */
typedef enum {
    HCI_CHECK_AGREES,   /* as declared */
    HCI_CHECK_MENDED,   /* by the best reading */
    HCI_CHECK_BETTER,   /* is nearer in the best reading, but not met */
    HCI_CHECK_MENDABLE, /* not by the best reading, but by one with a possible slip */
    HCI_CHECK_UNMENDED, /* by no reading */
    HCI_CHECK_WORSE,    /* agreed as declared, and does not in the best reading */
    HCI_CHECK_UNJUDGED  /* is within its tolerance, but that is so wide that a slip would be, too */
} hci_check_state;

/* One relation that must hold between numbers of the files. */
typedef struct {
    const char *name, *words; /* static */
    double declared;          /* as the files are declared */
    double expected;          /* by the other numbers */
    bool at_most;             /* expected is an upper bound */
    double as_read;           /* in the best reading */
    double tolerance;         /* one standard deviation, relative for a ratio */
    hci_check_state state;    /* how it stands */
} hci_check_evidence;

/* A relation that could not be checked. */
typedef struct {
    const char *name, *words; /* of the relation; static */
    const char *needs;        /* the value or recording that would allow it; static */
} hci_check_gap;

/* What a check has found. */
typedef struct {
    hci_check_verdict verdict;                          /* in a word */
    hci_check_finding finding[HCI_CHECK_MOST_FINDINGS]; /* most probable first */
    size_t findings;                                    /* entries of finding in use */
    double probability_as_declared;                     /* that nothing is read wrongly */
    double zero_rad, zero_error_rad; /* electrical, to be added to the angle of the recordings so that its
                                      * zero is that of the tables; NAN: they do not tell it */
    double given_zero_rad;           /* what the user has added to it already, electrical; 0: nothing */
    double zero_reach_rad; /* zero_error_rad with what a saliency beside it leaves open, as it is said */
    bool zero_is_told; /* and no saliency, known or not, explains the torques as well at the zero as it is */
    double drive_zero_rad,
        drive_zero_reach_rad;              /* where they do not, and all currents lie in one direction: the
                                            * zero_rad with which they lie along q, as of a drive that keeps its
                                            * i_d at 0, and within how much the torques confirm it; else NAN */
    double saliency_H, saliency_at_load_H; /* L_q - L_d of a reluctance torque that machine.csv does not
                                            * declare and the torques, as declared, ask for: at small currents
                                            * and at the largest i_q; NAN: none */
    double
        scale_left_open; /* beside it, standard deviation of the torque per ampere, of 1: as far another scale
                          * of back-EMF, currents or torque makes these torques as well; NAN: no saliency */
    hci_check_evidence evidence[HCI_CHECK_MOST_EVIDENCE]; /* relations that could be checked */
    size_t evidences;                                     /* entries of evidence in use */
    hci_check_gap gap[HCI_CHECK_MOST_EVIDENCE];           /* relations that could not */
    size_t gaps;                                          /* entries of gap in use */
    const char *untold[HCI_CHECK_MOST_UNTOLD];            /* slips that would change nothing here; static */
    size_t untolds;                                       /* entries of untold in use */
    hci_note machine_remark;                              /* what to know of the machine's folder, or "" */
    hci_note remark[HCI_CHECK_MOST_RUNS];                 /* how each recording was read, or "" */
    const char *machine;                                  /* the caller's */
    const char *const *run;                               /* the caller's */
    size_t runs;                                          /* entries of run */
} hci_check;

/* Reads the folder `machine` and `runs` recordings (at most HCI_CHECK_MOST_RUNS, which must have the same
 * conventions), tries every reading of them with up to three slips, and finds the one that makes the numbers
 * agree (docs/check.md). Nothing is written. reading: of the recordings, and order_base of the tables; pole
 * pairs and inertia are not used. machine and run must outlive *check. HCI_OK; HCI_NOT_REACHED for every
 * verdict but consistent; HCI_ERROR_INPUT, _MEMORY, _ARGUMENT; *check is then undefined. O(samples). */
hci_status hci_check_files(const char *machine, const char *const *run, size_t runs,
                           const hci_run_options *reading, hci_check *check, hci_note *note);

/* What is found beyond doubt and no effect makes; NULL: nothing. */
const hci_check_finding *hci_check_sure_slip(const hci_check *check);

/* A check that is made once something wants to know it. Zeros but for the first four. */
typedef struct {
    const char *machine;     /* as of hci_check_files, which see */
    const char *const *run;  /* of more than HCI_CHECK_MOST_RUNS the first ones */
    size_t runs;             /* entries of run; 0: nothing can be checked */
    hci_run_options reading; /* how they are read; `holding` is not used */
    hci_check check;         /* what was found, once is_made and has_check */
    bool is_made;            /* it was asked for */
    bool has_check;          /* the files could be read */
} hci_check_inquiry;

/* What is found; NULL: the files cannot be checked. Made the first time it is asked for. */
const hci_check *hci_check_ask(hci_check_inquiry *inquiry);

/* The words of hci_check_sure_slip for hci_diagnose_options.slip, as long as the hci_check_inquiry that
 * inquiry points at; NULL: nothing. */
const char *hci_check_slip(void *inquiry);

/* Of saliency_H: what it is, what it is not told from, and what would tell them apart. "" where there is
 * none. text: size bytes, 512 do. Returns text. */
const char *hci_check_saliency_words(const hci_check *check, char *text, size_t size);

/* What a slip is about, in words: "the kind and unit of the back-EMF". Static; "" for another name. */
const char *hci_check_slip_topic(const char *slip);

/* "consistent", "slips", "ambiguous", "not_understood"; a static string. */
const char *hci_check_verdict_name(hci_check_verdict verdict);

/* "consistent", "mended", "better", "mendable", "not_understood", "worse", "unjudged"; a static string. */
const char *hci_check_state_name(hci_check_state state);

#ifdef __cplusplus
}
#endif

#endif
