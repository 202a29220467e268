/* tests/unit/test_effects.c -- which effects are told of, in scenes that have them or have not. */
#include "sim/effects.h"
#include "tests/folder.h"
#include "tests/panorama_file.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

#define ROOM  "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
#define DARK  "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0}\n"
#define POINT "{type: point, at: [2, 1, 2], lumens: 1}"
#define FOUR  POINT ", " POINT ", " POINT ", " POINT

/* The names of what is on, each with a blank behind it. */
static void assert_effects(const char *want, bool direct_only, bool outside, const char *text)
{
    arena a        = { 0 };
    char got[200]  = "";
    const scene *s = scene_of_text(&a, text);
    effects all    = effects_of_grids(s, direct_only, outside);
    for (int e = 0; e < EFFECTS; e++)
        if (all.on[e])
            strcat(strcat(got, effect_name((effect)e)), " ");
    assert_string_equal(got, want);
    arena_clear(&a);
}

TEST(a_lamp_in_a_bare_room_has_no_shadow)
{
    assert_effects("interreflection ", false, false, ROOM "lights: [" POINT "]\n");
    assert_effects("", true, false, ROOM "lights: [" POINT "]\n");
    assert_effects("", false, false, DARK "lights: [" POINT "]\n");
    assert_effects("", false, false, ROOM);
}

TEST(lamps_or_sensors_outside_are_shadowed)
{
    assert_effects("shadows ", true, true, ROOM "lights: [" POINT "]\n");
    assert_effects("shadows ", true, false,
                   ROOM "lights: [{type: point, at: [2, 1, 3], lumens: 1}]\n");
    assert_effects("", true, true, ROOM);
}

TEST(areas_and_colours_are_told)
{
    assert_effects("area-lights ", true, false,
                   ROOM "lights: [{type: disk, at: [2, 1, 2], radius: 0.1, lumens: 1}]\n");
    assert_effects("color ", true, false,
                   ROOM "lights: [" POINT
                        ", {type: point, at: [2, 1, 2], lumens: 1, color: 3000K}]\n");
    assert_effects("interreflection color ", false, false,
                   "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: {ceiling: 0, walls: 0, floor: "
                   "[0.2, 0.3, 0.2]}}\n"
                   "lights: [" POINT "]\n");
}

/* By a tree more than 12 lamps are chosen from where light comes back; of more than 16 that may be
 * hidden the strongest are asked. */
TEST(many_lamps_are_told_where_it_matters)
{
    assert_effects("interreflection ", false, false,
                   ROOM "lights: [" FOUR ", " FOUR ", " FOUR "]\n");
    assert_effects("many-lights interreflection ", false, false,
                   ROOM "lights: [" FOUR ", " FOUR ", " FOUR ", " POINT "]\n");
    assert_effects("", true, false, ROOM "lights: [" FOUR ", " FOUR ", " FOUR ", " POINT "]\n");
    assert_effects("shadows ", true, true,
                   ROOM "lights: [" FOUR ", " FOUR ", " FOUR ", " FOUR "]\n");
    assert_effects("shadows many-lights ", true, true,
                   ROOM "lights: [" FOUR ", " FOUR ", " FOUR ", " FOUR ", " POINT "]\n");
}

static void assert_of_luminaire(const char *want, const char *opening)
{
    char *folder = folder_new(), text[600];
    snprintf(text, sizeof text,
             "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] x\n[MANUFAC] x\nTILT=NONE\n"
             "1 -1 1 2 1 1 2 %s\n1 1 25\n0 90\n0\n100 100\n",
             opening);
    folder_write(folder, "lamp.ies", text);
    snprintf(text, sizeof text, ROOM "luminaires: [{photometry: %s/lamp.ies, at: [2, 1, 2]}]\n",
             folder);
    assert_effects(want, true, false, text);
    folder_free(folder);
}

TEST(a_luminaire_with_an_opening_has_a_near_field)
{
    assert_of_luminaire("area-lights near-field ", "0.3 0.6 0");
    assert_of_luminaire("", "0 0 0");
}

