/* sim/sky_picture.c -- see sky_picture.h. */
#include "sim/sky_picture.h"

#include "core/color.h"

/* ---- suns ------------------------------------------------------------------------------------ */

sun_figures sun_figures_of(const light *sun)
{
    vvec3 here = vspread((vec3){ 0, 0, 0 });
    vlight_sample drawn;
    vfloat error;
    vlight_hit met = { 0 };
    if (sun->type->as_point)
        sun->type->as_point(sun, &here, ALL_LANES, &drawn, &error);
    else
        light_sample(sun, &here, vsplat(0.5f), vsplat(0.5f), ALL_LANES, &drawn);
    if (sun->type->hit)
        sun->type->hit(sun, &here, &drawn.wi, ALL_LANES, &met);

    /* e = pi L sin^2(radius) */
    double e    = (double)lane(vrgb_luminance(drawn.e), 0);
    double l    = (double)lane(vrgb_luminance(met.radiance), 0);
    double sine = l > 0.0 ? fmin(sqrt(e / (M_PI * l)), 1.0) : 0.0;
    return (sun_figures){
        .to_sun       = { lane(drawn.wi.x, 0), lane(drawn.wi.y, 0), lane(drawn.wi.z, 0) },
        .irradiance   = { lane(drawn.e.x, 0), lane(drawn.e.y, 0), lane(drawn.e.z, 0) },
        .diameter_deg = 2.0 * asin(sine) * (180.0 / M_PI),
    };
}

static bool is_seen(const light *l) { return l->type->hit != NULL; }

/* ---- directions ------------------------------------------------------------------------------ */

static vrgb sky_at(const scene *s, const vvec3 *wi, vmask active)
{
    vrgb sum = { 0 };
    for (int i = 0; i < s->sky_count; i++)
        sum = vadd(sum, sky_radiance(s->skies[i].sky, wi, active));
    return sum;
}

static vrgb suns_at(const scene *s, const vvec3 *wi, vmask active)
{
    vvec3 here = vspread((vec3){ 0, 0, 0 });
    vrgb sum   = { 0 };
    for (int i = s->light_count - s->sun_count; i < s->light_count; i++) {
        const light *sun = s->lights[i];
        vlight_hit met;
        if (is_seen(sun)) {
            vmask seen = sun->type->hit(sun, &here, wi, active, &met);
            sum        = vadd(sum, vkeep3(seen, met.radiance));
        }
    }
    return sum;
}

static bool make_planes(arena *a, int width, int height, float *rgb[3], lux_error *err)
{
    for (int c = 0; c < 3; c++) {
        rgb[c] = arena_array(a, float, (size_t)width *(size_t)height, err);
        if (!rgb[c])
            return false;
    }
    return true;
}

static void fill_row(const scene *s, const camera *c, bool suns, int y, float *const rgb[3])
{
    for (int x = 0; x < c->width; x += LANES) {
        vint column  = vlane_index() + x;
        vfloat right = vto_float(column) + 0.5f, down = vsplat((float)y + 0.5f);
        vmask active = (column < c->width) & camera_sees(c, right, down);
        vray ray     = camera_ray(c, right, down);
        vrgb seen    = sky_at(s, &ray.direction, active);
        if (suns)
            seen = vadd(seen, suns_at(s, &ray.direction, active));
        for (int i = 0; i < LANES && x + i < c->width; i++) {
            size_t to  = (size_t)y * (size_t)c->width + (size_t)(x + i);
            rgb[0][to] = lane(seen.x, i);
            rgb[1][to] = lane(seen.y, i);
            rgb[2][to] = lane(seen.z, i);
        }
    }
}

bool sky_picture(arena *a, const scene *s, const camera *c, float *rgb[3], lux_error *err)
{
    if (!make_planes(a, c->width, c->height, rgb, err))
        return false;
    for (int y = 0; y < c->height; y++)
        fill_row(s, c, true, y, rgb);
    return true;
}

/* ---- a panorama ------------------------------------------------------------------------------ */

enum { CUTS = 16 }; /* a side of a pixel, for a sun's share of it */

