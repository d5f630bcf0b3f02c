/* Valid machines with extreme values (subnormal numbers, 1e308, order 2000, a thousand harmonics, 200 pole
 * pairs), made of the bytes of the input. The machine is refused with words, or the laws hold for what
 * `solve` finds:
 *
 *   spectrum    the torque that is promised at each order is that of the sampled torque, and there is none at
 *               other orders
 *   verdict     an order that is said to be reached is
 *   linearity   currents = mean torque x per_Nm + constant
 *   copper      the mean square that is promised is that of the sampled currents
 *   rotation    the same machine with all angles counted from elsewhere costs the same
 *   repetition  the same again gives the same bits */
#include "draws.h"
#include "fuzzing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "hci/host/solve/solve.h"

static const long double PI = 3.14159265358979323846264338327950288L;

/* What takes long is rare, and not what an input that ends early asks for, whose further draws are 0: the
 * pointwise limit has some 1500 components and takes a second. */
enum { MOST_TEXT = 200000, MOST_WORK = 60000000, ONE_POINTWISE_IN = 60, ONE_LONG_TABLE_IN = 24 };

/* ---- draws from the bytes of the input ---- */

/* Of ordinary size three times in four; what is above 1e9 is refused, and rare. */
static double draw_size(void)
{
    static const double size[] = {0.0,  5e-324, 1e-320, 2.3e-308, 1e-160, 1e-12, 1e-9, 1e-6,
                                  1e-3, 0.1,    10.0,   1e3,      1e6,    9.9e8, 1e9};
    if (draw(300) == 299) return 1.7e308;
    const double value = draw(4) == 0 ? size[draw(sizeof size / sizeof *size)] : 0.01 + 0.01 * draw(1000);
    return draw(5) == 0 ? -value : value;
}

static double draw_phase(void)
{
    return draw(3) == 0 ? 0.0 : 0.001 * draw(6284);
}

/* ---- the folder ---- */

static char text[MOST_TEXT];
static size_t used;

static void say(const char *format, double a, double b, double c)
{
    if (used + 200 < sizeof text) used += (size_t)snprintf(text + used, sizeof text - used, format, a, b, c);
}

/* All, odd ones, 6k ± 1, or far ones; at most 2000, each once. */
static double order_of(unsigned kind, unsigned place)
{
    if (kind == 0) return 1.0 + place;
    if (kind == 1 && place < 1000) return 1.0 + 2.0 * place;
    return place == 0 ? 1.0 : kind == 2 ? 3.0 * (place % 666) + (place % 2 ? 2.0 : 1.0) : 2001.0 - place;
}

static unsigned draw_count(void)
{
    static const unsigned many[] = {20, 20, 100, 20, 100, 500, 20, 1000};
    return draw(ONE_LONG_TABLE_IN) == 1 ? many[draw(8)] : 1 + draw(8);
}

static void say_table(const char *name, const char *unit, double shift)
{
    const unsigned count = draw_count(), kind = draw(4);
    const double first = draw_size();
    say("\n@@ machine/", 0, 0, 0);
    used +=
        (size_t)snprintf(text + used, sizeof text - used, "%s\norder,amplitude_%s,phase_rad\n", name, unit);
    for (unsigned place = 0; place < count; ++place) {
        const double order = order_of(kind, place), size = place == 0 ? first
                                                           : draw(3)  ? 0.3 * first / (1.0 + place)
                                                                      : draw_size();
        say("%.17g,%.17g,%.17g\n", order, size, draw_phase() + order * shift);
    }
}

/* shift: by which all angles are counted from elsewhere, electrical. */
static void make_machine(double shift)
{
    static const unsigned pole_pairs[] = {1, 2, 7, 200, 1000};
    used = 0;
    say("@@ machine/machine.csv\nname,value\npole_pairs,%.0f\n", pole_pairs[draw(5)], 0, 0);
    if (draw(4) == 0) say("resistance,%.17g\n", fabs(draw_size()), 0, 0);
    say_table("back_emf.csv", "Nm_per_A", shift);
    if (draw(3) > 0) say_table("cogging.csv", "Nm", shift);
}

/* ---- what is asked for ---- */

enum { MOST_COMPONENTS = 12, MOST_TO_CHOOSE_FOR = 12 };

