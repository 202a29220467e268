/* lights/luminaire_emit.c -- light as it leaves a luminaire: a direction by the web's intensity,
 * then a place of the opening that is even over what is seen against it (opening.h).
 *
 * A cell of the web lies between two planes C and two angles gamma, these a few degrees apart at
 * most. In it the density is bilinear in C and h = 1 - cos(gamma), counted from the nearer pole so
 * that no digit is lost there, between intensities at the corners c00 ... c11:
 *
 *     pdf = P(ring) P(plane | ring) b(x, y) / (mean of b  dC dh)        [1/sr]
 *
 * Along C that is what the web itself is; along gamma it differs by what bends between the edges,
 * and is made up for in the weight, I / pdf. Where there is light some corner has some, and so
 * there is a density.
 */
#include "lights/luminaire.h"

#include "core/distribution.h"

#include <math.h>

static const double STEP_DEG = 2.5; /* at most, from ring to ring */

/* ---- drawing -------------------------------------------------------------------------------- */

/* In [0, 1], with a density that is linear from a to b; of an even u. */
static vfloat draw_linear(vfloat u, vfloat a, vfloat b)
{
    vfloat root = vsqrt((1.0f - u) * (a * a) + u * (b * b));
    return vmin(u * (a + b) / (a + root), vsplat(1.0f));
}

typedef struct vweb_ray {
    vvec3 w;    /* unit, along C0, C90 and gamma 0 */
    vfloat pdf; /* 1/sr */
} vweb_ray;

static vweb_ray draw_direction(const web_cells *c, vfloat u, vfloat v)
{
    vfloat x, y, of_ring, of_plane;
    vint ring  = vdistribution_draw(c->ring_cdf, vsplat_int(0), c->rings, v, &y, &of_ring);
    vint first = ring * (c->planes + 1);
    vint plane = vdistribution_draw(c->plane_cdf, first, c->planes, u, &x, &of_plane);

    /* In the cell, first from ring to ring, then along its strip */
    vint at    = first + plane;
    vint next  = at + (c->planes + 1);
    vfloat c00 = vgather(c->candela, at), c10 = vgather(c->candela, at + 1);
    vfloat c01 = vgather(c->candela, next), c11 = vgather(c->candela, next + 1);
    y           = draw_linear(y, c00 + c10, c01 + c11);
    vfloat from = vlerp(c00, c01, y), to = vlerp(c10, c11, y);
    x           = draw_linear(x, from, to);
    vfloat here = vlerp(from, to, x), mean = 0.25f * ((c00 + c10) + (c01 + c11));

    vfloat wide  = vgather(c->wide, ring);
    vfloat begin = vgather(c->plane, plane);
    vfloat turn  = vgather(c->plane, plane + 1) - begin;
    vfloat h     = vgather(c->low, ring) + y * wide;
    vfloat phi   = begin + x * turn;
    vfloat r     = vsqrt(vmax(h * (2.0f - h), vsplat(0.0f)));
    vmask down   = vgather_int(c->down, ring) != 0;
    return (vweb_ray){ { r * vcos(phi), r * vsin(phi), vselect(down, 1.0f - h, h - 1.0f) },
                       of_ring * of_plane * (here / (mean * turn * vabs(wide))) };
}

/* The place, from the centre. */
static vvec3 leave(const luminaire *l, vvec3 w, vfloat s, vfloat t)
{
    vvec3 own[3] = { vspread(l->own[0]), vspread(l->own[1]), vspread(l->own[2]) };
    vvec3 side   = { vdot(w, own[0]), vdot(w, own[1]), vdot(w, own[2]) };
    vvec3 size   = { vabs(side.x), vabs(side.y), vabs(side.z) };
    vvec3 place  = l->opening.type->leave(&l->opening, &size, s, t);
    return vadd(vscale(own[0], vcopysign(vsplat(1.0f), side.x) * place.x),
                vadd(vscale(own[1], vcopysign(vsplat(1.0f), side.y) * place.y),
                     vscale(own[2], vcopysign(vsplat(1.0f), side.z) * place.z)));
}

vmask luminaire_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                     vfloat v, vmask active, vlight_ray *out)
{
    const luminaire *l = (const luminaire *)self;
    (void)to;
    vweb_ray ray = draw_direction(&l->model->cells, vkeep(active, u), vkeep(active, v));
    vvec3 way    = vadd(vscale(vspread(l->c0), ray.w.x),
                        vadd(vscale(vspread(l->c90), ray.w.y), vscale(vspread(l->axis), ray.w.z)));
    vfloat cd    = { 0 };
    vmask lit    = vluminaire_candela(l, vneg(way), active & (ray.pdf > 0.0f), &cd);
    vvec3 origin = vspread(l->position);
    if (l->opening.type)
        origin = vadd(origin, leave(l, way, s, t));

    out->origin    = vkeep3(lit, origin);
    out->direction = vkeep3(lit, way);
    out->flux      = vscale(vspread(l->scale), vkeep(lit, cd / ray.pdf));
    return lit;
}

/* ---- making --------------------------------------------------------------------------------- */

