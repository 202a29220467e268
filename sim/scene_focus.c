/* sim/scene_focus.c -- light that mirrors and solids of glass send on, which no sampler reaches.
 *
 * A path that goes from a matt surface to a mirror finds a lamp there by its own ray alone: never
 * if the lamp is a point or far away, and rarely if it is small. A solid that refracts gathers
 * light where no shadow ray, which passes it straight, knows of.
 */
#include "core/color.h"
#include "sim/scene_build.h"

static const float narrow_pdf  = 100.0f; /* 1/sr: a lobe of about 6 degrees */
static const float least_share = 0.02f;  /* of light, below which a mirror does not matter */
static const double met_often  = 8.0;    /* times, in the first samples of a sensor: then a lamp is
                                            not overlooked */

enum { SIDE = 8, DRAWS = SIDE * SIDE };

/* The share of light from 45 degrees that comes back in a narrow lobe, or in a single direction. */
static float mirrored_share(const material *const *all, int m)
{
    const vvec3 up = vspread((vec3){ 0, 0, 1 });
    vshading s     = { .wo       = vspread((vec3){ 0.70710678f, 0, 0.70710678f }),
                       .n        = up,
                       .flat     = up,
                       .front    = ALL_LANES,
                       .distance = vsplat(1.0f),
                       .look     = look_plain(all[m]) };
    float sum      = 0.0f;
    for (int k = 0; k < DRAWS; k += LANES) {
        vint number = vlane_index() + k;
        vfloat u    = (vto_float(number / SIDE) + 0.5f) * (1.0f / SIDE);
        vfloat v    = (vto_float(number % SIDE) + 0.5f) * (1.0f / SIDE);
        vfloat pick = (vto_float(number) + 0.5f) * (1.0f / DRAWS);
        vscatter drawn;
        vmask goes   = materials_scatter(all, vsplat_int(m), &s, u, v, pick, ALL_LANES, &drawn);
        vmask narrow = goes & ~drawn.straight & ~drawn.bent & (drawn.pdf > narrow_pdf);
        sum += vsum(vkeep(narrow, vrgb_luminance(drawn.weight)));
    }
    return sum / DRAWS;
}

/* The material in use that is most like a mirror; -1: none is. */
static int best_mirror(const scene *s, float *share)
{
    int best = -1;
    *share   = least_share;
    for (int m = 0; s->narrow && m < s->material_count; m++) {
        float own = s->material_info[m].used ? mirrored_share(s->materials, m) : 0.0f;
        if (own > *share)
            best = m, *share = own;
    }
    return best;
}

/* m^2, the face of a box, about. */
static double face_of(const light *l)
{
    light_bounds b = light_bounds_of(l);
    dvec3 d        = d3_sub(d3_from(b.high), d3_from(b.low));
    return fmax(d.x * d.y, fmax(d.y * d.z, d.z * d.x));
}

/* m^2 that a light needs, so that samples of a sensor find it by a mirror of that share often
 * enough: as seen from a quarter of the scene's diagonal, against all directions by their cosine.
 */
static double face_needed(const scene *s, double share)
{
    double d = fmin(0.25 * d3_length(d3_sub(s->high, s->low)), 3.0);
    return met_often * M_PI * d * d / (MIRROR_SAMPLES * share);
}

/* The first light that is too small; NULL: none. */
static const char *hidden_light(const scene *s, double share)
{
    double needed = face_needed(s, share), glowing = 0.0;
    for (int l = 0; l < s->light_count; l++) {
        if (s->light_info[l].sun) /* scene_glint.c looks after those */
            continue;
        const light *lamp = s->lights[l];
        light_bounds b    = light_bounds_of(lamp);
        bool found        = light_has_extent(lamp) && !b.far && face_of(lamp) >= needed;
        if (!found && b.peak > 0.0f)
            return s->light_info[l].name;
    }
    for (int e = 0; e < s->emitter_count; e++) /* triangles: half of their boxes */
        glowing += 0.5 * face_of(s->lights[s->light_count + e]);
    return s->emitter_count > 0 && glowing < needed ? "glowing surfaces" : NULL;
}

static void tell_solids(const scene *s, notices *n)
{
    const char *first = NULL;
    int count         = 0;
    for (int m = s->material_count - 1; m >= 0; m--)
        if (s->material_info[m].used && s->materials[m]->solid)
            first = s->material_info[m].name, count++;
    notice_add(
        n,
        "%s: %d material%s of solids that refract, first \"%s\": what is seen through them is "
        "bent, but direct light is taken to pass them straight: intervals are not valid",
        s->study->path, count, count > 1 ? "s" : "", first);
}

void scene_find_focus(scene *s, notices *n)
{
    float share;
    int mirror         = best_mirror(s, &share);
    const char *hidden = mirror >= 0 ? hidden_light(s, (double)share) : NULL;
    s->mirrors         = mirror >= 0;
    s->mirrors_hide    = hidden != NULL;
    if (hidden)
        notice_add(n,
                   "%s: material \"%s\" reflects like a mirror: the light of small lights (first "
                   "`%s`) that falls on other surfaces by way of it is not found, or rarely, "
                   "intervals are not valid",
                   s->study->path, s->material_info[mirror].name, hidden);
    if (s->solids)
        tell_solids(s, n);
}
