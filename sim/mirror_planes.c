/* sim/mirror_planes.c -- which triangles of a scene are plane mirrors, and which chains of planes
 * light may go by: mirrors.h.
 *
 * Triangles are put together by plane, the largest first. Small planes of a material that has far
 * larger ones, or many, are facets of something round, and no mirrors here.
 */
#include "core/color.h"
#include "sim/mirrors.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_FOUND = 512 /* planes that are told apart */ };

static const double facet_share = 0.03;  /* of a material's mirrors: less is a facet */
static const float least_share  = 0.01f; /* of light, that a chain gives back */
static const double same_plane  = 1e-4;  /* m */

/* A mirror triangle. */
typedef struct facet {
    dvec3 corner[3];
    double area;
    int64_t number; /* in plane_of */
    uint32_t material;
} facet;

/* A plane as it is found. */
typedef struct found {
    dvec3 normal;
    double offset, area, share; /* share: by area */
    dvec3 u, v;                 /* unit, in the plane */
    double low[2], high[2];
    uint32_t material; /* of its first triangle */
    int32_t number;    /* once it is kept; -1 */
} found;

typedef struct search {
    const mesh *meshes;
    const world_instance *instances;
    const material *const *materials;
    uint32_t count;
    facet *facets;
    size_t facet_count;
    found *planes;
    int plane_count;
    double *area_of_material;
} search;

static const material *material_of(const search *w, const mesh *m, uint32_t t)
{
    return w->materials[m->material ? m->material[t] : 0];
}

/* Its reflection goes by the triangle's own plane. */
static bool is_plane_mirror(const search *w, const mesh *m, uint32_t t)
{
    const material *of = material_of(w, m, t);
    if (!of->type->mirrored || (of->textures && of->textures->normal.texture))
        return false;
    if (!m->normals)
        return true;
    const vec3 *n = &m->normals[3 * (size_t)t];
    for (int c = 1; c < 3; c++)
        if (v3_dot(n[0], n[c]) < (1.0f - 1e-5f) * v3_dot(n[0], n[0]))
            return false;
    return true;
}

static bool mesh_has_mirrors(const search *w, const mesh *m)
{
    for (uint32_t t = 0; t < m->triangle_count; t++)
        if (is_plane_mirror(w, m, t))
            return true;
    return false;
}

static size_t count_facets(const search *w, int64_t *first_of, size_t *triangles)
{
    size_t facets = 0;
    *triangles    = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        const mesh *m = &w->meshes[w->instances[i].mesh];
        first_of[i]   = -1;
        if (!mesh_has_mirrors(w, m))
            continue;
        first_of[i] = (int64_t)*triangles;
        *triangles += m->triangle_count;
        for (uint32_t t = 0; t < m->triangle_count; t++)
            facets += is_plane_mirror(w, m, t);
    }
    return facets;
}

static void collect(search *w, const int64_t *first_of)
{
    for (uint32_t i = 0; i < w->count; i++) {
        const mesh *m = &w->meshes[w->instances[i].mesh];
        for (uint32_t t = 0; first_of[i] >= 0 && t < m->triangle_count; t++) {
            if (!is_plane_mirror(w, m, t))
                continue;
            facet *f = &w->facets[w->facet_count];
            for (int c = 0; c < 3; c++)
                f->corner[c] =
                    transform_point(&w->instances[i].place,
                                    d3_from(m->positions[m->corners[3 * (size_t)t + (size_t)c]]));
            dvec3 a = d3_sub(f->corner[1], f->corner[0]), b = d3_sub(f->corner[2], f->corner[0]);
            f->area     = 0.5 * d3_length(d3_cross(a, b));
            f->number   = first_of[i] + t;
            f->material = m->material ? m->material[t] : 0;
            if (f->area > 0.0 && isfinite(f->area))
                w->facet_count++;
        }
    }
}

static int larger_first(const void *a, const void *b)
{
    const facet *x = a, *y = b;
    if (x->area != y->area)
        return x->area > y->area ? -1 : 1;
    return (x->number > y->number) - (x->number < y->number);
}