/* A disk in the sky: a sun, or, where it is a point, as large as the sun is. */
typedef struct sun_disk {
    double to[3], radius, cos_radius;
} sun_disk;

static sun_disk disk_of(const sun_figures *f)
{
    const double suns_own_deg = 0.533;
    double radius = 0.5 * (f->diameter_deg > 0.0 ? f->diameter_deg : suns_own_deg) * (M_PI / 180.0);
    return (sun_disk){ .to     = { (double)f->to_sun.x, (double)f->to_sun.y, (double)f->to_sun.z },
                       .radius = radius,
                       .cos_radius = cos(radius) };
}

/* The cosine of the angle from its middle to a place of the picture, in pixels. */
static double cosine_at(const sun_disk *d, int width, double x, double y)
{
    double azimuth = 2.0 * M_PI * (x / width - 0.5), polar = 2.0 * M_PI * y / width;
    return sin(polar) * (sin(azimuth) * d->to[0] + cos(azimuth) * d->to[1]) + cos(polar) * d->to[2];
}

/* The share of a pixel that the disk covers; in *toward what of its solid angle faces the sun. */
static double share_of(const sun_disk *d, int width, int x, int y, double *toward)
{
    int inside   = 0;
    double steps = 2.0 * M_PI / width, middle = cosine_at(d, width, x + 0.5, y + 0.5);
    *toward = middle * steps * (cos(y * steps) - cos((y + 1) * steps));
    if (middle < cos(fmin(d->radius + steps, M_PI))) /* further off than half its diagonal */
        return 0.0;
    if (steps < d->radius && middle > cos(d->radius - steps))
        return 1.0;
    for (int j = 0; j < CUTS; j++)
        for (int i = 0; i < CUTS; i++)
            inside +=
                cosine_at(d, width, x + (i + 0.5) / CUTS, y + (j + 0.5) / CUTS) >= d->cos_radius;
    return (double)inside / (CUTS * CUTS);
}

static int clamp_to(double x, int most) { return (int)fmin(fmax(x, 0.0), (double)most); }

/* Rows that the disk touches. */
static void rows_of(const sun_disk *d, int width, int *first, int *last)
{
    double step = 2.0 * M_PI / width, polar = acos(fmin(fmax(d->to[2], -1.0), 1.0));
    *first = clamp_to((polar - d->radius) / step - 1.0, width / 2 - 1);
    *last  = clamp_to((polar + d->radius) / step + 1.0, width / 2 - 1);
}

/* A sun's energy in the pixels that it covers, as they are covered. */
static void add_sun(const light *sun, int width, float *const rgb[3])
{
    sun_figures f = sun_figures_of(sun);
    sun_disk d    = disk_of(&f);
    int first, last;
    double sum = 0.0, toward;
    rows_of(&d, width, &first, &last);
    for (int y = first; y <= last; y++)
        for (int x = 0; x < width; x++) {
            double share = share_of(&d, width, x, y, &toward);
            sum += share * toward;
        }
    for (int y = first; sum > 0.0 && y <= last; y++)
        for (int x = 0; x < width; x++) {
            double share = share_of(&d, width, x, y, &toward) / sum;
            size_t to    = (size_t)y * (size_t)width + (size_t)x;
            rgb[0][to] += (float)(share * (double)f.irradiance.x);
            rgb[1][to] += (float)(share * (double)f.irradiance.y);
            rgb[2][to] += (float)(share * (double)f.irradiance.z);
        }
}

bool sky_panorama_picture(arena *a, const scene *s, int width, float *rgb[3], lux_error *err)
{
    camera c = { .width      = width,
                 .height     = width / 2,
                 .projection = PROJECTION_PANORAMA,
                 .right      = { 1, 0, 0 },
                 .up         = { 0, 0, 1 },
                 .forward    = { 0, 1, 0 } };
    if (!make_planes(a, c.width, c.height, rgb, err))
        return false;
    for (int y = 0; y < c.height; y++)
        fill_row(s, &c, false, y, rgb);
    for (int i = s->light_count - s->sun_count; i < s->light_count; i++)
        add_sun(s->lights[i], width, rgb);
    return true;
}
