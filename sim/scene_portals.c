/* sim/scene_portals.c -- what daylight comes in by: windows of the room and what the study names;
 * where there is neither, glazing that has the sky on one side.
 *
 * Portals only say where it is worth while to look: one too many, or too wide, costs samples, and
 * so does light by an opening that is none of them. Nothing is ever lost or counted twice by them.
 */
#include "core/sampler.h"
#include "core/warp.h"
#include "sim/flat_pieces.h"
#include "sim/room.h"
#include "sim/scene_build.h"

#include <stdio.h>

enum { MOST_PORTALS = 128, MOST_TRIANGLES = 1 << 18 };
enum { PACKETS = 256 / LANES, RAYS = PACKETS * LANES };

static const double least_face  = 0.02; /* of the largest: edges of panes are less */
static const double least_width = 0.02; /* of its length */
static const double thickness   = 0.15; /* of its width, from one face of a pane to the other */
static const double beyond      = 0.1;  /* of its size, by which one face may stand out */
static const double least_sky   = 0.02; /* of the cosine hemisphere, outside */
static const double most_inside = 0.5;  /* of that, inside */
static const double wider       = 1e-5; /* of its size, at each side: for rounding */

typedef struct portal_work {
    scene_build *b;
    const scene *s;
    arena *scratch;
    list corners;      /* dvec3, m, in the scene's frame; 3 a triangle */
    list tags;         /* uint32_t */
    flat_piece *found; /* that are portals; their normals look out */
    int count;
    int refused;    /* that do not lie between inside and outside */
    dvec3 first_at; /* m, in the scene's frame, of those */
    int left_out;   /* beyond MOST_PORTALS */
} portal_work;

/* ---- triangles ------------------------------------------------------------------------------- */

/* Which triangles of a placement are meant. */
typedef struct choice {
    const bool *materials; /* of the file; */
    bool all;              /* or all */
    const uint32_t *tags;  /* of each material of the file */
} choice;

static bool add_triangle(portal_work *w, const mesh *m, uint32_t t, const transform *place,
                         uint32_t tag)
{
    uint32_t *to = list_new(&w->tags, w->scratch, uint32_t, w->b->err);
    if (!to)
        return false;
    *to = tag;
    for (uint32_t c = 0; c < 3; c++) {
        dvec3 *p = list_new(&w->corners, w->scratch, dvec3, w->b->err);
        if (!p)
            return false;
        dvec3 at = transform_point(place, d3_from(m->positions[m->corners[3 * (size_t)t + c]]));
        *p       = d3_sub(at, w->b->centre);
    }
    return true;
}

/* Those of placement k of entry i, in all its copies. */
static bool add_placement(portal_work *w, int i, uint32_t k, const choice *which)
{
    const study_scene *s    = &w->b->study->scenes[i];
    const gltf_placement *p = &w->b->files[i]->placements[k];
    const mesh *m           = &w->b->files[i]->meshes[p->mesh].triangles;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        uint32_t made_of = m->material ? m->material[t] : 0;
        if (!which->all && !which->materials[made_of])
            continue;
        for (int c = 0; c < s->at_count && w->tags.count <= MOST_TRIANGLES; c++) {
            transform copy     = scene_copy_place(s, c);
            transform to_world = transform_product(&copy, &p->place);
            if (!add_triangle(w, m, t, &to_world, which->tags[made_of]))
                return false;
        }
    }
    return true;
}

/* What `portals` of entry i names; the tags tell whether it is opaque. */
static bool add_named(portal_work *w, int i)
{
    scene_build *b         = w->b;
    const study_scene *e   = &b->study->scenes[i];
    const gltf *g          = b->files[i];
    const named_patterns p = { "portals", e->portals, e->portal_count };
    named_parts parts;
    uint32_t *tags = arena_array(w->scratch, uint32_t, (size_t)g->material_count + 1, b->err);
    if (!tags || !scene_named_parts(b, i, &p, &parts))
        return false;
    for (uint32_t m = 0; m < g->material_count; m++)
        tags[m] = !material_is_hollow(w->s->materials[b->first_material[i] + m]);
    for (uint32_t k = 0; k < g->placement_count; k++)
        if (!add_placement(w, i, k, &(choice){ parts.materials, parts.placements[k], tags }))
            return false;
    return w->tags.count <= MOST_TRIANGLES ||
           study_failed(b->study, e->where, b->err, ERR_ARGUMENT,
                        "`portals` name more than %d triangles, expected windows", MOST_TRIANGLES);
}

