/* motors COUNT SEED FOLDER [FIRST [SHARE [SIZE [LINE]]]]: a test line on paper.
 *
 * Writes FOLDER/machine (what the data sheet says of every motor), FOLDER/runs/NAME (five short recordings of
 * each motor), FOLDER/motors.csv (the list for `hci-solve batch`) and FOLDER/truth.csv (the fault of each
 * motor, `none` for most). FIRST: number of the first motor, 1 where it is left out, so that a large fleet
 * can be made in blocks; a motor is the same in any block. SHARE: of motors with a hidden fault, 0.03.
 * SIZE: of the faults, as a part of what they are without it (1). LINE: plain; others, whose faults are of
 * other kinds than the five; or series, five pairs of poles and twelve coils, of which those of a phase are
 * in series.
 *
 * Each motor differs from the sheet by chance, as motors of one line do, its batch from other batches, and
 * one parameter drifts with the date. Torque at the angle θ (electrical, θ = pθ_m), with the flux 1 + M(θ_m):
 *
 *     T = (1 + M) Σ_s g_s e_s(θ) i_s + (1 + M)² T_cog(θ) − T_c sign ω − Bω
 *
 * e_s(θ) = e(θ − 2πs/3), of orders 1, 5 and 7; the encoder reads θ + δ, and the current was controlled by
 * what it reads. In the line in series each coil c, α_c mechanical ahead, sees the flux 1 + M(θ_m − α_c), and
 * so does each slot, whose cogging torques, of order 2 too, leave order 12. Nothing here includes a header of
 * the library or links with it. */
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define PI 3.14159265358979323846

enum { SAMPLES = 256, TURNS = 2, RUNS = 5, PATH = 4096, BATCH = 250, FAULTS = 5, OTHERS = 7, COILS = 12 };

static int pole_pairs = 4;
static bool is_of_others, is_in_series;

/* ---- chance: a state of its own for each motor ---- */

static uint64_t state;

static double uniform(double from, double to)
{
    uint64_t x = state += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return from + (to - from) * ((double)((x ^ (x >> 31)) >> 11) + 0.5) * 0x1p-53;
}

static double normal(double deviation)
{
    const double r = sqrt(-2.0 * log(uniform(0.0, 1.0)));
    return deviation * r * cos(uniform(0.0, 2.0 * PI));
}

static void begin_chance(uint64_t seed, uint64_t what)
{
    state = seed * UINT64_C(0xd1342543de82ef95) + what * UINT64_C(0x2545f4914f6cdd1d);
    for (int k = 0; k < 4; ++k)
        (void)uniform(0.0, 1.0);
}

/* ---- a motor ---- */

static const char *const FAULT[FAULTS + OTHERS + 1] = {"none",   "magnets", "phase", "pole", "friction",
                                                       "offset", "encoder", "gain",  "late", "bearing",
                                                       "play",   "swapped", "pairs"};

static const double KT_NM_PER_A = 0.6, COULOMB_NM = 0.03, VISCOUS = 2e-4, NOISE_NM = 0.005, NOISE_A = 0.005;
static const double EMF_SHARE[3] = {1.0, 0.02, -0.012};
static const int EMF_ORDER[3] = {1, 5, 7};

typedef struct {
    int fault;
    double magnets;                     /* relative change of the flux, of all poles */
    double phase[3];                    /* and of the turns of each phase */
    double pole;                        /* and of one magnet */
    double pole_at;                     /* its place in the turn, mechanical */
    double offset_rad;                  /* of the encoder, electrical */
    double eccentric_rad, eccentric_at; /* its reading once a turn, electrical; its place in the turn */
    double gain[3];                     /* relative error of a current that is read */
    double late_s;                      /* of the currents */
    double bearing_Nm;                  /* once in 3/11 of a turn */
    double play_rad;                    /* of the encoder's coupling, electrical */
    bool is_swapped;                    /* what is read of the phases b and c */
    double pairs;                       /* of poles beside those of the sheet */
    double coulomb_Nm, viscous;
    double cogging_Nm[2], cogging_rad[2]; /* of orders 6 and 12 */
} motor;

