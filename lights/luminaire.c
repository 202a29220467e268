/* lights/luminaire.c -- a lamp that shines as a measured luminaire does: from a point.
 *
 * Those that have a luminous opening shine from it: luminaire_area.c. From a point,
 *
 *     E = s I(C, gamma) / d^2        [W/m^2]
 *
 * with I in cd by the web of photometry.h and s in W/sr for each candela. The direction w from
 * the luminaire to the point, along the axes X (C0), Y (C90) and -Z (gamma 0) of its frame, is
 *
 *     gamma = atan2(sqrt(x^2 + y^2), -z),    C = atan2(y, x)
 *
 * which unlike the arc cosine of z is accurate near the axis, where a web is steepest.
 *
 * The frame: C0 = (cos r, sin r, 0) and C90 = (-sin r, cos r, 0) after `rotate` by r, both then
 * turned with the axis from straight down to the aim a, by the shortest way (Rodrigues' formula):
 *
 *     v + n x v + n x (n x v) / (1 + c),    n = down x a,  c = down . a = -a_z
 *
 * and for an aim straight up, which has no shortest way, by half a turn about C0.
 */
#include "lights/luminaire.h"

#include "core/color.h"
#include "core/transform.h"

/* An aim this close to straight up (sine of the angle) is straight up: a scene's matrices are
 * good to about 1e-7, and their rounding must not choose which way the luminaire turns over. */
static const double STRAIGHT_UP = 1e-6;

static vmask point_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                          vlight_sample *out)
{
    const luminaire *l = (const luminaire *)self;
    (void)s, (void)t; /* there is but one place to draw */

    vvec3 to     = vsub(vspread(l->position), *p);
    vfloat dist2 = vdot(to, to);
    vfloat dist  = vsqrt(dist2);
    vvec3 wi     = vscale(to, 1.0f / dist);

    vfloat cd = { 0 };
    vmask lit = vluminaire_candela(l, wi, active & (dist2 > 0.0f), &cd);

    out->wi   = vkeep3(lit, wi);
    out->dist = vkeep(lit, dist);
    out->e    = vscale(vspread(l->scale), vkeep(lit, cd / dist2));
    out->pdf  = vkeep(lit, vsplat(INFINITY));
    return lit;
}

vec3 luminaire_flux(const light *self)
{
    const luminaire *l = (const luminaire *)self;
    return v3_scale(l->scale, (float)l->model->lumens);
}

vec3 luminaire_peak(const light *self, vec3 *toward)
{
    const luminaire *l = (const luminaire *)self;
    dvec3 along        = d3_from(l->model->strongest);
    dvec3 across = d3_add(d3_scale(d3_from(l->c0), along.x), d3_scale(d3_from(l->c90), along.y));
    *toward      = d3_to_float(d3_add(across, d3_scale(d3_from(l->axis), along.z)));
    return v3_scale(l->scale, l->model->most);
}

/* Of the cones about the axis and about its opposite that hold all light, the narrower. */
light_bounds luminaire_bounds(const light *self)
{
    const luminaire *l       = (const luminaire *)self;
    const luminaire_model *m = l->model;
    bool down                = m->down_least >= -m->down_most;
    vec3 far                 = l->reach;
    vec3 at                  = l->position;
    return (light_bounds){ .low        = { at.x - far.x, at.y - far.y, at.z - far.z },
                           .high       = { at.x + far.x, at.y + far.y, at.z + far.z },
                           .axis       = down ? l->axis : v3_scale(l->axis, -1.0f),
                           .cos_spread = 1.0f,
                           .cos_reach  = fmaxf(down ? m->down_least : -m->down_most, -1.0f),
                           .peak       = rgb_luminance(l->scale) * m->most };
}

static const light_type luminaire_point_type = { .name   = "luminaire",
                                                 .sample = point_sample,
                                                 .emit   = luminaire_emit,
                                                 .flux   = luminaire_flux,
                                                 .peak   = luminaire_peak,
                                                 .bounds = luminaire_bounds };

/* ---- making one ------------------------------------------------------------------------- */

/* v turned by the shortest turn that takes straight down to the unit vector a, not straight up. */
static dvec3 turn_from_down(dvec3 v, dvec3 a)
{
    double across = a.x * a.x + a.y * a.y;
    double over   = a.z < 0.0 ? 1.0 / (1.0 - a.z) : (1.0 + a.z) / across; /* 1 / (1 + c) */
    dvec3 n       = { a.y, -a.x, 0.0 };
    dvec3 nv      = d3_cross(n, v);
    dvec3 nnv     = d3_cross(n, nv);
    return d3_add(d3_add(v, nv), d3_scale(nnv, over));
}

