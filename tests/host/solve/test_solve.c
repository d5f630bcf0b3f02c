/* Random machines, targets and sets: what hci_solve promises against sampled torque with a naive Fourier sum,
 * a system built from sampled unit currents, a pseudo-inverse by Jacobi rotations, and the laws of the
 * balance. */
#include "hci/host/solve/solve.h"

#include <string.h>

#include "support/jacobi.h"
#include "support/sampled.h"
#include "unity.h"

/* Orders of currents up to 25 and of the back-EMF up to 13 make torque up to 38 < 48 = PER_TURN/2. */
enum {
    PER_TURN = 96,
    MOST_TURNS = 5,
    MOST_BINS = PER_TURN / 2 * MOST_TURNS,
    MOST_TERMS = 6,
    MOST_SET = 24,
    DRAWS = 200
};
enum { MOST_UNKNOWNS = 2 * (MOST_SET + 1), MOST_ROWS = 2 * MOST_BINS };

/* One draw; `bind` makes the library's structs point into it. */
typedef struct {
    size_t turns; /* a period of everything, not always the shortest */
    bool has_neutral, is_held;
    size_t emf_count, cogging_count, target_count, set_count;
    ref_wave emf[MOST_TERMS], cogging[MOST_TERMS];
    hci_wave back_emf[MOST_TERMS], held;
    hci_harmonic cogging_Nm[MOST_TERMS];
    hci_target_order wanted[MOST_TERMS];
    hci_component component[MOST_SET];
    hci_set name[MOST_SET];
    hci_machine_data machine;
    hci_target target;
    hci_component_set set;
    hci_solve_options options;
} problem;

/* The weighted system of a problem, from samples: U over every bin, and which bins it compares. */
typedef struct {
    size_t bins, components, unknowns, rows;
    hci_wave unit[MOST_SET + 1]; /* what each pair of columns is of */
    double sine[MOST_UNKNOWNS][MOST_BINS], cosine[MOST_UNKNOWNS][MOST_BINS];
    double wanted_sine[MOST_BINS], wanted_cosine[MOST_BINS], h_sine[MOST_BINS], h_cosine[MOST_BINS];
    double weight[MOST_BINS];
    bool given[MOST_BINS], touched[MOST_BINS], compared[MOST_BINS];
    double u[MOST_ROWS * MOST_UNKNOWNS], h[MOST_ROWS],
        x[MOST_UNKNOWNS]; /* compared rows, weighted; x of least copper */
    jacobi_values values;
} reference;

static sampled samples;

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- draws
 * ----------------------------------------------------------------------------------------------------- */

static int sequence_of(int order)
{
    return order % 3 == 2 ? -1 : order % 3;
}

static void bind(problem *p)
{
    for (size_t k = 0; k < p->emf_count; ++k)
        p->back_emf[k] = (hci_wave){p->emf[k].order, sequence_of((int)p->emf[k].order),
                                    p->emf[k].amplitude * cos(p->emf[k].phase),
                                    p->emf[k].amplitude * sin(p->emf[k].phase)};
    for (size_t k = 0; k < p->cogging_count; ++k)
        p->cogging_Nm[k] =
            (hci_harmonic){p->cogging[k].order, p->cogging[k].amplitude * cos(p->cogging[k].phase),
                           p->cogging[k].amplitude * sin(p->cogging[k].phase)};
    p->machine.has_neutral = p->has_neutral;
    p->machine.back_emf = p->back_emf;
    p->machine.cogging = p->cogging_Nm;
    p->machine.model =
        (hci_machine){(int)p->turns, p->back_emf, p->emf_count, p->cogging_Nm, p->cogging_count, NULL, 0};
    p->target = (hci_target){p->wanted, p->target_count};
    p->set.component = p->component;
    p->set.set = p->name;
    p->set.count = p->set_count;
    p->options.target = &p->target;
    p->options.set = &p->set;
    p->options.held = p->is_held ? &p->held : NULL;
}

static bool is_listed(double order, const double *list, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (fabs(order - list[k]) < 1e-6) return true;
    return false;
}

/* A dominant fundamental and others that together stay below 0.35 of it, so that e⊥ never vanishes. */
static void draw_machine(uint64_t *seed, problem *p)
{
    static const int CHOICE[] = {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13};
    double used[MOST_TERMS] = {1.0};
    const double fundamental = ref_uniform(seed, 0.3, 2.0);
    p->turns = ref_integer(seed, 0, 2) == 0 ? (size_t)ref_integer(seed, 2, MOST_TURNS) : 1;
    p->has_neutral = ref_integer(seed, 0, 2) == 0;
    p->emf[0] = (ref_wave){1.0, 0.0, fundamental, ref_uniform(seed, -3.0, 3.0)};
    p->emf_count = (size_t)ref_integer(seed, 1, MOST_TERMS);
    for (size_t k = 1; k < p->emf_count; ++k) {
        do
            used[k] = CHOICE[ref_integer(seed, 0, 10)];
        while (is_listed(used[k], used, k));
        p->emf[k] = (ref_wave){used[k], 0.0, fundamental * ref_uniform(seed, 0.01, 0.07),
                               ref_uniform(seed, -3.0, 3.0)};
    }
    p->cogging_count = (size_t)ref_integer(seed, 0, MOST_TERMS - 1);
    for (size_t k = 0; k < p->cogging_count; ++k) {
        do
            used[k] = ref_integer(seed, 1, 24 * (int)p->turns) / (double)p->turns;
        while (is_listed(used[k], used, k));
        p->cogging[k] = (ref_wave){used[k], 0.0, ref_uniform(seed, 0.01, 0.5), ref_uniform(seed, -3.0, 3.0)};
    }
}

/* The mean and up to four orders, mostly whole; `weighted` also weights other than 1, 0 among them. */
static void draw_target(uint64_t *seed, bool weighted, problem *p)
{
    static const double WEIGHT[] = {1.0, 1.0, 1.0, 0.0, 0.4, 3.0};
    double used[MOST_TERMS] = {0.0};
    p->target_count = (size_t)ref_integer(seed, 1, 5);
    for (size_t k = 0; k < p->target_count; ++k) {
        const double amplitude = ref_uniform(seed, 0.05, 1.0), phase = ref_uniform(seed, -3.0, 3.0);
        const int whole = k == 0 ? 0 : ref_integer(seed, 1, 24);
        const bool fractional = ref_integer(seed, 0, 3) == 0;
        used[k] = k > 0 && fractional ? ref_integer(seed, 1, 24 * (int)p->turns) / (double)p->turns : whole;
        if (is_listed(used[k], used, k)) {
            p->target_count = k;
            break;
        }
        p->wanted[k] = (hci_target_order){{used[k], amplitude * cos(phase), amplitude * sin(phase)},
                                          weighted ? WEIGHT[ref_integer(seed, 0, 5)] : 1.0};
    }
    p->wanted[0].torque_Nm =
        (hci_harmonic){0.0, 0.0, ref_uniform(seed, 0.2, 5.0) * (ref_integer(seed, 0, 1) ? 1 : -1)};
    if (p->wanted[0].weight <= 0.0) p->wanted[0].weight = 2.0;
}