static double off_plane(const found *p, dvec3 at)
{
    return fabs(d3_dot(p->normal, at) - p->offset);
}

static bool lies_in(const found *p, const facet *f)
{
    double worst = 0.0, size = 0.0;
    for (int c = 0; c < 3; c++) {
        worst = fmax(worst, off_plane(p, f->corner[c]));
        size  = fmax(size, d3_length(f->corner[c]));
    }
    return worst < same_plane + 0x1p-21 * size;
}

static void begin_plane(found *p, const facet *f)
{
    dvec3 a = d3_sub(f->corner[1], f->corner[0]), b = d3_sub(f->corner[2], f->corner[0]);
    dvec3 n    = d3_cross(a, b);
    p->normal  = d3_scale(n, 1.0 / d3_length(n));
    p->offset  = d3_dot(p->normal, f->corner[0]);
    dvec3 c    = d3_sub(f->corner[2], f->corner[1]);
    dvec3 side = d3_length(b) > d3_length(a) ? b : a; /* of a rectangle's halves not the diagonal */
    if (fabs(d3_dot(a, b)) > fabs(d3_dot(a, c)))
        side = fabs(d3_dot(a, c)) < fabs(d3_dot(b, c)) ? a : b;
    p->u        = d3_scale(side, 1.0 / d3_length(side));
    p->v        = d3_cross(p->normal, p->u);
    p->material = f->material;
    p->low[0] = p->low[1] = HUGE_VAL;
    p->high[0] = p->high[1] = -HUGE_VAL;
}

static void add_facet(search *w, found *p, const facet *f)
{
    p->area += f->area;
    p->share += f->area * (double)rgb_luminance(w->materials[f->material]->reflectance);
    for (int c = 0; c < 3; c++) {
        double at[2] = { d3_dot(p->u, f->corner[c]), d3_dot(p->v, f->corner[c]) };
        for (int k = 0; k < 2; k++) {
            p->low[k]  = fmin(p->low[k], at[k]);
            p->high[k] = fmax(p->high[k], at[k]);
        }
    }
}

/* Puts each triangle to its plane, number in plane_of; -1 those of too many. */
static void put_together(search *w, int32_t *plane_of)
{
    qsort(w->facets, w->facet_count, sizeof *w->facets, larger_first);
    for (size_t i = 0; i < w->facet_count; i++) {
        const facet *f = &w->facets[i];
        int k          = 0;
        while (k < w->plane_count && !lies_in(&w->planes[k], f))
            k++;
        w->area_of_material[f->material] += f->area;
        if (k == MOST_FOUND)
            continue;
        if (k == w->plane_count)
            begin_plane(&w->planes[w->plane_count++], f);
        add_facet(w, &w->planes[k], f);
        plane_of[f->number] = k;
    }
}

/* The planes that are worth it, in the order of size: area by what it gives back. */
static int keep_planes(search *w, mirror_plane *to)
{
    int kept               = 0;
    bool taken[MOST_FOUND] = { false };
    while (kept < MOST_MIRROR_PLANES) {
        int best = -1;
        for (int k = 0; k < w->plane_count; k++)
            if (!taken[k] &&
                w->planes[k].area > facet_share * w->area_of_material[w->planes[k].material] &&
                w->planes[k].share > 0.001 * w->planes[k].area &&
                (best < 0 || w->planes[k].share > w->planes[best].share))
                best = k;
        if (best < 0)
            break;
        taken[best]    = true;
        found *p       = &w->planes[best];
        p->number      = kept;
        double half[2] = { 0.5 * (p->high[0] - p->low[0]), 0.5 * (p->high[1] - p->low[1]) };
        double mid[2]  = { 0.5 * (p->high[0] + p->low[0]), 0.5 * (p->high[1] + p->low[1]) };
        dvec3 centre   = d3_add(d3_scale(p->normal, p->offset),
                                d3_add(d3_scale(p->u, mid[0]), d3_scale(p->v, mid[1])));
        to[kept++]     = (mirror_plane){ .normal = d3_to_float(p->normal),
                                         .offset = (float)p->offset,
                                         .centre = d3_to_float(centre),
                                         .u      = d3_to_float(d3_scale(p->u, half[0])),
                                         .v      = d3_to_float(d3_scale(p->v, half[1])),
                                         .area   = p->area,
                                         .share  = (float)(p->share / p->area) };
    }
    return kept;
}

