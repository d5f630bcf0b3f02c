/* Currents to the compensation map of somebody else's drive. In: machine, currents, whose drive; out: its
 * files. The currents become what the drive has to add at each of its angles (foreign_need.c), this the
 * numbers that its file can hold (host/foreign), and these the ripple that is left (foreign_ripple.c). */
#include "hci/host/emit/emit_foreign.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/emit/foreign_ripple.h"
#include "host/emit/request.h"

enum { MOST_POINTS = 4096, LEAST_POINTS = 8, LINES = 8, LINE_SIZE = 120 };

typedef struct {
    const hci_emit_foreign_request *request;
    const hci_foreign_type *type;
    hci_machine_plant plant;
    hci_foreign_need need;
    hci_foreign_map map;
    hci_emit_foreign_result result;
    char text[LINES][LINE_SIZE];
    const char *line[LINES + 1];
} emission;

/* ---- what is asked for ---- */

static hci_status refuse(const hci_foreign_type *type, hci_note *note, const char *why, const char *remedy)
{
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "--for %s: %s; %s", type->word, why, remedy);
}

static hci_status check_points(size_t points, const hci_foreign_type *type, hci_note *note)
{
    if (points == 0) return HCI_OK;
    if (type->default_points == 0) return refuse(type, note, type->samples, "leave out --points");
    if (points >= LEAST_POINTS && points <= MOST_POINTS && (points & (points - 1)) == 0) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "--points: found %zu, expected a power of two from %d to %d", points,
                        (int)LEAST_POINTS, (int)MOST_POINTS);
}

static hci_status check_target(const hci_emit_foreign_request *r, const hci_foreign_type *type,
                               hci_note *note)
{
    if (r->per_Nm && type->kind != HCI_FOREIGN_DQ)
        return refuse(type, note, "its map is the same at every torque", "leave out --per-torque");
    if (type->has_counts && !(r->counts_per_A > 0.0))
        return refuse(type, note, "its numbers are counts", "add --counts-per-ampere N");
    if (!type->has_counts && r->counts_per_A > 0.0)
        return refuse(type, note, "it has no counts", "leave out --counts-per-ampere");
    if (!type->has_wave && r->wave != HCI_FOREIGN_SINE)
        return refuse(type, note, "its map has no phases that could be meant otherwise", "leave out --wave");
    return check_points(r->points, type, note);
}

/* The machine with what its effects add. */
static hci_status take_machine(emission *e, hci_note *note)
{
    const hci_emit_foreign_request *r = e->request;
    const hci_status status = hci_machine_plant_make(r->machine_folder, r->machine, &e->plant, note);
    if (status) return status;
    const double own = r->torque_constant_Nm_per_A;
    e->need =
        (hci_foreign_need){.plant = &e->plant,
                           .request = r,
                           .torque_constant_Nm_per_A = own > 0.0 ? own : e->plant.torque_constant_Nm_per_A};
    hci_foreign_need_begin(&e->need);
    return HCI_OK;
}

/* ---- the map ---- */

/* A row in the sense of the drive: where its direction is the other one, torque and i_q are too. */
static void turn_round(const hci_foreign_map *map, double *value)
{
    if (map->type->kind != HCI_FOREIGN_DQ) {
        value[0] *= map->direction;
        return;
    }
    value[1] *= map->direction;
    value[2] *= map->direction;
}

/* The mean over all electrical turns, where the drive knows its electrical angle only. */
static hci_status row_at(const emission *e, double turn, double *value, hci_note *note)
{
    const hci_foreign_map *map = &e->map;
    const int turns = map->type->is_electrical ? hci_machine_plant_pole_pairs(&e->plant) : 1;
    const double theta_rad =
        hci_foreign_theta_rad(map, turn) *
        (map->type->is_electrical ? 1.0 : (double)hci_machine_plant_pole_pairs(&e->plant));
    hci_status status = HCI_OK;
    memset(value, 0, map->columns * sizeof *value);
    for (int k = 0; !status && k < turns; ++k) {
        double one[HCI_FOREIGN_MOST_COLUMNS];
        status = hci_foreign_need_at(&e->need, map->type->kind, theta_rad + 2.0 * HCI_PI * k, one, note);
        for (size_t c = 0; !status && c < map->columns; ++c)
            value[c] += one[c] / turns;
    }
    turn_round(map, value);
    return status;
}

static hci_status fill_table(emission *e, hci_note *note)
{
    hci_foreign_map *map = &e->map;
    const size_t points = e->type->points      ? e->type->points
                          : e->request->points ? e->request->points
                                               : e->type->default_points;
    hci_status status = hci_foreign_map_points(map, points, note);
    for (size_t k = 0; !status && k < points; ++k)
        status = row_at(e, ((double)k + (e->type->in_middle ? 0.5 : 0.0)) / (double)points,
                        map->value + k * map->columns, note);
    if (!status && !e->type->in_middle) status = hci_foreign_balance(map, note);
    return status;
}

static hci_status fill_terms(emission *e, hci_note *note)
{
    enum { SAMPLES = 4096 };
    double *const value = hci_memory_new(SAMPLES, sizeof *value);
    hci_status status = value ? HCI_OK : hci_note_memory(note, NULL, "the harmonics of a map");
    for (size_t k = 0; !status && k < SAMPLES; ++k)
        status = row_at(e, (double)k / SAMPLES, value + k, note);
    if (!status) hci_foreign_find_terms(&e->map, value, SAMPLES);
    hci_memory_free(value);
    return status;
}

