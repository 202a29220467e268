/* tests/cli/test_check.c -- lux4 check: what it says of lights, groups, glow and grids. */
#include "tests/box_gltf.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

/* A node `Spot` that carries no body, and two triangles of 0.5 m^2 that glow: 1 m^2 of pi L lm to
 * each side. */
#define MODEL(material)                                                                            \
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_materials_emissive_strength\"],"   \
    "\"materials\":[{" material "}],"                                                              \
    "\"buffers\":[{\"byteLength\":72,\"uri\":\"data:application/octet-stream;base64,"              \
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAA"                                             \
    "AAAAAAAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAA\"}],"                                        \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":72}],"                                          \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\","       \
    "\"min\":[0,0,0],\"max\":[1,1,0]}],"                                                           \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"            \
    "\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":["                                       \
    "{\"mesh\":0,\"translation\":[1,1,-1]},{\"name\":\"Spot\",\"translation\":[2,2,-2]}]}"

static const char model[] =
    MODEL("\"name\":\"glow\",\"emissiveFactor\":[1,1,1],"
          "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1]},"
          "\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":50}}");

static const char lamp[] = "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] x\n[MANUFAC] x\n"
                           "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 25\n0 180\n0\n100 100\n";

static const char study_text[] =
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\nscene: model.gltf\n"
    "luminaires: [{name: spot, photometry: lamp.ies, nodes: Spot, lumens: 600, group: desk}]\n"
    "lights:\n  - {type: point, at: [2, 1, 2], lumens: 100, dimming: 0.5, group: wall}\n"
    "  - {type: point, at: [1, 1, 2], lumens: 100, dimming: 0.5, group: wall}\n"
    "  - {name: warm, type: point, at: [1, 1, 2], lumens: 30, color: [1, 0, 0]}\n"
    "dimming: {desk: 0.25}\n"
    "grids:\n  - {name: plane-with-quite-a-long-name, on: room, height: 0.75, spacing: en12464}\n"
    "  - {name: heads, on: room, height: 1.2, spacing: 1, quantity: cylindrical}\n";

static char *folder_of_check(void)
{
    char *folder = folder_of_study(study_text);
    folder_write(folder, "model.gltf", model);
    folder_write(folder, "lamp.ies", lamp);
    return folder;
}

static void assert_says(const program_result *r, const char *what)
{
    if (!strstr(r->out, what))
        fail_msg("nothing of `%s` in:\n%s", what, r->out);
}

TEST(lights_are_listed_with_what_is_not_plain)
{
    char *folder     = folder_of_check();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "check", "study.yaml");
    assert_says(&r, "         1         150.0   group desk   dimmed to 0.25   at nodes Spot\n");
    assert_says(&r, "         2          50.0   group wall   dimmed to 0.5\n");
    assert_says(&r, "         1          30.0   group other   colour 4.7 0 0\n");
    assert_says(&r, "         1         314.2   2 triangles\n"); /* 2 pi 50 */
    program_free(&r);
    folder_free(folder);
}

TEST(a_schedule_tells_what_glows_beside_its_rows)
{
    char *folder     = folder_of_check();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml", "--schedule", "--direct-only", "--accuracy=50%");
    assert_says(&r, "glowing surfaces, of no known watts, give another 314.2 lm\n");
    assert_says(&r, "3 of 4 luminaires without watts");
    program_free(&r);
    folder_free(folder);
}

TEST(grids_are_listed_with_how_they_are_laid)
{
    char *folder     = folder_of_check();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "check", "study.yaml");
    assert_says(&r, "grid plane-with-quite-a-long-name ");
    assert_says(&r, " m apart (EN 12464-1), looking up\n");
    assert_says(&r, "12 sensors, 4 x 3, 1 x 1 m apart, cylindrical illuminance\n");
    program_free(&r);
    folder_free(folder);
}