static hci_component draw_component(uint64_t *seed, const problem *p, hci_set *name)
{
    const bool fractional = p->turns > 1 && ref_integer(seed, 0, 5) == 0;
    const int whole = ref_integer(seed, 0, 16);
    hci_component c = {whole, 0};
    *name = (hci_set)ref_integer(seed, HCI_SET_POS, p->has_neutral ? HCI_SET_ZERO : HCI_SET_ASYM);
    if (*name == HCI_SET_SYM && !p->has_neutral && whole % 3 == 0) *name = HCI_SET_ASYM;
    if (fractional && *name != HCI_SET_SYM)
        c.order = ref_integer(seed, 0, 16 * (int)p->turns) / (double)p->turns;
    if (*name != HCI_SET_ASYM && c.order < 1e-6) *name = HCI_SET_POS;
    c.sequence = *name == HCI_SET_NEG    ? -1
                 : *name == HCI_SET_ZERO ? 0
                 : *name == HCI_SET_SYM  ? sequence_of(whole)
                                         : 1;
    return c;
}

static void add_component(problem *p, hci_component c, hci_set name)
{
    bool repeated = p->is_held && c.sequence == 1 && fabs(c.order - 1.0) < 1e-6;
    for (size_t k = 0; k < p->set_count; ++k)
        repeated = repeated ||
                   (fabs(p->component[k].order - c.order) < 1e-6 && p->component[k].sequence == c.sequence);
    if (repeated || p->set_count == MOST_SET) return;
    p->name[p->set_count] = name;
    p->component[p->set_count++] = c;
}

static void draw_set(uint64_t *seed, problem *p)
{
    for (int tries = ref_integer(seed, 0, MOST_SET / 2); tries > 0; --tries) {
        hci_set name;
        const hci_component c = draw_component(seed, p, &name);
        add_component(p, c, name);
    }
}

/* The components of the fundamental's two sides of order m: m + 1 positive, m − 1 negative. One of them, or
 * both. */
static void add_sides(uint64_t *seed, problem *p, double m, bool both)
{
    const bool above = m < 1.5 || ref_integer(seed, 0, 1) == 0;
    if (m < 1e-6) return;
    if (both || above) add_component(p, (hci_component){m + 1.0, 1}, HCI_SET_POS);
    if (m > 1.5 && (both || !above)) add_component(p, (hci_component){m - 1.0, -1}, HCI_SET_NEG);
}

/* A set that reaches what is wanted or disturbed, in the way of the papers: square where one side of each
 * order is taken. */
static void design_set(uint64_t *seed, problem *p)
{
    const bool both = ref_integer(seed, 0, 2) == 0;
    if (p->emf_count > 3) p->emf_count = 1;
    for (size_t k = 0; k < p->target_count; ++k)
        add_sides(seed, p, p->wanted[k].torque_Nm.order, both);
    for (size_t k = 0; k < p->cogging_count; ++k)
        add_sides(seed, p, p->cogging[k].order, both);
    for (size_t k = 1; k < p->emf_count && p->is_held; ++k) {
        const double order = p->emf[k].order;
        if (sequence_of((int)order) == 0) continue;
        add_sides(seed, p, sequence_of((int)order) == 1 ? order - 1.0 : order + 1.0, both);
    }
}

static void draw(uint64_t *seed, bool weighted, problem *p)
{
    memset(p, 0, sizeof *p);
    draw_machine(seed, p);
    draw_target(seed, weighted, p);
    p->is_held = ref_integer(seed, 0, 1) == 0;
    p->held = hci_wave_polar(1.0, 1, ref_uniform(seed, 0.5, 8.0), ref_uniform(seed, -3.0, 3.0));
    if (ref_integer(seed, 0, 1) == 0)
        draw_set(seed, p);
    else
        design_set(seed, p);
    p->options.compare = ref_integer(seed, 0, 2) == 0 ? HCI_COMPARE_SQUARE : HCI_COMPARE_ALL;
    bind(p);
}

static void sample_machine(const problem *p, size_t per_turn)
{
    sampled_machine(&samples, p->turns, per_turn, p->emf, p->emf_count, p->cogging, p->cogging_count);
}

/* ---- the system, a second time
 * --------------------------------------------------------------------------------- */

static void respond(const hci_wave *wave, bool with_cogging, size_t bins, double *sine, double *cosine)
{
    sampled_currents(&samples, wave, wave ? 1 : 0, with_cogging);
    sampled_spectrum(&samples, bins);
    memcpy(sine, samples.sine, bins * sizeof *sine);
    memcpy(cosine, samples.cosine, bins * sizeof *cosine);
}

static void list_units(const problem *p, reference *s)
{
    bool named = p->is_held;
    for (size_t k = 0; k < p->set_count; ++k)
        named = named || (fabs(p->component[k].order - 1.0) < 1e-6 && p->component[k].sequence == 1);
    if (!named) s->unit[s->components++] = (hci_wave){1.0, 1, 0.0, 0.0};
    for (size_t k = 0; k < p->set_count; ++k)
        s->unit[s->components++] = (hci_wave){p->component[k].order, p->component[k].sequence, 0.0, 0.0};
    s->unknowns = 2 * s->components;
}

/* 1e-9: an entry is some 0.01 or more where there is one, and rounding where there is none. */
static bool is_entry(double sine, double cosine)
{
    return hypot(sine, cosine) > 1e-9;
}

static void sample_columns(const problem *p, reference *s)
{
    s->bins = samples.count / 2;
    for (size_t j = 0; j < s->unknowns; ++j) {
        hci_wave unit = s->unit[j / 2];
        unit.sine = j % 2 == 0 ? 1.0 : 0.0;
        unit.cosine = 1.0 - unit.sine;
        respond(&unit, false, s->bins, s->sine[j], s->cosine[j]);
        for (size_t m = 0; m < s->bins; ++m) {
            if (is_entry(s->sine[j][m], s->cosine[j][m]))
                s->touched[m] = true;
            else
                s->sine[j][m] = s->cosine[j][m] = 0.0;
        }
    }
    respond(p->is_held ? &p->held : NULL, true, s->bins, s->h_sine, s->h_cosine);
}

