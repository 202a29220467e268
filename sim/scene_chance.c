/* sim/scene_chance.c -- light that samples rarely find: bright patches that are small.
 *
 * What a lamp sheds on a surface beside it comes back from a patch, and so does the spot that a
 * narrow beam makes anywhere. Paths meet a patch with a probability of about its share of all that
 * can be seen; a lamp 1 cm under a ceiling makes one of some 2 pi cm^2. n lamps have n such
 * patches, which matter less each and are met as often together: then they may be smaller by n.
 */
#include "core/color.h"
#include "sim/room.h"
#include "sim/scene_build.h"

#include <stdio.h>
#include <stdlib.h>

enum { PACKETS = 128 / LANES, RAYS = PACKETS * LANES };
enum { MOST_LOOKS = 4096 /* lamps */, MOST_EMITTERS = 256 /* triangles */ };

static const double near_share = 0.015; /* of how far the lamp sees */
static const double flux_share = 0.01;  /* of a lamp's light: less than that does not matter */

/* What surrounds a lamp, by rays evenly in all directions. */
typedef struct surroundings {
    float distance[RAYS]; /* m; INFINITY: nothing is there */
    float back[RAYS];     /* the reflectance of what is there, as luminance */
    float strength[RAYS]; /* the lamp's intensity that way, as luminance */
    vec3 toward[RAYS];
} surroundings;

/* Directions that lie evenly on the sphere, by the golden section. */
static vvec3 even_directions(int first)
{
    const double golden = 2.39996322972865332; /* pi (3 - sqrt 5) */
    float x[LANES], y[LANES], z[LANES];
    for (int i = 0; i < LANES; i++) {
        double n = first + i, up = 1.0 - (2.0 * n + 1.0) / RAYS;
        double across = sqrt(1.0 - up * up);
        x[i]          = (float)(across * cos(golden * n));
        y[i]          = (float)(across * sin(golden * n));
        z[i]          = (float)up;
    }
    return (vvec3){ vload(x), vload(y), vload(z) };
}

static void look_around(const scene *s, const light *l, vec3 at, surroundings *out)
{
    for (int k = 0; k < RAYS; k += LANES) {
        vray ray     = { vspread(at), even_directions(k), vsplat(INFINITY) };
        vmask active = ALL_LANES;
        vhit hit;
        vsurface there;
        vlight_sample lamp;
        world_first_hit(s->world, &ray, &active, 1, RAYS_INCOHERENT, &hit);
        vmask met = hit.instance >= 0;
        world_surface(s->world, &hit, met, &there);
        vrgb albedo = materials_reflectance(s->materials, there.material, met);

        /* Irradiance at 1 m from its centre is the intensity that way */
        vvec3 beside = vadd(vspread(at), ray.direction);
        vfloat half  = vsplat(0.5f), error;
        vmask lit    = light_has_extent(l) ? l->type->as_point(l, &beside, active, &lamp, &error)
                                           : light_sample(l, &beside, half, half, active, &lamp);
        vstore(out->distance + k, hit.distance);
        vstore(out->back + k, vrgb_luminance(albedo));
        vstore(out->strength + k, vkeep(lit, vrgb_luminance(lamp.e)));
        for (int i = 0; i < LANES; i++)
            out->toward[k + i] = (vec3){ lane(ray.direction.x, i), lane(ray.direction.y, i),
                                         lane(ray.direction.z, i) };
    }
}

