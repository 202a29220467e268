/* tests/physics/test_maps.c -- illumination maps: energy, cavities, walls, threads and files. */
#include "core/color.h"
#include "core/file.h"
#include "sim/map_parts.h"
#include "tests/folder.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static const map_options usual = {
    .seed = 1, .threads = 2, .particles = 1 << 18, .accuracy = 0.02, .deadline = HUGE_VAL
};

static const illumination_map *map_of(lab *l, const scene *s, const map_options *o)
{
    lux_error err             = { 0 };
    const illumination_map *m = illumination_map_new(&l->a, s, o, &err);
    if (!m)
        fail_msg("%s", err.text);
    return m;
}

/* What lies at the end of a ray, or nowhere: mean over all sets, lux, of the first channel. */
static bool lux_at(const scene *s, const illumination_map *m, dvec3 from, dvec3 way, double *fine)
{
    vec3 o = scene_place(s, from), d = d3_to_float(way);
    vray ray     = { vspread(o), vspread(d), vsplat(INFINITY) };
    vmask active = ALL_LANES;
    vhit hit;
    world_first_hit(s->world, &ray, &active, 1, RAYS_COHERENT, &hit);
    if (lane(hit.instance, 0) < 0)
        return false;
    vsurface at;
    world_surface(s->world, &hit, active, &at);
    vmask front = vdot(at.normal, ray.direction) < 0.0f;
    double sum  = 0.0;
    for (int set = 0; set < SCRAMBLES; set++) {
        vrgb e, c;
        vmask known = illumination_map_look(m, &hit, front, vsplat_int(set), -1, active, &e, &c);
        if (!(vbits(known) & 1))
            return false;
        sum += (double)lane(e.x, 0);
    }
    *fine = LUMENS_PER_WATT * sum / SCRAMBLES;
    return true;
}

static void assert_balanced(const illumination_map *m)
{
    map_figures f = illumination_map_figures(m);
    assert_near((double)f.absorbed.x + (double)f.escaped.x + (double)f.dropped.x,
                (double)f.emitted.x, 1e-5);
    assert_near((double)f.absorbed.z + (double)f.escaped.z + (double)f.dropped.z,
                (double)f.emitted.z, 1e-5);
}

/* The mean over the inside of a box [0, size]^3, by places spread evenly. */
static double mean_of_cube(const scene *s, const illumination_map *m, double size, int n)
{
    double sum = 0.0;
    int count  = 0;
    for (int face = 0; face < 6; face++)
        for (int i = 0; i < n * n; i++) {
            double u = (i % n + 0.5) / n * size, v = (i / n + 0.5) / n * size, e = 0.0;
            double at[3] = { u, u, u }, way[3] = { 0, 0, 0 };
            at[(face / 2 + 1) % 3] = u, at[(face / 2 + 2) % 3] = v;
            at[face / 2]  = 0.5 * size;
            way[face / 2] = face % 2 ? 1.0 : -1.0;
            bool known =
                lux_at(s, m, (dvec3){ at[0], at[1], at[2] }, (dvec3){ way[0], way[1], way[2] }, &e);
            sum += e;
            count += known;
        }
    assert_true(count > 6 * n * n * 9 / 10);
    return sum / count;
}

/* E = rho Phi / (S (1 - rho)), CIE 171:2006, 5.8, on average. Noise: particles that are laid down
 * are 2^17 rho / (1 - rho), and 9600 places are looked at. */
static void cube(double rho, double tolerance)
{
    lab l;
    lab_open(&l);
    char text[256];
    snprintf(text, sizeof text,
             "lux4: 1\nroom: {size: [4, 4, 4], reflectance: %g}\n"
             "lights: [{type: point, at: [2, 2, 2], lumens: 10000}]\n",
             rho);
    const scene *s            = lab_scene(&l, text);
    map_options o             = usual;
    o.particles               = rho > 0.9 ? 1 << 15 : 1 << 18;
    const illumination_map *m = map_of(&l, s, &o);
    assert_balanced(m);
    double r = (double)(float)rho;
    assert_near(mean_of_cube(s, m, 4, 40), r * 10000.0 / (96.0 * (1.0 - r)), tolerance);
    lab_close(&l);
}

TEST(a_cube_of_20_percent_has_the_light_of_its_balance) { cube(0.2, 0.01); }
TEST(a_cube_of_80_percent_has_the_light_of_its_balance) { cube(0.8, 0.005); }
TEST(a_cube_of_99_percent_has_the_light_of_its_balance) { cube(0.99, 0.02); }