/* h = target − cogging − what is held; given: the mean, the target, the cogging, what the held current
 * touches. */
static void sample_right_side(const problem *p, reference *s)
{
    s->given[0] = true;
    for (size_t m = 0; m < s->bins; ++m) {
        s->weight[m] = 1.0;
        s->given[m] = s->given[m] || (p->is_held && is_entry(s->h_sine[m], s->h_cosine[m]));
    }
    for (size_t k = 0; k < p->cogging_count; ++k)
        s->given[sampled_bin(&samples, p->cogging[k].order)] = true;
    for (size_t k = 0; k < p->target_count; ++k) {
        const size_t m = sampled_bin(&samples, p->wanted[k].torque_Nm.order);
        s->given[m] = true;
        s->weight[m] = p->wanted[k].weight;
        s->wanted_sine[m] = p->wanted[k].torque_Nm.sine;
        s->wanted_cosine[m] = p->wanted[k].torque_Nm.cosine;
    }
    for (size_t m = 0; m < s->bins; ++m) {
        s->h_sine[m] = s->wanted_sine[m] - s->h_sine[m];
        s->h_cosine[m] = s->wanted_cosine[m] - s->h_cosine[m];
    }
}

/* All: what is given or touched, weight 0 left out. Square: as many as there are components, the given ones
 * first, without the mean when the fundamental is held. */
static void choose_rows(const problem *p, reference *s)
{
    const bool square = p->options.compare == HCI_COMPARE_SQUARE;
    size_t left = square ? s->components : s->bins;
    for (int pass = 0; pass < 2; ++pass)
        for (size_t m = 0; m < s->bins; ++m) {
            const bool mine = pass == 0 ? s->given[m] : s->touched[m] && !s->given[m];
            if (!mine || s->weight[m] <= 0.0 || left == 0 || (square && m == 0 && p->is_held)) continue;
            s->compared[m] = true;
            s->rows += m == 0 ? 1 : 2;
            --left;
        }
}

/* Copper is (3/2)I², but 3I² for a constant zero-sequence current: its column counts by 1/√2. */
static double copper_scale(const reference *s, size_t unknown)
{
    const hci_wave *unit = &s->unit[unknown / 2];
    return unit->sequence == 0 && unit->order < 1e-6 ? sqrt(0.5) : 1.0;
}

static void solve_system(reference *s)
{
    size_t i = 0;
    for (size_t m = 0; m < s->bins; ++m) {
        if (!s->compared[m]) continue;
        for (int part = m == 0; part < 2; ++part, ++i) {
            s->h[i] = s->weight[m] * (part == 0 ? s->h_sine[m] : s->h_cosine[m]);
            for (size_t j = 0; j < s->unknowns; ++j)
                s->u[i + j * s->rows] =
                    copper_scale(s, j) * s->weight[m] * (part == 0 ? s->sine[j][m] : s->cosine[j][m]);
        }
    }
    s->values = jacobi_solve(s->rows, s->unknowns, s->u, 1e-11, 1, s->h, s->x);
    for (size_t j = 0; j < s->unknowns; ++j)
        s->x[j] *= copper_scale(s, j);
}

static void make_system(const problem *p, reference *s)
{
    memset(s, 0, sizeof *s);
    sample_machine(p, PER_TURN);
    list_units(p, s);
    sample_columns(p, s);
    sample_right_side(p, s);
    choose_rows(p, s);
    solve_system(s);
}

/* Whether the rank is beyond doubt: no singular value between 1e-13 and 1e-8 of the largest. */
static bool is_clear(const reference *s)
{
    return s->values.rank == 0 ||
           (s->values.dropped < 1e-13 * s->values.largest && s->values.smallest > 1e-8 * s->values.largest);
}

/* How far two solutions of the system may be apart: rounding, times the condition, times it again for the
 * residual; 1000 for the sums of up to 300 rows. */
static double current_bound_A(const reference *s)
{
    double h = 0.0, x = 0.0;
    const double ratio = s->values.rank ? s->values.largest / s->values.smallest : 0.0;
    for (size_t i = 0; i < s->rows; ++i)
        h = fmax(h, fabs(s->h[i]));
    for (size_t j = 0; j < s->unknowns; ++j)
        x = fmax(x, fabs(s->x[j]));
    return 1e-14 + (s->values.rank ? 1000.0 * 2.2e-16 * ratio * (ratio * h / s->values.largest + x) : 0.0);
}

/* ---- one solution
 * ---------------------------------------------------------------------------------------------- */

static hci_status solve(const problem *p, hci_solution *solution)
{
    hci_note note = {{0}};
    const hci_status status = hci_solve(&p->machine, &p->options, solution, &note);
    if (status > HCI_NOT_REACHED) {
        TEST_ASSERT_TRUE_MESSAGE(note.text[0] != '\0', "an error without a note");
    }
    return status;
}

static hci_status solve_well(const problem *p, hci_solution *solution)
{
    hci_note note = {{0}};
    const hci_status status = hci_solve(&p->machine, &p->options, solution, &note);
    TEST_ASSERT_TRUE_MESSAGE(status == HCI_OK || status == HCI_NOT_REACHED, note.text);
    return status;
}

/* Largest of |x_k − y_k| over coordinates, `scale`·y for the second. */
static double wave_distance(const hci_wave *x, const hci_wave *y, size_t count, double scale)
{
    double worst = 0.0;
    for (size_t k = 0; k < count; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(x[k].order, y[k].order);
        TEST_ASSERT_EQUAL_INT(x[k].sequence, y[k].sequence);
        worst = ref_worse(ref_worse(worst, x[k].sine - scale * y[k].sine), x[k].cosine - scale * y[k].cosine);
    }
    return worst;
}

static void check_currents(const problem *p, const reference *s, const hci_solution *solution)
{
    hci_wave expected[MOST_SET + 2];
    size_t count = 0;
    if (p->is_held) expected[count++] = p->held;
    for (size_t k = 0; k < s->components; ++k, ++count) {
        expected[count] = s->unit[k];
        expected[count].sine = s->x[2 * k];
        expected[count].cosine = s->x[2 * k + 1];
    }
    TEST_ASSERT_EQUAL_UINT64(count, solution->current.count);
    TEST_ASSERT_DOUBLE_WITHIN(current_bound_A(s), 0.0,
                              wave_distance(solution->current.wave, expected, count, 1.0));
}

