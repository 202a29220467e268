/* materials/brdf_look.c -- tables of reflection in packets: the value for two directions, a
 * direction drawn for one, and how often it is drawn.
 *
 * Half and difference angles (Rusinkiewicz, "A New Change of Variables for Efficient BRDF
 * Representation", 1998), of H = wi + wo, D = wi - wo, and H's horizontal length r:
 *
 *     theta_h = atan2(r, H.z)                theta_d = atan2(|D|, |H|)
 *     phi_d   = atan2(|H| (H x D).z, H.z (H.x D.x + H.y D.y) - r^2 D.z)      [modulo pi]
 *
 * Draws, with `share` = 1/8, or 1 where the table is black; w are wo's weights among the nodes k:
 *
 *     pdf = share cos / pi + (1 - share) sum w_k density_k(cell of wi) / sum w_k albedo_k
 *
 * times cos for cells of projected solid angle, over 4 (wo . h) for those of half vectors.
 */
#include "core/distribution.h"
#include "core/warp.h"
#include "materials/brdf_parts.h"

static const float COSINE_SHARE = 0.125f;

static vfloat vtheta(const brdf *b, const vvec3 *w)
{
    return vbrdf_angle(b, vsqrt(w->x * w->x + w->y * w->y), w->z);
}

/* ---- look-up --------------------------------------------------------------------------------- */

static void find_anisotropic(const brdf *b, const vvec3 *wo, const vvec3 *wi, vbrdf_place *out)
{
    out->axes[0] = vtable_find(&b->axes[0], vtheta(b, wo));
    out->axes[1] = vtable_find(&b->axes[1], vbrdf_angle(b, wo->y, wo->x));
    out->axes[2] = vtable_find(&b->axes[2], vtheta(b, wi));
    out->axes[3] = vtable_find(&b->axes[3], vbrdf_angle(b, wi->y, wi->x));
    out->theta   = out->axes[0];
    out->phi     = out->axes[1];
    out->cell    = out->axes[2].below * b->cells.phis + out->axes[3].below;
    out->to_sr   = wi->z;
}

static void find_isotropic(const brdf *b, const vvec3 *wo, const vvec3 *wi, vbrdf_place *out)
{
    vfloat x, y;
    vbrdf_heading(wo, &x, &y);
    vfloat delta = vbrdf_angle(b, wi->x * y - wi->y * x, wi->x * x + wi->y * y);
    out->axes[0] = vtable_find(&b->axes[0], vtheta(b, wo));
    out->axes[1] = vtable_find(&b->axes[1], vtheta(b, wi));
    out->axes[2] = vtable_find(&b->axes[2], delta);
    out->theta   = out->axes[0];
    out->phi     = (vtable_place){ 0 };
    out->cell    = out->axes[1].below * b->cells.phis + out->axes[2].below;
    out->to_sr   = wi->z;
}

static void find_half(const brdf *b, const vvec3 *wo, const vvec3 *wi, bool drawn, vbrdf_place *out)
{
    vvec3 h         = vadd(*wi, *wo);
    vvec3 d         = vsub(*wi, *wo);
    vfloat r2       = h.x * h.x + h.y * h.y;
    vfloat length_h = vlength(h), length_d = vlength(d);
    vfloat across = length_h * (h.x * d.y - h.y * d.x);
    vfloat along  = h.z * (h.x * d.x + h.y * d.y) - r2 * d.z;
    out->axes[0]  = vtable_find(&b->axes[0], vbrdf_angle(b, vsqrt(r2), h.z));
    out->axes[1]  = vtable_find(&b->axes[1], vbrdf_angle(b, length_d, length_h));
    vfloat phi_d  = vbrdf_angle(b, across, along);
    out->axes[2]  = vtable_find(&b->axes[2], vselect(phi_d < 0.0f, phi_d + WARP_PI, phi_d));
    if (!drawn)
        return;

    vfloat x, y;
    vbrdf_heading(wo, &x, &y);
    vfloat phi  = vatan2(h.y * x - h.x * y, h.x * x + h.y * y);
    phi         = vselect(phi < 0.0f, phi + 2.0f * WARP_PI, phi);
    vfloat most = vsplat((float)(b->cells.phis - 1));
    vint column = vto_int(vmin(phi * ((float)b->cells.phis / (2.0f * WARP_PI)), most));
    out->theta  = vtable_find(&b->nodes.theta, vtheta(b, wo));
    out->phi    = (vtable_place){ 0 };
    out->cell   = out->axes[0].below * b->cells.phis + column;
    out->to_sr  = 0.5f / length_h; /* wo . h = |H| / 2 */
}

void vbrdf_find(const brdf *b, const vvec3 *wo, const vvec3 *wi, bool drawn, vbrdf_place *out)
{
    if (b->kind == BRDF_ANISOTROPIC)
        find_anisotropic(b, wo, wi, out);
    else if (b->kind == BRDF_ISOTROPIC)
        find_isotropic(b, wo, wi, out);
    else
        find_half(b, wo, wi, drawn, out);
}

vrgb vbrdf_value(const brdf *b, const vvec3 *wo, const vvec3 *wi, vmask active)
{
    vbrdf_place p;
    vfloat rgb[4];
    vbrdf_find(b, wo, wi, false, &p);
    vbrdf_blend(b, &p, rgb);
    vmask above = active & (wo->z > 0.0f) & (wi->z > 0.0f);
    return vkeep3(above, (vrgb){ rgb[0], rgb[1], rgb[2] });
}

