/* sim/scene_lamps.c -- what all lamps of a scene share: those of `luminaires`, of `lights`, of
 * glTF.
 *
 * Lumens and candelas end here: inside, light is radiometric (core/color.h).
 *
 * In a layered scene lights are made as if they were not dimmed, and each says what it is dimmed
 * to.
 */
#include "core/color.h"
#include "sim/scene_build.h"

#include <stdio.h>
#include <string.h>

vec3 lamp_watts(const scene_build *b, vec3 color, double per_lumen_unit)
{
    return v3_scale(scene_color(b, color), (float)(per_lumen_unit / LUMENS_PER_WATT));
}

double lamp_tilt(const photometry *web, dvec3 aim, double lumens)
{
    if (!isnan(lumens))
        return 1.0;
    double down = -aim.z / d3_length(aim);
    return photometry_tilt_factor(web, acos(fmax(-1.0, fmin(down, 1.0))) * (180.0 / M_PI));
}

/* Of the lamp and its group together. */
static double dimming_of(const scene_build *b, const study_emission *e)
{
    return e->dimming * study_group_factor(b->study, e->group);
}

double lamp_made_with(const scene_build *b, const study_emission *e)
{
    return b->options->layered ? 1.0 : dimming_of(b, e);
}

int scene_group(scene_build *b, const char *name)
{
    const char **names = b->groups.items;
    for (size_t i = b->groups.count; i-- > 0;) /* mostly it is one of the last */
        if (!strcmp(names[i], name))
            return (int)i;
    const char **to = list_new(&b->groups, b->a, const char *, b->err);
    if (!to)
        return -1;
    *to = name;
    return (int)b->groups.count - 1;
}

/* Makers of lights know no file: theirs begin with "KIND light: " or "luminaire: ". */
static bool pass_on(scene_build *b, study_where where)
{
    lux_error why     = *b->err;
    const char *colon = strchr(why.text, ':');
    bool of_light     = colon && colon - why.text > 6 && !strncmp(colon - 6, " light", 6);
    if (of_light || !strncmp(why.text, "luminaire: ", 11))
        study_failed(b->study, where, b->err, why.code, "%s", why.text);
    return false;
}

/* In a series all lamps are one. */
static int lamp_group(scene_build *b, const char *name)
{
    if (b->options->moments)
        return scene_group(b, SCENE_LAMPS);
    return scene_group(b, name ? name : STUDY_GROUP_OTHER);
}

bool lamp_add(scene_build *b, const light *l, const lamp_entry *e)
{
    if (!l)
        return pass_on(b, e->where);
    const light **to  = list_new(&b->lights, b->a, const light *, b->err);
    scene_light *info = to ? list_new(&b->light_info, b->a, scene_light, b->err) : NULL;
    int group         = info ? lamp_group(b, e->emission->group) : -1;
    if (group < 0)
        return false;
    vec3 color     = scene_color(b, e->emission->color);
    vec3 first     = ((const scene_light *)b->light_info.items)->color;
    double dimming = dimming_of(b, e->emission);
    *to            = l;
    *info          = (scene_light){ .name      = e->name,
                                    .at        = e->at,
                                    .lumens    = e->far ? HUGE_VAL : dimming * e->lumens,
                                    .watts     = e->watts,
                                    .full      = e->far ? HUGE_VAL : e->lumens,
                                    .web       = e->web,
                                    .color     = color,
                                    .group     = group,
                                    .dimming   = b->options->layered ? (float)dimming : 1.0f,
                                    .dimmed_to = dimming,
                                    .where     = e->where,
                                    .luminaire = e->luminaire,
                                    .owner     = e->owner };
    b->lights_differ |=
        b->lights.count > 1 && (color.x != first.x || color.y != first.y || color.z != first.z);
    return true;
}

vec3 lamp_place(const scene_build *b, dvec3 at) { return d3_to_float(d3_sub(at, b->centre)); }

/* ---- what looks like a mistake --------------------------------------------------------------- */

/* The room; without one, what is not farther from the surfaces than they are large. (A street lamp
 * stands above all of them, and is right.) False: there is nothing to be outside of. */
static bool reach_of(const scene_build *b, dvec3 *low, dvec3 *high)
{
    *low  = (dvec3){ 0, 0, 0 };
    *high = b->study->room.size;
    if (b->study->room.given)
        return true;
    double far = d3_length(d3_sub(b->high, b->low));
    *low       = d3_sub(b->low, (dvec3){ far, far, far });
    *high      = d3_add(b->high, (dvec3){ far, far, far });
    return b->low.x <= b->high.x;
}

void lamp_look_outside(const scene_build *b, dvec3 at, lamps_outside *o)
{
    dvec3 low, high;
    if (!reach_of(b, &low, &high) || (at.x >= low.x && at.x <= high.x && at.y >= low.y &&
                                      at.y <= high.y && at.z >= low.z && at.z <= high.z))
        return;
    if (o->count++ == 0)
        o->first = at;
}

void lamp_tell_outside(const scene_build *b, study_where where, const char *what,
                       const lamps_outside *o)
{
    dvec3 low, high;
    if (o->count == 0 || !reach_of(b, &low, &high))
        return;
    char who[80];
    if (o->count == 1)
        snprintf(who, sizeof who, "a %s", what);
    else
        snprintf(who, sizeof who, "%d %ss, the first", o->count, what);
    notice_add(b->notices,
               "%s:%d:%d: %s at (%g, %g, %g) m%s outside the %s, (%g, %g, %g) to (%g, %g, %g) m",
               b->study->path, where.line, where.column, who, o->first.x, o->first.y, o->first.z,
               o->count == 1 ? " lies" : ", lie", b->study->room.given ? "room" : "scene", low.x,
               low.y, low.z, high.x, high.y, high.z);
}

/* 50 for half is a likely slip. */
void lamp_check_dimming(const scene_build *b, study_where where, double dimming)
{
    if (dimming > 1.0)
        notice_add(b->notices,
                   "%s:%d:%d: `dimming: %g` is more than the full light (0.5 is half of it)",
                   b->study->path, where.line, where.column, dimming);
}

/* ---- the whole ------------------------------------------------------------------------------- */

/* A mix takes a group as one: it cannot give back what differs within it. */
static void warn_of_mixed_dimming(const scene_build *b)
{
    const scene_light *info = b->light_info.items;
    for (size_t g = 0; b->options->layered && g < b->groups.count; g++) {
        const scene_light *first = NULL;
        bool differ              = false;
        for (size_t i = 0; i < b->light_info.count; i++) {
            if (info[i].group != (int)g)
                continue;
            differ = differ || (first && info[i].dimming != first->dimming);
            first  = first ? first : &info[i];
        }
        if (differ)
            notice_add(b->notices,
                       "%s: lights of group `%s` are dimmed differently: its layer has all of "
                       "them in full",
                       b->study->path, ((const char **)b->groups.items)[g]);
    }
}

bool build_lamps(scene_build *b)
{
    if (b->options->lamps_off)
        return true;
    if (!build_luminaires(b) || !build_lights(b) || !build_gltf_lights(b))
        return false;
    warn_of_mixed_dimming(b);
    return true;
}