/* Glass in entry i: what lets light through all over, not by holes. */
static bool add_glazing(portal_work *w, int i)
{
    scene_build *b       = w->b;
    const gltf *g        = b->files[i];
    const uint32_t first = b->first_material[i];
    bool any             = false;
    bool *glass          = arena_array(w->scratch, bool, (size_t)g->material_count + 1, b->err);
    uint32_t *tags       = arena_array(w->scratch, uint32_t, (size_t)g->material_count + 1, b->err);
    if (!glass || !tags)
        return false;
    for (uint32_t m = 0; m < g->material_count; m++) {
        tags[m]  = first + m;
        glass[m] = w->s->materials[first + m]->type->through && w->s->material_info[first + m].used;
        any      = any || glass[m];
    }
    for (uint32_t k = 0; any && k < g->placement_count; k++)
        if (!add_placement(w, i, k, &(choice){ glass, false, tags }))
            return false;
    return true;
}

/* ---- inside and outside ---------------------------------------------------------------------- */

/* The cosine-weighted share of what a side of a rectangle sees that nothing opaque hides. */
static double open_share(const world *w, const flat_piece *p, float side)
{
    const float off  = 1e-3f; /* of its size, from the surface */
    const float part = 1.8f;  /* of its half sides, all across: its very edge may lie in a wall */
    vvec3 n          = vspread(v3_scale(d3_to_float(p->normal), side));
    vvec3 u = vspread(d3_to_float(p->u)), v = vspread(d3_to_float(p->v));
    vvec3 from = valong(vspread(d3_to_float(p->centre)), n, off * vmin(vlength(u), vlength(v)));
    vray rays[PACKETS];
    vmask active[PACKETS], blocked[PACKETS];
    for (int k = 0; k < PACKETS; k++) {
        vuint number = vunsigned(vlane_index() + k * LANES);
        vsample4 q   = vsobol4(number, vsplat_uint(0));
        vvec3 place  = vadd(vscale(u, part * (q.z - 0.5f)), vscale(v, part * (q.w - 0.5f)));
        rays[k]   = (vray){ vadd(from, place), vwarp_cosine_about(n, q.x, q.y), vsplat(INFINITY) };
        active[k] = ALL_LANES;
    }
    world_any_hit(w, rays, active, NULL, PACKETS, RAYS_INCOHERENT, blocked);
    int open = 0;
    for (int k = 0; k < PACKETS; k++)
        open += __builtin_popcount((unsigned)vbits(~blocked[k] & active[k]));
    return (double)open / RAYS;
}

/* Turns a piece's normal to the side that sees the sky; false: both do, or none. */
static bool look_out(const scene *s, flat_piece *p)
{
    double front = open_share(s->world, p, 1.0f), back = open_share(s->world, p, -1.0f);
    if (back > front)
        p->normal = d3_scale(p->normal, -1.0);
    return fmax(front, back) >= least_sky && fmin(front, back) <= most_inside * fmax(front, back);
}

/* ---- which pieces ---------------------------------------------------------------------------- */

/* Whether p is the other face of the pane that q is one of, or another pane of that window. */
static bool lies_at(const flat_piece *p, const flat_piece *q)
{
    double along = d3_length(q->u), across = d3_length(q->v);
    double width = 2.0 * fmin(along, across);
    dvec3 apart  = d3_sub(p->centre, q->centre);
    if (fabs(d3_dot(p->normal, q->normal)) < 0.99 ||
        fabs(d3_dot(apart, q->normal)) > thickness * width)
        return false;
    dvec3 u = d3_scale(q->u, 1.0 / along), v = d3_scale(q->v, 1.0 / across);
    return fabs(d3_dot(apart, u)) + fabs(d3_dot(p->u, u)) + fabs(d3_dot(p->v, u)) <=
               (1.0 + beyond) * along &&
           fabs(d3_dot(apart, v)) + fabs(d3_dot(p->u, v)) + fabs(d3_dot(p->v, v)) <=
               (1.0 + beyond) * across;
}