/* What a batch of magnets has in common. */
static double batch_magnets(uint64_t seed, long number)
{
    begin_chance(seed, 1000003u * (uint64_t)(number / BATCH) + 77u);
    return normal(0.006);
}

static void hide(motor *m, double part)
{
    const double size = part * uniform(0.75, 1.35), sign = uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    m->fault = 1 + (int)uniform(0.0, FAULTS);
    if (m->fault == 1) m->magnets -= 0.09 * size;
    if (m->fault == 2) m->phase[(int)uniform(0.0, 3.0)] -= 0.05 * size;
    if (m->fault == 3) m->pole = -0.2 * size;
    if (m->fault == 4) m->coulomb_Nm += 0.045 * size;
    if (m->fault == 5) m->offset_rad += 0.06 * size * sign;
}

static void hide_another(motor *m, double part)
{
    const double size = part * uniform(0.75, 1.35), sign = uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    const int what = (int)uniform(0.0, OTHERS);
    m->fault = 1 + FAULTS + what;
    if (what == 0) m->eccentric_rad = 0.06 * size;
    if (what == 1) m->gain[(int)uniform(0.0, 3.0)] = 0.05 * size * sign;
    if (what == 2) m->late_s = 4e-4 * size;
    if (what == 3) m->bearing_Nm = 0.05 * size;
    if (what == 4) m->play_rad = 0.1 * size;
    if (what == 5) m->is_swapped = true;
    if (what == 6) m->pairs = 1.0;
}

static motor make(uint64_t seed, long number, double share, double part)
{
    motor m = {0};
    m.magnets = batch_magnets(seed, number);
    begin_chance(seed, (uint64_t)number);
    m.magnets += normal(0.008);
    for (int s = 0; s < 3; ++s)
        m.phase[s] = normal(0.001);
    m.offset_rad = normal(0.006);
    m.coulomb_Nm = COULOMB_NM * (1.0 + normal(0.08) + 1e-5 * (double)number); /* the press wears */
    m.viscous = VISCOUS * (1.0 + normal(0.1));
    m.cogging_Nm[0] = 0.05 * (1.0 + normal(0.08));
    m.cogging_Nm[1] = 0.02 * (1.0 + normal(0.08));
    m.cogging_rad[0] = 0.4 + normal(0.05);
    m.cogging_rad[1] = -1.1 + normal(0.05);
    m.pole_at = uniform(0.0, 2.0 * PI);
    if (uniform(0.0, 1.0) < share) (is_of_others ? hide_another : hide)(&m, part);
    m.eccentric_at = m.pole_at;
    return m;
}

/* Flux of a magnet that is weaker, smoothed as the air gap does. */
static double flux(const motor *m, double mechanical)
{
    const double away = remainder(mechanical - m->pole_at, 2.0 * PI), half = PI / (2.0 * pole_pairs);
    return 1.0 + m->pole * 0.5 * (tanh((away + half) / 0.08) - tanh((away - half) / 0.08));
}

static double friction(const motor *m, double speed)
{
    return copysign(m->coulomb_Nm, speed) + m->viscous * speed;
}

static double torque(const motor *m, double theta, const double current[3], double speed)
{
    const double f = flux(m, theta / pole_pairs);
    double sum = 0.0, cogging = 0.0;
    for (int s = 0; s < 3; ++s)
        for (int k = 0; k < 3; ++k)
            sum += (1.0 + m->magnets) * (1.0 + m->phase[s]) * KT_NM_PER_A / 1.5 * EMF_SHARE[k] * current[s] *
                   sin(EMF_ORDER[k] * (theta - 2.0 * PI * s / 3.0));
    for (int k = 0; k < 2; ++k)
        cogging += m->cogging_Nm[k] * sin(6 * (k + 1) * theta + m->cogging_rad[k]);
    return f * sum + f * f * cogging - friction(m, speed);
}

/* Of the back-EMF of a phase, one of its four coils: `ahead` of the phase, electrical. */
static double coil(const motor *m, int phase, double theta, double ahead)
{
    double e = 0.0;
    for (int k = 0; k < 3; ++k)
        e += 0.25 * EMF_SHARE[k] / cos(EMF_ORDER[k] * PI / 12.0) * sin(EMF_ORDER[k] * (theta + ahead));
    return (1.0 + m->magnets) * (1.0 + m->phase[phase]) * KT_NM_PER_A / 1.5 * e;
}

