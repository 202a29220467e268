/* sim/scene_sky.c -- the light of day: moments, suns as lamps, skies, the ground below them.
 *
 * The ground reflects what falls on it as a level plane does that nothing shadows:
 *
 *     L = rho (E_sky + E_sun sin h) / pi        [W/(sr m^2)]
 *
 * in two parts, so that each can be of the group of what lights it.
 */
#include "core/color.h"
#include "lights/light.h"
#include "sim/moment_sky.h"
#include "sim/planck.h"
#include "sim/scene_build.h"
#include "sky/panorama.h"
#include "sky/sun_light.h"

static const double suns_own_diameter_deg = 0.53;

/* The groups of what one moment's sun and sky give. */
typedef struct day_groups {
    const char *sun, *sky;
} day_groups;

/* ---- parts ----------------------------------------------------------------------------------- */

/* Makers of skies know no file. */
static bool pass_on(const scene_build *b, const lux_error *why)
{
    return study_failed(b->study, b->study->sky.where, b->err, why->code, "%s", why->text);
}

static bool add_sky(scene_build *b, const sky *from, const char *group, bool ground)
{
    if (is_left_out(b, EFFECT_SKY))
        return true;
    scene_sky *to = list_new(&b->skies, b->a, scene_sky, b->err);
    int number    = to ? scene_group(b, group) : -1;
    if (number < 0)
        return false;
    *to = (scene_sky){ .sky = from, .group = number, .ground = ground };
    return true;
}

/* horizontal: W/m^2. */
static bool add_ground(scene_build *b, vec3 horizontal, const char *group)
{
    vec3 radiance =
        v3_scale(v3_mul(scene_color(b, b->study->sky.ground), horizontal), (float)(1.0 / M_PI));
    if (!(v3_dot(radiance, radiance) > 0.0f))
        return true;
    lux_error why = { 0 };
    const sky *of = sky_ground(b->a, radiance, &why);
    return of ? add_sky(b, of, group, true) : pass_on(b, &why);
}

/* A sun is a lamp; its light: W/m^2 square to it. */
static bool add_sun(scene_build *b, const sun_light_desc *d, const char *group)
{
    const study_sky *k = &b->study->sky;
    lux_error why      = { 0 };
    parallel_desc p    = { .aim = v3_scale(d->to_sun, -1.0f), .irradiance = d->irradiance };
    bool point         = k->sun == STUDY_SUN_POINT || b->options->measures.point_sun;
    const light *made  = point ? light_parallel(b->a, &p, &why) : light_sun(b->a, d, &why);
    if (!made)
        return pass_on(b, &why);
    study_emission is = { .color = { 1, 1, 1 }, .dimming = 1.0, .group = group };
    rgb_scale_to_luminance_1(
        (double[]){ (double)d->irradiance.x, (double)d->irradiance.y, (double)d->irradiance.z },
        &is.color);
    lamp_entry e = { .where    = k->where,
                     .name     = "sun",
                     .at       = d3_from(p.aim),
                     .emission = &is,
                     .lumens   = HUGE_VAL,
                     .watts    = (double)NAN,
                     .far      = true };
    if (!lamp_add(b, made, &e))
        return false;
    scene_light *info = (scene_light *)b->light_info.items + b->light_info.count - 1;
    info->sun         = true;
    info->group       = scene_group(b, group); /* lamps of a series are of one group */
    b->sun_count++;
    return info->group >= 0;
}

/* ---- moments --------------------------------------------------------------------------------- */

static bool add_moment(scene_build *b, const moment *m, day_groups in, int *nights)
{
    moment_light now;
    lux_error why = { 0 };
    if (!moment_light_of(b->a, b->study, m, &now, &why))
        return pass_on(b, &why);
    *nights += now.night;
    if (now.sky &&
        (!add_sky(b, now.sky, in.sky, false) || !add_ground(b, now.sky->horizontal, in.sky)))
        return false;
    if (!(now.sun_lx > 0.0) || is_left_out(b, EFFECT_SUN))
        return true;
    vec3 square      = lamp_watts(b, (vec3){ 1, 1, 1 }, now.sun_lx);
    sun_light_desc d = { .to_sun       = m->to_sun,
                         .irradiance   = square,
                         .diameter_deg = now.diameter_deg };
    return add_sun(b, &d, in.sun) && add_ground(b, v3_scale(square, m->to_sun.z), in.sun);
}

