/* The choice of at most K components against a search over all subsets, on problems with few candidates. The
 * search has its own system (sampled unit currents), its own candidates and its own solver; it shares only
 * the criterion: copper within the allowance first, then the smallest worst order with the mean counted
 * tenfold, or less copper where both are exact. test_choose_at_length has more problems. */
#include "hci/host/solve/solve.h"

#include <string.h>

#include "support/jacobi.h"
#include "support/sampled.h"
#include "unity.h"

/* Candidates up to order 18 + 2·7 = 32, doubled while there are few of them, and a back-EMF up to 7 make
 * torque up to 71 < 96. */
enum {
    PER_TURN = 192,
    BINS = PER_TURN / 2,
    MOST = 12,
    MOST_K = 4,
    ROWS = 2 * BINS,
#ifdef AT_LENGTH
    PROBLEMS = 24,
#else
    PROBLEMS = 2,
#endif
    LAWSON = 60,
    TERMS = 4
};

typedef struct {
    ref_wave emf[TERMS], cogging[TERMS];
    size_t emf_count, cogging_count;
    hci_wave back_emf[TERMS];
    hci_harmonic cogging_Nm[TERMS];
    hci_target_order wanted[2];
    hci_machine_data machine;
    hci_target target;
} problem;

/* All candidates with U and h; the mean's row is tenfold. Rows of bin b: first[b] and, but for bin 0, the
 * next. */
typedef struct {
    size_t count, rows;
    hci_component component[MOST + 1];
    double u[2 * MOST][ROWS], h[ROWS], diagonal;
    size_t first[BINS];
    bool used[BINS];
    double limit_A2, mean_Nm;
} candidates;

typedef struct {
    double worst_Nm, copper_A2;
} set_cost;

static sampled samples;

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- problems
 * -------------------------------------------------------------------------------------------------- */

static int sequence_of(double order)
{
    const int rest = (int)order % 3;
    return rest == 2 ? -1 : rest;
}

static void draw(uint64_t *seed, problem *p)
{
    const int kind = ref_integer(seed, 0, 2);
    memset(p, 0, sizeof *p);
    p->emf[p->emf_count++] = (ref_wave){1.0, 0.0, 0.5, ref_uniform(seed, -1.0, 1.0)};
    if (kind != 1)
        p->emf[p->emf_count++] =
            (ref_wave){5.0, 0.0, ref_uniform(seed, 0.02, 0.12), ref_uniform(seed, -3.0, 3.0)};
    if (kind != 0)
        p->emf[p->emf_count++] =
            (ref_wave){7.0, 0.0, ref_uniform(seed, 0.02, 0.12), ref_uniform(seed, -3.0, 3.0)};
    for (int order = 6; order <= 18; order += 6)
        if (ref_integer(seed, 0, 2) > 0)
            p->cogging[p->cogging_count++] =
                (ref_wave){order, 0.0, ref_uniform(seed, 0.02, 0.4), ref_uniform(seed, -3.0, 3.0)};
    p->wanted[0] = (hci_target_order){{0.0, 0.0, 3.0}, 1.0};
    p->wanted[1] =
        (hci_target_order){{12.0, ref_uniform(seed, -0.3, 0.3), ref_uniform(seed, -0.3, 0.3)}, 1.0};
    for (size_t k = 0; k < p->emf_count; ++k)
        p->back_emf[k] = hci_wave_polar(p->emf[k].order, sequence_of(p->emf[k].order), p->emf[k].amplitude,
                                        p->emf[k].phase);
    for (size_t k = 0; k < p->cogging_count; ++k)
        p->cogging_Nm[k] =
            hci_harmonic_polar(p->cogging[k].order, p->cogging[k].amplitude, p->cogging[k].phase);
    p->machine.model = (hci_machine){1, p->back_emf, p->emf_count, p->cogging_Nm, p->cogging_count, NULL, 0};
    p->machine.back_emf = p->back_emf;
    p->machine.cogging = p->cogging_Nm;
    p->target = (hci_target){p->wanted, (size_t)ref_integer(seed, 1, 2)};
}

