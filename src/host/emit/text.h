/* The C text of an emitted table. Same input, same bytes: no dates, no paths, no locale. */
#ifndef HCI_SRC_HOST_EMIT_TEXT_H
#define HCI_SRC_HOST_EMIT_TEXT_H

#include "hci/host/base/output.h"
#include "host/emit/emission.h"

/* What goes into NAME.h and NAME.c of format f32 … */
void hci_emission_write_header(const hci_emission *e, hci_output *output);
void hci_emission_write_source(const hci_emission *e, hci_output *output);

/* … and of i16, q15 and i8. */
void hci_emission_write_spline_header(const hci_emission *e, hci_output *output);
void hci_emission_write_spline_source(const hci_emission *e, hci_output *output);

/* NAME.csv and NAME.json, of those formats. */
void hci_emission_write_csv(const hci_emission *e, hci_output *output);
void hci_emission_write_json(const hci_emission *e, hci_output *output);

/* What goes into NAME.bin of any format. */
void hci_emission_write_blob(const hci_emission *e, hci_output *output);

/* ---- what both say ---- */

/* Nine significant digits, which is enough for a float, with a decimal point in every locale and for every
 * value, so that C takes it for a floating constant. */
const char *hci_emission_number(double value, char text[32]);

/* The number with the suffix f, and `end` behind it. */
void hci_emission_float(hci_output *output, float value, const char *end);

/* The first lines of NAME.extension, in a comment that hci_emission_input ends. */
void hci_emission_title(const hci_emission *e, hci_output *output, const char *extension);

/* What the values are, and in which unit. */
void hci_emission_frame(const hci_emission *e, hci_output *output);

/* Which angle, and where its zero is. */
void hci_emission_angle(const hci_emission *e, hci_output *output);

/* Machine and magnets. */
void hci_emission_facts_of_machine(const hci_emit_facts *facts, hci_output *output);

/* The same, torque, and what a current loop has to follow. */
void hci_emission_facts(const hci_emission *e, hci_output *output);

/* What ripple the table leaves in the model, where its machine is given. */
void hci_emission_ripple(const hci_emission *e, hci_output *output);

/* NAME_POLE_PAIRS and NAME_PERIODS, of a table over so many electrical turns, where they are known. */
/* Zeros, gains and angles that a firmware corrects by; nothing where there are none. */
void hci_emission_correction_macros(const char *name, const hci_corrections *corrections, hci_output *output);

void hci_emission_macros(const char *name, size_t pole_pairs, size_t turns, hci_output *output);

/* Where the numbers come from. Ends the comment. */
void hci_emission_input(const hci_emission *e, hci_output *output);

/* The waves of all parts. */
void hci_emission_waves(const hci_emission *e, hci_output *output);

/* `#ifndef` … of NAME.h and the include of `header`, which must have the version; and the end of NAME.h. */
void hci_emission_guard(const hci_emission *e, hci_output *output, const char *header, const char *macro,
                        int version);
void hci_emission_guard_end(hci_output *output);

#endif
