/* Vectors of the plane: three phases as α + jβ, or d + jq. */
#ifndef HCI_SRC_HOST_CHECK_PLANE_VECTOR_H
#define HCI_SRC_HOST_CHECK_PLANE_VECTOR_H

typedef struct {
    double re, im;
} check_vector;

check_vector hci_check_product(check_vector a, check_vector b);
check_vector hci_check_conjugate(check_vector a);
check_vector hci_check_scaled(check_vector a, double factor);
check_vector hci_check_turned(check_vector a, double angle_rad);
check_vector hci_check_sum(check_vector a, check_vector b);
double hci_check_length(check_vector a);

#endif