/* Marks the orders that a component reaches, or tells whether one is marked already. */
static bool reach(const problem *p, hci_component c, bool *order, bool mark)
{
    bool found = false;
    for (size_t k = 0; k < p->emf_count; ++k) {
        const int rho = sequence_of(p->emf[k].order);
        if (rho != c.sequence && rho != -c.sequence) continue;
        const size_t n =
            (size_t)(rho == c.sequence ? fabs(c.order - p->emf[k].order) : c.order + p->emf[k].order);
        found = found || order[n];
        if (mark) order[n] = true;
    }
    return found;
}

/* Every component up to the top order that hangs together with a wanted or disturbed order. */
static void list_candidates(const problem *p, candidates *c)
{
    bool order[BINS] = {true}, taken[2][BINS] = {{false}};
    double top = 1.0, top_emf = 1.0;
    for (size_t k = 0; k < p->target.count; ++k)
        top = fmax(top, p->wanted[k].torque_Nm.order);
    for (size_t k = 0; k < p->cogging_count; ++k)
        top = fmax(top, p->cogging[k].order);
    for (size_t k = 0; k < p->emf_count; ++k)
        top_emf = fmax(top_emf, p->emf[k].order);
    for (size_t k = 0; k < p->target.count; ++k)
        order[(size_t)p->wanted[k].torque_Nm.order] = true;
    for (size_t k = 0; k < p->cogging_count; ++k)
        order[(size_t)p->cogging[k].order] = true;
    for (bool grown = true; grown;) {
        grown = false;
        for (size_t n = 0; n <= (size_t)(top + 2.0 * top_emf); ++n)
            for (int side = n == 0; side < 2; ++side) {
                const hci_component one = {(double)n, side == 0 ? -1 : 1};
                if (taken[side][n] || !reach(p, one, order, false)) continue;
                reach(p, one, order, true);
                taken[side][n] = grown = true;
                TEST_ASSERT_TRUE(c->count < MOST);
                c->component[c->count++] = one;
            }
    }
}

static void fill_rows(const problem *p, candidates *c)
{
    double sine[2 * MOST][BINS], cosine[2 * MOST][BINS], h_sine[BINS], h_cosine[BINS];
    for (size_t j = 0; j < 2 * c->count; ++j) {
        const hci_wave unit = {c->component[j / 2].order, c->component[j / 2].sequence, j % 2 == 0,
                               j % 2 == 1};
        sampled_currents(&samples, &unit, 1, 0);
        sampled_spectrum(&samples, BINS);
        memcpy(sine[j], samples.sine, sizeof sine[j]);
        memcpy(cosine[j], samples.cosine, sizeof cosine[j]);
    }
    sampled_currents(&samples, NULL, 0, 1);
    sampled_spectrum(&samples, BINS);
    for (size_t b = 0; b < BINS; ++b) {
        h_sine[b] = -samples.sine[b];
        h_cosine[b] = -samples.cosine[b];
    }
    for (size_t k = 0; k < p->target.count; ++k) {
        h_sine[(size_t)p->wanted[k].torque_Nm.order] += p->wanted[k].torque_Nm.sine;
        h_cosine[(size_t)p->wanted[k].torque_Nm.order] += p->wanted[k].torque_Nm.cosine;
    }
    for (size_t b = 0; b < BINS; ++b) {
        const double scale = b == 0 ? 10.0 : 1.0;
        c->used[b] = hypot(h_sine[b], h_cosine[b]) > 1e-12;
        for (size_t j = 0; j < 2 * c->count; ++j)
            c->used[b] = c->used[b] || hypot(sine[j][b], cosine[j][b]) > 1e-12;
        if (!c->used[b]) continue;
        c->first[b] = c->rows;
        for (int part = b == 0; part < 2; ++part, ++c->rows) {
            c->h[c->rows] = scale * (part == 0 ? h_sine[b] : h_cosine[b]);
            for (size_t j = 0; j < 2 * c->count; ++j)
                c->u[j][c->rows] = scale * (part == 0 ? sine[j][b] : cosine[j][b]);
        }
    }
}

