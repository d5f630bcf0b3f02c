/* teeth SEED FOLDER: a machine of lumped teeth, and recordings of it.
 * teeth SEED play WAVEFORM.csv RECORDING.csv NUMBER: the recording of currents as solve writes them.
 * teeth SEED true WAVEFORM.csv: its torque without noise, N·m: mean, and maximum less minimum.
 *
 * The iron is a row of teeth with a gap of its own each, whose co-energy saturates:
 *
 *     W'(θ, i) = A Σ_j P(α_j) G(u_j)     G(u) = s² (√(1 + u²/s²) − 1)
 *     α_j = φ_j − θ     u_j = −Σ_n M_n cos nα_j + Σ_s i_s w(φ_j − 2πs/3)     T = p ∂W'/∂θ at constant i
 *
 * so that cogging, back-EMF, reluctance and saturation come from one law that is none of the series of the
 * library, with all orders and powers at once. Nothing here includes a header of the library or links with
 * it. */
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define PI 3.14159265358979323846

enum { MOST_TEETH = 12, MAGNETS = 4, MOST_ORDER = 60, DFT = 720, MOST_WAVEFORM = 1 << 17, PATH = 4096 };

/* ---- chance ---- */

static uint64_t state;

static double uniform(double from, double to)
{
    uint64_t x = state += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return from + (to - from) * ((double)((x ^ (x >> 31)) >> 11) + 0.5) * 0x1p-53;
}

static double normal(void)
{
    const double r = sqrt(-2.0 * log(uniform(0.0, 1.0)));
    return r * cos(uniform(0.0, 2.0 * PI));
}

/* ---- the machine ---- */

typedef struct {
    int pole_pairs, teeth;
    double size_Nm, knee, magnet[MAGNETS], saliency, winding[3]; /* of orders 1, 5, 7; mmf of 1 A */
    double uneven;                   /* every other tooth wider, and the rest narrower, by this share */
    double order_2_Nm, order_2_rad;  /* of cogging that no table has */
    double lost;                     /* share of the first cogging order that the table lacks */
    double rated_A, rated_Nm, noise; /* of the rated torque; 0: finite elements */
    int top;                         /* order of the declared cogging */
} teeth;

static double winding_at(const teeth *m, double phi)
{
    return m->winding[0] * cos(phi) + m->winding[1] * cos(5.0 * phi) + m->winding[2] * cos(7.0 * phi);
}

static double coenergy(const teeth *m, double theta, const double i[3])
{
    double sum = 0.0;
    for (int j = 0; j < m->teeth; ++j) {
        const double phi = 2.0 * PI * j / m->teeth, alpha = phi - theta;
        double u = 0.0;
        for (int n = 0; n < MAGNETS; ++n)
            u -= m->magnet[n] * cos((2 * n + 1) * alpha);
        for (int s = 0; s < 3; ++s)
            u += i[s] * winding_at(m, phi - 2.0 * PI * s / 3.0);
        const double gap = (1.0 + m->saliency * cos(2.0 * alpha)) * (1.0 + (j % 2 ? m->uneven : -m->uneven));
        sum += gap * m->knee * m->knee * (sqrt(1.0 + u * u / (m->knee * m->knee)) - 1.0);
    }
    return m->size_Nm * sum;
}

/* Central difference of sixth order. */
static double torque_of_iron(const teeth *m, double theta, const double i[3])
{
    static const double WEIGHT[] = {45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0};
    const double h = 4e-3;
    double sum = 0.0;
    for (int k = 1; k <= 3; ++k)
        sum += WEIGHT[k - 1] * (coenergy(m, theta + k * h, i) - coenergy(m, theta - k * h, i));
    return m->pole_pairs * sum / h;
}

static double torque_of(const teeth *m, double theta, const double i[3])
{
    return torque_of_iron(m, theta, i) + m->order_2_Nm * sin(2.0 * theta + m->order_2_rad);
}

static void phases(double theta, double d, double q, double i[3])
{
    for (int s = 0; s < 3; ++s)
        i[s] = q * sin(theta - 2.0 * PI * s / 3.0) - d * cos(theta - 2.0 * PI * s / 3.0);
}

