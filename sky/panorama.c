/* sky/panorama.c -- see panorama.h.
 *
 * A pixel is found by two angles: the row by the polar angle atan2(|(x, y)|, z), which unlike
 * acos(z) is exact at the poles, the column by the azimuth atan2(x, y). Four floats are kept a
 * pixel (128 MB of 4096 x 2048), so that a lane reads it at once.
 */
#include "sky/panorama_parts.h"

#include "core/color.h"
#include "core/image.h"
#include "core/packet_math.h"

#include <float.h>

typedef struct panorama {
    sky base;
    int width, height;
    const float *rgb0; /* of each pixel; in units of `scale` */
    float scale;       /* W/(sr m^2) */
    float shift;       /* turns, from the azimuth over the left edge: [0, 1) */
} panorama;

/* ---- looking it up --------------------------------------------------------------------------- */

/* Which of `count` cells `part`, [0, 1], of their whole is in; whatever `part` is, there is one. */
static inline vint cell_of(vfloat part, int count)
{
    vfloat cell = part * (float)count;
    return vto_int(vmin(vmax(cell, vsplat(0.0f)), vsplat((float)(count - 1))));
}

static vrgb radiance(const sky *self, const vvec3 *wi, vmask active)
{
    const panorama *p = (const panorama *)self;
    vvec3 w           = vkeep3(active, *wi);
    vfloat polar      = vatan2(vsqrt(w.x * w.x + w.y * w.y), w.z);
    vfloat azimuth    = vatan2(w.x, w.y);
    vfloat turn       = azimuth * (float)(0.5 / M_PI) + p->shift;
    vint column       = cell_of(turn - vfloor(turn), p->width);
    vint row          = cell_of(polar * (float)(1.0 / M_PI), p->height);

    vfloat pixel[4];
    vgather4(p->rgb0, row * p->width + column, pixel);
    return vkeep3(active, vscale((vrgb){ pixel[0], pixel[1], pixel[2] }, vsplat(p->scale)));
}

static const sky_type panorama_type = { .name = "panorama", .radiance = radiance };

/* ---- what it gives --------------------------------------------------------------------------- */

/* Of sin t cos t dt from t0 to t1. */
static double rise(double t0, double t1) { return 0.5 * sin(t0 + t1) * sin(t1 - t0); }

panorama_row panorama_row_of(const panorama_map *m, int row)
{
    double df = 2.0 * M_PI / m->width, dt = M_PI / m->height;
    double t0 = row * dt, t1 = t0 + dt, middle = t0 + 0.5 * dt;
    double sin2    = 0.5 * dt - 0.5 * cos(2.0 * middle) * sin(dt); /* of sin^2 t dt */
    double horizon = fmin(t1, 0.5 * M_PI);
    return (panorama_row){ .polar       = middle,
                           .solid_angle = df * 2.0 * sin(middle) * sin(0.5 * dt),
                           .up          = df * rise(t0, t1),
                           .above       = t0 < horizon ? df * rise(t0, horizon) : 0.0,
                           .out         = 2.0 * sin(0.5 * df) * sin2 };
}

/* W/m^2 on level ground, in the map's numbers: exact, for a pixel is as bright all over. */
static void horizontal_of(const panorama_map *m, double out[3])
{
    out[0] = out[1] = out[2] = 0.0;
    for (int y = 0; 2 * y < m->height; y++) {
        const float *p = panorama_pixel(m, 0, y);
        double r = 0.0, g = 0.0, b = 0.0, above = panorama_row_of(m, y).above;
        for (int x = 0; x < m->width; x++, p += 4)
            r += (double)p[0], g += (double)p[1], b += (double)p[2];
        out[0] += above * r, out[1] += above * g, out[2] += above * b;
    }
}

static double luminance_of(const double rgb[3])
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; /* ITU-R BT.709-6, item 3.2 */
}

/* ---- making it ------------------------------------------------------------------------------- */

static bool is_sound(const panorama_desc *d, lux_error *err)
{
    if (!isfinite(d->rotate_deg))
        return failed(err, ERR_ARGUMENT, "%s: rotated by %g degrees: a finite number was expected",
                      d->path, d->rotate_deg);
    bool scaled = isnan(d->scale) || (d->scale > 0.0 && d->scale < HUGE_VAL);
    bool level  = isnan(d->horizontal) || (d->horizontal > 0.0 && d->horizontal < HUGE_VAL);
    return (scaled && level) ||
           failed(err, ERR_ARGUMENT, "%s: %s is %g: a number above 0 was expected", d->path,
                  scaled ? "the irradiance of level ground" : "the scale",
                  scaled ? d->horizontal : d->scale);
}

