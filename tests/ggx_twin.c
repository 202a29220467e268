/* tests/ggx_twin.c -- see ggx_twin.h. */
#include "tests/ggx_twin.h"

#include "materials/ggx.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

static double s_of(double alpha, double m)
{
    return sqrt(alpha * alpha + (1.0 - alpha * alpha) * m * m);
}

double ggx_twin_density(double alpha, double sin2, double cos2)
{
    double spread = alpha * alpha * cos2 + sin2;
    return alpha * alpha / (pi * spread * spread);
}

double ggx_twin_visibility(double alpha, double m_o, double m_i)
{
    return 0.5 / (m_o * s_of(alpha, m_i) + m_i * s_of(alpha, m_o));
}

/* ---- quadrature -------------------------------------------------------------------------------
 *
 * Over facets as vggx_draw_facet draws them light keeps the share G2 / G1: one less it is written
 * without a difference of like numbers. v = 1 - r with r = y^4: most of the loss is in steep
 * facets, far out in the density, where r is small.
 */

ggx_twin_share ggx_twin_integral(double alpha, double m, int v_steps, int u_steps)
{
    double across = sqrt(1.0 - m * m), size = sqrt(alpha * alpha * across * across + m * m);
    double ox = alpha * across / size, oz = m / size, s_o = s_of(alpha, m);
    ggx_twin_share sum = { 0 };
    for (int a = 0; a < v_steps; a++) {
        double y = (a + 0.5) / v_steps, r = y * y * y * y;
        double weight = 4.0 * y * y * y / v_steps / u_steps;
        double up = r * (1.0 + oz), z = up - oz, side = sqrt(fmax(1.0 - z * z, 0.0));
        for (int b = 0; b < u_steps; b++) {
            double phi = pi * (b + 0.5) / u_steps;
            double hx = alpha * (side * cos(phi) + ox), hy = alpha * side * sin(phi);
            double h = sqrt(hx * hx + hy * hy + up * up), o_h = (hx * across + up * m) / h;
            double m_i = 2.0 * o_h * up / h - m;
            double s_i = s_of(alpha, m_i), kept = m * s_i + m_i * s_o;
            double lost =
                m_i > 0.0 ? m * alpha * alpha * (1.0 - m_i * m_i) / ((s_i + m_i) * kept) : 1.0;
            sum.loss += weight * lost;
            sum.schlick += weight * (1.0 - lost) * pow(fmax(1.0 - o_h, 0.0), 5.0);
        }
    }
    return sum;
}

/* ---- the tables -------------------------------------------------------------------------------
 */

static const double least_root = 0.177827941003892280, scale = (double)GGX_COLUMN_SCALE;

double ggx_twin_root(double row) { return least_root + (1.0 - least_root) * row / (GGX_ROWS - 1); }

double ggx_twin_cosine(double alpha, double column)
{
    double most = log(1.0 + scale / sqrt(alpha));
    double root = (exp(most * column / (GGX_COLUMNS - 1)) - 1.0) / scale;
    return fmin(root * root * alpha, 1.0);
}

