/* sim/plan_why.c -- why an effect is on or off, with the scene's own numbers. */
#include "sim/plan_parts.h"
#include "sim/render.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void say(plan_effect *to, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(plan_effect *to, const char *format, ...)
{
    va_list more;
    va_start(more, format);
    vsnprintf(to->why, sizeof to->why, format, more);
    va_end(more);
}

static const char *plural(int count) { return count == 1 ? "" : "s"; }

/* After how many reflections of that share less than a fifth of the accuracy is left. */
static int depth_of(const plan_facts *f, double share)
{
    double least = f->accuracy / 5.0;
    if (!(share > 0.0))
        return 0;
    return share <= least ? 1 : (int)fmin(ceil(log(least) / log(fmin(share, 0.999))), 9999.0);
}

/* ---- lamps ----------------------------------------------------------------------------------- */

/* What comes from far away, and from all surfaces that glow. */
static const char *wide_sources(const plan_facts *f)
{
    const scene *s = f->s;
    bool suns = !f->sealed && s->sun_count > 0, skies = !f->sealed && s->dome;
    if (suns || skies)
        return suns && skies ? "sun and sky" : suns ? "the sun" : "the sky";
    return s->glows ? "glowing surfaces" : "";
}

static void tell_shadows(const plan_facts *f, bool called, plan_effect *to)
{
    const scene *s = f->s;
    int lamps = scene_lamp_count(s), hidden = 0;
    const char *wide = wide_sources(f);
    for (int l = 0; l < lamps; l++)
        hidden += !s->light_info[l].clear;
    if (called && f->outside)
        say(to, "some sensor is outside of the room: its walls shade it");
    else if (called && hidden > 0)
        say(to, "something may stand before %d of %d lamp%s%s%s", hidden, lamps, plural(lamps),
            wide[0] ? ", and before " : "", wide);
    else if (called)
        say(to, "something may stand before %s", wide);
    else if (s->light_count == 0)
        say(to, "there is nothing that could be shaded");
    else
        say(to, "nothing stands between any lamp and any %s: %s",
            f->o->views ? "surface" : "sensor",
            s->study->room.given ? "the room is empty" : "there are no surfaces");
}

static int lamps_of_extent(const scene *s, bool of_file)
{
    int count = 0;
    for (int l = 0; l < scene_lamp_count(s); l++)
        count += light_has_extent(s->lights[l]) && (s->light_info[l].web || !of_file);
    return count;
}

static int lamps_of(const scene *s, bool of_file)
{
    int count = 0;
    for (int l = 0; l < scene_lamp_count(s); l++)
        count += s->light_info[l].web || !of_file;
    return count;
}

static void tell_extent(const plan_facts *f, bool called, plan_effect *to, bool of_file)
{
    const scene *s   = f->s;
    const char *what = of_file ? "luminaire" : "lamp";
    int count = lamps_of_extent(s, of_file), all = lamps_of(s, of_file);
    bool openings = !of_file && count > 0 && count == lamps_of_extent(s, true);
    if (called && !to->on && !to->forced && openings)
        say(to, "no lamp is more than a point, but for openings of luminaires");
    else if (called && !to->on && !to->forced)
        say(to, "%d %s%s of extent: point%s within %.2g %% at every sensor", count, what,
            plural(count), plural(count), 100.0 * to->bound);
    else if (called && count > 0)
        say(to, "%d of %d %s%s %s more than a point%s", count, all, what, plural(all),
            count == 1 ? "is" : "are", of_file ? ": light comes from an opening" : "");
    else if (called)
        say(to, "surfaces glow: %d triangles", s->emitter_count);
    else if (all == 0)
        say(to, "there is no %s", what);
    else
        say(to, "%s",
            of_file    ? "no luminaire's file has an opening"
            : all == 1 ? "the lamp is a point"
                       : "all lamps are points");
}

static void tell_area(const plan_facts *f, bool called, plan_effect *to)
{
    tell_extent(f, called, to, false);
}

static void tell_near_field(const plan_facts *f, bool called, plan_effect *to)
{
    int count = lamps_of_extent(f->s, true);
    if (!called && count > 0)
        say(to, "the %d luminaire%s with an opening give%s no light", count, plural(count),
            count == 1 ? "s" : "");
    else
        tell_extent(f, called, to, true);
}

