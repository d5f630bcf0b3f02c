#include "cli/terminal/estimate.h"

#include <math.h>

#define SETTLING_s   1.5  /* time constant of the smoothing … */
#define GOOD_NEWS_s  0.5  /* … and where the end comes nearer */
#define LEAST_SHARE  0.02 /* from which a share is used … */
#define LEAST_TIME_s 0.5  /* … and the time it must have taken */

void cli_estimate_begin(cli_estimate *e, double now_s, double share)
{
    e->from_s = e->now_s = now_s;
    e->from_share = e->share = share;
    e->end_s = NAN;
}

void cli_estimate_follow(cli_estimate *e, double now_s, double share)
{
    const double before_s = e->now_s, gone = share - e->from_share;
    if (share < e->share) {
        cli_estimate_begin(e, now_s, share);
        return;
    }
    e->now_s = now_s;
    e->share = share;
    if (gone < LEAST_SHARE || now_s - e->from_s < LEAST_TIME_s) return;
    const double end_s = now_s + (now_s - e->from_s) * (1.0 - share) / gone;
    const double settling_s = end_s < e->end_s ? GOOD_NEWS_s : SETTLING_s;
    if (isnan(e->end_s))
        e->end_s = end_s;
    else
        e->end_s += (end_s - e->end_s) * -expm1(-(now_s - before_s) / settling_s);
}

double cli_estimate_left_s(const cli_estimate *e)
{
    return isnan(e->end_s) ? e->end_s : fmax(0.0, e->end_s - e->now_s);
}

double cli_estimate_share_per_s(const cli_estimate *e)
{
    return (e->share - e->from_share) / (e->now_s - e->from_s);
}