/* Paths are the reference: on the floor of an uneven room, where and on average. A cell's 500
 * particles are off by 5 %, and its light is smoothed. */
TEST(floors_have_the_light_that_paths_find)
{
    lab l;
    lab_open(&l);
    const scene *s = lab_scene(
        &l, "lux4: 1\nroom: {size: [5, 3, 2.5], reflectance: {ceiling: 0.7, walls: 0.5, floor: "
            "0.2}}\nlights: [{type: point, at: [1.2, 1, 1.8], lumens: 10000}]\ngrids: [{name: g, "
            "origin: [0, 0, 0], u: [5, 0, 0], v: [0, 3, 0], spacing: 0.25}]\n");
    grid_result r;
    grid_of_scene(&l.a, s, 0, &(run_options){ .accuracy = 0.01, .seed = 7 }, &r);
    const illumination_map *m = map_of(&l, s, &usual);
    double paths = 0.0, maps = 0.0, square = 0.0;
    for (int k = 0; k < r.sensor_count; k++) {
        double got = 0.0, want = r.illuminance[k] - r.direct[k];
        dvec3 over = d3_add(r.sensors[k].at, (dvec3){ 0, 0, 1 });
        assert_true(lux_at(s, m, over, (dvec3){ 0, 0, -1 }, &got));
        paths += want;
        maps += got;
        square += (got / want - 1.0) * (got / want - 1.0) / r.sensor_count;
    }
    assert_near(maps, paths, 0.01);
    assert_true(sqrt(square) < 0.08);
    lab_close(&l);
}

/* ---- walls ----------------------------------------------------------------------------------- */

/* One mesh: a box of 6 m x 3 m x 3 m, and across it a wall without thickness at x = 2.7, in which
 * nothing is open. The lamp is in the first room. */
static const scene *two_rooms(lab *l)
{
    quad q[7];
    quads_of_box((dvec3){ 0, 0, 0 }, (dvec3){ 6, 3, 3 }, q);
    q[6] = (quad){ { { 2.7, 0, 0 }, { 2.7, 3, 0 }, { 2.7, 3, 3 }, { 2.7, 0, 3 } } };
    lab_quads(l, "rooms.gltf", q, 7,
              "\"name\":\"White\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.7,0.7,0.7,1],"
              "\"metallicFactor\":0}");
    return lab_scene(l, "lux4: 1\nscene: {file: rooms.gltf}\n"
                        "lights: [{type: point, at: [1.3, 1.5, 1.6], lumens: 10000}]\n");
}

TEST(nothing_comes_through_a_wall_that_stands_on_a_floor_of_both_rooms)
{
    lab l;
    lab_open(&l);
    const scene *s            = two_rooms(&l);
    const illumination_map *m = map_of(&l, s, &usual);
    int lit = 0, dark = 0, near = 0;
    for (int i = 0; i < 4000; i++) {
        double x = 6.0 * (i % 400 + 0.5) / 400, y = 3.0 * (i / 400 + 0.5) / 10, lux = 0.0;
        for (int up = -1; up <= 1; up += 2) {
            if (!lux_at(s, m, (dvec3){ x, y, 1.5 }, (dvec3){ 0, 0, up }, &lux))
                continue;
            if (x > 2.7)
                assert_true(lux == 0.0);
            else
                assert_true(lux > 0.0);
            dark += x > 2.7;
            lit += x < 2.7;
            near += x < 2.7 && x > 2.6;
        }
    }
    assert_true(lit > 3600 * 9 / 10); /* of 3600 */
    assert_true(dark > 4400 / 2);     /* of 4400: cells that something stands on are large there */
    assert_true(near > 40);           /* of 120: small ones reach close to the wall */
    lab_close(&l);
}

TEST(both_sides_of_a_sheet_are_apart)
{
    lab l;
    lab_open(&l);
    const scene *s            = two_rooms(&l);
    const illumination_map *m = map_of(&l, s, &usual);
    double lux                = 0.0;
    assert_true(lux_at(s, m, (dvec3){ 1, 1.2, 1.3 }, (dvec3){ 1, 0, 0 }, &lux));
    assert_true(lux > 100.0);
    assert_false(lux_at(s, m, (dvec3){ 4, 1.2, 1.3 }, (dvec3){ -1, 0, 0 }, &lux));
    lab_close(&l);
}

/* ---- the same for all ------------------------------------------------------------------------ */