static double peak_of(const hci_foreign_map *map)
{
    double peak = 0.0;
    for (size_t k = 0; k < map->terms; ++k)
        peak = fmax(peak, map->term[k].amplitude);
    for (size_t c = 0; c < map->columns && c < 2; ++c)
        peak = fmax(peak, hci_foreign_largest(map, c));
    return peak;
}

static hci_status fill(emission *e, hci_note *note)
{
    const hci_emit_foreign_request *r = e->request;
    hci_foreign_map_init(&e->map, e->type);
    e->map.offset_deg = r->encoder_offset_deg;
    e->map.direction = r->encoder_direction < 0 ? -1 : 1;
    e->map.counts_per_A = e->type->has_counts ? r->counts_per_A : 1.0;
    e->map.torque_constant_Nm_per_A = e->need.torque_constant_Nm_per_A;
    e->map.wave = r->wave;
    const hci_status status = e->type->most_terms > 0 ? fill_terms(e, note) : fill_table(e, note);
    if (status) return status;
    e->result.peak = peak_of(&e->map);
    e->type->fit(&e->map);
    return HCI_OK;
}

/* ---- what is told ---- */

bool hci_foreign_ripple_is_reached(const hci_foreign_ripple *r)
{
    return fabs(r->mean_Nm - r->torque_Nm) <= 0.01 * fabs(r->torque_Nm) || r->torque_Nm == 0.0;
}

static void tell(emission *e)
{
    hci_emit_foreign_result *x = &e->result;
    const double torque_Nm[HCI_FOREIGN_RIPPLES] = {0.0, e->need.torque_Nm, -e->need.torque_Nm};
    x->carries = e->type->carries;
    x->lacks = e->type->lacks;
    x->samples = e->type->samples;
    x->points = e->map.points;
    x->terms = e->map.terms;
    x->unit = e->map.unit;
    x->cut = e->map.cut;
    x->left_out = e->map.left_out;
    x->left_out_amplitude = e->map.left_out_amplitude;
    x->torque_Nm = e->need.torque_Nm;
    x->torque_constant_Nm_per_A = e->need.torque_constant_Nm_per_A;
    x->ripples = x->torque_Nm == 0.0 ? 1 : HCI_FOREIGN_RIPPLES;
    for (size_t k = 0; k < x->ripples; ++k)
        x->ripple[k] = hci_foreign_ripple_of(&e->need, &e->map, torque_Nm[k]);
}

static void ripple_line(const hci_foreign_ripple *r, char text[LINE_SIZE])
{
    if (hci_foreign_ripple_is_reached(r))
        snprintf(text, LINE_SIZE,
                 "Ripple at %.4g N*m, peak to peak: %.4g N*m with a sine, %.4g N*m with this.", r->torque_Nm,
                 r->without_Nm, r->with_Nm);
    else
        snprintf(text, LINE_SIZE, "%.4g N*m is not reached: the counts of the drive end at %.4g N*m.",
                 r->torque_Nm, r->mean_Nm);
}

/* The lines at the head of a file. */
static void make_lines(emission *e)
{
    const hci_emit_foreign_result *x = &e->result;
    size_t used = 0;
    snprintf(e->text[used++], LINE_SIZE, "Holds %s.", x->carries);
    snprintf(e->text[used++], LINE_SIZE, "Does not hold %s.", x->lacks);
    snprintf(e->text[used++], LINE_SIZE, "Form: %s.", x->samples);
    for (size_t k = 0; k < x->ripples; ++k)
        ripple_line(&x->ripple[k], e->text[used++]);
    snprintf(e->text[used++], LINE_SIZE, "Input: FNV-1a %016" PRIx64, e->request->input_hash);
    for (size_t k = 0; k < used; ++k)
        e->line[k] = e->text[k];
}

static void name_of_file(const emission *e, size_t which, char text[96])
{
    const char *ending = e->type->file[which];
    snprintf(text, 96, "%s%s%s", e->request->name, *ending == '_' ? "" : ".", ending);
}

static hci_status write_one(emission *e, size_t which, hci_output *out, hci_note *note)
{
    const hci_foreign_files files = {.name = e->request->name, .lines = e->line};
    const size_t used = strlen(e->result.files);
    char name[96];
    name_of_file(e, which, name);
    snprintf(e->result.files + used, sizeof e->result.files - used, "%s%s", used ? ", " : "", name);
    const hci_status status = hci_output_file(out, name, note);
    if (!status) e->type->write[which](&e->map, &files, out);
    return status;
}

static hci_status write_files(emission *e, const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    for (size_t k = 0; !status && k < HCI_FOREIGN_MOST_FILES && e->type->file[k] != NULL; ++k)
        status = write_one(e, k, out, note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}

hci_status hci_emit_foreign(const char *folder, const hci_emit_foreign_request *request,
                            hci_emit_foreign_result *result, hci_note *note)
{
    emission e = {.request = request, .type = hci_foreign_types[request->target]};
    hci_status status = hci_emit_check_name(request->name, note);
    if (!status) status = check_target(request, e.type, note);
    if (!status) status = take_machine(&e, note);
    if (!status) status = fill(&e, note);
    if (!status) {
        tell(&e);
        make_lines(&e);
        status = write_files(&e, folder, note);
    }
    if (!status && result) *result = e.result;
    hci_foreign_map_release(&e.map);
    hci_machine_plant_release(&e.plant);
    return status;
}