TEST(groups_add_up_to_all_light)
{
    char *folder     = folder_of_check();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "check", "study.yaml", "--json");
    assert_true(json_is_valid(r.out));
    double glow = 100.0 * M_PI;
    assert_memory_equal(json_at(r.out, "groups.0.name"), "\"desk\"", 6);
    assert_near(json_number_at(r.out, "groups.0.lights"), 1.0, 0.0);
    assert_near(json_number_at(r.out, "groups.0.lumens"), 150.0, 1e-6);
    assert_near(json_number_at(r.out, "groups.1.lights"), 2.0, 0.0);
    assert_near(json_number_at(r.out, "groups.1.lumens"), 100.0, 1e-6);
    assert_memory_equal(json_at(r.out, "groups.2.name"), "\"other\"", 7);
    assert_near(json_number_at(r.out, "groups.2.lumens"), 30.0 + glow, 1e-6);
    assert_near(json_number_at(r.out, "lumens"), 280.0 + glow, 1e-6);
    assert_near(json_number_at(r.out, "lights"), 4.0, 0.0);
    assert_near(json_number_at(r.out, "glowing_triangles"), 2.0, 0.0);
    program_free(&r);
    folder_free(folder);
}

/* A solid box of 2 x 2 m stands in the way of 4 of 12 sensors; glTF's y is up. */
TEST(sensors_inside_furniture_are_counted)
{
    char *folder     = folder_of_check();
    program_result r = { 0 };
    folder_write(folder, "box.gltf",
                 "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":132,"
                 "\"uri\":\"box.bin\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":96},"
                 "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":36}],"
                 "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":"
                 "\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,1]},{\"bufferView\":1,"
                 "\"componentType\":5121,\"count\":36,\"type\":\"SCALAR\"}],"
                 "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
                 "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,"
                 "\"translation\":[1,0,-2],\"scale\":[2,2,2]}]}");
    float corners[8][3];
    static const unsigned char faces[36] = { 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                             2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5 };
    for (int i = 0; i < 8; i++)
        for (int c = 0; c < 3; c++)
            corners[i][c] = (float)(i >> c & 1);
    FILE *f = fopen(path_in(folder, "box.bin"), "wb");
    fwrite(corners, sizeof corners, 1, f);
    fwrite(faces, sizeof faces, 1, f);
    fclose(f);
    folder_write(folder, "box.yaml",
                 "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\nscene: box.gltf\n"
                 "lights: [{type: point, at: [2, 1, 2.3], lumens: 100}]\n"
                 "grids: [{name: g, on: room, height: 0.75, spacing: 1}]\n");
    LUX4(folder, 0, &r, "check", "box.yaml");
    assert_says(&r,
                "8 sensors, 4 x 3, 1 x 1 m apart, looking up; 4 more inside furniture left out\n");
    program_free(&r);
    folder_free(folder);
}

/* Each kind says what it reflects: one number where that is grey, three else. */
TEST(materials_are_listed_with_what_they_do)
{
    char *folder     = folder_of_check();
    program_result r = { 0 };
    folder_write(
        folder, "study.yaml",
        "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: {ceiling: 0.7, walls: [0.5, 0.25, "
        "0.125], floor: 0.2}}\nscene: model.gltf\nmaterials:\n"
        "  - {match: 'room: ceiling', mirror: 0.75}\n"
        "  - {match: 'room: floor', transmittance: 0.8}\n");
    LUX4(folder, 0, &r, "check", "study.yaml");
    assert_says(&r, "  room: ceiling          mirror                0.750   (by the study)\n");
    assert_says(&r, "  room: walls            diffuse   0.500 0.250 0.125\n");
    assert_says(&r, "  room: floor            pane                  0.");
    assert_says(&r, "   lets through 0.");
    assert_says(&r,
                "  glow                   diffuse               0.000   glows, 50 50 50 cd/m2\n");
    program_free(&r);
    folder_free(folder);
}

