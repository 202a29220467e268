/* tests/physics/test_independence.c -- errors of what is sampled have nothing to do with each
 * other: not of neighbouring sensors, nor of one sensor under consecutive seeds, nor of grids whose
 * names differ. Otherwise means over sensors or seeds were less sure than their intervals say.
 *
 * Of n pairs of independent errors the correlation spreads by 1 / sqrt(n): 4 of that are allowed.
 */
#include "tests/folder.h"
#include "tests/test.h"

enum { COLUMNS = 4, ROWS = 2, SENSORS = COLUMNS * ROWS, SEEDS = 256 };

typedef struct errors {
    double of[SEEDS][SENSORS]; /* in units of the sensor's standard deviation; mean 0 */
} errors;

static const scene *lit_room(arena *a)
{
    return scene_of_text(
        a, "lux4: 1\n"
           "room: {size: [6, 4, 3], reflectance: {ceiling: 0.7, walls: 0.5, floor: 0.2}}\n"
           "lights: [{type: point, at: [2, 1.5, 2.2], intensity: 100}]\n"
           "grids:\n"
           "- {name: desk, origin: [0, 0, 0.75], u: [2, 0, 0], v: [0, 1, 0], spacing: 0.5}\n"
           "- {name: desl, origin: [0, 0, 0.75], u: [2, 0, 0], v: [0, 1, 0], spacing: 0.5}\n");
}

static void run_grid(const scene *s, int grid, uint32_t seed, double lux[SENSORS])
{
    arena a = { 0 };
    grid_result r;
    grid_of_scene(&a, s, grid, &(run_options){ .accuracy = 0.9, .seed = seed, .threads = 2 }, &r);
    assert_int_equal(r.sensor_count, SENSORS);
    for (int k = 0; k < SENSORS; k++)
        lux[k] = r.indirect[k];
    arena_clear(&a);
}

/* A sensor's errors against its mean over all seeds. */
static void errors_of(const scene *s, int grid, errors *e)
{
    for (uint32_t seed = 0; seed < SEEDS; seed++)
        run_grid(s, grid, seed, e->of[seed]);
    for (int k = 0; k < SENSORS; k++) {
        double mean = 0.0, squares = 0.0;
        for (int i = 0; i < SEEDS; i++)
            mean += e->of[i][k] / SEEDS;
        for (int i = 0; i < SEEDS; i++)
            squares += (e->of[i][k] - mean) * (e->of[i][k] - mean);
        assert_true(squares > 0.0);
        for (int i = 0; i < SEEDS; i++)
            e->of[i][k] = (e->of[i][k] - mean) / sqrt(squares / SEEDS);
    }
}

/* Correlation of x's errors with y's, `seeds` later at the sensor dx, dy off. */
static void assert_unrelated(const errors *x, const errors *y, int seeds, int dx, int dy)
{
    double sum = 0.0;
    int pairs  = 0;
    for (int i = 0; i + seeds < SEEDS; i++)
        for (int k = 0; k < SENSORS; k++) {
            int column = k % COLUMNS + dx, row = k / COLUMNS + dy;
            if (column < 0 || column >= COLUMNS || row < 0 || row >= ROWS)
                continue;
            sum += x->of[i][k] * y->of[i + seeds][row * COLUMNS + column];
            pairs++;
        }
    if (!(pairs >= 500 && fabs(sum / pairs) < 4.0 / sqrt(pairs)))
        fail_msg("%d seeds, %d columns, %d rows off: correlation %.3f of %d pairs, below %.3f "
                 "wanted",
                 seeds, dx, dy, sum / pairs, pairs, 4.0 / sqrt(pairs));
}

static errors desk, desl;

static int run_all(void **state)
{
    (void)state;
    arena a        = { 0 };
    const scene *s = lit_room(&a);
    errors_of(s, 0, &desk);
    errors_of(s, 1, &desl);
    arena_clear(&a);
    return 0;
}

TEST(errors_of_neighbouring_sensors_are_unrelated)
{
    assert_unrelated(&desk, &desk, 0, 1, 0);
    assert_unrelated(&desk, &desk, 0, 0, 1);
    assert_unrelated(&desk, &desk, 0, 1, 1);
    assert_unrelated(&desk, &desk, 0, 2, 0);
}

TEST(errors_under_consecutive_seeds_are_unrelated)
{
    assert_unrelated(&desk, &desk, 1, 0, 0);
    assert_unrelated(&desk, &desk, 2, 0, 0);
}

/* Seed and number of the sensor must not just be added up. */
TEST(errors_of_the_next_sensor_under_the_next_seed_are_unrelated)
{
    assert_unrelated(&desk, &desk, 1, 1, 0);
    assert_unrelated(&desk, &desk, 1, -1, 0);
}

TEST(errors_of_grids_of_other_names_are_unrelated)
{
    assert_unrelated(&desk, &desl, 0, 0, 0);
    assert_unrelated(&desk, &desl, 0, 1, 0);
    assert_unrelated(&desk, &desl, 1, 0, 0);
    assert_unrelated(&desl, &desk, 1, 0, 0);
}

TEST(a_grid_s_name_and_seed_alone_choose_its_samples)
{
    arena a        = { 0 };
    const scene *s = lit_room(&a);
    double first[SENSORS], again[SENSORS], named[SENSORS], seeded[SENSORS];
    run_grid(s, 0, 1, first);
    run_grid(s, 0, 1, again);
    run_grid(s, 1, 1, named);
    run_grid(s, 0, 2, seeded);
    for (int k = 0; k < SENSORS; k++) {
        assert_true(first[k] == again[k]);
        assert_true(first[k] != named[k] && first[k] != seeded[k]);
    }
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_of_neighbouring_sensors_are_unrelated),
        cmocka_unit_test(errors_under_consecutive_seeds_are_unrelated),
        cmocka_unit_test(errors_of_the_next_sensor_under_the_next_seed_are_unrelated),
        cmocka_unit_test(errors_of_grids_of_other_names_are_unrelated),
        cmocka_unit_test(a_grid_s_name_and_seed_alone_choose_its_samples),
    };
    return cmocka_run_group_tests(tests, run_all, NULL);
}