/* ---- chains ---------------------------------------------------------------------------------- */

/* Which sides of plane p some of q lies on: bit 0 before it, bit 1 behind. */
static int sides_of(const mirror_plane *p, const mirror_plane *q)
{
    int sides   = 0;
    float slack = 1e-4f;
    for (int c = 0; c < 4; c++) {
        vec3 u = v3_scale(q->u, c & 1 ? 1.0f : -1.0f), v = v3_scale(q->v, c & 2 ? 1.0f : -1.0f);
        vec3 at   = { q->centre.x + u.x + v.x, q->centre.y + u.y + v.y, q->centre.z + u.z + v.z };
        float off = v3_dot(p->normal, at) - p->offset;
        sides |= (off > slack) | (off < -slack) << 1;
    }
    return sides;
}

/* Whether light can go from the plane before the last to the last to q: all on one side of each. */
static bool can_follow(const mirrors *m, const mirror_image *i, int q)
{
    if (i->depth == 0)
        return true;
    int last = m->chains[i->first + i->depth - 1];
    if (last == q)
        return false;
    int onward = sides_of(&m->planes[last], &m->planes[q]);
    if (onward == 0 || sides_of(&m->planes[q], &m->planes[last]) == 0)
        return false;
    if (i->depth == 1)
        return true;
    int before = m->chains[i->first + i->depth - 2];
    return (onward & sides_of(&m->planes[last], &m->planes[before])) != 0;
}

/* M a: the chain's map and one more reflection. */
static void reflect_map(const mirror_image *from, const mirror_plane *p, mirror_image *to)
{
    double n[3] = { (double)p->normal.x, (double)p->normal.y, (double)p->normal.z };
    double row[3][4];
    for (int r = 0; r < 3; r++) {
        const float move[3] = { from->move.x, from->move.y, from->move.z };
        row[r][0] = (double)from->row[r].x, row[r][1] = (double)from->row[r].y;
        row[r][2] = (double)from->row[r].z, row[r][3] = (double)move[r];
    }
    double out[3][4];
    for (int c = 0; c < 4; c++) {
        double along = n[0] * row[0][c] + n[1] * row[1][c] + n[2] * row[2][c];
        if (c == 3)
            along -= (double)p->offset;
        for (int r = 0; r < 3; r++)
            out[r][c] = row[r][c] - 2.0 * along * n[r];
    }
    for (int r = 0; r < 3; r++)
        to->row[r] = (vec3){ (float)out[r][0], (float)out[r][1], (float)out[r][2] };
    to->move = (vec3){ (float)out[0][3], (float)out[1][3], (float)out[2][3] };
}

/* Chain i and plane p, without its first plane: -1 where that is not kept. */
static int32_t without_first(const mirrors *m, const int32_t *next, int i, int p)
{
    return i == 0 ? 0 : next[m->images[i].after * m->plane_count + p];
}

/* The best way to make a chain longer; false: none is worth it. */
static bool best_longer(const mirrors *m, const int32_t *next, int count, int *image, int *plane)
{
    float best = least_share;
    *image     = -1;
    for (int i = 0; i < count; i++)
        for (int p = 0; p < m->plane_count; p++) {
            float share = m->images[i].share * m->planes[p].share;
            if (next[i * m->plane_count + p] == -1 && share > best &&
                can_follow(m, &m->images[i], p) && without_first(m, next, i, p) >= 0) {
                best   = share;
                *image = i, *plane = p;
            }
        }
    return *image >= 0;
}

