/* How fast long work goes and when it will be done, from the shares of it that are done and the times at
 * which they are told. Arithmetic alone: no clock, no terminal, nothing else of cli.
 *
 * With s(t) told since the part of the work began at t0, the end is expected at
 *     t + (t − t0) (1 − s)/(s − s0),
 * smoothed so that the time that is left does not jump: with a time constant of 1.5 s, or 0.5 s where the
 * expected end comes nearer. */
#ifndef HCI_CLI_ESTIMATE_H
#define HCI_CLI_ESTIMATE_H

typedef struct {
    double from_s, from_share; /* when and where the part of the work began that is under way */
    double now_s, share;       /* what was told last */
    double end_s;              /* when the part will be done; NAN: not known yet */
} cli_estimate;

/* Begins a part at a time in s with a share from 0 to 1. */
void cli_estimate_begin(cli_estimate *estimate, double now_s, double share);

/* Takes in that a share is done now. One that falls is that of another part, which begins there. */
void cli_estimate_follow(cli_estimate *estimate, double now_s, double share);

/* Time until the end, 0 or more; NAN: not known yet, since less than 2 % or half a second is behind. */
double cli_estimate_left_s(const cli_estimate *estimate);

/* Mean share per second of the part; NAN or infinite where no time has passed. */
double cli_estimate_share_per_s(const cli_estimate *estimate);

#endif