/* White of which a tenth is there, and nothing: 0.0995 and 0 of light come back, the rest goes
 * through. */
TEST(holes_reflect_nothing_and_let_all_through)
{
#define SHEET(alpha)                                                                               \
    MODEL("\"name\":\"sheet\",\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{"                  \
          "\"metallicFactor\":0,\"baseColorFactor\":[1,1,1," alpha "]}")
    static const char *const rows[][2] = {
        { SHEET("0.1"), "0.100   lets through 0.900   with holes\n" },
        { SHEET("0"), "0.000   lets through 1.000   with holes\n" },
    };
    char *folder     = folder_of_check();
    program_result r = { 0 };
    for (int i = 0; i < 2; i++) {
        folder_write(folder, "model.gltf", rows[i][0]);
        folder_write(folder, "study.yaml",
                     "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\nscene: model.gltf\n");
        LUX4(folder, 0, &r, "check", "study.yaml");
        assert_says(&r, rows[i][1]);
        assert_null(strstr(r.err, "99.5"));
    }
    program_free(&r);
    folder_free(folder);
}

#define FLAT_BRDF                                                                                  \
    "lux4 brdf 1\nparameters isotropic\ntheta_in 0 90\ntheta_out 0 90\ndelta_phi 0 180\nvalues\n"  \
    "0.0795775 0.0795775 0.0795775 0.0795775 0.0795775 0.0795775 0.0795775 0.0795775\n"

/* One value everywhere, 0.25 / pi: reciprocal, and nothing to be scaled. */
TEST(tables_are_listed_with_their_figures)
{
    char *folder     = folder_of_check();
    program_result r = { 0 };
    folder_write(folder, "flat.brdf", FLAT_BRDF);
    folder_write(folder, "study.yaml",
                 "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\nscene: model.gltf\n"
                 "materials: [{match: 'room: walls', brdf: flat.brdf}]\n");
    LUX4(folder, 0, &r, "check", "study.yaml");
    assert_says(&r, "  room: walls            brdf                  0.250   of ");
    assert_says(&r, "flat.brdf, reciprocity error 0.0 %   (by the study)\n");
    program_free(&r);
    folder_free(folder);
}

TEST(boxes_of_glass_are_told_of_with_the_place_in_the_study)
{
    char *folder        = folder_of_check();
    program_result r    = { 0 };
    const double low[3] = { 1, 1, 0.5 }, high[3] = { 2, 1.006, 1.5 };
    box_gltf_write(folder, "model.gltf", low, high, 0.0);
    folder_write(folder, "study.yaml",
                 "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\nscene: model.gltf\n"
                 "materials:\n  - {match: Side, transmittance: 0.8}\n");
    LUX4(folder, 0, &r, "check", "study.yaml");
    assert_non_null(strstr(r.err, "study.yaml:5:5: material \"Side\" has closed boxes of glass"));
    folder_write(folder, "study.yaml",
                 "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\nscene: model.gltf\n"
                 "materials:\n  - {match: Side, transmittance: 0.8, pane: box}\n");
    LUX4(folder, 0, &r, "check", "study.yaml");
    assert_null(strstr(r.err, "closed boxes"));
    assert_says(&r, "   closed boxes   (by the study)\n");
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(materials_are_listed_with_what_they_do),
        cmocka_unit_test(holes_reflect_nothing_and_let_all_through),
        cmocka_unit_test(tables_are_listed_with_their_figures),
        cmocka_unit_test(boxes_of_glass_are_told_of_with_the_place_in_the_study),
        cmocka_unit_test(lights_are_listed_with_what_is_not_plain),
        cmocka_unit_test(a_schedule_tells_what_glows_beside_its_rows),
        cmocka_unit_test(grids_are_listed_with_how_they_are_laid),
        cmocka_unit_test(groups_add_up_to_all_light),
        cmocka_unit_test(sensors_inside_furniture_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
