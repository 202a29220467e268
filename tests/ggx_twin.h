/* tests/ggx_twin.h -- materials/ggx.h and gloss.h once more, one direction at a time in double. */
#ifndef TESTS_GGX_TWIN_H
#define TESTS_GGX_TWIN_H

#include "materials/material.h"

typedef struct ggx_twin_share {
    double loss, schlick;
} ggx_twin_share;

/* As materials/ggx.h defines them, with S, D and V written out. */
double ggx_twin_density(double alpha, double sin2, double cos2);
double ggx_twin_visibility(double alpha, double m_o, double m_i);

/* By quadrature over the facets that are seen: steps in the square of (u, v), along v and half of
 * u. 800 and 200 are good for 1e-5. */
ggx_twin_share ggx_twin_integral(double alpha, double m, int v_steps, int u_steps);

/* The fourth root of alpha at a place along the rows, 0 ... GGX_ROWS - 1; the cosine at a place
 * along the columns. */
double ggx_twin_root(double row);
double ggx_twin_cosine(double alpha, double column);

/* The tables between their places; and their means over diffuse light, by quadrature. */
ggx_twin_share ggx_twin_lookup(double alpha, double m);
ggx_twin_share ggx_twin_mean(double alpha);

/* f |cos|, 1/sr, and pdf of such a surface (materials/gloss.c), n = +z or as given. */
typedef struct gloss_twin {
    double f_cos[3], pdf;
    double albedo[3];
    double left; /* what leaves, as luminance: the parts that the pdf is made of are shares of it */
} gloss_twin;
gloss_twin gloss_twin_of(const gloss_desc *d, const double n[3], const double wo[3],
                         const double wi[3]);

#endif