typedef struct {
    hci_target target;
    hci_component component[MOST_COMPONENTS];
    hci_set name[MOST_COMPONENTS];
    hci_component_set set;
    hci_solve_options options;
    clock_t begin;
} task;

static bool is_late(void *context)
{
    return clock() - ((const task *)context)->begin > 4 * CLOCKS_PER_SEC;
}

static void make_target(double shift)
{
    const unsigned count = 1 + draw(3);
    say("\n@@ target.csv\norder,amplitude_Nm,phase_rad,weight\n", 0, 0, 0);
    for (unsigned k = 0; k < count; ++k) {
        const double size = draw_size(), phase = k ? draw_phase() + 6.0 * k * shift : 0.0;
        say("%.0f,%.17g,%.17g", 6.0 * k, size, phase);
        say(",%.17g\n", draw(4) == 3 ? pow(10.0, (double)draw(13) - 6.0) : 1.0, 0, 0);
    }
}

/* Components 6k ± 1 of either sequence, some of them far. */
static void make_set(task *t)
{
    t->set.component = t->component;
    t->set.set = t->name;
    t->set.count = 1 + draw(MOST_COMPONENTS);
    const unsigned far = draw(5) == 4 ? 300 : 0;
    for (size_t k = 0; k < t->set.count; ++k) {
        const double order = k == 0 ? 1.0 : 6.0 * (double)(far + (k + 1) / 2) + (k % 2 ? -1.0 : 1.0);
        t->component[k] = (hci_component){order, k % 2 ? -1 : 1};
        t->name[k] = k % 2 ? HCI_SET_NEG : HCI_SET_POS;
    }
    t->options.set = &t->set;
}

/* To choose a set for many harmonics, or for high ones, takes minutes with sanitizers. */
static bool is_large(const hci_machine *machine)
{
    double highest = 0.0;
    for (size_t k = 0; k < machine->back_emf_count; ++k)
        highest = fmax(highest, machine->back_emf[k].order);
    for (size_t k = 0; k < machine->cogging_count; ++k)
        highest = fmax(highest, machine->cogging[k].order);
    return machine->back_emf_count + machine->cogging_count > MOST_TO_CHOOSE_FOR || highest > 24.0;
}

static void make_task(task *t, const hci_machine *machine)
{
    t->options.target = &t->target;
    if (is_large(machine) || draw(3) == 2)
        make_set(t);
    else if (draw(3) == 0)
        t->options.choose_at_most = 1 + draw(4);
    t->options.method =
        !t->options.set && draw(ONE_POINTWISE_IN) == 1 ? HCI_METHOD_POINTWISE : HCI_METHOD_AUTO;
    t->options.compare = draw(4) == 0 ? HCI_COMPARE_SQUARE : HCI_COMPARE_ALL;
    t->options.limit_current_A = draw(6) == 0 ? fabs(draw_size()) : 0.0;
    t->options.stop = is_late;
    t->options.stop_context = t;
    t->begin = clock();
}

/* ---- the torque in samples ---- */

typedef struct {
    size_t count, turns;                 /* samples over so many electrical turns */
    long double *sine, *i_A[3], *torque; /* sine: of one turn of the samples */
    long double scale_Nm;                /* largest torque that could add up */
} samples;

static long double *room(size_t count)
{
    long double *values = calloc(count, sizeof *values);
    fuzz_require(values != NULL, "memory for samples");
    return values;
}

/* A sin(nθ − σ2πs/3 + γ) of waves at each sample, added. */
static void add_wave(const samples *s, const hci_wave *wave, int phase, long double *out)
{
    const long double back = -2.0L * PI * wave->sequence * phase / 3.0L;
    const long double in_sine = wave->sine * cosl(back) - wave->cosine * sinl(back);
    const long double in_cosine = wave->sine * sinl(back) + wave->cosine * cosl(back);
    const size_t step = (size_t)llround(wave->order * (double)s->turns), quarter = s->count / 4;
    for (size_t k = 0, at = 0; k < s->count; ++k, at = (at + step) % s->count)
        out[k] += in_sine * s->sine[at] + in_cosine * s->sine[(at + quarter) % s->count];
}

static long double size_of(double sine, double cosine)
{
    return hypotl(sine, cosine);
}

