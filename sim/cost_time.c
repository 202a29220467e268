/* sim/cost_time.c -- how long settings of lux4 cost will take, as the rungs so far say.
 *
 * A rung that has reached the accuracy p in t seconds is taken to reach q < p in
 *
 *     t (p / q)^e,    e = log(t / t') / log(p' / p)    within [1, 2], of it and the rung before
 *
 * where p is what was reached, not what was asked for: the first rounds may do for several rungs.
 */
#include "sim/cost_parts.h"

#include <math.h>

static const double least_growth = 1.0, most_growth = 2.0; /* e */
static const double more = 1.3;                            /* as much time at least tells e */

static double growth_at(const cost_list *l, int k)
{
    const cost_sample *now = &l->all[k].sample[0];
    if (k < 1)
        return most_growth;
    const cost_sample *before = &l->all[k - 1].sample[0];
    double e = log(now->seconds / before->seconds) / log(before->reached / now->reached);
    if (!(now->seconds > more * before->seconds) || !(before->reached > now->reached))
        return most_growth;
    return fmin(fmax(e, least_growth), most_growth);
}

double cost_predict(const cost_list *l, int k, double accuracy)
{
    const cost_sample *s = &l->all[k].sample[0];
    double farther = isfinite(s->reached) ? s->reached / accuracy : l->all[k].accuracy / accuracy;
    return s->seconds * pow(fmax(farther, 1.0), growth_at(l, k));
}

int cost_rung_of_others(const cost_list *l, int finest, double asked)
{
    int k = 0;
    while (k < finest && l->all[k].accuracy > asked * (1.0 + 1e-9))
        k++;
    return k;
}

double cost_still_to_do(const cost_list *l, int k, bool next, double asked, double scene_seconds)
{
    int finest     = next ? k + 1 : k;
    double coming  = next ? cost_predict(l, k, l->all[finest].accuracy) : 0.0;
    double sum     = cost_predict(l, k, l->all[finest].accuracy / COST_TIGHTER);
    int at         = cost_rung_of_others(l, finest, asked);
    double another = at > k ? coming : l->all[at].sample[0].seconds;
    for (int i = 0; i <= k; i++)
        sum += (COST_RUNS - 1) * l->all[i].sample[0].seconds;
    for (int i = l->rungs; i < l->count; i++)
        if (!l->all[i].usual)
            sum += COST_RUNS * another + (cost_own_scene(l, &l->all[i]) ? scene_seconds : 0.0);
    return sum + COST_RUNS * coming;
}