static void make_candidates(const problem *p, candidates *c)
{
    static double wanted[SAMPLED_MOST];
    memset(c, 0, sizeof *c);
    list_candidates(p, c);
    sampled_machine(&samples, 1, 1024, p->emf, p->emf_count, p->cogging, p->cogging_count);
    memset(wanted, 0, sizeof wanted);
    for (size_t k = 0; k < p->target.count; ++k)
        sampled_add(&samples, p->wanted[k].torque_Nm.order, p->wanted[k].torque_Nm.sine,
                    p->wanted[k].torque_Nm.cosine, 0.0, wanted);
    c->limit_A2 = sampled_limit(&samples, wanted, 0);
    c->mean_Nm = p->wanted[0].torque_Nm.cosine;
    sampled_machine(&samples, 1, PER_TURN, p->emf, p->emf_count, p->cogging, p->cogging_count);
    fill_rows(p, c);
    for (size_t j = 0; j < 2 * c->count; ++j) {
        double square = 0.0;
        for (size_t i = 0; i < c->rows; ++i)
            square += c->u[j][i] * c->u[j][i];
        c->diagonal = fmax(c->diagonal, square);
    }
}

/* ---- one subset
 * ------------------------------------------------------------------------------------------------ */

static double amplitude_at(const candidates *c, const double *r, size_t b)
{
    return b == 0 ? fabs(r[c->first[0]]) : hypot(r[c->first[b]], r[c->first[b] + 1]);
}

/* r = U x − h over the subset; the cost of x. */
static set_cost cost_of(const candidates *c, const size_t *pick, size_t count, const double *x, double *r)
{
    set_cost w = {0.0, 0.0};
    for (size_t i = 0; i < c->rows; ++i)
        r[i] = -c->h[i];
    for (size_t j = 0; j < 2 * count; ++j) {
        for (size_t i = 0; i < c->rows; ++i)
            r[i] += c->u[2 * pick[j / 2] + j % 2][i] * x[j];
        w.copper_A2 += 1.5 * x[j] * x[j];
    }
    for (size_t b = 0; b < BINS; ++b)
        if (c->used[b]) w.worst_Nm = fmax(w.worst_Nm, amplitude_at(c, r, b));
    return w;
}

/* (UᵀWU + ρI) x = UᵀWh by elimination; the matrix is positive definite. */
static void weighted(const candidates *c, const size_t *pick, size_t count, const double *weight,
                     double ridge, double *x)
{
    double a[2 * MOST_K][2 * MOST_K];
    const size_t n = 2 * count;
    for (size_t i = 0; i < n; ++i) {
        const double *ui = c->u[2 * pick[i / 2] + i % 2];
        x[i] = 0.0;
        for (size_t q = 0; q < c->rows; ++q)
            x[i] += ui[q] * weight[q] * c->h[q];
        for (size_t j = 0; j < n; ++j) {
            const double *uj = c->u[2 * pick[j / 2] + j % 2];
            a[i][j] = i == j ? ridge : 0.0;
            for (size_t q = 0; q < c->rows; ++q)
                a[i][j] += ui[q] * weight[q] * uj[q];
        }
    }
    for (size_t k = 0; k < n; ++k)
        for (size_t i = k + 1; i < n; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (size_t j = k; j < n; ++j)
                a[i][j] -= factor * a[k][j];
            x[i] -= factor * x[k];
        }
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; ++j)
            x[i] -= a[i][j] * x[j];
        x[i] /= a[i][i];
    }
}

static bool is_better(set_cost a, set_cost b, double tolerance_Nm, double allowed_A2)
{
    if ((a.copper_A2 <= allowed_A2) != (b.copper_A2 <= allowed_A2)) return a.copper_A2 <= allowed_A2;
    if (a.copper_A2 > allowed_A2) return a.copper_A2 < b.copper_A2;
    if (a.worst_Nm <= tolerance_Nm && b.worst_Nm <= tolerance_Nm) return a.copper_A2 < b.copper_A2;
    return a.worst_Nm < b.worst_Nm;
}

