/* sim/scene_lights.c -- `lights` of a study as lights of the scene.
 *
 * A lamp of L cd/m^2 and A m^2 that shines from one side sends out pi L A lumens, a line of I cd
 * square to it pi^2 I, and I cos^n to one side 2 pi I / (n + 1).
 */
#include "core/color.h"
#include "sim/scene_build.h"

/* ---- ideal lights ---------------------------------------------------------------------------- */

/* A light of a study, in one of its places after the other. */
typedef struct light_work {
    scene_build *b;
    const study_light *from;
    double made_with;
    const scene_web *file;    /* NULL: it is ideal */
    const photometry *shaped; /* the file's web with the opening of the light */
    lamps_outside outside;

    int k; /* the place's number */
    dvec3 at;
    vec3 place, aim; /* aim: unit */
    double lumens;   /* not dimmed; given back */
    bool far;
} light_work;

/* Per unit of a kind's strength, the lumens that it sends out. */
static vec3 strength_of(light_work *w, double given, double lumens_each)
{
    double strength = isnan(given) ? w->from->lumens / lumens_each : given;
    w->lumens       = strength * lumens_each;
    return lamp_watts(w->b, w->from->emission.color, strength * w->made_with);
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
    linear_desc d = { .from      = lamp_place(w->b, d3_sub(w->at, half)),
                      .to        = lamp_place(w->b, d3_add(w->at, half)),
                      .intensity = strength_of(w, w->from->intensity, M_PI * M_PI) };
    return light_linear(w->b->a, &d, w->b->err);
}

/* As strong as a flat lamp of that luminance (or flux) and area, seen from afar: I = L A. */
static const light *make_spot(light_work *w, double area)
{
    vec3 radiance = strength_of(w, w->from->luminance, M_PI * area);
    cosine_desc d = { w->place, w->aim, v3_scale(radiance, (float)area), 1.0f };
    return light_cosine(w->b->a, &d, w->b->err);
}

static const light *make_disk(light_work *w)
{
    double r = w->from->radius;
    if (is_left_out(w->b, EFFECT_AREA_LIGHTS))
        return make_spot(w, M_PI * r * r);
    disk_desc d = { w->place, w->aim, (float)r,
                    strength_of(w, w->from->luminance, M_PI * M_PI * r * r) };
    return light_disk(w->b->a, &d, w->b->err);
}

static vec3 up_of(const light_work *w)
{
    dvec3 up = study_light_up(w->from, w->k);
    return d3_to_float(d3_scale(up, 1.0 / d3_length(up)));
}

static const light *make_rect(light_work *w)
{
    const double *size = w->from->size;
    if (is_left_out(w->b, EFFECT_AREA_LIGHTS))
        return make_spot(w, size[0] * size[1]);
    rect_desc d = { .centre   = w->place,
                    .aim      = w->aim,
                    .up       = up_of(w),
                    .width    = (float)size[0],
                    .height   = (float)size[1],
                    .radiance = strength_of(w, w->from->luminance, M_PI * size[0] * size[1]) };
    return light_rect(w->b->a, &d, w->b->err);
}

static const light *make_ideal(light_work *w)
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
        return make_rect(w);
    }
    return NULL;
}

/* ---- ideal shapes that shine as a photometric file says -------------------------------------- */