/* Lagrange's weights of the four places from the one before y on; which that is. */
static int cubic_weights(double y, double w[4])
{
    int j    = (int)fmin(fmax(floor(y), 1.0), GGX_COLUMNS - 3);
    double f = y - j;
    w[0]     = -f * (f - 1.0) * (f - 2.0) / 6.0;
    w[1]     = (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0;
    w[2]     = -(f + 1.0) * f * (f - 2.0) / 2.0;
    w[3]     = (f + 1.0) * f * (f - 1.0) / 6.0;
    return j - 1;
}

static double blend(const float *row, const double w[4])
{
    return w[0] * (double)row[0] + w[1] * (double)row[1] + w[2] * (double)row[2] +
           w[3] * (double)row[3];
}

/* At places along rows and columns. */
static ggx_twin_share at(double x, double y)
{
    double w[4];
    int i     = (int)fmin(fmax(floor(x), 0.0), GGX_ROWS - 2);
    double f  = x - i;
    size_t r0 = (size_t)(i * GGX_COLUMNS + cubic_weights(y, w)), r1 = r0 + GGX_COLUMNS;
    return (ggx_twin_share){ (1.0 - f) * blend(ggx_loss + r0, w) + f * blend(ggx_loss + r1, w),
                             (1.0 - f) * blend(ggx_schlick + r0, w) +
                                 f * blend(ggx_schlick + r1, w) };
}

static double row_of(double alpha)
{
    return (pow(alpha, 0.25) - least_root) / (1.0 - least_root) * (GGX_ROWS - 1);
}

ggx_twin_share ggx_twin_lookup(double alpha, double m)
{
    double y = log(1.0 + scale * sqrt(m / alpha)) / log(1.0 + scale / sqrt(alpha));
    return at(row_of(alpha), y * (GGX_COLUMNS - 1));
}

/* By Simpson's rule over the columns, each cut in 16: 2 m dm = d(m^2). */
ggx_twin_share ggx_twin_mean(double alpha)
{
    enum { CUTS = 16, STEPS = (GGX_COLUMNS - 1) * CUTS };
    const double dy = 1.0 / CUTS, most = log(1.0 + scale / sqrt(alpha));
    double x           = row_of(alpha);
    ggx_twin_share sum = { 0 };
    for (int k = 0; k <= STEPS; k++) {
        double e = exp(most * k * dy / (GGX_COLUMNS - 1)), root = (e - 1.0) / scale;
        double m      = alpha * root * root;
        double slope  = alpha * 2.0 * root * e / scale * most / (GGX_COLUMNS - 1); /* dm / dy */
        double weight = (k == 0 || k == STEPS ? 1.0 : k % 2 ? 4.0 : 2.0) * dy / 3.0;
        ggx_twin_share here = at(x, k * dy);
        sum.loss += weight * 2.0 * m * slope * here.loss;
        sum.schlick += weight * 2.0 * m * slope * here.schlick;
    }
    return sum;
}

/* ---- the surface ------------------------------------------------------------------------------
 */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static ggx_twin_share mean_between(double alpha)
{
    double x = row_of(alpha) * GGX_MEAN_STEPS;
    int k    = (int)fmin(fmax(floor(x), 0.0), GGX_MEANS - 2);
    double f = x - k;
    return (ggx_twin_share){
        (1.0 - f) * (double)ggx_mean_loss[k] + f * (double)ggx_mean_loss[k + 1],
        (1.0 - f) * (double)ggx_mean_schlick[k] + f * (double)ggx_mean_schlick[k + 1]
    };
}

/* One channel: what the surface is made of. */
typedef struct channel {
    double f0, f90, several, matt, clear, luminance;
} channel;

static channel channel_of(const gloss_desc *d, int c, double mean_loss)
{
    static const double weights[3] = { 0.2126, 0.7152, 0.0722 };
    const float base[]             = { d->base_color.x, d->base_color.y, d->base_color.z };
    const float tint[] = { d->specular_color.x, d->specular_color.y, d->specular_color.z };
    double metallic = (double)d->metallic, b = (double)base[c], t = (double)d->transmission;
    double ior = (double)d->ior, root = ior == 0.0 ? 1.0 : (ior - 1.0) / (ior + 1.0);
    double plain = fmin(root * root * (double)tint[c], 1.0) * (double)d->specular;
    channel k    = { .f0        = plain * (1.0 - metallic) + b * metallic,
                     .f90       = (double)d->specular * (1.0 - metallic) + metallic,
                     .matt      = b * (1.0 - metallic) * (1.0 - t),
                     .clear     = b * (1.0 - metallic) * t,
                     .luminance = weights[c] };
    double mean  = k.f0 + (k.f90 - k.f0) / 21.0;
    k.several    = mean * mean * (1.0 - mean_loss) / (1.0 - mean * mean_loss);
    return k;
}

static double enters(const channel *k, ggx_twin_share s)
{
    return (1.0 - k->f0) * (1.0 - s.loss - s.schlick) + (1.0 - k->f90) * s.schlick +
           (1.0 - k->several) * s.loss;
}

/* The half vector between o and i, or i mirrored: its angles. */
typedef struct facet {
    double sin2, cos2, o_h;
} facet;

static facet facet_of(const double n[3], const double wo[3], const double wi[3], double m_o,
                      double m_i)
{
    double up = m_o + fabs(m_i), h[3], along2 = 0.0;
    for (int c = 0; c < 3; c++) {
        double away = wo[c] - m_o * n[c] + wi[c] - m_i * n[c];
        along2 += away * away;
        h[c] = away + up * n[c];
    }
    double h2 = along2 + up * up, size = sqrt(h2);
    return (facet){ along2 / h2, up * up / h2, dot(h, wo) / size };
}

gloss_twin gloss_twin_of(const gloss_desc *d, const double n[3], const double wo[3],
                         const double wi[3])
{
    double roughness = fmax((double)d->roughness, (double)GGX_LEAST_ROUGHNESS);
    double alpha = roughness * roughness, m_o = dot(n, wo), m = dot(n, wi), m_i = fabs(m);
    facet h          = facet_of(n, wo, wi, m_o, m);
    double density   = ggx_twin_density(alpha, h.sin2, h.cos2);
    double single    = density * ggx_twin_visibility(alpha, m_o, m_i);
    double off       = density / (2.0 * (m_o + s_of(alpha, m_o)));
    double lossy     = m_i / (pi * (alpha * alpha + m_i * m_i) * log1p(1.0 / (alpha * alpha)));
    ggx_twin_share o = ggx_twin_lookup(alpha, m_o), i = ggx_twin_lookup(alpha, m_i);
    ggx_twin_share mean = mean_between(alpha);
    double lost         = o.loss * i.loss / (pi * mean.loss);

    gloss_twin r   = { 0 };
    double part[5] = { 0 }; /* once, through; several, through; matt */
    for (int c = 0; c < 3; c++) {
        channel k = channel_of(d, c, mean.loss);
        double f  = k.f0 + (k.f90 - k.f0) * pow(1.0 - h.o_h, 5.0);
        double in = enters(&k, o), in_mean = enters(&k, mean);
        double base  = in_mean > 0.0 ? k.matt * in * enters(&k, i) / (pi * in_mean) : 0.0;
        double back  = f * single + k.several * lost + base;
        double past  = k.clear * ((1.0 - f) * single + (1.0 - k.several) * lost);
        double plain = 1.0 - o.loss - o.schlick;
        r.f_cos[c]   = (m > 0.0 ? back : past) * m_i;
        r.albedo[c]  = 1.0 - in + k.matt * in;
        part[0] += k.luminance * (k.f0 * plain + k.f90 * o.schlick);
        part[1] += k.luminance * k.clear * ((1.0 - k.f0) * plain + (1.0 - k.f90) * o.schlick);
        part[2] += k.luminance * k.several * o.loss;
        part[3] += k.luminance * k.clear * (1.0 - k.several) * o.loss;
        part[4] += k.luminance * k.matt * in;
    }
    double all   = part[0] + part[1] + part[2] + part[3] + part[4];
    double same  = part[0] * off + part[2] * lossy + part[4] * m_i / pi;
    double other = part[1] * off + part[3] * lossy;
    r.left       = all;
    r.pdf        = all > 0.0 ? (m > 0.0 ? same : other) / all : 0.0;
    return r;
}
