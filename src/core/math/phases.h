/* Three phases a third of a turn apart. */
#ifndef HCI_SRC_CORE_MATH_PHASES_H
#define HCI_SRC_CORE_MATH_PHASES_H

/* Cosine and sine of a third of a turn. */
#define HCI_COS_THIRD (-0.5)
#define HCI_SIN_THIRD 0.86602540378443864676

/* Adds a wave to abc[3]: phase s lags by σ2πs/3, so that it is x cos(σ2πs/3) − y sin(σ2πs/3) of the wave x in
 * phase a and the one y a quarter of a period ahead of it. sequence: σ. */
static inline void hci_phases_add(double x, double y, int sequence, double abc[3])
{
    const double cosine = sequence == 0 ? 1.0 : HCI_COS_THIRD, sine = sequence * HCI_SIN_THIRD;
    abc[0] += x;
    abc[1] += cosine * x - sine * y;
    abc[2] += cosine * x + sine * y;
}

#endif
