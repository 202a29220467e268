/* materials/bsdf_lookup.c -- where pairs of directions are in a BSDF, matrix or tree, and back. */
#include "materials/bsdf_parts.h"

#define PI 3.14159265358979323846

static vint whole(vfloat place, int log2) { return vto_int(place * (float)(1 << log2)); }

static vint tensor_row_of(const bsdf *b, const vfloat at[4])
{
    vint row = whole(at[0], b->in_log2);
    return b->rank == 3 ? row : (row << b->in_log2) + whole(at[1], b->in_log2);
}

vbsdf_place vbsdf_find(const bsdf *b, const vvec3 *in, const vvec3 *out)
{
    vbsdf_place p = { 0 };
    if (b->rank == 0) {
        p.row  = vklems_cell(&b->basis, in->x, in->y, in->z);
        p.cell = vklems_cell(&b->basis, out->x, out->y, out->z);
        return p;
    }
    vtensor_place(b->rank, in, out, p.at);
    p.row  = tensor_row_of(b, p.at);
    p.cell = (whole(p.at[b->rank - 2], b->out_log2) << b->out_log2) +
             whole(p.at[b->rank - 1], b->out_log2);
    return p;
}

vint vbsdf_row(const bsdf *b, const vvec3 *in)
{
    if (b->rank == 0)
        return vklems_cell(&b->basis, in->x, in->y, in->z);
    vfloat at[4];
    vtensor_place(b->rank, in, in, at);
    return tensor_row_of(b, at);
}

vfloat vbsdf_value(const bsdf *b, bsdf_side_name side, bsdf_part part, const vbsdf_place *p,
                   vmask active)
{
    const bsdf_side *s = &b->side[side];
    if (b->rank > 0)
        return vtensor_value(s->tree[part], p->at, active);
    vint at = vkeep_int(active, p->row * b->cells + p->cell);
    return vkeep(active, vgather(s->value[part], at));
}

vvec3 vbsdf_direction(const bsdf *b, const vvec3 *in, vint cell, vfloat u, vfloat v)
{
    if (b->rank == 0)
        return vklems_direction(&b->basis, cell, u, v);
    const float size = 1.0f / (float)(1 << b->out_log2);
    vint mask        = vsplat_int((1 << b->out_log2) - 1);
    vfloat s         = (vto_float(cell >> b->out_log2) + u) * size;
    vfloat t         = (vto_float(cell & mask) + v) * size;
    vvec3 out;
    vsquare_to_disk(s, t, &out.x, &out.y);
    out.z = vsqrt(vmax(1.0f - out.x * out.x - out.y * out.y, vsplat(0.0f)));
    if (b->rank == 4)
        return out;
    vfloat r = vsqrt(in->x * in->x + in->y * in->y);
    vfloat c = vselect(r > 0.0f, in->x / r, vsplat(1.0f));
    vfloat d = vkeep(r > 0.0f, in->y / r);
    return (vvec3){ out.x * c - out.y * d, out.y * c + out.x * d, out.z };
}

vfloat vbsdf_area(const bsdf *b, vint cell)
{
    if (b->rank == 0)
        return vklems_area(&b->basis, cell);
    return vsplat((float)(PI / (double)(1 << 2 * b->out_log2)));
}