static void assert_same(const illumination_map *a, const illumination_map *b)
{
    assert_int_equal(a->cells.node_count, b->cells.node_count);
    assert_int_equal(a->cells.sheet_room, b->cells.sheet_room);
    assert_memory_equal(a->cells.sheets, b->cells.sheets,
                        a->cells.sheet_room * sizeof *a->cells.sheets);
    assert_memory_equal(a->cells.nodes, b->cells.nodes,
                        (size_t)a->cells.node_count * sizeof *a->cells.nodes);
    assert_memory_equal(a->values, b->values,
                        map_bins(a) * (size_t)a->slots * SCRAMBLES * 3 * sizeof *a->values);
}

TEST(maps_are_the_same_for_one_thread_and_three)
{
    lab l;
    lab_open(&l);
    const scene *s              = two_rooms(&l);
    map_options o               = usual;
    o.particles                 = 1 << 16;
    o.threads                   = 1;
    const illumination_map *one = map_of(&l, s, &o);
    o.threads                   = 3;
    assert_same(one, map_of(&l, s, &o));
    lab_close(&l);
}

/* ---- files ----------------------------------------------------------------------------------- */

static const illumination_map *read_map(lab *l, const char *path, const scene *s,
                                        const map_options *o, const char **why, lux_error *err)
{
    *err = (lux_error){ 0 };
    return illumination_map_read(&l->a, path, s, o, why, err);
}

TEST(a_file_gives_back_the_map_or_says_why_not)
{
    lab l;
    lab_open(&l);
    const scene *s = two_rooms(&l);
    map_options o  = usual;
    o.particles    = 1 << 16;
    char path[4096];
    const char *why;
    lux_error err;
    snprintf(path, sizeof path, "%s/maps", l.folder);
    assert_null(read_map(&l, path, s, &o, &why, &err));
    assert_int_equal(err.code, ERR_NONE);
    assert_null(why);

    const illumination_map *m = map_of(&l, s, &o);
    assert_true(illumination_map_write(path, m, &err));
    const illumination_map *back = read_map(&l, path, s, &o, &why, &err);
    assert_non_null(back);
    assert_same(m, back);
    assert_true(illumination_map_figures(back).rays == illumination_map_figures(m).rays);

    o.seed = 2;
    assert_null(read_map(&l, path, s, &o, &why, &err));
    assert_string_equal(why, "seed, particles or accuracy");
    o.seed             = 1;
    const scene *other = lab_scene(&l, "lux4: 1\nscene: {file: rooms.gltf}\nlights: [{type: "
                                       "point, at: [1.3, 1.5, 1.7], lumens: 10000}]\n");
    assert_null(read_map(&l, path, other, &o, &why, &err));
    assert_string_equal(why, "lights");
    lab_close(&l);
}

/* Each byte that is tried is changed, and the checksum set right or not: never a crash, and never a
 * map where the sum is wrong. */
TEST(damaged_files_are_refused)
{
    lab l;
    lab_open(&l);
    const scene *s = two_rooms(&l);
    map_options o  = usual;
    o.particles    = 1 << 14;
    char path[4096];
    const char *why;
    lux_error err = { 0 };
    snprintf(path, sizeof path, "%s/maps", l.folder);
    assert_true(illumination_map_write(path, map_of(&l, s, &o), &err));
    size_t size;
    char *bytes = file_read(&l.a, path, 1 << 30, &size, &err);
    assert_non_null(bytes);
    for (size_t k = 0; k < 100; k++) {
        size_t at = k < 60 ? 4 * k : k * (size / 100), kept = k % 7 == 3 ? at : size;
        FILE *f   = fopen(path, "wb");
        bytes[at] = (char)(bytes[at] ^ 0x41);
        fwrite(bytes, 1, kept, f);
        fclose(f);
        bytes[at] = (char)(bytes[at] ^ 0x41);
        assert_null(read_map(&l, path, s, &o, &why, &err));
        assert_true(err.code != ERR_NONE || why);
    }
    lab_close(&l);
}

/* ---- glass ----------------------------------------------------------------------------------- */

enum { ROUND = 128, RINGS = 64 };

static dvec3 on_sphere(int ring, int turn)
{
    double t = M_PI * ring / RINGS, p = 2.0 * M_PI * turn / ROUND;
    return (dvec3){ 2.5 + 0.5 * sin(t) * cos(p), 1.5 + 0.5 * sin(t) * sin(p), 1.5 + 0.5 * cos(t) };
}

