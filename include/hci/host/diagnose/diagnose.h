/* From recordings to the physical effect that the model lacks. */
#ifndef HCI_HOST_DIAGNOSE_DIAGNOSE_H
#define HCI_HOST_DIAGNOSE_DIAGNOSE_H

#include "hci/host/base/progress.h"
#include "hci/host/machine/effects.h"
#include "hci/host/machine/machine.h"
#include "hci/host/machine/uncertainty.h"
#include "hci/host/recording/run.h"
#include "hci/host/solve/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is wrong with files of the machine or of the recordings that no effect makes, such as swapped phases,
 * in words that outlive the diagnosis; NULL: nothing. */
typedef const char *hci_diagnose_slip(void *context);

/* How to look. All zeros will do. */
typedef struct {
    double resolution; /* what the model is not asked to be better than, as a share of the largest rms torque
                        * of a run; 0: 5e-4 */
    hci_progress *progress;  /* may be NULL */
    void *progress_context;  /* first argument of progress */
    hci_stop *stop;          /* asked during the search for effects and what follows; may be NULL */
    void *stop_context;      /* first argument of stop */
    double work;             /* of the search, > 0: times the usual limit; 0: once */
    hci_diagnose_slip *slip; /* asked where the declared machine leaves more than half of all torque: no
                              * effect is looked for then if there is one; may be NULL */
    void *slip_context;      /* first argument of slip */
} hci_diagnose_options;

/* Whether the recordings show an effect. */
typedef enum {
    HCI_FINDING_ADDED,     /* the recordings show it */
    HCI_FINDING_AMBIGUOUS, /* it, or another one that is listed, fits as well */
    HCI_FINDING_REJECTED   /* not needed */
} hci_finding_verdict;

/* The verdict as in effects.csv: added, ambiguous, rejected; a static string. */
const char *hci_finding_verdict_name(hci_finding_verdict verdict);

/* Bytes of a detail. */
enum { HCI_DETAIL_SIZE = 512 };

/* One effect. */
typedef struct {
    const char *effect;          /* as in effects.csv; `unknown` for what no effect explains */
    hci_finding_verdict verdict; /* what the recordings say of it */
    double delta_bic; /* fall of the Bayesian information criterion by having it: positive speaks for it; NAN:
                       * of `unknown`, which is in no model */
    size_t stays, left_out; /* with how many of the fitted runs that were left out in turn it is found all the
                             * same; of parts of them, where there are fewer than three */
    double residual_share;  /* of the mean square of the residual before, that it explains; NAN: none */
    char detail[HCI_DETAIL_SIZE]; /* its parameters with standard errors, or why not; in words */
} hci_finding;

/* One run before and after. */
typedef struct {
    const char *file;                   /* belongs to the runs */
    hci_role role;                      /* fitted, or held out */
    hci_torque_source source;           /* where its torque is from */
    double mean_torque_Nm;              /* of the recording */
    double torque_varies_Nm;            /* rms about it, ripple and loads that follow each other */
    double rms_before_Nm, rms_after_Nm; /* of measured less modelled torque: declared and corrected machine */
    double error_mean_before_Nm, error_mean_after_Nm; /* its mean, signed */
    double ripple_before_Nm, ripple_after_Nm;         /* rms of what is left beside the mean */
    double after_low_Nm, after_high_Nm;               /* 95 % confidence interval of rms_after_Nm */
    double noise_floor_Nm;                            /* rms that noise alone would leave */
    double unrepeated_Nm; /* of it, rms that differs from turn to turn and is no noise between the orders;
                           * NAN: too few turns */
    double
        slip_rad; /* the run's mechanical angle is ahead of that of the others by this; it was turned back */
} hci_run_errors;

/* The residual at one order. */
typedef struct {
    size_t run;                 /* index of the run among those with a torque */
    double order;               /* electrical */
    double before_Nm, after_Nm; /* peak amplitude */
    double noise_Nm;            /* amplitude that noise alone exceeds once in twenty times */
} hci_residual_line;

/* A torque that swings beside the turn of the rotor, of the load, a belt or the mains: no effect, and taken
 * out of the torque of each run that has it. */
typedef struct {
    bool of_turn;            /* frequency and error are per turn of the rotor, else in Hz */
    double frequency, error; /* error: standard error */
    double amplitude_Nm;     /* mean of the runs */
    size_t runs;             /* in so many */
} hci_free_swing;

