/* core/world.c -- see world.h: how a world is made, and the queries. */
#include "core/world.h"
#include "core/trace.h"

#include <float.h>
#include <string.h>
#include <time.h>

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- building ------------------------------------------------------------------------------- */

/* What a step down a tree costs, in tests of a triangle and in walks through a mesh. */
static const double traverse_triangles = 2.0, traverse_instances = 0.1;

/* Copies of arrays, until one fails. */
typedef struct keeper {
    arena *a;
    uint64_t bytes; /* of all copies */
    bool failed;
    lux_error *err;
} keeper;

/* Of an array of 4-byte numbers; NULL of none. */
static const void *keep(keeper *k, const void *from, size_t numbers)
{
    if (!from || numbers == 0 || k->failed)
        return NULL;
    void *to = arena_alloc(k->a, numbers, 4, 4, k->err);
    if (to)
        memcpy(to, from, 4 * numbers);
    k->failed = !to;
    k->bytes += 4 * numbers;
    return to;
}

static bool copy_mesh(arena *a, const mesh *m, solid *to, uint64_t *bytes, lux_error *err)
{
    /* One number more, so that a triangle may be read as three rows of four */
    size_t numbers = (size_t)9 * m->triangle_count + 1;
    float *corners = arena_array(a, float, numbers, err);
    if (!corners)
        return false;
    for (size_t i = 0; i < (size_t)3 * m->triangle_count; i++)
        memcpy(corners + 3 * i, &m->positions[m->corners[i]], 3 * sizeof *corners);
    to->corners        = corners;
    to->triangle_count = m->triangle_count;

    size_t triangles = m->triangle_count;
    keeper k         = { .a = a, .err = err };
    to->material     = keep(&k, m->material, triangles);
    for (int set = 0; set < 2; set++)
        to->texcoord[set] = keep(&k, m->texcoord[set], 6 * triangles);
    to->normals = keep(&k, m->normals, 9 * triangles);
    *bytes += numbers * sizeof *corners + k.bytes;
    return !k.failed;
}

static bool make_projections(arena *a, solid *s, uint64_t *bytes, lux_error *err)
{
    projection *p = arena_array(a, projection, s->triangle_count, err);
    if (!p)
        return false;
    for (uint32_t i = 0; i < s->triangle_count; i++)
        projection_make(s->corners + (size_t)9 * i, &p[i]);
    s->projections = p;
    *bytes += s->triangle_count * sizeof *p;
    return true;
}

static bool make_meshes(arena *a, const world_desc *d, world *w, lux_error *err)
{
    solid *meshes = arena_array(a, solid, d->mesh_count, err);
    if (!meshes)
        return false;
    w->meshes = meshes;
    w->stats.bytes += d->mesh_count * sizeof *meshes;
    for (uint32_t i = 0; i < d->mesh_count; i++) {
        solid *s = &meshes[i];
        if (!copy_mesh(a, &d->meshes[i], s, &w->stats.bytes, err) ||
            (d->test == TRIANGLE_PROJECTION && !make_projections(a, s, &w->stats.bytes, err)))
            return false;
        bsp_desc desc = { .corners  = s->corners,
                          .count    = s->triangle_count,
                          .traverse = traverse_triangles,
                          .threads  = d->threads };
        if (!bsp_build(a, &desc, &s->tree, err))
            return false;
        w->stats.triangles += s->triangle_count;
        w->stats.bytes += s->tree.bytes;
    }
    return true;
}

static placed place(const world_instance *from)
{
    placed p    = { .mesh  = from->mesh,
                    .owner = from->owner,
                    .traits =
                        (from->owner ? TRAIT_OWNED : 0) | (from->hollow ? TRAIT_HOLLOW : TRAIT_SOLID),
                    .identity = true,
                    .mirrors  = transform_determinant(&from->place) < 0.0 };
    transform r = transform_inverse(&from->place);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            p.to_world[i][j] = (float)from->place.m[i][j];
            p.to_mesh[i][j]  = (float)r.m[i][j];
            p.identity       = p.identity && from->place.m[i][j] == (i == j ? 1.0 : 0.0);
        }
    return p;
}

