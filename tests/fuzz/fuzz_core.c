/* Numbers of any size for what runs on a microcontroller: refused, or the laws hold, each with the error that
 * rounding explains.
 *
 *   lu         P A = L U within n·2⁻⁵²·|L||U|, and A x = b within the same times |x|
 *   strategy   the current makes the torque, and no ray has a shorter one that does
 *   table      between two rows nothing is beyond them
 *   learn      any blob and any samples: nothing outside the memory that is given; what is written is read
 * back */
#include "draws.h"
#include "fuzzing.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "hci/learn.h"
#include "hci/machine/strategy.h"
#include "hci/math/dense.h"

/* Zeros, ones and numbers of ordinary size, and now and then any power of ten up to 1e±span. */
static double draw_number(int span)
{
    const unsigned kind = draw(8);
    if (kind == 0) return 0.0;
    if (kind == 1) return 1.0;
    const double value = ((double)draw(65536) - 32768.0) / 4096.0;
    return kind == 2 ? value * pow(10.0, (double)draw((unsigned)(2 * span + 1)) - span) : value;
}

/* ---- lu ---- */

enum { MOST_N = 8 };

typedef struct {
    size_t n, pivot[MOST_N];
    double a[MOST_N * MOST_N], lu[MOST_N * MOST_N];
} factored;

/* (L U)(i, j), and the sum of its terms' sizes. */
static long double product_at(const factored *f, size_t i, size_t j, long double *size)
{
    long double sum = 0.0L;
    *size = 0.0L;
    for (size_t k = 0; k <= (i < j ? i : j); ++k) {
        const long double term = (k == i ? 1.0L : (long double)f->lu[i + k * f->n]) * f->lu[k + j * f->n];
        sum += term;
        *size += fabsl(term);
    }
    return sum;
}

static void check_factors(factored *f)
{
    double moved[MOST_N * MOST_N];
    const size_t n = f->n;
    memcpy(moved, f->a, sizeof moved);
    for (size_t k = 0; k < n; ++k)
        for (size_t j = 0; j < n; ++j) {
            const double kept = moved[k + j * n];
            moved[k + j * n] = moved[f->pivot[k] + j * n];
            moved[f->pivot[k] + j * n] = kept;
        }
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i) {
            long double size, made = product_at(f, i, j, &size);
            fuzz_require(fabsl(made - moved[i + j * n]) <=
                             2.0L * (long double)n * (long double)DBL_EPSILON * size + 1e-290L,
                         "P A = L U");
            fuzz_require(i <= j || fabs(f->lu[i + j * n]) <= 1.0, "no multiplier above 1");
        }
}

/* |b − A x| within the rounding of |L||U||x|, all of it added up; transposed, x goes by the rows before their
 * exchange, so its largest counts. */
static void check_solved(const factored *f, const double *b, const double *x, bool transposed)
{
    long double most = 0.0L, largest = 0.0L;
    for (size_t i = 0; i < f->n; ++i)
        largest = fmaxl(largest, fabsl((long double)x[i]));
    for (size_t i = 0; i < f->n; ++i)
        for (size_t j = 0; j < f->n; ++j) {
            long double size;
            product_at(f, i, j, &size);
            most += size * (transposed ? largest : fabsl((long double)x[j]));
        }
    for (size_t i = 0; i < f->n; ++i) {
        long double left = b[i];
        for (size_t j = 0; j < f->n; ++j)
            left -= (long double)f->a[transposed ? j + i * f->n : i + j * f->n] * x[j];
        fuzz_require(fabsl(left) <= 6.0L * (long double)f->n * (long double)DBL_EPSILON * most + 1e-280L,
                     transposed ? "Aᵀ x = b" : "A x = b");
    }
}

static bool is_ordinary(const double *x, size_t n)
{
    for (size_t k = 0; k < n; ++k)
        if (!(fabs(x[k]) < 1e280)) return false;
    return true;
}

static void try_lu(void)
{
    factored f = {.n = 1 + draw(MOST_N)};
    double b[MOST_N], x[MOST_N];
    for (size_t k = 0; k < f.n * f.n; ++k)
        f.a[k] = draw_number(40);
    memcpy(f.lu, f.a, sizeof f.lu);
    if (hci_lu_factor(f.n, f.lu, f.pivot) != HCI_OK) return;
    check_factors(&f);
    for (size_t k = 0; k < f.n; ++k)
        b[k] = draw_number(40);
    for (int transposed = 0; transposed < 2; ++transposed) {
        memcpy(x, b, sizeof x);
        if (transposed)
            hci_lu_solve_transposed(f.n, f.lu, f.pivot, x);
        else
            hci_lu_solve(f.n, f.lu, f.pivot, x);
        if (is_ordinary(x, f.n)) check_solved(&f, b, x, transposed == 1);
    }
}

