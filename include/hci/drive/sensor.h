/* A measured quantity: what lies between the truth and what a controller or a logger reads.
 *
 *     y = quantise((1 + gain_error)·x + offset + noise)     delayed by whole steps
 *
 * A sensor of zeros is ideal. */
#ifndef HCI_DRIVE_SENSOR_H
#define HCI_DRIVE_SENSOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The quantities of a drive that have a sensor each, and their number. */
enum {
    HCI_SENSE_IA,     /* current of phase a, A */
    HCI_SENSE_IB,     /* of phase b, A */
    HCI_SENSE_IC,     /* of phase c, A */
    HCI_SENSE_ANGLE,  /* mechanical angle, rad */
    HCI_SENSE_SPEED,  /* mechanical speed, rad/s */
    HCI_SENSE_TORQUE, /* torque, N·m; logged, and not used by the controller */
    HCI_SENSE_COUNT   /* how many */
};

/* What a sensor does to the quantity that it measures. */
typedef struct {
    double gain_error;  /* 0.01: reads 1 % too much */
    double offset;      /* of the reading, in the quantity's unit */
    double noise;       /* standard deviation of white Gaussian noise */
    double quantum;     /* read to the nearest multiple of it; 0: not quantised */
    size_t delay_steps; /* age of the reading in steps */
    /* Another effect of the sensor, on the true value and before all others; NULL: none. theta_m_rad: true
     * angle of the rotor, which is all that an eccentric encoder needs. */
    double (*modify)(const void *context, double value, double theta_m_rad);
    const void *context; /* first argument of modify */
} hci_sensor;

/* What a sensor keeps from step to step; made by hci_sensor_start. */
typedef struct {
    uint64_t random; /* state of the generator */
    double spare;    /* normal deviates come in pairs */
    bool has_spare;  /* whether spare is one */
    double *ring;    /* readings that are on their way; the caller's */
    size_t next;     /* place in the ring of the oldest */
} hci_sensor_state;

/* Doubles that a sensor's ring needs: its delay. */
size_t hci_sensor_workspace(const hci_sensor *sensor);

/* Starts a sensor. ring: hci_sensor_workspace doubles, kept; NULL when that is 0. seed: equal seeds give
 * equal noise on one libm; any two different ones, neighbours too, give unlike noise. first: what is read
 * until the delay has passed. */
void hci_sensor_start(const hci_sensor *sensor, hci_sensor_state *state, double *ring, uint64_t seed,
                      double first);

/* One step: the true value in, the reading out. O(1). */
double hci_sensor_read(const hci_sensor *sensor, hci_sensor_state *state, double value, double theta_m_rad);

#ifdef __cplusplus
}
#endif

#endif
