/* sim/plan_transport.c -- paths or maps: which reaches the accuracy asked for sooner.
 *
 * Where it is not plain from what is asked for and from the scene, pilots tell (plan_pilot.c). Maps
 * smooth, and paths do not: so maps are taken only where they are sooner by more than pilots err.
 */
#include "sim/plan_parts.h"

#include <stdio.h>

static const double sooner = 1.2; /* times, at least */

/* Why paths are taken without a trial; NULL: there is no reason. */
static const char *plain_reason(const plan_facts *f, const plan *p)
{
    if (!p->effects[EFFECT_INTERREFLECTION].on)
        return "no light comes back from surfaces";
    if (f->o->series)
        return "all moments of a series are weighed from the same paths";
    if (!f->o->views && grid_needs_paths(f->s))
        return "daylight is told apart from light that needs maintenance";
    if (f->s->exteriors && f->s->portal_count == 0)
        return "most particles of daylight would stay outside";
    return NULL;
}

static void tell(const plan_pilot *t, double accuracy, plan *out)
{
    char *why          = out->transport_why;
    const size_t size  = sizeof out->transport_why;
    const double asked = 100.0 * accuracy;
    if (t->at_once)
        snprintf(why, size, "paths reach %.3g %% after about %.1g rays", asked, t->paths);
    else if (t->too_coarse)
        snprintf(why, size, "paths reach %.3g %% after about %.1e rays, maps would be too coarse",
                 asked, t->paths);
    else if (out->transport == TRANSPORT_MAPS)
        snprintf(why, size, "maps reach %.3g %% after about %.1e rays, paths after %.1e", asked,
                 t->maps, t->paths);
    else
        snprintf(why, size, "paths reach %.3g %% after about %.1e rays, maps after %.1e", asked,
                 t->paths, t->maps);
}

bool plan_transport(const plan_facts *f, plan *out, lux_error *err)
{
    const char *plain = f->o->transport == TRANSPORT_AUTO ? plain_reason(f, out) : "asked for";
    plan_pilot t      = { 0 };
    out->transport    = f->o->transport == TRANSPORT_MAPS ? TRANSPORT_MAPS : TRANSPORT_PATH;
    if (plain) {
        snprintf(out->transport_why, sizeof out->transport_why, "%s", plain);
        return true;
    }
    if (!plan_pilot_run(f, f->accuracy - out->bound, &t, err))
        return false;
    if (!t.at_once && !t.too_coarse && sooner * t.maps < t.paths)
        out->transport = TRANSPORT_MAPS;
    tell(&t, f->accuracy, out);
    return true;
}