/* In a white room with one lamp; `measured` is one value everywhere. */
TEST(materials_call_for_effects)
{
#define LIT ROOM "lights: [" POINT "]\nmaterials: [{match: 'room: floor', "
    assert_effects("interreflection mirrors ", false, false, LIT "mirror: 0.5}]\n");
    assert_effects("", true, false, LIT "mirror: 0.5}]\n");
    assert_effects("interreflection ", false, false,
                   LIT "reflectance: 0.5, specular: 0.1, exponent: 9}]\n");
    assert_effects("interreflection mirrors tinted-shadows ", false, false,
                   LIT "transmittance: 0.5}]\n");
    assert_effects("tinted-shadows ", true, false, LIT "transmittance: 0.5}]\n");

    char *folder = folder_new(), text[600];
    folder_write(folder, "flat.brdf",
                 "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0\ndelta_phi 0\n"
                 "values 0.08\n");
    snprintf(text, sizeof text, LIT "brdf: %s/flat.brdf}]\n", folder);
    assert_effects("interreflection measured-brdf color ", false, false, text);
    assert_effects("color ", true, false, text); /* whatever a table holds */
    folder_free(folder);
}

/* A solid of glass with holes in it and a glowing sheet, from a glTF file. */
TEST(solids_and_holes_call_for_effects)
{
    char *folder = folder_new(), text[1200];
    folder_write(folder, "model.gltf",
                 "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"alphaMode\":\"MASK\","
                 "\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"extensions\":{"
                 "\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
                 "\"KHR_materials_volume\":{\"thicknessFactor\":1}}}],"
                 "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
                 "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAA\"}],"
                 "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                 "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":"
                 "\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}],"
                 "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
                 "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]}");
    snprintf(text, sizeof text,
             "lux4: 1\nscene: %s/model.gltf\nlights: [{type: point, at: [2, 1, 2], lumens: 1}]\n",
             folder);
    assert_effects("shadows interreflection mirrors refraction textures tinted-shadows color ",
                   false, true, text);
    folder_free(folder);
}

/* A sun is no area light, be it a disk or a point; what a closed room keeps out is told of, too. */
TEST(daylight_calls_for_its_effects)
{
#define HOLE                                                                                       \
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5, windows: [{wall: south, at: [1, 1], "    \
    "size: [2, 1]}]}\n"
#define SUN "sun_at: {azimuth: 180, elevation: 40}, horizontal: 10000, sun_illuminance: 50000"
    assert_effects("shadows sky portals interreflection ", false, false,
                   HOLE "sky: {model: overcast, horizontal: 10000}\n");
    assert_effects("shadows sun sky portals interreflection ", false, false,
                   HOLE "sky: {model: clear, sun: disk, " SUN "}\n");
    assert_effects("shadows sun sky portals ", true, false,
                   HOLE "sky: {model: clear, sun: point, " SUN "}\n");
    assert_effects("shadows sky portals ", true, false,
                   HOLE "sky: {model: clear, sun: off, sun_at: {azimuth: 180, elevation: 40}, "
                        "horizontal: 10000}\n");
    assert_effects("shadows sky ", true, false, ROOM "sky: {model: uniform, horizontal: 1}\n");
    assert_effects("", true, false, HOLE "sky: {model: none}\n");
}

TEST(skies_of_pictures_are_panoramas)
{
    char text[400];
    file_box b = file_box_new();
    file_box_fill(&b, 16, 8, 1.0f, 1.0f, 1.0f);
    file_box_store(&b, 16, 8);
    snprintf(text, sizeof text, HOLE "sky: {model: panorama, file: %s}\n", b.path);
    assert_effects("shadows sky portals panorama interreflection color ", false, false, text);
    file_box_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lamp_in_a_bare_room_has_no_shadow),
        cmocka_unit_test(lamps_or_sensors_outside_are_shadowed),
        cmocka_unit_test(areas_and_colours_are_told),
        cmocka_unit_test(many_lamps_are_told_where_it_matters),
        cmocka_unit_test(a_luminaire_with_an_opening_has_a_near_field),
        cmocka_unit_test(materials_call_for_effects),
        cmocka_unit_test(solids_and_holes_call_for_effects),
        cmocka_unit_test(daylight_calls_for_its_effects),
        cmocka_unit_test(skies_of_pictures_are_panoramas),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
