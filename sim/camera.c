/* sim/camera.c -- see camera.h. */
#include "sim/camera.h"

#include "core/packet_math.h"

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
    bool upright  = d3_length(across) < 1e-6; /* up or down: north is up in the picture */
    if (upright)
        across = d3_cross(forward, (dvec3){ 0, 1, 0 });
    if (v->projection == PROJECTION_PANORAMA) { /* its top is the zenith, whatever the target */
        if (upright)
            across = (dvec3){ 1, 0, 0 };
        forward = unit(d3_cross((dvec3){ 0, 0, 1 }, across));
    }
    dvec3 right = unit(across), up = d3_cross(right, forward);

    double half   = v->projection == PROJECTION_PERSPECTIVE ? tan(0.5 * v->fov_deg * (M_PI / 180.0))
                                                            : 0.5 * v->width_m;
    bool flat     = v->projection <= PROJECTION_ORTHOGRAPHIC;
    c->projection = v->projection;
    set(c, s, v->eye, right, up, forward, flat ? half : 1.0,
        flat ? half * c->height / c->width : 1.0);
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
    double aspect = (double)c->width / c->height;
    c->projection = from->perspective ? PROJECTION_PERSPECTIVE : PROJECTION_ORTHOGRAPHIC;
    double half   = from->perspective ? tan(0.5 * from->yfov) : from->ymag;
    set(c, s, transform_point(&from->place, (dvec3){ 0, 0, 0 }), right, up, forward, half * aspect,
        half);
    return true;
}

static int lesser(int a, int b) { return a < b ? a : b; }

static float spread_of(const camera *c)
{
    switch (c->projection) {
    case PROJECTION_PERSPECTIVE:
        return 2.0f * v3_length(c->up) / (float)c->height;
    case PROJECTION_FISHEYE:
        return (float)M_PI / (float)lesser(c->width, c->height);
    case PROJECTION_PANORAMA:
        return (float)M_PI / (float)c->height;
    case PROJECTION_ORTHOGRAPHIC:
        break;
    }
    return 0.0f;
}

bool camera_of_view(const scene *s, const study_view *v, camera *out, lux_error *err)
{
    *out        = (camera){ .width = v->width, .height = v->height };
    bool good   = v->camera ? of_gltf(s, v, out, err) : of_eye_and_target(s, v, out, err);
    out->spread = spread_of(out);
    return good;
}

static vray flat_ray(const camera *c, vfloat x, vfloat y)
{
    vfloat s  = 2.0f / (float)c->width * x - 1.0f;
    vfloat t  = 1.0f - 2.0f / (float)c->height * y;
    vvec3 off = vadd(vscale(vspread(c->right), s), vscale(vspread(c->up), t));
    vray ray  = { .origin    = vspread(c->eye),
                  .direction = vspread(c->forward),
                  .reach     = vsplat(INFINITY) };
    if (c->projection == PROJECTION_PERSPECTIVE)
        ray.direction = vnormalize(vadd(ray.direction, off));
    else
        ray.origin = vadd(ray.origin, off);
    return ray;
}

/* From the middle of the picture, in radii of the fisheye's circle: to the right, and up. */
static void in_circle(const camera *c, vfloat x, vfloat y, vfloat *right, vfloat *up)
{
    float unit = 2.0f / (float)lesser(c->width, c->height);
    *right     = (x - 0.5f * (float)c->width) * unit;
    *up        = (0.5f * (float)c->height - y) * unit;
}

/* Towards across right + over up + on forward. */
static vray round_ray(const camera *c, vfloat across, vfloat over, vfloat on)
{
    vvec3 beside = vadd(vscale(vspread(c->right), across), vscale(vspread(c->up), over));
    return (vray){ .origin    = vspread(c->eye),
                   .direction = vnormalize(vadd(beside, vscale(vspread(c->forward), on))),
                   .reach     = vsplat(INFINITY) };
}

static vray fisheye_ray(const camera *c, vfloat x, vfloat y)
{
    vfloat right, up;
    in_circle(c, x, y, &right, &up);
    vfloat r     = vsqrt(right * right + up * up);
    vfloat angle = (float)(0.5 * M_PI) * r;
    vfloat by    = vselect(r > 0.0f, vsin(angle) / r, vsplat(0.0f));
    return round_ray(c, right * by, up * by, vcos(angle));
}

static vray panorama_ray(const camera *c, vfloat x, vfloat y)
{
    vfloat azimuth = (x / (float)c->width - 0.5f) * (float)(2.0 * M_PI);
    vfloat polar   = y / (float)c->height * (float)M_PI;
    vfloat out     = vsin(polar);
    return round_ray(c, out * vsin(azimuth), vcos(polar), out * vcos(azimuth));
}

vray camera_ray(const camera *c, vfloat x, vfloat y)
{
    if (c->projection == PROJECTION_FISHEYE)
        return fisheye_ray(c, x, y);
    if (c->projection == PROJECTION_PANORAMA)
        return panorama_ray(c, x, y);
    return flat_ray(c, x, y);
}

vmask camera_sees(const camera *c, vfloat x, vfloat y)
{
    if (c->projection != PROJECTION_FISHEYE)
        return ALL_LANES;
    vfloat right, up;
    in_circle(c, x, y, &right, &up);
    return right * right + up * up <= 1.0f;
}