static bool matters(const flat_piece *p, const flat_piece *largest)
{
    double a = d3_length(p->u), b = d3_length(p->v);
    return flat_piece_face(p) >= least_face * flat_piece_face(largest) &&
           fmin(a, b) >= least_width * fmax(a, b);
}

/* Pieces from the largest on: each window once, by its outermost or largest pane. */
static bool choose(portal_work *w)
{
    flat_piece *all;
    uint32_t n = 0, kept = 0;
    if (!flat_pieces_of(w->scratch, w->corners.items, w->tags.items, (uint32_t)w->tags.count, &all,
                        &n, w->b->err))
        return false;
    for (uint32_t i = 0; i < n && kept <= MOST_PORTALS; i++) {
        bool another = matters(&all[i], &all[0]);
        for (uint32_t k = 0; another && k < kept; k++)
            another = !lies_at(&all[i], &all[k]);
        if (another)
            all[kept++] = all[i];
    }
    w->left_out = kept > MOST_PORTALS;
    for (uint32_t i = 0; i < kept && i < MOST_PORTALS; i++) {
        if (look_out(w->s, &all[i]))
            w->found[w->count++] = all[i];
        else if (w->refused++ == 0)
            w->first_at = all[i].centre;
    }
    return true;
}

/* ---- the three kinds ------------------------------------------------------------------------- */

static bool from_room(portal_work *w)
{
    const study_room *r = &w->b->study->room;
    for (int i = 0; i < r->window_count; i++) {
        room_opening o = room_opening_of(r->size, &r->windows[i]);
        dvec3 half     = d3_scale(d3_sub(o.high, o.low), 0.5);
        dvec3 x = { half.x, 0, 0 }, y = { 0, half.y, 0 }, z = { 0, 0, half.z };
        dvec3 mid            = d3_scale(d3_add(o.low, o.high), 0.5);
        w->found[w->count++] = (flat_piece){ .centre = d3_sub(mid, w->b->centre),
                                             .u      = o.outward.x != 0.0 ? y : x,
                                             .v      = o.outward.z != 0.0 ? y : z,
                                             .normal = o.outward };
    }
    return true;
}

static void tell_named(portal_work *w)
{
    const uint32_t *opaque = w->tags.items;
    const study *s         = w->b->study;
    size_t shut            = 0;
    for (size_t i = 0; i < w->tags.count; i++)
        shut += opaque[i] != 0;
    dvec3 at = d3_add(w->first_at, w->s->centre);
    if (w->refused)
        notice_add(w->b->notices,
                   "%s: %d surface%s that `portals` name, first at (%.4g, %.4g, %.4g) m, %s not "
                   "between inside and outside: the sky is sought there as elsewhere",
                   s->path, w->refused, w->refused > 1 ? "s" : "", at.x, at.y, at.z,
                   w->refused > 1 ? "are" : "is");
    if (shut)
        notice_add(w->b->notices,
                   "%s: %zu of %zu triangles that `portals` name are opaque: no light comes in by "
                   "them",
                   s->path, shut, w->tags.count);
    if (w->left_out)
        notice_add(w->b->notices, "%s: of what `portals` name the %d largest are looked to",
                   s->path, MOST_PORTALS);
}

static bool from_names(portal_work *w, int *named)
{
    const study *s = w->b->study;
    int before     = w->count;
    for (int i = 0; i < s->scene_count; i++)
        if (s->scenes[i].portal_count && !add_named(w, i))
            return false;
    if (!w->tags.count)
        return true;
    if (!choose(w))
        return false;
    tell_named(w);
    *named = w->count - before;
    return true;
}

static bool from_glazing(portal_work *w)
{
    for (int i = 0; i < w->b->study->scene_count; i++)
        if (!add_glazing(w, i))
            return false;
    return w->tags.count == 0 || w->tags.count > MOST_TRIANGLES || choose(w);
}

