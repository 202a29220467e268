/* tests/cli/test_round_views.c -- views all around: what they see of a room, and nothing beside it.
 */
#include "core/image.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <string.h>

/* The eye is in the middle of 4 m by 3 m by 2 m. */
static const char room[] =
    "lux4: 1\nroom: {size: [4, 3, 2], reflectance: 0.5}\n"
    "lights: [{type: point, at: [2, 1.5, 1.5], intensity: 100}]\n"
    "views:\n"
    "  - {name: eye, eye: [2, 1.5, 1], target: [2, 3, 1], projection: fisheye, size: [90, 60]}\n"
    "  - {name: round, eye: [2, 1.5, 1], target: [4, 1.5, 2], projection: panorama, size: [120, "
    "60]}\n";

static const float *channel_of(const image *im, const char *name)
{
    for (int i = 0; i < im->channel_count; i++)
        if (!strcmp(im->channels[i].name, name))
            return im->channels[i].values;
    fail_msg("no channel %s", name);
    return NULL;
}

static void render(arena *a, const char *name, image *im)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    lux_error err    = { 0 };
    LUX4(folder, 0, &r, "render", "study.yaml", "--accuracy", "60%");
    if (!image_read_exr(path_in(folder, name), a, im, &err))
        fail_msg("%s", err.text);
    program_free(&r);
    folder_free(folder);
}

/* How far the walls are from the middle of the room along w, and which axis they are square to. */
static double to_wall(const double w[3], int *axis)
{
    static const double half[3] = { 2.0, 1.5, 1.0 };
    double near                 = HUGE_VAL;
    for (int k = 0; k < 3; k++)
        if (half[k] / fabs(w[k]) < near)
            near = half[k] / fabs(w[k]), *axis = k;
    return near;
}

/* A pixel that looks along w at its middle. A mean over a pixel of 3 degrees differs from its
 * middle by 1 % where the wall is seen flat; next to a corner of the room it is not looked at. */
static void assert_sees(const image *im, int x, int y, const double w[3])
{
    static const char *const names[3] = { "normal.X", "normal.Y", "normal.Z" };
    int axis = 0, i = y * im->width + x;
    double far = to_wall(w, &axis);
    if (fabs((double)channel_of(im, names[axis])[i]) < 0.9999)
        return;
    assert_near(channel_of(im, "Z")[i], far, 0.03);
    assert_near(channel_of(im, names[axis])[i], w[axis] > 0.0 ? -1.0 : 1.0, 1e-4);
    assert_true(channel_of(im, "R")[i] > 0.0f && channel_of(im, "illuminance.Y")[i] > 0.0f);
}

TEST(a_fisheye_sees_half_of_the_room_in_its_circle)
{
    arena a = { 0 };
    image im;
    render(&a, "out/eye.exr", &im);
    assert_int_equal(im.width, 90);
    assert_int_equal(im.height, 60);
    int inside = 0;
    for (int y = 0; y < 60; y++)
        for (int x = 0; x < 90; x++) {
            double right = (x + 0.5 - 45.0) / 30.0, up = (30.0 - y - 0.5) / 30.0;
            double r = sqrt(right * right + up * up), angle = 0.5 * M_PI * r;
            /* All but the half width, which is never less than what so many samples can tell */
            for (int c = 0; r > 1.05 && c < im.channel_count; c++)
                if (strcmp(im.channels[c].name, "halfWidth.Y") != 0)
                    assert_true(im.channels[c].values[y * 90 + x] == 0.0f);
            if (r > 0.95 || r == 0.0)
                continue;
            const double w[3] = { sin(angle) * right / r, cos(angle), sin(angle) * up / r };
            assert_sees(&im, x, y, w);
            inside++;
        }
    assert_true(inside > 2400);
    assert_near(channel_of(&im, "Z")[30 * 90 + 45], 1.5, 0.01);
    arena_clear(&a);
}

TEST(a_panorama_sees_all_of_the_room)
{
    arena a = { 0 };
    image im;
    render(&a, "out/round.exr", &im);
    for (int y = 0; y < 60; y++)
        for (int x = 0; x < 120; x++) {
            double f          = 0.5 * M_PI + 2.0 * M_PI * ((x + 0.5) / 120.0 - 0.5),
                   t          = M_PI * (y + 0.5) / 60.0;
            const double w[3] = { sin(t) * sin(f), sin(t) * cos(f), cos(t) };
            assert_sees(&im, x, y, w);
        }
    const float *z = channel_of(&im, "Z");
    assert_near(z[30 * 120 + 60], 2.0,
                0.01); /* +x in the middle: level, though the target is not */
    assert_near(z[30 * 120 + 90], 1.5, 0.01); /* to its right -y */
    assert_near(z[0], 1.0, 0.01);             /* the ceiling */
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fisheye_sees_half_of_the_room_in_its_circle),
        cmocka_unit_test(a_panorama_sees_all_of_the_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
