/* A user of the host library: the current that makes 1 N·m, through the sparse solver, and a file that is not
 * there. */
#include <hci/host/csv/csv.h>
#include <hci/host/solve/solve.h>
#include <math.h>
#include <stdio.h>

static int missing_file_is_told(void)
{
    hci_csv *csv = NULL;
    hci_note note = {0};
    const hci_status status = hci_csv_read("not/there.csv", &csv, &note);
    printf("%s\n", note.text);
    return status == HCI_ERROR_INPUT && csv == NULL && note.text[0] != '\0';
}

static int torque_is_solved(void)
{
    hci_wave back_emf[] = {hci_wave_polar(1.0, +1, 0.5, 0.0)};
    hci_component component[] = {{1.0, +1}};
    hci_set name[] = {HCI_SET_POS};
    hci_target_order order[] = {{{0.0, 0.0, 1.0}, 1.0}};
    const hci_component_set set = {.component = component, .set = name, .count = 1};
    const hci_target target = {order, 1};
    const hci_solve_options options = {.target = &target, .set = &set};
    const hci_machine_data machine = {.pole_pairs = 4.0,
                                      .model = {.pole_pairs = 4, .back_emf = back_emf, .back_emf_count = 1}};
    hci_solution solution;
    hci_note note = {0};
    const hci_status status = hci_solve(&machine, &options, &solution, &note);
    if (status) return printf("%s: %s\n", hci_status_text(status), note.text), 0;
    const hci_wave *current = solution.current.wave;
    const double amplitude_A = hci_amplitude(current->sine, current->cosine);
    printf("%s: %.6f A by %s\n", hci_status_text(status), amplitude_A, hci_method_name(solution.method));
    hci_solution_release(&solution);
    return fabs(amplitude_A - 4.0 / 3.0) < 1e-9; /* 1 N·m / (3/2 · 0.5 N·m/A) */
}

int main(void)
{
    return missing_file_is_told() && torque_is_solved() ? 0 : 1;
}
