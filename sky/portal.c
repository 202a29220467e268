/* sky/portal.c -- see portal.h, and portal_table.h for what one portal does.
 *
 * Portals of one orientation stand together, since they share a frame and a table. A portal's
 * chance is its light times the larger cosine of two places of it with the surface.
 */
#include "sky/portal.h"

#include "sky/portal_table.h"

/* In the frame of its orientation. */
typedef struct placed {
    float x, y, z, half_x, half_y; /* m */
    int facade;
} placed;

typedef struct facade {
    portal_table table;
    int first, count; /* of placed */
} facade;

struct portals {
    int count; /* of facades */
    const facade *facades;
    const placed *all;
};

/* Rays closer to the plane of a portal, by their cosine, do not go through it: squares of smaller
 * ones leave the range of a float. */
static const float GRAZING = 1e-12f;

/* ---- one portal ----------------------------------------------------------------------------- */

static vvec3 turn(const portal_table *t, const vvec3 *a)
{
    return (vvec3){ vdot(vspread(t->u), *a), vdot(vspread(t->v), *a),
                    vdot(vspread(t->outward), *a) };
}

static vvec3 turn_back(const portal_table *t, const vvec3 *a)
{
    return vadd(vscale(vspread(t->u), a->x),
                vadd(vscale(vspread(t->v), a->y), vscale(vspread(t->outward), a->z)));
}

/* p: in the frame. */
static portal_view look(const placed *d, const vvec3 *p)
{
    return (portal_view){ d->x - p->x, d->y - p->y, d->z - p->z, vsplat(d->half_x),
                          vsplat(d->half_y) };
}

/* Whether w in the frame goes through. */
static vmask crosses(const portal_view *v, const vvec3 *w)
{
    return (v->z > 0.0f) & (w->z > GRAZING) &
           (vabs(w->x * v->z - v->x * w->z) <= v->half_x * w->z) &
           (vabs(w->y * v->z - v->y * w->z) <= v->half_y * w->z);
}

static vfloat cosine(vfloat x, vfloat y, const portal_view *v, const vvec3 *n)
{
    return (x * n->x + y * n->y + v->z * n->z) / vsqrt(x * x + y * y + v->z * v->z);
}

/* Of its middle and of the corner that lies farthest along n, which is above the horizon if any is;
 * 1 where n is 0. */
static vfloat highest(const portal_view *v, const vvec3 *n)
{
    vfloat x    = v->x + vcopysign(v->half_x, n->x);
    vfloat y    = v->y + vcopysign(v->half_y, n->y);
    vfloat most = vmax(cosine(x, y, v, n), cosine(v->x, v->y, v, n));
    vmask plain = (n->x == 0.0f) & (n->y == 0.0f) & (n->z == 0.0f);
    return vselect(plain, vsplat(1.0f), vmax(most, vsplat(0.0f)));
}

/* ---- all of them ---------------------------------------------------------------------------- */

/* What is drawn from: the sum of chances, and where asked for the portal drawn by pick. */
typedef struct drawing {
    vfloat total, pick;
    vint portal;
} drawing;

static void add_chances(drawing *d, const portals *all, int which, const vvec3 *p, const vvec3 *n,
                        vmask active)
{
    const facade *f = &all->facades[which];
    vvec3 place = turn(&f->table, p), normal = turn(&f->table, n);
    for (int i = f->first; i < f->first + f->count; i++) {
        portal_view v  = look(&all->all[i], &place);
        vmask in_front = active & (v.z > 0.0f);
        if (!vany(in_front))
            continue;
        portal_box box;
        portal_table_box(&f->table, &v, in_front, &box);
        vfloat chance = vkeep(box.seen, box.light * highest(&v, &normal));

        /* The new one is drawn with its share of all so far; what is left of pick goes on */
        vfloat total = d->total + chance;
        vfloat at    = d->pick * total;
        vmask taken  = at < chance;
        vfloat left  = vselect(taken, at, at - chance) / vselect(taken, chance, d->total);
        d->pick      = vselect(chance > 0.0f, vmin(left, vsplat(0x1.fffffep-1f)), d->pick);
        d->portal    = vselect_int(taken, vsplat_int(i), d->portal);
        d->total     = total;
    }
}