static void sample_currents(samples *s, const hci_solution *solution)
{
    for (size_t k = 0; k < solution->current.count; ++k)
        for (int phase = 0; phase < 3; ++phase)
            add_wave(s, &solution->current.wave[k], phase, s->i_A[phase]);
}

static void sample_torque(samples *s, const hci_machine *machine, const hci_solution *solution)
{
    long double *e = room(s->count), emf = 0.0L, current = 0.0L;
    for (int phase = 0; phase < 3; ++phase) {
        memset(e, 0, s->count * sizeof *e);
        for (size_t k = 0; k < machine->back_emf_count; ++k)
            add_wave(s, &machine->back_emf[k], phase, e);
        for (size_t k = 0; k < s->count; ++k)
            s->torque[k] += e[k] * s->i_A[phase][k];
    }
    for (size_t k = 0; k < machine->cogging_count; ++k) {
        const hci_harmonic *c = &machine->cogging[k];
        add_wave(s, &(hci_wave){c->order, 0, c->sine, c->cosine}, 0, s->torque);
        s->scale_Nm += size_of(c->sine, c->cosine);
    }
    for (size_t k = 0; k < machine->back_emf_count; ++k)
        emf += size_of(machine->back_emf[k].sine, machine->back_emf[k].cosine);
    for (size_t k = 0; k < solution->current.count; ++k)
        current += size_of(solution->current.wave[k].sine, solution->current.wave[k].cosine);
    s->scale_Nm += 3.0L * emf * current;
    free(e);
}

static double highest_order(const hci_machine *machine, const hci_solution *solution)
{
    double emf = 0.0, current = 0.0, cogging = 0.0;
    for (size_t k = 0; k < machine->back_emf_count; ++k)
        emf = fmax(emf, machine->back_emf[k].order);
    for (size_t k = 0; k < machine->cogging_count; ++k)
        cogging = fmax(cogging, machine->cogging[k].order);
    for (size_t k = 0; k < solution->current.count; ++k)
        current = fmax(current, solution->current.wave[k].order);
    return fmax(emf + current, cogging);
}

/* False where it would take too long. */
static bool sample(samples *s, const hci_machine *machine, const hci_solution *solution)
{
    const double most = highest_order(machine, solution) * (double)solution->period_turns;
    memset(s, 0, sizeof *s);
    s->turns = solution->period_turns;
    for (s->count = 64; (double)s->count <= 2.0 * most + 2.0; s->count *= 2)
        ;
    if ((double)s->count * (double)(3 * (machine->back_emf_count + solution->current.count) +
                                    machine->cogging_count + solution->order_count) >
        (double)MOST_WORK)
        return false;
    s->sine = room(s->count);
    for (size_t k = 0; k < s->count; ++k)
        s->sine[k] = sinl(2.0L * PI * (long double)k / (long double)s->count);
    for (int phase = 0; phase < 3; ++phase)
        s->i_A[phase] = room(s->count);
    s->torque = room(s->count);
    sample_currents(s, solution);
    sample_torque(s, machine, solution);
    return true;
}

static void release(samples *s)
{
    free(s->sine);
    free(s->torque);
    for (int phase = 0; phase < 3; ++phase)
        free(s->i_A[phase]);
}

/* ---- the laws ---- */

/* Takes an order out of the sampled torque; returns how far the promise is from it. */
static long double take_out(samples *s, const hci_harmonic *promised)
{
    const size_t step = (size_t)llround(promised->order * (double)s->turns), quarter = s->count / 4;
    const long double factor = (step == 0 ? 1.0L : 2.0L) / (long double)s->count;
    long double sine = 0.0L, cosine = 0.0L;
    for (size_t k = 0, at = 0; k < s->count; ++k, at = (at + step) % s->count) {
        sine += factor * s->torque[k] * s->sine[at];
        cosine += factor * s->torque[k] * s->sine[(at + quarter) % s->count];
    }
    for (size_t k = 0, at = 0; k < s->count; ++k, at = (at + step) % s->count)
        s->torque[k] -= sine * s->sine[at] + cosine * s->sine[(at + quarter) % s->count];
    return hypotl(sine - promised->sine, cosine - promised->cosine);
}

