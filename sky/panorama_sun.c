/* sky/panorama_sun.c -- the sun in a panorama: found by its brightness, taken out with its energy.
 *
 * After Voloboy, Galaktionov, Kopylov and Shapiro, "Simulation of natural daylight illumination
 * determined by a high dynamic range image", Programming and Computer Software 32(5), 2006: a small
 * place that is brighter than the sky around it by orders is replaced by a lamp. Here:
 *
 *     peak      the brightest pixel
 *     around    the mean luminance of the sky from 5 to 15 degrees off it
 *     bright    above sqrt(peak around): nearer to the peak than to the sky around it, in stops
 *
 * It is a sun if peak / around is at least 100, nine tenths of the light of all bright pixels of
 * the picture come from within 5 degrees of the peak (else they are lamps), and that light is a
 * hundredth or more of what comes from all around, and it is not larger than below. The bright
 * pixels there become what is left around them within those 5 degrees; the light that is taken out
 * is the lamp's, so that nothing is lost or gained. Its direction is the mean of theirs by energy;
 * it is as large as a disk of the peak's brightness and that energy, but not smaller than the sun;
 * what would be larger than 2 degrees and a pixel is a lamp.
 */
#include "sky/panorama_parts.h"

#include "core/color.h"

#include <stdlib.h>

static const double near_deg = 5.0, around_deg = 15.0;
static const double least_contrast = 100.0;
static const double least_alone    = 0.9;
static const double least_clipped  = 4.0; /* what stands out less is no sun, clipped or not */
static const double least_share    = 0.01;
static const double sun_deg        = 0.533; /* at the mean distance */
static const double most_sun_deg   = 2.0;   /* and a pixel: seen through haze, or clipped */

/* Of a limb that the camera saw whole only a disk of the sun's own size can be of one value. */
static const double flat_within = 0.01, most_flat_deg = 0.6;
static const float half_full = 65000.0f; /* about the largest number of 16 bits: 65504 */

typedef struct sun_search {
    const panorama_map *m;
    int column, row; /* of the peak */
    double peak;
    double around;
    double threshold;   /* what is above it is bright */
    double all, bright; /* W/m^2 from all around, on no surface; of that from bright pixels */
    int flat;           /* pixels as bright as the peak */
} sun_search;

static double luminance(const float *p)
{
    return (double)rgb_luminance((vec3){ p[0], p[1], p[2] });
}

/* Pixel luminances are compared as floats everywhere. */
static void find_peak(sun_search *s)
{
    const panorama_map *m = s->m;
    s->peak               = -1.0;
    for (int y = 0; y < m->height; y++) {
        const float *p = panorama_pixel(m, 0, y);
        for (int x = 0; x < m->width; x++, p += 4)
            if (luminance(p) > s->peak)
                s->peak = luminance(p), s->column = x, s->row = y;
    }
}

/* ---- the pixels about the peak --------------------------------------------------------------- */

typedef void visit_fn(const sun_search *s, int column, const panorama_row *row, float *pixel,
                      void *context);

/* Columns to each side of the peak's that a cap of that radius about it reaches in a row; < 0:
 * none. */
static int columns_within(const sun_search *s, double polar, double radius)
{
    const panorama_map *m = s->m;
    double centre = panorama_row_of(m, s->row).polar, across = sin(polar) * sin(centre);
    double least = cos(radius) - cos(polar) * cos(centre); /* cos of the longitudes apart, times
                                                              across */
    if (least > across)
        return -1;
    if (least <= -across)
        return m->width;
    return (int)(acos(least / across) * m->width / (2.0 * M_PI));
}