/* ---- the whole ------------------------------------------------------------------------------- */

/* In single precision, and never smaller than the opening. */
static portal portal_of(const flat_piece *p)
{
    double far  = fabs(p->centre.x) + fabs(p->centre.y) + fabs(p->centre.z);
    double more = 4.0 * 0x1p-24 * (far + d3_length(p->u) + d3_length(p->v));
    double u = 1.0 + wider + more / d3_length(p->u), v = 1.0 + wider + more / d3_length(p->v);
    return (portal){ .centre  = d3_to_float(p->centre),
                     .u       = d3_to_float(d3_scale(p->u, u)),
                     .v       = d3_to_float(d3_scale(p->v, v)),
                     .outward = d3_to_float(p->normal) };
}

/* "2 room windows", "3 named", "4 of glazing "Glass", "Door"": no more than two names. */
static const char *say_whence(portal_work *w, int windows, int named)
{
    enum { SIZE = 256 };
    const scene_material *info = w->s->material_info;
    char *text                 = arena_array(w->b->a, char, SIZE, w->b->err);
    if (!text)
        return NULL;
    if (windows || named) {
        size_t n = 0;
        if (windows)
            n = (size_t)snprintf(text, SIZE, "%d room window%s", windows, windows > 1 ? "s" : "");
        if (named)
            snprintf(text + n, SIZE - n, "%s%d named", windows ? "; " : "", named);
        return text;
    }
    uint32_t first = w->found[0].tag, other = first;
    for (int i = 0; i < w->count && other == first; i++)
        other = w->found[i].tag;
    snprintf(text, SIZE, "%d of glazing \"%.80s\"%s", w->count, info[first].name,
             other == first ? "" : " and others");
    return text;
}

static bool keep(portal_work *w, scene *s, int windows, int named)
{
    portal *all = arena_array(w->b->a, portal, (size_t)w->count + 1, w->b->err);
    if (!all)
        return false;
    for (int i = 0; i < w->count; i++)
        all[i] = portal_of(&w->found[i]);
    s->portal_list  = all;
    s->portal_count = w->count;
    if (w->count)
        s->portals_from = say_whence(w, windows, named);
    return !w->count || s->portals_from;
}

static bool find(portal_work *w, scene *s)
{
    const study *from = w->b->study;
    int windows = from->room.given ? from->room.window_count : 0, named = 0;
    bool asked = windows > 0;
    for (int i = 0; i < from->scene_count; i++)
        asked = asked || from->scenes[i].portal_count > 0;
    w->found = arena_array(w->scratch, flat_piece, (size_t)windows + MOST_PORTALS, w->b->err);
    return w->found && (windows == 0 || from_room(w)) &&
           (asked ? from_names(w, &named) : from_glazing(w)) && keep(w, s, windows, named);
}

/* What directions are drawn by, over all skies. */
static bool make_samplers(scene_build *b, scene *s)
{
    arena scratch   = { 0 };
    const sky **all = arena_array(&scratch, const sky *, (size_t)s->sky_count, b->err);
    for (int i = 0; all && i < s->sky_count; i++)
        all[i] = s->skies[i].sky;
    bool good =
        all && (s->dome = dome_new(b->a, all, s->sky_count, b->err)) &&
        (s->portal_count == 0 || (s->portals = portals_new(b->a, s->portal_list, s->portal_count,
                                                           all, s->sky_count, b->err)));
    arena_clear(&scratch);
    return good;
}

bool scene_find_portals(scene_build *b, scene *s)
{
    if (s->sky_count == 0 && s->sun_count == 0)
        return true;
    arena scratch = { 0 };
    portal_work w = { .b = b, .s = s, .scratch = &scratch };
    bool good     = is_left_out(b, EFFECT_PORTALS) || find(&w, s);
    arena_clear(&scratch);
    const study_room *room = &b->study->room;
    if (room->given && room->window_count == 0)
        notice_add(b->notices, "%s:%d:%d: the room has no `windows`: no daylight comes into it",
                   b->study->path, room->where.line, room->where.column);
    return good && (s->sky_count == 0 || make_samplers(b, s));
}