static bool make_chains(arena *a, mirrors *m, lux_error *err)
{
    size_t planes        = (size_t)m->plane_count;
    mirror_image *images = arena_array(a, mirror_image, MOST_MIRROR_IMAGES, err);
    int32_t *next    = images ? arena_array(a, int32_t, MOST_MIRROR_IMAGES * planes, err) : NULL;
    size_t room      = MOST_MIRROR_IMAGES * MOST_MIRROR_IMAGES / 2;
    int32_t *earlier = next ? arena_array(a, int32_t, MOST_MIRROR_IMAGES * planes, err) : NULL;
    int32_t *chains  = earlier ? arena_array(a, int32_t, room, err) : NULL;
    if (!chains)
        return false;
    memset(next, -1, MOST_MIRROR_IMAGES * planes * sizeof *next);
    memset(earlier, -1, MOST_MIRROR_IMAGES * planes * sizeof *earlier);
    images[0] = (mirror_image){ .before = -1,
                                .share  = 1.0f,
                                .row    = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
    m->images = images, m->chains = chains, m->next = next, m->earlier = earlier,
    m->image_count = 1;
    size_t used    = 0;
    int from = 0, plane = 0;
    while (m->image_count < MOST_MIRROR_IMAGES &&
           best_longer(m, next, m->image_count, &from, &plane)) {
        const mirror_image *short_ = &images[from];
        size_t depth               = (size_t)short_->depth;
        if (used + depth + 1 > room)
            break;
        mirror_image *to = &images[m->image_count];
        *to              = (mirror_image){ .before = from,
                                           .first  = (int32_t)used,
                                           .depth  = short_->depth + 1,
                                           .share  = short_->share * m->planes[plane].share };
        reflect_map(short_, &m->planes[plane], to);
        if (depth)
            memcpy(chains + used, chains + short_->first, depth * sizeof *chains);
        chains[used + depth] = plane;
        used += depth + 1;
        to->after = without_first(m, next, from, plane);
        earlier[to->after * m->plane_count + chains[to->first]] = m->image_count;
        next[from * m->plane_count + plane]                     = m->image_count++;
        m->most                                                 = fmaxf(m->most, to->share);
    }
    return true;
}

bool mirrors_find(arena *a, const mesh *meshes, const world_instance *instances, uint32_t count,
                  const material *const *materials, const mirrors **out, lux_error *err)
{
    arena scratch = { 0 };
    search w = { .meshes = meshes, .instances = instances, .materials = materials, .count = count };
    int64_t *first_of = arena_array(a, int64_t, (size_t)count + 1, err);
    size_t triangles = 0, facets = first_of ? count_facets(&w, first_of, &triangles) : 0;
    *out = NULL;
    if (!facets)
        return first_of != NULL;
    mirrors *m           = arena_new(a, mirrors, err);
    int32_t *plane_of    = arena_array(a, int32_t, triangles, err);
    mirror_plane *planes = arena_array(a, mirror_plane, MOST_MIRROR_PLANES, err);
    w.facets             = arena_array(&scratch, facet, facets, err);
    w.planes             = arena_array(&scratch, found, MOST_FOUND, err);
    uint32_t most        = 0;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t t = 0; first_of[i] >= 0 && t < meshes[instances[i].mesh].triangle_count; t++)
            if (meshes[instances[i].mesh].material)
                most = most > meshes[instances[i].mesh].material[t]
                           ? most
                           : meshes[instances[i].mesh].material[t];
    w.area_of_material = arena_array(&scratch, double, (size_t)most + 1, err);
    bool good          = m && plane_of && planes && w.facets && w.planes && w.area_of_material;
    if (good) {
        memset(plane_of, -1, triangles * sizeof *plane_of);
        for (int k = 0; k < MOST_FOUND; k++)
            w.planes[k].number = -1;
        collect(&w, first_of);
        put_together(&w, plane_of);
        *m             = (mirrors){ .planes = planes, .first_of = first_of, .plane_of = plane_of };
        m->plane_count = keep_planes(&w, planes);
        for (size_t i = 0; i < triangles; i++)
            plane_of[i] = plane_of[i] >= 0 ? w.planes[plane_of[i]].number : -1;
        good = m->plane_count == 0 || make_chains(a, m, err);
        *out = good && m->plane_count > 0 ? m : NULL;
    }
    arena_clear(&scratch);
    return good;
}
