/* core/detail.c -- see world.h: texture coordinates and smooth normals where a hit is.
 *
 * From corner 0 the triangle's edges a and b lead in the picture by (u1, v1) and (u2, v2), so that
 *
 *   dP/du = (v2 a - v1 b) / d       dP/du x dP/dv = (a x b) / d
 *   dP/dv = (u1 b - u2 a) / d       d = u1 v2 - u2 v1, twice the area in the picture
 *
 * Hence along_u, and that v grows along normal x along_u where d > 0: a x b is along the normal,
 * unless the instance's matrix mirrors.
 */
#include "core/place.h"

#include <float.h>

/* What meshes say of the corners of each lane's triangle; 0 where they say nothing. */
typedef struct vattributes {
    vfloat texcoord[2][6], normal[9];
    bool smooth; /* some lane's mesh has normals */
} vattributes;

static void attributes_find(const world *w, const vhit *hit, vmask active, vattributes *out)
{
    float texcoord[12][LANES] = { { 0 } }, normal[9][LANES] = { { 0 } };
    out->smooth = false;
    for (int i = 0; i < LANES; i++) {
        if (!(vbits(active) >> i & 1))
            continue;
        const solid *s  = &w->meshes[w->instances[lane(hit->instance, i)].mesh];
        size_t triangle = (size_t)lane(hit->triangle, i);
        for (size_t k = 0; k < 12; k++)
            if (s->texcoord[k / 6])
                texcoord[k][i] = s->texcoord[k / 6][6 * triangle + k % 6];
        for (size_t k = 0; s->normals && k < 9; k++)
            normal[k][i] = s->normals[9 * triangle + k];
        out->smooth = out->smooth || s->normals;
    }
    for (int k = 0; k < 12; k++)
        out->texcoord[k / 6][k % 6] = vload(texcoord[k]);
    for (int k = 0; k < 9; k++)
        out->normal[k] = vload(normal[k]);
}

/* The triangle in the world, its longest edge about 1 so that no product leaves the range of a
 * float, and the hit's place in it. */
typedef struct vfacet {
    vfloat weight[3]; /* of the corners */
    vvec3 a, b;       /* edges from corner 0, over size */
    vfloat size;      /* m */
    vfloat area;      /* twice it, over size^2, > 0 */
    vvec3 normal;     /* unit, on the front side */
    vmask mirrors;    /* the instance's matrix does */
} vfacet;

static void facet_make(const vplace *p, const vhit *hit, vvec3 normal, vfacet *f)
{
    const float rounding =
        0x1p-24f; /* of the longest edge's square: areas below it are only that */
    vvec3 a      = place_vector(p, vsub(place_corner(p, 1), place_corner(p, 0)));
    vvec3 b      = place_vector(p, vsub(place_corner(p, 2), place_corner(p, 0)));
    f->size      = vmax(place_largest(a), place_largest(b));
    f->a         = vscale(a, 1.0f / f->size);
    f->b         = vscale(b, 1.0f / f->size);
    f->area      = vmax(vlength(vcross(f->a, f->b)), vsplat(rounding));
    f->normal    = normal;
    f->mirrors   = p->mirrors;
    f->weight[0] = 1.0f - hit->u - hit->v;
    f->weight[1] = hit->u;
    f->weight[2] = hit->v;
}

/* t: u and v of each corner. */
static void set_detail(const vfacet *f, const vfloat t[6], vmask active, int set, vdetail *out)
{
    const vfloat *w = f->weight;
    out->u[set]     = vkeep(active, w[0] * t[0] + w[1] * t[2] + w[2] * t[4]);
    out->v[set]     = vkeep(active, w[0] * t[1] + w[1] * t[3] + w[2] * t[5]);

    /* The edges in the picture, the longest about 1 */
    vfloat u1 = t[2] - t[0], v1 = t[3] - t[1], u2 = t[4] - t[0], v2 = t[5] - t[1];
    vfloat size = vmax(vmax(vabs(u1), vabs(v1)), vmax(vabs(u2), vabs(v2)));
    vfloat over = 1.0f / size;
    u1 *= over, v1 *= over, u2 *= over, v2 *= over;

    /* Twice the area, which is none where four roundings of what it is made of might be all */
    vfloat p = u1 * v2, q = u2 * v1;
    vfloat d = p - q;
    active &= vabs(d) > 4.0f * 0x1p-24f * (vabs(p) + vabs(q));
    vfloat ratio    = size / f->size * vsqrt(vabs(d) / f->area);
    out->scale[set] = vkeep(active, vmin(ratio, vsplat(FLT_MAX)));

    /* In the plane, which rounding may have left where the triangle is thin */
    vvec3 along = vscale(vsub(vscale(f->a, v2), vscale(f->b, v1)), vcopysign(vsplat(1.0f), d));
    along       = vscale(along, 1.0f / place_largest(along));
    along       = vsub(along, vscale(f->normal, vdot(f->normal, along)));
    along       = vnormalize(along);
    active &= vdot(along, along) > 0.5f; /* neither 0 nor NaN */
    out->along_u[set] = vkeep3(active, along);

    vmask same         = d > 0.0f;
    out->mirrored[set] = active & ((same & ~f->mirrors) | (~same & f->mirrors));
}

/* `front`: a normal of the triangle in the mesh. */
static vvec3 smooth_normal(const vplace *p, const vfacet *f, const vfloat n[9], vvec3 front)
{
    /* Opposite normals leave nothing but rounding, which must not turn what is left by over 1e-4 */
    const float least = 1e-3f;
    vvec3 flat = vnormalize(front), sum = { 0 };
    vmask given = ~ALL_LANES;
    for (int i = 0; i < 3; i++) {
        vvec3 at   = { n[3 * i], n[3 * i + 1], n[3 * i + 2] };
        vmask none = (at.x == 0.0f) & (at.y == 0.0f) & (at.z == 0.0f);
        sum        = vadd(sum, vscale(vselect3(none, flat, at), f->weight[i]));
        given |= ~none;
    }

    /* NaN compares false */
    vvec3 normal = place_normal(p, sum);
    vmask good   = given & (vdot(sum, sum) > least * least) & (vdot(normal, f->normal) > 0.0f);
    return vselect3(good, normal, f->normal);
}

void world_detail(const world *w, const vhit *hit, vmask active, vdetail *out)
{
    active &= hit->instance >= vsplat_int(0);
    vplace p;
    vattributes said;
    vfacet f;
    vfloat height;
    place_find(w, hit, active, &p);
    attributes_find(w, hit, active, &said);
    vvec3 front = place_front(&p, active, &height);
    facet_make(&p, hit, place_normal(&p, front), &f);
    vvec3 normal = said.smooth ? smooth_normal(&p, &f, said.normal, front) : f.normal;
    out->normal  = vkeep3(active, normal);
    for (int set = 0; set < 2; set++)
        set_detail(&f, said.texcoord[set], active, set, out);
}
