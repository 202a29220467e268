/* sim/mirrors.c -- see mirrors.h: images of places, and which are worth asking for. */
#include "sim/mirrors.h"

#include "core/color.h"
#include "sim/direct.h"

enum { FEW_WAYS = 128 /* lamps by images: so many are weighed one by one */ };

/* What an image is worth by whose mirrors a lamp's middle is not seen: lamps with extent may be in
 * part; of a point only rounding is at stake. */
static const float unseen_extent = 0.05f, unseen_point = 1e-4f;

vint mirrors_plane(const mirrors *m, const vhit *hit, vmask active)
{
    int32_t of[LANES];
    for (int i = 0; i < LANES; i++) {
        of[i] = -1;
        if (!(vbits(active) >> i & 1) || lane(hit->instance, i) < 0)
            continue;
        int64_t first = m->first_of[lane(hit->instance, i)];
        if (first >= 0)
            of[i] = m->plane_of[first + lane(hit->triangle, i)];
    }
    return vload_int(of);
}

static vint longer(const mirrors *m, const int32_t *table, vint image, const vhit *hit,
                   vmask active)
{
    vint plane = mirrors_plane(m, hit, active & (image >= 0));
    vmask on   = plane >= 0;
    if (!vany(on))
        return vsplat_int(-1);
    vint next = vgather_int(table, vkeep_int(on, image * m->plane_count + plane));
    return vselect_int(on, next, vsplat_int(-1));
}

vint mirrors_follow(const mirrors *m, vint image, const vhit *hit, vmask active)
{
    return longer(m, m->next, image, hit, active);
}

vint mirrors_precede(const mirrors *m, vint image, const vhit *hit, vmask active)
{
    return longer(m, m->earlier, image, hit, active);
}

/* ---- images of places ------------------------------------------------------------------------ */

/* By image, one at a time. */
static vvec3 mapped(const mirrors *m, vint image, const vvec3 *p, bool move, bool back)
{
    vvec3 out  = *p;
    vmask left = image > 0;
    while (vany(left)) {
        int i;
        vmask same            = vtake_same(image, &left, &i);
        const mirror_image *g = &m->images[i];
        vvec3 r[3]            = { vspread(g->row[0]), vspread(g->row[1]), vspread(g->row[2]) };
        vvec3 q               = { vdot(r[0], *p), vdot(r[1], *p), vdot(r[2], *p) };
        if (back)
            q = vadd(vscale(r[0], p->x), vadd(vscale(r[1], p->y), vscale(r[2], p->z)));
        if (move)
            q = vadd(q, vspread(g->move));
        out = vselect3(same, q, out);
    }
    return out;
}

vvec3 mirrors_place(const mirrors *m, vint image, const vvec3 *p)
{
    return mapped(m, image, p, true, false);
}
vvec3 mirrors_turn(const mirrors *m, vint image, const vvec3 *w)
{
    return mapped(m, image, w, false, false);
}
vvec3 mirrors_back(const mirrors *m, vint image, const vvec3 *w)
{
    return mapped(m, image, w, false, true);
}

static vvec3 place_in(const mirror_image *g, const vvec3 *p)
{
    return (vvec3){ vdot(vspread(g->row[0]), *p) + g->move.x,
                    vdot(vspread(g->row[1]), *p) + g->move.y,
                    vdot(vspread(g->row[2]), *p) + g->move.z };
}

static vvec3 turn_in(const mirror_image *g, const vvec3 *w)
{
    return (vvec3){ vdot(vspread(g->row[0]), *w), vdot(vspread(g->row[1]), *w),
                    vdot(vspread(g->row[2]), *w) };
}

static vvec3 back_from(const mirror_image *g, const vvec3 *w)
{
    return vadd(vscale(vspread(g->row[0]), w->x),
                vadd(vscale(vspread(g->row[1]), w->y), vscale(vspread(g->row[2]), w->z)));
}

/* ---- which to ask for ------------------------------------------------------------------------ */

/* Whether the line from p along w crosses the plane's rectangle, ahead. */
static vmask crosses(const mirror_plane *m, const vvec3 *p, const vvec3 *w)
{
    const float slack = 1.0f + 1e-3f;
    vvec3 n = vspread(m->normal), u = vspread(m->u), v = vspread(m->v);
    vfloat off     = m->offset - vdot(n, *p);
    vfloat toward  = vdot(n, *w);
    vfloat t       = off / toward;
    vvec3 from     = vsub(valong(*p, *w, t), vspread(m->centre));
    float across_u = v3_dot(m->u, m->u), across_v = v3_dot(m->v, m->v);
    return (t > 0.0f) & (t < INFINITY) & (vabs(vdot(u, from)) <= slack * across_u) &
           (vabs(vdot(v, from)) <= slack * across_v);
}

