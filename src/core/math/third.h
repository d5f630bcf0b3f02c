/* Cosine and sine of a third of a turn, the shift from phase to phase. */
#ifndef HCI_SRC_CORE_MATH_THIRD_H
#define HCI_SRC_CORE_MATH_THIRD_H

static const double COS_THIRD = -0.5;
static const double SIN_THIRD = 0.86602540378443864676;

#endif