static void tell_many(const plan_facts *f, bool called, plan_effect *to)
{
    int lamps = scene_lamp_count(f->s), glowing = f->s->emitter_count;
    if (called && glowing > 0 && lamps > 0)
        say(to, "some of %d lamp%s and %d glowing triangle%s are asked, by what they may give",
            lamps, plural(lamps), glowing, plural(glowing));
    else if (called)
        say(to, "some of %d %s are asked, by what they may give", glowing ? glowing : lamps,
            glowing ? "glowing triangles" : "lamps");
    else if (lamps == 0)
        say(to, "there is no lamp");
    else
        say(to, "%d lamp%s: %s asked", lamps, plural(lamps), lamps == 1 ? "it is" : "all are");
}

/* ---- daylight -------------------------------------------------------------------------------- */

/* Of what a closed room keeps out. */
static bool tell_sealed(const plan_facts *f, bool called, plan_effect *to)
{
    if (called && f->sealed)
        say(to, "the room has no opening, and all %s are within", f->o->views ? "eyes" : "sensors");
    return called && f->sealed;
}

static void tell_sun(const plan_facts *f, bool called, plan_effect *to)
{
    const scene *s = f->s;
    int nights     = 0;
    for (int h = 0; h < s->moment_count; h++)
        nights += s->moments[h].sun_known && !(s->moments[h].to_sun.z > 0.0f);
    double below = s->moment_count ? -asin((double)s->moments[0].to_sun.z) * (180.0 / M_PI) : 0.0;
    if (tell_sealed(f, called, to))
        return;
    if (called && s->by_moment)
        say(to, "it shines at %d of %d moments", s->sun_count, s->moment_count);
    else if (called)
        say(to, "it is %.1f degrees above the horizon", -below);
    else if (nights > 0 && s->by_moment)
        say(to, "it is below the horizon at all %d moments", nights);
    else if (nights > 0)
        say(to, "it is %.1f degrees below the horizon", below);
    else
        say(to, "the study has none");
}

static void tell_sky(const plan_facts *f, bool called, plan_effect *to)
{
    if (tell_sealed(f, called, to))
        return;
    int skies = 0;
    for (int i = 0; i < f->s->sky_count; i++)
        skies += !f->s->skies[i].ground;
    const char *ground = skies < f->s->sky_count ? ", and the ground below" : "";
    if (called && f->s->by_moment)
        say(to, "it gives light at %d of %d moments%s", skies, f->s->moment_count, ground);
    else if (called)
        say(to, "it gives light%s", ground);
    else
        say(to, f->s->moment_count ? "the sky is dark" : "the study has none");
}

static void tell_portals(const plan_facts *f, bool called, plan_effect *to)
{
    if (tell_sealed(f, called, to))
        return;
    if (called)
        say(to, "daylight is looked for through openings (%s)", f->s->portals_from);
    else if (f->s->sky_count == 0)
        say(to, "there is no sky to look for");
    else
        say(to, "no opening is known: the sky is looked for all around");
}

static void tell_panorama(const plan_facts *f, bool called, plan_effect *to)
{
    if (!tell_sealed(f, called, to))
        say(to, called ? "the sky is a picture" : "no sky is a picture");
}

/* ---- surfaces -------------------------------------------------------------------------------- */

static void tell_interreflection(const plan_facts *f, bool called, plan_effect *to)
{
    const plan_materials *m = &f->materials;
    if (f->o->direct_only)
        say(to, "left out as asked: --direct-only");
    else if (called && !to->on && to->bound > 0.0)
        say(to, "no surface reflects more than %.2g %%", 100.0 * m->most);
    else if (called)
        say(to,
            "%.0f %% of the surface area reflects more than %.0f %%, in the mean %.0f %%: about "
            "%d reflections",
            100.0 * m->bright_share, 100.0 * BRIGHT, 100.0 * m->mean, depth_of(f, m->mean));
    else if (!scene_is_lit(f->s))
        say(to, "nothing gives light");
    else
        say(to, "no surface gives light on");
}

/* What is said of materials that are not looked at: light is not followed to them, or there are
 * none. */
static void say_unused(const plan_facts *f, plan_effect *to, int count, const char *none)
{
    if (!scene_is_lit(f->s))
        say(to, "nothing gives light");
    else if (count == 0)
        say(to, "%s", none);
    else
        say(to, "%d material%s call%s for it, but no light comes back from surfaces", count,
            plural(count), count == 1 ? "s" : "");
}

static void tell_mirrors(const plan_facts *f, bool called, plan_effect *to)
{
    const plan_materials *m = &f->materials;
    if (called)
        say(to, "%d material%s reflect%s up to %.0f %% as a mirror: about %d reflections",
            m->mirrors, plural(m->mirrors), m->mirrors == 1 ? "s" : "", 100.0 * m->sharpest,
            depth_of(f, m->sharpest));
    else
        say_unused(f, to, m->mirrors, "no mirror in use");
}

