/* materials/brdf_merl.c -- the tables of the MERL database (Matusik et al. 2003), .binary.
 *
 *     int32 counts[3]      little endian: theta_h, theta_d, phi_d; there 90, 90, 180
 *     float64 red[counts], green[counts], blue[counts]      phi_d fastest; below 0: no data
 *
 *     theta_h cell = floor(sqrt(theta_h / 90 deg) counts[0])
 *     theta_d cell = floor(theta_d / 90 deg counts[1]),   phi_d cell = floor(phi_d / 180 deg ...)
 *     f            = value * (1, 1.15, 1.66) / 1500      [1/sr]
 *
 * A cell's value stands at its middle (that of its indices, before the square), and between middles
 * f is linear in each angle. Below the first and above the last middle of the thetas f is as there;
 * phi_d goes round, from its last middle to its first, 180 degrees on: f is the same with wi and wo
 * exchanged.
 */
#include "materials/brdf_parts.h"

#include <string.h>

/* Twice as fine as the database is, along each angle: what takes longer to look at is no data. */
enum { HEADER = 12, MOST_CELLS = 360 };

static bool read_header(const char *path, const char *bytes, size_t size, int counts[3],
                        lux_error *err)
{
    static const char wanted[] = "expected 'lux4 brdf 1', or MERL's three counts";
    int64_t places             = 1;
    if (size < HEADER)
        return failed(err, ERR_FORMAT, "%s: found %zu bytes, %s", path, size, wanted);
    for (int i = 0; i < 3; i++) {
        uint32_t count = 0;
        for (int k = 3; k >= 0; k--)
            count = count << 8 | (unsigned char)bytes[4 * i + k];
        if (count < 1 || count > MOST_CELLS)
            return failed(err, ERR_FORMAT, "%s: offset %d: found %u, %s, each from 1 to %d", path,
                          4 * i, count, wanted, MOST_CELLS);
        counts[i] = (int)count;
        places *= counts[i];
    }
    if (places > BRDF_MOST_PLACES)
        return failed(err, ERR_FORMAT,
                      "%s: offset 0: found %d x %d x %d cells, at most %d were "
                      "expected",
                      path, counts[0], counts[1], counts[2], BRDF_MOST_PLACES);
    if ((int64_t)size != HEADER + 24 * places)
        return failed(err, ERR_FORMAT,
                      "%s: found %zu bytes, expected %lld for %d x %d x %d cells in three channels",
                      path, size, (long long)(HEADER + 24 * places), counts[0], counts[1],
                      counts[2]);
    return true;
}

static double number_at(const char *bytes, size_t index)
{
    uint64_t bits = 0;
    double value;
    for (size_t k = 8; k-- > 0;)
        bits = bits << 8 | (unsigned char)bytes[HEADER + 8 * index + k];
    memcpy(&value, &bits, sizeof value);
    return value;
}

static bool read_values(const char *path, const char *bytes, size_t places, float *rgb,
                        lux_error *err)
{
    static const double scale[3] = { 1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0 };
    for (size_t k = 0; k < 3; k++)
        for (size_t i = 0; i < places; i++) {
            double value = number_at(bytes, k * places + i) * scale[k];
            if (!(value <= 1e30)) /* NaN: no */
                return failed(err, ERR_FORMAT,
                              "%s: offset %zu: found %g, expected a number below 1e30", path,
                              HEADER + 8 * (k * places + i), value);
            rgb[3 * i + k] = (float)value;
        }
    return true;
}

const brdf *brdf_read_merl(arena *a, const char *path, const char *bytes, size_t size, notices *n,
                           lux_error *err)
{
    int counts[3];
    if (!read_header(path, bytes, size, counts, err))
        return NULL;
    arena scratch = { 0 };
    size_t places = (size_t)counts[0] * (size_t)counts[1] * (size_t)counts[2];
    double *deg   = arena_array(&scratch, double, (size_t)(counts[0] + counts[1] + counts[2]), err);
    float *rgb    = deg ? arena_array(&scratch, float, 3 * places, err) : NULL;
    const brdf *b = NULL;
    if (rgb && read_values(path, bytes, places, rgb, err)) {
        double *d = deg + counts[0], *p = d + counts[1];
        for (int i = 0; i < counts[0]; i++)
            deg[i] = 90.0 * ((i + 0.5) / counts[0]) * ((i + 0.5) / counts[0]);
        for (int i = 0; i < counts[1]; i++)
            d[i] = 90.0 * (i + 0.5) / counts[1];
        for (int i = 0; i < counts[2]; i++)
            p[i] = 180.0 * (i + 0.5) / counts[2];
        brdf_data data = { .name   = path,
                           .kind   = BRDF_HALF,
                           .counts = { counts[0], counts[1], counts[2] },
                           .deg    = { deg, d, p },
                           .rgb    = rgb,
                           .bands  = 3 };
        b              = brdf_make(a, &data, n, err);
    }
    arena_clear(&scratch);
    return b;
}