/* An order that no effect explains, and how it grows over the runs:
 * T = (S sin nθ + C cos nθ) |i/A|^a |ω/(rad/s)|^b (sign ω)^c, a description and not physics. */
typedef struct {
    double order;                            /* n, electrical */
    double sine_Nm, cosine_Nm;               /* S, C */
    double current_exponent, speed_exponent; /* a, b */
    bool turns_sign;                         /* c */
    double amplitude_Nm;                     /* at the largest current and speed of the recordings */
} hci_unexplained;

/* Bytes of what a slip is, in words. */
enum { HCI_SLIP_SIZE = 128 };

/* The one recording that disagrees with all others, and was taken out. */
typedef struct {
    const char *file;              /* belongs to the runs; NULL: there is none */
    double rms_Nm, others_Nm;      /* of measured less modelled torque: of this run, and of the others */
    char slip[HCI_SLIP_SIZE];      /* what in that file would make most of it, in words; "": nothing simple */
    bool mended;                   /* and brings it down to its noise … */
    double mended_Nm;              /* … to this rms error */
    double angle_rad;              /* mechanical angle by which the run is ahead, where that is it */
    double mean_Nm, mean_error_Nm; /* constant by which its torque is more than that of the machine that
                                    * explains all others, where it is off by nothing else; and the standard
                                    * error of that, by their means. 0: that is not it */
    double mean_open_Nm; /* standard deviation of what the others leave open of its mean, such as friction */
    bool mean_is_untold; /* no other run has its speed */
    bool is_aside; /* all that is known: with it the recordings are not explained, and without it they are */
    double noise_Nm; /* there: of this run */
} hci_odd_run;

/* Bytes of a reason. */
enum { HCI_WHY_SIZE = 256 };

/* A steady run to record next, within what the machine is rated for or what was recorded. */
typedef struct {
    double id_A;              /* of the rotor frame */
    double iq_A;              /* NAN: the current answers to what holds or brakes the shaft */
    double speed_rad_per_s;   /* mechanical, signed */
    double turns;             /* how long at least */
    hci_torque_source source; /* of its torque: a sensor, or without one a shaft that is held or free */
    double chi_square;        /* how much it tells; 0: not known */
    char why[HCI_WHY_SIZE];   /* what it is for, in words */
} hci_next_point;

/* How such a run is recorded in a word: dyno (with a torque sensor), holding, free; a static string. */
const char *hci_next_test_name(hci_torque_source source);

/* Capacities: of effects, of orders that none explains, of runs to record next, of swings. */
enum { HCI_MOST_FINDINGS = 32, HCI_MOST_UNEXPLAINED = 8, HCI_MOST_NEXT_POINTS = 8, HCI_MOST_FREE_SWINGS = 4 };

/* How well the model as a whole describes the recordings. */
typedef enum {
    HCI_DIAGNOSIS_COMPLETE,  /* nothing is missing */
    HCI_DIAGNOSIS_EXPLAINED, /* the effects added explain the residual */
    HCI_DIAGNOSIS_AMBIGUOUS, /* several explain it equally well */
    HCI_DIAGNOSIS_PARTLY,    /* the effects added explain a part, and what is left is not known */
    HCI_DIAGNOSIS_UNKNOWN    /* none does */
} hci_diagnosis_verdict;

/* The verdict in a word: complete, explained, ambiguous, partly explained, unknown; a static
 * string. */
const char *hci_diagnosis_verdict_name(hci_diagnosis_verdict verdict);

/* How the search ended in a word: complete, interrupted, limited; a static string. */
const char *hci_diagnosis_search_name(hci_work_end end);

/* What new recordings say of an earlier diagnosis: hci/host/diagnose/again.h. */
typedef struct hci_again hci_again;

