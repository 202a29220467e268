/* materials/ggx.c -- see ggx.h. */
#include "materials/ggx.h"

#include "core/packet_math.h"

/* The cell of x, in cells from 0 on, and how far into it; NaN is in the first. */
static vint cell_of(vfloat x, int cells, vfloat *part)
{
    x          = vmin(vmax(x, vsplat(0.0f)), vsplat((float)cells));
    vint whole = vto_int(vmin(x, vsplat((float)(cells - 1))));
    *part      = x - vto_float(whole);
    return whole;
}

static vfloat between(const float *table, vint at, vfloat part)
{
    return vlerp(vgather(table, at), vgather(table, at + 1), part);
}

vggx vggx_of(vfloat roughness, vmask active)
{
    vfloat r = vmin(vmax(roughness, vsplat(GGX_LEAST_ROUGHNESS)), vsplat(1.0f));
    vggx g   = { .alpha = r * r, .roughness = r };

    const float rows = (GGX_ROWS - 1) / (1.0f - GGX_LEAST_ROOT);
    vfloat x         = vkeep(active, vsqrt(r) - GGX_LEAST_ROOT) * rows;
    vfloat part;
    g.row           = cell_of(x, GGX_ROWS - 1, &g.below_next);
    vint mean       = cell_of(x * (float)GGX_MEAN_STEPS, GGX_MEANS - 1, &part);
    g.mean.loss     = between(ggx_mean_loss, mean, part);
    g.mean.schlick  = between(ggx_mean_schlick, mean, part);
    g.columns_scale = (GGX_COLUMNS - 1) / vlog2(1.0f + GGX_COLUMN_SCALE / r);
    return g;
}

/* Lagrange's weights of four even places for f past the second one. */
static void cubic_weights(vfloat f, vfloat w[4])
{
    w[0] = f * (f - 1.0f) * (f - 2.0f) * (-1.0f / 6.0f);
    w[1] = (f + 1.0f) * (f - 1.0f) * (f - 2.0f) * 0.5f;
    w[2] = (f + 1.0f) * f * (f - 2.0f) * -0.5f;
    w[3] = (f + 1.0f) * f * (f - 1.0f) * (1.0f / 6.0f);
}

static vfloat along_row(const float *table, vint at, const vfloat w[4])
{
    return w[0] * vgather(table, at) + w[1] * vgather(table, at + 1) +
           w[2] * vgather(table, at + 2) + w[3] * vgather(table, at + 3);
}

vggx_share vggx_shares(const vggx *g, vfloat m, vmask active)
{
    /* The first of four columns about y: at the ends of a row there are none beyond */
    vfloat c = GGX_COLUMN_SCALE * vsqrt(vmax(m, vsplat(0.0f))) / g->roughness;
    vfloat y = vkeep(active, vlog2(1.0f + c) * g->columns_scale);
    vfloat part, w[4];
    vint first = cell_of(y - 1.0f, GGX_COLUMNS - 3, &part);
    cubic_weights(y - 1.0f - vto_float(first), w); /* part, but below 0 in the first cell */

    vint at = g->row * GGX_COLUMNS + first;
    vfloat loss =
        vlerp(along_row(ggx_loss, at, w), along_row(ggx_loss, at + GGX_COLUMNS, w), g->below_next);
    vfloat schlick = vlerp(along_row(ggx_schlick, at, w),
                           along_row(ggx_schlick, at + GGX_COLUMNS, w), g->below_next);
    vggx_share s;
    s.loss    = vmin(vmax(loss, vsplat(0.0f)), vsplat(1.0f));
    s.schlick = vmin(vmax(schlick, vsplat(0.0f)), 1.0f - s.loss);
    return s;
}

vvec3 vggx_draw_facet(const vggx *g, vvec3 wo, vfloat u, vfloat v)
{
    /* Seen from there on the half sphere */
    vvec3 o = vnormalize((vvec3){ g->alpha * wo.x, g->alpha * wo.y, wo.z });

    /* A mirrored direction within the cap above -o.z, and the half way between it and o */
    vfloat phi  = 6.28318531f * u;
    vfloat up   = (1.0f - v) * (1.0f + o.z);
    vfloat z    = up - o.z;
    vfloat side = vsqrt(vmax(1.0f - z * z, vsplat(0.0f)));
    vvec3 h     = { side * vcos(phi) + o.x, side * vsin(phi) + o.y, up };

    return vnormalize((vvec3){ g->alpha * h.x, g->alpha * h.y, h.z });
}

vfloat vggx_draw_lossy(const vggx *g, vfloat u)
{
    vfloat alpha2 = g->alpha * g->alpha;
    vfloat grown  = vexp2(u * vlog2(1.0f + 1.0f / alpha2));
    return vmin(g->alpha * vsqrt(vmax(grown - 1.0f, vsplat(0.0f))), vsplat(1.0f));
}

vfloat vggx_lossy_pdf(const vggx *g, vfloat m)
{
    vfloat alpha2 = g->alpha * g->alpha;
    vfloat log    = 0.693147181f * vlog2(1.0f + 1.0f / alpha2);
    return m * 0.318309886f / ((alpha2 + m * m) * log);
}
