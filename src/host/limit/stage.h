/* One stage of solving within limits, as a convex program (theory.md, section 15). */
#ifndef HCI_SRC_HOST_LIMIT_STAGE_H
#define HCI_SRC_HOST_LIMIT_STAGE_H

#include "host/conic/problem.h"
#include "host/limit/build.h"

/* What ends the solution of a stage, from its program and its answer or, without one (NULL), from where it
 * ended last; HCI_ERROR_MEMORY, without a note. */
typedef hci_status hci_limit_finish(const hci_limit_build *build, const hci_cone_answer *answer,
                                    hci_limit_rest *last, hci_limit_optimum *optimum);

/* finish: or NULL; then `last` is not used. *optimum: out; x to be freed with hci_memory_free, also where it
 * is infeasible. HCI_ERROR_MEMORY, _NUMERIC. */
hci_status hci_limit_stage_solve(const hci_limit_program *program, hci_limit_stage stage,
                                 hci_limit_finish *finish, hci_limit_rest *last, hci_limit_optimum *optimum,
                                 hci_note *note);

/* The rows, cones, equations and the objective of a stage into a build that has begun. */
void hci_limit_stage_fill(hci_limit_build *build);

/* Adds what a limit's row with the multiplier z gains. tag: hci_limit_tag. */
void hci_limit_stage_add_gain(const hci_limit_build *build, size_t tag, double z, hci_limit_optimum *optimum);

/* What an answer to a build says, into an optimum whose x has room and whose gains are 0. */
void hci_limit_stage_read(const hci_limit_build *build, const hci_cone_answer *answer,
                          hci_limit_optimum *optimum);

#endif