/* What was found. Start with {0}. */
typedef struct {
    hci_diagnosis_verdict verdict; /* in a word */
    hci_work_end search;           /* unless complete, of the best model that it had found */
    double further_work; /* times the usual limit, that a search which reached its own may take next; as in
                          * the options, of an empty diagnosis 0: four times that */
    hci_finding finding[HCI_MOST_FINDINGS]; /* most important first */
    size_t findings;                        /* entries of finding in use */
    hci_effects_data effects;               /* of the corrected machine: declared ones and added ones */
    hci_uncertainty
        uncertainty; /* of the corrected machine; empty where a part is unknown or the search ended early */
    hci_run_errors *run;                               /* of each run with a torque */
    size_t runs;                                       /* entries of run */
    hci_residual_line *line;                           /* orders that stand out of the noise, run by run */
    size_t lines;                                      /* entries of line */
    hci_unexplained unexplained[HCI_MOST_UNEXPLAINED]; /* orders that no effect explains */
    size_t unexplained_count;                          /* entries of unexplained in use */
    hci_free_swing swing[HCI_MOST_FREE_SWINGS];        /* beside the turn of the rotor */
    size_t swings;                                     /* entries of swing in use */
    size_t drifts;       /* runs whose torque drifts much slower than a turn: taken out of it */
    double drift_Nm;     /* the largest of them, from its least to its largest in the run */
    size_t zeros_read;   /* runs in which all that was read as current is the zeros of the sensors */
    double zeros_read_A; /* the largest of them */
    size_t only_noise;   /* further runs in which it is the noise of the sensors, and stands at nothing */
    double rms_before_Nm, rms_after_Nm, noise_Nm;                 /* of the runs that were fitted */
    double holdout_before_Nm, holdout_after_Nm, holdout_noise_Nm; /* NAN without such runs */
    double holdout_mean_before_Nm, holdout_mean_after_Nm;         /* rms of the mean errors of these runs */
    double holdout_ripple_before_Nm, holdout_ripple_after_Nm;     /* and of what is left beside the means */
    hci_odd_run odd;          /* all the rest is of the other recordings */
    const hci_again *again;   /* what the new recordings say of the last diagnosis; NULL: this is the first;
                               * not released with it */
    const char *disbelieved;  /* effect that describes the recordings best, with values that nobody would
                                 believe,  and was left out; NULL: none */
    double disbelieved_share; /* of the declared torque per ampere of i_q, that it would leave */
    hci_next_point next[HCI_MOST_NEXT_POINTS]; /* what to record next, most telling first */
    size_t next_points;                        /* entries of next in use; 0: nothing is left open */
    char advice[3 * HCI_DETAIL_SIZE];          /* the same in a few sentences, or "" */
    bool contradicted;    /* effects described the runs that were fitted, but not those held out, and were
                             dropped */
    bool means_open;      /* effects described the means of the runs that were fitted, but not of those left
                           * out, and were dropped */
    bool means_alone;     /* and nothing stands in the ripple beside what is left of these means */
    bool no_load_alone;   /* the effects are those that the runs without a current show by themselves, since
                           * what   acts under load is not known */
    bool no_load_against; /* under load the ripple is larger with those: something unknown there works against
                             them */
    const char *no_load_denied; /* why what the runs without a current show was left out, in words; NULL: it
                                 * was not */
    double resolution_Nm;       /* torque that the model was not asked to be better than */
    double drowned_Nm; /* torque of interest, rated or of the currents, that the noise is as large as: nothing
                        * is said to be complete; 0: it is not */
    bool wanders;      /* something is left that does not repeat with the turn */
    const char *slip;  /* what a wrong sign, direction, zero or number of pole pairs shows, and no effect was
                        * made of, in words; NULL: nothing such */
    bool not_searched; /* because of that slip no effect was looked for */
    bool magnetic_only;           /* direct current alone: beside iron nothing else was looked for */
    const char *standing_taken;   /* of the zero of the torque sensor, friction, a reluctance torque and the
                                   * torque   per ampere the one that is in where another explains the means as
                                   * well, in   words; NULL: they are told. Static */
    const char *standing_instead; /* that other one */
    double standing_share;        /* by which the torque per ampere is larger with the other one */
    bool sensors_as_well; /* current sensors that read each other's current look the same as an ambiguous one
                           */
    bool inertia_as_well; /* free shafts alone: a wrong inertia looks the same as an ambiguous effect */
    double open_voltage_off; /* share by which voltages without a current differ from the declared back-EMF;
                              * 0: none were recorded */
    bool against_voltages; /* the torques ask for another torque per ampere, which voltages that were recorded
                            * without a current exclude: effects were dropped */
    double beyond_voltages; /* share by which the corrected torque per ampere is above what voltages that were
                             * recorded without a current show; 0: none were recorded */
    size_t of_mean_currents;       /* free shafts at constant speed, whose mean currents are a friction by the
                                    * declared torque per ampere; 0: no friction is of them */
    double held_constant_Nm_per_A; /* torque per ampere as declared, that no run to be fitted tells and that
                                    * torques are found by; 0: one tells it */
    size_t unknown_loads;  /* slow turns to be fitted that work against a load which nobody knows: their means
                            * say  nothing */
    bool without_cogging;  /* the effects are those of the machine without the cogging torque of its folder,
                            * of which they have all */
    bool nothing_measured; /* no run to be fitted has an angle and a torque: nothing can be said */
} hci_diagnosis;