static double mean_torque(const teeth *m, double d, double q)
{
    double sum = 0.0, i[3];
    for (int k = 0; k < DFT; ++k) {
        phases(2.0 * PI * k / DFT, d, q, i);
        sum += torque_of(m, 2.0 * PI * k / DFT, i) / DFT;
    }
    return sum;
}

static teeth draw(uint64_t seed)
{
    static const double NOISE[] = {0.0, 2e-4, 1e-3, 3e-3};
    teeth m = {.noise = NOISE[seed % 4]};
    state = seed * UINT64_C(0x2545f4914f6cdd1d) + 1;
    m.pole_pairs = 2 + (int)uniform(0.0, 3.0);
    m.teeth = 12;
    m.uneven = uniform(-0.05, 0.05);
    m.rated_A = exp(uniform(log(2.0), log(20.0)));
    m.magnet[0] = 1.0;
    for (int n = 1; n < MAGNETS; ++n)
        m.magnet[n] = uniform(-0.15, 0.15) / n;
    m.saliency = uniform(0.0, 1.0) < 0.5 ? 0.0 : uniform(-0.4, -0.1);
    m.winding[0] = uniform(0.08, 0.3) / m.rated_A;
    m.winding[1] = m.winding[0] * uniform(-0.05, 0.05);
    m.winding[2] = m.winding[0] * uniform(-0.03, 0.03);
    m.knee = uniform(1.0, 3.0);
    m.size_Nm = 1.0;
    m.lost = uniform(0.0, 1.0) < 0.5 ? 0.0 : uniform(-0.2, 0.2);
    m.top = uniform(0.0, 1.0) < 0.5 ? 36 : MOST_ORDER;
    m.rated_Nm = exp(uniform(log(0.5), log(20.0)));
    m.size_Nm = m.rated_Nm / mean_torque(&m, 0.0, m.rated_A);
    if (uniform(0.0, 1.0) < 0.25) m.order_2_Nm = m.rated_Nm * uniform(0.001, 0.01);
    m.order_2_rad = uniform(-PI, PI);
    return m;
}

/* ---- what is declared ---- */

static FILE *file_open(const char *folder, const char *name)
{
    char path[PATH];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    if (!f) {
        fprintf(stderr, "teeth: %s: %s\n", path, strerror(errno));
        exit(5);
    }
    return f;
}

/* Sine and cosine of one order of x[DFT]. */
static void order_of(const double *x, int n, double *sine, double *cosine)
{
    *sine = *cosine = 0.0;
    for (int k = 0; k < DFT; ++k) {
        *sine += 2.0 / DFT * x[k] * sin(2.0 * PI * n * k / DFT);
        *cosine += 2.0 / DFT * x[k] * cos(2.0 * PI * n * k / DFT);
    }
}

static void emf_write(const teeth *m, const char *folder)
{
    FILE *f = file_open(folder, "machine/back_emf.csv");
    double x[DFT], sine, cosine;
    const double h = 1e-4 * m->rated_A, plus[3] = {h, 0.0, 0.0}, minus[3] = {-h, 0.0, 0.0};
    for (int k = 0; k < DFT; ++k) {
        const double theta = 2.0 * PI * k / DFT;
        x[k] = (torque_of(m, theta, plus) - torque_of(m, theta, minus)) / (2.0 * h);
    }
    fputs("order,amplitude_Nm_per_A,phase_rad\n", f);
    for (int n = 1; n <= 31; n += 2) {
        order_of(x, n, &sine, &cosine);
        fprintf(f, "%d,%.10g,%.10g\n", n, hypot(sine, cosine), atan2(cosine, sine));
    }
    fclose(f);
}

