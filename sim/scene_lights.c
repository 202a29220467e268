/* sim/scene_lights.c -- the lamps of study and glTF files as lights of the scene.
 *
 * Lumens and candelas end here: inside, light is radiometric (core/color.h).
 */
#include "core/color.h"
#include "sim/scene_build.h"

#include <stdio.h>
#include <string.h>

/* Adds a light that a maker gave, or passes on that it failed. */
static bool add(scene_build *b, const light *l, const char *name, dvec3 at, double lumens,
                vec3 color)
{
    const light **to  = l ? list_new(&b->lights, b->a, const light *, b->err) : NULL;
    scene_light *info = to ? list_new(&b->light_info, b->a, scene_light, b->err) : NULL;
    if (!info)
        return false;
    vec3 first = ((const scene_light *)b->light_info.items)->color;
    *to        = l;
    *info      = (scene_light){ name, at, lumens, color };
    b->lights_differ |=
        b->lights.count > 1 && (color.x != first.x || color.y != first.y || color.z != first.z);
    return true;
}

static vec3 watts(vec3 color, double per_lumen_unit)
{
    return v3_scale(color, (float)(per_lumen_unit / LUMENS_PER_WATT));
}

/* A lamp beyond the walls of the room, or far from all surfaces, lights nothing that was meant. (A
 * street lamp stands above all surfaces, and is right.) */
static void warn_if_outside(const scene_build *b, study_where where, const char *what, dvec3 at)
{
    bool room  = b->study->room.given;
    dvec3 low  = room ? (dvec3){ 0, 0, 0 } : b->low;
    dvec3 high = room ? b->study->room.size : b->high;
    bool empty = !(low.x <= high.x);
    if (!room && !empty) {
        dvec3 more = d3_sub(high, low);
        double far = d3_length(more);
        low        = d3_sub(low, (dvec3){ far, far, far });
        high       = d3_add(high, (dvec3){ far, far, far });
    }
    if (empty || (at.x >= low.x && at.x <= high.x && at.y >= low.y && at.y <= high.y &&
                  at.z >= low.z && at.z <= high.z))
        return;
    notice_add(b->notices,
               "%s:%d:%d: a %s at (%g, %g, %g) m lies outside the %s, (%g, %g, %g) to "
               "(%g, %g, %g) m",
               b->study->path, where.line, where.column, what, at.x, at.y, at.z,
               room ? "room" : "scene", low.x, low.y, low.z, high.x, high.y, high.z);
}

/* 50 for half is a likely slip. */
static void warn_if_brightened(const scene_build *b, study_where where, double dimming)
{
    if (dimming > 1.0)
        notice_add(b->notices,
                   "%s:%d:%d: `dimming: %g` is more than the full light (0.5 is half of it)",
                   b->study->path, where.line, where.column, dimming);
}

/* ---- the study's own ------------------------------------------------------------------------- */

static bool luminaire_factor(scene_build *b, const study_luminaire *l, const photometry *web,
                             double *factor)
{
    *factor = l->emission.dimming * study_group_factor(b->study, l->emission.group);
    if (!isnan(l->lumens)) {
        if (!(web->luminaire_lumens > 0.0))
            return study_failed(b->study, l->where, b->err, ERR_ARGUMENT,
                                "`lumens` cannot scale %s: it gives no light", l->photometry);
        *factor *= l->lumens / web->luminaire_lumens;
    } else if (!isnan(l->lamp_lumens)) {
        if (!(web->lamp_lumens > 0.0))
            return study_failed(b->study, l->where, b->err, ERR_ARGUMENT,
                                "`lamp_lumens` cannot scale %s: its photometry is absolute (say "
                                "`lumens`)",
                                l->photometry);
        *factor *= l->lamp_lumens / web->lamp_lumens;
    }
    return true;
}

static const photometry *web_of(scene_build *b, int i, const photometry **webs)
{
    const study_luminaire *all = b->study->luminaires;
    for (int j = 0; j < i; j++)
        if (!strcmp(all[j].photometry, all[i].photometry))
            return webs[j];
    lux_error why         = { 0 };
    const photometry *web = photometry_read(b->a, all[i].photometry, b->notices, &why);
    if (!web && why.code == ERR_IO) /* the study names what is not there */
        return study_failed(b->study, all[i].where, b->err, ERR_IO, "%s", why.text);
    return web ? web : failed(b->err, why.code, "%s", why.text);
}

