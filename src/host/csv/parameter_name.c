#include "host/csv/parameter_name.h"

#include <stdio.h>
#include <string.h>

#include "host/csv/column_name.h"

#define SAID(column, unit, meaning)                                                                          \
    {                                                                                                        \
        "", column, unit, "SINAMICS", meaning, NULL                                                          \
    }
enum { ANY = -1, NAME_SIZE = 16 };

/* What is wanted, r0060, r0062, r0075, r0077 and r0079, is not among them. */
static const struct {
    int number, index;
    hci_alias said;
} PARAMETERS[] = {
    {61, ANY, SAID("speed_rad_per_s", "rpm", "the mechanical speed")},
    {63, ANY, SAID("speed_rad_per_s", "rpm", "the mechanical speed")},
    {69, 0, SAID("ia_A", "A", "the current of phase a")},
    {69, 1, SAID("ib_A", "A", "the current of phase b")},
    {69, 2, SAID("ic_A", "A", "the current of phase c")},
    {76, ANY, SAID("id_A", "Arms", "i_d")},
    {78, ANY, SAID("iq_A", "Arms", "i_q")},
    {80, ANY,
     SAID("torque_computed_Nm", "N*m",
          "a torque that the drive has computed from its current, not measured")},
    {89, 0, SAID("va_V", "V", "the voltage of phase a")},
    {89, 1, SAID("vb_V", "V", "the voltage of phase b")},
    {89, 2, SAID("vc_V", "V", "the voltage of phase c")},
    {93, ANY, SAID("theta_e_rad", "deg", "the electrical angle")},
};

bool hci_parameter_known(size_t k, char name[NAME_SIZE], const hci_alias **said)
{
    if (k >= sizeof PARAMETERS / sizeof *PARAMETERS) return false;
    *said = &PARAMETERS[k].said;
    if (PARAMETERS[k].index == ANY)
        snprintf(name, NAME_SIZE, "r%04d", PARAMETERS[k].number);
    else
        snprintf(name, NAME_SIZE, "r%04d[%d]", PARAMETERS[k].number, PARAMETERS[k].index);
    return true;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Up to five digits; moves on. */
static bool read_number(const char **at, int *number)
{
    size_t digits = 0;
    for (*number = 0; is_digit(**at) && digits < 6; ++*at, ++digits)
        *number = 10 * *number + (**at - '0');
    return digits > 0 && digits < 6;
}

/* "r0078[1]" and what follows it, behind the device and a dot. */
static const char *read_parameter(const char *header, int *number, int *index)
{
    const char *dot = strstr(header, ".r"), *at = dot != NULL ? dot + 1 : header;
    *index = 0;
    if (*at++ != 'r' || !read_number(&at, number)) return NULL;
    if (*at == '[') {
        ++at;
        if (!read_number(&at, index) || *at++ != ']') return NULL;
    }
    return strchr(" :,_([/", *at) != NULL ? at : NULL; /* the end of the text, too */
}

const hci_alias *hci_parameter_name(const char *header, const hci_unit **unit)
{
    int number, index;
    const char *rest = read_parameter(header, &number, &index);
    *unit = NULL;
    for (size_t k = 0; rest != NULL && k < sizeof PARAMETERS / sizeof *PARAMETERS; ++k) {
        if (PARAMETERS[k].number != number || (PARAMETERS[k].index != ANY && PARAMETERS[k].index != index))
            continue;
        for (; *rest != '\0' && *unit == NULL; ++rest)
            *unit = hci_column_unit_of_tail(rest);
        return &PARAMETERS[k].said;
    }
    return NULL;
}