static void cogging_write(const teeth *m, const char *folder)
{
    FILE *f = file_open(folder, "machine/cogging.csv");
    const double none[3] = {0.0, 0.0, 0.0};
    double x[DFT], sine, cosine;
    for (int k = 0; k < DFT; ++k)
        x[k] = torque_of_iron(m, 2.0 * PI * k / DFT, none);
    fputs("order,amplitude_Nm,phase_rad\n", f);
    for (int n = 6; n <= m->top; n += 6) {
        order_of(x, n, &sine, &cosine);
        fprintf(f, "%d,%.10g,%.10g\n", n, hypot(sine, cosine) * (n == 6 ? 1.0 - m->lost : 1.0),
                atan2(cosine, sine));
    }
    fclose(f);
}

static void machine_write(const teeth *m, const char *folder)
{
    FILE *f = file_open(folder, "machine/machine.csv");
    fprintf(f,
            "name,value,unit,source\npole_pairs,%d,1,\nconnection,star,,\nrated_current,%.10g,A,\n"
            "rated_torque,%.10g,Nm,\n",
            m->pole_pairs, 1.2 * m->rated_A, m->rated_Nm);
    fclose(f);
    f = file_open(folder, "target.csv");
    fprintf(f, "order,amplitude_Nm,phase_rad\n0,%.10g,1.5707963267948966\n", m->rated_Nm);
    fclose(f);
}

/* ---- recordings ---- */

/* Currents in the rotor frame over the angle: a mean and one order. */
typedef struct {
    double d, q, ripple, order;
} current;

static const char *header_of(const teeth *m)
{
    return m->noise > 0.0 ? "theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n"
                          : "theta_e_rad,ia_A,ib_A,ic_A,torque_Nm\n";
}

static double angle_of(const teeth *m, double theta)
{
    return m->noise > 0.0 ? theta / m->pole_pairs : theta;
}

/* One sample; finite elements have no noise. */
static void sample_write(const teeth *m, FILE *f, double theta, const double i[3], double *memory)
{
    double torque = torque_of(m, theta, i), seen[3];
    *memory = 0.8 * *memory + 0.6 * normal();
    torque += m->noise * m->rated_Nm * (0.9 * normal() + 0.436 * *memory);
    for (int s = 0; s < 3; ++s)
        seen[s] = i[s] + 0.3 * m->noise * m->rated_A * normal();
    fprintf(f, "%.10g,%.10g,%.10g,%.10g,%.10g\n", angle_of(m, theta), seen[0], seen[1], seen[2], torque);
}

static int samples_of(const teeth *m)
{
    return m->noise > 0.0 ? 2 * 149 : 180;
}

static double turns_of(const teeth *m)
{
    return m->noise > 0.0 ? 2.0 : 1.0;
}

static void run_write(const teeth *m, const char *folder, int k, const current *c)
{
    char name[32];
    double memory = 0.0, i[3];
    snprintf(name, sizeof name, "runs/%02d.csv", k);
    FILE *f = file_open(folder, name);
    fputs(header_of(m), f);
    for (int j = 0; j < samples_of(m); ++j) {
        const double theta = 2.0 * PI * turns_of(m) * j / samples_of(m);
        phases(theta, c->d + c->ripple * sin(c->order * theta), c->q + c->ripple * cos(c->order * theta), i);
        sample_write(m, f, theta, i, &memory);
    }
    fclose(f);
}

/* No current; the rated one and parts of it, ahead and behind, braking; and what a bench adds to that. */
static void runs_write(const teeth *m, const char *folder)
{
    static const current FIRST[] = {{0.0, 0.0, 0.0, 0.0},  {0.0, 1.0, 0.0, 0.0},  {0.0, 0.5, 0.0, 0.0},
                                    {0.0, 1.2, 0.0, 0.0},  {-0.5, 1.0, 0.0, 0.0}, {-1.0, 0.6, 0.0, 0.0},
                                    {0.4, 0.8, 0.0, 0.0},  {0.0, -1.0, 0.0, 0.0}, {-0.5, -0.5, 0.0, 0.0},
                                    {0.1, 0.9, 0.15, 6.0}, {-0.2, 0.7, 0.1, 12.0}};
    const int runs = 14 + (int)uniform(0.0, 3.0), first = (int)(sizeof FIRST / sizeof *FIRST);
    FILE *list = file_open(folder, "runs.csv");
    fputs("file,role\n", list);
    for (int k = 0; k < runs; ++k) {
        current c = {uniform(-0.9, 0.3), uniform(-0.9, 1.1), 0.0, 0.0};
        if (k < first) c = FIRST[k];
        c.d *= m->rated_A;
        c.q *= m->rated_A;
        c.ripple *= m->rated_A;
        run_write(m, folder, k, &c);
        fprintf(list, "runs/%02d.csv,%s\n", k, k >= runs - 2 ? "holdout" : "fit");
    }
    fclose(list);
}

