/* How well `hci-solve diagnose` names what the rig has hidden: many cases, a table by kind, and the aims. */
#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { PATH = 4096, NAME = 64, KINDS = 64, FIELDS = 16, LINE = 16384, PARAMETERS = 256, REQUIREMENTS = 8 };

static const char *const EFFECT[] = {"cogging",         "back_emf",
                                     "phase_imbalance", "reluctance",
                                     "saturation",      "magnet_temperature",
                                     "current_offset",  "current_gain",
                                     "position_offset", "position_eccentricity",
                                     "channel_delay",   "friction",
                                     "torque_sensor",   "mechanical_order",
                                     "unknown",         "(other)"};
enum { EFFECTS = sizeof EFFECT / sizeof *EFFECT, UNKNOWN = EFFECTS - 2, OTHER = EFFECTS - 1 };

typedef uint32_t effect_set; /* bit k: EFFECT[k] */

typedef struct {
    const char *rig, *solve, *keep;
    char folder[PATH]; /* of all cases */
    char kind[KINDS][NAME];
    int kinds, cases, jobs, timeout_s;
    uint64_t seed;
    bool verbose;
    const char *require;
} options;

typedef struct {
    const char *kind;
    uint64_t seed;
    pid_t pid; /* of whoever works at it; 0: nobody */
    bool done, crashed;
    int code;
    double seconds;
    effect_set truth, added, ambiguous;
    double noise_Nm, holdout; /* ratio; NAN: none */
    int parameters, within_1, within_2;
} score_case;

