/* tests/physics/test_daylight_balance.c -- daylight that comes into a closed white room leaves it,
 * or is absorbed by its surfaces.
 *
 * A room of reflectance rho with one open window: what comes in, F, is that which a black room's
 * surfaces get. Each reflection leaves the absorbed share, and what goes out by the window again
 * is what arrives there from within:
 *
 *     F = (1 - rho) sum E_i A_i + F_out,      F_out = E_w A_w
 *
 * with E_w on the inner side of the window, facing the room. F itself has a closed form: sun by
 * E_n cos(a) A_w; of a uniform sky pi L / 2 on the upright window, of black ground nothing.
 * Sensors stand in the middle of cells; the error of that is measured with F in the black room.
 */
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

static const double sun_lx = 40000.0, sky_lx = 12000.0; /* square to the beam; on level ground */
static const double azimuth_deg = 170.0, elevation_deg = 35.0;
static const double width = 3.0, depth = 4.0, height = 2.5;                     /* m */
static const double window_at[2] = { 0.9, 0.8 }, window_size[2] = { 1.2, 1.2 }; /* m */

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

/* Direct on all sides, and what is left of it. */
typedef struct balance {
    double in;                /* lm: direct light on all surfaces */
    double absorbed;          /* lm */
    double out;               /* lm, by the window */
    double half_in, half_all; /* lm: the sum of half widths, which the error of the sum is within */
} balance;

static balance balance_of(double rho, const char *model, bool sun, double cell)
{
    lab l;
    lab_open(&l);
    cells c = cells_of(&l.a, cell);
    grid_result r;
    lab_measure(&l,
                text_of(&l.a,
                        "room: {size: [%g, %g, %g], reflectance: %g, windows: [{wall: south, "
                        "at: [%g, %g], size: [%g, %g]}]}\n"
                        "sky: {model: %s, sun: %s, sun_at: {azimuth: %g, elevation: %g}, ground: 0,"
                        "\n      horizontal: %g, sun_illuminance: %g}",
                        width, depth, height, rho, window_at[0], window_at[1], window_size[0],
                        window_size[1], model, sun ? "point" : "off", azimuth_deg, elevation_deg,
                        sun ? 1e-6 : sky_lx, sun_lx),
                NULL, c.p, c.count, &(run_options){ .accuracy = 0.03 }, &r);
    balance b = { 0 };
    for (int i = 0; i < c.count; i++) {
        double a = c.area[i];
        b.in += c.in_window[i] ? 0.0 : r.direct[i] * a;
        b.absorbed += c.in_window[i] ? 0.0 : (1.0 - rho) * r.illuminance[i] * a;
        b.out += c.in_window[i] ? r.illuminance[i] * a : 0.0;
        b.half_all += r.half_width[i] * a;
    }
    lab_close(&l);
    return b;
}

/* Sensors' errors are independent of each other: their sum is far surer than each. */
static void all_is_accounted_for(const char *model, bool sun, double rho, double tolerance)
{
    const double cell = 0.1;
    double a = azimuth_deg * M_PI / 180.0, h = elevation_deg * M_PI / 180.0;
    double area = window_size[0] * window_size[1];
    double in   = area * (sun ? -sun_lx * cos(a) * cos(h) : 0.5 * sky_lx);
    balance b   = balance_of(rho, model, sun, cell);
    print_message(
        "           %s, %g: in %.6g lm, of sensors %.6g, absorbed %.6g, out %.6g: %+.2e\n",
        sun ? "sun" : model, rho, in, b.in, b.absorbed, b.out, (b.absorbed + b.out) / b.in - 1.0);
    assert_near(b.in, in, tolerance);
    assert_near(b.absorbed + b.out, b.in, tolerance);
    assert_true(b.out > 0.01 * in && b.out < 0.5 * in);
}

TEST(sunlight_that_comes_in_is_absorbed_or_leaves)
{
    all_is_accounted_for("clear", true, 0.5, 0.01);
    all_is_accounted_for("clear", true, 0.8, 0.01);
}

TEST(skylight_that_comes_in_is_absorbed_or_leaves)
{
    all_is_accounted_for("uniform", false, 0.5, 0.005);
    all_is_accounted_for("uniform", false, 0.8, 0.005);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sunlight_that_comes_in_is_absorbed_or_leaves),
        cmocka_unit_test(skylight_that_comes_in_is_absorbed_or_leaves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
