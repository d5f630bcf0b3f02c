/* A diagnosis that goes on from an earlier one with further recordings: was what it promised kept, and what
 * do the new recordings contradict. */
#ifndef HCI_HOST_DIAGNOSE_AGAIN_H
#define HCI_HOST_DIAGNOSE_AGAIN_H

#include "hci/host/currents/played.h"
#include "hci/host/diagnose/diagnose.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A new recording: rms of measured less modelled torque. */
typedef struct {
    const char *file;      /* belongs to the runs */
    hci_role role;         /* fitted, or held out */
    double declared_Nm;    /* by the machine as it is declared */
    double last_Nm;        /* by the machine of last time, which has never seen it */
    double last_mean_Nm;   /* its mean, signed … */
    double last_ripple_Nm; /* … and rms of what is beside the mean */
    double now_Nm;         /* by the machine that is fitted to all of them; a test if held out */
    double noise_Nm;       /* that noise alone would leave */
    double bound_Nm;   /* what was promised: what the recordings of last time left open, 95 %, and noise, as
                        * large as it is by chance in so many samples; NAN: nothing was */
    bool kept;         /* last_Nm is within the bound: the machine's error, not the ripple of its currents */
    const char *path;  /* of the file, from where the program runs; belongs to the runs */
    hci_played played; /* its currents, against those that were solved for the machine of last time */
} hci_again_run;

/* What became of an effect. */
typedef enum {
    HCI_AGAIN_STAYS,   /* its values are within their errors */
    HCI_AGAIN_CHANGED, /* a value has changed by more than its error */
    HCI_AGAIN_LEFT,    /* it is not in the machine any more */
    HCI_AGAIN_CAME     /* it was not before */
} hci_again_change;

/* In a word: stays, changed, left, came; a static string. */
const char *hci_again_change_name(hci_again_change change);

/* What the new recordings alone say of an effect that is not in the machine any more. */
typedef enum {
    HCI_AGAIN_SILENT, /* the machine of last time describes them as well without it, or it was not asked */
    HCI_AGAIN_FOR,    /* it describes them better with it */
    HCI_AGAIN_AGAINST /* it describes them better without it: they contradict it */
} hci_again_speaks;

/* In a word: silent, for, against; a static string. */
const char *hci_again_speaks_name(hci_again_speaks speaks);

/* An effect of the last diagnosis or of this one. */
typedef struct {
    const char *effect;               /* its name */
    hci_again_change change;          /* in a word */
    hci_again_speaks speaks;          /* of one that left: in a word */
    bool was_ambiguous, is_ambiguous; /* with another one: last time, now */
    double deviations;               /* largest change of a value, in standard errors; NAN: none is in both */
    char words[HCI_DETAIL_SIZE / 2]; /* that value, then and now; or "" */
} hci_again_effect;

/* All of it. Start with {0}. */
struct hci_again {
    hci_again_run *run;                                      /* the new ones that have a torque */
    size_t runs;                                             /* entries of run */
    size_t bounded, kept;                                    /* of them with a bound, and within it */
    double declared_Nm, last_Nm, now_Nm, noise_Nm, bound_Nm; /* root mean squares over the new ones */
    hci_again_effect effect[HCI_MOST_FINDINGS];              /* in either machine, or ambiguous in one */
    size_t effects;                                          /* entries of effect */
    size_t recordings_before;                                /* of the last diagnosis */
    bool without_cogging; /* the declared cogging torque of last time is left to all recordings together */
    hci_solved_currents solved; /* for the machine of last time, and what was promised of them */
};

/* What new recordings say of the last diagnosis. */
typedef struct {
    const hci_machine_data *machine; /* both as the last diagnosis started from them */
    const hci_effects *declared;     /* effects of that machine */
    const hci_runs *runs;            /* all, as hci_diagnose has left them: those of last time first */
    size_t recordings_before;        /* how many of them are those */
    const char *folder;              /* of the last diagnosis: machine/ and effects.csv are read there */
} hci_again_question;

/* Compares a diagnosis of all recordings with the last one. Sets diagnosis->again to *again, which has to
 * stay as long. HCI_ERROR_INPUT where the folder has not what it needs, HCI_ERROR_MEMORY; *again is empty
 * then. */
hci_status hci_again_find(const hci_again_question *question, hci_diagnosis *diagnosis, hci_again *again,
                          hci_note *note);

/* Whether a new recording breaks what was promised of the currents, or plays them at another angle. */
bool hci_again_is_bad(const hci_again *again);

/* Bytes of the sentences. */
enum { HCI_AGAIN_WORDS = 8192 };

/* In a few plain sentences. size: of text, HCI_AGAIN_WORDS will do. */
void hci_again_words(const hci_again *again, char *text, size_t size);

/* Frees what it holds and empties it. */
void hci_again_release(hci_again *again);

#ifdef __cplusplus
}
#endif

#endif