/* W/(sr m^2) of 1.0. What the largest number then comes to must be a float, too. */
static bool find_scale(const panorama_map *m, const panorama_desc *d, double *scale, lux_error *err)
{
    *scale = isnan(d->scale) ? 1.0 : d->scale;
    if (isnan(d->scale) && !isnan(d->horizontal)) {
        double whole[3];
        horizontal_of(m, whole);
        *scale = d->horizontal / luminance_of(whole);
        if (!(*scale < HUGE_VAL))
            return failed(err, ERR_ARGUMENT,
                          "%s: all is black above the horizon: no factor makes it light", d->path);
    }
    float most   = 0.0f;
    size_t count = 4 * (size_t)m->width * (size_t)m->height;
    for (size_t i = 0; i < count; i++)
        most = m->rgb0[i] > most ? m->rgb0[i] : most;
    return (*scale >= (double)FLT_MIN && (double)most * *scale < 1e30 && *scale < 1e30) ||
           failed(err, ERR_ARGUMENT,
                  "%s: its brightest pixel is %g, times a scale of %g: beyond what can be "
                  "reckoned with",
                  d->path, (double)most, *scale);
}

/* Turns about +z, clockwise seen from above. */
static vec3 turned(vec3 v, double angle)
{
    double x = (double)v.x, y = (double)v.y, c = cos(angle), s = sin(angle);
    return (vec3){ (float)(x * c + y * s), (float)(y * c - x * s), v.z };
}

static void tell(const panorama_desc *d, const panorama_map *m, const panorama_sun *sun, notices *n)
{
    if (m->width != 2 * m->height)
        notice_add(n,
                   "%s: %d x %d pixels, not twice as wide as high: taken as all around all the "
                   "same",
                   d->path, m->width, m->height);
    if (!sun->found)
        return;
    double azimuth   = atan2((double)sun->to_sun.x, (double)sun->to_sun.y) * (180.0 / M_PI);
    double elevation = asin(fmin(fmax((double)sun->to_sun.z, -1.0), 1.0)) * (180.0 / M_PI);
    notice_add(n,
               "%s: a sun at elevation %.1f, %.1f degrees clockwise from +y, gives %.6g lx square "
               "to it: now a lamp of %.2f degrees%s",
               d->path, elevation, azimuth < 0.0 ? azimuth + 360.0 : azimuth,
               LUMENS_PER_WATT * (double)rgb_luminance(sun->irradiance), sun->diameter_deg,
               sun->clipped ? "; it was brighter than the picture holds" : "");
}

static const sky *make(arena *a, const panorama_desc *d, const panorama_map *m, panorama_sun *sun,
                       notices *n, lux_error *err)
{
    double scale, level[3];
    panorama *p = arena_new(a, panorama, err);
    if (!p || !find_scale(m, d, &scale, err))
        return NULL;
    if (!d->keep_sun)
        panorama_split_sun(m, sun, n);
    double turns    = d->rotate_deg / 360.0;
    double shift    = 0.5 - turns - floor(0.5 - turns);
    sun->to_sun     = turned(sun->to_sun, 2.0 * M_PI * (turns - floor(turns)));
    sun->irradiance = v3_scale(sun->irradiance, (float)scale);
    horizontal_of(m, level);
    *p = (panorama){ .base   = { .type       = &panorama_type,
                                 .horizontal = { (float)(scale * level[0]), (float)(scale * level[1]),
                                                 (float)(scale * level[2]) },
                                 .below      = true,
                                 .columns    = m->width,
                                 .rows       = m->height },
                     .width  = m->width,
                     .height = m->height,
                     .rgb0   = m->rgb0,
                     .scale  = (float)scale,
                     .shift  = (float)shift };
    tell(d, m, sun, n);
    return &p->base;
}

const sky *sky_panorama(arena *a, const panorama_desc *d, panorama_sun *sun, notices *n,
                        lux_error *err)
{
    panorama_map m = { .path = d->path };
    *sun           = (panorama_sun){ .to_sun = { 0, 0, 1 } };
    return is_sound(d, err) && image_load_radiance(d->path, a, &m.width, &m.height, &m.rgb0, err) &&
                   panorama_clean(&m, err)
               ? make(a, d, &m, sun, n, err)
               : NULL;
}