/* How many rings a step of the web is cut into. */
static int rings_within(const photometry *web, int ring)
{
    double step = (double)(web->gamma_deg[ring + 1] - web->gamma_deg[ring]);
    return (int)ceil(fmax(step / STEP_DEG, 1.0));
}

/* A web of one angle gamma is light on a cone without width: it has no flux, and one dark ring. */
static int count_rings(const photometry *web)
{
    int count = 0;
    for (int i = 0; i + 1 < web->gamma_count; i++)
        count += rings_within(web, i);
    return count > 0 ? count : 1;
}

typedef struct web_work {
    const photometry *web;
    web_cells *cells;
    float *plane, *low, *wide, *candela, *ring_cdf, *plane_cdf;
    int32_t *down;
    double *of_rings, *of_planes; /* their weights */
} web_work;

static bool find_room(arena *a, arena *scratch, web_work *w, lux_error *err)
{
    const size_t planes = (size_t)w->cells->planes, rings = (size_t)w->cells->rings;
    return (w->plane = arena_array(a, float, planes + 1, err)) &&
           (w->low = arena_array(a, float, rings, err)) &&
           (w->wide = arena_array(a, float, rings, err)) &&
           (w->down = arena_array(a, int32_t, rings, err)) &&
           (w->candela = arena_array(a, float, (rings + 1) * (planes + 1), err)) &&
           (w->ring_cdf = arena_array(a, float, rings + 1, err)) &&
           (w->plane_cdf = arena_array(a, float, rings *(planes + 1), err)) &&
           (w->of_rings = arena_array(scratch, double, rings, err)) &&
           (w->of_planes = arena_array(scratch, double, planes, err));
}

/* The intensities along edge number `edge`, `share` of the way from ring `ring` to the next. */
static void fill_edge(web_work *w, int edge, int ring, double share)
{
    const photometry *web = w->web;
    const int planes      = w->cells->planes;
    float *to             = w->candela + (size_t)edge * (size_t)(planes + 1);
    for (int i = 0; i <= planes; i++) {
        const float *from = web->candela + (size_t)(i % planes) * (size_t)web->gamma_count;
        int next          = ring + 1 < web->gamma_count ? ring + 1 : ring;
        to[i] = (float)((1.0 - share) * (double)from[ring] + share * (double)from[next]);
    }
}

static double less_than_pole(double gamma, bool down)
{
    double half = sin(0.5 * (down ? gamma : M_PI - gamma));
    return 2.0 * half * half;
}

/* Ring number k, between the angles from and to. */
static void fill_ring(web_work *w, int k, double from, double to)
{
    const int planes   = w->cells->planes;
    const float *upper = w->candela + (size_t)k * (size_t)(planes + 1);
    const float *lower = upper + planes + 1;
    bool down          = from + to < M_PI;
    double low         = less_than_pole(from, down);
    double wide        = less_than_pole(to, down) - low;
    w->down[k]         = down;
    w->low[k]          = (float)low;
    w->wide[k]         = (float)wide;
    for (int i = 0; i < planes; i++) {
        double sum =
            (double)upper[i] + (double)upper[i + 1] + (double)lower[i] + (double)lower[i + 1];
        w->of_planes[i] = sum * (double)(w->plane[i + 1] - w->plane[i]);
    }
    w->of_rings[k] = fabs(wide) * distribution_make(w->plane_cdf + (size_t)k * (size_t)(planes + 1),
                                                    w->of_planes, planes);
}

static void fill(web_work *w)
{
    const photometry *web = w->web;
    const int planes      = w->cells->planes;
    const double rad      = M_PI / 180.0;
    for (int i = 0; i < planes; i++)
        w->plane[i] = (float)((double)web->plane_deg[i] * rad);
    w->plane[planes] = (float)((double)web->plane_deg[0] * rad + 2.0 * M_PI);

    int k = 0;
    fill_edge(w, 0, 0, 0.0);
    for (int i = 0; i + 1 < web->gamma_count; i++) {
        const int n  = rings_within(web, i);
        double begin = (double)web->gamma_deg[i] * rad;
        double step  = (double)web->gamma_deg[i + 1] * rad - begin;
        for (int j = 0; j < n; j++, k++) {
            fill_edge(w, k + 1, i, (j + 1.0) / n);
            fill_ring(w, k, begin + step * j / n, begin + step * (j + 1.0) / n);
        }
    }
    distribution_make(w->ring_cdf, w->of_rings, w->cells->rings);
}

bool luminaire_cells_make(arena *a, const photometry *web, web_cells *to, lux_error *err)
{
    arena scratch = { 0 };
    to->planes    = web->plane_count;
    to->rings     = count_rings(web);
    web_work w    = { .web = web, .cells = to };
    bool good     = find_room(a, &scratch, &w, err);
    if (good)
        fill(&w);
    to->plane     = w.plane;
    to->low       = w.low;
    to->wide      = w.wide;
    to->down      = w.down;
    to->candela   = w.candela;
    to->ring_cdf  = w.ring_cdf;
    to->plane_cdf = w.plane_cdf;
    arena_clear(&scratch);
    return good;
}
