/* materials/ggx.h -- rough surfaces as many small mirrors, facets: how they stand and hide each
 * other.
 *
 * Facet normals h are distributed about the surface's normal n as GGX has it (Walter et al.,
 * "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007), with the angle t from n:
 *
 *     D(h) = alpha^2 / (pi (alpha^2 cos^2 t + sin^2 t)^2)                                   [1/sr]
 *
 * and hide each other as heights on a Smith surface do, toward both directions at once (Heitz,
 * "Understanding the Masking-Shadowing Function", JCGT 3(2) 2014). With m the cosine of a direction
 * with n, and S(m) = sqrt(alpha^2 + (1 - alpha^2) m^2):
 *
 *     G1(o)          = 2 m_o / (m_o + S(m_o))
 *     V = G2/(4 m m) = 1 / (2 (m_o S(m_i) + m_i S(m_o)))
 *
 * Light that meets a second facet is not in D V. Of light from o,
 *
 *     loss(m_o)      = 1 - integral of D V m_i          what meets several facets
 *     schlick(m_o)   = integral of (1 - o.h)^5 D V m_i  what of the rest is Fresnel's steep part
 *
 * are tabulated: what is made of them adds up to what came in (Kulla & Conty, "Revisiting
 * Physically Based Shading at Imageworks", SIGGRAPH 2017 courses).
 */
#ifndef MATERIALS_GGX_H
#define MATERIALS_GGX_H

#include "core/packet.h"

/* alpha = roughness^2. What is smoother than alpha = 0.001 is taken as that: a lobe a tenth of a
 * degree wide, whose peak, 3.2e5 1/sr, floats still resolve. */
#define GGX_LEAST_ROUGHNESS 0.0316227766f

/* The tables (materials/ggx_table.c). Rows are even in x, the fourth root of alpha, from that of
 * 0.001 to 1; columns even in y = log(1 + c sqrt(m / alpha)) / log(1 + c / sqrt(alpha)), c = 1.5,
 * so that each row has its places about m = alpha, where the loss of smooth surfaces is. Between
 * rows they are linear, along them cubic. The means are those of these very functions over diffuse
 * light (the integral of 2 m dm), linear between GGX_MEAN_STEPS places from row to row. */
enum { GGX_ROWS = 48, GGX_COLUMNS = 32, GGX_MEAN_STEPS = 8 };
enum { GGX_PLACES = GGX_ROWS * GGX_COLUMNS, GGX_MEANS = (GGX_ROWS - 1) * GGX_MEAN_STEPS + 1 };
extern const float ggx_loss[GGX_PLACES], ggx_schlick[GGX_PLACES];
extern const float ggx_mean_loss[GGX_MEANS], ggx_mean_schlick[GGX_MEANS];
#define GGX_LEAST_ROOT   0.177827941f /* x of the first row */
#define GGX_COLUMN_SCALE 1.5f         /* c */

typedef struct vggx_share {
    vfloat loss, schlick; /* each and their sum in [0, 1] */
} vggx_share;

typedef struct vggx {
    vfloat alpha, roughness;
    vint row;             /* of the tables, and */
    vfloat below_next;    /* how far it is to the next one, [0, 1] */
    vfloat columns_scale; /* y GGX's columns for each binary logarithm */
    vggx_share mean;
} vggx;

/* A surface of that roughness, in [0, 1]. */
vggx vggx_of(vfloat roughness, vmask active);

/* Of light from (or to) the directions with the cosine m with n, in [0, 1]. */
vggx_share vggx_shares(const vggx *g, vfloat m, vmask active);

/* D, 1/sr: of sin^2 t and cos^2 t, whose sum is 1. */
static inline vfloat vggx_density(const vggx *g, vfloat sin2, vfloat cos2)
{
    vfloat alpha2 = g->alpha * g->alpha;
    vfloat spread = alpha2 * cos2 + sin2;
    return alpha2 * 0.318309886f / (spread * spread);
}

static inline vfloat vggx_s(const vggx *g, vfloat m)
{
    vfloat alpha2 = g->alpha * g->alpha;
    return vsqrt(alpha2 + (1.0f - alpha2) * m * m);
}

/* V, of cosines above 0. */
static inline vfloat vggx_visibility(const vggx *g, vfloat m_o, vfloat m_i)
{
    return 0.5f / (m_o * vggx_s(g, m_i) + m_i * vggx_s(g, m_o));
}

/* A facet as often as it is seen from wo, both in coordinates whose z is n: (u, v) in [0,1)^2.
 * Directions mirrored by it have the density D(h) / (2 (m_o + S(m_o))), of which those below
 * the horizon are lost. Stretched to alpha = 1 facets are a half sphere, and its seen part is even
 * over a cap of directions (Dupuy & Benyoub, "Sampling Visible GGX Normals with Spherical Caps",
 * HPG 2023). */
vvec3 vggx_draw_facet(const vggx *g, vvec3 wo, vfloat u, vfloat v);
static inline vfloat vggx_facet_pdf(const vggx *g, vfloat density, vfloat m_o)
{
    return 0.5f * density / (m_o + vggx_s(g, m_o));
}

/* The cosine of a direction with n, nearly as often as such light meets several facets: the density
 * over directions is m / (pi (alpha^2 + m^2) log(1 + 1 / alpha^2)), 1/sr. */
vfloat vggx_draw_lossy(const vggx *g, vfloat u);
vfloat vggx_lossy_pdf(const vggx *g, vfloat m);

#endif