/* lx: a panorama that gives less was likely not meant to be W/(sr m^2). */
static const double least_day = 1000.0;

/* The picture shows what is below the horizon, too. */
static const sky *read_panorama(scene_build *b, panorama_sun *sun)
{
    const study_sky *k = &b->study->sky;
    panorama_desc d    = { .path       = k->file,
                           .rotate_deg = k->rotate_deg,
                           .scale      = k->scale,
                           .horizontal = k->horizontal / LUMENS_PER_WATT,
                           .keep_sun   = !study_has_sun(b->study) };
    lux_error why      = { 0 };
    const sky *read    = sky_panorama(b->a, &d, sun, b->notices, &why);
    if (!read) {
        pass_on(b, &why);
        return NULL;
    }
    double lux = LUMENS_PER_WATT * (double)rgb_luminance(read->horizontal);
    if (isnan(k->scale) && isnan(k->horizontal) && lux < least_day)
        notice_add(b->notices,
                   "%s: its pixels, taken as W/(sr m2), give %.3g lx on level ground besides any "
                   "sun: `scale` or `horizontal` makes daylight of it",
                   k->file, lux);
    return read;
}

static bool add_panorama(scene_build *b, const sky *picture, const panorama_sun *sun, day_groups in)
{
    sun_light_desc d = { .to_sun       = sun->to_sun,
                         .irradiance   = sun->irradiance,
                         .diameter_deg = fmax(sun->diameter_deg, suns_own_diameter_deg) };
    bool shines      = sun->found && !is_left_out(b, EFFECT_SUN);
    return is_left_out(b, EFFECT_PANORAMA) ||
           (add_sky(b, picture, in.sky, false) && (!shines || add_sun(b, &d, in.sun)));
}

static bool add_moments(scene_build *b)
{
    bool pictured      = b->study->sky.model == STUDY_SKY_PANORAMA;
    panorama_sun sun   = { 0 };
    const sky *picture = pictured ? read_panorama(b, &sun) : NULL;
    int nights         = 0;
    for (int h = 0; h < b->moment_count; h++) {
        const moment *m = &b->moments[h];
        day_groups in   = { "sun", "sky" };
        if (b->options->moments)
            in = (day_groups){ m->text, m->text };
        int group = b->options->moments ? scene_group(b, m->text) : 1 + h;
        if (group < 0)
            return false;
        if (group != 1 + h)
            return failed(b->err, ERR_ARGUMENT, "%s: the moment %s stands twice in one series",
                          b->study->path, m->text);
        if (pictured ? !picture || !add_panorama(b, picture, &sun, in)
                     : !add_moment(b, m, in, &nights))
            return false;
    }
    if (nights > 0 && !b->options->moments) /* of a series, its command tells of all batches */
        notice_add(b->notices, "%s:%d:%d: the sun is below the horizon: the sky is dark",
                   b->study->path, b->study->sky.where.line, b->study->sky.where.column);
    return true;
}

/* Clocks keep within 3 h of the sun everywhere (China, Argentina): else east and west, or latitude
 * and longitude, may have been exchanged. */
static void check_zone(const scene_build *b)
{
    const double most_h  = 3.5;
    const study_site *in = &b->study->site;
    const moment *m      = &b->moments[0];
    if (!in->given || !in->zone || isnan(m->at))
        return;
    double clocks = clock_offset(in->zone, m->at) / 3600.0;
    double sun    = in->at.longitude_deg / 15.0;
    if (fabs(remainder(clocks - sun, 24.0)) > most_h)
        notice_add(b->notices,
                   "%s:%d:%d: clocks of the zone (UTC%+g h) are far from the sun's time at "
                   "longitude %.4g (UTC%+.1f h): is the place right?",
                   b->study->path, in->where.line, in->where.column, clocks, in->at.longitude_deg,
                   sun);
}

bool build_daylight(scene_build *b)
{
    const scene_options *o = b->options;
    if (!study_has_daylight(b->study))
        return true;
    int count       = o->moments ? o->moment_count : 1;
    moment *moments = arena_array(b->a, moment, (size_t)count, b->err);
    if (!moments)
        return false;
    if (o->moments)
        memcpy(moments, o->moments, (size_t)count * sizeof *moments);
    else if (!moment_of(b->study, moments, b->err))
        return false;
    b->moments      = moments;
    b->moment_count = count;
    check_zone(b);
    return add_moments(b);
}