static bool add_luminaires(scene_build *b)
{
    const study *s = b->study;
    const photometry **webs =
        arena_array(b->a, const photometry *, (size_t)s->luminaire_count + 1, b->err);
    if (!webs)
        return false;
    for (int i = 0; i < s->luminaire_count; i++) {
        const study_luminaire *l = &s->luminaires[i];
        double factor;
        if (l->nodes || l->aim_at_given)
            return study_failed(s, l->where, b->err, ERR_UNSUPPORTED,
                                "luminaires with `nodes` or `aim_at` are not simulated yet");
        webs[i] = web_of(b, i, webs);
        if (!webs[i] || !luminaire_factor(b, l, webs[i], &factor))
            return false;
        warn_if_brightened(b, l->where, l->emission.dimming);
        const char *file =
            strrchr(l->photometry, '/') ? strrchr(l->photometry, '/') + 1 : l->photometry;
        const char *name = l->name ? l->name : file;
        for (int k = 0; k < l->at_count; k++) {
            luminaire_desc d = { .position = d3_to_float(d3_sub(l->at[k], b->centre)),
                                 .aim      = d3_to_float(l->aim),
                                 .rotate   = (float)(l->rotate_deg * (M_PI / 180.0)),
                                 .scale    = watts(l->emission.color, factor),
                                 .web      = webs[i] };
            warn_if_outside(b, l->where, "luminaire", l->at[k]);
            if (!add(b, light_luminaire(b->a, &d, b->err), name, l->at[k],
                     factor * webs[i]->luminaire_lumens, l->emission.color))
                return false;
        }
    }
    return true;
}

static bool add_points(scene_build *b)
{
    for (int i = 0; i < b->study->light_count; i++) {
        const study_light *l = &b->study->lights[i];
        if (l->kind != STUDY_POINT)
            return study_failed(b->study, l->where, b->err, ERR_UNSUPPORTED,
                                "of `lights`, only points are simulated yet");
        double candelas = isnan(l->lumens) ? l->intensity : l->lumens / (4.0 * M_PI);
        double intensity =
            candelas * l->emission.dimming * study_group_factor(b->study, l->emission.group);
        warn_if_brightened(b, l->where, l->emission.dimming);
        for (int k = 0; k < l->at_count; k++) {
            point_desc d = { .position  = d3_to_float(d3_sub(l->at[k], b->centre)),
                             .intensity = watts(l->emission.color, intensity) };
            warn_if_outside(b, l->where, "light", l->at[k]);
            if (!add(b, light_point(b->a, &d, b->err), l->name ? l->name : "point", l->at[k],
                     4.0 * M_PI * intensity, l->emission.color))
                return false;
        }
    }
    return true;
}

/* ---- those of glTF files (KHR_lights_punctual) ----------------------------------------------- */

static vec3 luminance_one(vec3 color)
{
    float y = rgb_luminance(color);
    return y > 0.0f ? v3_scale(color, 1.0f / y) : (vec3){ 0, 0, 0 };
}

static bool add_punctual(scene_build *b, const gltf_light *l, const transform *copy)
{
    transform to  = transform_product(copy, &l->place);
    dvec3 at      = transform_point(&to, (dvec3){ 0, 0, 0 });
    dvec3 along   = transform_vector(&to, (dvec3){ 0, 0, -1 });
    vec3 place    = d3_to_float(d3_sub(at, b->centre));
    vec3 aim      = d3_to_float(d3_scale(along, 1.0 / d3_length(along)));
    vec3 color    = luminance_one(l->color);
    double given  = l->intensity * study_group_factor(b->study, NULL);
    vec3 strength = watts(color, given);
    double i      = rgb_luminance(l->color) > 0.0f ? given : 0.0;

    if (l->kind == GLTF_DIRECTIONAL)
        return add(b, light_parallel(b->a, &(parallel_desc){ aim, strength }, b->err), l->name,
                   along, HUGE_VAL, color);
    if (l->kind == GLTF_POINT)
        return add(b, light_point(b->a, &(point_desc){ place, strength }, b->err), l->name, at,
                   4.0 * M_PI * i, color);
    cone_desc d = { place, aim, strength, (float)l->inner, (float)l->outer };
    double full = 1.0 - cos(l->inner), rim = (cos(l->inner) - cos(l->outer)) / 3.0;
    return add(b, light_cone(b->a, &d, b->err), l->name, at, 2.0 * M_PI * i * (full + rim), color);
}

static bool add_gltf_lights(scene_build *b)
{
    for (int i = 0; i < b->study->scene_count; i++) {
        const study_scene *s = &b->study->scenes[i];
        for (uint32_t k = 0; s->lights && k < b->files[i]->light_count; k++)
            for (int c = 0; c < s->at_count; c++) {
                transform copy = scene_copy_place(s, c);
                if (!add_punctual(b, &b->files[i]->lights[k], &copy))
                    return false;
            }
    }
    return true;
}

bool build_lights(scene_build *b)
{
    return add_luminaires(b) && add_points(b) && add_gltf_lights(b);
}
