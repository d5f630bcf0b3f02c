/* How a speed varies: within an electrical turn as the shaft turns unevenly, or about 0 as noise makes it. */
#ifndef HCI_SRC_HOST_RECORDING_SPEED_VARIATION_H
#define HCI_SRC_HOST_RECORDING_SPEED_VARIATION_H

#include "hci/host/recording/run.h"

/* rms of the speed about its mean over half an electrical turn, as a share of that mean; where the shaft
 * keeps its direction and about its pace, so that neither a turn round nor a pause nor another speed counts.
 * The speed is the slope of the angle, since a recorded one may be noisier; where the clock is rough it
 * is the recorded one, or else the slope over stamps that are smoothed. *share: out, 0 where a run
 * without time or with too few such samples does not tell. False: no memory. O(samples). */
bool hci_speed_variation(const hci_run *run, int pole_pairs, double *share);

/* How often the shaft has come to rest on its way and gone on in the same direction: its speed over a
 * twentieth of an electrical turn has fallen below a fifth of its mean pace. Where it stands longer and slips
 * further than half an electrical turn, hci_speed_variation finds no pace to compare with. *path_turns: out,
 * electrical turns there and back. 0 without time or angle. O(samples). */
size_t hci_speed_stops(const hci_run *run, int pole_pairs, double *path_turns);

/* How often a speed changes its sign: below HCI_SPEED_SIGN_CHANGES it is not noise around 0. */
enum { HCI_SPEED_SIGN_CHANGES = 4 };
size_t hci_speed_sign_changes(const double *speed, size_t count);

/* Whether noise turns the sign of a recorded speed about while the angle goes one way, as that of a slow
 * turn. slope: [count], of the angle. The speed has the other sign in one row of a hundred or more, changes
 * it four times as often as the angle, and is that of the angle on the whole. O(samples). */
bool hci_speed_sign_is_noise(const hci_run *run, const double *slope);

/* Takes the slope of the angle in the few rows, less than one in a hundred, in which noise gives a recorded
 * speed the other sign, as where the shaft starts and stops: friction that does not turn its sign in such
 * rows passes for a zero of the torque sensor. Only where the speed changes its sign more often than the
 * slope and goes with it on the whole. Returns how many rows. O(samples). */
size_t hci_speed_sign_mend(hci_run *run, const double *slope);

/* The slope of the speed at each sample of a run with time and speed; where the speed is itself a slope of
 * the angle, over a window that the noise of the angle asks for. rate_rad_per_s2: out, [count], count >= 2.
 * O(n). */
void hci_run_acceleration(const hci_run *run, double *rate_rad_per_s2);

#endif
