/* tests/unit/test_seen_lamps.c -- which lamps the rays of a batch may see. */
#include "sim/lamp_boxes.h"
#include "tests/test.h"

enum { LAMPS = 200, PACKETS = 32 / LANES, BATCHES = 200 };

static double random_in(uint32_t *seed, double low, double high)
{
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (*seed >> 8) * 0x1p-24;
}

static vec3 place_in(uint32_t *seed, double reach)
{
    return (vec3){ (float)random_in(seed, -reach, reach), (float)random_in(seed, -reach, reach),
                   (float)random_in(seed, -reach, reach) };
}

/* Disks of 1 cm to 2 m about the origin, and points between them, which no ray sees. */
static void make_lamps(arena *a, scene *s, uint32_t *seed)
{
    const light **lights = arena_array(a, const light *, LAMPS, NULL);
    for (int l = 0; l < LAMPS; l++) {
        disk_desc d = { .centre   = place_in(seed, 10.0),
                        .aim      = place_in(seed, 1.0),
                        .radius   = (float)random_in(seed, 0.01, 2.0),
                        .radiance = { 1, 1, 1 } };
        lights[l]   = l % 2 ? light_disk(a, &d, NULL)
                            : light_point(a, &(point_desc){ d.centre, { 1, 1, 1 } }, NULL);
        assert_non_null(lights[l]);
    }
    *s = (scene){ .light_count = LAMPS, .lights = lights };
}

/* Rays from about one place, within a cone as wide as `spread`. */
static void make_rays(vray rays[PACKETS], vmask active[PACKETS], double spread, uint32_t *seed)
{
    vec3 at = place_in(seed, 10.0), along = place_in(seed, 1.0);
    for (int k = 0; k < PACKETS; k++) {
        float o[3][LANES], d[3][LANES];
        for (int i = 0; i < LANES; i++) {
            vec3 off = place_in(seed, 0.01), aside = place_in(seed, spread);
            o[0][i] = at.x + off.x, o[1][i] = at.y + off.y, o[2][i] = at.z + off.z;
            d[0][i] = along.x + aside.x, d[1][i] = along.y + aside.y, d[2][i] = along.z + aside.z;
        }
        vvec3 toward = { vload(d[0]), vload(d[1]), vload(d[2]) };
        rays[k]      = (vray){ { vload(o[0]), vload(o[1]), vload(o[2]) },
                               vnormalize(toward),
                               vsplat(INFINITY) };
        active[k]    = ALL_LANES;
    }
}

static bool is_met(const light *l, const vray rays[PACKETS], const vmask active[PACKETS])
{
    for (int k = 0; k < PACKETS; k++) {
        vlight_hit hit;
        if (vany(l->type->hit(l, &rays[k].origin, &rays[k].direction, active[k], &hit)))
            return true;
    }
    return false;
}

TEST(no_lamp_that_a_ray_meets_is_left_out)
{
    static const double spreads[] = { 0.001, 0.05, 0.5, 3.0 };
    arena a                       = { 0 };
    uint32_t seed                 = 1;
    scene s;
    make_lamps(&a, &s, &seed);
    seen_lamps all = lamps_that_show(&a, &s, NULL);
    assert_int_equal(all.count, LAMPS / 2); /* points are not seen */
    int32_t *list = arena_array(&a, int32_t, LAMPS, NULL);
    int met = 0, narrow = 0;
    for (int b = 0; b < BATCHES; b++) {
        vray rays[PACKETS];
        vmask active[PACKETS];
        make_rays(rays, active, spreads[b % 4], &seed);
        int count = lamps_before(&s, &all, rays, active, PACKETS, list);
        narrow += b % 4 == 0 ? count : 0;
        for (int k = 0, at = 0; k < all.count; k++) {
            bool listed = at < count && list[at] == all.lamps[k];
            at += listed;
            if (is_met(s.lights[all.lamps[k]], rays, active)) {
                met++;
                assert_true(listed);
            }
        }
    }
    assert_true(met > BATCHES);                          /* so that it was a test */
    assert_true(narrow < all.count * (BATCHES / 4) / 4); /* and that it spares something */
    arena_clear(&a);
}

/* Of a packet's rays, and in order. */
TEST(no_lamp_that_a_packet_meets_lies_outside_of_the_boxes_met)
{
    arena a       = { 0 };
    uint32_t seed = 3;
    scene s;
    make_lamps(&a, &s, &seed);
    seen_lamps all          = lamps_that_show(&a, &s, NULL);
    const lamp_boxes *boxes = lamp_boxes_new(&a, &s, &all, NULL);
    int32_t *list           = arena_array(&a, int32_t, LAMPS, NULL);
    int met = 0, given = 0;
    for (int b = 0; b < BATCHES; b++) {
        vray rays[PACKETS];
        vmask active[PACKETS];
        make_rays(rays, active, 3.0, &seed);
        for (int k = 0; k < PACKETS; k++) {
            int count = lamp_boxes_met(boxes, &rays[k], active[k], list);
            given += count;
            for (int i = 0, at = 0; i < all.count; i++) {
                const light *l = s.lights[all.lamps[i]];
                bool listed    = at < count && list[at] == all.lamps[i];
                at += listed;
                vlight_hit hit;
                if (vany(l->type->hit(l, &rays[k].origin, &rays[k].direction, active[k], &hit))) {
                    met++;
                    assert_true(listed);
                }
            }
        }
    }
    assert_true(met > BATCHES);
    assert_true(given < all.count * BATCHES * PACKETS / 2);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_lamp_that_a_ray_meets_is_left_out),
        cmocka_unit_test(no_lamp_that_a_packet_meets_lies_outside_of_the_boxes_met),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