/* U and the promised sizes; the condition is an estimate to a factor of two. Of the plain U, without copper
 * scales. */
static void check_size(const reference *s, const hci_solution *solution)
{
    bool scaled = false;
    TEST_ASSERT_EQUAL_UINT64(s->rows, solution->rows);
    TEST_ASSERT_EQUAL_UINT64(s->unknowns, solution->unknowns);
    TEST_ASSERT_EQUAL_UINT64(s->values.rank, solution->rank);
    for (size_t j = 0; j < s->unknowns; ++j)
        scaled = scaled || copper_scale(s, j) < 1.0;
    if (s->values.rank == 0 || scaled) return;
    const double ratio = s->values.largest / s->values.smallest;
    TEST_ASSERT_TRUE(solution->condition > 0.5 * ratio && solution->condition < 2.0 * ratio);
}

/* The residual is at right angles to every column, by the test's own U and the torque of the samples. */
static void check_residual(const reference *s)
{
    for (size_t j = 0; j < s->unknowns; ++j) {
        double dot = 0.0, column = 0.0, residual = 0.0;
        for (size_t m = 0; m < s->bins; ++m) {
            const double w = s->weight[m] * s->weight[m], rs = samples.sine[m] - s->wanted_sine[m],
                         rc = samples.cosine[m] - s->wanted_cosine[m];
            if (!s->compared[m]) continue;
            dot += w * (s->sine[j][m] * rs + s->cosine[j][m] * rc);
            column += w * (s->sine[j][m] * s->sine[j][m] + s->cosine[j][m] * s->cosine[j][m]);
            residual += w * (s->h_sine[m] * s->h_sine[m] + s->h_cosine[m] * s->h_cosine[m]);
        }
        /* 1e-11: rounding of 300 rows times the spread of the column norms (1 to 0.01). */
        TEST_ASSERT_DOUBLE_WITHIN(1e-11 * (sqrt(column * residual) + 1e-3), 0.0, dot);
    }
}

static double tolerance_of(const problem *p)
{
    return 1e-6 * fabs(p->wanted[0].torque_Nm.cosine);
}

static hci_order_verdict verdict_of(const reference *s, size_t m, double error, double tolerance)
{
    if (s->weight[m] <= 0.0) return HCI_ORDER_FREE;
    if (error <= tolerance) return HCI_ORDER_REACHED;
    if (!s->touched[m]) return HCI_ORDER_UNREACHABLE;
    return s->compared[m] ? HCI_ORDER_MISSED : HCI_ORDER_PARASITIC;
}

/* Every bin against the promised spectrum: torque to 1e-9 of the largest, target, error and verdict. Expects
 * the samples of the solution. Returns whether everything is reached. */
static bool check_orders(const problem *p, const reference *s, const hci_solution *solution)
{
    double scale = 0.0, worst = 0.0;
    size_t at = 0;
    bool reached = true;
    for (size_t m = 0; m < s->bins; ++m)
        scale = fmax(scale, hypot(samples.sine[m], samples.cosine[m]));
    for (size_t m = 0; m < s->bins; ++m) {
        const double rs = samples.sine[m] - s->wanted_sine[m], rc = samples.cosine[m] - s->wanted_cosine[m];
        const double error = hypot(rs, rc);
        const hci_order_verdict verdict = verdict_of(s, m, error, tolerance_of(p));
        const hci_solved_order *o = &solution->order[at];
        if (at == solution->order_count || sampled_bin(&samples, o->torque_Nm.order) != m) {
            TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-9 * scale, 0.0, hypot(samples.sine[m], samples.cosine[m]),
                                              "not listed");
            continue;
        }
        ++at;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * scale, samples.sine[m], o->torque_Nm.sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * scale, samples.cosine[m], o->torque_Nm.cosine);
        TEST_ASSERT_EQUAL_DOUBLE(s->wanted_sine[m], o->target_Nm.sine);
        TEST_ASSERT_EQUAL_DOUBLE(s->wanted_cosine[m], o->target_Nm.cosine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * scale, error, o->error_Nm);
        if (fabs(error - tolerance_of(p)) > 1e-9 * scale) {
            TEST_ASSERT_EQUAL_INT(verdict, o->verdict);
        }
        reached = reached && o->verdict <= HCI_ORDER_FREE;
        if (verdict != HCI_ORDER_FREE) worst = fmax(worst, error);
    }
    TEST_ASSERT_EQUAL_UINT64(solution->order_count, at);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * scale, worst, solution->worst_error_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * tolerance_of(p), tolerance_of(p), solution->tolerance_Nm);
    return reached;
}

/* The plain fundamental: what is held, or the least sine of the same mean, along the back-EMF. */
static hci_wave plain_of(const problem *p)
{
    const double amplitude = p->wanted[0].torque_Nm.cosine / (1.5 * p->emf[0].amplitude);
    return p->is_held
               ? p->held
               : (hci_wave){1.0, 1, amplitude * cos(p->emf[0].phase), amplitude * sin(p->emf[0].phase)};
}

static void sample_target(const problem *p, double *wanted)
{
    memset(wanted, 0, samples.count * sizeof *wanted);
    for (size_t k = 0; k < p->target_count; ++k)
        sampled_add(&samples, p->wanted[k].torque_Nm.order, p->wanted[k].torque_Nm.sine,
                    p->wanted[k].torque_Nm.cosine, 0.0, wanted);
}

/* Copper by the average over samples, ratios, the limit, the peak, the period. Leaves samples of 1024 a turn.
 */