/* All pixels whose middle is from `from` to below `to` degrees off the peak's. */
static void visit(const sun_search *s, double from_deg, double to_deg, visit_fn *f, void *context)
{
    const panorama_map *m = s->m;
    double to = to_deg * (M_PI / 180.0), from = from_deg * (M_PI / 180.0), dt = M_PI / m->height;
    int reach = (int)fmin(to / dt, m->height);
    int first = s->row - reach > 0 ? s->row - reach : 0;
    int last  = s->row + reach < m->height - 1 ? s->row + reach : m->height - 1;
    for (int y = first; y <= last; y++) {
        panorama_row row = panorama_row_of(m, y);
        int outer = columns_within(s, row.polar, to), inner = columns_within(s, row.polar, from);
        int least = outer < m->width / 2 ? -outer : -(m->width / 2);
        int most  = outer < (m->width - 1) / 2 ? outer : (m->width - 1) / 2;
        for (int k = least; k <= most; k++) {
            int x = (s->column + k + m->width) % m->width;
            if (from_deg == 0.0 || abs(k) > inner)
                f(s, x, &row, panorama_pixel(m, x, y), context);
        }
    }
}

typedef struct mean_sum {
    double weight, light, rgb[3];
} mean_sum;

static void add_mean(const sun_search *s, int column, const panorama_row *row, float *pixel,
                     void *context)
{
    mean_sum *sum = context;
    (void)column;
    if (luminance(pixel) > s->threshold)
        return;
    sum->weight += row->solid_angle;
    sum->light += row->solid_angle * luminance(pixel);
    for (int c = 0; c < 3; c++)
        sum->rgb[c] += row->solid_angle * (double)pixel[c];
}

/* ---- whether it is a sun --------------------------------------------------------------------- */

/* Of the bright pixels near the peak. */
typedef struct blob {
    double light;         /* W/m^2, as sun_search.bright */
    double toward[3];     /* W/m^2: of direction times luminance over them */
    int flat;             /* pixels as bright as the peak */
    double flat_angle;    /* sr, of those */
    double fill[3];       /* W/(sr m^2), of what is put in their place */
    double removed[3][3]; /* W/m^2: of direction times what is taken out, of each channel */
} blob;

/* Of direction over a pixel, sr. */
static void pixel_toward(const sun_search *s, int column, const panorama_row *row, double out[3])
{
    double longitude = panorama_longitude(s->m, column);
    out[0]           = row->out * sin(longitude);
    out[1]           = row->out * cos(longitude);
    out[2]           = row->up;
}

static bool is_flat(const sun_search *s, double l) { return l >= (1.0 - flat_within) * s->peak; }

static void add_to_blob(const sun_search *s, int column, const panorama_row *row, float *pixel,
                        void *context)
{
    blob *b  = context;
    double l = luminance(pixel), toward[3];
    if (!(l > s->threshold))
        return;
    pixel_toward(s, column, row, toward);
    b->light += l * row->solid_angle;
    for (int i = 0; i < 3; i++)
        b->toward[i] += l * toward[i];
    if (is_flat(s, l)) {
        b->flat++;
        b->flat_angle += row->solid_angle;
    }
}

static void look_all_around(sun_search *s)
{
    for (int y = 0; y < s->m->height; y++) {
        const float *p = panorama_pixel(s->m, 0, y);
        double all = 0.0, bright = 0.0;
        for (int x = 0; x < s->m->width; x++, p += 4) {
            double l = luminance(p);
            all += l;
            bright += l > s->threshold ? l : 0.0;
            s->flat += is_flat(s, l);
        }
        double angle = panorama_row_of(s->m, y).solid_angle;
        s->all += angle * all;
        s->bright += angle * bright;
    }
}

static double length_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* Of a disk of radiance l that gives e on a surface square to it: e = pi l sin^2(radius). */
static double diameter_of(double e, double l)
{
    return 2.0 * asin(fmin(sqrt(e / (M_PI * l)), 1.0)) * (180.0 / M_PI);
}

