/* A machine with its effects as a quadratic model. In: the declared machine and effects; out: e, L' and T_cog
 * of their own that hold everything up to the second degree in the currents, and the list of effects above
 * it. The torque at no current, its gradient there and the change of the gradient with 1 A in each phase are
 * sampled over the period and transformed. */
#include "host/machine/quadratic_model.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/fft.h"

enum { MOST_TURNS = 4096 };

/* ---- orders ---- */

static bool is_whole(double x, double tolerance)
{
    return fabs(x - floor(x + 0.5)) < tolerance;
}

/* An order within the tolerance of k/p is k/p. */
static bool term_repeats(double order, int pole_pairs, size_t turns)
{
    const double k = order * pole_pairs, n = (double)turns;
    const double exact = is_whole(k, HCI_ORDER_TOLERANCE * pole_pairs) ? floor(k + 0.5) / pole_pairs : order;
    return is_whole(exact * n, HCI_ORDER_TOLERANCE * n);
}

bool hci_effects_repeat(const hci_effects *effects, int pole_pairs, size_t turns)
{
    bool repeat = true;
    for (size_t k = 0; k < effects->count; ++k)
        for (size_t j = 0; j < effects->effect[k].count && repeat; ++j)
            repeat = term_repeats(effects->effect[k].term[j].order, pole_pairs, turns);
    return repeat;
}

double hci_effects_top_order(const hci_effects *effects)
{
    double top = 0.0;
    for (size_t k = 0; k < effects->count; ++k)
        for (size_t j = 0; j < effects->effect[k].count; ++j)
            top = fmax(top, effects->effect[k].term[j].order);
    return top;
}

static hci_status find_turns(const hci_effects *effects, int pole_pairs, size_t *turns, hci_note *note)
{
    for (*turns = 1; *turns <= MOST_TURNS; ++*turns)
        if (hci_effects_repeat(effects, pole_pairs, *turns)) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "effects.csv: the orders have no common period of at most %d electrical turns; write "
                        "fractional orders as k/pole_pairs with at least 7 digits",
                        MOST_TURNS);
}

/* ---- what is of second degree, sampled ---- */

/* T, ∂T/∂i at no current and how it changes with 1 A in each phase; two rows each are the real and the
 * imaginary part of one transform. */
enum { TORQUE, SPARE, EMF_A, EMF_B, EMF_C, SPARE_2, SLOPE, ROWS = SLOPE + HCI_PHASE_MATRIX };

typedef struct {
    double *row; /* ROWS × count */
    size_t count, turns;
} samples;

static void sample_at(const hci_effects_plant *lower, const samples *s, size_t k)
{
    static const int AT[3][3] = {
        {HCI_AA, HCI_AB, HCI_CA}, {HCI_AB, HCI_BB, HCI_BC}, {HCI_CA, HCI_BC, HCI_CC}};
    const double turn = (double)k * (double)s->turns / (double)s->count;
    hci_sample x = {0};
    x.theta_m_rad = 2.0 * HCI_PI * turn / lower->machine->pole_pairs;
    x.temperature_C = lower->temperature_C;
    const hci_effect_torque none = hci_effects_torque(lower->machine, lower->effects, &x, NULL);
    s->row[TORQUE * s->count + k] = none.torque_Nm;
    for (size_t phase = 0; phase < 3; ++phase) {
        s->row[(EMF_A + phase) * s->count + k] = none.by_current[phase];
        x.i_abc[phase] = 1.0;
        const hci_effect_torque one = hci_effects_torque(lower->machine, lower->effects, &x, NULL);
        x.i_abc[phase] = 0.0;
        for (size_t other = 0; other < 3; ++other)
            s->row[(size_t)(SLOPE + AT[phase][other]) * s->count + k] =
                one.by_current[other] - none.by_current[other];
    }
}

