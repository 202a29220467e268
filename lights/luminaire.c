/* lights/luminaire.c -- a point that shines as a measured luminaire does.
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
#include "core/color.h"
#include "core/packet_math.h"
#include "core/table.h"
#include "core/transform.h"
#include "lights/light.h"
#include "lights/photometry.h"

/* An aim this close to straight up (sine of the angle) is straight up: a scene's matrices are
 * good to about 1e-7, and their rounding must not choose which way the luminaire turns over. */
static const double STRAIGHT_UP = 1e-6;

typedef struct luminaire {
    light base;
    vec3 position;      /* m */
    vec3 c0, c90, axis; /* unit: where C0, C90 and gamma 0 point */
    vec3 scale;         /* W/sr for each candela */
    double lumens;      /* cd sr: the integral of the web */
    vec3 strongest;     /* unit: where the largest candela points */
    float most;         /* cd: the largest */
    const float *candela;
    table_axis axes[2];         /* rad: C, gamma */
    float gamma_from, gamma_to; /* rad: dark outside of them */
    float down_least;           /* cosine of gamma_to, less a rounding: below it all is dark */
} luminaire;

static vmask luminaire_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                              vlight_sample *out)
{
    const luminaire *l = (const luminaire *)self;
    (void)s, (void)t; /* there is but one place to draw */

    vvec3 to     = vsub(vspread(l->position), *p);
    vfloat dist2 = vdot(to, to);
    vfloat dist  = vsqrt(dist2);
    vvec3 wi     = vscale(to, 1.0f / dist);

    /* Where the point lies in the luminaire's frame */
    vfloat x    = -vdot(wi, vspread(l->c0));
    vfloat y    = -vdot(wi, vspread(l->c90));
    vfloat down = -vdot(wi, vspread(l->axis));
    if (!vany(active & (down >= l->down_least))) {
        *out = (vlight_sample){ 0 };
        return (vmask){ 0 };
    }
    vfloat gamma = vatan2(vsqrt(x * x + y * y), down);
    vfloat plane = l->axes[0].count > 1 ? vatan2(y, x) : vsplat(0.0f);

    vfloat cd = vtable_lookup2(l->candela, l->axes, plane, gamma);
    vmask lit =
        active & (dist2 > 0.0f) & (gamma >= l->gamma_from) & (gamma <= l->gamma_to) & (cd > 0.0f);

    out->wi   = vkeep3(lit, wi);
    out->dist = vkeep(lit, dist);
    out->e    = vscale(vspread(l->scale), vkeep(lit, cd / dist2));
    out->pdf  = vkeep(lit, vsplat(INFINITY));
    return lit;
}

static vec3 luminaire_flux(const light *self)
{
    const luminaire *l = (const luminaire *)self;
    return v3_scale(l->scale, (float)l->lumens);
}

static vec3 luminaire_peak(const light *self, vec3 *toward)
{
    const luminaire *l = (const luminaire *)self;
    *toward            = l->strongest;
    return v3_scale(l->scale, l->most);
}

static light_bounds luminaire_bounds(const light *self)
{
    const luminaire *l = (const luminaire *)self;
    return (light_bounds){ .low        = l->position,
                           .high       = l->position,
                           .axis       = l->axis,
                           .cos_spread = 1.0f,
                           .cos_reach  = l->down_least > -1.0f ? l->down_least : -1.0f,
                           .peak       = rgb_luminance(l->scale) * l->most };
}

static const light_type luminaire_type = { .name   = "luminaire",
                                           .sample = luminaire_sample,
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

static void make_frame(luminaire *l, vec3 aim, float rotate)
{
    dvec3 a   = d3_from(aim);
    double r  = (double)rotate;
    a         = d3_scale(a, 1.0 / d3_length(a));
    dvec3 c0  = { cos(r), sin(r), 0.0 };
    dvec3 c90 = { -sin(r), cos(r), 0.0 };
    bool up   = a.z > 0.0 && hypot(a.x, a.y) < STRAIGHT_UP;

    l->c0   = d3_to_float(up ? c0 : turn_from_down(c0, a));
    l->c90  = d3_to_float(up ? d3_scale(c90, -1.0) : turn_from_down(c90, a));
    l->axis = d3_to_float(a);
}

/* A copy of angles in rad. */
static const float *radians(arena *a, const float *deg, int count, lux_error *err)
{
    float *rad = arena_array(a, float, (size_t)count, err);
    for (int i = 0; rad && i < count; i++)
        rad[i] = (float)((double)deg[i] * (M_PI / 180.0));
    return rad;
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
    l->down_least = (float)cos(fmin((double)l->gamma_to, M_PI)) - 1e-5f;
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

const light *light_luminaire(arena *a, const luminaire_desc *d, lux_error *err)
{
    float length = v3_length(d->aim);
    if (!(length > 0.0f && length < INFINITY))
        return failed(err, ERR_ARGUMENT, "luminaire: the aim has no length");
    if (!isfinite(d->rotate))
        return failed(err, ERR_ARGUMENT, "luminaire: rotate is not finite");
    if (!v3_nonnegative(d->scale))
        return failed(err, ERR_ARGUMENT, "luminaire: a scale is not >= 0 W/sr for each candela");
    if (!check_web(d->web, err))
        return NULL;

    luminaire *l = arena_new(a, luminaire, err);
    if (!l || !make_table(l, d->web, a, err))
        return NULL;
    l->base     = (light){ &luminaire_type };
    l->position = d->position;
    l->scale    = d->scale;
    l->lumens   = d->web->luminaire_lumens;
    make_frame(l, d->aim, d->rotate);
    find_strongest(l, d->web);
    return &l->base;
}
