/* sim/plan_transport.c -- paths or maps: which reaches the accuracy asked for sooner.
 *
 * Maps cost particles once, however much is then read from them; a path costs its reflections at
 * each sensor and pixel anew. So maps pay where many places ask for light that has been reflected
 * many times, and lies on matt surfaces; a map has no moments, so that series go by paths. What is
 * outside gives light on into rooms by particles that are aimed at portals, where these are known.
 */
#include "sim/plan_parts.h"

#include <stdio.h>

static const double many_sensors = 5000.0; /* of all grids */
static const double many_pixels  = 1e5;    /* of all views */
static const double mostly       = 0.5;    /* of the surface area is matt */
static const double bright       = 0.4;    /* mean reflectance: three reflections to a tenth */

transport plan_transport(const plan_facts *f, bool interreflection, char *why, size_t size)
{
    const plan_materials *m = &f->materials;
    double places           = f->o->views ? f->pixels : f->sensors;
    const char *what        = f->o->views ? "pixels" : "sensors";
    double least            = f->o->views ? many_pixels : many_sensors;
    if (!interreflection)
        snprintf(why, size, "no light comes back from surfaces");
    else if (f->o->series)
        snprintf(why, size, "all moments of a series are weighed from the same paths");
    else if (places < least)
        snprintf(why, size, "%.0f %s: maps pay from %.0f on", places, what, least);
    else if (f->s->exteriors && f->s->portal_count == 0)
        snprintf(why, size, "most particles of daylight would stay outside");
    else if (m->matt_share < mostly)
        snprintf(why, size, "%.0f %% of the surface area is not matt",
                 100.0 * (1.0 - m->matt_share));
    else if (m->mean < bright)
        snprintf(why, size, "surfaces reflect %.0f %% in the mean: paths end soon",
                 100.0 * m->mean);
    else {
        snprintf(why, size, "%.0f %s, surfaces reflect %.0f %% in the mean, %.0f %% of them matt",
                 places, what, 100.0 * m->mean, 100.0 * m->matt_share);
        return TRANSPORT_MAPS;
    }
    return TRANSPORT_PATH;
}
