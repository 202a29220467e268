/* core/surface.c -- see world.h: where a hit is, how exactly that is known, and what is there.
 *
 * A position is made of the triangle's corners, as the triangle is where it is whatever the
 * ray's rounding was; how far it may be off is bounded by counting roundings, each of at most
 * 2^-24 of the result (Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., 6.8).
 *
 * The normal goes by the transposed inverse: it so points to where the matrix takes the mesh's
 * front side, mirrored or not.
 */
#include "core/trace.h"

#define ROUNDINGS(n) ((float)(n)*0x1p-24f)

/* What there is to know of each lane's triangle and instance. */
typedef struct vplace {
    vfloat corner[9];
    vfloat to_world[3][4], to_mesh[3][4];
    vint material;
    bool identity; /* of all lanes */
} vplace;

static vplace place_of(const world *w, const vhit *hit, vmask active)
{
    float corner[9][LANES] = { { 0 } }, to_world[12][LANES] = { { 0 } };
    float to_mesh[12][LANES] = { { 0 } };
    int32_t material[LANES]  = { 0 };
    vplace p                 = { .identity = true };
    for (int i = 0; i < LANES; i++) {
        if (!(vbits(active) >> i & 1))
            continue;
        const placed *at = &w->instances[lane(hit->instance, i)];
        const solid *s   = &w->meshes[at->mesh];
        size_t triangle  = (size_t)lane(hit->triangle, i);
        for (size_t k = 0; k < 9; k++)
            corner[k][i] = s->corners[9 * triangle + k];
        for (int k = 0; k < 12; k++) {
            to_world[k][i] = at->to_world[k / 4][k % 4];
            to_mesh[k][i]  = at->to_mesh[k / 4][k % 4];
        }
        material[i] = s->material ? (int32_t)s->material[triangle] : 0;
        p.identity  = p.identity && at->identity;
    }
    for (int k = 0; k < 9; k++)
        p.corner[k] = vload(corner[k]);
    for (int k = 0; k < 12; k++) {
        p.to_world[k / 4][k % 4] = vload(to_world[k]);
        p.to_mesh[k / 4][k % 4]  = vload(to_mesh[k]);
    }
    p.material = vload_int(material);
    return p;
}

static inline vfloat row(const vfloat m[4], vvec3 a, vfloat one)
{
    return m[0] * a.x + m[1] * a.y + m[2] * a.z + m[3] * one;
}
static inline vvec3 moved(const vfloat m[3][4], vvec3 a, vfloat one)
{
    return (vvec3){ row(m[0], a, one), row(m[1], a, one), row(m[2], a, one) };
}
static inline vfloat largest(vvec3 a) { return vmax(vabs(a.x), vmax(vabs(a.y), vabs(a.z))); }
static inline vvec3 corner(const vplace *p, int i)
{
    return (vvec3){ p->corner[3 * i], p->corner[3 * i + 1], p->corner[3 * i + 2] };
}

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
    vvec3 a = corner(p, 0), b = corner(p, 1), c = corner(p, 2);

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
    if (!p->identity) {
        matrix_sizes(there, p->to_world);
        matrix_sizes(back, p->to_mesh);
        vvec3 world_size = moved(there, size, one);
        vvec3 mesh_size  = moved(back, world_size, one);
        error            = vadd(error, vscale(mesh_size, vsplat(ROUNDINGS(10))));
    }

    /* Not nearer to an edge than that error: else rays that start here might pass the edge of
     * the next triangle on the outside. */
    vfloat w[3] = { 1.0f - hit->u - hit->v, hit->u, hit->v };
    keep_off_edges(w, 2.0f * largest(error) / height);
    vvec3 at = vadd(vadd(vscale(a, w[0]), vscale(b, w[1])), vscale(c, w[2]));

    out->position = p->identity ? at : moved(p->to_world, at, one);
    out->error    = largest(p->identity ? error : moved(there, error, zero));
}

/* Of a triangle so thin that single precision loses its plane. */
static dvec3 thin_normal(const vplace *p, int lane_number)
{
    double c[9];
    for (int k = 0; k < 9; k++)
        c[k] = (double)lane(p->corner[k], lane_number);
    dvec3 a = { c[3] - c[0], c[4] - c[1], c[5] - c[2] };
    dvec3 b = { c[6] - c[0], c[7] - c[1], c[8] - c[2] };
    dvec3 n = d3_cross(d3_scale(a, 1.0 / d3_length(a)), d3_scale(b, 1.0 / d3_length(b)));
    return d3_scale(n, 1.0 / d3_length(n));
}

static vvec3 thin_normals(const vplace *p, vmask thin, vvec3 n)
{
    float x[LANES], y[LANES], z[LANES];
    for (int i = 0; i < LANES; i++) {
        x[i] = lane(n.x, i), y[i] = lane(n.y, i), z[i] = lane(n.z, i);
        if (!(vbits(thin) >> i & 1))
            continue;
        vec3 exact = d3_to_float(thin_normal(p, i));
        x[i] = exact.x, y[i] = exact.y, z[i] = exact.z;
    }
    return (vvec3){ vload(x), vload(y), vload(z) };
}

static vvec3 place_normal(const vplace *p, vmask active, vfloat *height)
{
    /* Edges of about 1 m, so that no product leaves the range of a float */
    vvec3 a        = vsub(corner(p, 1), corner(p, 0));
    vvec3 b        = vsub(corner(p, 2), corner(p, 0));
    vfloat a_size  = largest(a);
    vfloat b_size  = largest(b);
    vvec3 n        = vcross(vscale(a, 1.0f / a_size), vscale(b, 1.0f / b_size));
    vfloat squared = vdot(n, n);
    *height        = 0.25f * vsqrt(squared) * vmin(a_size, b_size);

    const float sine_squared = 1e-3f; /* below, rounding would turn it by more than 2e-6 */
    vmask thin               = active & ~(squared > sine_squared);
    if (vany(thin))
        n = thin_normals(p, thin, n);
    if (!p->identity) {
        const vfloat(*m)[4] = p->to_mesh;

        n = (vvec3){ m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z,
                     m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
                     m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z };
        n = vscale(n, 1.0f / largest(n));
    }
    return vnormalize(n);
}

void world_surface(const world *w, const vhit *hit, vmask active, vsurface *out)
{
    active &= hit->instance >= vsplat_int(0);
    vplace p = place_of(w, hit, active);
    vfloat height;
    vvec3 normal = place_normal(&p, active, &height);
    vsurface s;
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