static int compare(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* How far the lamp sees, m: but for the farthest twentieth of what it sees. 0: it sees nothing. */
static double view_of(const surroundings *around)
{
    float seen[RAYS];
    int count = 0;
    for (int i = 0; i < RAYS; i++)
        if (around->distance[i] < INFINITY)
            seen[count++] = around->distance[i];
    qsort(seen, (size_t)count, sizeof *seen, compare);
    return count ? (double)seen[(count - 1) * 19 / 20] : 0.0;
}

/* Whether a worthwhile share of its light comes back from surfaces within reach. */
static bool shines_on_near(const surroundings *around, double reach)
{
    double all = 0.0, near = 0.0;
    for (int i = 0; i < RAYS; i++) {
        all += (double)around->strength[i];
        if ((double)around->distance[i] < reach)
            near += (double)around->strength[i] * (double)around->back[i];
    }
    return near > flux_share * all;
}

/* Whether its beam is so narrow that the spot it makes is as small as the patch of a lamp within
 * reach of a surface: solid angle flux / peak, times distance^2, against 2 pi reach^2. */
static bool makes_small_spot(const scene *s, const light *l, vec3 at, double reach)
{
    vec3 toward;
    if (!l->type->peak)
        return false;
    double peak = (double)rgb_luminance(l->type->peak(l, &toward));
    double flux = (double)rgb_luminance(light_flux(l));
    if (!(peak > 0.0))
        return false;
    vray ray     = { vspread(at), vspread(toward), vsplat(INFINITY) };
    vmask active = vlane_index() == 0;
    vhit hit;
    vsurface there;
    world_first_hit(s->world, &ray, &active, 1, RAYS_COHERENT, &hit);
    vmask met = active & (hit.instance >= 0);
    world_surface(s->world, &hit, met, &there);
    float back = lane(vrgb_luminance(materials_reflectance(s->materials, there.material, met)), 0);
    double d   = vany(met) ? (double)lane(hit.distance, 0) : 0.0;
    return back > 0.0f && flux / peak * d * d < 2.0 * M_PI * reach * reach;
}

static bool is_in_room(dvec3 size, dvec3 low, dvec3 high, double off)
{
    return low.x >= -off && high.x <= size.x + off && low.y >= -off && high.y <= size.y + off &&
           low.z >= -off && high.z <= size.z + off;
}

/* Whether some of a light that is in a plain room reaches out of it. */
static bool reaches_out(const scene *s, int l)
{
    const double off = 1e-3; /* m: no model is truer */
    dvec3 size = s->study->room.size, at = s->light_info[l].at;
    light_bounds b = light_bounds_of(s->lights[l]);
    return s->study->room.given && light_has_extent(s->lights[l]) && is_in_room(size, at, at, 0) &&
           !is_in_room(size, d3_add(d3_from(b.low), s->centre), d3_add(d3_from(b.high), s->centre),
                       off);
}

static void tell_reaching_out(const scene *s, notices *n)
{
    int count = 0, first = 0;
    for (int l = s->light_count - 1; l >= 0; l--)
        if (reaches_out(s, l))
            count++, first = l;
    if (count == 0)
        return;
    const scene_light *info = &s->light_info[first];
    notice_add(n,
               "%s: %d light%s, first `%s` at (%g, %g, %g) m, reach%s through a wall, floor or "
               "ceiling: what shines from behind it is lost",
               s->study->path, count, count > 1 ? "s" : "", info->name, info->at.x, info->at.y,
               info->at.z, count > 1 ? "" : "es");
}

/* The share of a lamp's light that meets nothing. A plain room is closed but for its windows: there
 * it has left it, from a lamp in its very walls. Elsewhere 0. */
static double lost_share(const scene *s, const scene_light *info, const surroundings *around)
{
    double all = 0.0, lost = 0.0;
    for (int i = 0; i < RAYS; i++) {
        all += (double)around->strength[i];
        if (!(around->distance[i] < INFINITY) &&
            !room_goes_out(&s->study->room, info->at, d3_from(around->toward[i])))
            lost += (double)around->strength[i];
    }
    bool inside = s->study->room.given && scene_is_in_room(s, info->at);
    return inside && lost > flux_share * all ? lost / all : 0.0;
}

/* Lamps that lose light: how many, and the first. */
typedef struct losers {
    int count;
    double share;
    const scene_light *first;
} losers;

static void add_loser(losers *l, const scene_light *info, double share)
{
    if (share > 0.0 && l->count++ == 0) {
        l->share = share;
        l->first = info;
    }
}

static void tell_lost_light(const scene *s, const losers *l, notices *n)
{
    if (l->count == 0)
        return;
    char more[80] = "";
    if (l->count > 1)
        snprintf(more, sizeof more, ", and of %s%d more,",
                 s->light_count > MOST_LOOKS ? "at least " : "", l->count - 1);
    dvec3 at = l->first->at;
    notice_add(
        n,
        "%s: about %.0f %% of the light of `%s` at (%g, %g, %g) m%s leaves the room: it lies in a "
        "wall, floor or ceiling; 1 cm inside it would not",
        s->study->path, 100.0 * l->share, l->first->name, at.x, at.y, at.z, more);
}

/* Not far away, nor within a body, which is all that it would see. */
static bool has_surroundings(const scene_light *info)
{
    return isfinite(info->lumens) && !info->owner;
}

/* lm, of lamps that are looked at: all if 0. Of very many, which take 30 us each, those that give
 * as much as one of MOST_LOOKS alike would are, and of weaker ones one for each such share of all
 * light: evenly, and none that matters is left out. */
static double share_to_look_at(const scene *s)
{
    double all = 0.0;
    for (int i = 0; i < s->light_count; i++)
        all += has_surroundings(&s->light_info[i]) ? s->light_info[i].lumens : 0.0;
    return s->light_count > MOST_LOOKS ? all / MOST_LOOKS : 0.0;
}

/* Whether a lamp takes the light so far into the next share. */
static bool is_looked_at(double *so_far, double lumens, double share)
{
    if (!(share > 0.0))
        return true;
    double before = floor(*so_far / share);
    *so_far += lumens;
    return floor(*so_far / share) > before;
}

/* The centre of a triangle, as it is seen from before its box. */
static dvec3 centre_of(const light *l, const light_bounds *b, double size)
{
    dvec3 box    = d3_scale(d3_add(d3_from(b->low), d3_from(b->high)), 0.5);
    vvec3 before = vspread(d3_to_float(d3_add(box, d3_scale(d3_from(b->axis), size))));
    vlight_sample seen;
    vfloat error;
    l->type->as_point(l, &before, ALL_LANES, &seen, &error);
    vvec3 at = valong(before, seen.wi, seen.dist);
    return (dvec3){ (double)lane(at.x, 0), (double)lane(at.y, 0), (double)lane(at.z, 0) };
}

/* A glowing triangle as a light that is looked at from just off its middle: where the patch that it
 * lights is as small as a lamp's would be, and it is not large itself. */
static bool emitter_is_near(const scene *s, int e, double share, dvec3 *at)
{
    const light *l = s->lights[s->light_count + e];
    light_bounds b = light_bounds_of(l);
    vec3 size      = { b.high.x - b.low.x, b.high.y - b.low.y, b.high.z - b.low.z };
    dvec3 middle   = centre_of(l, &b, (double)v3_length(size));
    surroundings around[2]; /* behind it, before it */
    for (int side = 0; side < 2; side++) {
        dvec3 off = d3_scale(d3_from(b.axis), (2 * side - 1) * 1e-3 * (double)v3_length(size));
        look_around(s, l, d3_to_float(d3_add(middle, off)), &around[side]);
    }
    double reach = near_share * fmax(view_of(&around[0]), view_of(&around[1])) / sqrt(share);
    *at          = d3_add(middle, s->centre);
    return (double)v3_length(size) < reach &&
           (shines_on_near(&around[0], reach) || shines_on_near(&around[1], reach));
}

/* An even choice of them: triangles of one surface are alike. */
static int near_emitters(const scene *s, dvec3 *first_at)
{
    int step = s->emitter_count / MOST_EMITTERS + 1, count = 0;
    for (int e = 0; s->reflects && e < s->emitter_count; e += step) {
        dvec3 at;
        if (emitter_is_near(s, e, s->light_count + s->emitter_count, &at) && count++ == 0)
            *first_at = at;
    }
    return count;
}

static void tell_small_patches(const scene *s, int count, const scene_light *first, notices *n)
{
    char who[80];
    if (s->light_count > MOST_LOOKS)
        snprintf(who, sizeof who, "at least %d of %d lights", count, s->light_count);
    else
        snprintf(who, sizeof who, "%d light%s", count, count > 1 ? "s" : "");
    bool many = count > 1 || s->light_count > MOST_LOOKS;
    notice_add(n,
               "%s: %s, first `%s` at (%g, %g, %g) m, shine%s on a surface close by, or on a small "
               "spot: what comes back from there is found rarely, intervals are not valid (more "
               "distance helps)",
               s->study->path, who, first->name, first->at.x, first->at.y, first->at.z,
               many ? "" : "s");
}

int scene_small_patches(const scene *s, notices *n)
{
    int count                = 0;
    const scene_light *first = NULL;
    losers lost              = { 0 };
    double share = share_to_look_at(s), so_far = 0.0;
    for (int i = 0; i < s->light_count; i++) {
        const scene_light *info = &s->light_info[i];
        if (!has_surroundings(info) || !is_looked_at(&so_far, info->lumens, share))
            continue;
        surroundings around;
        vec3 at = scene_place(s, info->at);
        look_around(s, s->lights[i], at, &around);
        add_loser(&lost, info, lost_share(s, info, &around));
        double reach = near_share * view_of(&around) / sqrt(s->light_count);
        if (!s->reflects ||
            (!shines_on_near(&around, reach) && !makes_small_spot(s, s->lights[i], at, reach)))
            continue;
        if (count++ == 0)
            first = info;
    }
    tell_reaching_out(s, n);
    tell_lost_light(s, &lost, n);
    if (count)
        tell_small_patches(s, count, first, n);
    dvec3 first_at = { 0, 0, 0 };
    int glowing    = near_emitters(s, &first_at);
    if (glowing)
        notice_add(
            n,
            "%s: small glowing surfaces, first that at (%g, %g, %g) m, shine on a surface close "
            "by: what comes back from there is found rarely, intervals are not valid",
            s->study->path, first_at.x, first_at.y, first_at.z);
    return count + glowing;
}

const char *scene_left_to_chance(const scene *s, bool direct_only)
{
    bool plates = s->solids && (s->light_count > 0 || s->emitter_count > 0);
    if (s->smoothed)
        return "solids of rough glass are taken as clear: what they scatter goes elsewhere";
    if (direct_only)
        return plates ? "light that bends in solids of glass is taken to pass them straight" : NULL;
    if (s->reflects && s->small_patches > 0)
        return "lamps light small patches of surface, from where samples rarely find light back";
    if (s->by_suns.narrow > SHARE_THAT_MATTERS)
        return "sunlight that comes by way of smooth surfaces, not quite mirrors, is rarely found";
    if (s->lamps_hide && s->by_lamps.narrow > SHARE_THAT_MATTERS)
        return "light of small lights that comes by way of smooth surfaces, not quite mirrors, is "
               "rarely found";
    if (plates && !s->lenses)
        return "light that bends in plates of glass is taken to pass them straight";
    return NULL;
}