static void tell_refraction(const plan_facts *f, bool called, plan_effect *to)
{
    int count = f->materials.solids;
    if (called)
        say(to, "%d solid%s of glass bend%s light, in and out: 2 faces each at least", count,
            plural(count), count == 1 ? "s" : "");
    else
        say_unused(f, to, count, "no solid in use bends light");
}

static void tell_textures(const plan_facts *f, bool called, plan_effect *to)
{
    const plan_materials *m = &f->materials;
    if (called && !to->on && !to->forced)
        say(to, "%d textured material%s of nearly one colour each", m->textured,
            plural(m->textured));
    else if (called)
        say(to, "%d textured material%s, first `%.60s`", m->textured, plural(m->textured),
            m->first_textured);
    else
        say_unused(f, to, m->textured, "no texture in use");
}

static void tell_normal_maps(const plan_facts *f, bool called, plan_effect *to)
{
    int count = f->materials.bumpy;
    if (called && !to->on && !to->forced)
        say(to, "%d normal map%s, flat", count, plural(count));
    else if (called)
        say(to, "%d normal map%s in use", count, plural(count));
    else
        say_unused(f, to, count, "no normal map in use");
}

static void tell_measured(const plan_facts *f, bool called, plan_effect *to)
{
    const plan_materials *m = &f->materials;
    const char *file        = m->first_measured ? strrchr(m->first_measured, '/') : NULL;
    if (called)
        say(to, "%d measured table%s in use, first %.80s", m->measured, plural(m->measured),
            file ? file + 1 : m->first_measured);
    else
        say_unused(f, to, m->measured, "no measured table in use");
}

static void tell_tints(const plan_facts *f, bool called, plan_effect *to)
{
    int count = f->materials.hollow;
    if (called)
        say(to, "light goes straight through %d material%s", count, plural(count));
    else
        say_unused(f, to, count, "light goes straight through no surface");
}

static void tell_color(const plan_facts *f, bool called, plan_effect *to)
{
    if (called)
        say(to, "%s", scene_colored_by(f->s));
    else
        say(to, "all surfaces and all light are grey");
}

/* ---- the rest -------------------------------------------------------------------------------- */

static void tell_motion(const plan_facts *f, bool called, plan_effect *to)
{
    (void)called;
    say(to, f->o->series ? "nothing moves from moment to moment" : "there is but one moment");
}

static void tell_antialiasing(const plan_facts *f, bool called, plan_effect *to)
{
    const int first = SCRAMBLES * VIEW_FIRST_SAMPLES << (LEAST_ROUNDS - 1);
    if (!f->o->views)
        say(to, "no view is drawn");
    else if (!called)
        say(to, "nothing gives light: all is black");
    else
        say(to,
            "%d rays all over each pixel, then %d, %d and so on, until %d %% of the pixels are "
            "within %g %%; %d rays at most",
            first, 2 * first, 4 * first, VIEW_NEEDED_PERCENT, 100.0 * f->accuracy,
            SCRAMBLES * MOST_SAMPLES);
}

void plan_tell(const plan_facts *f, effect e, bool called, plan_effect *to)
{
    static void (*const all[EFFECTS])(const plan_facts *, bool, plan_effect *) = {
        [EFFECT_SHADOWS]         = tell_shadows,
        [EFFECT_AREA_LIGHTS]     = tell_area,
        [EFFECT_NEAR_FIELD]      = tell_near_field,
        [EFFECT_MANY_LIGHTS]     = tell_many,
        [EFFECT_SUN]             = tell_sun,
        [EFFECT_SKY]             = tell_sky,
        [EFFECT_PORTALS]         = tell_portals,
        [EFFECT_PANORAMA]        = tell_panorama,
        [EFFECT_INTERREFLECTION] = tell_interreflection,
        [EFFECT_MIRRORS]         = tell_mirrors,
        [EFFECT_REFRACTION]      = tell_refraction,
        [EFFECT_TEXTURES]        = tell_textures,
        [EFFECT_NORMAL_MAPS]     = tell_normal_maps,
        [EFFECT_MEASURED_BRDF]   = tell_measured,
        [EFFECT_TINTED_SHADOWS]  = tell_tints,
        [EFFECT_COLOR]           = tell_color,
        [EFFECT_MOTION]          = tell_motion,
        [EFFECT_ANTIALIASING]    = tell_antialiasing,
    };
    all[e](f, called, to);
    char why[sizeof to->why];
    memcpy(why, to->why, sizeof why);
    if (to->forced && (to->on || called) && !(e == EFFECT_INTERREFLECTION && f->o->direct_only))
        say(to, "%s%.140s",
            !to->on  ? "left out as asked: "
            : called ? "asked for: "
                     : "asked for, though ",
            why);
}
