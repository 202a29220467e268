/* sim/camera.c -- see camera.h. */
#include "sim/camera.h"

#include <string.h>

static bool has_direction(dvec3 v) { return d3_finite(v) && d3_length(v) > 0.0; }
static dvec3 unit(dvec3 v) { return d3_scale(v, 1.0 / d3_length(v)); }

/* Half of the picture's width and height, at unit distance or in metres. */
static void set(camera *c, const scene *s, dvec3 eye, dvec3 right, dvec3 up, dvec3 forward,
                double half_width, double half_height)
{
    c->eye     = scene_place(s, eye);
    c->right   = d3_to_float(d3_scale(right, half_width));
    c->up      = d3_to_float(d3_scale(up, half_height));
    c->forward = d3_to_float(forward);
}

static bool of_eye_and_target(const scene *s, const study_view *v, camera *c, lux_error *err)
{
    dvec3 look = d3_sub(v->target, v->eye);
    if (!has_direction(look))
        return study_failed(s->study, v->where, err, ERR_ARGUMENT,
                            "view `%s`: eye and target are the same place", v->name);
    dvec3 forward = unit(look);
    dvec3 across  = d3_cross(forward, (dvec3){ 0, 0, 1 });
    if (d3_length(across) < 1e-6) /* straight up or down: north is up in the picture */
        across = d3_cross(forward, (dvec3){ 0, 1, 0 });
    dvec3 right = unit(across), up = d3_cross(right, forward);

    c->perspective = v->projection == PROJECTION_PERSPECTIVE;
    double half    = c->perspective ? tan(0.5 * v->fov_deg * (M_PI / 180.0)) : 0.5 * v->width_m;
    set(c, s, v->eye, right, up, forward, half, half * c->height / c->width);
    return true;
}

static bool of_gltf(const scene *s, const study_view *v, camera *c, lux_error *err)
{
    const scene_camera *from = NULL;
    for (int i = 0; i < s->camera_count && !from; i++)
        if (!strcmp(s->cameras[i].name, v->camera))
            from = &s->cameras[i];
    if (!from)
        return study_failed(s->study, v->where, err, ERR_ARGUMENT,
                            "view `%s`: no camera `%s` in the scene%s%s", v->name, v->camera,
                            s->camera_count ? ", which has " : ": it has none",
                            s->camera_count ? s->cameras[0].name : "");
    dvec3 look = transform_vector(&from->place, (dvec3){ 0, 0, -1 });
    dvec3 top  = transform_vector(&from->place, (dvec3){ 0, 1, 0 });
    dvec3 side = d3_cross(look, top);
    if (!has_direction(look) || !has_direction(side))
        return study_failed(s->study, v->where, err, ERR_ARGUMENT,
                            "view `%s`: camera `%s` is scaled to nothing", v->name, v->camera);

    double shape = from->perspective ? from->aspect : from->xmag / from->ymag;
    if (!v->size_given && shape > 0.0 && shape < HUGE_VAL)
        c->height = (int)fmin(fmax(round(c->width / shape), 1.0), 16384.0);
    dvec3 forward = unit(look), right = unit(side), up = d3_cross(right, forward);
    double aspect  = (double)c->width / c->height;
    c->perspective = from->perspective;
    double half    = c->perspective ? tan(0.5 * from->yfov) : from->ymag;
    set(c, s, transform_point(&from->place, (dvec3){ 0, 0, 0 }), right, up, forward, half * aspect,
        half);
    return true;
}

bool camera_of_view(const scene *s, const study_view *v, camera *out, lux_error *err)
{
    *out        = (camera){ .width = v->width, .height = v->height };
    bool good   = v->camera ? of_gltf(s, v, out, err) : of_eye_and_target(s, v, out, err);
    out->spread = out->perspective ? 2.0f * v3_length(out->up) / (float)out->height : 0.0f;
    return good;
}

vray camera_ray(const camera *c, vfloat x, vfloat y)
{
    vfloat s  = 2.0f / (float)c->width * x - 1.0f;
    vfloat t  = 1.0f - 2.0f / (float)c->height * y;
    vvec3 off = vadd(vscale(vspread(c->right), s), vscale(vspread(c->up), t));
    vray ray  = { .origin    = vspread(c->eye),
                  .direction = vspread(c->forward),
                  .reach     = vsplat(INFINITY) };
    if (c->perspective)
        ray.direction = vnormalize(vadd(ray.direction, off));
    else
        ray.origin = vadd(ray.origin, off);
    return ray;
}