static drawing draw_portal(const portals *all, const vvec3 *p, const vvec3 *n, vfloat pick,
                           vmask active)
{
    drawing d = { .pick = vkeep(active, pick) };
    for (int i = 0; i < all->count; i++)
        add_chances(&d, all, i, p, n, active);
    return d;
}

/* The density of the mixture, of wi through whichever portals. */
static vfloat density(const portals *all, const vvec3 *p, const vvec3 *n, const vvec3 *wi,
                      vfloat total, vmask active)
{
    vfloat sum = vsplat(0.0f);
    for (int i = 0; i < all->count; i++) {
        const facade *f = &all->facades[i];
        vvec3 place = turn(&f->table, p), normal = turn(&f->table, n), w = turn(&f->table, wi);
        if (!vany(active & (w.z > GRAZING)))
            continue;
        for (int k = f->first; k < f->first + f->count; k++) {
            portal_view v = look(&all->all[k], &place);
            vmask through = active & crosses(&v, &w);
            if (!vany(through))
                continue;
            portal_box box;
            portal_table_box(&f->table, &v, through, &box);
            vfloat chance = box.light * highest(&v, &normal);
            vmask drawn   = box.seen & (chance > 0.0f);
            vfloat of_one = portal_table_density(&f->table, &box, &w, drawn);
            sum           = sum + vkeep(drawn, chance / total * of_one);
        }
    }
    return sum;
}

/* A direction through one portal, zero in lanes that rounding leaves without one. */
static vvec3 direction(const portals *all, const placed *d, const vvec3 *p, vfloat s, vfloat t,
                       vmask active)
{
    const facade *f = &all->facades[d->facade];
    vvec3 place     = turn(&f->table, p);
    portal_view v   = look(d, &place);
    portal_box box;
    portal_table_box(&f->table, &v, active, &box);
    vvec3 w  = portal_table_draw(&f->table, &box, s, t);
    vvec3 wi = turn_back(&f->table, &w);
    wi       = vnormalize(wi);
    w        = turn(&f->table, &wi);

    /* Where rounding took it past the frame: to the middle of it */
    vmask past = box.seen & ~crosses(&v, &w);
    if (vany(past)) {
        vvec3 to     = { v.x, v.y, v.z };
        vvec3 middle = vnormalize(turn_back(&f->table, &to));
        wi           = vselect3(past, middle, wi);
    }
    return vkeep3(box.seen, wi);
}

vmask portals_sample(const portals *all, const vvec3 *p, const vvec3 *n, vfloat pick, vfloat s,
                     vfloat t, vmask active, vvec3 *wi, vfloat *pdf)
{
    drawing d   = draw_portal(all, p, n, pick, active);
    vmask drawn = active & (d.total > 0.0f);
    *wi         = (vvec3){ 0 };

    vmask left = drawn;
    while (vany(left)) {
        int which;
        vmask same = vtake_same(d.portal, &left, &which);
        vvec3 to   = direction(all, &all->all[which], p, vkeep(same, s), vkeep(same, t), same);
        *wi        = vselect3(same, to, *wi);
    }
    *pdf  = density(all, p, n, wi, d.total, drawn);
    drawn = drawn & (*pdf > 0.0f) & (*pdf < INFINITY);
    *pdf  = vkeep(drawn, *pdf);
    *wi   = vkeep3(drawn, *wi);
    return drawn;
}

vfloat portals_pdf(const portals *all, const vvec3 *p, const vvec3 *n, const vvec3 *wi,
                   vmask active)
{
    vmask through = portals_cross(all, p, wi, active);
    if (!vany(through))
        return vsplat(0.0f);
    drawing d  = draw_portal(all, p, n, vsplat(0.0f), through);
    vfloat pdf = density(all, p, n, wi, d.total, through & (d.total > 0.0f));
    return vkeep((pdf > 0.0f) & (pdf < INFINITY), pdf);
}

