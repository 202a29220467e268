/* sim/map_aim_cut.c -- see map_aim.h: surfaces that may focus, cut into blocks of pieces.
 *
 * Triangles follow each other as map_mesh.c has them in order; a triangle that is worth more than a
 * block is halved at its longest edge until it is not, and pieces fill block after block.
 */
#include "sim/map_aim_parts.h"

#include <string.h>

static const double area_share = 0.2; /* of cuts: by area alone */

static vec3 minus(vec3 a, vec3 b) { return (vec3){ a.x - b.x, a.y - b.y, a.z - b.z }; }
static vec3 plus(vec3 a, vec3 b) { return (vec3){ a.x + b.x, a.y + b.y, a.z + b.z }; }

static double area_of(const aim_piece *p)
{
    vec3 u = minus(p->corner[1], p->corner[0]), v = minus(p->corner[2], p->corner[0]);
    return 0.5 * (double)v3_length(v3_cross(u, v));
}

/* A cut that is being made. */
typedef struct cutting {
    map_list *pieces;
    double room; /* what a block holds of `worth` */
    double held; /* the last block does */
    int blocks;
    double *learned; /* as the learner has it, of the new blocks */
    int most, sources;
} cutting;

static bool add_piece(cutting *c, const aim_piece *p, double worth)
{
    if (c->blocks == 0 || (c->held + worth > c->room * (1.0 + 1e-6) && c->blocks < c->most)) {
        c->blocks++;
        c->held = 0.0;
    }
    c->held += worth;
    aim_piece *to = map_list_add(c->pieces);
    if (!to)
        return false;
    *to       = *p;
    to->block = c->blocks - 1;
    return true;
}

static int longest_edge(const aim_piece *p)
{
    int longest = 0;
    float most  = -1.0f;
    for (int e = 0; e < 3; e++) {
        float l = v3_length(minus(p->corner[(e + 1) % 3], p->corner[e]));
        if (l > most)
            most = l, longest = e;
    }
    return longest;
}

typedef struct old_share {
    const double *of; /* of the old block, by source, in steps of `most` */
    double area;      /* m^2, of it */
} old_share;

/* Halves until no part is worth more than a block's room. */
static bool add_parts(cutting *c, const aim_piece *p, double worth, const old_share *from)
{
    if (worth > c->room * (1.0 + 1e-6)) {
        int i = longest_edge(p), j = (i + 1) % 3;
        vec3 mid       = v3_scale(plus(p->corner[i], p->corner[j]), 0.5f);
        aim_piece half = *p;
        half.area *= 0.5f;
        half.corner[j] = mid;
        if (!add_parts(c, &half, 0.5 * worth, from))
            return false;
        half.corner[j] = p->corner[j];
        half.corner[i] = mid;
        return add_parts(c, &half, 0.5 * worth, from);
    }
    if (!add_piece(c, p, worth))
        return false;
    for (int s = 0; from && s < c->sources; s++)
        c->learned[s * c->most + c->blocks - 1] +=
            from->of[s * c->most] * (double)p->area / from->area;
    return true;
}

/* Of the pieces in a list, in order. */
static bool finish_cut(arena *a, const map_list *l, int blocks, aim_cut *to, lux_error *err)
{
    size_t n         = l->count;
    aim_piece *piece = arena_array(a, aim_piece, n + 1, err);
    int32_t *first   = piece ? arena_array(a, int32_t, (size_t)blocks + 1, err) : NULL;
    double *area     = first ? arena_array(a, double, (size_t)blocks + 1, err) : NULL;
    float *from      = area ? arena_array(a, float, n + 1, err) : NULL;
    float *width     = from ? arena_array(a, float, n + 1, err) : NULL;
    if (!width)
        return false;
    memcpy(piece, l->items, n * sizeof *piece);
    for (size_t i = 0; i < n; i++)
        area[piece[i].block] += (double)piece[i].area;
    double before = 0.0;
    for (size_t i = 0; i < n; i++) {
        int b = piece[i].block;
        if (i == 0 || b != piece[i - 1].block) {
            first[b] = (int32_t)i;
            before   = 0.0;
        }
        from[i] = (float)(before / area[b]);
        before += (double)piece[i].area;
    }
    for (size_t i = 0; i < n; i++) {
        bool last = i + 1 == n || piece[i + 1].block != piece[i].block;
        width[i]  = (last ? 1.0f : from[i + 1]) - from[i];
    }
    first[blocks] = (int32_t)n;
    *to           = (aim_cut){ (int)n, blocks, piece, first, area, from, width };
    return true;
}

