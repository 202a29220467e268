/* sim/moment_sky.h -- how bright sun and sky are at a moment, and the sky itself.
 *
 * What the study gives in lux counts; the rest follows from the sun's elevation by the formulae of
 * sky.h, or from the irradiances of a Perez sky.
 */
#ifndef SIM_MOMENT_SKY_H
#define SIM_MOMENT_SKY_H

#include "sim/moments.h"
#include "sky/sky.h"

typedef struct moment_light {
    const sky *sky;      /* without the ground; NULL: dark, or the study has none, or a panorama */
    double sky_lx;       /* on level ground that sees all of the sky, >= 0 */
    double sun_lx;       /* square to the beam, >= 0; 0: no sun */
    double diameter_deg; /* of the sun, > 0 */
    bool night;          /* the sun is known to be below the horizon, and something depends on it */
    const char *sky_by, *sun_by; /* the formula; "as given" */
    perez_figures perez;         /* of a Perez sky that is not dark */
} moment_light;

/* Of a study whose sky is given, no panorama; the sky lives as long as a does. False, with *err. */
bool moment_light_of(arena *a, const study *s, const moment *m, moment_light *out, lux_error *err);

/* Whether the study has daylight; whether the sun shines in it as a lamp of its own (of panoramas:
 * whether one in the picture is made such a lamp). */
bool study_has_daylight(const study *s);
bool study_has_sun(const study *s);

/* Whether the light depends on where the sun stands. */
bool study_needs_sun(const study *s);

#endif