static void die(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("score: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(2);
}

static void join(char path[PATH], const char *folder, const char *name)
{
    const int length = snprintf(path, PATH, "%s/%s", folder, name);
    if (length < 0 || length >= PATH) die("%s: the path is too long", folder);
}

static bool is_invention(const char *kind)
{
    return strncmp(kind, "unknown_", 8) == 0;
}

/* ---- tables ---- */

typedef struct {
    FILE *file;
    char header[LINE], line[LINE];
    char *name[FIELDS], *field[FIELDS];
    int names, fields;
} table;

/* Cuts a line at its commas, RFC 4180, in place. */
static int cut(char *line, char *field[FIELDS])
{
    int count = 0;
    char *out = line;
    line[strcspn(line, "\r\n")] = '\0';
    for (bool more = true; more && count < FIELDS;) {
        bool quoted = false;
        field[count++] = out;
        for (; *line && (quoted || *line != ','); ++line)
            if (*line == '"')
                quoted = !quoted;
            else
                *out++ = *line;
        more = *line == ',';
        ++line;
        *out++ = '\0';
    }
    return count;
}

static bool table_open(table *t, const char *folder, const char *name)
{
    char path[PATH];
    join(path, folder, name);
    t->file = fopen(path, "r");
    if (!t->file) return false;
    do
        if (!fgets(t->header, LINE, t->file)) t->header[0] = '\0';
    while (t->header[0] == '#');
    t->names = cut(t->header, t->name);
    return true;
}

static bool table_next(table *t)
{
    if (t->file && fgets(t->line, LINE, t->file)) {
        t->fields = cut(t->line, t->field);
        return true;
    }
    if (t->file) fclose(t->file);
    t->file = NULL;
    return false;
}

/* "": there is no such column. */
static const char *cell(const table *t, const char *name)
{
    for (int k = 0; k < t->names && k < t->fields; ++k)
        if (strcmp(t->name[k], name) == 0) return t->field[k];
    return "";
}

static double number(const table *t, const char *name)
{
    const char *text = cell(t, name);
    char *end;
    const double value = strtod(text, &end);
    return end == text ? (double)NAN : value;
}

static effect_set set_of(const char *effect)
{
    int k = 0;
    while (k < OTHER && strcmp(EFFECT[k], effect) != 0)
        ++k;
    return (effect_set)1 << k;
}

/* ---- parameters ---- */

typedef struct {
    char effect[NAME], name[NAME];
    double order, value, std_error;
} parameter;

static double factor_of(const char *unit)
{
    static const struct {
        const char *unit;
        double factor;
    } LIST[] = {{"deg", 0.017453292519943295},
                {"mA", 1e-3},
                {"us", 1e-6},
                {"ms", 1e-3},
                {"mNm", 1e-3},
                {"%", 0.01},
                {"mH", 1e-3},
                {"uH", 1e-6},
                {"kHz", 1e3},
                {"mNm_per_A", 1e-3}};
    for (size_t k = 0; k < sizeof LIST / sizeof *LIST; ++k)
        if (strcmp(unit, LIST[k].unit) == 0) return LIST[k].factor;
    return 1.0;
}

static parameter parameter_of(const table *t)
{
    parameter p = {"", "", NAN, NAN, NAN};
    const double factor = factor_of(cell(t, "unit"));
    snprintf(p.effect, sizeof p.effect, "%.63s", cell(t, "effect"));
    snprintf(p.name, sizeof p.name, "%.63s", cell(t, "parameter"));
    char *mark = strrchr(p.name, '_'), *end;
    if (mark && mark[1] >= '0' && mark[1] <= '9') {
        const double order = strtod(mark + 1, &end);
        if (*end == '\0') {
            p.order = order;
            *mark = '\0';
        }
    }
    p.value = factor * number(t, "value");
    p.std_error = factor * number(t, "std_error");
    return p;
}

static int parameters_read(const char *folder, const char *name, parameter list[PARAMETERS])
{
    static table t;
    int count = 0;
    if (!table_open(&t, folder, name)) return 0;
    while (table_next(&t))
        if (count < PARAMETERS) list[count++] = parameter_of(&t);
    return count;
}

static const parameter *find(const parameter *list, int count, const char *effect, const char *name,
                             double order)
{
    for (int k = 0; k < count; ++k) {
        const bool same_order = isnan(order) ? isnan(list[k].order) : fabs(list[k].order - order) < 1e-5;
        if (same_order && strcmp(list[k].effect, effect) == 0 && strcmp(list[k].name, name) == 0)
            return &list[k];
    }
    return NULL;
}

/* The degree of dAqB, in which a value follows the reference current. */
static int degree_of(const char *name)
{
    return name[0] == 'd' && name[1] >= '0' && name[1] <= '9' && name[2] == 'q'
               ? name[1] - '0' + name[3] - '0'
               : 0;
}

static double reference_of(const parameter *list, int count)
{
    const parameter *p = find(list, count, "saturation", "reference_current", NAN);
    return p ? p->value : 1.0;
}

static void compare_parameters(score_case *c, const char *folder)
{
    static parameter truth[PARAMETERS], found[PARAMETERS];
    const int truths = parameters_read(folder, "truth.csv", truth);
    const int count = parameters_read(folder, "out/machine/effects.csv", found);
    const double ratio = reference_of(truth, truths) / reference_of(found, count);
    for (int k = 0; k < truths; ++k) {
        const parameter *p = find(found, count, truth[k].effect, truth[k].name, truth[k].order);
        if (!p || !(p->std_error > 0.0) || strcmp(p->name, "reference_current") == 0) continue;
        const double scale = strcmp(p->effect, "saturation") == 0 ? pow(ratio, degree_of(p->name)) : 1.0;
        const double errors = fabs(scale * p->value - truth[k].value) / (scale * p->std_error);
        ++c->parameters;
        c->within_1 += errors <= 1.0;
        c->within_2 += errors <= 2.0;
    }
}

/* ---- a case ---- */

static void read_truth(score_case *c, const char *folder)
{
    static table t;
    c->noise_Nm = NAN;
    if (!table_open(&t, folder, "truth.csv")) return;
    while (table_next(&t)) {
        const char *effect = cell(&t, "effect");
        if (strcmp(effect, "noise") == 0)
            c->noise_Nm = number(&t, "value");
        else if (!is_invention(effect))
            c->truth |= set_of(effect);
    }
}

static bool read_verdicts(score_case *c, const char *folder)
{
    static table t;
    if (!table_open(&t, folder, "out/effects.csv")) return false;
    while (table_next(&t)) {
        const char *verdict = cell(&t, "verdict");
        if (strcmp(verdict, "added") == 0) c->added |= set_of(cell(&t, "effect"));
        if (strcmp(verdict, "ambiguous") == 0) c->ambiguous |= set_of(cell(&t, "effect"));
    }
    return true;
}

/* The runs count alike, as they do in truth.csv. */
static void read_errors(score_case *c, const char *folder)
{
    static table t;
    double square = 0.0;
    int runs = 0;
    c->holdout = NAN;
    if (!table_open(&t, folder, "out/errors.csv")) return;
    while (table_next(&t))
        if (strcmp(cell(&t, "role"), "holdout") == 0) {
            const double rms = number(&t, "rms_after_Nm");
            square += rms * rms;
            ++runs;
        }
    if (runs > 0) c->holdout = sqrt(square / runs) / c->noise_Nm;
}

static void case_folder(const options *o, const score_case *c, char path[PATH])
{
    char name[2 * NAME];
    snprintf(name, sizeof name, "%s_%llu", c->kind, (unsigned long long)c->seed);
    join(path, o->folder, name);
}

static void remove_tree(const char *path)
{
    DIR *folder = opendir(path);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        char inner[PATH];
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        join(inner, path, entry->d_name);
        if (unlink(inner) != 0) remove_tree(inner);
    }
    if (folder) closedir(folder);
    rmdir(path);
}

