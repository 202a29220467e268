/* materials/material_figures.c -- see material_figures.h.
 *
 * What goes through is the mean weight of the ways on that scatter() draws to the other side: it
 * finds single directions as well as densities of any sharpness.
 */
#include "materials/material_figures.h"

#include "core/color.h"
#include "core/sampler.h"

#include <math.h>

/* The point that is asked about: flat, seen from wo, textures white. */
static vshading seen_from(const material *m, vec3 wo)
{
    const material_look *l = &m->look;
    const vvec3 n          = vspread((vec3){ 0, 0, wo.z < 0.0f ? -1.0f : 1.0f });
    return (vshading){ .wo       = vspread(wo),
                       .n        = n,
                       .flat     = n,
                       .front    = n.z > 0.0f,
                       .distance = vsplat(1.0f),
                       .look     = { .color           = vspread(l->color),
                                     .emission        = vspread(l->emission),
                                     .specular        = vspread(l->specular),
                                     .openness        = vsplat(l->openness),
                                     .metallic        = vsplat(l->metallic),
                                     .roughness       = vsplat(l->roughness),
                                     .transmission    = vsplat(l->transmission),
                                     .specular_weight = vsplat(l->specular_weight) } };
}

/* ---- shares ---------------------------------------------------------------------------------- */

enum { DRAWS = 1 << 13 }; /* a multiple of every packet width */

static vec3 drawn_through(const material *m, const vshading *s)
{
    double sum[3] = { 0 };
    if (!m->two_sided && !m->type->through)
        return (vec3){ 0, 0, 0 };
    for (int i = 0; i < DRAWS; i += LANES) {
        vscatter to;
        vsample4 r = vsobol4(vunsigned(vlane_index() + i), vunsigned(vsplat_int(1)));
        vmask goes = m->type->scatter(m, s, r.x, r.y, r.z, ALL_LANES, &to);
        vrgb w     = vkeep3(goes & (vdot(to.wi, s->n) < 0.0f), to.weight);
        for (int k = 0; k < LANES; k++) {
            sum[0] += (double)lane(w.x, k);
            sum[1] += (double)lane(w.y, k);
            sum[2] += (double)lane(w.z, k);
        }
    }
    return (vec3){ (float)(sum[0] / DRAWS), (float)(sum[1] / DRAWS), (float)(sum[2] / DRAWS) };
}

material_share material_share_of(const material *m, vec3 wo)
{
    const vshading s = seen_from(m, wo);
    const vrgb back  = m->type->albedo(m, &s, ALL_LANES);
    return (material_share){ .reflected = { lane(back.x, 0), lane(back.y, 0), lane(back.z, 0) },
                             .through   = drawn_through(m, &s) };
}

double material_lobe(const material *m, vec3 wo, vec3 wi)
{
    if (!m->type->reflect)
        return 0.0;
    const vshading s = seen_from(m, wo);
    const vvec3 to   = vspread(wi);
    const vrgb f     = m->type->reflect(m, &s, &to, ALL_LANES, NULL);
    return (double)lane(vrgb_luminance(f), 0);
}

/* ---- reciprocity ----------------------------------------------------------------------------- */

enum { THETAS = 7, TURNS = 3, PHIS = 24, PAIRS = THETAS * THETAS * TURNS * PHIS };

/* Polar angles that are no places of tables, as azimuths are none; mirror directions are among the
 * pairs, and others as near as lobes are narrow. */
static const double thetas[THETAS] = { 0.06, 0.28, 0.52, 0.79, 1.07, 1.31, 1.49 };
static const double turns[TURNS]   = { 0.03, 0.94, 2.47 };

static vec3 direction(double theta, double phi, bool behind)
{
    double z = cos(theta);
    return (vec3){ (float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)),
                   (float)(behind ? -z : z) };
}

/* Pairs (there, back) of f for directions on these sides. */
static int add_pairs(const material *m, bool behind, bool across, double (*f)[2])
{
    int count = 0;
    for (int i = 0; i < THETAS; i++)
        for (int j = 0; j < THETAS; j++)
            for (int k = 0; k < TURNS * PHIS; k++) {
                double turn = turns[k % TURNS];
                double off  = k / TURNS * (2.0 * M_PI / PHIS);
                vec3 wo     = direction(thetas[i], turn, behind);
                vec3 wi     = direction(thetas[j], turn + off, behind != across);
                f[count][0] = material_lobe(m, wo, wi) / fabs((double)wi.z);
                f[count][1] = material_lobe(m, wi, wo) / fabs((double)wo.z);
                count++;
            }
    return count;
}

material_reciprocity material_reciprocity_of(const material *m)
{
    static const double tiny = 1e-3;
    double f[3 * PAIRS][2];
    int count = add_pairs(m, false, false, f);
    if (m->two_sided) {
        count += add_pairs(m, true, false, f + count);
        count += add_pairs(m, false, true, f + count);
    }
    double most = 0.0, sum = 0.0, off = 0.0, worst = 0.0;
    for (int i = 0; i < count; i++) {
        most = fmax(most, fmax(f[i][0], f[i][1]));
        sum += 0.5 * (f[i][0] + f[i][1]);
        off += fabs(f[i][0] - f[i][1]);
    }
    for (int i = 0; i < count; i++) {
        double larger = fmax(f[i][0], f[i][1]);
        if (larger > tiny * most)
            worst = fmax(worst, fabs(f[i][0] - f[i][1]) / larger);
    }
    return (material_reciprocity){ .mean = sum > 0.0 ? off / sum : 0.0, .worst = worst };
}
