/* data/materials/make_bsdf.c -- makes the measured layers that lux4 ships: README-bsdf.md.
 *
 *     make_bsdf FOLDER       glazing.xml and blind.xml
 */
#include "data/materials/bsdf_models.h"

#include <math.h>
#include <stdlib.h>

static int make_file(const bsdf_model *m, const char *folder, const char *name)
{
    char path[4096];
    if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path) {
        fprintf(stderr, "%s: too long\n", folder);
        return EXIT_FAILURE;
    }
    FILE *f         = fopen(path, "wb");
    const bool done = f && model_write(m, f);
    if (f && fclose(f) == 0 && done)
        return EXIT_SUCCESS;
    perror(path);
    return EXIT_FAILURE;
}

int main(int argc, char **argv)
{
    static bsdf_model m;
    const slats blind = slats_shipped();
    if (argc != 2) {
        fprintf(stderr, "usage: make_bsdf FOLDER\n");
        return EXIT_FAILURE;
    }
    model_glazing(&m);
    if (make_file(&m, argv[1], "glazing.xml") != EXIT_SUCCESS)
        return EXIT_FAILURE;
    if (!model_blind(&m, &blind)) {
        fprintf(stderr, "no memory\n");
        return EXIT_FAILURE;
    }
    return make_file(&m, argv[1], "blind.xml");
}