static void check_figures(const problem *p, const hci_solution *solution, hci_status status)
{
    static double wanted[SAMPLED_MOST];
    const hci_wave plain = plain_of(p);
    const double plain_A = hypot(plain.sine, plain.cosine);
    bool weighted = false;
    double copper, limit, peak;
    sample_machine(p, 1024);
    sampled_currents(&samples, solution->current.wave, solution->current.count, true);
    copper = sampled_mean_square(&samples);
    peak = sampled_peak(&samples);
    sample_target(p, wanted);
    limit = sampled_limit(&samples, wanted, p->has_neutral);
    for (size_t k = 0; k < p->target_count; ++k)
        weighted = weighted || p->wanted[k].weight <= 0.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-11 * copper, copper, solution->mean_square_A2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * plain_A, plain_A, solution->plain_amplitude_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * copper, copper, solution->loss_to_plain * 1.5 * plain_A * plain_A);
    /* 1024 samples: 1/(e⊥·e⊥) has orders that fall by 0.35 or faster for each 13 orders. */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * limit, limit, solution->limit_mean_square_A2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * copper, copper, solution->loss_to_limit * limit);
    /* No current that makes the torque exactly has less copper than the limit; 1e-4: "exactly" is to 1e-6. */
    if (status == HCI_OK && !weighted) {
        TEST_ASSERT_TRUE(copper >= (1.0 - 1e-4) * limit);
    }
    /* 16 samples to the period of the highest order: at most (π/16)²/2 = 1.93 % below the peak. */
    TEST_ASSERT_TRUE(solution->peak_phase_current_A >= 0.98 * peak);
    TEST_ASSERT_TRUE(solution->peak_phase_current_A <=
                     peak * (1.0 + 0.5 * pow(REF_PI * 16.0 / 1024.0, 2)) + 1e-12);
}

static bool is_whole_at(const problem *p, size_t turns, size_t shortest)
{
    bool whole = true;
#define BIN_OF(order) ((size_t)floor((order) * (double)p->turns + 0.5) * turns % shortest == 0)
    for (size_t k = 0; k < p->set_count; ++k)
        whole = whole && BIN_OF(p->component[k].order);
    for (size_t k = 0; k < p->target_count; ++k)
        whole = whole && BIN_OF(p->wanted[k].torque_Nm.order);
    for (size_t k = 0; k < p->cogging_count; ++k)
        whole = whole && BIN_OF(p->cogging[k].order);
#undef BIN_OF
    return whole;
}

static void check_period(const problem *p, const hci_solution *solution)
{
    size_t turns = 1;
    while (!is_whole_at(p, turns, p->turns))
        ++turns;
    TEST_ASSERT_EQUAL_UINT64(turns, solution->period_turns);
}

static void check_split(const problem *p, const reference *s, const hci_solution *solution)
{
    const double mean_Nm = p->wanted[0].torque_Nm.cosine;
    hci_wave sum[MOST_SET + 2];
    hci_solution other;
    problem q = *p;
    if (p->is_held) {
        TEST_ASSERT_NULL(solution->per_Nm);
        TEST_ASSERT_NULL(solution->constant);
        return;
    }
    q.wanted[0].torque_Nm.cosine = -1.7 * mean_Nm;
    bind(&q);
    solve_well(&q, &other);
    for (int turn = 0; turn < 2; ++turn) {
        const hci_solution *whole = turn == 0 ? solution : &other;
        for (size_t k = 0; k < solution->current.count; ++k) {
            const double mean = q.wanted[0].torque_Nm.cosine;
            const hci_wave *a = &solution->per_Nm[k], *b = &solution->constant[k];
            sum[k] = *b;
            sum[k].sine += (turn == 0 ? mean_Nm : mean) * a->sine;
            sum[k].cosine += (turn == 0 ? mean_Nm : mean) * a->cosine;
        }
        TEST_ASSERT_DOUBLE_WITHIN(10.0 * current_bound_A(s), 0.0,
                                  wave_distance(whole->current.wave, sum, solution->current.count, 1.0));
    }
    hci_solution_release(&other);
}

/* ---- laws
 * ------------------------------------------------------------------------------------------------------ */

/* Back-EMF × a, torques × b: currents × b/a. */
static void check_scaling(const problem *p, const reference *s, const hci_solution *solution,
                          hci_status status)
{
    const double a = 2.5, b = 0.3;
    problem q = *p;
    hci_solution other;
    for (size_t k = 0; k < q.emf_count; ++k)
        q.emf[k].amplitude *= a;
    for (size_t k = 0; k < q.cogging_count; ++k)
        q.cogging[k].amplitude *= b;
    for (size_t k = 0; k < q.target_count; ++k) {
        q.wanted[k].torque_Nm.sine *= b;
        q.wanted[k].torque_Nm.cosine *= b;
    }
    q.held.sine *= b / a;
    q.held.cosine *= b / a;
    bind(&q);
    TEST_ASSERT_EQUAL_INT(status, solve_well(&q, &other));
    TEST_ASSERT_DOUBLE_WITHIN(
        2.0 * current_bound_A(s), 0.0,
        wave_distance(other.current.wave, solution->current.wave, other.current.count, b / a));
    hci_solution_release(&other);
}

static void turn_by(double *sine, double *cosine, double angle)
{
    const double s = *sine, c = *cosine;
    *sine = s * cos(angle) - c * sin(angle);
    *cosine = c * cos(angle) + s * sin(angle);
}

/* The angle's zero moved by δ: every phase of order n moves by nδ, those of the currents too. */
static void check_rotation(const problem *p, const reference *s, const hci_solution *solution)
{
    const double delta = 0.7;
    problem q = *p;
    hci_solution other;
    for (size_t k = 0; k < q.emf_count; ++k)
        q.emf[k].phase += q.emf[k].order * delta;
    for (size_t k = 0; k < q.cogging_count; ++k)
        q.cogging[k].phase += q.cogging[k].order * delta;
    for (size_t k = 0; k < q.target_count; ++k) {
        hci_harmonic *h = &q.wanted[k].torque_Nm;
        turn_by(&h->sine, &h->cosine, h->order * delta);
    }
    turn_by(&q.held.sine, &q.held.cosine, delta);
    bind(&q);
    solve_well(&q, &other);
    for (size_t k = 0; k < other.current.count; ++k) {
        hci_wave *w = &other.current.wave[k];
        turn_by(&w->sine, &w->cosine, -w->order * delta);
    }
    TEST_ASSERT_DOUBLE_WITHIN(
        2.0 * current_bound_A(s), 0.0,
        wave_distance(other.current.wave, solution->current.wave, other.current.count, 1.0));
    hci_solution_release(&other);
}

/* ---- methods, remedies
 * ----------------------------------------------------------------------------------------- */

/* Named methods: the same currents where they apply, a clear answer where they do not. Returns 1 when both
 * LUs did. */
