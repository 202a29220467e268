/* tests/unit/test_courtyard_study.c -- the study of the courtyard as shipped: what it finds in the
 * model, and the panorama beside it. */
#include "core/image.h"
#include "sim/sky_picture.h"
#include "tests/test.h"

#include <string.h>

static arena memory;

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

static const scene *scene_of_variant(const char *variant)
{
    lux_error err         = { 0 };
    notices said          = { .a = &memory };
    const scene_options o = { .threads = 1 };
    const study *s    = study_read(&memory, "data/courtyard/courtyard.yaml", variant, &said, &err);
    const scene *made = s ? scene_new(&memory, s, &o, &said, &err) : NULL;
    if (!made)
        fail_msg("%s", err.text);
    return made;
}

static bool meets_something(const scene *s, dvec3 from, dvec3 way)
{
    vray ray     = { vspread(scene_place(s, from)), vspread(d3_to_float(way)), vsplat(INFINITY) };
    vmask active = ALL_LANES;
    vhit hit;
    world_first_hit(s->world, &ray, &active, 1, RAYS_COHERENT, &hit);
    return lane(hit.instance, 0) >= 0;
}

/* From a grid of places in the room rays to all sides meet something: the panes close the hole. */
TEST(nothing_leaks_out_of_the_room)
{
    const scene *s = scene_of_variant("noon");
    for (int i = 0; i < 4000; i++) {
        double up = 1.0 - 2.0 * (i + 0.5) / 4000, turn = 2.399963 * i, r = sqrt(1.0 - up * up);
        dvec3 from = { 0.3 + 3.4 * (i % 7) / 6.0, 0.2 + 7.0 * (i % 11) / 10.0,
                       1.2 + 0.8 * (i % 3) };
        assert_true(meets_something(s, from, (dvec3){ r * cos(turn), r * sin(turn), up }));
    }
}

/* The panorama was made of the noon's sky by lux4 sky, 512 pixels wide: 0.7 degrees each. */
TEST(the_panorama_gives_the_light_of_the_sky_that_it_is_of)
{
    const scene *noon = scene_of_variant("noon"), *drawn = scene_of_variant("panorama");
    assert_int_equal(noon->sun_count, 1);
    assert_int_equal(drawn->sun_count, 1);
    sun_figures a = sun_figures_of(noon->lights[noon->light_count - 1]);
    sun_figures b = sun_figures_of(drawn->lights[drawn->light_count - 1]);
    assert_near(b.irradiance.y, a.irradiance.y, 1e-4);
    assert_true(d3_length(d3_sub(d3_from(a.to_sun), d3_from(b.to_sun))) < 0.35 * M_PI / 180.0);
    assert_near(drawn->skies[0].sky->horizontal.y, noon->skies[0].sky->horizontal.y, 1e-3);
}

/* As lux4 sky courtyard.yaml --variant noon --width 512 draws it. */
TEST(the_panorama_in_the_repository_is_that_which_the_program_makes)
{
    lux_error err = { 0 };
    float *rgb[3];
    image im;
    assert_true(image_read_exr("data/courtyard/noon.exr", &memory, &im, &err));
    assert_int_equal(im.width, 512);
    assert_int_equal(im.height, 256);
    assert_true(sky_panorama_picture(&memory, scene_of_variant("noon"), 512, rgb, &err));
    for (int c = 0; c < 3; c++) {
        assert_memory_equal(im.channels[c].name, &"BGR"[c], 1); /* as files have them */
        for (int i = 0; i < 512 * 256; i++)
            assert_near(im.channels[c].values[i], rgb[2 - c][i], 1e-5);
    }
}

/* Three panes are what daylight comes in by; facades, ground and trees are outside. */
TEST(the_study_finds_what_it_names)
{
    static const char *const outside[] = { "Facade plaster", "Facade pane", "Ground lawn",
                                           "Tree leaf" };
    const scene *s                     = scene_of_variant("overcast");
    int found                          = 0;
    assert_int_equal(s->portal_count, 3);
    assert_int_equal(s->sun_count, 0);
    for (int i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->material_info[i];
        for (int k = 0; k < 4; k++)
            found += m->exterior && !strcmp(m->name, outside[k]);
        assert_false(m->exterior && (!strcmp(m->name, "Wall paint") || !strcmp(m->name, "Oak")));
    }
    assert_int_equal(found, 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(nothing_leaks_out_of_the_room, forget),
        cmocka_unit_test_teardown(the_panorama_in_the_repository_is_that_which_the_program_makes,
                                  forget),
        cmocka_unit_test_teardown(the_panorama_gives_the_light_of_the_sky_that_it_is_of, forget),
        cmocka_unit_test_teardown(the_study_finds_what_it_names, forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