/* Weights move to where the error is largest. Gives up where even the least squares cannot beat `best`: the
 * worst of B orders is at least ‖r‖/√B. */
static set_cost smallest_worst_order(const candidates *c, const size_t *pick, size_t count, double ridge,
                                     double tolerance_Nm, double allowed_A2)
{
    double weight[ROWS], order_weight[BINS], x[2 * MOST_K], r[ROWS];
    set_cost best = {HUGE_VAL, HUGE_VAL};
    for (size_t b = 0; b < BINS; ++b)
        order_weight[b] = 1.0;
    for (int step = 0; step < LAWSON; ++step) {
        double sum = 0.0;
        size_t orders = 0;
        for (size_t b = 0; b < BINS; ++b)
            for (size_t i = 0; c->used[b] && i < (b == 0 ? 1 : 2); ++i)
                weight[c->first[b] + i] = order_weight[b];
        weighted(c, pick, count, weight, ridge, x);
        const set_cost w = cost_of(c, pick, count, x, r);
        if (is_better(w, best, tolerance_Nm, allowed_A2)) best = w;
        if (w.worst_Nm <= 0.0) break;
        for (size_t b = 0; b < BINS; ++b) {
            if (!c->used[b]) continue;
            order_weight[b] *= amplitude_at(c, r, b) / w.worst_Nm + 1e-9;
            sum += order_weight[b];
            ++orders;
        }
        for (size_t b = 0; b < BINS; ++b)
            order_weight[b] *= (double)orders / sum;
    }
    return best;
}

static set_cost least_squares(const candidates *c, const size_t *pick, size_t count, double *bound_Nm)
{
    double u[ROWS * 2 * MOST_K], x[2 * MOST_K] = {0.0}, r[ROWS], square = 0.0, orders = 0.0;
    for (size_t j = 0; j < 2 * count; ++j)
        memcpy(u + j * c->rows, c->u[2 * pick[j / 2] + j % 2], c->rows * sizeof *u);
    jacobi_solve(c->rows, 2 * count, u, 1e-11, 1, c->h, x);
    const set_cost w = cost_of(c, pick, count, x, r);
    for (size_t i = 0; i < c->rows; ++i)
        square += r[i] * r[i];
    for (size_t b = 0; b < BINS; ++b)
        orders += c->used[b];
    *bound_Nm = sqrt(square / orders);
    return w;
}

/* ---- all subsets
 * ----------------------------------------------------------------------------------------------- */

static bool next_subset(size_t *pick, size_t count, size_t all)
{
    for (size_t k = count; k-- > 0;) {
        if (pick[k] == all - count + k) continue;
        ++pick[k];
        for (size_t j = k + 1; j < count; ++j)
            pick[j] = pick[j - 1] + 1;
        return true;
    }
    return false;
}

static set_cost search_all(const candidates *c, size_t count, double tolerance_Nm, double allowed_A2)
{
    static const double PRICE[] = {3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-6};
    size_t pick[MOST_K] = {0, 1, 2, 3};
    set_cost best = {HUGE_VAL, HUGE_VAL};
    do {
        double bound_Nm;
        const set_cost exact = least_squares(c, pick, count, &bound_Nm);
        if (is_better(exact, best, tolerance_Nm, allowed_A2)) best = exact;
        if (bound_Nm > fmax(best.worst_Nm, tolerance_Nm) && best.copper_A2 <= allowed_A2) continue;
        for (size_t k = 0; k < sizeof PRICE / sizeof PRICE[0]; ++k) {
            const set_cost w = smallest_worst_order(c, pick, count, PRICE[k] * c->diagonal / 100.0,
                                                    tolerance_Nm, allowed_A2);
            if (is_better(w, best, tolerance_Nm, allowed_A2)) best = w;
        }
    } while (next_subset(pick, count, c->count));
    return best;
}

/* ---- the library's choice
 * --------------------------------------------------------------------------------------- */