vmask portals_cross(const portals *all, const vvec3 *p, const vvec3 *wi, vmask active)
{
    vmask found = ~ALL_LANES;
    for (int i = 0; i < all->count; i++) {
        const facade *f = &all->facades[i];
        vvec3 place = turn(&f->table, p), w = turn(&f->table, wi);
        vmask out = active & (w.z > GRAZING);
        for (int k = f->first; k < f->first + f->count && vany(out & ~found); k++) {
            portal_view v = look(&all->all[k], &place);
            vmask through = out & ~found & crosses(&v, &w);
            if (!vany(through))
                continue;
            portal_box box;
            portal_table_box(&f->table, &v, through, &box);
            found = found | box.seen;
        }
    }
    return found;
}

/* ---- making --------------------------------------------------------------------------------- */

/* Of all tables: the more orientations there are, the fewer cells has each. */
static const size_t MOST_BYTES = 16 << 20;
enum { MOST_CELLS = 256, FEWEST_CELLS = 16 };

/* rad, about. Portals that are turned against each other by less share a frame: of one wall, as
 * floats have it. */
static const float SAME = 4e-6f;

static vec3 unit(vec3 a) { return v3_scale(a, 1.0f / v3_length(a)); }

static bool alike(vec3 a, vec3 b)
{
    vec3 off = { a.x - b.x, a.y - b.y, a.z - b.z };
    return v3_length(off) < SAME;
}

static portal_table frame_of(const portal *p)
{
    vec3 u = unit(p->u), outward = unit(p->outward), v = v3_cross(outward, u);
    return (portal_table){ .u       = u,
                           .v       = unit(v3_dot(v, p->v) < 0.0f ? v3_scale(v, -1.0f) : v),
                           .outward = outward };
}

static placed place(const portal *p, const portal_table *t, int which)
{
    return (placed){ .x      = v3_dot(p->centre, t->u),
                     .y      = v3_dot(p->centre, t->v),
                     .z      = v3_dot(p->centre, t->outward),
                     .half_x = v3_length(p->u),
                     .half_y = v3_length(p->v),
                     .facade = which };
}

/* A facade for each orientation, how many; of[i] becomes that of portal i. */
static int find_facades(facade *facades, int *of, const portal *list, int count)
{
    int found = 0;
    for (int i = 0; i < count; i++) {
        portal_table t = frame_of(&list[i]);
        int k          = 0;
        while (k < found && !(alike(facades[k].table.u, t.u) && alike(facades[k].table.v, t.v) &&
                              alike(facades[k].table.outward, t.outward)))
            k++;
        if (k == found)
            facades[found++].table = t;
        facades[k].count++;
        of[i] = k;
    }
    return found;
}

/* Portals in the order of their facades. */
static void place_all(placed *all, facade *facades, int facade_count, const int *of,
                      const portal *list, int count)
{
    int at = 0;
    for (int k = 0; k < facade_count; k++) {
        facades[k].first = at;
        for (int i = 0; i < count; i++)
            if (of[i] == k)
                all[at++] = place(&list[i], &facades[k].table, k);
    }
}

static int cells_for(int facades)
{
    size_t cells = MOST_CELLS;
    while (cells > FEWEST_CELLS &&
           (size_t)facades * sizeof(int32_t) * (cells + 1) * (cells + 1) > MOST_BYTES)
        cells /= 2;
    return (int)cells;
}

static bool fill_tables(arena *a, facade *facades, int count, const brightness *bright,
                        lux_error *err)
{
    for (int i = 0; i < count; i++) {
        facades[i].table.cells = cells_for(count);
        if (!portal_table_fill(a, &facades[i].table, bright, err))
            return false;
    }
    return true;
}

const portals *portals_new(arena *a, const portal *list, int count, const sky *const *skies,
                           int sky_count, lux_error *err)
{
    arena scratch     = { 0 };
    brightness bright = { 0 };
    portals *all      = arena_new(a, portals, err);
    facade *facades   = all ? arena_array(a, facade, (size_t)count, err) : NULL;
    placed *places    = facades ? arena_array(a, placed, (size_t)count, err) : NULL;
    int *of           = places ? arena_array(&scratch, int, (size_t)count, err) : NULL;
    bool done         = of && brightness_of(&scratch, &bright, skies, sky_count, err);
    if (done) {
        *all = (portals){ find_facades(facades, of, list, count), facades, places };
        place_all(places, facades, all->count, of, list, count);
        done = fill_tables(a, facades, all->count, &bright, err);
    }
    arena_clear(&scratch);
    return done ? all : NULL;
}
