/* sim/map_sensors.c -- see map_parts.h: squares in the air that particles pass through.
 *
 * Each sensor has a square of twice the area asked for, of two triangles (0, 1, 2) and (0, 2, 3);
 * the square asked for lies in its middle.
 */
#include "sim/map_parts.h"

enum { AT_ONCE = 16 }; /* squares that a ray meets */

struct map_watch {
    const world *squares;
};

const map_watch *map_watch_new(arena *a, const map_sensors *m, lux_error *err)
{
    size_t n          = (size_t)m->count;
    map_watch *w      = arena_new(a, map_watch, err);
    arena scratch     = { 0 };
    vec3 *places      = w ? arena_array(&scratch, vec3, 4 * n, err) : NULL;
    uint32_t *corners = places ? arena_array(&scratch, uint32_t, 6 * n, err) : NULL;
    float half        = 0.5f * m->side * sqrtf(2.0f);
    for (uint32_t i = 0; corners && i < n; i++) {
        static const uint32_t around[6] = { 0, 1, 2, 0, 2, 3 };
        vec3 u, v, p = m->at[i];
        v3_frame(m->normal[i], &u, &v);
        for (uint32_t c = 0; c < 4; c++) {
            float s = c == 1 || c == 2 ? half : -half, t = c >= 2 ? half : -half;
            places[4 * i + c] =
                (vec3){ p.x + s * u.x + t * v.x, p.y + s * u.y + t * v.y, p.z + s * u.z + t * v.z };
        }
        for (uint32_t c = 0; c < 6; c++)
            corners[6 * i + c] = 4 * i + around[c];
    }
    if (corners) {
        mesh all            = { .positions      = places,
                                .corners        = corners,
                                .position_count = (uint32_t)(4 * n),
                                .triangle_count = (uint32_t)(2 * n) };
        world_instance once = { .place = TRANSFORM_IDENTITY };
        w->squares          = world_new(a,
                                        &(world_desc){ .meshes         = &all,
                                                       .mesh_count     = 1,
                                                       .instances      = &once,
                                                       .instance_count = 1,
                                                       .threads        = 1 },
                                        err);
    }
    arena_clear(&scratch);
    return corners && w->squares ? w : NULL;
}

static void add(map_list *out, int32_t bin, int32_t group, float dimming, vec3 flux)
{
    map_deposit *to = map_list_add(out);
    if (to)
        *to = (map_deposit){ bin, group, dimming, flux };
}

/* Whether a hit of a large square is in the small one. */
static bool is_inside(int32_t triangle, float u, float v)
{
    const float half = 0.25f * sqrtf(2.0f); /* of the large square's side */
    float s          = triangle & 1 ? u : u + v;
    float t          = triangle & 1 ? u + v : v;
    return fabsf(s - 0.5f) <= half && fabsf(t - 0.5f) <= half;
}

typedef struct passing {
    const vhit *hits;
    const vrgb *flux;
    vint group;
    vfloat dimming;
    int32_t first_bin;
    map_list *out;
} passing;

static void take(const passing *p, int k, int i)
{
    const vhit *hit  = &p->hits[k];
    int32_t triangle = lane(hit->triangle, i);
    int32_t bin      = p->first_bin + 2 * (triangle / 2);
    vec3 flux        = { lane(p->flux->x, i), lane(p->flux->y, i), lane(p->flux->z, i) };
    add(p->out, bin + 1, lane(p->group, i), lane(p->dimming, i), flux);
    if (is_inside(triangle, lane(hit->u, i), lane(hit->v, i)))
        add(p->out, bin, lane(p->group, i), lane(p->dimming, i), flux);
}

/* One lane after the other, so that deposits come in the same order at every width. */
static void take_all(const map_watch *w, const passing *p, const vvec3 *way, vmask active)
{
    int lit[AT_ONCE];
    for (int k = 0; k < AT_ONCE; k++) {
        vsurface at;
        vmask met = active & (p->hits[k].instance >= 0);
        world_surface(w->squares, &p->hits[k], met, &at);
        lit[k] = vbits(met & (vdot(at.normal, *way) < 0.0f));
    }
    for (int i = 0; i < LANES; i++)
        for (int k = 0; k < AT_ONCE; k++)
            if (lit[k] >> i & 1)
                take(p, k, i);
}

void map_watch_pass(const map_watch *w, const vray *ray, vmask active, const vrgb *flux, vint group,
                    vfloat dimming, int32_t first_bin, map_list *out)
{
    vray rest = *ray;
    while (vany(active)) {
        vhit hits[AT_ONCE];
        bool all  = world_every_hit(w->squares, &rest, &active, 1, AT_ONCE, hits);
        passing p = { hits, flux, group, dimming, first_bin, out };
        if (vany(active & (hits[0].instance >= 0)))
            take_all(w, &p, &ray->direction, active);
        if (all)
            return;
        /* Those that have met so many go on from the last */
        const vhit *last = &hits[AT_ONCE - 1];
        active           = active & (last->instance >= 0);
        rest.origin      = valong(rest.origin, rest.direction, vkeep(active, last->distance));
        rest.reach       = rest.reach - vkeep(active, last->distance);
    }
}