/* ---- strategy ---- */

/* Largest terms that the torque of x is a sum of. */
static double terms_Nm(const hci_machine_point *p, const double x[2])
{
    const double length = hypot(x[0], x[1]),
                 slope = fabs(p->slope[0]) + 2.0 * fabs(p->slope[1]) + fabs(p->slope[2]);
    return hypot(p->e[0], p->e[1]) * length + slope * length * length + fabs(p->cogging_Nm);
}

/* The least length on a ray that makes the torque; infinite where none does. */
static double length_on_ray(const hci_machine_point *p, double torque_Nm, double angle)
{
    const double u[2] = {cos(angle), sin(angle)}, c = p->cogging_Nm - torque_Nm;
    const double b = p->e[0] * u[0] + p->e[1] * u[1];
    const double a =
        0.5 * p->slope[0] * u[0] * u[0] + p->slope[1] * u[0] * u[1] + 0.5 * p->slope[2] * u[1] * u[1];
    const double square = b * b - 4.0 * a * c;
    if (square < 0.0) return INFINITY;
    const double q = -0.5 * (b + copysign(sqrt(square), b));
    const double first = a != 0.0 ? q / a : (double)INFINITY, second = q != 0.0 ? c / q : (double)INFINITY;
    return fmin(first > 0.0 ? first : (double)INFINITY, second > 0.0 ? second : (double)INFINITY);
}

/* Whether a current on a ray makes the torque. Of a long one whose large terms cancel rounding does not let
 * that be told. */
static bool is_made(const hci_machine_point *p, double torque_Nm, double length, double angle)
{
    const double x[2] = {length * cos(angle), length * sin(angle)};
    const double rounding_Nm = 8.0 * DBL_EPSILON * terms_Nm(p, x);
    return fabs(hci_point_torque_Nm(p, x) - torque_Nm) + rounding_Nm <=
           1e-6 * fabs(torque_Nm - p->cogging_Nm);
}

static void check_shortest(const hci_machine_point *p, double torque_Nm, const double x[2], hci_status status)
{
    const double length = status == HCI_OK ? hypot(x[0], x[1]) * (1.0 - 1e-6) - 1e-9 : 1e9;
    for (int k = 0; k < 32; ++k) {
        const double angle = 0.19634954 * k, on_ray = length_on_ray(p, torque_Nm, angle);
        if (on_ray < length && is_made(p, torque_Nm, on_ray, angle))
            fuzz_require(false, status ? "a torque that is not reached is not" : "no shorter current");
    }
}

static void try_strategy(void)
{
    const hci_machine_point p = {
        {draw_number(3), draw_number(3)}, {draw_number(3), draw_number(3), draw_number(3)}, draw_number(3)};
    const double torque_Nm = draw_number(3), before[2] = {draw_number(2), draw_number(2)};
    for (int strategy = HCI_STRATEGY_MTPA; strategy <= HCI_STRATEGY_CANCEL; ++strategy) {
        double x[2], least;
        const hci_status status =
            hci_strategy_current(&p, (hci_strategy)strategy, torque_Nm, draw(2) ? before : NULL, x, &least);
        fuzz_require(isfinite(x[0]) && isfinite(x[1]), "finite currents");
        fuzz_require(!isnan(least) && least >= 0.0, "a least current");
        if (strategy == HCI_STRATEGY_MTPA) check_shortest(&p, torque_Nm, x, status);
        if (strategy != HCI_STRATEGY_ID0 && status == HCI_OK)
            fuzz_require(fabs(hci_point_torque_Nm(&p, x) - torque_Nm) <=
                             1e-9 * (terms_Nm(&p, x) + fabs(torque_Nm)),
                         "the torque that was wanted");
    }
}

/* ---- table ---- */

enum { MOST_POINTS = 16 };

