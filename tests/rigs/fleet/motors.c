/* motors COUNT SEED FOLDER [FIRST [SHARE [SIZE]]]: a test line on paper.
 *
 * Writes FOLDER/machine (what the data sheet says of every motor), FOLDER/runs/NAME (five short recordings of
 * each motor), FOLDER/motors.csv (the list for `hci-solve batch`) and FOLDER/truth.csv (the fault of each
 * motor, `none` for most). FIRST: number of the first motor, 1 where it is left out, so that a large fleet
 * can be made in blocks; a motor is the same in any block. SHARE: of motors with a hidden fault, 0.03.
 * SIZE: of the faults, as a part of what they are without it (1).
 *
 * Each motor differs from the sheet by chance, as motors of one line do, its batch from other batches, and
 * one parameter drifts with the date. Torque at the angle θ (electrical, θ = pθ_m), with the flux 1 + M(θ_m):
 *
 *     T = (1 + M) Σ_s g_s e_s(θ) i_s + (1 + M)² T_cog(θ) − T_c sign ω − Bω
 *
 * e_s(θ) = e(θ − 2πs/3), of orders 1, 5 and 7; the encoder reads θ + δ, and the current was controlled by
 * what it reads. Nothing here includes a header of the library or links with it. */
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define PI 3.14159265358979323846

enum { POLE_PAIRS = 4, SAMPLES = 256, TURNS = 2, RUNS = 5, PATH = 4096, BATCH = 250, FAULTS = 5 };

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

static const char *const FAULT[FAULTS + 1] = {"none", "magnets", "phase", "pole", "friction", "offset"};

static const double KT_NM_PER_A = 0.6, COULOMB_NM = 0.03, VISCOUS = 2e-4, NOISE_NM = 0.005, NOISE_A = 0.005;
static const double EMF_SHARE[3] = {1.0, 0.02, -0.012};
static const int EMF_ORDER[3] = {1, 5, 7};

typedef struct {
    int fault;
    double magnets;    /* relative change of the flux, of all poles */
    double phase[3];   /* and of the turns of each phase */
    double pole;       /* and of one magnet */
    double pole_at;    /* its place in the turn, mechanical */
    double offset_rad; /* of the encoder, electrical */
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
    if (uniform(0.0, 1.0) < share) hide(&m, part);
    return m;
}

/* Flux of a magnet that is weaker, smoothed as the air gap does. */
static double flux(const motor *m, double mechanical)
{
    const double away = remainder(mechanical - m->pole_at, 2.0 * PI), half = PI / (2.0 * POLE_PAIRS);
    return 1.0 + m->pole * 0.5 * (tanh((away + half) / 0.08) - tanh((away - half) / 0.08));
}

static double torque(const motor *m, double theta, const double current[3], double speed)
{
    const double f = flux(m, theta / POLE_PAIRS);
    double sum = 0.0, cogging = 0.0;
    for (int s = 0; s < 3; ++s)
        for (int k = 0; k < 3; ++k)
            sum += (1.0 + m->magnets) * (1.0 + m->phase[s]) * KT_NM_PER_A / 1.5 * EMF_SHARE[k] * current[s] *
                   sin(EMF_ORDER[k] * (theta - 2.0 * PI * s / 3.0));
    for (int k = 0; k < 2; ++k)
        cogging += m->cogging_Nm[k] * sin(6 * (k + 1) * theta + m->cogging_rad[k]);
    return f * sum + f * f * cogging - copysign(m->coulomb_Nm, speed) - m->viscous * speed;
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
            POLE_PAIRS);
    fclose(f);
    f = open_file(folder, "back_emf.csv");
    fprintf(f, "order,amplitude_Nm_per_A,phase_rad\n");
    for (int k = 0; k < 3; ++k)
        fprintf(f, "%d,%.17g,%.17g\n", EMF_ORDER[k], EMF_SHARE[k] * KT_NM_PER_A / 1.5, 0.0);
    fclose(f);
    f = open_file(folder, "cogging.csv");
    fprintf(f, "order,amplitude_Nm,phase_rad\n6,0.05,0.4\n12,0.02,-1.1\n");
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

static void write_run(const motor *m, const point *p, const char *folder)
{
    const double step = 2.0 * PI * TURNS / SAMPLES / fabs(p->speed);
    FILE *f = open_file(folder, p->name);
    fprintf(f, "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n");
    for (int k = 0; k < SAMPLES; ++k) {
        const double time = k * step, read = POLE_PAIRS * (p->speed * time + 0.3),
                     theta = read - m->offset_rad;
        double current[3];
        for (int s = 0; s < 3; ++s) {
            const double at = read - 2.0 * PI * s / 3.0;
            current[s] = p->q_A * sin(at) - p->d_A * cos(at);
        }
        fprintf(f, "%.7g,%.7g,%.5g,%.5g,%.5g,%.5g\n", time, read / POLE_PAIRS, current[0] + normal(NOISE_A),
                current[1] + normal(NOISE_A), current[2] + normal(NOISE_A),
                torque(m, theta, current, p->speed) + normal(NOISE_NM));
    }
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
    if (argc < 4) return fprintf(stderr, "motors COUNT SEED FOLDER [FIRST [SHARE [SIZE]]]\n"), 2;
    const long count = atol(argv[1]), first = argc > 4 ? atol(argv[4]) : 1;
    const uint64_t seed = (uint64_t)strtoull(argv[2], NULL, 10);
    const double share = argc > 5 ? atof(argv[5]) : 0.03, part = argc > 6 ? atof(argv[6]) : 1.0;
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