bool aim_no_memory(lux_error *err)
{
    return failed(err, ERR_MEMORY, "illumination maps: no memory to aim particles");
}

static bool may_focus(const scene *s, uint32_t made_of)
{
    return (s->material_does[made_of] & (DOES_NARROW | DOES_SOLID | DOES_HOLLOW)) != 0;
}

/* All triangles that may focus, whole. */
static bool find_triangles(const aim_desc *d, map_list *out)
{
    const world *w = d->s->world;
    for (int32_t i = 0; i < world_instances(w); i++) {
        const map_mesh *of = &d->meshes->meshes[world_mesh(w, i)];
        transform place    = world_place(w, i);
        for (int32_t r = 0; r < of->count; r++) {
            dvec3 c[3];
            aim_piece p = { .instance = i, .triangle = of->order[r] };
            if (!may_focus(d->s, world_triangle(w, i, p.triangle, c)))
                continue;
            for (int k = 0; k < 3; k++)
                p.corner[k] = d3_to_float(transform_point(&place, c[k]));
            p.area        = (float)area_of(&p);
            aim_piece *to = p.area > 0.0f ? map_list_add(out) : &p;
            if (!to)
                return false;
            *to = p;
        }
    }
    return true;
}

bool aim_first_cut(aim_learner *l, lux_error *err)
{
    map_list whole = { .size = sizeof(aim_piece) }, parts = whole;
    bool good    = find_triangles(l->d, &whole);
    aim_piece *p = whole.items;
    double all   = 0.0;
    for (size_t i = 0; i < whole.count; i++)
        all += (double)p[i].area;
    cutting c = { .pieces = &parts, .room = all / l->wanted, .most = l->most };
    for (size_t i = 0; good && i < whole.count; i++)
        good = add_parts(&c, &p[i], (double)p[i].area, NULL);
    good = good ? finish_cut(&l->scratch, &parts, c.blocks, &l->m->cut, err) : aim_no_memory(err);
    map_list_free(&whole);
    map_list_free(&parts);
    return good;
}

/* The finer the more is drawn there. */
bool aim_cut_anew(aim_learner *l, lux_error *err)
{
    const aim_cut *old = &l->m->cut;
    size_t cells       = (size_t)l->m->sources * (size_t)l->most;
    map_list parts     = { .size = sizeof(aim_piece) };
    double *learned    = arena_array(&l->scratch, double, cells, err);
    double all         = 0.0;
    if (!learned)
        return false;
    for (int b = 0; b < old->blocks; b++)
        all += old->area[b];
    cutting c = { .pieces  = &parts,
                  .room    = 1.0 / l->wanted,
                  .learned = learned,
                  .most    = l->most,
                  .sources = l->m->sources };
    bool good = true;
    for (int i = 0; good && i < old->pieces; i++) {
        int b        = old->piece[i].block;
        double share = 0.0;
        for (int s = 0; s < l->m->sources; s++)
            share += l->learned[s * l->most + b];
        double worth   = (1.0 - area_share) * share / old->area[b] + area_share / all;
        old_share from = { l->learned + b, old->area[b] };
        good           = add_parts(&c, &old->piece[i], worth * (double)old->piece[i].area, &from);
    }
    good = good ? finish_cut(&l->scratch, &parts, c.blocks, &l->m->cut, err) : aim_no_memory(err);
    l->learned = learned;
    map_list_free(&parts);
    return good;
}

/* Out of what is cleared. */
bool aim_keep_cut(arena *a, map_aim *m, lux_error *err)
{
    map_list l = { .size = sizeof(aim_piece) };
    bool good  = true;
    for (int i = 0; good && i < m->cut.pieces; i++) {
        aim_piece *to = map_list_add(&l);
        good          = to != NULL;
        if (to)
            *to = m->cut.piece[i];
    }
    good = good ? finish_cut(a, &l, m->cut.blocks, &m->cut, err) : aim_no_memory(err);
    map_list_free(&l);
    return good;
}