/* Whether a finding is in the machine beside others as a part of a whole that was chosen together, such as
 * the co-energy of the iron, and the recordings would not miss it alone: ΔBIC does not speak for it, and it
 * is found in fewer than two of three cases with a run left out. O(findings). */
bool hci_finding_is_part(const hci_diagnosis *diagnosis, const hci_finding *finding);

/* Of hci_diagnosis.open_voltage_off, that is no error of instruments: magnets, turns or harmonics differ. */
#define HCI_OPEN_VOLTAGE_OFF 0.02

/* Of hci_diagnosis.beyond_voltages, that is said: a gain of the torque or current sensors looks the same. */
#define HCI_BEYOND_VOLTAGES 0.01

/* Finds what is missing. HCI_OK; HCI_NOT_REACHED when the verdict is ambiguous, partly explained or unknown
 * (which it is where no run tells a torque, or nothing is found and voltages contradict the back-EMF), or the
 * search did not come to its end; or an error with a note, and then *diagnosis is empty. runs: kept as long
 * as the diagnosis. */
hci_status hci_diagnose(const hci_machine_data *machine, const hci_effects *declared, const hci_runs *runs,
                        const hci_diagnose_options *options, hci_diagnosis *diagnosis, hci_note *note);

/* Of further recordings, those of the last diagnosis among them. As hci_diagnose; where that does not explain
 * them, slow turns without a torque sensor are among them and the machine has a cogging torque, the search is
 * made once more without that, which such a turn may have shown with errors of its sensors in it, and taken
 * if it explains them: diagnosis->without_cogging. */
hci_status hci_diagnose_further(const hci_machine_data *machine, const hci_effects *declared,
                                const hci_runs *runs, const hci_diagnose_options *options,
                                hci_diagnosis *diagnosis, hci_note *note);

/* An effect as people call it, "reluctance torque" of `reluctance`, "what is not known" of `unknown`; a
 * static string, or `effect` itself where it names none. */
const char *hci_finding_title(const char *effect);

/* Its values as people call them, at most the four that make most torque: "mean, L_dd = 0.00097 ± 1e-05 H;
 * …", sine and cosine of an order as one amplitude; what an effect in its place is, or `detail`. size: of
 * text, 512 will do. */
void hci_finding_words(const hci_diagnosis *diagnosis, const hci_finding *finding, char *text, size_t size);

/* The verdict as a few plain sentences. size: of text, 2048 will do. */
void hci_diagnosis_words(const hci_diagnosis *diagnosis, char *text, size_t size);

/* Frees what a diagnosis holds and empties it. */
void hci_diagnosis_release(hci_diagnosis *diagnosis);

/* Currents for a target torque before and after the correction. */
typedef struct {
    hci_solution before, after;             /* for the declared machine and for the corrected one */
    hci_status before_status, after_status; /* what solving them answered: HCI_OK or HCI_NOT_REACHED */
    hci_torque_evaluation old_currents, new_currents; /* both on the corrected machine */
} hci_resolution;

/* Solves for the declared machine and for the corrected one, and tells what both currents do on the corrected
 * one. options: target and limits, effects are set here. HCI_OK or HCI_NOT_REACHED (of the corrected
 * machine), or an error with a note, and then *resolution is empty. */
hci_status hci_diagnosis_resolve(const hci_machine_data *machine, const hci_effects *declared,
                                 const hci_diagnosis *diagnosis, const hci_solve_options *options,
                                 hci_resolution *resolution, hci_note *note);

/* Frees what a resolution holds and empties it. */
void hci_resolution_release(hci_resolution *resolution);

#ifdef __cplusplus
}
#endif

#endif