static int check_methods(const problem *p, const reference *s, const hci_solution *solution)
{
    static const hci_method METHOD[] = {HCI_METHOD_QR, HCI_METHOD_UMFPACK, HCI_METHOD_LU};
    const bool square = s->rows == s->unknowns && s->rows > 0;
    const bool regular = square && s->values.rank == s->rows;
    for (size_t k = 0; k < 3; ++k) {
        problem q = *p;
        hci_solution other;
        hci_status status;
        bind(&q);
        q.options.method = METHOD[k];
        status = solve(&q, &other);
        if (k > 0 && !square) {
            TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, status);
        }
        if (k > 0 && square && !regular) {
            TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, status);
        }
        if (k > 0 && !regular) {
            TEST_ASSERT_NULL(other.current.wave);
            continue;
        }
        TEST_ASSERT_TRUE(status <= HCI_NOT_REACHED);
        TEST_ASSERT_EQUAL_INT(METHOD[k], other.method);
        TEST_ASSERT_DOUBLE_WITHIN(
            current_bound_A(s), 0.0,
            wave_distance(other.current.wave, solution->current.wave, other.current.count, 1.0));
        hci_solution_release(&other);
    }
    return regular;
}

/* The remedy reaches the order, as strongly as any component can through one back-EMF wave; it is neither in
 * the set nor held, and it can flow. Expects samples of the machine. */
static void check_remedy(const problem *p, const reference *s, const hci_solved_order *o)
{
    const size_t m = sampled_bin(&samples, o->torque_Nm.order);
    double strongest = 0.0, response[2][2];
    for (size_t k = 0; k < p->emf_count; ++k)
        if (p->has_neutral || (int)p->emf[k].order % 3 != 0) strongest = fmax(strongest, p->emf[k].amplitude);
    for (int part = 0; part < 2; ++part) {
        const hci_wave unit = {o->remedy.order, o->remedy.sequence, 1.0 - part, part};
        sampled_currents(&samples, &unit, 1, false);
        sampled_spectrum(&samples, m + 1);
        response[part][0] = samples.sine[m];
        response[part][1] = samples.cosine[m];
    }
    /* A second wave may reach the same order and take some of it away: 0.07 at most. */
    for (int part = 0; part < 2 && m > 0; ++part)
        TEST_ASSERT_TRUE(hypot(response[part][0], response[part][1]) >= 0.9 * 1.5 * strongest);
    if (m == 0) {
        TEST_ASSERT_TRUE(hypot(response[0][1], response[1][1]) >= 0.9 * 1.5 * strongest);
    }
    TEST_ASSERT_TRUE(p->has_neutral || o->remedy.sequence != 0);
    for (size_t k = 0; k < s->components; ++k)
        TEST_ASSERT_FALSE(fabs(s->unit[k].order - o->remedy.order) < 1e-6 &&
                          s->unit[k].sequence == o->remedy.sequence);
    /* For the mean the remedy is the fundamental even where it is held: it is to be let go. */
    if (p->is_held && m > 0) {
        TEST_ASSERT_FALSE(fabs(o->remedy.order - 1.0) < 1e-6 && o->remedy.sequence == 1);
    }
}

/* ---- tests
 * ----------------------------------------------------------------------------------------------------- */

/* What a run of draws met, so that it cannot pass by meeting nothing. */
typedef struct {
    int clear, reached, missed, deficient, wide, square, remedies, verdict[5];
} tally;

static void check_draw(const problem *p, tally *t)
{
    static reference s;
    hci_solution solution;
    hci_status status;
    make_system(p, &s);
    status = solve_well(p, &solution);
    check_period(p, &solution);
    if (is_clear(&s)) {
        ++t->clear;
        t->deficient += s.values.rank < s.rows && s.values.rank < s.unknowns;
        t->wide += s.rows < s.unknowns;
        check_currents(p, &s, &solution);
        check_size(&s, &solution);
        check_split(p, &s, &solution);
        check_scaling(p, &s, &solution, status);
        check_rotation(p, &s, &solution);
        t->square += check_methods(p, &s, &solution);
    }
    sampled_currents(&samples, solution.current.wave, solution.current.count, true);
    sampled_spectrum(&samples, s.bins);
    check_residual(&s);
    TEST_ASSERT_EQUAL_INT(status == HCI_OK, check_orders(p, &s, &solution));
    ++*(status == HCI_OK ? &t->reached : &t->missed);
    for (size_t k = 0; k < solution.order_count; ++k) {
        ++t->verdict[solution.order[k].verdict];
        if (solution.order[k].verdict == HCI_ORDER_UNREACHABLE) check_remedy(p, &s, &solution.order[k]);
    }
    check_figures(p, &solution, status);
    hci_solution_release(&solution);
}

static void test_random_machines(void)
{
    uint64_t seed = 20210;
    tally t = {0};
    static problem p;
    for (int k = 0; k < DRAWS; ++k) {
        draw(&seed, k % 3 == 0, &p);
        check_draw(&p, &t);
    }
    /* So that it cannot pass by meeting nothing: 200, 35, 165, 50, 61, 14, and 18 of the rarest verdict, when
     * written. */
    TEST_ASSERT_TRUE(t.clear > 190 && t.reached > 20 && t.missed > 50 && t.deficient > 20 && t.wide > 20 &&
                     t.square > 8);
    for (int k = 0; k < 5; ++k)
        TEST_ASSERT_TRUE(t.verdict[k] > 10);
}

/* ---- the pointwise limit
 * ---------------------------------------------------------------------------------------- */

static void draw_whole(uint64_t *seed, size_t most_turns, problem *p)
{
    do {
        memset(p, 0, sizeof *p);
        draw_machine(seed, p);
        draw_target(seed, false, p);
    } while (p->turns > most_turns);
    bind(p);
    p->options.set = NULL;
}

/* i = (T* − T_cog) e⊥/(e⊥·e⊥) at every sample. 1e-7: orders above 512 are left out, and the orders of
 * 1/(e⊥·e⊥) fall by at least 0.7 for each 13. */
static double pointwise_distance(const problem *p, const double *wanted)
{
    double worst = 0.0, largest = 0.0;
    for (size_t j = 0; j < samples.count; ++j) {
        double e[3];
        const double square = sampled_normal(&samples, j, p->has_neutral, e);
        for (int s = 0; s < 3; ++s) {
            const double i = (wanted[j] - samples.cogging[j]) * e[s] / square;
            worst = ref_worse(worst, samples.i[s][j] - i);
            largest = fmax(largest, fabs(i));
        }
    }
    return worst / largest;
}

/* No other current of zero sum (or any, with a neutral) that makes the same torque at an angle is shorter:
 * what is added at right angles to e⊥ adds its own square. */
