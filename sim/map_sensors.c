/* sim/map_sensors.c -- see map_parts.h: squares in the air that particles pass through.
 *
 * Each sensor has a square of twice the area asked for, of two triangles (0, 1, 2) and (0, 2, 3);
 * the square asked for lies in its middle. Cylinders have two, that face along x and y: light of
 * direction w passes a share |w_x| and |w_y| of their areas, and of each counts by
 *
 *     response(w) |w_k| / (w_x^2 + w_y^2)        which together make response(w)
 */
#include "sim/map_parts.h"
#include "sim/sensor.h"

enum { AT_ONCE = 16 }; /* squares that a ray meets */

struct map_watch {
    const world *squares;
    const map_sensors *of;
};

/* Squares of a sensor. */
static uint32_t squares_each(const map_sensors *m)
{
    return quantity_is_round(m->quantity) ? 2 : 1;
}

static vec3 facing(const map_sensors *m, uint32_t square)
{
    if (squares_each(m) == 1)
        return m->normal[square];
    return square & 1 ? (vec3){ 0, 1, 0 } : (vec3){ 1, 0, 0 };
}

/* A little before the sensor: light that ends on a surface in which it lies has passed there. */
static vec3 lifted(const map_sensors *m, uint32_t sensor)
{
    vec3 p = m->at[sensor];
    if (squares_each(m) > 1)
        return p;
    float off = 1e-3f * map_sensor_side(m, (int)sensor) +
                0x1p-17f * fmaxf(fabsf(p.x), fmaxf(fabsf(p.y), fabsf(p.z)));
    vec3 n = v3_scale(m->normal[sensor], off);
    return (vec3){ p.x + n.x, p.y + n.y, p.z + n.z };
}

const map_watch *map_watch_new(arena *a, const map_sensors *m, map_widths wide, lux_error *err)
{
    uint32_t each     = squares_each(m);
    size_t n          = each * (size_t)m->count;
    map_watch *w      = arena_new(a, map_watch, err);
    arena scratch     = { 0 };
    vec3 *places      = w ? arena_array(&scratch, vec3, 4 * n, err) : NULL;
    uint32_t *corners = places ? arena_array(&scratch, uint32_t, 6 * n, err) : NULL;
    for (uint32_t i = 0; corners && i < n; i++) {
        static const uint32_t around[6] = { 0, 1, 2, 0, 2, 3 };
        vec3 u, v, p = lifted(m, i / each), normal = facing(m, i);
        v3_frame(normal, &u, &v);
        float side = fmaxf(wide.times * map_sensor_side(m, (int)(i / each)), wide.least * m->side);
        float half = 0.5f * side * sqrtf(2.0f);
        for (uint32_t c = 0; c < 4; c++) {
            float s = c == 1 || c == 2 ? half : -half, t = c >= 2 ? half : -half;
            places[4 * i + c] =
                (vec3){ p.x + s * u.x + t * v.x, p.y + s * u.y + t * v.y, p.z + s * u.z + t * v.z };
        }
        for (uint32_t c = 0; c < 6; c++)
            corners[6 * i + c] = 4 * i + around[c];
    }
    if (corners) {
        w->of               = m;
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
    const map_watch *watch;
    const vvec3 *way;
    const vhit *hits;
    const vrgb *flux;
    vint group;
    vfloat dimming;
    int32_t first_bin;
    map_list *out;
} passing;

/* By which light that passes a square of a cylinder counts. */
static vfloat weight_of(const map_sensors *m, uint32_t square, const vvec3 *way)
{
    vvec3 wi     = vneg(*way);
    vvec3 n      = vspread(m->normal[square / 2]);
    vfloat level = wi.x * wi.x + wi.y * wi.y;
    vfloat along = vabs(square & 1 ? wi.y : wi.x);
    vfloat share = vsensor_response(m->quantity, &n, &wi) * along / level;
    return vkeep(level > 0.0f, share);
}

static void take(const passing *p, int k, int i)
{
    const map_sensors *m = p->watch->of;
    const vhit *hit      = &p->hits[k];
    int32_t triangle     = lane(hit->triangle, i);
    uint32_t square = (uint32_t)triangle / 2, each = squares_each(m);
    int32_t bin = p->first_bin + 2 * (int32_t)(square / each);
    vrgb all    = *p->flux;
    if (each > 1)
        all = vscale(all, weight_of(m, square, p->way));
    vec3 flux = { lane(all.x, i), lane(all.y, i), lane(all.z, i) };
    add(p->out, bin + 1, lane(p->group, i), lane(p->dimming, i), flux);
    if (is_inside(triangle, lane(hit->u, i), lane(hit->v, i)))
        add(p->out, bin, lane(p->group, i), lane(p->dimming, i), flux);
}

/* One lane after the other, so that deposits come in the same order at every width. */
static void take_all(const passing *p, vmask active)
{
    const map_watch *w = p->watch;
    int lit[AT_ONCE];
    for (int k = 0; k < AT_ONCE; k++) {
        vsurface at;
        vmask met = active & (p->hits[k].instance >= 0);
        world_surface(w->squares, &p->hits[k], met, &at);
        vmask toward = squares_each(w->of) > 1 ? met : vdot(at.normal, *p->way) < 0.0f;
        lit[k]       = vbits(met & toward);
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
        passing p = { w, &ray->direction, hits, flux, group, dimming, first_bin, out };
        if (vany(active & (hits[0].instance >= 0)))
            take_all(&p, active);
        if (all)
            return;
        /* Those that have met so many go on from the last */
        const vhit *last = &hits[AT_ONCE - 1];
        active           = active & (last->instance >= 0);
        rest.origin      = valong(rest.origin, rest.direction, vkeep(active, last->distance));
        rest.reach       = rest.reach - vkeep(active, last->distance);
    }
}
