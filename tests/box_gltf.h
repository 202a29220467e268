/* tests/box_gltf.h -- a closed box as a glTF file, for tests of the program. */
#ifndef TESTS_BOX_GLTF_H
#define TESTS_BOX_GLTF_H

/* Writes FOLDER/NAME: a box from low to high (m, z up, as in the study) that looks outward, of
 * reflectance 0.5, of the one node `Box`. Emission: of all its sides, cd/m^2, 0 to 1. */
void box_gltf_write(const char *folder, const char *name, const double low[3], const double high[3],
                    double emission);

#endif
