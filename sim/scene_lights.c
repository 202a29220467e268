/* sim/scene_lights.c -- the lamps of a study as lights of the scene.
 *
 * Lumens and candelas end here: inside, light is radiometric (core/color.h). A lamp of L cd/m^2 and
 * A m^2 that shines from one side sends out pi L A lumens, a line of I cd square to it pi^2 I, and
 * I cos^n to one side 2 pi I / (n + 1).
 *
 * In a layered scene lights are made as if they were not dimmed, and each says what it is dimmed
 * to.
 */
#include "core/color.h"
#include "sim/scene_build.h"

#include <stdio.h>
#include <string.h>

/* ---- what all lamps share -------------------------------------------------------------------- */

vec3 lamp_watts(vec3 color, double per_lumen_unit)
{
    return v3_scale(color, (float)(per_lumen_unit / LUMENS_PER_WATT));
}

double lamp_tilt(const photometry *web, dvec3 aim)
{
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

/* The number of a group by its name; -1 if memory is out. */
static int group_of(scene_build *b, const char *name)
{
    const char **names = b->groups.items;
    for (size_t i = 0; i < b->groups.count; i++)
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

bool lamp_add(scene_build *b, const light *l, const lamp_entry *e)
{
    if (!l)
        return pass_on(b, e->where);
    const light **to  = list_new(&b->lights, b->a, const light *, b->err);
    scene_light *info = to ? list_new(&b->light_info, b->a, scene_light, b->err) : NULL;
    int group =
        info ? group_of(b, e->emission->group ? e->emission->group : STUDY_GROUP_OTHER) : -1;
    if (group < 0)
        return false;
    vec3 color     = e->emission->color;
    vec3 first     = ((const scene_light *)b->light_info.items)->color;
    double dimming = dimming_of(b, e->emission);
    *to            = l;
    *info          = (scene_light){ .name      = e->name,
                                    .at        = e->at,
                                    .lumens    = e->far ? HUGE_VAL : dimming * e->lumens,
                                    .watts     = e->watts,
                                    .full      = e->far ? HUGE_VAL : e->lumens,
                                    .web       = e->web,
                                    .profile   = e->profile,
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

static vec3 place_of(const scene_build *b, dvec3 at) { return d3_to_float(d3_sub(at, b->centre)); }

static const char *file_name(const char *path)
{
    return strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
}

/* ---- photometric files ----------------------------------------------------------------------- */

/* The web of a file, read once; `earlier` are those that were read before. */
static const photometry *read_web(scene_build *b, const char *path, study_where where)
{
    lux_error why         = { 0 };
    const photometry *web = photometry_read(b->a, path, b->notices, &why);
    if (!web && why.code == ERR_IO) /* the study names what is not there */
        return study_failed(b->study, where, b->err, ERR_IO, "%s", why.text);
    return web ? web : failed(b->err, why.code, "%s", why.text);
}

static const photometry *luminaire_web(scene_build *b, int i, const photometry **webs)
{
    const study_luminaire *all = b->study->luminaires;
    for (int j = 0; j < i; j++)
        if (!strcmp(all[j].photometry, all[i].photometry))
            return webs[j];
    return read_web(b, all[i].photometry, all[i].where);
}

static bool luminaire_factor(scene_build *b, const study_luminaire *l, const photometry *web,
                             double *factor)
{
    *factor = 1.0;
    if (!isnan(l->lumens)) {
        if (!(web->luminaire_lumens > 0.0))
            return study_failed(b->study, l->where, b->err, ERR_ARGUMENT,
                                "`lumens` cannot scale %s: it gives no light", l->photometry);
        *factor = l->lumens / web->luminaire_lumens;
    } else if (!isnan(l->lamp_lumens)) {
        if (!(web->lamp_lumens > 0.0))
            return study_failed(b->study, l->where, b->err, ERR_ARGUMENT,
                                "`lamp_lumens` cannot scale %s: its photometry is absolute (say "
                                "`lumens`)",
                                l->photometry);
        *factor = l->lamp_lumens / web->lamp_lumens;
    }
    return true;
}

/* ---- luminaires ------------------------------------------------------------------------------ */

typedef struct luminaire_work {
    scene_build *b;
    const study_luminaire *from;
    const photometry *web;
    double factor; /* of the file's candelas, not dimmed */
} luminaire_work;

static bool add_luminaire(const luminaire_work *w, luminaire_desc *d, dvec3 at, int32_t owner)
{
    scene_build *b           = w->b;
    const study_luminaire *l = w->from;
    double factor            = w->factor * lamp_tilt(w->web, d3_from(d->aim));
    double watts = !isnan(l->watts) ? l->watts : w->web->watts > 0.0 ? w->web->watts : (double)NAN;
    lamp_entry e = { .where     = l->where,
                     .luminaire = l,
                     .name      = l->name ? l->name : file_name(l->photometry),
                     .at        = at,
                     .emission  = &l->emission,
                     .lumens    = factor * w->web->luminaire_lumens,
                     .watts     = watts,
                     .web       = w->web,
                     .owner     = owner };
    d->position  = place_of(b, at);
    d->scale     = lamp_watts(l->emission.color, factor * lamp_made_with(b, &l->emission));
    d->web       = w->web;
    warn_if_outside(b, l->where, "luminaire", at);
    return lamp_add(b, light_luminaire(b->a, d, b->err), &e);
}

static bool add_at_places(const luminaire_work *w)
{
    const study_luminaire *l = w->from;
    for (int k = 0; k < l->at_count; k++) {
        dvec3 aim        = l->aim_at_given ? d3_sub(l->aim_at, l->at[k]) : l->aim;
        luminaire_desc d = { .aim    = d3_to_float(d3_scale(aim, 1.0 / d3_length(aim))),
                             .rotate = (float)(l->rotate_deg * (M_PI / 180.0)) };
        if (!add_luminaire(w, &d, l->at[k], 0))
            return false;
    }
    return true;
}

/* As the node is turned: its -y, which glTF has down, is gamma 0, and its x is C0, turned by
 * `rotate` about the axis; unless the study says where to aim. */
static bool add_at_nodes(const luminaire_work *w, const node_lamps *nodes)
{
    const study_luminaire *l = w->from;
    const node_lamp *lamps   = nodes->lamps.items;
    double turn              = l->rotate_deg * (M_PI / 180.0);
    for (size_t k = 0; k < nodes->lamps.count; k++) {
        const transform *place = &lamps[k].place;
        dvec3 at               = transform_point(place, (dvec3){ 0, 0, 0 });
        dvec3 aim              = transform_vector(place, (dvec3){ 0, -1, 0 });
        dvec3 c0               = transform_vector(place, (dvec3){ 1, 0, 0 });
        luminaire_desc d       = { .rotate = (float)turn };
        if (l->aim_at_given || l->aim_given) {
            aim = l->aim_at_given ? d3_sub(l->aim_at, at) : l->aim;
        } else {
            aim       = d3_scale(aim, 1.0 / d3_length(aim));
            dvec3 c90 = d3_cross(c0, aim);
            d.c0      = d3_to_float(d3_add(d3_scale(c0, cos(turn)), d3_scale(c90, sin(turn))));
        }
        if (!(d3_length(aim) > 0.0) || !isfinite(d3_length(aim)))
            return study_failed(w->b->study, l->where, w->b->err, ERR_ARGUMENT,
                                "a luminaire at (%g, %g, %g) m has no direction to shine to", at.x,
                                at.y, at.z);
        d.aim = d3_to_float(d3_scale(aim, 1.0 / d3_length(aim)));
        if (!add_luminaire(w, &d, at, lamps[k].owner))
            return false;
    }
    return true;
}

static bool add_luminaires(scene_build *b)
{
    const study *s = b->study;
    const photometry **webs =
        arena_array(b->a, const photometry *, (size_t)s->luminaire_count + 1, b->err);
    if (!webs)
        return false;
    for (int i = 0; i < s->luminaire_count; i++) {
        luminaire_work w = { b, &s->luminaires[i], luminaire_web(b, i, webs), 1.0 };
        webs[i]          = w.web;
        if (!w.web || !luminaire_factor(b, w.from, w.web, &w.factor))
            return false;
        warn_if_brightened(b, w.from->where, w.from->emission.dimming);
        if (!(w.from->nodes ? add_at_nodes(&w, &b->at_nodes[i]) : add_at_places(&w)))
            return false;
    }
    return true;
}

/* ---- ideal lights ---------------------------------------------------------------------------- */

/* One light of a study in one of its places. */
typedef struct light_work {
    scene_build *b;
    const study_light *from;
    dvec3 at;
    vec3 place, aim; /* aim: unit */
    double made_with;
    double lumens; /* not dimmed; given back */
    bool far;
} light_work;

/* Per unit of a kind's strength, the lumens that it sends out. */
static vec3 strength_of(light_work *w, double given, double lumens_each)
{
    double strength = isnan(given) ? w->from->lumens / lumens_each : given;
    w->lumens       = strength * lumens_each;
    return lamp_watts(w->from->emission.color, strength * w->made_with);
}

static const light *make_point(light_work *w)
{
    point_desc d = { w->place, strength_of(w, w->from->intensity, 4.0 * M_PI) };
    return light_point(w->b->a, &d, w->b->err);
}

static const light *make_cone(light_work *w)
{
    double inner = w->from->inner_deg * (M_PI / 180.0), outer = w->from->outer_deg * (M_PI / 180.0);
    double full = 1.0 - cos(inner), rim = (cos(inner) - cos(outer)) / 3.0;
    vec3 i      = strength_of(w, w->from->intensity, 2.0 * M_PI * (full + rim));
    cone_desc d = { w->place, w->aim, i, (float)inner, (float)outer };
    d.outer     = fminf(d.outer, (float)M_PI);
    return light_cone(w->b->a, &d, w->b->err);
}

static const light *make_cosine(light_work *w)
{
    double n      = w->from->exponent;
    cosine_desc d = { .position  = w->place,
                      .aim       = w->aim,
                      .intensity = strength_of(w, w->from->intensity, 2.0 * M_PI / (n + 1.0)),
                      .exponent  = (float)n };
    return light_cosine(w->b->a, &d, w->b->err);
}

static const light *make_parallel(light_work *w)
{
    bool beam       = !isnan(w->from->radius);
    parallel_desc d = { .aim        = w->aim,
                        .irradiance = strength_of(w, w->from->illuminance, 1.0),
                        .at         = beam ? w->place : (vec3){ 0, 0, 0 },
                        .radius     = beam ? (float)w->from->radius : 0.0f };
    w->far          = !beam;
    w->lumens *= beam ? M_PI * w->from->radius * w->from->radius : 1.0;
    return light_parallel(w->b->a, &d, w->b->err);
}

static const light *make_linear(light_work *w)
{
    dvec3 half    = d3_scale(w->from->along, 0.5);
    linear_desc d = { .from      = place_of(w->b, d3_sub(w->at, half)),
                      .to        = place_of(w->b, d3_add(w->at, half)),
                      .intensity = strength_of(w, w->from->intensity, M_PI * M_PI) };
    return light_linear(w->b->a, &d, w->b->err);
}

static const light *make_disk(light_work *w)
{
    double r    = w->from->radius;
    disk_desc d = { w->place, w->aim, (float)r,
                    strength_of(w, w->from->luminance, M_PI * M_PI * r * r) };
    return light_disk(w->b->a, &d, w->b->err);
}

static vec3 up_of(const light_work *w, int k)
{
    dvec3 up = study_light_up(w->from, k);
    return d3_to_float(d3_scale(up, 1.0 / d3_length(up)));
}

static const light *make_rect(light_work *w, vec3 up)
{
    const double *size = w->from->size;
    rect_desc d        = { .centre   = w->place,
                           .aim      = w->aim,
                           .up       = up,
                           .width    = (float)size[0],
                           .height   = (float)size[1],
                           .radiance = strength_of(w, w->from->luminance, M_PI * size[0] * size[1]) };
    return light_rect(w->b->a, &d, w->b->err);
}

static const light *make_ideal(light_work *w, int k)
{
    switch (w->from->kind) {
    case STUDY_POINT:
        return make_point(w);
    case STUDY_CONE:
        return make_cone(w);
    case STUDY_COSINE:
        return make_cosine(w);
    case STUDY_PARALLEL:
        return make_parallel(w);
    case STUDY_LINEAR:
        return make_linear(w);
    case STUDY_DISK:
        return make_disk(w);
    case STUDY_RECT:
        return make_rect(w, up_of(w, k));
    }
    return NULL;
}

/* ---- ideal shapes that shine as a photometric file says ---------------------------------------
 */

/* The file's web with the opening of the light in place of its own. */
static photometry *web_in_shape(light_work *w, const photometry *web)
{
    const study_light *l = w->from;
    photometry *own      = arena_new(w->b->a, photometry, w->b->err);
    if (!own)
        return NULL;
    *own         = *web;
    own->length  = (float)(2.0 * l->radius);
    own->width   = own->length;
    own->height  = 0.0f;
    own->opening = OPENING_DISC;
    if (l->kind == STUDY_RECT) {
        own->opening          = OPENING_RECTANGLE;
        own->length           = (float)l->size[0];
        own->width            = (float)l->size[1];
        own->length_along_deg = 0.0f;
    } else if (l->kind == STUDY_LINEAR) {
        own->opening = OPENING_LINE;
        own->length  = (float)d3_length(l->along);
        own->width   = 0.0f;
    }
    return own;
}

/* Where C0 lies: across a rectangle; the file's length along a line, whose web looks down. */
static void frame_of_shape(light_work *w, int k, const photometry *web, luminaire_desc *d)
{
    if (w->from->kind == STUDY_RECT)
        d->c0 = v3_cross(d->aim, up_of(w, k));
    if (w->from->kind != STUDY_LINEAR)
        return;
    dvec3 along = d3_scale(w->from->along, 1.0 / d3_length(w->from->along));
    dvec3 down  = fabs(along.z) < 1.0 - 1e-9 ? (dvec3){ 0, 0, -1 } : (dvec3){ 1, 0, 0 };
    dvec3 aim   = d3_sub(down, d3_scale(along, d3_dot(down, along)));
    aim         = d3_scale(aim, 1.0 / d3_length(aim));
    d->aim      = d3_to_float(aim);
    d->c0       = d3_to_float(web->length_along_deg == 90.0f ? d3_cross(aim, along) : along);
}

static const light *make_shaped(light_work *w, int k, const photometry *web)
{
    double factor   = isnan(w->from->lumens) ? 1.0 : w->from->lumens / web->luminaire_lumens;
    photometry *own = web_in_shape(w, web);
    if (!(web->luminaire_lumens > 0.0) && !isnan(w->from->lumens))
        return study_failed(w->b->study, w->from->where, w->b->err, ERR_ARGUMENT,
                            "`lumens` cannot scale %s: it gives no light", w->from->photometry);
    if (!own)
        return NULL;
    luminaire_desc d = { .position = w->place,
                         .aim      = w->aim,
                         .scale    = lamp_watts(w->from->emission.color, factor * w->made_with),
                         .web      = own };
    frame_of_shape(w, k, web, &d);
    double tilt = lamp_tilt(web, d3_from(d.aim));
    d.scale     = v3_scale(d.scale, (float)tilt);
    w->lumens   = tilt * factor * web->luminaire_lumens;
    return light_luminaire(w->b->a, &d, w->b->err);
}

static const char *kind_name(study_light_kind kind)
{
    static const char *const names[] = {
        [STUDY_POINT] = "point",       [STUDY_CONE] = "cone",     [STUDY_COSINE] = "cosine",
        [STUDY_PARALLEL] = "parallel", [STUDY_LINEAR] = "linear", [STUDY_DISK] = "disk",
        [STUDY_RECT] = "rect"
    };
    return names[kind];
}

static bool add_light(scene_build *b, const study_light *l, int k, const photometry *web)
{
    dvec3 aim    = study_light_aim(l, k);
    light_work w = { .b         = b,
                     .from      = l,
                     .at        = l->at_count ? l->at[k] : aim,
                     .aim       = d3_to_float(d3_scale(aim, 1.0 / d3_length(aim))),
                     .made_with = lamp_made_with(b, &l->emission) };
    if (l->at_count) {
        w.place = place_of(b, w.at);
        warn_if_outside(b, l->where, "light", w.at);
    }
    const light *made = web ? make_shaped(&w, k, web) : make_ideal(&w, k);
    lamp_entry e      = { .where    = l->where,
                          .name     = l->name ? l->name : kind_name(l->kind),
                          .at       = w.at,
                          .emission = &l->emission,
                          .lumens   = w.lumens,
                          .watts    = (double)NAN,
                          .web      = web,
                          .far      = w.far };
    return lamp_add(b, made, &e);
}

static bool add_lights(scene_build *b)
{
    for (int i = 0; i < b->study->light_count; i++) {
        const study_light *l  = &b->study->lights[i];
        const photometry *web = l->photometry ? read_web(b, l->photometry, l->where) : NULL;
        if (l->photometry && !web)
            return false;
        warn_if_brightened(b, l->where, l->emission.dimming);
        int places = l->at_count ? l->at_count : 1;
        for (int k = 0; k < places; k++)
            if (!add_light(b, l, k, web))
                return false;
    }
    return true;
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

bool build_lights(scene_build *b)
{
    if (!add_luminaires(b) || !add_lights(b) || !build_gltf_lights(b))
        return false;
    warn_of_mixed_dimming(b);
    return true;
}