static set_cost choose(const problem *p, const hci_wave *held, size_t most, double allowance, hci_solution *s)
{
    hci_note note = {{0}};
    hci_solve_options options = {0};
    set_cost w = {0.0, 0.0};
    options.target = &p->target;
    options.held = held;
    options.choose_at_most = most;
    options.loss_allowance = allowance;
    const hci_status status = hci_solve(&p->machine, &options, s, &note);
    TEST_ASSERT_TRUE_MESSAGE(status <= HCI_NOT_REACHED, note.text);
    TEST_ASSERT_TRUE(s->current.count <= most + (held != NULL));
    sampled_currents(&samples, s->current.wave, s->current.count, 1);
    sampled_spectrum(&samples, BINS);
    for (size_t k = 0; k < p->target.count; ++k) {
        samples.sine[(size_t)p->wanted[k].torque_Nm.order] -= p->wanted[k].torque_Nm.sine;
        samples.cosine[(size_t)p->wanted[k].torque_Nm.order] -= p->wanted[k].torque_Nm.cosine;
    }
    for (size_t b = 0; b < BINS; ++b)
        w.worst_Nm = fmax(w.worst_Nm, (b == 0 ? 10.0 : 1.0) * hypot(samples.sine[b], samples.cosine[b]));
    w.copper_A2 = sampled_mean_square(&samples);
    return w;
}

/* At length 24 problems for each K. When written the choice was within 10 % of the best of all subsets in 24,
 * 23, 24 and 24 of them (1 % in 24, 22, 21, 22), 1.26 times the best at worst; it is a search by elimination
 * and exchange and may miss. */
static void test_against_all_subsets(void)
{
    static candidates c;
    static problem p;
    uint64_t seed = 20220;
    int within[MOST_K + 1] = {0};
    for (int k = 0; k < PROBLEMS; ++k) {
        draw(&seed, &p);
        make_candidates(&p, &c);
        const double tolerance_Nm = 1e-6 * c.mean_Nm, allowed_A2 = 1.1 * c.limit_A2;
        for (size_t most = 1; most <= MOST_K; ++most) {
            hci_solution s;
            const set_cost ours = choose(&p, NULL, most, 0.0, &s);
            const set_cost best = search_all(&c, most, tolerance_Nm, allowed_A2);
            const double ratio = ours.worst_Nm / fmax(best.worst_Nm, tolerance_Nm);
            within[most] += ratio <= 1.1;
            TEST_ASSERT_TRUE(ratio <= 1.5);
            if (ours.worst_Nm <= tolerance_Nm && best.worst_Nm <= tolerance_Nm) {
                TEST_ASSERT_TRUE(ours.copper_A2 <= 1.02 * best.copper_A2);
            }
            hci_solution_release(&s);
        }
    }
    for (size_t most = 1; most <= MOST_K; ++most)
        TEST_ASSERT_TRUE(within[most] >= PROBLEMS - PROBLEMS / 12);
}

/* One more component is never worse, beyond being exact. Also where K is more than there are. */
static void test_more_components_are_not_worse(void)
{
    static candidates c;
    static problem p;
    uint64_t seed = 20221;
    for (int k = 0; k < PROBLEMS / 2; ++k) {
        double before_Nm = HUGE_VAL;
        draw(&seed, &p);
        make_candidates(&p, &c);
        for (size_t most = 1; most <= c.count + 3; ++most) {
            hci_solution s;
            const set_cost w = choose(&p, NULL, most, 0.0, &s);
            TEST_ASSERT_TRUE(s.current.count <= most);
            TEST_ASSERT_TRUE(w.worst_Nm <= fmax(1e-6 * c.mean_Nm, before_Nm * (1.0 + 1e-6)));
            before_Nm = w.worst_Nm;
            hci_solution_release(&s);
        }
    }
}

/* The allowance is kept; one or two components alone may need more for the mean torque itself (1.107 of the
 * limit at most when written), and the ratio says so. The mean is not given up for less ripple: 3.1 % of it
 * at most. */
