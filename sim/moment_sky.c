/* sim/moment_sky.c -- see moment_sky.h. */
#include "sim/moment_sky.h"

#include "core/color.h"

/* Twice the semidiameter of the sun at 1 au, 959.63" (Auwers 1891). */
static const double mean_diameter_deg = 2.0 * 959.63 / 3600.0;
static const char *const as_given     = "as given";
static const vec3 white               = { 1, 1, 1 };

/* ---- what a study asks for ------------------------------------------------------------------- */

bool study_has_daylight(const study *s) { return s->sky.given && s->sky.model != STUDY_SKY_NONE; }

static bool has_cie_sun(int type) { return type >= 7 && type <= 15; }

bool study_has_sun(const study *s)
{
    if (!study_has_daylight(s))
        return false;
    if (s->sky.sun != STUDY_SUN_MODEL)
        return s->sky.sun != STUDY_SUN_OFF;
    return s->sky.model != STUDY_SKY_CIE || has_cie_sun(s->sky.type);
}

/* Types whose luminance does not depend on the angle to the sun (ISO 15469, table 1: c = 0). */
static bool is_round(int type)
{
    return type == SKY_UNIFORM || type == SKY_TRADITIONAL || type == 1 || type == 3 || type == 5;
}

bool study_needs_sun(const study *s)
{
    if (!study_has_daylight(s) || s->sky.model == STUDY_SKY_PANORAMA)
        return false;
    return study_has_sun(s) || s->sky.model == STUDY_SKY_PEREZ || !is_round(s->sky.type) ||
           isnan(s->sky.horizontal);
}

/* ---- one moment ------------------------------------------------------------------------------ */

/* Of `sun_at` nothing is known but where it stands. */
static double distance_of(const moment *m)
{
    return m->sun.distance_au > 0.0 ? m->sun.distance_au : 1.0;
}

static bool make_cie(arena *a, const study *s, const moment *m, moment_light *out, lux_error *err)
{
    const study_sky *k = &s->sky;
    double elevation   = m->sun.apparent_elevation_deg;
    bool by_formula    = isnan(k->horizontal);
    bool dark          = out->night && (by_formula || !is_round(k->type));
    out->sky_by        = by_formula ? sky_diffuse_formula(k->type) : as_given;
    out->sky_lx        = k->horizontal;
    if (by_formula)
        out->sky_lx =
            dark ? 0.0 : sky_diffuse_lx(k->type, elevation, s->site.at.altitude_m, k->turbidity);
    if (dark || !(out->sky_lx > 0.0)) {
        out->sky_lx = 0.0;
        return true;
    }
    cie_desc d = { .type       = k->type,
                   .to_sun     = out->night || !m->sun_known ? (vec3){ 0, 0, 1 } : m->to_sun,
                   .horizontal = out->sky_lx / LUMENS_PER_WATT,
                   .color      = white };
    out->sky   = sky_cie(a, &d, err);
    return out->sky != NULL;
}

static bool make_perez(arena *a, const study *s, const moment *m, moment_light *out, lux_error *err)
{
    out->sky_by = "Perez et al. 1993, efficacy of Perez et al. 1990";
    if (out->night)
        return true;
    perez_desc d = { .to_sun             = m->to_sun,
                     .direct_normal      = s->sky.direct_normal,
                     .diffuse_horizontal = s->sky.diffuse_horizontal,
                     .dew_point_c        = s->sky.dew_point_c,
                     .distance_au        = distance_of(m),
                     .altitude_m         = s->site.at.altitude_m,
                     .color              = white };
    out->sky     = sky_perez(a, &d, &out->perez, err);
    out->sky_lx  = out->perez.diffuse_lx;
    return out->sky != NULL;
}

/* Square to the beam. */
static void light_of_sun(const study *s, const moment *m, moment_light *out)
{
    double elevation = m->sun.apparent_elevation_deg;
    bool is_perez    = s->sky.model == STUDY_SKY_PEREZ;
    bool given       = !isnan(s->sky.sun_illuminance);
    out->sun_by      = given ? as_given : is_perez ? out->sky_by : sky_sun_formula();
    if (out->night || !study_has_sun(s))
        return;
    out->sun_lx =
        given      ? s->sky.sun_illuminance
        : is_perez ? out->perez.direct_normal_lx
                   : sky_sun_lx(elevation, s->site.at.altitude_m, s->sky.turbidity, distance_of(m));
}

bool moment_light_of(arena *a, const study *s, const moment *m, moment_light *out, lux_error *err)
{
    double own = m->sun.diameter_deg;
    *out       = (moment_light){ .diameter_deg = own > 0.0 ? own : mean_diameter_deg };
    out->night = study_needs_sun(s) && !(m->sun_known && m->to_sun.z > 0.0f);
    bool made  = s->sky.model == STUDY_SKY_PEREZ ? make_perez(a, s, m, out, err)
                                                 : make_cie(a, s, m, out, err);
    light_of_sun(s, m, out);
    return made;
}
