/* tests/physics/test_roulette_materials.c -- by way of every material comes the same light,
 * whatever finds it and wherever roulette begins.
 */
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/program.h"
#include "tests/test.h"

/* A lamp in a grey room with a body of it on the floor: other depths, the same light. */
static void depths_agree(const char *looks, const char *made_of)
{
    lab l;
    lab_open(&l);
    quad body[6];
    quads_of_box((dvec3){ 1, 1, 0.5 }, (dvec3){ 3, 2, 1.2 }, body);
    lab_quads(&l, "body.gltf", body, 6, looks);
    const lab_probe p[] = { { { 0.5, 0.7, 1 }, { 0, 0, -1 } },
                            { { 3.5, 2.5, 0.2 }, { -1, 0, 0 } } };
    const char *yaml =
        text_of(&l.a,
                "room: {size: [4, 3, 2.5], reflectance: 0.7}\nscene: body.gltf\n"
                "lights: [{type: rect, at: [2, 1.5, 2.4], aim: [0, 0, -1], size: [1, 1], "
                "lumens: 3000}]\nmaterials: [%s]\n",
                made_of);
    grid_result first;
    lab_measure(&l, yaml, NULL, p, 2, &(run_options){ .accuracy = 0.01, .seed = 3 }, &first);
    lab_check_all_ways(looks, yaml, &l, p, 2, first.illuminance, 0.015, 0.03);
    lab_close(&l);
}

static void measured(const char *file)
{
    lab l;
    lab_open(&l);
    depths_agree("\"name\":\"Body\"",
                 text_of(&l.a, "{match: Body, brdf: %s/data/materials/%s, up: [0, 0, 1]}",
                         project_root(), file));
    lab_close(&l);
}

TEST(phong_surfaces_give_the_same_at_every_depth)
{
    depths_agree("\"name\":\"Body\"",
                 "{match: Body, reflectance: [0.5, 0.3, 0.1], specular: 0.4, exponent: 50}");
}

TEST(metals_give_the_same_at_every_depth)
{
    depths_agree("\"name\":\"Body\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.95,0.7,0.4,1],"
                 "\"roughnessFactor\":0.3}",
                 "");
}

TEST(plastics_give_the_same_at_every_depth)
{
    depths_agree("\"name\":\"Body\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.8,0.4,0.1,1],"
                 "\"metallicFactor\":0,\"roughnessFactor\":0.3}",
                 "");
}

TEST(frosted_glass_gives_the_same_at_every_depth)
{
    depths_agree("\"name\":\"Body\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
                 "\"roughnessFactor\":0.5},\"extensions\":{\"KHR_materials_transmission\":{"
                 "\"transmissionFactor\":1}}",
                 "");
}

TEST(panes_that_absorb_give_the_same_at_every_depth)
{
    depths_agree("\"name\":\"Body\"", "{match: Body, transmittance: [0.8, 0.5, 0.1]}");
}

TEST(measured_paint_gives_the_same_at_every_depth) { measured("carpaint.brdf"); }
TEST(measured_metal_gives_the_same_at_every_depth) { measured("brushed.brdf"); }
TEST(measured_glazing_gives_the_same_at_every_depth) { measured("glazing.xml"); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phong_surfaces_give_the_same_at_every_depth),
        cmocka_unit_test(metals_give_the_same_at_every_depth),
        cmocka_unit_test(plastics_give_the_same_at_every_depth),
        cmocka_unit_test(frosted_glass_gives_the_same_at_every_depth),
        cmocka_unit_test(panes_that_absorb_give_the_same_at_every_depth),
        cmocka_unit_test(measured_paint_gives_the_same_at_every_depth),
        cmocka_unit_test(measured_metal_gives_the_same_at_every_depth),
        cmocka_unit_test(measured_glazing_gives_the_same_at_every_depth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