static hci_status sample_lower(const hci_effects_plant *lower, samples *s, hci_note *note)
{
    const hci_machine *m = lower->machine;
    double top = hci_effects_top_order(lower->effects);
    const hci_status status = find_turns(lower->effects, m->pole_pairs, &s->turns, note);
    if (status) return status;
    for (size_t k = 0; k < m->back_emf_count; ++k)
        top = fmax(top, m->back_emf[k].order);
    s->count = hci_fft_size(2.0 * (top + 4.0) * (double)s->turns);
    s->row = hci_memory_new(ROWS * s->count, sizeof *s->row);
    if (!s->row) return hci_note_memory(note, NULL, "the effects of the machine");
    for (size_t k = 0; k < s->count; ++k)
        sample_at(lower, s, k);
    for (size_t r = 0; r < ROWS; r += 2)
        hci_fft(s->row + r * s->count, s->row + (r + 1) * s->count, s->count, -1);
    return HCI_OK;
}

/* Rows r and r + 1 at k periods. */
static void bin(const samples *s, size_t r, size_t k, hci_harmonic *a, hci_harmonic *b)
{
    const hci_fft_pair pair = {s->row + r * s->count, s->row + (r + 1) * s->count, s->count, s->turns};
    hci_fft_bin(&pair, k, a, b);
}

/* ---- into the machine ---- */

/* Amplitude X_σ = ⅓ Σ X_s e^(jσ2πs/3) of e^(jnθ), with X = C − jS; a mean is all positive sequence. */
static hci_wave wave_of(const hci_harmonic h[3], int sequence)
{
    const bool mean = h[0].order < HCI_ORDER_TOLERANCE;
    const double scale = (mean && sequence != 0 ? 2.0 : 1.0) / 3.0;
    hci_wave w = {h[0].order, sequence, 0.0, 0.0};
    if (mean && sequence < 0) return w;
    for (int s = 0; s < 3; ++s) {
        const double c = cos(sequence * 2.0 * HCI_PI * s / 3.0), d = sin(sequence * 2.0 * HCI_PI * s / 3.0);
        w.cosine += scale * (h[s].cosine * c + h[s].sine * d);
        w.sine += scale * (h[s].sine * c - h[s].cosine * d);
    }
    return w;
}

static hci_status add_back_emf(const samples *s, hci_quadratic_model *to, hci_note *note)
{
    hci_machine *m = &to->machine;
    size_t n = m->back_emf_count;
    to->back_emf = hci_memory_new(n + 3 * s->count / 2, sizeof *to->back_emf);
    if (!to->back_emf) return hci_note_memory(note, NULL, "the effects of the machine");
    if (n > 0) memcpy(to->back_emf, m->back_emf, n * sizeof *to->back_emf);
    for (size_t k = 0; k < s->count / 2; ++k) {
        hci_harmonic h[3], unused;
        bin(s, EMF_A, k, &h[0], &h[1]);
        bin(s, EMF_C, k, &h[2], &unused);
        for (int sequence = -1; sequence <= 1; ++sequence)
            to->back_emf[n++] = wave_of(h, sequence);
    }
    m->back_emf = to->back_emf;
    m->back_emf_count = hci_waves_join(to->back_emf, n, HCI_FFT_FLOOR);
    return HCI_OK;
}

/* Largest amplitude of a row. */
static double largest_in(const samples *s, size_t r)
{
    double largest = 0.0;
    for (size_t k = 0; k < s->count / 2; ++k) {
        hci_harmonic a, b;
        bin(s, r, k, &a, &b);
        largest = fmax(largest, fmax(hci_amplitude(a.sine, a.cosine), hci_amplitude(b.sine, b.cosine)));
    }
    return largest;
}

static hci_status add_cogging(const samples *s, hci_quadratic_model *to, hci_note *note)
{
    hci_machine *m = &to->machine;
    const double least = HCI_FFT_FLOOR * largest_in(s, TORQUE);
    to->cogging = hci_memory_new(m->cogging_count + s->count / 2, sizeof *to->cogging);
    if (!to->cogging) return hci_note_memory(note, NULL, "the effects of the machine");
    if (m->cogging_count > 0) memcpy(to->cogging, m->cogging, m->cogging_count * sizeof *to->cogging);
    for (size_t k = 0; k < s->count / 2; ++k) {
        hci_harmonic a, unused;
        bin(s, TORQUE, k, &a, &unused);
        if (hci_amplitude(a.sine, a.cosine) > least) to->cogging[m->cogging_count++] = a;
    }
    m->cogging = to->cogging;
    return HCI_OK;
}