static void test_allowance_and_mean(void)
{
    static const double ALLOWANCE[] = {1.03, 1.1, 1.5};
    static candidates c;
    static problem p;
    uint64_t seed = 20222;
    for (int k = 0; k < PROBLEMS / 2; ++k) {
        draw(&seed, &p);
        make_candidates(&p, &c);
        for (size_t most = 1; most <= MOST_K; ++most)
            for (size_t q = 0; q < 3; ++q) {
                hci_solution s;
                const set_cost w = choose(&p, NULL, most, ALLOWANCE[q], &s);
                TEST_ASSERT_DOUBLE_WITHIN(1e-9, w.copper_A2 / c.limit_A2, s.loss_to_limit);
                TEST_ASSERT_TRUE(w.copper_A2 <=
                                 fmax(ALLOWANCE[q], most > 2 ? 0.0 : 1.12) * c.limit_A2 * (1.0 + 1e-9));
                TEST_ASSERT_TRUE(fabs(samples.cosine[0]) <= 0.05 * c.mean_Nm);
                hci_solution_release(&s);
            }
    }
}

/* With another unit of the current the same components are chosen, few or all, with the same currents in it.
 */
static void test_any_unit_of_the_current(void)
{
    static problem p, other;
    uint64_t seed = 20224;
    const double unit = ldexp(1.0, -30);
    for (int k = 0; k < 2 * PROBLEMS; ++k) {
        hci_note note = {{0}};
        hci_solution s, small;
        draw(&seed, &p);
        other = p;
        for (size_t j = 0; j < p.emf_count; ++j) {
            other.back_emf[j].sine /= unit;
            other.back_emf[j].cosine /= unit;
        }
        other.machine.model.back_emf = other.machine.back_emf = other.back_emf;
        hci_solve_options options = {.target = &p.target, .choose_at_most = k % 2 ? 3 : 0};
        TEST_ASSERT_TRUE(hci_solve(&p.machine, &options, &s, &note) <= HCI_NOT_REACHED);
        TEST_ASSERT_TRUE(hci_solve(&other.machine, &options, &small, &note) <= HCI_NOT_REACHED);
        TEST_ASSERT_EQUAL_UINT64(s.current.count, small.current.count);
        for (size_t j = 0; j < s.current.count; ++j) {
            const hci_wave *a = &s.current.wave[j], *b = &small.current.wave[j];
            TEST_ASSERT_TRUE(a->order == b->order && a->sequence == b->sequence);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, a->sine, b->sine / unit);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, a->cosine, b->cosine / unit);
        }
        hci_solution_release(&s);
        hci_solution_release(&small);
    }
}

/* A fundamental that is held stays as it is, beside at most K others, and is not chosen a second time. */
static void test_beside_a_held_fundamental(void)
{
    static candidates c;
    static problem p;
    uint64_t seed = 20223;
    for (int k = 0; k < PROBLEMS; ++k) {
        hci_solution s;
        hci_wave held;
        set_cost plain, w;
        draw(&seed, &p);
        make_candidates(&p, &c);
        held = hci_wave_polar(1.0, 1, c.mean_Nm / (1.5 * 0.5), p.emf[0].phase);
        plain = choose(&p, &held, 1, 0.0, &s);
        hci_solution_release(&s);
        w = choose(&p, &held, MOST_K, 0.0, &s);
        TEST_ASSERT_EQUAL_MEMORY(&held, &s.current.wave[0], sizeof held);
        for (size_t j = 1; j < s.current.count; ++j)
            TEST_ASSERT_FALSE(s.current.wave[j].order == 1.0 && s.current.wave[j].sequence == 1);
        TEST_ASSERT_TRUE(w.worst_Nm <= plain.worst_Nm * (1.0 + 1e-6));
        TEST_ASSERT_NULL(s.per_Nm);
        hci_solution_release(&s);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_against_all_subsets);
    RUN_TEST(test_more_components_are_not_worse);
    RUN_TEST(test_allowance_and_mean);
    RUN_TEST(test_any_unit_of_the_current);
    RUN_TEST(test_beside_a_held_fundamental);
    return UNITY_END();
}