static void make_frame(luminaire *l, const luminaire_desc *d)
{
    dvec3 a = d3_from(d->aim);
    a       = d3_scale(a, 1.0 / d3_length(a));
    l->axis = d3_to_float(a);
    if (v3_length(d->c0) > 0.0f) {
        dvec3 c0 = d3_from(d->c0);
        c0       = d3_sub(c0, d3_scale(a, d3_dot(c0, a)));
        c0       = d3_scale(c0, 1.0 / d3_length(c0));
        l->c0    = d3_to_float(c0);
        l->c90   = d3_to_float(d3_cross(c0, a));
        return;
    }
    double r  = (double)d->rotate;
    dvec3 c0  = { cos(r), sin(r), 0.0 };
    dvec3 c90 = { -sin(r), cos(r), 0.0 };
    bool up   = a.z > 0.0 && hypot(a.x, a.y) < STRAIGHT_UP;
    l->c0     = d3_to_float(up ? c0 : turn_from_down(c0, a));
    l->c90    = d3_to_float(up ? d3_scale(c90, -1.0) : turn_from_down(c90, a));
}

/* Places the opening: its own axes and the box around it, as the world has them. */
static void make_opening(luminaire *l, const photometry *web)
{
    double along = (double)web->length_along_deg * (M_PI / 180.0);
    dvec3 c0 = d3_from(l->c0), c90 = d3_from(l->c90);
    dvec3 length  = d3_add(d3_scale(c0, cos(along)), d3_scale(c90, sin(along)));
    dvec3 width   = d3_add(d3_scale(c0, -sin(along)), d3_scale(c90, cos(along)));
    vec3 axes[3]  = { d3_to_float(length), d3_to_float(width), l->axis };
    float half[3] = { l->opening.half.x, l->opening.half.y, l->opening.half.z };
    for (int i = 0; i < 3; i++) {
        vec3 e = l->own[i] = axes[l->opening.axis[i]];
        l->reach.x += fabsf(e.x) * half[i];
        l->reach.y += fabsf(e.y) * half[i];
        l->reach.z += fabsf(e.z) * half[i];
    }
}

static bool check_sizes(const photometry *web, lux_error *err)
{
    const float most    = 1e6f; /* m, whose fourth power is still a float */
    const float sizes[] = { web->length, web->width, web->height };
    for (int i = 0; i < 3; i++)
        if (!(sizes[i] >= 0.0f && sizes[i] <= most))
            return failed(err, ERR_ARGUMENT,
                          "luminaire: a luminous opening of %g m, 0 to %g m was expected",
                          (double)sizes[i], (double)most);
    return isfinite(web->length_along_deg) ||
           failed(err, ERR_ARGUMENT, "luminaire: the opening's length lies along no C plane");
}

static bool check(const luminaire_desc *d, lux_error *err)
{
    float length = v3_length(d->aim), c0 = v3_length(d->c0);
    if (!(length > 0.0f && length < INFINITY))
        return failed(err, ERR_ARGUMENT, "luminaire: the aim has no length");
    if (!(v3_length(v3_cross(d->aim, d->c0)) > 1e-6f * length * c0 || c0 == 0.0f))
        return failed(err, ERR_ARGUMENT, "luminaire: C0 points where the aim does");
    if (!isfinite(d->rotate))
        return failed(err, ERR_ARGUMENT, "luminaire: rotate is not finite");
    if (!v3_nonnegative(d->scale))
        return failed(err, ERR_ARGUMENT, "luminaire: a scale is not >= 0 W/sr for each candela");
    if (!d->web)
        return failed(err, ERR_ARGUMENT, "luminaire: there is no photometric web");
    return d->point || check_sizes(d->web, err);
}

const light *light_luminaire(arena *a, const luminaire_desc *d, lux_error *err)
{
    if (!check(d, err))
        return NULL;
    const luminaire_model *m = d->model ? d->model : luminaire_model_new(a, d->web, err);
    luminaire *l             = m ? arena_new(a, luminaire, err) : NULL;
    if (!l)
        return NULL;
    l->model    = m;
    l->position = d->position;
    l->scale    = d->scale;
    make_frame(l, d);

    l->base = (light){ &luminaire_point_type };
    if (!d->point)
        l->opening = opening_of(d->web);
    if (!l->opening.type)
        return &l->base;
    l->base = (light){ l->opening.type->meet ? &luminaire_area_type : &luminaire_line_type };
    make_opening(l, d->web);
    return &l->base;
}
