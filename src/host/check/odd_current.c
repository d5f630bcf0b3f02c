#include "host/check/own_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* So near to −1 a gain is a sign. */
#define A_SIGN 0.2

static const char PHASE[] = "abc";

/* "; in 1 of 5 recordings": files with a current, of which some have it. */
static void say_share(const check_data *data, const check_run *odd, hci_check_finding *f)
{
    const size_t used = strlen(f->words);
    const char *path = "";
    size_t all = 0, alike = 0;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (strcmp(r->path, path) == 0 || !r->has_abc || !hci_check_has_current(data, r)) continue;
        path = r->path;
        ++all;
        alike += r->channel.state == odd->channel.state && r->channel.phase == odd->channel.phase;
    }
    if (alike < all)
        snprintf(f->words + used, sizeof f->words - used, "; in %zu of %zu recordings, such as %.40s", alike,
                 all, hci_check_name_of(odd->path));
}

/* Of a unit without an exponent. */
static void say_gain(double gain, char text[12])
{
    snprintf(text, 12, fabs(gain) < 100.0 || fabs(gain) > 1e9 ? "%.3g" : "%.0f", gain);
}

static void say_odd(const check_run *r, hci_check_finding *f)
{
    const int odd = r->channel.phase;
    const char a = PHASE[(odd + 1) % 3], b = PHASE[(odd + 2) % 3], x = PHASE[odd];
    char gain[12];
    say_gain(r->channel.gain, gain);
    if (r->channel.state == CHECK_CHANNEL_DEAD)
        snprintf(f->words, sizeof f->words,
                 "the current of phase %c reads nothing, where %c and %c do not sum to 0", x, a, b);
    else if (fabs(r->channel.gain + 1.0) < A_SIGN)
        snprintf(
            f->words, sizeof f->words,
            "the current of phase %c has the other sign than those of %c and %c: its clamp sits the other "
            "way round",
            x, a, b);
    else
        snprintf(f->words, sizeof f->words,
                 "the current of phase %c reads %s times what those of %c and %c leave for it: the range or "
                 "unit of its probe",
                 x, gain, a, b);
}

static void say_remedy(const check_run *r, hci_check_finding *f)
{
    const int odd = r->channel.phase;
    const char x = PHASE[odd];
    char gain[12];
    say_gain(r->channel.gain, gain);
    if (r->channel.state == CHECK_CHANNEL_DEAD)
        snprintf(f->should_be, sizeof f->should_be, "left out, as it is 0 less the two others");
    else if (fabs(r->channel.gain + 1.0) < A_SIGN)
        snprintf(f->should_be, sizeof f->should_be, "with the opposite sign: --column 'i%c=-%.60s'", x,
                 f->column);
    else
        snprintf(f->should_be, sizeof f->should_be, "divided by %s: --column 'i%c=%.60s/%s'", gain, x,
                 f->column, gain);
}

static void say_twins(const check_run *r, hci_check_finding *f)
{
    const int other = r->channel.phase;
    snprintf(
        f->words, sizeof f->words,
        "the currents of phases %c and %c are the same, so that one of the two columns is of another phase",
        PHASE[(other + 1) % 3], PHASE[(other + 2) % 3]);
    snprintf(f->should_be, sizeof f->should_be, "the current of its own phase");
}

void hci_check_add_channel(const check_data *data, hci_check *check)
{
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (r->channel.state == CHECK_CHANNELS_AGREE || !r->channel_cell.path ||
            !hci_check_has_current(data, r))
            continue;
        hci_check_finding f =
            hci_check_finding_at("current_channel", &r->channel_cell,
                                 "the three currents of a machine without neutral, which sum to 0");
        if (r->channel.state == CHECK_CHANNELS_TWINS) {
            say_twins(r, &f);
            check->findings = 0; /* of currents that are not those of the machine */
        } else {
            say_odd(r, &f);
            say_remedy(r, &f);
        }
        say_share(data, r, &f);
        hci_check_put_first(check, &f);
        return;
    }
}