static void check_shortest(uint64_t *seed, const problem *p)
{
    for (int tries = 0; tries < 200; ++tries) {
        const size_t j = (size_t)ref_integer(seed, 0, (int)samples.count - 1);
        double e[3], d[3], mean = 0.0, along = 0.0, before = 0.0, after = 0.0;
        const double square = sampled_normal(&samples, j, p->has_neutral, e);
        for (int s = 0; s < 3; ++s)
            d[s] = ref_uniform(seed, -0.1, 0.1);
        for (int s = 0; s < 3 && !p->has_neutral; ++s)
            mean += d[s] / 3.0;
        for (int s = 0; s < 3; ++s)
            along += (d[s] - mean) * e[s] / square;
        for (int s = 0; s < 3; ++s) {
            const double i = samples.i[s][j];
            before += i * i;
            after += (i + d[s] - mean - along * e[s]) * (i + d[s] - mean - along * e[s]);
        }
        TEST_ASSERT_TRUE(after >= before * (1.0 - 1e-6));
    }
}

static void test_pointwise(void)
{
    static double wanted[SAMPLED_MOST];
    static problem p;
    uint64_t seed = 20211;
    for (int k = 0; k < 8; ++k) {
        hci_solution solution;
        draw_whole(&seed, 2, &p);
        p.options.method = HCI_METHOD_POINTWISE;
        p.options.strategy = HCI_STRATEGY_MTPA;
        TEST_ASSERT_EQUAL_INT(HCI_OK, solve_well(&p, &solution));
        TEST_ASSERT_EQUAL_INT(HCI_METHOD_POINTWISE, solution.method);
        sample_machine(&p, 2048);
        sample_target(&p, wanted);
        sampled_currents(&samples, solution.current.wave, solution.current.count, true);
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, 0.0, pointwise_distance(&p, wanted));
        check_shortest(&seed, &p);
        TEST_ASSERT_DOUBLE_WITHIN(
            1e-9, 1.0, sampled_mean_square(&samples) / sampled_limit(&samples, wanted, p.has_neutral));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, solution.loss_to_limit);
        hci_solution_release(&solution);
    }
}

static void test_held_fundamentals_that_cannot_be(void)
{
    static problem p;
    uint64_t seed = 20212;
    hci_solution solution;
    draw_whole(&seed, 1, &p);
    p.held = hci_wave_polar(1.0, 1, 2.0, 0.2);
    p.options.held = &p.held;
    p.options.method = HCI_METHOD_POINTWISE;
    p.options.strategy = HCI_STRATEGY_MTPA;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, solve(&p, &solution));
    TEST_ASSERT_NULL(solution.current.wave);
    p.options.method = HCI_METHOD_AUTO;
    p.held.sine = NAN;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, solve(&p, &solution));
}

/* ---- a chosen set without a limit to its size
 * ------------------------------------------------------------------- */

static double worst_bin(const double *wanted, size_t bins)
{
    double worst = 0.0;
    for (size_t j = 0; j < samples.count; ++j)
        samples.torque[j] -= wanted[j];
    sampled_spectrum(&samples, bins);
    for (size_t m = 0; m < bins; ++m)
        worst = ref_worse(worst, hypot(samples.sine[m], samples.cosine[m]));
    return worst;
}

static void test_auto(void)
{
    static double wanted[SAMPLED_MOST];
    static problem p;
    uint64_t seed = 20213;
    for (int k = 0; k < 16; ++k) {
        hci_solution solution;
        double top = 0.0;
        draw_whole(&seed, 2, &p);
        const hci_status status = solve_well(&p, &solution);
        for (size_t j = 0; j < solution.current.count; ++j)
            top = fmax(top, solution.current.wave[j].order);
        sample_machine(&p, 2048 / p.turns);
        sample_target(&p, wanted);
        sampled_currents(&samples, solution.current.wave, solution.current.count, true);
        TEST_ASSERT_TRUE(top + 13.0 < 1024.0 / (double)p.turns); /* no aliases */
        const double limit = sampled_limit(&samples, wanted, p.has_neutral);
        const double copper = sampled_mean_square(&samples);
        const double worst = worst_bin(wanted, samples.count / 2);
        TEST_ASSERT_EQUAL_INT(HCI_OK, status);
        TEST_ASSERT_TRUE(worst <= tolerance_of(&p));
        TEST_ASSERT_TRUE(copper <= 1.01 * limit && copper >= limit * (1.0 - 1e-4));
        hci_solution_release(&solution);
    }
}

/* ---- edges
 * ------------------------------------------------------------------------------------------------------ */

/* A machine of order 1 and cogging of order 6; the mean, and the sides of order 6. */
static void plain_problem(problem *p)
{
    memset(p, 0, sizeof *p);
    p->turns = 1;
    p->emf_count = p->cogging_count = p->target_count = 1;
    p->emf[0] = (ref_wave){1.0, 0.0, 0.5, 0.0};
    p->cogging[0] = (ref_wave){6.0, 0.0, 0.2, 1.0};
    p->wanted[0] = (hci_target_order){{0.0, 0.0, 3.0}, 1.0};
    add_component(p, (hci_component){5.0, -1}, HCI_SET_NEG);
    add_component(p, (hci_component){7.0, 1}, HCI_SET_POS);
    bind(p);
}

/* (3/2) E I = 3 N·m of mean; the cogging of 0.2 N·m shared by two components of I = 0.2/(2·1.5·0.5) each. */
static void test_closed_form(void)
{
    static problem p;
    hci_solution s;
    plain_problem(&p);
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve_well(&p, &s));
    TEST_ASSERT_EQUAL_UINT64(3, s.current.count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, s.current.wave[0].sine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2 / 1.5, hypot(s.current.wave[1].sine, s.current.wave[1].cosine));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2 / 1.5, hypot(s.current.wave[2].sine, s.current.wave[2].cosine));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5 * (16.0 + 2.0 * 0.04 / 2.25), s.mean_square_A2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, s.plain_amplitude_A);
    TEST_ASSERT_EQUAL_UINT64(3, s.rows);
    TEST_ASSERT_EQUAL_UINT64(6, s.unknowns);
    hci_solution_release(&s);
}

/* Order 3 by a direct current C of zero sequence, 3 C E, and by order 6 of it, (3/2) I E, whose order 9 is
 * not cared for. Their copper is 3 C² and (3/2) I², so the least of it has C = I = W/(4.5 E): W²/(4.5 E²). */
