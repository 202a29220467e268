/* sim/scene_chance.c -- what samples miss: first, what lamps do that are near to a surface.
 *
 * A lamp at distance h from a wall lights a patch of it some h across with all that it sheds on
 * that side, and the patch is a source of its own. Paths meet it with a probability of some h^2
 * over the area of all surfaces: in a room of 4 m by 3 m by 2.5 m and reflectance 0.5, of a lamp
 * 1 cm under the ceiling, 41.0 lx +- 5 % were found of 47.6 lx. n lamps have n such patches, which
 * matter less each and are met as often together: then h may be smaller by the root of n.
 */
#include "core/color.h"
#include "sim/scene_build.h"

enum { PACKETS = 128 / LANES };

/* Glowing surfaces are met by chance, not sought: where they are less of all surfaces than this,
 * samples may miss them all. */
static const double least_glow_share = 0.01;

static const double near_share = 0.01; /* of the diagonal of the scene's box */
static const double flux_share = 0.01; /* of a lamp's light: less than that does not matter */

/* Directions that lie evenly on the sphere, by the golden section. */
static void even_directions(vvec3 to[PACKETS])
{
    const double golden = 2.39996322972865332; /* pi (3 - sqrt 5) */
    for (int k = 0; k < PACKETS; k++) {
        float x[LANES], y[LANES], z[LANES];
        for (int i = 0; i < LANES; i++) {
            double n = k * LANES + i, up = 1.0 - (2.0 * n + 1.0) / (PACKETS * LANES);
            double across = sqrt(1.0 - up * up);
            x[i]          = (float)(across * cos(golden * n));
            y[i]          = (float)(across * sin(golden * n));
            z[i]          = (float)up;
        }
        to[k] = (vvec3){ vload(x), vload(y), vload(z) };
    }
}

/* Whether a worthwhile share of what lamp l sheds from `at` falls on surfaces within `reach`. */
static bool shines_on_near(const scene *s, const light *l, vec3 at, float reach)
{
    vvec3 directions[PACKETS];
    vray rays[PACKETS];
    vmask active[PACKETS], blocked[PACKETS];
    double all = 0.0, near = 0.0;
    even_directions(directions);
    for (int k = 0; k < PACKETS; k++) {
        rays[k]   = (vray){ vspread(at), directions[k], vsplat(reach) };
        active[k] = (vlane_index() >= 0);
    }
    world_any_hit(s->world, rays, active, PACKETS, RAYS_INCOHERENT, blocked);

    for (int k = 0; k < PACKETS; k++) { /* its irradiance at 1 m is its intensity that way */
        vlight_sample sample;
        vvec3 there   = vadd(vspread(at), directions[k]);
        vfloat middle = vsplat(0.5f);
        vmask lit     = light_sample(l, &there, middle, middle, active[k], &sample);
        vfloat strong = vkeep(lit, vrgb_luminance(sample.e));
        for (int i = 0; i < LANES; i++) {
            all += (double)lane(strong, i);
            near += vbits(blocked[k]) >> i & 1 ? (double)lane(strong, i) : 0.0;
        }
    }
    return near > flux_share * all;
}

int scene_near_lamps(const scene *s, notices *n)
{
    dvec3 across   = d3_sub(s->high, s->low);
    double reach   = near_share * d3_length(across) / sqrt(fmax(s->light_count, 1));
    int count      = 0;
    dvec3 first_at = { 0, 0, 0 };
    if (!(s->low.x <= s->high.x)) /* no surface at all */
        return 0;
    for (int i = 0; i < s->light_count; i++) {
        const scene_light *info = &s->light_info[i];
        if (!isfinite(info->lumens) ||
            !shines_on_near(s, s->lights[i], scene_place(s, info->at), (float)reach))
            continue;
        if (count++ == 0)
            first_at = info->at;
    }
    if (count)
        notice_add(n,
                   "%s: %d light%s, first that at (%g, %g, %g) m, shine%s on a surface within %.2g "
                   "m: what comes back from there is found too rarely, intervals are not valid",
                   s->study->path, count, count > 1 ? "s" : "", first_at.x, first_at.y, first_at.z,
                   count > 1 ? "" : "s", reach);
    return count;
}

const char *scene_left_to_chance(const scene *s, bool direct_only)
{
    if (s->glows && s->glow_share < least_glow_share)
        return "glowing surfaces are small and met by chance, which samples may miss";
    if (!direct_only && s->reflects && s->near_lamps > 0)
        return "lamps light surfaces beside them, from where samples rarely find light back";
    return NULL;
}