/* What the worker found out about the program itself. */
static void read_status(score_case *c, const char *folder)
{
    char path[PATH], line[LINE] = "", *end;
    join(path, folder, "status");
    FILE *f = fopen(path, "r");
    if (f && !fgets(line, sizeof line, f)) line[0] = '\0';
    if (f) fclose(f);
    c->code = (int)strtol(line, &end, 10);
    c->seconds = strtod(end, NULL);
    c->crashed = line[0] == '\0' || c->code < 0 || c->code > 1;
}

static void evaluate(const options *o, score_case *c)
{
    char folder[PATH];
    case_folder(o, c, folder);
    read_status(c, folder);
    read_truth(c, folder);
    if (!read_verdicts(c, folder)) c->crashed = true;
    read_errors(c, folder);
    compare_parameters(c, folder);
    if (!o->keep) remove_tree(folder);
    c->done = true;
}

/* ---- running ---- */

/* Its exit code, or minus the signal that ended it. */
static int run_program(char *const *argument, const char *log, int timeout_s)
{
    int status = 0;
    const pid_t pid = fork();
    if (pid == 0) {
        const int file = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        dup2(file, STDOUT_FILENO);
        dup2(file, STDERR_FILENO);
        alarm((unsigned)timeout_s);
        execvp(argument[0], argument);
        fprintf(stderr, "%s: %s\n", argument[0], strerror(errno));
        _exit(127);
    }
    while (pid < 0 || waitpid(pid, &status, 0) < 0)
        if (errno != EINTR) return 127;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

static double seconds_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static char *copied(const char *text)
{
    char *copy = malloc(strlen(text) + 1);
    if (!copy) die("out of memory");
    return strcpy(copy, text);
}

/* Makes the case, has it diagnosed, and leaves exit code and seconds in a file. */
static int work_at(const options *o, const score_case *c)
{
    char folder[PATH], machine[PATH], runs[PATH], out[PATH], log[PATH], seed[NAME];
    case_folder(o, c, folder);
    join(machine, folder, "machine");
    join(runs, folder, "runs.csv");
    join(out, folder, "out");
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)c->seed);
    mkdir(folder, 0777);
    join(log, folder, "rig.log");
    char *rig[] = {copied(o->rig), copied(c->kind), seed, folder, NULL};
    if (run_program(rig, log, o->timeout_s) != 0) return 1;
    join(log, folder, "solve.log");
    char *solve[] = {copied(o->solve),
                     copied("diagnose"),
                     machine,
                     copied("--runs"),
                     runs,
                     copied("-o"),
                     out,
                     copied("--quiet"),
                     NULL};
    const double start = seconds_now();
    const int code = run_program(solve, log, o->timeout_s);
    const double seconds = seconds_now() - start;
    join(log, folder, "status");
    FILE *f = fopen(log, "w");
    if (!f) return 1;
    fprintf(f, "%d %.3f\n", code, seconds);
    return fclose(f) != 0;
}

static void start(const options *o, score_case *c)
{
    fflush(NULL);
    c->pid = fork();
    if (c->pid < 0) die("fork: %s", strerror(errno));
    if (c->pid == 0) _exit(work_at(o, c));
}

static void print_set(effect_set s)
{
    bool first = true;
    for (int k = 0; k < EFFECTS; ++k)
        if (s >> k & 1u) {
            printf("%s%s", first ? "" : "+", EFFECT[k]);
            first = false;
        }
    if (first) putchar('-');
}

static double credit(const score_case *c);

static void print_case(const score_case *c)
{
    printf("%-3g %s %llu: ", credit(c), c->kind, (unsigned long long)c->seed);
    print_set(c->truth);
    fputs(" | added ", stdout);
    print_set(c->added);
    fputs(" | ambiguous ", stdout);
    print_set(c->ambiguous);
    printf(" | held-out %.3f | within 2: %d/%d | exit %d, %.2f s%s\n", c->holdout, c->within_2, c->parameters,
           c->code, c->seconds, c->crashed ? " CRASHED" : "");
    fflush(stdout);
}