/* Coils and slots, 30° mechanical and 150° electrical apart: two beside each other are of one phase. */
static double torque_in_series(const motor *m, double theta, const double current[3], double speed)
{
    static const double SLOT_NM = 0.05; /* of order 2, of one slot */
    double sum = 0.0;
    for (int c = 0; c < COILS; ++c) {
        const double f = flux(m, theta / pole_pairs - 2.0 * PI * c / COILS);
        const double at = theta - pole_pairs * 2.0 * PI * c / COILS;
        for (int s = 0; s < 3; ++s) {
            const double away = remainder(at - PI / 12.0 - (theta - 2.0 * PI * s / 3.0), PI);
            if (fabs(away) < PI / 8.0) sum += f * current[s] * coil(m, s, theta - 2.0 * PI * s / 3.0, away);
        }
        sum += f * f * SLOT_NM * sin(2.0 * at);
        for (int k = 0; k < 2; ++k)
            sum += f * f * m->cogging_Nm[k] / COILS * sin(12 * (k + 1) * at + m->cogging_rad[k]);
    }
    return sum - friction(m, speed);
}

/* ---- files ---- */

static FILE *open_file(const char *folder, const char *name)
{
    char path[PATH];
    snprintf(path, sizeof path, "%.3000s/%.900s", folder, name);
    FILE *file = fopen(path, "w");
    if (!file) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        exit(1);
    }
    return file;
}

static void write_machine(const char *folder)
{
    FILE *f = open_file(folder, "machine.csv");
    fprintf(f,
            "name,value,unit,source\npole_pairs,%d,1,sheet\nconnection,star,,sheet\nrated_current,4,A,sheet\n"
            "rated_torque,2.4,Nm,sheet\nrated_speed,60,rad/s,sheet\n",
            pole_pairs);
    if (is_in_series) fprintf(f, "slots,%d,1,sheet\n", COILS);
    fclose(f);
    f = open_file(folder, "back_emf.csv");
    fprintf(f, "order,amplitude_Nm_per_A,phase_rad\n");
    for (int k = 0; k < 3; ++k)
        fprintf(f, "%d,%.17g,%.17g\n", EMF_ORDER[k], EMF_SHARE[k] * KT_NM_PER_A / 1.5, 0.0);
    fclose(f);
    f = open_file(folder, "cogging.csv");
    const int first = is_in_series ? 12 : 6;
    fprintf(f, "order,amplitude_Nm,phase_rad\n%d,0.05,0.4\n%d,0.02,-1.1\n", first, 2 * first);
    fclose(f);
    f = open_file(folder, "effects.csv");
    fprintf(
        f,
        "effect,parameter,value,unit,std_error\nfriction,coulomb,%g,Nm,\nfriction,viscous,%g,Nms_per_rad,\n",
        COULOMB_NM, VISCOUS);
    fclose(f);
}

/* An operating point: currents in the frame of what the encoder reads, and the speed. */
typedef struct {
    const char *name;
    double d_A, q_A, speed;
} point;

/* The true angle, electrical, where the encoder reads `read`. */
static double true_angle(const motor *m, double read, double speed)
{
    return read - m->offset_rad - m->eccentric_rad * sin(read / pole_pairs - m->eccentric_at) -
           copysign(0.5 * m->play_rad, speed) + m->pairs * read / pole_pairs;
}