static void check_order(samples *s, const hci_solution *solution, size_t k)
{
    const hci_solved_order *o = &solution->order[k];
    fuzz_require(isfinite(o->torque_Nm.sine) && isfinite(o->torque_Nm.cosine) && isfinite(o->error_Nm),
                 "finite torque");
    const long double wanted = hypotl(o->target_Nm.sine, o->target_Nm.cosine);
    const long double rounding = 1e-10L * s->scale_Nm + 1e-14L * wanted + 1e-300L;
    fuzz_require(take_out(s, &o->torque_Nm) <= rounding, "the promised torque is that of the samples");
    const long double error = hypotl((long double)o->torque_Nm.sine - o->target_Nm.sine,
                                     (long double)o->torque_Nm.cosine - o->target_Nm.cosine);
    fuzz_require(fabsl(error - o->error_Nm) <= rounding, "the error is torque less target");
    if (o->verdict == HCI_ORDER_REACHED)
        fuzz_require(error <= solution->tolerance_Nm + rounding, "an order that is reached is");
}

static void check_spectrum(samples *s, const hci_solution *solution)
{
    long double left = 0.0L;
    for (size_t k = 0; k < solution->order_count; ++k)
        check_order(s, solution, k);
    for (size_t k = 0; k < s->count; ++k)
        left = fmaxl(left, fabsl(s->torque[k]));
    fuzz_require(left <= 1e-9L * s->scale_Nm + 1e-300L, "no torque at orders that are not listed");
}

static void check_copper(const samples *s, const hci_solution *solution)
{
    long double square = 0.0L, peak = 0.0L;
    for (int phase = 0; phase < 3; ++phase)
        for (size_t k = 0; k < s->count; ++k) {
            square += s->i_A[phase][k] * s->i_A[phase][k] / (long double)s->count;
            peak = fmaxl(peak, fabsl(s->i_A[phase][k]));
        }
    fuzz_require(fabsl(square - solution->mean_square_A2) <= 1e-9L * square + 1e-300L,
                 "the promised copper loss is that of the samples");
    fuzz_require(peak <= solution->peak_phase_current_A * (1.0L + 1e-9L) + 1e-300L,
                 "no sample is above the promised peak");
    if (solution->within_limits && solution->limit_count > 0 && solution->limit[0].kind == HCI_LIMIT_CURRENT)
        fuzz_require(peak <= solution->limit[0].limit * (1.0L + 1e-6L), "currents within their limit are");
}

static bool is_near(double a, double b, double scale)
{
    return fabs(a - b) <= 1e-9 * fabs(scale) + 1e-300;
}

static void check_linear(const hci_solution *solution, double mean_Nm)
{
    double scale = 0.0;
    for (size_t k = 0; k < solution->current.count && solution->per_Nm != NULL; ++k)
        scale += fabs(solution->current.wave[k].sine) + fabs(solution->current.wave[k].cosine) +
                 fabs(solution->constant[k].sine) + fabs(solution->constant[k].cosine);
    for (size_t k = 0; k < solution->current.count && solution->per_Nm != NULL; ++k) {
        const hci_wave *i = &solution->current.wave[k], *per = &solution->per_Nm[k],
                       *rest = &solution->constant[k];
        fuzz_require(is_near(i->sine, mean_Nm * per->sine + rest->sine, scale) &&
                         is_near(i->cosine, mean_Nm * per->cosine + rest->cosine, scale),
                     "currents are linear in the mean torque");
    }
}

static void check_finite(const hci_solution *solution)
{
    for (size_t k = 0; k < solution->current.count; ++k)
        fuzz_require(isfinite(solution->current.wave[k].sine) && isfinite(solution->current.wave[k].cosine),
                     "finite currents");
    fuzz_require(isfinite(solution->mean_square_A2) && isfinite(solution->peak_phase_current_A) &&
                     isfinite(solution->worst_error_Nm),
                 "finite figures");
    fuzz_check_shown(solution->remark.text);
}

/* ---- one input ---- */

/* What a solution must not depend on the zero of the angle in. */
typedef struct {
    hci_status status;
    double mean_square_A2;
    double condition;
    double none_A; /* what is less is rounding */
    uint64_t hash;
    bool is_given; /* the components were not chosen */
} outcome;

