/* sim/scene_lights_gltf.c -- the lights of glTF files (gltf.h) as lights of the scene. */
#include "core/color.h"
#include "sim/scene_build.h"

/* They have no group of the study's, and are not dimmed but by that of the others. */
static study_emission emission_of(const gltf_light *l)
{
    float y = rgb_luminance(l->color);
    return (study_emission){ .color   = y > 0.0f ? v3_scale(l->color, 1.0f / y) : (vec3){ 1, 1, 1 },
                             .dimming = 1.0 };
}

/* A light of a file in one of the file's copies. */
typedef struct gltf_work {
    scene_build *b;
    const gltf_light *from;
    study_emission emission;
    dvec3 at, along; /* m, in the user's frame; where it shines to, unit */
    vec3 place, aim; /* the same in the scene's */
    dvec3 x, y;      /* where the node's x and y axes point, unit */
    double strength; /* of the file, 0 where its colour is black */
    double scale;    /* of the copy */
    double lumens;   /* not dimmed; given back */
    const photometry *web;
} gltf_work;

static vec3 watts_of(const gltf_work *w)
{
    return lamp_watts(w->b, w->emission.color, w->strength * lamp_made_with(w->b, &w->emission));
}

static const light *make_spot(gltf_work *w)
{
    const gltf_light *l = w->from;
    cone_desc d         = { w->place, w->aim, watts_of(w), (float)l->inner, (float)l->outer };
    double full = 1.0 - cos(l->inner), rim = (cos(l->inner) - cos(l->outer)) / 3.0;
    w->lumens = 2.0 * M_PI * w->strength * (full + rim);
    return light_cone(w->b->a, &d, w->b->err);
}

static const light *make_area(gltf_work *w)
{
    const gltf_light *l = w->from;
    if (l->kind == GLTF_AREA_DISK) {
        double r    = l->radius * w->scale;
        disk_desc d = { w->place, w->aim, (float)r, watts_of(w) };
        w->lumens   = M_PI * M_PI * r * r * w->strength;
        return light_disk(w->b->a, &d, w->b->err);
    }
    double width = l->width * w->scale, height = l->height * w->scale;
    rect_desc d = { w->place, w->aim, d3_to_float(w->y), (float)width, (float)height, watts_of(w) };
    w->lumens   = M_PI * width * height * w->strength;
    return light_rect(w->b->a, &d, w->b->err);
}

static const scene_web *file_of(gltf_work *w)
{
    const gltf_light *l = w->from;
    if (l->photometry_bytes)
        return scene_web_of(w->b, l->photometry_name, l->photometry_bytes, l->photometry_size,
                            w->b->err);
    lux_error why        = { 0 };
    const scene_web *web = scene_web_of(w->b, l->photometry_path, NULL, 0, &why);
    if (!web && why.code == ERR_IO) /* the scene names what is not there */
        return failed(w->b->err, ERR_IO, "%s: %s", l->photometry_name, why.text);
    return web ? web : failed(w->b->err, why.code, "%s", why.text);
}

static const light *make_measured(gltf_work *w)
{
    const scene_web *file = file_of(w);
    if (!file)
        return NULL;
    w->web = file->web;
    w->strength *= lamp_tilt(w->web, w->along, (double)NAN);
    luminaire_desc d = { .position = w->place,
                         .aim      = w->aim,
                         .c0       = d3_to_float(w->x),
                         .scale    = watts_of(w),
                         .web      = w->web,
                         .model    = file->model };
    w->lumens        = w->strength * w->web->luminaire_lumens;
    return light_luminaire(w->b->a, &d, w->b->err);
}

static const light *make(gltf_work *w)
{
    switch (w->from->kind) {
    case GLTF_DIRECTIONAL:
        w->lumens = HUGE_VAL;
        return light_parallel(w->b->a, &(parallel_desc){ .aim = w->aim, .irradiance = watts_of(w) },
                              w->b->err);
    case GLTF_POINT:
        w->lumens = 4.0 * M_PI * w->strength;
        return light_point(w->b->a, &(point_desc){ w->place, watts_of(w) }, w->b->err);
    case GLTF_SPOT:
        return make_spot(w);
    case GLTF_IES:
        return make_measured(w);
    case GLTF_AREA_RECT:
    case GLTF_AREA_DISK:
        return make_area(w);
    }
    return NULL;
}

static dvec3 unit(dvec3 v) { return d3_scale(v, 1.0 / d3_length(v)); }

static bool add(scene_build *b, const study_scene *s, const gltf_light *l, const transform *copy)
{
    transform to      = transform_product(copy, &l->place);
    dvec3 at          = transform_point(&to, (dvec3){ 0, 0, 0 });
    dvec3 along       = unit(transform_vector(&to, (dvec3){ 0, 0, -1 }));
    double given      = l->kind == GLTF_IES ? l->multiplier : l->intensity;
    gltf_work w       = { .b        = b,
                          .from     = l,
                          .emission = emission_of(l),
                          .at       = at,
                          .along    = along,
                          .place    = lamp_place(b, at),
                          .aim      = d3_to_float(along),
                          .x        = unit(transform_vector(&to, (dvec3){ 1, 0, 0 })),
                          .y        = unit(transform_vector(&to, (dvec3){ 0, 1, 0 })),
                          .strength = rgb_luminance(l->color) > 0.0f ? given : 0.0,
                          .scale    = s->scale };
    const light *made = make(&w);
    bool far          = l->kind == GLTF_DIRECTIONAL;
    lamp_entry e      = { .where    = s->where,
                          .name     = l->name,
                          .at       = far ? along : at,
                          .emission = &w.emission,
                          .lumens   = w.lumens,
                          .watts    = w.web && w.web->watts > 0.0 ? w.web->watts : (double)NAN,
                          .web      = w.web,
                          .far      = far };
    return lamp_add(b, made, &e);
}

bool build_gltf_lights(scene_build *b)
{
    for (int i = 0; i < b->study->scene_count; i++) {
        const study_scene *s = &b->study->scenes[i];
        for (uint32_t k = 0; s->lights && k < b->files[i]->light_count; k++)
            for (int c = 0; c < s->at_count; c++) {
                transform copy = scene_copy_place(s, c);
                if (!add(b, s, &b->files[i]->lights[k], &copy))
                    return false;
            }
    }
    return true;
}