/* ---- solved currents ---- */

/* One period of currents at even angles. */
typedef struct {
    double theta[MOST_WAVEFORM], i[MOST_WAVEFORM][3];
    int count;
} waveform;

static waveform played;

static void waveform_read(const char *path)
{
    char line[1024];
    FILE *f = fopen(path, "r");
    if (!f || !fgets(line, sizeof line, f)) {
        fprintf(stderr, "teeth: %s: cannot be read\n", path);
        exit(5);
    }
    for (double *i = played.i[0]; played.count < MOST_WAVEFORM && fgets(line, sizeof line, f);
         i = played.i[played.count])
        if (sscanf(line, "%lf,%lf,%lf,%lf", &played.theta[played.count], &i[0], &i[1], &i[2]) == 4)
            ++played.count;
    fclose(f);
}

static int true_print(const teeth *m, const char *path)
{
    double low = INFINITY, high = -INFINITY, mean = 0.0;
    waveform_read(path);
    for (int k = 0; k < played.count; ++k) {
        const double torque = torque_of(m, played.theta[k], played.i[k]);
        low = fmin(low, torque);
        high = fmax(high, torque);
        mean += torque / played.count;
    }
    printf("%.10g %.10g\n", mean, high - low);
    return 0;
}

/* A straight line between the angles of the waveform. at: in samples. */
static void currents_at(double at, double i[3])
{
    const int k = (int)at % played.count, next = (k + 1) % played.count;
    for (int s = 0; s < 3; ++s)
        i[s] = played.i[k][s] + (at - floor(at)) * (played.i[next][s] - played.i[k][s]);
}

static int play(const teeth *m, const char *waveform_path, uint64_t number, const char *path)
{
    double memory = 0.0, i[3];
    waveform_read(waveform_path);
    FILE *f = fopen(path, "w");
    if (!f || played.count == 0) return 5;
    state += number * UINT64_C(0xd1342543de82ef95);
    fputs(header_of(m), f);
    for (int j = 0; j < samples_of(m); ++j) {
        const double turns = turns_of(m) * j / samples_of(m);
        currents_at((turns - floor(turns)) * played.count, i);
        sample_write(m, f, 2.0 * PI * turns, i, &memory);
    }
    fclose(f);
    return 0;
}

/* ---- command ---- */

static void folder_make(const char *folder, const char *name)
{
    char path[PATH];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (mkdir(path, 0777) == 0 || errno == EEXIST) return;
    fprintf(stderr, "teeth: %s: %s\n", path, strerror(errno));
    exit(5);
}

static int case_write(const teeth *m, const char *folder)
{
    folder_make(folder, "");
    folder_make(folder, "machine");
    folder_make(folder, "runs");
    machine_write(m, folder);
    emf_write(m, folder);
    cogging_write(m, folder);
    runs_write(m, folder);
    return 0;
}

int main(int argc, char **argv)
{
    const char *what = argc > 3 ? argv[2] : "";
    const teeth m = draw(argc > 1 ? strtoull(argv[1], NULL, 10) : 0);
    if (argc == 3) return case_write(&m, argv[2]);
    if (argc == 4 && strcmp(what, "true") == 0) return true_print(&m, argv[3]);
    if (argc == 6 && strcmp(what, "play") == 0)
        return play(&m, argv[3], strtoull(argv[5], NULL, 10), argv[4]);
    fputs("usage: teeth SEED FOLDER | teeth SEED play WAVEFORM RECORDING NUMBER | teeth SEED true WAVEFORM\n",
          stderr);
    return 2;
}