/* Whether it is a sun; if only lamps too many or too large keep it from that, the user is told. */
static bool is_sun(const sun_search *s, const blob *b, notices *n)
{
    if (!(s->peak > 0.0) || s->peak < least_contrast * s->around)
        return false;
    double e = length_of(b->toward);
    if (e < least_share * s->all)
        return false;
    bool alone = b->light >= least_alone * s->bright;
    bool small = diameter_of(e, s->peak) <= most_sun_deg + 180.0 / s->m->height;
    if (!alone || !small)
        notice_add(n, "%s: what is brightest in it is %s: taken for lamps, and no sun is split off",
                   s->m->path, alone ? "too large for a sun" : "in several places");
    return alone && small;
}

/* ---- taking it out --------------------------------------------------------------------------- */

static void take_out(const sun_search *s, int column, const panorama_row *row, float *pixel,
                     void *context)
{
    blob *b = context;
    double toward[3];
    if (!(luminance(pixel) > s->threshold))
        return;
    pixel_toward(s, column, row, toward);
    for (int c = 0; c < 3; c++) {
        float stays = fminf(pixel[c], (float)b->fill[c]);
        for (int i = 0; i < 3; i++)
            b->removed[c][i] += (double)(pixel[c] - stays) * toward[i];
        pixel[c] = stays;
    }
}

/* The mean color of what is not bright near the peak; where there is no such pixel, further off. */
static void find_fill(const sun_search *s, blob *b)
{
    mean_sum sum = { 0 };
    visit(s, 0.0, near_deg, add_mean, &sum);
    if (sum.weight == 0.0)
        visit(s, near_deg, around_deg, add_mean, &sum);
    for (int c = 0; c < 3; c++)
        b->fill[c] = sum.weight > 0.0 ? sum.rgb[c] / sum.weight : 0.0;
}

static bool is_clipped(const sun_search *s, const blob *b)
{
    const float *peak = panorama_pixel(s->m, s->column, s->row);
    float most        = fmaxf(peak[0], fmaxf(peak[1], peak[2]));
    double flat_deg   = 2.0 * acos(1.0 - b->flat_angle / (2.0 * M_PI)) * (180.0 / M_PI);
    return (b->flat > 1 && flat_deg > most_flat_deg) || (most >= half_full && most <= 65504.0f);
}

/* A sun in a picture that holds too little of it to be one. */
static void tell_dim(const sun_search *s, const blob *b, notices *n)
{
    bool dim = s->peak < least_contrast * s->around && s->peak > least_clipped * s->around;
    if (dim && is_clipped(s, b) && b->flat == s->flat)
        notice_add(n,
                   "%s: its %d brightest pixels, in one place, all have one value: if that is the "
                   "sun, the picture holds only a part of its light",
                   s->m->path, b->flat);
}

void panorama_split_sun(const panorama_map *m, panorama_sun *out, notices *n)
{
    sun_search s    = { .m = m, .threshold = HUGE_VAL };
    mean_sum around = { 0 };
    blob b          = { 0 };
    find_peak(&s);
    visit(&s, near_deg, around_deg, add_mean, &around);
    if (around.weight == 0.0) /* pixels of ten degrees and more: there is no telling */
        return;
    s.around    = around.light / around.weight;
    s.threshold = sqrt(s.peak * s.around);
    look_all_around(&s);
    visit(&s, 0.0, near_deg, add_to_blob, &b);
    if (!is_sun(&s, &b, n)) {
        tell_dim(&s, &b, n);
        return;
    }

    double length = length_of(b.toward), e[3] = { 0.0, 0.0, 0.0 };
    out->clipped = is_clipped(&s, &b);
    find_fill(&s, &b);
    visit(&s, 0.0, near_deg, take_out, &b);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < 3; i++)
            e[c] += b.removed[c][i] * b.toward[i] / length;
    out->found        = true;
    out->to_sun       = (vec3){ (float)(b.toward[0] / length), (float)(b.toward[1] / length),
                                (float)(b.toward[2] / length) };
    out->irradiance   = (vec3){ (float)e[0], (float)e[1], (float)e[2] };
    out->diameter_deg = fmax(sun_deg, diameter_of(length, s.peak));
}