/* All six entries of L' at k periods; returns the largest. */
static double slope_at(const samples *s, size_t k, hci_inductance_slope *slope)
{
    double largest = 0.0;
    for (size_t q = 0; q < HCI_PHASE_MATRIX; q += 2) {
        hci_harmonic h[2];
        bin(s, SLOPE + q, k, &h[0], &h[1]);
        for (size_t j = 0; j < 2; ++j) {
            slope->order = h[j].order;
            slope->sine[q + j] = h[j].sine;
            slope->cosine[q + j] = h[j].cosine;
            largest = fmax(largest, hci_amplitude(h[j].sine, h[j].cosine));
        }
    }
    return largest;
}

static hci_status add_slopes(const samples *s, hci_quadratic_model *to, hci_note *note)
{
    hci_machine *m = &to->machine;
    double largest = 0.0;
    for (size_t q = 0; q < HCI_PHASE_MATRIX; q += 2)
        largest = fmax(largest, largest_in(s, SLOPE + q));
    to->slope = hci_memory_new(m->slope_count + s->count / 2, sizeof *to->slope);
    if (!to->slope) return hci_note_memory(note, NULL, "the effects of the machine");
    if (m->slope_count > 0) memcpy(to->slope, m->slope, m->slope_count * sizeof *to->slope);
    for (size_t k = 0; k < s->count / 2; ++k) {
        hci_inductance_slope slope;
        if (slope_at(s, k, &slope) > HCI_FFT_FLOOR * largest) to->slope[m->slope_count++] = slope;
    }
    m->slope = to->slope;
    return HCI_OK;
}

static hci_status write_lower(const hci_effects_plant *lower, hci_quadratic_model *to, hci_note *note)
{
    samples s = {0};
    hci_status status = sample_lower(lower, &s, note);
    if (!status) status = add_back_emf(&s, to, note);
    if (!status) status = add_cogging(&s, to, note);
    if (!status) status = add_slopes(&s, to, note);
    hci_memory_free(s.row);
    return status;
}

/* ---- all of it ---- */

/* Effects up to the second degree first, those above from the end. */
static hci_status sort_out(const hci_effects *effects, hci_quadratic_model *to, hci_note *note)
{
    size_t lower = 0, higher = effects->count;
    to->effect = hci_memory_new(effects->count, sizeof *to->effect);
    if (!to->effect) return hci_note_memory(note, NULL, "the effects of the machine");
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *effect = &effects->effect[k];
        if (!effect->type->in_machine)
            ++to->left_out;
        else
            to->effect[effect->type->beyond_quadratic ? --higher : lower++] = *effect;
    }
    to->lower_list = (hci_effects){to->effect, lower};
    to->higher_list = (hci_effects){to->effect + higher, effects->count - higher};
    return HCI_OK;
}

hci_status hci_quadratic_model_make(const hci_machine *declared, const hci_effects *effects,
                                    double temperature_C, hci_quadratic_model *model, hci_note *note)
{
    hci_status status;
    memset(model, 0, sizeof *model);
    model->machine = *declared;
    if (!effects) return HCI_OK;
    status = sort_out(effects, model, note);
    if (!status && model->higher_list.count > 0)
        model->higher = (hci_effects_plant){declared, &model->higher_list, temperature_C};
    if (!status && model->lower_list.count > 0) {
        const hci_effects_plant lower = {declared, &model->lower_list, temperature_C};
        status = write_lower(&lower, model, note);
    }
    return status;
}

void hci_quadratic_model_release(hci_quadratic_model *model)
{
    hci_memory_free(model->effect);
    hci_memory_free(model->back_emf);
    hci_memory_free(model->cogging);
    hci_memory_free(model->slope);
    memset(model, 0, sizeof *model);
}