/* ---- nodes ----------------------------------------------------------------------------------- */

/* The nodes around a direction, and what each weighs: two, or four where they have azimuths. */
typedef struct corner_nodes {
    int count;
    vint node[4];
    vfloat weight[4];
} corner_nodes;

static corner_nodes corners(const brdf *b, vtable_place theta, vtable_place phi)
{
    int phis = b->nodes.phi.count;
    vfloat f = theta.fraction, g = phi.fraction;
    if (phis == 1)
        return (corner_nodes){ 2, { theta.below, theta.above }, { 1.0f - f, f } };
    return (corner_nodes){ 4,
                           { theta.below * phis + phi.below, theta.below * phis + phi.above,
                             theta.above * phis + phi.below, theta.above * phis + phi.above },
                           { (1.0f - f) * (1.0f - g), (1.0f - f) * g, f * (1.0f - g), f * g } };
}

vfloat vbrdf_of_nodes(const brdf *b, const float *values, int every, vtable_place theta,
                      vtable_place phi)
{
    corner_nodes k = corners(b, theta, phi);
    vfloat sum     = vsplat(0.0f);
    for (int i = 0; i < k.count; i++)
        sum = sum + k.weight[i] * vgather(values, k.node[i] * every);
    return sum;
}

/* ---- drawing --------------------------------------------------------------------------------- */

vfloat vbrdf_pdf(const brdf *b, const vbrdf_place *p, vfloat cos_in)
{
    corner_nodes k = corners(b, p->theta, p->phi);
    int cells      = b->cells.thetas * b->cells.phis;
    vfloat density = vsplat(0.0f), albedo = vsplat(0.0f);
    for (int i = 0; i < k.count; i++) {
        density = density + k.weight[i] * vgather(b->cells.density, k.node[i] * cells + p->cell);
        albedo  = albedo + k.weight[i] * vgather(b->nodes.albedo + 3, k.node[i] * 4);
    }
    vmask black   = ~(albedo > 0.0f);
    vfloat share  = vselect(black, vsplat(1.0f), vsplat(COSINE_SHARE));
    vfloat tables = vkeep(~black, (1.0f - share) * density * p->to_sr / albedo);
    return share * vwarp_cosine_pdf(cos_in) + tables;
}

/* One of the nodes, as often as it weighs and gives back; in *pick what is left of it. */
static vint draw_node(const brdf *b, const vvec3 *wo, vfloat pick, vmask *black)
{
    vtable_place theta, phi;
    vbrdf_node(b, wo, &theta, &phi);
    corner_nodes k = corners(b, theta, phi);
    vfloat sums[4], sum = vsplat(0.0f);
    for (int i = 0; i < k.count; i++)
        sums[i] = sum = sum + k.weight[i] * vgather(b->nodes.albedo + 3, k.node[i] * 4);
    vint node    = k.node[0];
    vfloat below = pick * sum;
    for (int i = 1; i < k.count; i++)
        node = vselect_int((below >= sums[i - 1]) & (sums[i] > sums[i - 1]), k.node[i], node);
    *black = ~(sum > 0.0f);
    return node;
}

/* A direction by its azimuth from wo's heading. */
static vvec3 turned(const vvec3 *wo, vfloat sin_theta, vfloat cos_theta, vfloat phi)
{
    vfloat x, y, c = vcos(phi), s = vsin(phi);
    vbrdf_heading(wo, &x, &y);
    vfloat scale = sin_theta / vsqrt(x * x + y * y);
    return (vvec3){ scale * (x * c - y * s), scale * (y * c + x * s), cos_theta };
}

vvec3 vbrdf_draw(const brdf *b, const vvec3 *wo, vfloat u, vfloat v, vfloat pick)
{
    /* A cell of a node, and a place in it */
    const brdf_cells *c = &b->cells;
    vmask black;
    vfloat rest = vmax((pick - COSINE_SHARE) / (1.0f - COSINE_SHARE), vsplat(0.0f));
    vint node   = draw_node(b, wo, rest, &black);
    vfloat f, g, share;
    vint row    = vdistribution_draw(c->rows, node * (c->thetas + 1), c->thetas, u, &f, &share);
    vint column = vdistribution_draw(c->columns, (node * c->thetas + row) * (c->phis + 1), c->phis,
                                     v, &g, &share);
    vfloat s    = vlerp(vgather(c->theta_edges, row), vgather(c->theta_edges, row + 1), f);
    vfloat phi  = vlerp(vgather(c->phi_edges, column), vgather(c->phi_edges, column + 1), g);

    vvec3 wi;
    if (b->kind == BRDF_HALF) { /* s = sin^2(theta_h / 2) */
        vvec3 h = turned(wo, 2.0f * vsqrt(s * (1.0f - s)), 1.0f - 2.0f * s, phi);
        wi      = vsub(vscale(h, 2.0f * vdot(h, *wo)), *wo);
    } else { /* s = sin^2 theta */
        vfloat sine = vsqrt(s), cosine = vsqrt(1.0f - s);
        wi = b->kind == BRDF_ISOTROPIC ? turned(wo, sine, cosine, -phi)
                                       : (vvec3){ sine * vcos(phi), sine * vsin(phi), cosine };
    }
    return vselect3(black | (pick < COSINE_SHARE), vwarp_cosine(u, v), wi);
}
