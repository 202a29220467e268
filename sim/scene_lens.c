/* sim/scene_lens.c -- which solids of glass are plates, which light passes about straight, and
 * which bend it: lenses, balls, blocks.
 *
 * Rays from all around meet the solids of a scene; where one does, the solid's far side is looked
 * for. A plate's is near and even with this one, and its edges are far. Small ones that few rays
 * meet are looked at by some of their own triangles.
 */
#include "core/color.h"
#include "core/sampler.h"
#include "core/warp.h"
#include "sim/scene_build.h"

enum { RAYS = 1 << 12, FEW = 16, MOST_LOOKS = 64 /* at a material's triangles */ };

static const float even_normals = 0.999f; /* cosine */
static const float flat         = 5.0f;   /* times as wide as thick */
static const double plate_share = 0.8;    /* of what is met */

typedef struct finding {
    int met, plate;
    bool small;                /* few rays met it */
    int32_t triangles, passed; /* then: how many it has, and were passed by */
} finding;

static vray ray_through(const scene *s, vsample4 u, vsample4 v)
{
    dvec3 half   = d3_scale(d3_sub(s->high, s->low), 0.5);
    dvec3 middle = d3_sub(d3_scale(d3_add(s->high, s->low), 0.5), s->centre);
    float radius = (float)d3_length(half);
    vvec3 way    = vwarp_sphere(u.x, u.y);
    vvec3 within = vspread(d3_to_float(half));
    vvec3 at     = { 2.0f * v.x - 1.0f, 2.0f * v.y - 1.0f, 2.0f * v.z - 1.0f };
    at           = vadd(vspread(d3_to_float(middle)), vmul(at, within));
    return (vray){ valong(at, way, vsplat(-2.0f * radius)), way, vsplat(INFINITY) };
}

/* How far the solid's surface is from p along w. */
static vfloat inside_to(const scene *s, const vvec3 *p, const vvec3 *w, vmask active, vvec3 *normal)
{
    vray ray = { *p, *w, vsplat(INFINITY) };
    vhit hit;
    vsurface there;
    world_first_hit(s->world, &ray, &active, 1, RAYS_INCOHERENT, &hit);
    world_surface(s->world, &hit, active & (hit.instance >= 0), &there);
    *normal = there.normal;
    return hit.distance;
}

static vmask is_plate(const scene *s, const vsurface *at, vmask met)
{
    vvec3 in    = vneg(at->normal), back, ignored;
    vvec3 start = vray_start(at, &in);
    vfloat deep = inside_to(s, &start, &in, met, &back);
    vmask plate = met & (deep < INFINITY) & (vabs(vdot(back, at->normal)) > even_normals);
    vvec3 mid   = valong(start, in, 0.5f * deep);
    vvec3 u, v;
    vframe(at->normal, &u, &v);
    vvec3 sides[4] = { u, v, vneg(u), vneg(v) };
    vint far       = { 0 };
    for (int i = 0; i < 4 && vany(plate); i++) {
        vfloat d = inside_to(s, &mid, &sides[i], plate, &ignored);
        far      = vselect_int(d > flat * deep, far + 1, far);
    }
    return plate & (far >= 3);
}

static void look(const scene *s, uint32_t first, finding *of)
{
    vuint index = vunsigned(vlane_index()) + first;
    vsample4 u = vsobol4(index, vsplat_uint(1)), v = vsobol4(index, vsplat_uint(2));
    vray ray     = ray_through(s, u, v);
    vmask active = ALL_LANES;
    for (int layer = 0; layer < 4 && vany(active); layer++) {
        vhit hit;
        vsurface at;
        world_first_hit(s->world, &ray, &active, 1, RAYS_INCOHERENT, &hit);
        vmask met = active & (hit.instance >= 0);
        world_surface(s->world, &hit, met, &at);
        vint does   = vgather_int(s->material_does, vkeep_int(met, at.material));
        vmask solid = met & ((does & DOES_SOLID) != 0) & (vdot(at.normal, ray.direction) < 0.0f);
        vmask plate = vany(solid) ? is_plate(s, &at, solid) : solid;
        for (int bits = vbits(solid); bits; bits &= bits - 1) {
            int i = __builtin_ctz((unsigned)bits);
            of[lane(at.material, i)].met++;
            of[lane(at.material, i)].plate += vbits(plate) >> i & 1;
        }
        ray.origin = vray_start(&at, &ray.direction);
        active     = met;
    }
}

/* Triangles that wait until there is a packet of them. */
typedef struct waiting {
    int32_t instance[LANES], triangle[LANES];
    int count;
} waiting;

/* From the middles of triangles. */
static void look_at(const scene *s, waiting *w, finding *of)
{
    for (; w->count % LANES != 0; w->count++)
        w->instance[w->count] = -1;
    vfloat third = vsplat(1.0f / 3.0f);
    vhit hit     = { third, vload_int(w->instance), vload_int(w->triangle), third, third };
    vmask some   = hit.instance >= 0;
    vsurface at;
    world_surface(s->world, &hit, some, &at);
    vmask plate = is_plate(s, &at, some);
    for (int bits = vbits(some); bits; bits &= bits - 1) {
        int i = __builtin_ctz((unsigned)bits);
        of[lane(at.material, i)].met++;
        of[lane(at.material, i)].plate += vbits(plate) >> i & 1;
    }
    w->count = 0;
}

/* Counts the triangles of solids that few rays met; then looks at some of each. */
static void look_at_small_ones(const scene *s, finding *of)
{
    waiting w = { 0 };
    for (int pass = 0; pass < 2; pass++)
        for (int32_t i = 0; i < world_instances(s->world); i++)
            for (int32_t t = 0; t < world_triangles(s->world, i); t++) {
                dvec3 corner[3];
                finding *f = &of[world_triangle(s->world, i, t, corner)];
                if (!f->small)
                    continue;
                if (pass == 0) {
                    f->triangles++;
                } else if (f->passed++ % (f->triangles / MOST_LOOKS + 1) == 0) {
                    w.instance[w.count]   = i;
                    w.triangle[w.count++] = t;
                }
                if (w.count == LANES)
                    look_at(s, &w, of);
            }
    if (w.count > 0)
        look_at(s, &w, of);
}

bool scene_find_lenses(scene *s, int32_t *does, lux_error *err)
{
    if (!s->solids)
        return true;
    arena a     = { 0 };
    finding *of = arena_array(&a, finding, (size_t)s->material_count + 1, err);
    bool small  = false;
    for (uint32_t i = 0; of && i < RAYS; i += LANES)
        look(s, i, of);
    for (int m = 0; of && m < s->material_count; m++) {
        of[m].small = s->materials[m]->solid && of[m].met < FEW;
        small |= of[m].small;
    }
    if (small)
        look_at_small_ones(s, of);
    for (int m = 0; of && m < s->material_count; m++)
        if (s->materials[m]->solid && of[m].met > 0 && of[m].plate < plate_share * of[m].met) {
            does[m] |= DOES_LENS;
            s->lenses = true;
        }
    arena_clear(&a);
    return of != NULL;
}