static void run_all(const options *o, score_case *list, int count)
{
    int started = 0, running = 0, printed = 0;
    while (printed < count) {
        while (running < o->jobs && started < count) {
            start(o, &list[started++]);
            ++running;
        }
        const pid_t pid = wait(NULL);
        if (pid < 0 && errno != EINTR) die("wait: %s", strerror(errno));
        for (int k = 0; k < started; ++k)
            if (pid > 0 && list[k].pid == pid && !list[k].done) {
                evaluate(o, &list[k]);
                --running;
            }
        for (; printed < count && list[printed].done; ++printed)
            if (o->verbose || list[printed].crashed) print_case(&list[printed]);
    }
}

/* ---- judging ---- */

static int size_of(effect_set s)
{
    int n = 0;
    for (; s; s &= s - 1)
        ++n;
    return n;
}

/* 1: exactly what was hidden; ½: that is among what fits as well. */
static double credit(const score_case *c)
{
    const effect_set truth = is_invention(c->kind) ? (effect_set)1 << UNKNOWN : c->truth;
    const effect_set named = c->added | c->ambiguous;
    if (c->crashed) return 0.0;
    if (c->added == truth) return c->ambiguous & ~truth ? 0.5 : 1.0;
    if (truth == 0 || is_invention(c->kind)) return 0.0;
    return (named & truth) == truth && size_of(c->added & ~truth) <= size_of(c->ambiguous & truth) ? 0.5
                                                                                                   : 0.0;
}

static bool has_false_addition(const score_case *c)
{
    const effect_set unknown = (effect_set)1 << UNKNOWN;
    return (c->added & ~c->truth & (strcmp(c->kind, "none") == 0 ? ~(effect_set)0 : ~unknown)) != 0;
}

typedef struct {
    int cases, false_cases, crashes, parameters, within_1, within_2, held_out;
    double credit, holdout, worst, seconds;
} tally;

static void count_case(tally *t, const score_case *c)
{
    ++t->cases;
    t->credit += credit(c);
    t->false_cases += has_false_addition(c);
    t->crashes += c->crashed;
    t->parameters += c->parameters;
    t->within_1 += c->within_1;
    t->within_2 += c->within_2;
    t->seconds += c->seconds;
    if (isnan(c->holdout)) return;
    ++t->held_out;
    t->holdout += c->holdout;
    t->worst = fmax(t->worst, c->holdout);
}

static double share(double part, int whole)
{
    return whole > 0 ? part / whole : (double)NAN;
}

static void print_percent(double value)
{
    if (isnan(value))
        printf("      -");
    else
        printf(" %5.1f%%", 100.0 * value);
}

static void print_row(const char *name, const tally *t)
{
    printf("%-22s %5d", name, t->cases);
    print_percent(share(t->credit, t->cases));
    print_percent(share(t->false_cases, t->cases));
    if (t->held_out > 0)
        printf("  %7.3f %7.3f", t->holdout / t->held_out, t->worst);
    else
        printf("        -       -");
    printf("  %5d", t->parameters);
    print_percent(share(t->within_1, t->parameters));
    print_percent(share(t->within_2, t->parameters));
    printf("  %6.2f", share(t->seconds, t->cases));
    if (t->crashes) printf("  %d crashed", t->crashes);
    putchar('\n');
}

enum { ALL, SINGLE, TWO, NONE, INVENTED, FITTED, GROUPS };

/* FITTED: everything whose true machine is in the catalogue. */
static void count_groups(const score_case *list, int count, tally group[GROUPS])
{
    memset(group, 0, GROUPS * sizeof *group);
    for (int k = 0; k < count; ++k) {
        const char *kind = list[k].kind;
        const bool none = strcmp(kind, "none") == 0, two = strcmp(kind, "two") == 0;
        count_case(&group[ALL], &list[k]);
        count_case(&group[is_invention(kind) ? INVENTED : none ? NONE : two ? TWO : SINGLE], &list[k]);
        if (!is_invention(kind)) count_case(&group[FITTED], &list[k]);
    }
}

