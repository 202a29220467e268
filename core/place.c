/* core/place.c -- see place.h. */
#include "core/place.h"

void place_find(const world *w, const vhit *hit, vmask active, vplace *out)
{
    float corner[9][LANES] = { { 0 } }, to_world[12][LANES] = { { 0 } };
    float to_mesh[12][LANES] = { { 0 } };
    int32_t material[LANES] = { 0 }, moved[LANES] = { 0 }, mirrors[LANES] = { 0 };
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
        moved[i]    = !at->identity;
        mirrors[i]  = at->mirrors;
    }
    for (int k = 0; k < 9; k++)
        out->corner[k] = vload(corner[k]);
    for (int k = 0; k < 12; k++) {
        out->to_world[k / 4][k % 4] = vload(to_world[k]);
        out->to_mesh[k / 4][k % 4]  = vload(to_mesh[k]);
    }
    out->material = vload_int(material);
    out->identity = vload_int(moved) == vsplat_int(0);
    out->mirrors  = vload_int(mirrors) != vsplat_int(0);
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

vvec3 place_front(const vplace *p, vmask active, vfloat *height)
{
    /* Edges of about 1 m, so that no product leaves the range of a float */
    vvec3 a        = vsub(place_corner(p, 1), place_corner(p, 0));
    vvec3 b        = vsub(place_corner(p, 2), place_corner(p, 0));
    vfloat a_size  = place_largest(a);
    vfloat b_size  = place_largest(b);
    vvec3 n        = vcross(vscale(a, 1.0f / a_size), vscale(b, 1.0f / b_size));
    vfloat squared = vdot(n, n);
    *height        = 0.25f * vsqrt(squared) * vmin(a_size, b_size);

    const float sine_squared = 1e-3f; /* below, rounding would turn it by more than 2e-6 */
    vmask thin               = active & ~(squared > sine_squared);
    return vany(thin) ? thin_normals(p, thin, n) : n;
}

vvec3 place_normal(const vplace *p, vvec3 n)
{
    if (!vall(p->identity)) {
        const vfloat(*m)[4] = p->to_mesh;

        vvec3 t = { m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z,
                    m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
                    m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z };
        t       = vscale(t, 1.0f / place_largest(t));
        n       = vselect3(p->identity, n, t);
    }
    return vnormalize(n);
}

vvec3 place_vector(const vplace *p, vvec3 a)
{
    if (vall(p->identity))
        return a;
    return vselect3(p->identity, a, place_moved(p->to_world, a, vsplat(0.0f)));
}
