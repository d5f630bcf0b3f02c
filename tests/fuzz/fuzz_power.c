/* Saturated machines made of the bytes of the input: terms of co-energy of degrees 0 to 8, far orders,
 * extreme values and currents. Energy is neither made nor lost by them:
 *
 *   power balance   over any closed cycle of angle and currents  ∮ i·dψ = ∮ T dθ,  dψ = L di + (e + L'i) dθ
 *   sum             all terms together make what each alone makes
 */
#include "draws.h"
#include "fuzzing.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "hci/effects/effect.h"

enum { TYPES = 4, MOST_TERMS = 24, LEAST_STEPS = 256, MOST_STEPS = 32768, CURRENT_ORDER = 2 };

typedef struct {
    hci_effect effect[TYPES];             /* with all terms of a type together */
    hci_effect alone[TYPES * MOST_TERMS]; /* with one */
    hci_effect_term term[TYPES][MOST_TERMS];
    hci_effects list;
    size_t terms;
    hci_machine machine;
    double size_A, turns, start_rad;
    size_t steps;
} saturated;

static double draw_coefficient(void)
{
    static const double size[] = {5e-324, 2.3e-308, 1e-160, 1e-12, 1e-6, 1.0, 1e6, 9.9e8};
    const double value = draw(4) ? 0.001 * (1 + draw(1000)) : size[draw(sizeof size / sizeof *size)];
    return draw(2) ? value : -value;
}

/* A linear parameter. */
static bool draw_term(const hci_effect_type *type, hci_effect_term *term)
{
    static const double far[] = {24.0, 36.0, 120.0, 600.0};
    const size_t k = draw((unsigned)type->parameter_count);
    const hci_effect_parameter *p = &type->parameter[k];
    if (!(p->traits & HCI_PARAMETER_LINEAR)) return false;
    *term = (hci_effect_term){k, 0.0, draw_coefficient(), NAN};
    if (p->ordered) term->order = fmax(draw(8) ? draw(13) : far[draw(4)], ceil(p->least_order));
    return true;
}

/* Terms of a type. Returns their highest order. */
static double draw_effect(saturated *s, const char *name, size_t place)
{
    const unsigned count = draw(MOST_TERMS);
    const hci_effect_type *type = hci_effect_type_find(name);
    hci_effect *e = &s->effect[place];
    double highest = 0.0;
    fuzz_require(type != NULL, "a type of effect");
    *e = (hci_effect){type, s->term[place], 0};
    for (unsigned k = 0; k < count; ++k) {
        hci_effect_term *term = &s->term[place][e->count];
        if (!draw_term(type, term)) continue;
        ++e->count;
        s->alone[s->terms++] = (hci_effect){type, term, 1};
        highest = fmax(highest, term->order);
    }
    return highest;
}

static void draw_machine(saturated *s)
{
    static const char *const NAME[TYPES] = {"saturation", "reluctance", "back_emf", "cogging"};
    static const int pole_pairs[] = {1, 2, 3, 7, 20};
    double highest = 0.0;
    memset(s, 0, sizeof *s);
    s->machine.pole_pairs = pole_pairs[draw(5)];
    for (size_t k = 0; k < TYPES; ++k)
        if (k == 0 || draw(2)) highest = fmax(highest, draw_effect(s, NAME[k], s->list.count++));
    s->list.effect = s->effect;
    s->size_A = draw(4) ? 0.1 * (1 + draw(100)) : pow(10.0, (double)draw(9) - 4.0);
    s->turns = draw(2);
    s->start_rad = 0.001 * draw(6284);
    /* Beyond the highest order of the integrand equal steps are exact to rounding. */
    for (s->steps = LEAST_STEPS;
         (double)s->steps <= s->machine.pole_pairs * (highest + 9.0) + 9.0 * CURRENT_ORDER; s->steps *= 2)
        ;
}

/* A cycle that never returns on its own path. */
static void cycle(const saturated *s, double w, hci_plant_state *y, double di[2])
{
    y->theta_m_rad = s->start_rad + s->turns * w;
    y->i[0] = s->size_A * (0.6 + 0.8 * cos(w) + 0.2 * sin(2.0 * w));
    y->i[1] = s->size_A * (-0.2 + sin(w) + 0.3 * cos(2.0 * w));
    di[0] = s->size_A * (-0.8 * sin(w) + 0.4 * cos(2.0 * w));
    di[1] = s->size_A * (cos(w) - 0.6 * sin(2.0 * w));
}

static hci_plant_point point_of(const saturated *s, const hci_effects *effects, const hci_plant_state *y)
{
    hci_plant_point p = {0};
    const hci_effects_plant context = {&s->machine, effects, NAN};
    hci_effects_apply(&context, y, &p);
    return p;
}

/* i·dψ of a step. */
static double taken_in(const saturated *s, const hci_plant_point *p, const double i[2], const double di[2])
{
    const double *l = p->inductance_H, *h = p->magnetic.slope, *e = p->magnetic.e;
    return i[0] * (l[0] * di[0] + l[1] * di[1] + (e[0] + h[0] * i[0] + h[1] * i[1]) * s->turns) +
           i[1] * (l[1] * di[0] + l[2] * di[1] + (e[1] + h[1] * i[0] + h[2] * i[1]) * s->turns);
}

/* The torque of each term alone, and the sum of their sizes. */
static double alone_Nm(const saturated *s, const hci_plant_state *y, double *size_Nm)
{
    double sum = 0.0;
    *size_Nm = 0.0;
    for (size_t k = 0; k < s->terms; ++k) {
        const hci_effects one = {&s->alone[k], 1};
        const hci_plant_point p = point_of(s, &one, y);
        const double torque = hci_point_torque_Nm(&p.magnetic, y->i);
        sum += torque;
        *size_Nm += fabs(p.magnetic.cogging_Nm) + fabs(p.magnetic.e[0] * y->i[0]) +
                    fabs(p.magnetic.e[1] * y->i[1]) + fabs(torque);
    }
    return sum;
}

static void check_balance(const saturated *s)
{
    static const double TURN = 6.283185307179586;
    double energy = 0.0, size = 0.0;
    for (size_t k = 0; k < s->steps; ++k) {
        hci_plant_state y = {{0.0, 0.0}, 0.0, 0.0, 0.0};
        double di[2], size_Nm;
        cycle(s, TURN * (double)k / (double)s->steps, &y, di);
        const hci_plant_point p = point_of(s, &s->list, &y);
        const double torque = hci_point_torque_Nm(&p.magnetic, y.i), in = taken_in(s, &p, y.i, di);
        fuzz_require(isfinite(torque) && isfinite(in), "finite torque and flux");
        energy += in - torque * s->turns;
        size += fabs(in) + fabs(torque * s->turns);
        if (k % 64 == 0)
            fuzz_require(fabs(alone_Nm(s, &y, &size_Nm) - torque) <= 1e-11 * size_Nm + 1e-300,
                         "together as each alone");
    }
    fuzz_require(fabs(energy) <= 1e-9 * size + 1e-290, "the power balance");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static saturated s;
    draws_begin(data, size);
    draw_machine(&s);
    if (s.terms > 0 && s.steps <= MOST_STEPS) check_balance(&s);
    return 0;
}
