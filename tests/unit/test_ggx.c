/* tests/unit/test_ggx.c -- facets against closed forms and quadrature, and their tables.
 *
 * Called with the word `table` it prints materials/ggx_table.c.
 */
#include "materials/ggx.h"
#include "core/sampler.h"
#include "tests/ggx_twin.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979324;

/* ---- the tables -------------------------------------------------------------------------------
 */

static void print_numbers(const char *name, const char *size, const float *number, int count)
{
    printf("\nconst float %s[%s] = {", name, size);
    for (int i = 0; i < count; i++) {
        char text[32];
        snprintf(text, sizeof text, "%.5g", (double)number[i]);
        printf("%s%s%sf,", i % 8 ? " " : "\n    ", text, strpbrk(text, ".e") ? "" : ".0");
    }
    printf("\n};\n");
}

static float rounded(double a)
{
    char text[32];
    snprintf(text, sizeof text, "%.5g", a);
    return strtof(text, NULL);
}

/* The means are those of the tables that are linked: a first run fills these, a second one them. */
static int print_table(void)
{
    static float loss[GGX_PLACES], schlick[GGX_PLACES], mean[2][GGX_MEANS];
    for (int i = 0; i < GGX_PLACES; i++) {
        double alpha     = pow(ggx_twin_root(i / GGX_COLUMNS), 4.0);
        double m         = ggx_twin_cosine(alpha, i % GGX_COLUMNS);
        ggx_twin_share s = ggx_twin_integral(alpha, m, 800, 200);
        loss[i]          = rounded(s.loss);
        schlick[i]       = rounded(s.schlick);
    }
    for (int i = 0; i < GGX_MEANS; i++) {
        double alpha     = pow(ggx_twin_root((double)i / GGX_MEAN_STEPS), 4.0);
        ggx_twin_share s = ggx_twin_mean(alpha);
        mean[0][i]       = rounded(s.loss);
        mean[1][i]       = rounded(s.schlick);
    }
    printf("/* materials/ggx_table.c -- what meets several facets: see ggx.h. Printed by "
           "tests/unit/test_ggx.c,\n * whose tests work it out again. */\n"
           "#include \"materials/ggx.h\"\n\n/* clang-format off */\n");
    print_numbers("ggx_loss", "GGX_PLACES", loss, GGX_PLACES);
    print_numbers("ggx_schlick", "GGX_PLACES", schlick, GGX_PLACES);
    print_numbers("ggx_mean_loss", "GGX_MEANS", mean[0], GGX_MEANS);
    print_numbers("ggx_mean_schlick", "GGX_MEANS", mean[1], GGX_MEANS);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "table") == 0)
        return print_table();
    return 0;
}