/* The file's web with the opening of the light in place of its own. */
static const photometry *web_in_shape(scene_build *b, const study_light *l, const photometry *web)
{
    photometry *own = arena_new(b->a, photometry, b->err);
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

/* C0 lies across a rectangle, wherever the file's luminaire is longer: one that is longer the other
 * way is likely meant to be turned. */
static void warn_if_turned(const scene_build *b, const study_light *l, const photometry *web)
{
    const double clearly = 1.25;
    bool turned          = web->length_along_deg == 90.0f;
    double c0            = (double)(turned ? web->width : web->length);
    double c90           = (double)(turned ? web->length : web->width);
    double across = l->size[0], up = l->size[1];
    bool differ = (c0 > clearly * c90 && up > clearly * across) ||
                  (c90 > clearly * c0 && across > clearly * up);
    if (l->kind == STUDY_RECT && differ)
        notice_add(b->notices,
                   "%s:%d:%d: the opening of %s is longer along %s (%.3g m along C0, %.3g m along "
                   "C90), this rect along %s (%.3g m and %.3g m): its light lies turned by 90 "
                   "degrees; with the other order of `size`, and `up` turned too, it would not",
                   b->study->path, l->where.line, l->where.column, l->photometry,
                   c0 > c90 ? "C0" : "C90", c0, c90, across > up ? "C0" : "C90", across, up);
}

static bool read_shape(light_work *w)
{
    const study_light *l = w->from;
    w->file              = study_web(w->b, l->photometry, l->where);
    if (!w->file)
        return false;
    if (!isnan(l->lumens) && !(w->file->web->luminaire_lumens > 0.0))
        return study_failed(w->b->study, l->where, w->b->err, ERR_ARGUMENT,
                            "`lumens` cannot scale %s: it gives no light", l->photometry);
    warn_if_turned(w->b, l, w->file->web);
    w->shaped = web_in_shape(w->b, l, w->file->web);
    return w->shaped != NULL;
}

/* Where C0 lies: across a rectangle; the file's length along a line, whose web looks down. */
static void frame_of_shape(const light_work *w, luminaire_desc *d)
{
    if (w->from->kind == STUDY_RECT)
        d->c0 = v3_cross(d->aim, up_of(w));
    if (w->from->kind != STUDY_LINEAR)
        return;
    dvec3 along = d3_scale(w->from->along, 1.0 / d3_length(w->from->along));
    dvec3 down  = fabs(along.z) < 1.0 - 1e-9 ? (dvec3){ 0, 0, -1 } : (dvec3){ 1, 0, 0 };
    dvec3 aim   = d3_sub(down, d3_scale(along, d3_dot(down, along)));
    aim         = d3_scale(aim, 1.0 / d3_length(aim));
    bool turned = w->shaped->length_along_deg == 90.0f;
    d->aim      = d3_to_float(aim);
    d->c0       = d3_to_float(turned ? d3_cross(aim, along) : along);
}

static const light *make_shaped(light_work *w)
{
    double lumens    = w->from->lumens;
    double own       = w->shaped->luminaire_lumens;
    luminaire_desc d = { .position = w->place,
                         .aim      = w->aim,
                         .web      = w->shaped,
                         .model    = w->file->model,
                         .point    = is_left_out(w->b, EFFECT_NEAR_FIELD) };
    frame_of_shape(w, &d);
    double factor = isnan(lumens) ? 1.0 : lumens / own;
    factor *= lamp_tilt(w->shaped, d3_from(d.aim), lumens);
    w->lumens = factor * own;
    d.scale   = lamp_watts(w->b, w->from->emission.color, factor * w->made_with);
    return light_luminaire(w->b->a, &d, w->b->err);
}

/* ---- all ------------------------------------------------------------------------------------- */

static const char *kind_name(study_light_kind kind)
{
    static const char *const names[] = {
        [STUDY_POINT] = "point",       [STUDY_CONE] = "cone",     [STUDY_COSINE] = "cosine",
        [STUDY_PARALLEL] = "parallel", [STUDY_LINEAR] = "linear", [STUDY_DISK] = "disk",
        [STUDY_RECT] = "rect"
    };
    return names[kind];
}

static bool add_light(light_work *w, int k)
{
    const study_light *l = w->from;
    dvec3 aim            = study_light_aim(l, k);
    w->k                 = k;
    w->at                = l->at_count ? l->at[k] : aim;
    w->aim               = d3_to_float(d3_scale(aim, 1.0 / d3_length(aim)));
    if (l->at_count) {
        w->place = lamp_place(w->b, w->at);
        lamp_look_outside(w->b, w->at, &w->outside);
    }
    const light *made = w->file ? make_shaped(w) : make_ideal(w);
    lamp_entry e      = { .where    = l->where,
                          .name     = l->name ? l->name : kind_name(l->kind),
                          .at       = w->at,
                          .emission = &l->emission,
                          .lumens   = w->lumens,
                          .watts    = (double)NAN,
                          .web      = w->file ? w->file->web : NULL,
                          .far      = w->far };
    return lamp_add(w->b, made, &e);
}

bool build_lights(scene_build *b)
{
    for (int i = 0; i < b->study->light_count; i++) {
        const study_light *l = &b->study->lights[i];
        light_work w         = { .b = b, .from = l, .made_with = lamp_made_with(b, &l->emission) };
        if (l->photometry && !read_shape(&w))
            return false;
        lamp_check_dimming(b, l->where, l->emission.dimming);
        int places = l->at_count ? l->at_count : 1;
        for (int k = 0; k < places; k++)
            if (!add_light(&w, k))
                return false;
        lamp_tell_outside(b, l->where, "light", &w.outside);
    }
    return true;
}
