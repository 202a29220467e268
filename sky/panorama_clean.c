/* sky/panorama_clean.c -- negative numbers in a panorama.
 *
 * Filters that make pictures smaller (Lanczos) and lossy compression swing about bright edges: they
 * leave negative pixels beside the sun and lamps, of down to a sixth of these, and as much too much
 * light in others. The sum is right. So what is missing in a negative pixel is taken from those
 * around it, in proportion to their light, to make it as bright as the darkest of them: no light is
 * lost or gained.
 */
#include "sky/panorama_parts.h"

enum {
    REACH     = 3, /* pixels that filters swing */
    MOST_PART = 20 /* a picture is no picture of light where more than one in so many is negative */
};
static const float most_swing = 0.5f; /* of the brightest that is near */

/* The pixels about one. */
typedef struct window {
    const panorama_map *m;
    int column, row;
} window;

static float *window_pixel(const window *w, int right, int down)
{
    int width = w->m->width, x = (w->column + right) % width;
    return panorama_pixel(w->m, x < 0 ? x + width : x, w->row + down);
}

static bool has_row(const window *w, int down)
{
    return w->row + down >= 0 && w->row + down < w->m->height;
}

/* No pixel is looked at twice in pictures that are smaller. */
static int reach_across(const window *w)
{
    int most = (w->m->width - 1) / 2;
    return most < REACH ? most : REACH;
}

/* The light of the positive pixels, in one channel, W/m^2, and the least and the greatest of them.
 */
static double light_of(const window *w, int c, float *least, float *most)
{
    double light = 0.0;
    *most        = 0.0f;
    *least       = INFINITY;
    for (int down = -REACH; down <= REACH; down++) {
        double angle = has_row(w, down) ? panorama_row_of(w->m, w->row + down).solid_angle : 0.0;
        for (int right = -reach_across(w); angle > 0.0 && right <= reach_across(w); right++) {
            float v = window_pixel(w, right, down)[c];
            light += v > 0.0f ? angle * (double)v : 0.0;
            *most  = v > *most ? v : *most;
            *least = v > 0.0f && v < *least ? v : *least;
        }
    }
    return light;
}

static void dim(const window *w, int c, double factor)
{
    for (int down = -REACH; down <= REACH; down++)
        for (int right = -reach_across(w); has_row(w, down) && right <= reach_across(w); right++) {
            float *v = window_pixel(w, right, down) + c;
            *v       = *v > 0.0f ? (float)((double)*v * factor) : *v;
        }
}

static bool clean_pixel(const window *w, lux_error *err)
{
    float *pixel = window_pixel(w, 0, 0);
    double angle = panorama_row_of(w->m, w->row).solid_angle;
    for (int c = 0; c < 3; c++) {
        if (!(pixel[c] < 0.0f))
            continue;
        float least, most;
        double light   = light_of(w, c, &least, &most);
        double missing = (double)(least - pixel[c]) * angle;
        if (!(-pixel[c] <= most_swing * most) || !(missing < light))
            return failed(err, ERR_FORMAT,
                          "%s: the pixel in column %d of row %d is negative: %g %g %g", w->m->path,
                          w->column, w->row, (double)pixel[0], (double)pixel[1], (double)pixel[2]);
        dim(w, c, 1.0 - missing / light);
        pixel[c] = least;
    }
    return true;
}

bool panorama_clean(const panorama_map *m, lux_error *err)
{
    int64_t left = (int64_t)m->width * m->height / MOST_PART;
    for (int y = 0; y < m->height; y++) {
        const float *p = panorama_pixel(m, 0, y);
        for (int x = 0; x < m->width; x++, p += 4) {
            if (!(p[0] < 0.0f || p[1] < 0.0f || p[2] < 0.0f))
                continue;
            if (left-- <= 0)
                return failed(err, ERR_FORMAT,
                              "%s: too many negative pixels, up to column %d of row %d: no "
                              "picture of light",
                              m->path, x, y);
            if (!clean_pixel(&(window){ m, x, y }, err))
                return false;
        }
    }
    return true;
}