static void print_kinds(const options *o, const score_case *list, int count)
{
    printf("%-22s %5s %6s %6s  %7s %7s  %5s %6s %6s  %6s\n", "kind", "cases", "exact", "false", "held-out",
           "worst", "param", "1 se", "2 se", "s");
    for (int kind = 0; kind < o->kinds; ++kind) {
        tally t = {0};
        for (int k = 0; k < count; ++k)
            if (strcmp(list[k].kind, o->kind[kind]) == 0) count_case(&t, &list[k]);
        print_row(o->kind[kind], &t);
    }
}

typedef struct {
    const char *name, *words;
    double value, aim;
    bool at_most;
} figure;

enum { FIGURES = 8 };

static void list_figures(const tally group[GROUPS], figure list[FIGURES])
{
    const tally *fitted = &group[FITTED];
    const figure all[FIGURES] = {
        {"exact", "exact, all kinds", share(group[ALL].credit, group[ALL].cases), 0.95, false},
        {"single", "exact, one effect", share(group[SINGLE].credit, group[SINGLE].cases), 0.95, false},
        {"two", "exact, two effects", share(group[TWO].credit, group[TWO].cases), 0.95, false},
        {"unknown", "inventions reported as unknown", share(group[INVENTED].credit, group[INVENTED].cases),
         0.95, false},
        {"false", "additions with nothing hidden", share(group[NONE].false_cases, group[NONE].cases), 0.02,
         true},
        {"holdout", "held-out / noise, mean", share(fitted->holdout, fitted->held_out), 1.15, true},
        {"worst", "held-out / noise, worst", share(fitted->worst, fitted->held_out > 0), 1.15, true},
        {"within2", "parameters within 2 std errors", share(fitted->within_2, fitted->parameters), 0.90,
         false},
    };
    memcpy(list, all, sizeof all);
}

static bool holds(const figure *f, double bar)
{
    return isnan(f->value) || (f->at_most ? f->value <= bar : f->value >= bar);
}

static void print_figures(const figure *list)
{
    printf("\n%-34s %8s %8s\n", "", "found", "aim");
    for (int k = 0; k < FIGURES; ++k)
        if (!isnan(list[k].value))
            printf("%-34s %8.3f %s %5.3f  %s\n", list[k].words, list[k].value,
                   list[k].at_most ? "<=" : ">=", list[k].aim,
                   holds(&list[k], list[k].aim) ? "met" : "not met");
}

/* exact=0.9,false=0.05 */
static bool meets(const char *require, const figure *list)
{
    bool good = true;
    for (const char *at = require; at && *at;) {
        const size_t length = strcspn(at, "=");
        char *end;
        int k = 0;
        while (k < FIGURES && !(strlen(list[k].name) == length && strncmp(list[k].name, at, length) == 0))
            ++k;
        if (k == FIGURES || at[length] != '=')
            die("--require %s: found `%s`, expected name=value", require, at);
        const double bar = strtod(at + length + 1, &end);
        if (!holds(&list[k], bar)) {
            printf("REQUIRED %s %s %g: found %.4g\n", list[k].name, list[k].at_most ? "<=" : ">=", bar,
                   list[k].value);
            good = false;
        }
        at = *end == ',' ? end + 1 : end;
        if (end[0] != ',' && end[0] != '\0') die("--require %s: found `%s`, expected a number", require, end);
    }
    return good;
}

/* ---- command ---- */

static void usage(int code)
{
    fputs("score --solve PATH [--rig PATH] [--cases N] [--seed S | --fresh] [--kinds a,b,c] [--jobs N]\n"
          "      [--timeout SECONDS] [--keep FOLDER] [--verbose] [--require exact=0.9,false=0.05,...]\n"
          "--cases     per kind, standard 10\n"
          "--kinds     standard: all of `rig --list`\n"
          "--keep      leaves every case in FOLDER/KIND_SEED\n"
          "--require   exit code 1 unless exact, single, two, unknown, within2 are at least, and false,\n"
          "            holdout, worst at most what is given\n",
          code ? stderr : stdout);
    exit(code);
}

static void add_kinds(options *o, const char *text)
{
    while (*text && o->kinds < KINDS) {
        const size_t length = strcspn(text, ",\n");
        snprintf(o->kind[o->kinds++], NAME, "%.*s", (int)length, text);
        text += length;
        text += *text == ',' || *text == '\n';
    }
}

