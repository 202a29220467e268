/* tests/unit/test_study_messages.c -- each way to break a study, and what its author is told. */
#include "tests/study_text.h"
#include "tests/test.h"

#include <stdio.h>

TEST(other_versions_are_refused_before_their_keys)
{
    assert_study_refused(NULL, "lux4: 2\nnew: 3", ERR_UNSUPPORTED,
                         "1:7: version 2 of study files, this program knows 1");
    assert_study_refused(NULL, "new: 3\nlux4: 1.5", ERR_UNSUPPORTED,
                         "2:7: version 1.5 of study files, this program knows 1");
}

TEST(unknown_keys_are_named_with_the_nearest_known_one)
{
    static const broken_study table[] = {
        { "luminares: []", "2:1: unknown key `luminares`: did you mean `luminaires`?" },
        { "Grids: []", "2:1: unknown key `Grids`: did you mean `grids`?" },
        { "acuracy: 2%", "2:1: unknown key `acuracy`: did you mean `accuracy`?" },
        { "room: {seiz: [1, 1, 1]}", "2:8: unknown key `seiz`: did you mean `size`?" },
        { "views: [{name: a, tagret: [1,2,3]}]",
          "2:19: unknown key `tagret`: did you mean `target`?" },
        { "grids: [{name: a, require: {avarage: 5}}]",
          "2:29: unknown key `avarage`: did you mean `average`?" },
        { "grids: [{no: room}]", "2:10: unknown key `no`: did you mean `on`?" },
        { "room: {colour: red}",
          "2:8: unknown key `colour`: a room has size, reflectance, windows" },
        { "? [a]\n: b", "2:3: expected the name of a key, found a list of 1" },
        { "'': b", "2:1: unknown key an empty text: a study has lux4, room, scene, site, when, "
                   "sky, maintenance, luminaires, lights, dimming, materials, grids, views, "
                   "accuracy, variants" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

TEST(keys_stand_once_and_are_not_forgotten)
{
    static const broken_study table[] = {
        { "scene: a\nlights: []\nscene: b", "4:1: the key `scene` stands in line 2 already" },
        { "lights: [{type: point,\n type: point}]",
          "3:2: the key `type` stands in line 2 already" },
        { "room: {size: [1, 1, 1]}", "2:7: a room needs the key `reflectance`" },
        { "room: {size: [1, 1, 1], reflectance: {floor: 0, walls: 0}}",
          "2:38: a room's reflectance needs the key `ceiling`" },
        { "scene: [{scale: 2}]", "2:9: a scene needs the key `file`" },
        { "luminaires:\n  - photometry: a",
          "3:5: a luminaire takes one of `at`, `layout` and `nodes`" },
        { "luminaires: [{at: [0, 0, 0]}]", "2:14: a luminaire needs the key `photometry`" },
        { "lights: [{at: [0, 0, 0]}]", "2:10: a point light needs the key `type`" },
        { "lights: [{type: point, lumens: 1}]", "2:10: a point light needs the key `at`" },
        { "materials: [{reflectance: 1}]", "2:13: a material needs the key `match`" },
        { "grids: [{points: a}]", "2:9: a grid needs the key `name`" },
        { "grids: [{name: a}]", "2:9: a grid needs `on`, or `origin`, `u` and `v`, or `points`" },
        { "grids: [{name: a, on: room, spacing: 1}]",
          "2:9: a grid with `on: room` needs the key `height`" },
        { "grids: [{name: a, origin: [0,0,0], u: [1,0,0], spacing: 1}]",
          "2:9: a grid with `origin` needs the key `v`" },
        { "views: [{eye: [0,0,0]}]", "2:9: a view needs the key `name`" },
        { "views: [{name: a, eye: [0,0,0]}]",
          "2:9: a view without `camera` needs the key `target`" },
        { "views: [{name: a, eye: [0,0,0], target: [1,0,0], projection: orthographic}]",
          "2:9: a view in orthographic projection needs the key `width`" },
        { "sky: {}", "2:6: a sky needs the key `model`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
    assert_study_refused(NULL, "scene: a", ERR_FORMAT, "1:1: a study needs the key `lux4`");
}

TEST(values_of_the_wrong_type_are_shown)
{
    static const broken_study table[] = {
        { "room: 5", "2:7: expected a mapping (key: value), found `5`" },
        { "room:", "2:6: expected a mapping (key: value), found nothing" },
        { "room: {size: 5}", "2:14: expected [x, y, z], found `5`" },
        { "room: {size: [1, 2]}", "2:14: expected [x, y, z], found a list of 2" },
        { "room: {size: [1, abc, 2]}", "2:18: expected a number > 0, found `abc`" },
        { "scene: {file: a, scale: \"2\"}", "2:25: expected a number > 0, found the text `2`" },
        { "scene: {file: a, scale: [2]}", "2:25: expected a number > 0, found a list of 1" },
        { "scene: {file: a, lights: maybe}", "2:26: expected on or off, found `maybe`" },
        { "scene: {file: a, at: here}",
          "2:22: expected [x, y, z] or a list of such, found `here`" },
        { "scene: {file: a, at: []}",
          "2:22: expected [x, y, z] or a list of such, found a list of 0" },
        { "scene: {file: a, at: [[0,0,0], 3]}", "2:32: expected [x, y, z], found `3`" },
        { "scene: {file: {}}", "2:15: expected the name of a file, found a mapping" },
        { "scene:", "2:7: expected the name of a file, found nothing" },
        { "luminaires: {}", "2:13: expected a list, found a mapping" },
        { "luminaires: [a]", "2:14: expected a mapping (key: value), found `a`" },
        { "lights: [{type: lamp}]",
          "2:17: expected point or cone or cosine or parallel or linear or disk or rect, found "
          "`lamp`" },
        { "materials: [{match: ~, reflectance: 1}]", "2:21: expected a text, found `~`" },
        { "grids: [{name: a, on: desk}]",
          "2:23: expected room or floor or ceiling or south or east or north or west or walls, "
          "found `desk`" },
        { "grids: [{name: a, spacing: en1246}]",
          "2:28: expected a number > 0 or en12464, found `en1246`" },
        { "views: [{name: a, size: 5}]",
          "2:25: expected two whole numbers from 1 to 16384, found `5`" },
        { "views: [{name: a, size: [640, 480.5]}]",
          "2:31: expected two whole numbers from 1 to 16384, found `480.5`" },
        { "views: [{name: a, projection: flat}]",
          "2:31: expected perspective or orthographic or fisheye or panorama, found `flat`" },
        { "accuracy: 0.02", "2:11: expected a percentage with its sign, as 2%, found `0.02`" },
        { "maintenance: on", "2:14: expected a number > 0 and at most 1, found `on`" },
        { "sky: none", "2:6: expected a mapping (key: value), found `none`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
    assert_study_refused(NULL, "lux4", ERR_FORMAT,
                         "1:1: expected a study (lux4: 1 ...), found `lux4`");
    assert_study_refused(NULL, "[lux4]", ERR_FORMAT,
                         "1:1: expected a study (lux4: 1 ...), found a list of 1");
    assert_study_refused(NULL, "lux4: one", ERR_FORMAT, "1:7: expected a number, found `one`");
}

TEST(numbers_outside_their_range_are_shown)
{
    static const broken_study table[] = {
        { "room: {size: [1, -1, 2]}", "2:18: expected a number > 0, found `-1`" },
        { "room: {size: [1, 0, 2]}", "2:18: expected a number > 0, found `0`" },
        { "room: {size: [1, 1e-300, 2]}",
          "2:18: expected a number of at least 1e-9, found `1e-300`" },
        { "room: {size: [1, 1e13, 2]}", "2:18: expected a number of at most 1e12, found `1e13`" },
        { "room: {size: [1, .inf, 2]}", "2:18: expected a number > 0, found `.inf`" },
        { "room: {size: [1, .nan, 2]}", "2:18: expected a number > 0, found `.nan`" },
        { "room: {size: [1, nan, 2]}", "2:18: expected a number > 0, found `nan`" },
        { "room: {size: [1, 1e400, 2]}", "2:18: expected a number > 0, found `1e400`" },
        { "room: {size: [1, 0x, 2]}", "2:18: expected a number > 0, found `0x`" },
        { "room: {size: [1, 0o8, 2]}", "2:18: expected a number > 0, found `0o8`" },
        { "room: {size: [1, '1', 2]}", "2:18: expected a number > 0, found the text `1`" },
        { "room: {size: [1, 1_0, 2]}", "2:18: expected a number > 0, found `1_0`" },
        { "room: {reflectance: 1.01}", "2:21: expected a number from 0 to 1, found `1.01`" },
        { "room: {reflectance: [0, 1, -0.1]}",
          "2:28: expected a number from 0 to 1, found `-0.1`" },
        { "luminaires: [{aim: [0, 0, 0]}]", "2:20: expected a direction, found no length" },
        { "luminaires: [{dimming: -1}]", "2:24: expected a number >= 0, found `-1`" },
        { "lights: [{type: point, intensity: -1}]", "2:35: expected a number >= 0, found `-1`" },
        { "views: [{fov: 180}]", "2:15: expected an angle > 0 and < 180 degrees, found `180`" },
        { "views: [{fov: 0}]", "2:15: expected an angle > 0 and < 180 degrees, found `0`" },
        { "views: [{size: [0, 5]}]",
          "2:17: expected two whole numbers from 1 to 16384, found `0`" },
        { "views: [{size: [16384, 16384]}]",
          "2:16: 16384 by 16384 pixels, expected at most 67108864 altogether" },
        { "accuracy: 0%", "2:11: expected a percentage > 0 and at most 100%, found `0%`" },
        { "accuracy: 101%", "2:11: expected a percentage > 0 and at most 100%, found `101%`" },
        { "maintenance: 0", "2:14: expected a number > 0 and at most 1, found `0`" },
        { "maintenance: 1.1", "2:14: expected a number > 0 and at most 1, found `1.1`" },
        { "grids: [{require: {uniformity: 2}}]",
          "2:32: expected a number > 0 and at most 1, found `2`" },
        { "grids: [{spacing: 0}]", "2:19: expected a number > 0, found `0`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

TEST(colors_are_temperatures_or_channels)
{
    static const char wanted[]     = "2:22: expected a colour temperature from 1000K to 25000K or "
                                     "[r, g, b], found ";
    static const char *const bad[] = { "4000", "K", "999K", "25001K", "4000 kelvin", "warm" };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[200], says[200];
        snprintf(text, sizeof text, "lux4: 1\nluminaires: [{color: %s}]", bad[i]);
        snprintf(says, sizeof says, "%s`%s`", wanted, bad[i]);
        assert_study_refused(NULL, text, ERR_FORMAT, says);
    }
    static const broken_study table[] = {
        { "luminaires: [{color: [0, 0, 0]}]", "2:22: expected a colour, found black" },
        { "luminaires: [{color: [1, -1, 0]}]", "2:26: expected a number >= 0, found `-1`" },
        { "luminaires: [{color: [1, 0]}]",
          "2:22: expected a colour temperature as 4000K or [r, g, b], found a list of 2" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

TEST(what_contradicts_itself_is_refused)
{
    static const broken_study table[] = {
        { "lights: [{type: point, at: [0, 0, 0]}]",
          "2:10: a point light takes either `intensity` or `lumens`, found neither" },
        { "lights: [{type: point, at: [0, 0, 0], lumens: 1, intensity: 1}]",
          "2:10: a point light takes either `intensity` or `lumens`, found both" },
        { "luminaires: [{photometry: a, at: [0, 0, 0], lumens: 1, lamp_lumens: 1}]",
          "2:14: a luminaire takes `lumens` or `lamp_lumens`, not both" },
        { "grids: [{name: a, points: a.csv, spacing: 1}]",
          "2:43: `spacing` does not go with `points`" },
        { "grids: [{name: a, points: a.csv, u: [1, 0, 0]}]",
          "2:37: `u` does not go with `points`" },
        { "grids: [{name: a, on: room, height: 1, spacing: 1, points: b}]",
          "2:60: `points` does not go with `on`" },
        { "grids: [{name: a, origin: [0,0,0], u: [1,0,0], v: [0,1,0], spacing: 1, margin: 1}]",
          "2:80: `margin` does not go with `origin`" },
        { "grids: [{name: a, on: room, height: 1, spacing: 1}]",
          "2:9: a grid with `on` needs a room, but there is no `room`" },
        { "room: {size: [4, 3, 2], reflectance: 0}\n"
          "grids: [{name: a, on: room, height: 2, spacing: 1}]",
          "3:9: `height: 2` is not below the ceiling at 2 m" },
        { "room: {size: [4, 3, 2], reflectance: 0}\n"
          "grids: [{name: a, on: room, height: 1, spacing: 1, margin: 1.5}]",
          "3:9: `margin: 1.5` leaves nothing of a room of 4 by 3 m" },
        { "grids: [{name: a, origin: [0,0,0], u: [1,1,0], v: [-2,-2,0], spacing: 1}]",
          "2:9: `u` and `v` are parallel" },
        { "grids: [{name: a, origin: [0,0,0], u: [2001,0,0], v: [0,2000,0], spacing: 1}]",
          "2:9: 2001 by 2000 sensors, expected at most 4000000" },
        { "grids: [{name: a, origin: [0,0,0], u: [1e12,0,0], v: [0,1e12,0], spacing: 1e-9}]",
          "2:9: 1000000000000000000000 by 1000000000000000000000 sensors, expected at most "
          "4000000" },
        { "views: [{name: a, eye: [0,0,0], target: [0,0,0]}]",
          "2:9: `eye` and `target` are at the same place" },
        { "views: [{name: a, camera: b, fov: 5}]",
          "2:35: `fov` does not go with `camera`, which has its own" },
        { "views: [{name: a, eye: [0,0,0], target: [1,0,0], width: 3}]",
          "2:57: `width` does not go with perspective, which has a `fov`" },
        { "views: [{name: a, eye: [0,0,0], target: [1,0,0], projection: orthographic, width: 3, "
          "fov: 5}]",
          "2:91: `fov` does not go with orthographic projection, which has a `width`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

TEST(names_can_be_names_of_files_and_differ)
{
    static const char *const bad[] = { ".a", "-a", "a/b", "..", "a b", "\xc3\xa9", "a:b" };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[100], says[200];
        snprintf(text, sizeof text, "lux4: 1\nviews: [{name: %s}]", bad[i]);
        snprintf(says, sizeof says,
                 "2:16: expected a name of a-z, A-Z, 0-9, _, - and . that does "
                 "not begin with - or . (it names files), found `%s`",
                 bad[i]);
        assert_study_refused(NULL, text, ERR_FORMAT, says);
    }
    static const broken_study table[] = {
        { "views: [{name: }]", "2:16: expected a name, found nothing" },
        { "views: [{name: ''}]", "2:16: expected a name, found an empty text" },
        { "views: [{name: \"a\\0b\"}]",
          "2:16: expected a text without control characters, found the text `a?b`" },
        { "views: [{name: aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"
          "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa}]",
          "2:16: expected a name of at most 100 characters (it names files), found "
          "`aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa...`" },
        { "grids:\n  - {name: a, points: x}\n  - {name: a, points: y}",
          "4:5: the name `a` is taken by the grid or view of line 3" },
        { "views:\n  - {name: a, camera: x}\ngrids:\n  - {name: a, points: y}",
          "5:5: the name `a` is taken by the grid or view of line 3" },
        { "luminaires:\n  - {name: a, photometry: x, at: [0, 0, 0]}\n"
          "  - {photometry: x, at: [0, 0, 0]}\n  - {name: a, photometry: x, at: [0, 0, 0]}",
          "5:5: the name `a` is taken by the luminaire of line 3" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_versions_are_refused_before_their_keys),
        cmocka_unit_test(unknown_keys_are_named_with_the_nearest_known_one),
        cmocka_unit_test(keys_stand_once_and_are_not_forgotten),
        cmocka_unit_test(values_of_the_wrong_type_are_shown),
        cmocka_unit_test(numbers_outside_their_range_are_shown),
        cmocka_unit_test(colors_are_temperatures_or_channels),
        cmocka_unit_test(what_contradicts_itself_is_refused),
        cmocka_unit_test(names_can_be_names_of_files_and_differ),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
