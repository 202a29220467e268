/* sim/map_aim.c -- see map_aim.h: particles that are drawn.
 *
 * One net of two coordinates (x, y) picks the cell and the place in it: x the block, then its
 * piece, and what is left of x with y the place, so that places in each cell are even together. x
 * has 24 digits; below them it is filled up by others.
 */
#include "sim/map_aim_parts.h"

#include "core/color.h"
#include "core/distribution.h"

/* As in emission.c */
static const float ahead = 0x1p-16f;

/* Of distances: roundings of both ends and of the direction, some of each. */
static const float off = 0x1p-20f;

static vvec3 corner_of(const aim_cut *c, vint piece, int corner)
{
    const int stride = sizeof(aim_piece) / sizeof(float);
    const float *at  = &c->piece[0].corner[corner].x;
    vint i           = piece * stride;
    return (vvec3){ vgather(at, i), vgather(at + 1, i), vgather(at + 2, i) };
}

/* E. Heitz, "A Low-Distortion Map Between Triangle and Square", 2019. */
vvec3 aim_place(const aim_cut *c, vint piece, vfloat a, vfloat b, vvec3 *normal)
{
    vmask upper = b > a;
    vfloat u    = vselect(upper, 0.5f * a, a - 0.5f * b);
    vfloat v    = vselect(upper, b - 0.5f * a, 0.5f * b);
    vvec3 p     = corner_of(c, piece, 0);
    vvec3 along = vsub(corner_of(c, piece, 1), p), up = vsub(corner_of(c, piece, 2), p);
    *normal = vnormalize(vcross(along, up));
    return vadd(p, vadd(vscale(along, u), vscale(up, v)));
}

/* The piece of a block that u falls into; in *rest how far into it. */
static vint draw_piece(const aim_cut *c, vint block, vfloat u, vfloat *rest, vfloat *share)
{
    vint low  = vgather_int(c->first, block);
    vint high = vgather_int(c->first, block + 1);
    while (vany(high - low > 1)) {
        vint mid   = low + ((high - low) >> 1);
        vmask over = vgather(c->from, mid) <= u;
        vmask wide = high - low > 1;
        low        = vselect_int(wide & over, mid, low);
        high       = vselect_int(wide & ~over, mid, high);
    }
    *share = vgather(c->width, low);
    *rest  = (u - vgather(c->from, low)) / *share;
    return low;
}

static vfloat in_unit(vfloat a) { return vmin(vmax(a, vsplat(0.0f)), vsplat(0x1.fffffep-1f)); }

/* What a source shines on q with. */
static void shine(const map_aim *m, int which, const vvec3 *q, const vsample4 *u, vmask lanes,
                  vlight_sample *of)
{
    const scene *s = m->s;
    vlight_sample e;
    vmask lit = light_sample(s->lights[which], q, u->z, u->w, lanes, &e);
    of->wi    = vselect3(lit, e.wi, of->wi);
    of->dist  = vselect(lit, e.dist, of->dist);
    of->e     = vselect3(lit, e.e, of->e);
}

static void set_out(const map_aim *m, const vvec3 *q, const vlight_sample *of, vmask lit,
                    vparticle *out, vaimed *to)
{
    vfloat whole = vselect(of->dist < INFINITY, of->dist, vsplat(2.0f * m->radius));
    vfloat begin = whole - ahead * vmin(whole, vsplat(m->radius));
    to->distance = vkeep(lit, begin);
    out->ray     = (vray){ vkeep3(lit, valong(*q, of->wi, begin)), vkeep3(lit, vneg(of->wi)),
                           vkeep(lit, vsplat(INFINITY)) };
}

vmask map_aim_draw(const map_aim *m, vuint index, vuint seed, vmask active, vparticle *out,
                   vaimed *to)
{
    *out = (vparticle){ 0 };
    *to  = (vaimed){ .instance = vsplat_int(-1), .triangle = vsplat_int(-1) };
    if (m->sources == 0)
        return (vmask){ 0 };
    const aim_cut *c = &m->cut;
    vsample4 u       = vsobol4(index, seed);
    vsample4 pick    = vsobol4(index, vhash_combine(seed, vsplat_uint(1)));

    /* Source, block, piece, place */
    vfloat x, rest, of_source, of_block, of_piece;
    vint number = vdistribution_draw(m->source_cdf, vsplat_int(0), m->sources,
                                     vkeep(active, pick.x), &rest, &of_source);
    vint block  = vdistribution_draw(m->block_cdf, number * (c->blocks + 1), c->blocks,
                                     vkeep(active, u.x), &x, &of_block);
    x           = in_unit(x + 0x1p-24f * pick.y / of_block);
    vint piece  = draw_piece(c, block, x, &rest, &of_piece);
    vfloat a    = in_unit(rest);
    vvec3 normal, q = aim_place(c, piece, a, u.y, &normal);

    vlight_sample of = { 0 };
    vmask left       = active;
    vint source      = vgather_int(m->source, number);
    while (vany(left)) {
        int which;
        vmask same     = vtake_same(source, &left, &which);
        const scene *s = m->s;
        out->source    = vselect_int(same, vsplat_int(which), out->source);
        out->group     = vselect_int(same, vsplat_int(s->light_info[which].group), out->group);
        out->spare     = vselect_int(same, vsplat_int(s->light_info[which].owner), out->spare);
        shine(m, which, &q, &u, same, &of);
    }
    const int stride = sizeof(aim_piece) / sizeof(int32_t);
    vfloat area      = vgather(&c->piece[0].area, piece * stride);
    vfloat cosine    = vabs(vdot(normal, of.wi));
    vfloat weight    = cosine * area / (of_source * of_block * of_piece);
    out->flux        = vkeep3(active, vscale(of.e, weight));
    vmask lit        = active & (vrgb_luminance(out->flux) > 0.0f);
    out->flux        = vkeep3(lit, out->flux);
    set_out(m, &q, &of, lit, out, to);
    to->instance = vgather_int(&c->piece[0].instance, piece * stride);
    to->triangle = vgather_int(&c->piece[0].triangle, piece * stride);
    to->cell     = number * c->blocks + block;
    return lit;
}

vfloat map_aim_tolerance(const map_aim *m, vfloat distance)
{
    return off * (vabs(distance) + m->radius);
}
