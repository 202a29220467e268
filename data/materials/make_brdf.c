/* data/materials/make_brdf.c -- writes carpaint.brdf and brushed.brdf, from models.
 *
 *     make_brdf carpaint|brushed > FILE
 *
 * Both are GGX lobes (Walter et al., "Microfacet Models for Refraction through Rough Surfaces",
 * EGSR 2007; anisotropic as by Heitz, JCGT 3(2) 2014) with Schlick's F:
 *
 *     f = D(h) F(i . h) / (2 (o.z L(i) + i.z L(o))),   L(w) = |(ax w.x, ay w.y, w.z)|
 *     D = 1 / (pi ax ay ((h.x/ax)^2 + (h.y/ay)^2 + h.z^2)^2)
 *
 * Car paint: a clear coat (F0 0.04, a 0.08; a hazed one, as a table of steps of degrees can have
 * it) on flakes of metal (a 0.35) on a base of pigment; light passes the coat twice, so that what
 * is below loses F both ways. Brushed metal: steel (F0 0.56) with 0.12 along x and 0.35 across, the
 * scratches running along x, so that highlights are drawn out along y.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const double DEG = M_PI / 180.0;

typedef struct vec {
    double x, y, z;
} vec;

static vec direction(double theta_deg, double phi_deg)
{
    double t = theta_deg * DEG, p = phi_deg * DEG;
    return (vec){ sin(t) * cos(p), sin(t) * sin(p), cos(t) };
}

static double fresnel(double f0, double cosine) { return f0 + (1.0 - f0) * pow(1.0 - cosine, 5.0); }

static double ggx(vec i, vec o, double ax, double ay, double f0)
{
    vec h     = { i.x + o.x, i.y + o.y, i.z + o.z };
    double l  = sqrt(h.x * h.x + h.y * h.y + h.z * h.z);
    double hx = h.x / (l * ax), hy = h.y / (l * ay), hz = h.z / l;
    double sum = hx * hx + hy * hy + hz * hz;
    double d   = 1.0 / (M_PI * ax * ay * sum * sum);
    double li  = sqrt(ax * ax * i.x * i.x + ay * ay * i.y * i.y + i.z * i.z);
    double lo  = sqrt(ax * ax * o.x * o.x + ay * ay * o.y * o.y + o.z * o.z);
    return d * fresnel(f0, 0.5 * l) / (2.0 * (o.z * li + i.z * lo)); /* i . h = |i + o| / 2 */
}

/* ---- files ----------------------------------------------------------------------------------- */

enum { MOST = 64 };

typedef struct axis {
    const char *name;
    int count;
    double at[MOST];
} axis;

static void print_axis(const axis *a)
{
    printf("%s", a->name);
    for (int i = 0; i < a->count; i++)
        printf(" %g", a->at[i]);
    printf("\n");
}

static const axis deltas     = { "delta_phi", 24, { 0,   15,  30,  45,  60,  90,  120,   140,
                                                    150, 155, 160, 163, 166, 168, 170,   172,
                                                    174, 175, 176, 177, 178, 179, 179.5, 180 } };
static const double PAINT[3] = { 0.28, 0.02, 0.03 }, FLAKE[3] = { 0.45, 0.10, 0.08 };

static void carpaint(void)
{
    axis in = { .name = "theta_in" };
    for (int i = 0; i <= 28; i++) /* beyond 84 degrees a table is what it is there */
        in.at[in.count++] = 3.0 * i;
    axis out = in;
    out.name = "theta_out";
    printf("parameters isotropic\nbands R G B\nunit 1/sr\n");
    print_axis(&in);
    print_axis(&out);
    print_axis(&deltas);
    printf("values\n");
    for (int a = 0; a < in.count; a++)
        for (int b = 0; b < out.count; b++) {
            for (int c = 0; c < deltas.count; c++) {
                vec i = direction(in.at[a], 0.0), o = direction(out.at[b], deltas.at[c]);
                double coat  = ggx(i, o, 0.08, 0.08, 0.04);
                double below = (1.0 - fresnel(0.04, i.z)) * (1.0 - fresnel(0.04, o.z));
                double flake = ggx(i, o, 0.35, 0.35, 0.6);
                for (int k = 0; k < 3; k++)
                    printf("%s%.3g", c || k ? " " : "",
                           coat + below * (PAINT[k] / M_PI + FLAKE[k] * flake));
            }
            printf("\n");
        }
}

static void brushed(void)
{
    axis in = { "theta_in", 11, { 0, 10, 20, 30, 40, 50, 58, 66, 74, 80, 84 } }, phi_in = { 0 };
    axis out = in;
    for (int i = 0; i < 24; i++)
        phi_in.at[phi_in.count++] = 15.0 * i;
    axis phi_out = phi_in;
    out.name     = "theta_out";
    phi_in.name  = "phi_in";
    phi_out.name = "phi_out";
    printf("parameters anisotropic\nbands grey\nunit 1/sr\n");
    print_axis(&in);
    print_axis(&phi_in);
    print_axis(&out);
    print_axis(&phi_out);
    printf("values\n");
    for (int a = 0; a < in.count; a++)
        for (int b = 0; b < phi_in.count; b++)
            for (int c = 0; c < out.count; c++) {
                for (int d = 0; d < phi_out.count; d++) {
                    vec i = direction(in.at[a], phi_in.at[b]);
                    vec o = direction(out.at[c], phi_out.at[d]);
                    printf("%s%.3g", d ? " " : "", ggx(i, o, 0.12, 0.35, 0.56));
                }
                printf("\n");
            }
}

int main(int argc, char **argv)
{
    bool paint = argc == 2 && !strcmp(argv[1], "carpaint");
    if (!paint && (argc != 2 || strcmp(argv[1], "brushed"))) {
        fprintf(stderr, "use: make_brdf carpaint|brushed > FILE\n");
        return 2;
    }
    printf("lux4 brdf 1\n# %s: made by data/materials/make_brdf.c, which has the model\n", argv[1]);
    if (paint)
        carpaint();
    else
        brushed();
    return 0;
}