static void try_table(void)
{
    float rows[(MOST_POINTS + 1) * 6], current[3], next[3];
    hci_table_f32 table = {.rows = rows,
                           .points = 1 + draw(MOST_POINTS),
                           .columns = 2 + draw(2),
                           .parts = 1,
                           .frame = HCI_TABLE_ABC,
                           .period_turns = 1};
    const size_t row = table.columns;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k)
        rows[k] = (float)draw_number(6);
    memcpy(rows + table.points * row, rows, row * sizeof *rows);
    for (int k = 0; k < 16; ++k) {
        const uint32_t angle = draw(65536) * 65536u + draw(65536);
        const uint32_t before = (uint32_t)(((uint64_t)angle * table.points) >> 32);
        hci_table_f32_currents(&table, angle, 0.0f, current);
        memcpy(next, rows + (before + 1) * row, row * sizeof *rows);
        for (size_t c = 0; c < row; ++c) {
            const float at = rows[before * row + c], slack = 1e-6f * (fabsf(at) + fabsf(next[c]));
            fuzz_require(current[c] >= fminf(at, next[c]) - slack && current[c] <= fmaxf(at, next[c]) + slack,
                         "between its rows");
        }
        if (row == 2) fuzz_require(current[2] == -current[0] - current[1], "a star");
    }
}

/* ---- learn ---- */

enum { MOST_ORDERS = 4 };

typedef struct {
    uint16_t orders[MOST_ORDERS];
    hci_learn_sums sums[MOST_ORDERS + 1];
    hci_learn learn;
} learner;

static void start(learner *l, uint32_t count)
{
    hci_learn_start(&l->learn, l->orders, count, l->sums, 64);
}

static void feed(learner *l)
{
    uint32_t angle = 0;
    const int32_t direction = draw(2) ? 1 : -1;
    hci_learn_turn(&l->learn, direction);
    for (unsigned k = 0; k < 150; ++k) {
        angle += (uint32_t)direction * (draw(40) == 39 ? draw(65536) * 65536u : 0x04000000u);
        hci_learn_sample(&l->learn, angle, (float)draw_number(4));
        if (draw(16)) hci_learn_work(&l->learn);
    }
}

/* What is written is read back into another, and written again the same. */
static void check_kept(learner *l, uint32_t count)
{
    unsigned char first[HCI_LEARN_HEAD + MOST_ORDERS * HCI_LEARN_ORDER + 4], second[sizeof first];
    const hci_learn_facts facts = {draw(65536), 1 + draw(100), draw(2), 1.5f};
    const uint32_t size = hci_learn_write(&l->learn, &facts, first, sizeof first);
    learner other = *l;
    fuzz_require(size == hci_learn_bytes(count), "room for the blob");
    fuzz_require(hci_learn_write(&l->learn, &facts, second, size - 1) == 0, "no blob where there is no room");
    start(&other, count);
    fuzz_require(hci_learn_restore(&other.learn, first, size) == HCI_BLOB_GOOD, "a blob that is read");
    fuzz_require(other.learn.turns_forward == l->learn.turns_forward &&
                     other.learn.turns_backward == l->learn.turns_backward,
                 "the same turns");
    for (uint32_t k = 1; k <= count; ++k)
        fuzz_require(memcmp(other.sums[k].forward, l->sums[k].forward, 2 * sizeof(float)) == 0,
                     "the same sums");
    first[draw(size)] ^= (unsigned char)(1u << draw(8));
    fuzz_require(hci_learn_check(first, size, NULL) != HCI_BLOB_GOOD, "a bit that is not as it was");
    for (uint32_t cut = 0; cut < size; cut += 1 + draw(16))
        fuzz_require(hci_learn_check(second, cut, NULL) != HCI_BLOB_GOOD, "a blob that is cut off");
}

static void try_learn(void)
{
    learner l;
    const uint32_t count = 1 + draw(MOST_ORDERS);
    memset(&l, 0, sizeof l);
    for (uint32_t k = 0; k < count; ++k)
        l.orders[k] = (uint16_t)(1 + k);
    start(&l, count);
    for (unsigned k = draw(5); k > 0; --k)
        feed(&l);
    for (uint32_t k = 0; k <= count; ++k) {
        hci_learn_result result;
        if (hci_learn_result_of(&l.learn, k, &result))
            fuzz_require(isfinite(result.cogging[0]) && !isnan(result.error), "finite results");
    }
    check_kept(&l, count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static void (*const TRY[])(void) = {try_lu, try_strategy, try_table, try_learn};
    draws_begin(data, size);
    TRY[draw(sizeof TRY / sizeof *TRY)]();
    return 0;
}