/* About the share of what p sees that the plane fills. */
static vfloat fills(const mirror_plane *m, const vvec3 *p)
{
    vvec3 to = vsub(vspread(m->centre), *p);
    float a  = (float)m->area;
    return a / (a + 4.0f * vdot(to, to));
}

/* Where a place and its image see a light. */
typedef struct outlook {
    const mirror_image *image;
    const mirror_plane *first, *last;
    vvec3 p, there, n; /* the place; its image, and the normal there: 0 where all around counts */
} outlook;

/* About what light l gives by way of the image. */
static vfloat given_by(const scene *s, int l, const outlook *o, vmask active)
{
    const light *lamp = s->lights[l];
    light_bounds b    = light_bounds_of(lamp);
    vsurface at       = { .position = o->there, .normal = o->n };
    vvec3 facing      = direct_facing(lamp, &at);
    vmask round       = (o->n.x == 0.0f) & (o->n.y == 0.0f) & (o->n.z == 0.0f);
    vvec3 n           = vselect3(round, facing, o->n);
    vfloat weight     = direct_weight(lamp, &o->there, &n, active);
    vvec3 way         = b.far ? vneg(vspread(b.axis)) : facing;
    vvec3 out         = back_from(o->image, &way);
    vmask seen        = crosses(o->first, &o->p, &out);
    if (o->image->depth > 1 && !b.far)
        seen = seen & crosses(o->last, &o->there, &way);
    float unseen = light_has_extent(lamp) ? unseen_extent : unseen_point;
    return weight * vselect(seen, vsplat(1.0f), vsplat(unseen));
}

static vfloat weight_of(const scene *s, mirror_lights which, int image, const vvec3 *p,
                        const vvec3 *n, vmask active)
{
    const mirrors *m      = s->mirror_images;
    const mirror_image *g = &m->images[image];
    outlook o             = { .image = g,
                              .first = &m->planes[m->chains[g->first]],
                              .last  = &m->planes[m->chains[g->first + g->depth - 1]],
                              .p     = *p,
                              .there = place_in(g, p),
                              .n     = turn_in(g, n) };
    int lamps = scene_lamp_count(s), from = which == MIRROR_SUNS ? lamps : 0;
    int count   = which == MIRROR_SUNS ? s->sun_count : lamps;
    bool by_one = count * m->image_count <= FEW_WAYS && count <= FEW_LAMPS &&
                  (which == MIRROR_SUNS || s->emitter_count == 0);
    vfloat sum = { 0 };
    if (by_one) {
        for (int l = from; l < from + count; l++)
            sum = sum + given_by(s, l, &o, active);
    } else {
        sum = fills(o.first, p);
        if (g->depth > 1)
            sum = sum * fills(o.last, &o.there);
    }
    return vkeep(active & (sum > 0.0f), sum * g->share);
}

vint mirrors_choose(const scene *s, mirror_lights which, const vvec3 *p, const vvec3 *n,
                    vfloat pick, vmask active, vfloat *chance)
{
    const mirrors *m = s->mirror_images;
    vfloat weight[MOST_MIRROR_IMAGES], total = { 0 };
    for (int i = 1; i < m->image_count; i++) {
        weight[i] = weight_of(s, which, i, p, n, active);
        total     = total + weight[i];
    }
    vint drawn   = vsplat_int(-1);
    vfloat share = { 0 }, sum = { 0 }, threshold = pick * total;
    for (int i = 1; i < m->image_count; i++) {
        sum        = sum + weight[i];
        vmask this = active & (drawn < 0) & (weight[i] > 0.0f) & (sum >= threshold);
        drawn      = vselect_int(this, vsplat_int(i), drawn);
        share      = vselect(this, weight[i], share);
    }
    *chance = vkeep(drawn > 0, share / total);
    return drawn;
}

vfloat mirrors_chance(const scene *s, mirror_lights which, const vvec3 *p, const vvec3 *n,
                      vint image, vmask active)
{
    const mirrors *m = s->mirror_images;
    vfloat own = { 0 }, total = { 0 };
    active = active & (image > 0);
    for (int i = 1; i < m->image_count; i++) {
        vfloat weight = weight_of(s, which, i, p, n, active);
        total         = total + weight;
        own           = vselect(image == i, weight, own);
    }
    return vkeep(active & (total > 0.0f), own / total);
}