static void write_glass_sphere(lab *l)
{
    quad *q = arena_array(&l->a, quad, ROUND * RINGS, NULL);
    assert_non_null(q);
    for (int r = 0; r < RINGS; r++)
        for (int t = 0; t < ROUND; t++)
            q[r * ROUND + t] = (quad){ { on_sphere(r, t), on_sphere(r + 1, t),
                                         on_sphere(r + 1, t + 1), on_sphere(r, t + 1) } };
    lab_write(l, "sphere.gltf",
              "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":["
              "\"KHR_materials_transmission\",\"KHR_materials_volume\"],\"scenes\":[{\"nodes\":[0]"
              "}],\"nodes\":[{\"mesh\":0}],\"materials\":[{\"name\":\"Glass\","
              "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0},"
              "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
              "\"KHR_materials_volume\":{\"thicknessFactor\":1}}}],%s}",
              lab_mesh(l, q, ROUND * RINGS, NULL, 0));
}

/* W that lie on all cells, first channel, mean of all sets. */
static double laid_down(const illumination_map *m)
{
    double sum = 0.0;
    for (int32_t n = 0; n < m->cells.node_count; n++)
        for (int set = 0; set < SCRAMBLES; set++)
            if (m->cells.nodes[n].parent < 0)
                sum += m->cells.nodes[n].area *
                       (double)m->values[map_value_at(m, (size_t)n, 0, set)] / SCRAMBLES;
    return sum;
}

/* The lamp is 0.6 m from the middle of a sphere of 0.5 m: of its light the share (1 - sqrt(1 -
 * (r/d)^2)) / 2 meets it, and all of that comes to the walls at last. Facets that are 1/128 of the
 * way around hide 0.1 % less. */
TEST(all_light_that_meets_a_glass_sphere_comes_to_the_walls)
{
    lab l;
    lab_open(&l);
    write_glass_sphere(&l);
    const scene *s      = lab_scene(&l, "lux4: 1\nroom: {size: [5, 3, 3], reflectance: 0.5}\n"
                                             "scene: {file: sphere.gltf}\n"
                                             "lights: [{type: point, at: [1.9, 1.5, 1.5], lumens: 1790}]\n");
    const dvec3 place[] = { { 4.999, 1.5, 1.5 }, { 0.001, 1.5, 1.5 }, { 2.5, 2.999, 1.5 },
                            { 2.5, 0.001, 1.5 }, { 2.5, 1.5, 2.999 }, { 2.5, 1.5, 0.001 } };
    vec3 at[6];
    for (int i = 0; i < 6; i++)
        at[i] = scene_place(s, place[i]);
    const vec3 normal[]       = { { -1, 0, 0 }, { 1, 0, 0 },  { 0, -1, 0 },
                                  { 0, 1, 0 },  { 0, 0, -1 }, { 0, 0, 1 } };
    map_sensors walls         = { .count = 6, .at = at, .normal = normal, .side = 12.0f };
    map_options o             = usual;
    o.light                   = MAP_FOCUSED;
    o.particles               = 1 << 18;
    o.sensors                 = &walls;
    const illumination_map *m = map_of(&l, s, &o);
    assert_balanced(m);
    double met  = 10.0 * 0.5 * (1.0 - sqrt(1.0 - 25.0 / 36.0));
    double came = laid_down(m) + (double)illumination_map_figures(m).unplaced.x;
    assert_near(came, met, 0.005);
    assert_true((double)illumination_map_figures(m).unplaced.x < 0.02 * met);

    /* Squares before the walls see it all, too; some twice, within 1 mm of a corner */
    double passed = 0.0;
    for (int i = 0; i < 6; i++)
        for (int set = 0; set < SCRAMBLES; set++) {
            vec3 coarse, fine = illumination_map_at_sensor(m, i, set, -1, &coarse);
            passed += 144.0 / SCRAMBLES * (double)fine.x;
            assert_near(2.0 * (double)coarse.x, (double)fine.x, 1e-5);
        }
    assert_near(passed, came, 0.003);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_of_20_percent_has_the_light_of_its_balance),
        cmocka_unit_test(a_cube_of_80_percent_has_the_light_of_its_balance),
        cmocka_unit_test(a_cube_of_99_percent_has_the_light_of_its_balance),
        cmocka_unit_test(floors_have_the_light_that_paths_find),
        cmocka_unit_test(nothing_comes_through_a_wall_that_stands_on_a_floor_of_both_rooms),
        cmocka_unit_test(both_sides_of_a_sheet_are_apart),
        cmocka_unit_test(maps_are_the_same_for_one_thread_and_three),
        cmocka_unit_test(a_file_gives_back_the_map_or_says_why_not),
        cmocka_unit_test(damaged_files_are_refused),
        cmocka_unit_test(all_light_that_meets_a_glass_sphere_comes_to_the_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