static void test_direct_current_of_zero_sequence(void)
{
    static problem p;
    hci_solution s;
    memset(&p, 0, sizeof p);
    p.turns = 1;
    p.has_neutral = true;
    p.emf_count = 2;
    p.emf[0] = (ref_wave){1.0, 0.0, 0.5, 0.0};
    p.emf[1] = (ref_wave){3.0, 0.0, 0.2, 0.3};
    p.target_count = 3;
    p.wanted[0] = (hci_target_order){{0.0, 0.0, 0.0}, 1.0};
    p.wanted[1] = (hci_target_order){{3.0, 0.9 * cos(0.3), 0.9 * sin(0.3)}, 1.0};
    p.wanted[2] = (hci_target_order){{9.0, 0.0, 0.0}, 0.0};
    add_component(&p, (hci_component){0.0, 0}, HCI_SET_ZERO);
    add_component(&p, (hci_component){6.0, 0}, HCI_SET_ZERO);
    bind(&p);
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve_well(&p, &s));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.9 * 0.9 / (4.5 * 0.2 * 0.2), s.mean_square_A2);
    hci_solution_release(&s);
}

/* Without a mean the largest cogging is the measure, and there is no plain fundamental to compare with. */
static void test_no_mean(void)
{
    static problem p;
    hci_solution s;
    plain_problem(&p);
    p.wanted[0].torque_Nm.cosine = 0.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve_well(&p, &s));
    TEST_ASSERT_DOUBLE_WITHIN(1e-18, 0.2e-6, s.tolerance_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, s.plain_amplitude_A);
    TEST_ASSERT_TRUE(isnan(s.loss_to_plain));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, s.current.wave[0].sine);
    hci_solution_release(&s);
}

/* e₁ and e₅ of one size cancel at e^{j6θ} = −1: no pointwise limit, but a harmonic solution. */
static void test_vanishing_back_emf(void)
{
    static problem p;
    hci_solution s;
    plain_problem(&p);
    p.emf_count = 2;
    p.emf[1] = (ref_wave){5.0, 0.0, 0.5, 0.0};
    bind(&p);
    solve_well(&p, &s);
    TEST_ASSERT_TRUE(isnan(s.limit_mean_square_A2));
    TEST_ASSERT_TRUE(isnan(s.loss_to_limit));
    hci_solution_release(&s);
    p.options.set = NULL;
    p.options.method = HCI_METHOD_POINTWISE;
    p.options.strategy = HCI_STRATEGY_MTPA;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_NUMERIC, solve(&p, &s));
    TEST_ASSERT_NULL(s.current.wave);
    p.options.method = HCI_METHOD_AUTO;
    p.options.choose_at_most = 4;
    solve_well(&p, &s);
    TEST_ASSERT_TRUE(s.current.count > 0 && s.current.count <= 4);
    hci_solution_release(&s);
}

/* 5 negative and 13 positive both make orders 6 and 12, by e₁ and e₇; with e₁ and e₇ of one size the two are
 * dependent, but elimination leaves rounding where a zero belongs. A named LU refuses, the library left to
 * itself goes round it. */
static void test_singular_to_working_precision(void)
{
    static problem p;
    hci_solution s;
    uint64_t seed = 20214;
    for (int k = 0; k < 50; ++k) {
        plain_problem(&p);
        p.is_held = true;
        p.held = hci_wave_polar(1.0, 1, 4.0, 0.1);
        p.emf_count = p.cogging_count = 2;
        p.emf[0].phase = ref_uniform(&seed, -3.0, 3.0);
        p.emf[1] = (ref_wave){7.0, 0.0, p.emf[0].amplitude, ref_uniform(&seed, -3.0, 3.0)};
        p.cogging[1] = (ref_wave){12.0, 0.0, 0.1, 0.0};
        p.component[1] = (hci_component){13.0, 1};
        p.options.compare = HCI_COMPARE_SQUARE;
        bind(&p);
        solve_well(&p, &s);
        TEST_ASSERT_EQUAL_INT(HCI_METHOD_QR, s.method);
        TEST_ASSERT_EQUAL_UINT64(4, s.unknowns);
        TEST_ASSERT_EQUAL_UINT64(2, s.rank);
        hci_solution_release(&s);
        p.options.method = HCI_METHOD_LU;
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, solve(&p, &s));
        p.options.method = HCI_METHOD_UMFPACK;
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, solve(&p, &s));
    }
}

/* A back-EMF far from a sine and nothing but the mean wanted: orders far above those of the machine are
 * needed. */
static void test_auto_goes_high(void)
{
    static problem p;
    hci_solution s;
    double top = 0.0;
    plain_problem(&p);
    p.cogging_count = 0;
    p.emf_count = 3;
    p.emf[1] = (ref_wave){5.0, 0.0, 0.15, 0.0};
    p.emf[2] = (ref_wave){7.0, 0.0, 0.10, 0.0};
    bind(&p);
    p.options.set = NULL;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve_well(&p, &s));
    for (size_t k = 0; k < s.current.count; ++k)
        top = fmax(top, s.current.wave[k].order);
    TEST_ASSERT_TRUE(top > 8.0);
    TEST_ASSERT_TRUE(s.loss_to_limit <= 1.01);
    hci_solution_release(&s);
}

static void test_refusals(void)
{
    static problem p;
    hci_solution s;
    plain_problem(&p);
    p.machine.has_effects = true;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, solve(&p, &s));
    plain_problem(&p);
    p.cogging[0].order = 0.3333; /* meant as a third, written too short */
    bind(&p);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, solve(&p, &s));
    plain_problem(&p);
    p.is_held = true;
    p.held = hci_wave_polar(7.0, 1, 2.0, 0.0); /* is in the set too */
    bind(&p);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, solve(&p, &s));
    TEST_ASSERT_NULL(s.current.wave);
    plain_problem(&p); /* a set, and what has no use for one */
    p.options.choose_at_most = 2;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, solve(&p, &s));
    p.options.choose_at_most = 0;
    p.options.method = HCI_METHOD_POINTWISE;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, solve(&p, &s));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_random_machines);
    RUN_TEST(test_pointwise);
    RUN_TEST(test_held_fundamentals_that_cannot_be);
    RUN_TEST(test_auto);
    RUN_TEST(test_closed_form);
    RUN_TEST(test_direct_current_of_zero_sequence);
    RUN_TEST(test_no_mean);
    RUN_TEST(test_vanishing_back_emf);
    RUN_TEST(test_singular_to_working_precision);
    RUN_TEST(test_auto_goes_high);
    RUN_TEST(test_refusals);
    return UNITY_END();
}