static void write_row(const motor *m, const point *p, double time, FILE *f)
{
    const double read = pole_pairs * (p->speed * time + 0.3), theta = true_angle(m, read, p->speed);
    const double late = read - pole_pairs * p->speed * m->late_s;
    double current[3];
    for (int s = 0; s < 3; ++s) {
        const double at = late - 2.0 * PI * s / 3.0;
        current[s] = p->q_A * sin(at) - p->d_A * cos(at);
    }
    const double sum = (is_in_series ? torque_in_series : torque)(m, theta, current, p->speed) +
                       m->bearing_Nm * sin(11.0 / 3.0 * read / pole_pairs);
    const double torque_noise_Nm = normal(NOISE_NM);
    double seen[3];
    for (int k = 2; k >= 0; --k) {
        const int s = m->is_swapped && k > 0 ? 3 - k : k;
        const double at = read - 2.0 * PI * s / 3.0, is = p->q_A * sin(at) - p->d_A * cos(at);
        seen[k] = (1.0 + m->gain[s]) * is + normal(NOISE_A);
    }
    fprintf(f, "%.7g,%.7g,%.5g,%.5g,%.5g,%.5g\n", time, read / pole_pairs, seen[0], seen[1], seen[2],
            sum + torque_noise_Nm);
}

static void write_run(const motor *m, const point *p, const char *folder)
{
    const double step = 2.0 * PI * TURNS / SAMPLES / fabs(p->speed);
    FILE *f = open_file(folder, p->name);
    fprintf(f, "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n");
    for (int k = 0; k < SAMPLES; ++k)
        write_row(m, p, k * step, f);
    fclose(f);
}

static void write_runs(const motor *m, const char *folder)
{
    static const point POINT[RUNS] = {{"ahead.csv", 0.0, 0.0, 20.0},
                                      {"back.csv", 0.0, 0.0, -20.0},
                                      {"drive.csv", 0.0, 4.0, 20.0},
                                      {"brake.csv", 0.0, -4.0, 20.0},
                                      {"fast.csv", -2.0, 3.0, 60.0}};
    FILE *f = open_file(folder, "runs.csv");
    fprintf(f, "file,role\n");
    for (int k = 0; k < RUNS; ++k)
        fprintf(f, "%s,fit\n", POINT[k].name);
    fclose(f);
    for (int k = 0; k < RUNS; ++k)
        write_run(m, &POINT[k], folder);
}

static void make_folder(const char *folder)
{
    if (mkdir(folder, 0777) == 0 || errno == EEXIST) return;
    fprintf(stderr, "%s: %s\n", folder, strerror(errno));
    exit(1);
}

int main(int argc, char **argv)
{
    char path[PATH];
    if (argc < 4) return fprintf(stderr, "motors COUNT SEED FOLDER [FIRST [SHARE [SIZE [LINE]]]]\n"), 2;
    const long count = atol(argv[1]), first = argc > 4 ? atol(argv[4]) : 1;
    const uint64_t seed = (uint64_t)strtoull(argv[2], NULL, 10);
    const double share = argc > 5 ? atof(argv[5]) : 0.03, part = argc > 6 ? atof(argv[6]) : 1.0;
    is_of_others = argc > 7 && strcmp(argv[7], "others") == 0;
    is_in_series = argc > 7 && strcmp(argv[7], "series") == 0;
    if (is_in_series) pole_pairs = 5;
    make_folder(argv[3]);
    snprintf(path, sizeof path, "%.3000s/machine", argv[3]);
    make_folder(path);
    write_machine(path);
    snprintf(path, sizeof path, "%.3000s/runs", argv[3]);
    make_folder(path);
    FILE *list = open_file(argv[3], "motors.csv"), *truth = open_file(argv[3], "truth.csv");
    fprintf(list, "motor,serial,batch,date,machine,runs\n");
    fprintf(truth, "motor,fault,magnets,phase_a,phase_b,phase_c,coulomb_Nm,offset_rad\n");
    for (long k = first; k < first + count; ++k) {
        const motor m = make(seed, k, share, part);
        const long day = k / 50;
        snprintf(path, sizeof path, "%.3000s/runs/m%06ld", argv[3], k);
        make_folder(path);
        write_runs(&m, path);
        fprintf(list, "m%06ld,%ld,b%03ld,20%02ld-%02ld-%02ld,machine,runs/m%06ld/runs.csv\n", k, 700000 + k,
                k / BATCH, 25 + day / 336, 1 + day / 28 % 12, 1 + day % 28, k);
        fprintf(truth, "m%06ld,%s,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", k, FAULT[m.fault], m.magnets, m.phase[0],
                m.phase[1], m.phase[2], m.coulomb_Nm, m.offset_rad);
    }
    return fclose(list) | fclose(truth) ? 1 : 0;
}