/* The box of what the mesh's box becomes, a little wider for what rounds. */
static bsp_box placed_box(const transform *t, const bsp *tree)
{
    double low[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, high[3] = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    for (int corner = 0; corner < 8; corner++) {
        dvec3 p            = { (double)(corner & 1 ? tree->high.x : tree->low.x),
                               (double)(corner & 2 ? tree->high.y : tree->low.y),
                               (double)(corner & 4 ? tree->high.z : tree->low.z) };
        dvec3 q            = transform_point(t, p);
        const double at[3] = { q.x, q.y, q.z };
        for (int k = 0; k < 3; k++) {
            low[k]  = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
        }
    }
    bsp_box box;
    for (int k = 0; k < 3; k++) {
        double wider = fmax(fabs(low[k]), fabs(high[k])) * (double)TRACE_WIDTH;
        box.low[k]   = (float)fmax(low[k] - wider, -(double)FLT_MAX);
        box.high[k]  = (float)fmin(high[k] + wider, (double)FLT_MAX);
    }
    return box;
}

static bool make_instances(arena *a, const world_desc *d, world *w, lux_error *err)
{
    arena scratch     = { 0 };
    placed *instances = arena_array(a, placed, d->instance_count, err);
    uint32_t *numbers = instances ? arena_array(&scratch, uint32_t, d->instance_count, err) : NULL;
    bsp_box *boxes    = numbers ? arena_array(&scratch, bsp_box, d->instance_count, err) : NULL;
    uint32_t count    = 0;
    for (uint32_t i = 0; boxes && i < d->instance_count; i++) {
        const bsp *tree = &w->meshes[d->instances[i].mesh].tree;
        instances[i]    = place(&d->instances[i]);
        w->hollow       = w->hollow || d->instances[i].hollow;
        w->stats.placed_triangles += w->meshes[instances[i].mesh].triangle_count;
        if (tree->low.x <= tree->high.x) {
            numbers[count] = i;
            boxes[count++] = placed_box(&d->instances[i].place, tree);
        }
    }
    bsp_desc desc = {
        .boxes = boxes, .count = count, .traverse = traverse_instances, .threads = 1
    };
    bool done = boxes && bsp_build(a, &desc, &w->tree, err);
    if (done) {
        /* Those of empty meshes have no box: from numbers of boxes to numbers of instances */
        uint32_t *items = (uint32_t *)(uintptr_t)w->tree.items;
        for (uint64_t i = 0; i < w->tree.item_count; i++)
            items[i] = numbers[items[i]];
        w->instances      = instances;
        w->instance_count = d->instance_count;
        w->stats.bytes += d->instance_count * sizeof *instances + w->tree.bytes;
    }
    arena_clear(&scratch);
    return done;
}

world *world_new(arena *a, const world_desc *d, lux_error *err)
{
    double start = seconds();
    world *w     = arena_new(a, world, err);
    if (!w)
        return NULL;
    w->test        = d->test;
    w->stats.bytes = sizeof *w;
    if (!make_meshes(a, d, w, err) || !make_instances(a, d, w, err))
        return NULL;
    w->stats.build_seconds = seconds() - start;
    return w;
}

world_stats world_statistics(const world *w) { return w->stats; }

void world_bounds(const world *w, vec3 *low, vec3 *high)
{
    *low  = w->tree.low;
    *high = w->tree.high;
}

/* ---- queries -------------------------------------------------------------------------------- */

/* Packets of one lane gain nothing by being put in order. */
static bool as_they_come(ray_hint hint) { return LANES == 1 || hint == RAYS_COHERENT; }

void world_first_hit(const world *w, const vray *rays, const vmask *active, int packets,
                     ray_hint hint, vhit *hits)
{
    if (!as_they_come(hint))
        trace_sorted_first(w, rays, active, packets, hits);
    else
        for (int i = 0; i < packets; i++)
            trace_packet_first(w, &rays[i], active[i], &hits[i]);
}

void world_any_hit(const world *w, const vray *rays, const vmask *active, const vint *spare,
                   int packets, ray_hint hint, vmask *blocked)
{
    if (!as_they_come(hint))
        trace_sorted_any(w, rays, active, spare, packets, blocked);
    else
        for (int i = 0; i < packets; i++)
            blocked[i] = trace_packet_any(w, &rays[i], active[i], spare ? spare[i] : vsplat_int(0));
}

static bool list_hits(const world *w, const vray *rays, const vmask *active, const vint *spare,
                      int packets, int most, list_kind kind, vhit *hits)
{
    bool all = true;
    for (int i = 0; i < packets; i++) {
        hit_list list = { .hits = hits + (size_t)i * (size_t)most, .most = most, .kind = kind };
        for (int k = 0; k < most; k++)
            list.hits[k] = (vhit){ .distance = vsplat(INFINITY),
                                   .instance = vsplat_int(-1),
                                   .triangle = vsplat_int(-1) };
        if (kind != LIST_HOLLOW || w->hollow)
            trace_packet_all(w, &rays[i], active[i], spare ? spare[i] : vsplat_int(0), &list);
        for (int lane_number = 0; lane_number < LANES; lane_number++) {
            if (list.dropped[lane_number] && !list.stopped[lane_number])
                all = false;
            for (int k = list.count[lane_number]; k < most; k++)
                hit_list_clear(&list.hits[k], lane_number);
        }
    }
    return all;
}

bool world_all_hits(const world *w, const vray *rays, const vmask *active, int packets, int most,
                    vhit *hits)
{
    return list_hits(w, rays, active, NULL, packets, most, LIST_TO_SOLID, hits);
}

bool world_hollow_hits(const world *w, const vray *rays, const vmask *active, const vint *spare,
                       int packets, int most, vhit *hits)
{
    return list_hits(w, rays, active, spare, packets, most, LIST_HOLLOW, hits);
}

bool world_every_hit(const world *w, const vray *rays, const vmask *active, int packets, int most,
                     vhit *hits)
{
    return list_hits(w, rays, active, NULL, packets, most, LIST_EVERY, hits);
}
