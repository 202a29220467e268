/* core/surface.c -- see world.h: where a hit is, how exactly that is known, and what is there.
 *
 * A position is made of the triangle's corners, as the triangle is where it is whatever the
 * ray's rounding was; how far it may be off is bounded by counting roundings, each of at most
 * 2^-24 of the result (Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., 6.8).
 */
#include "core/place.h"

#define ROUNDINGS(n) ((float)(n)*0x1p-24f)

/* With all numbers replaced by their sizes: how large what is rounded can be. */
static void matrix_sizes(vfloat to[3][4], const vfloat m[3][4])
{
    for (int i = 0; i < 12; i++)
        to[i / 4][i % 4] = vabs(m[i / 4][i % 4]);
}

/* Weights of the corners, none below `least`, which is 1/3 at most. */
static void keep_off_edges(vfloat w[3], vfloat least)
{
    const float third = 1.0f / 3.0f;
    vfloat lowest     = vmin(w[0], vmin(w[1], w[2]));
    vfloat room       = vmax(third - lowest, vsplat(0x1p-24f));
    vfloat pull       = vmin(vmax(least - lowest, vsplat(0.0f)) / room, vsplat(1.0f));
    for (int i = 0; i < 3; i++)
        w[i] = w[i] + pull * (third - w[i]);
}

/* `height` is what the triangle's least height may be, in the mesh. */
static void place_position(const vplace *p, const vhit *hit, vfloat height, vsurface *out)
{
    vvec3 a = place_corner(p, 0), b = place_corner(p, 1), c = place_corner(p, 2);

    /* By 3 products, 2 sums and a weight that is off by 2 roundings. By the largest corner, not
     * by their mean: a ray from here is tested against the corners as they are. */
    vvec3 size  = { vmax(vabs(a.x), vmax(vabs(b.x), vabs(c.x))),
                    vmax(vabs(a.y), vmax(vabs(b.y), vabs(c.y))),
                    vmax(vabs(a.z), vmax(vabs(b.z), vabs(c.z))) };
    vvec3 error = vscale(size, vsplat(ROUNDINGS(6)));

    /* To the world: the matrix is rounded, and 3 products and 3 sums. And back, as a ray that
     * starts here is. */
    vfloat there[3][4], back[3][4];
    vfloat one = vsplat(1.0f), zero = vsplat(0.0f);
    bool as_it_is = vall(p->identity);
    if (!as_it_is) {
        matrix_sizes(there, p->to_world);
        matrix_sizes(back, p->to_mesh);
        vvec3 world_size = place_moved(there, size, one);
        vvec3 mesh_size  = place_moved(back, world_size, one);
        vvec3 further    = vscale(mesh_size, vsplat(ROUNDINGS(10)));
        error            = vadd(error, vkeep3(~p->identity, further));
    }

    /* Not nearer to an edge than that error: else rays that start here might pass the edge of
     * the next triangle on the outside. */
    vfloat w[3] = { 1.0f - hit->u - hit->v, hit->u, hit->v };
    keep_off_edges(w, 2.0f * place_largest(error) / height);
    vvec3 at = vadd(vadd(vscale(a, w[0]), vscale(b, w[1])), vscale(c, w[2]));

    out->position = at;
    out->error    = place_largest(error);
    if (!as_it_is) {
        vfloat moved_error = place_largest(place_moved(there, error, zero));
        out->position      = vselect3(p->identity, at, place_moved(p->to_world, at, one));
        out->error         = vselect(p->identity, out->error, moved_error);
    }
}

void world_surface(const world *w, const vhit *hit, vmask active, vsurface *out)
{
    active &= hit->instance >= vsplat_int(0);
    vplace p;
    vfloat height;
    vsurface s;
    place_find(w, hit, active, &p);
    vvec3 normal = place_normal(&p, place_front(&p, active, &height));
    place_position(&p, hit, height, &s);
    out->position = vkeep3(active, s.position);
    out->error    = vkeep(active, s.error);
    out->normal   = vkeep3(active, normal);
    out->material = p.material;
}

/* The next float in the direction of `way`. */
static inline vfloat next_toward(vfloat a, vfloat way)
{
    vint bits  = vas_int(a + 0.0f); /* -0 is +0 */
    vint up    = vselect_int(bits < 0, bits - 1, bits + 1);
    vint down  = vselect_int(bits > 0, bits - 1,
                             vselect_int(bits == 0, vsplat_int(INT32_MIN + 1), bits + 1));
    vint moved = vselect_int(way > 0.0f, up, down);
    return vselect(way != 0.0f, vas_float(moved), a);
}

/* How many errors a start is moved off: one is the position's own; as much again for the
 * rounding of the normal and of the start itself. */
static const float errors_off = 2.0f;

vvec3 vray_start(const vsurface *from, const vvec3 *direction)
{
    vvec3 n      = from->normal;
    vfloat off   = errors_off * from->error * (vabs(n.x) + vabs(n.y) + vabs(n.z));
    vvec3 offset = vscale(n, vcopysign(off, vdot(n, *direction)));
    vvec3 p      = vadd(from->position, offset);
    return (vvec3){ next_toward(p.x, offset.x), next_toward(p.y, offset.y),
                    next_toward(p.z, offset.z) };
}