/* From the rig itself. */
static void add_all_kinds(options *o)
{
    char command[PATH + 16], line[NAME];
    snprintf(command, sizeof command, "'%s' --list", o->rig);
    FILE *pipe = popen(command, "r");
    while (pipe && fgets(line, sizeof line, pipe))
        add_kinds(o, line);
    if (!pipe || pclose(pipe) != 0 || o->kinds == 0) die("%s --list: failed", o->rig);
}

static long whole(const char *text)
{
    char *end;
    const long value = strtol(text, &end, 10);
    if (*text == '\0' || *end != '\0' || value < 1) die("found `%s`, expected a whole number from 1", text);
    return value;
}

static void read_option(options *o, const char *name, const char *value)
{
    if (strcmp(name, "--solve") == 0)
        o->solve = value;
    else if (strcmp(name, "--rig") == 0)
        o->rig = value;
    else if (strcmp(name, "--cases") == 0)
        o->cases = (int)whole(value);
    else if (strcmp(name, "--seed") == 0)
        o->seed = (uint64_t)whole(value);
    else if (strcmp(name, "--kinds") == 0)
        add_kinds(o, value);
    else if (strcmp(name, "--jobs") == 0)
        o->jobs = (int)whole(value);
    else if (strcmp(name, "--timeout") == 0)
        o->timeout_s = (int)whole(value);
    else if (strcmp(name, "--keep") == 0)
        o->keep = value;
    else if (strcmp(name, "--require") == 0)
        o->require = value;
    else
        usage(2);
}

static void read_options(options *o, int argc, char **argv)
{
    for (int k = 1; k < argc; ++k) {
        if (strcmp(argv[k], "--help") == 0) usage(0);
        if (strcmp(argv[k], "--verbose") == 0) {
            o->verbose = true;
        } else if (strcmp(argv[k], "--fresh") == 0) {
            o->seed = (uint64_t)time(NULL) * 1000u;
        } else {
            if (k + 1 >= argc) usage(2);
            read_option(o, argv[k], argv[k + 1]);
            ++k;
        }
    }
    if (!o->solve) usage(2);
}

/* The rig lies beside this program. */
static const char *beside(const char *program)
{
    static char path[PATH];
    const char *slash = strrchr(program, '/');
    snprintf(path, sizeof path, "%.*srig", slash ? (int)(slash - program + 1) : 0, program);
    return path;
}

static void make_folder(options *o)
{
    const char *temporary = getenv("TMPDIR");
    if (o->keep) {
        snprintf(o->folder, sizeof o->folder, "%s", o->keep);
        if (mkdir(o->folder, 0777) != 0 && errno != EEXIST) die("%s: %s", o->folder, strerror(errno));
        return;
    }
    snprintf(o->folder, sizeof o->folder, "%s/hci-score-XXXXXX", temporary ? temporary : "/tmp");
    if (!mkdtemp(o->folder)) die("%s: %s", o->folder, strerror(errno));
}

/* Before the work: a figure that is not known yet holds any bar. */
static void check_require(const options *o)
{
    const tally none[GROUPS] = {{0}};
    figure figures[FIGURES];
    list_figures(none, figures);
    meets(o->require, figures);
}

static int report(const options *o, const score_case *list, int count)
{
    tally group[GROUPS];
    figure figures[FIGURES];
    count_groups(list, count, group);
    list_figures(group, figures);
    print_kinds(o, list, count);
    print_row("total", &group[ALL]);
    print_figures(figures);
    const bool good = meets(o->require, figures);
    if (group[ALL].crashes) printf("%d of %d crashed\n", group[ALL].crashes, count);
    return group[ALL].crashes || !good;
}

int main(int argc, char **argv)
{
    static options o = {.cases = 10, .jobs = 2, .timeout_s = 300, .seed = 1};
    o.rig = beside(argv[0]);
    read_options(&o, argc, argv);
    if (o.kinds == 0) add_all_kinds(&o);
    check_require(&o);
    make_folder(&o);
    const int count = o.kinds * o.cases;
    score_case *list = calloc((size_t)count, sizeof *list);
    if (!list) die("out of memory");
    for (int k = 0; k < count; ++k) {
        list[k].kind = o.kind[k / o.cases];
        list[k].seed = o.seed + (uint64_t)(k % o.cases);
    }
    printf("seeds %llu to %llu\n", (unsigned long long)o.seed,
           (unsigned long long)o.seed + (unsigned)o.cases - 1u);
    run_all(&o, list, count);
    const int code = report(&o, list, count);
    if (!o.keep) remove_tree(o.folder);
    free(list);
    return code;
}
