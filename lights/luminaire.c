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
    return v3_scale(l->scale, (float)l->lumens);
}

vec3 luminaire_peak(const light *self, vec3 *toward)
{
    const luminaire *l = (const luminaire *)self;
    *toward            = l->strongest;
    return v3_scale(l->scale, l->most);
}

/* Of the cones about the axis and about its opposite that hold all light, the narrower. */
light_bounds luminaire_bounds(const light *self)
{
    const luminaire *l = (const luminaire *)self;
    bool down          = l->down_least >= -l->down_most;
    vec3 far           = l->reach;
    vec3 at            = l->position;
    return (light_bounds){ .low        = { at.x - far.x, at.y - far.y, at.z - far.z },
                           .high       = { at.x + far.x, at.y + far.y, at.z + far.z },
                           .axis       = down ? l->axis : v3_scale(l->axis, -1.0f),
                           .cos_spread = 1.0f,
                           .cos_reach  = fmaxf(down ? l->down_least : -l->down_most, -1.0f),
                           .peak       = rgb_luminance(l->scale) * l->most };
}

static const light_type luminaire_point_type = { .name   = "luminaire",
                                                 .sample = point_sample,
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

/* A copy of angles in rad. */
static const float *radians(arena *a, const float *deg, int count, lux_error *err)
{
    float *rad = arena_array(a, float, (size_t)count, err);
    for (int i = 0; rad && i < count; i++)
        rad[i] = (float)((double)deg[i] * (M_PI / 180.0));
    return rad;
}

static bool ring_is_dark(const photometry *web, int ring)
{
    for (int i = 0; i < web->plane_count; i++)
        if (web->candela[i * web->gamma_count + ring] > 0.0f)
            return false;
    return true;
}

/* The angles gamma between which there is light, less a rounding of their cosines. */
static void find_cone(luminaire *l, const photometry *web)
{
    int first = 0, last = web->gamma_count - 1;
    while (first < last && ring_is_dark(web, first + 1))
        first++;
    while (last > 0 && ring_is_dark(web, last - 1))
        last--;
    if (!ring_is_dark(web, 0))
        first = 0;
    if (!ring_is_dark(web, web->gamma_count - 1))
        last = web->gamma_count - 1;
    l->down_least = (float)cos((double)web->gamma_deg[last] * (M_PI / 180.0)) - 1e-5f;
    l->down_most  = (float)cos((double)web->gamma_deg[first] * (M_PI / 180.0)) + 1e-5f;
}

/* The web as tables have it. From straight down to straight up no rounding of gamma is dark. */
static bool make_table(luminaire *l, const photometry *web, arena *a, lux_error *err)
{
    const float *plane = radians(a, web->plane_deg, web->plane_count, err);
    const float *gamma = plane ? radians(a, web->gamma_deg, web->gamma_count, err) : NULL;
    if (!gamma)
        return false;
    l->candela = web->candela;
    l->axes[0] = (table_axis){ plane, web->plane_count, true, (float)(2.0 * M_PI) };
    l->axes[1] = (table_axis){ gamma, web->gamma_count };
    for (int i = 0; i < 2; i++)
        l->axes[i].density = table_axis_density(&l->axes[i]);
    l->gamma_from = gamma[0];
    l->gamma_to   = gamma[web->gamma_count - 1];
    if (web->gamma_deg[0] <= 0.0f)
        l->gamma_from = -1.0f;
    if (web->gamma_deg[web->gamma_count - 1] >= 180.0f)
        l->gamma_to = 4.0f;
    find_cone(l, web);
    return true;
}

static void find_strongest(luminaire *l, const photometry *web)
{
    int at = 0;
    for (int i = 1; i < web->plane_count * web->gamma_count; i++)
        if (web->candela[i] > web->candela[at])
            at = i;
    double plane = (double)web->plane_deg[at / web->gamma_count] * (M_PI / 180.0);
    double gamma = (double)web->gamma_deg[at % web->gamma_count] * (M_PI / 180.0);
    dvec3 across =
        d3_add(d3_scale(d3_from(l->c0), cos(plane)), d3_scale(d3_from(l->c90), sin(plane)));
    l->most = web->candela[at];
    l->strongest =
        d3_to_float(d3_add(d3_scale(across, sin(gamma)), d3_scale(d3_from(l->axis), cos(gamma))));
}

/* What a web made by a program may lack. */
static bool check_web(const photometry *web, lux_error *err)
{
    if (!web || web->plane_count < 1 || web->gamma_count < 1)
        return failed(err, ERR_ARGUMENT, "luminaire: there is no photometric web");
    const table_axis plane = { web->plane_deg, web->plane_count, true, 360.0f };
    const table_axis gamma = { web->gamma_deg, web->gamma_count, false, 0.0f };
    return table_axis_check(&plane, "luminaire: C planes", err) &&
           table_axis_check(&gamma, "luminaire: angles gamma", err);
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
    return check_web(d->web, err) && (d->point || check_sizes(d->web, err));
}

const light *light_luminaire(arena *a, const luminaire_desc *d, lux_error *err)
{
    if (!check(d, err))
        return NULL;
    luminaire *l = arena_new(a, luminaire, err);
    if (!l || !make_table(l, d->web, a, err))
        return NULL;
    l->position = d->position;
    l->scale    = d->scale;
    l->lumens   = d->web->luminaire_lumens;
    make_frame(l, d);
    find_strongest(l, d->web);

    l->base = (light){ &luminaire_point_type };
    if (!d->point)
        l->opening = opening_of(d->web);
    if (!l->opening.type)
        return &l->base;
    l->base = (light){ l->opening.type->meet ? &luminaire_area_type : &luminaire_line_type };
    make_opening(l, d->web);
    return luminaire_make_error(l, d->web, a, err) ? &l->base : NULL;
}
