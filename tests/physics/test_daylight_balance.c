/* tests/physics/test_daylight_balance.c -- daylight that comes into a closed white room leaves it,
 * or is absorbed by its surfaces.
 *
 * A room of reflectance rho with one open window, in which E is the indirect illuminance of its
 * surfaces, and E_w that of the inner side of the window, facing the room. Of the flux F that comes
 * in, rho F is reflected first; of that, each surface absorbs its share or the window lets it go:
 *
 *     rho F = (1 - rho) sum E_i A_i + E_w A_w
 *
 * F has a closed form: of the sun E_n cos(a) A_w, of a uniform sky pi L / 2 A_w on the upright
 * window, of black ground nothing. Sensors stand in the middle of cells of 0.25 m; they are off by
 * 20 % each at most, which a thousand of them even out, and by the midpoint rule near edges: 0.75 %
 * in all.
 */
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

static const double sun_lx = 40000.0, sky_lx = 12000.0; /* square to the beam; on level ground */
static const double azimuth_deg = 170.0, elevation_deg = 35.0;
static const double width = 3.0, depth = 4.0, height = 2.5;                      /* m */
static const double window_at[2] = { 1, 0.75 }, window_size[2] = { 1.25, 1.25 }; /* m */

/* Sensors in the middle of square cells of the six sides; those of the wall y = 0 whose cell is
 * the window's face in from the window: what goes out. `cell` divides all lengths above. */
typedef struct cells {
    int count;
    lab_probe *p;
    double *area; /* m^2 */
    bool *in_window;
} cells;

static void add_side(cells *c, dvec3 corner, dvec3 u, dvec3 v, int across, int up, bool south)
{
    dvec3 normal = d3_cross(u, v);
    double area  = d3_length(normal) / (across * up);
    normal       = d3_scale(normal, 1.0 / d3_length(normal));
    for (int i = 0; i < across; i++)
        for (int k = 0; k < up; k++) {
            dvec3 at  = d3_add(corner,
                               d3_add(d3_scale(u, (i + 0.5) / across), d3_scale(v, (k + 0.5) / up)));
            bool hole = south && at.x > window_at[0] && at.x < window_at[0] + window_size[0] &&
                        at.z > window_at[1] && at.z < window_at[1] + window_size[1];
            c->p[c->count]           = (lab_probe){ at, normal };
            c->area[c->count]        = area;
            c->in_window[c->count++] = hole;
        }
}

static cells cells_of(arena *a, double cell)
{
    int x = (int)lround(width / cell), y = (int)lround(depth / cell);
    int z = (int)lround(height / cell), most = 2 * (x * y + y * z + z * x);
    cells c = { .p         = arena_array(a, lab_probe, (size_t)most, NULL),
                .area      = arena_array(a, double, (size_t)most, NULL),
                .in_window = arena_array(a, bool, (size_t)most, NULL) };
    dvec3 u = { width, 0, 0 }, v = { 0, depth, 0 }, w = { 0, 0, height };
    add_side(&c, (dvec3){ 0 }, u, v, x, y, false);
    add_side(&c, w, v, u, y, x, false);
    add_side(&c, (dvec3){ 0 }, w, u, z, x, true);
    add_side(&c, v, u, w, x, z, false);
    add_side(&c, (dvec3){ 0 }, v, w, y, z, false);
    add_side(&c, u, w, v, z, y, false);
    assert_int_equal(c.count, most);
    return c;
}

static void all_is_accounted_for(bool sun, double rho)
{
    lab l;
    lab_open(&l);
    cells c = cells_of(&l.a, 0.25);
    grid_result r;
    lab_measure(
        &l,
        text_of(&l.a,
                "room: {size: [%g, %g, %g], reflectance: %g, windows: [{wall: south, "
                "at: [%g, %g], size: [%g, %g]}]}\n"
                "sky: {model: %s, sun_at: {azimuth: %g, elevation: %g}, ground: 0, "
                "horizontal: %g, %s}",
                width, depth, height, rho, window_at[0], window_at[1], window_size[0],
                window_size[1], sun ? "clear" : "uniform", azimuth_deg, elevation_deg,
                sun ? 1e-6 : sky_lx,
                sun ? text_of(&l.a, "sun: point, sun_illuminance: %g", sun_lx) : "sun: off"),
        NULL, c.p, c.count, &(run_options){ .accuracy = 0.2 }, &r);
    double direct = 0.0, absorbed = 0.0, out = 0.0;
    for (int i = 0; i < c.count; i++) {
        direct += c.in_window[i] ? 0.0 : r.direct[i] * c.area[i];
        absorbed += c.in_window[i] ? 0.0 : (1.0 - rho) * r.indirect[i] * c.area[i];
        out += c.in_window[i] ? r.indirect[i] * c.area[i] : 0.0;
    }
    double a = azimuth_deg * M_PI / 180.0, h = elevation_deg * M_PI / 180.0;
    double area = window_size[0] * window_size[1];
    double in   = area * (sun ? -sun_lx * cos(a) * cos(h) : 0.5 * sky_lx);
    print_message("           in %.6g lm, direct %.6g, absorbed again %.6g, out %.6g: %+.2e\n", in,
                  direct, absorbed, out, (absorbed + out) / (rho * in) - 1.0);
    assert_near(direct, in, sun ? 0.1 : 0.01); /* cells do not tell where a patch ends */
    assert_near(absorbed + out, rho * in, 0.0075);
    assert_true(out > 0.01 * in && out < 0.5 * in);
    lab_close(&l);
}

TEST(sunlight_that_comes_in_is_absorbed_or_leaves)
{
    all_is_accounted_for(true, 0.5);
    all_is_accounted_for(true, 0.8);
}

TEST(skylight_that_comes_in_is_absorbed_or_leaves)
{
    all_is_accounted_for(false, 0.5);
    all_is_accounted_for(false, 0.8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sunlight_that_comes_in_is_absorbed_or_leaves),
        cmocka_unit_test(skylight_that_comes_in_is_absorbed_or_leaves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