static void check_laws(const hci_machine_data *machine, const hci_solution *solution, double mean_Nm)
{
    samples s;
    check_finite(solution);
    if (!sample(&s, &machine->model, solution)) return;
    check_copper(&s, solution);
    check_spectrum(&s, solution);
    check_linear(solution, mean_Nm);
    release(&s);
}

static uint64_t hash_of(const void *values, size_t size)
{
    const uint8_t *byte = values;
    uint64_t hash = 14695981039346656037u;
    for (size_t k = 0; k < size; ++k)
        hash = (hash ^ byte[k]) * 1099511628211u;
    return hash;
}

/* Fields of a wave alone: it has bytes between them. */
static uint64_t hash_of_waves(const hci_wave *wave, size_t count)
{
    uint64_t hash = count;
    for (size_t k = 0; k < count; ++k) {
        const double values[] = {wave[k].order, wave[k].sequence, wave[k].sine, wave[k].cosine};
        hash = hash * 31u + hash_of(values, sizeof values);
    }
    return hash;
}

/* A billionth of the limit, and what makes a billionth of the torque that is missing. */
static double rounding_A(const hci_machine_data *machine, const task *t, const hci_solution *solution)
{
    double emf = 0.0;
    for (size_t k = 0; k < machine->model.back_emf_count; ++k)
        emf = fmax(emf, hypot(machine->model.back_emf[k].sine, machine->model.back_emf[k].cosine));
    return 1e-9 * fmax(t->options.limit_current_A, emf > 0.0 ? solution->worst_error_Nm / emf : 0.0);
}

static hci_status find(const hci_machine_data *machine, task *t, outcome *found, hci_note *note)
{
    hci_solution solution;
    const hci_status status = hci_solve(machine, &t->options, &solution, note);
    if (status != HCI_OK && status != HCI_NOT_REACHED) return status;
    found->mean_square_A2 = solution.mean_square_A2;
    found->condition = solution.condition;
    found->none_A = rounding_A(machine, t, &solution);
    found->hash = hash_of_waves(solution.current.wave, solution.current.count);
    found->is_given = t->options.set != NULL;
    check_laws(machine, &solution, hci_target_mean_Nm(&t->target));
    hci_solution_release(&solution);
    return status;
}

static outcome solve(const uint8_t *data, size_t size, double shift)
{
    outcome found = {HCI_ERROR_INPUT, 0.0, 0.0, 0.0, 0, false};
    hci_machine_data machine;
    task t;
    hci_note note = {{0}};
    draws_begin(data, size);
    memset(&machine, 0, sizeof machine);
    memset(&t, 0, sizeof t);
    make_machine(shift);
    make_target(shift);
    fuzz_unpack((const uint8_t *)text, used);
    found.status = hci_machine_read("machine", &machine, &note);
    if (!found.status) found.status = hci_target_read("target.csv", &t.target, &note);
    make_task(&t, &machine.model);
    if (!found.status) found.status = find(&machine, &t, &found, &note);
    hci_target_release(&t.target);
    hci_machine_release(&machine);
    if (getenv("FUZZ_VERBOSE") != NULL)
        fprintf(stderr, "%s\nstatus %d %s\n", text, (int)found.status, note.text);
    if (found.status != HCI_NOT_REACHED) fuzz_check_note(found.status, &note);
    return found;
}

/* Angles counted from elsewhere: the same copper, where rounding does not decide which components are chosen.
 */
static void check_rotated(const outcome *first, const outcome *rotated)
{
    if (first->status != rotated->status || !(first->condition < 1e6)) return;
    const double none_A = fmax(first->none_A, rotated->none_A);
    fuzz_require(fabs(first->mean_square_A2 - rotated->mean_square_A2) <=
                     1e-6 * first->mean_square_A2 + none_A * none_A + 1e-200,
                 "the same copper loss whatever the zero of the angle");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const outcome first = solve(data, size, 0.0);
    if (first.status == HCI_ERROR_STOPPED) return -1;
    const outcome again = solve(data, size, 0.0);
    fuzz_require(again.status == HCI_ERROR_STOPPED ||
                     (first.status == again.status && first.hash == again.hash),
                 "the same again gives the same bits");
    if (first.is_given) {
        const outcome rotated = solve(data, size, 0.7);
        check_rotated(&first, &rotated);
    }
    return 0;
}
