/* data/model/picture.c -- see picture.h: PNG (ISO/IEC 15948), and noise to paint with. */
#define _GNU_SOURCE /* open_memstream */
#include "data/model/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- PNG ---------------------------------------------------------------------------------- */

static uint32_t crc_of(const unsigned char *bytes, size_t size)
{
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int k = 0; k < 8; k++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

static void big_endian(unsigned char to[4], uint32_t v)
{
    for (int i = 0; i < 4; i++)
        to[i] = (unsigned char)(v >> (24 - 8 * i));
}

/* A chunk: its bytes start with the four letters of its kind. */
static void put_chunk(FILE *to, const void *bytes, size_t size)
{
    unsigned char n[4];
    big_endian(n, (uint32_t)size - 4);
    fwrite(n, 1, 4, to);
    fwrite(bytes, 1, size, to);
    big_endian(n, crc_of(bytes, size));
    fwrite(n, 1, 4, to);
}

static void put_header(FILE *to, const picture *p)
{
    unsigned char b[17] = "IHDR";
    big_endian(b + 4, (uint32_t)p->width);
    big_endian(b + 8, (uint32_t)p->height);
    b[12] = 8;
    b[13] = p->has_alpha ? 6 : 2;
    fwrite("\x89PNG\r\n\x1a\n", 1, 8, to);
    put_chunk(to, b, sizeof b);
}

/* Every row is kept as its difference from the pixel to the left (filter 1, "Sub"). */
static void fill_row(const picture *p, int y, unsigned char *row)
{
    const int n           = p->has_alpha ? 4 : 3;
    unsigned char left[4] = { 0 };
    *row++                = 1;
    for (int x = 0; x < p->width; x++) {
        double c[4] = { 0, 0, 0, 1 };
        p->at((x + 0.5) / p->width, (y + 0.5) / p->height, c);
        for (int k = 0; k < n; k++) {
            const unsigned char v = (unsigned char)(fmin(fmax(c[k], 0.0), 1.0) * 255.0 + 0.5);
            *row++                = (unsigned char)(v - left[k]);
            left[k]               = v;
        }
    }
}

bool picture_write_png(const picture *p, FILE *to)
{
    const size_t row  = 1 + (size_t)p->width * (p->has_alpha ? 4 : 3),
                 size = row * (size_t)p->height;
    unsigned char *px = malloc(size);
    char *chunk       = NULL;
    size_t length     = 0;
    FILE *data        = open_memstream(&chunk, &length);
    bool done         = px && data;
    if (done) {
        for (int y = 0; y < p->height; y++)
            fill_row(p, y, px + row * (size_t)y);
        fwrite("IDAT", 1, 4, data);
        done = deflate_write(px, size, data);
    }
    done &= data && fclose(data) == 0;
    if (done) {
        put_header(to, p);
        put_chunk(to, chunk, length);
        put_chunk(to, "IEND", 4);
    }
    free(px);
    free(chunk);
    return done && !ferror(to);
}

/* ---- noise -------------------------------------------------------------------------------- */

double fraction(double x) { return x - floor(x); }

static double lattice(int i, int j, int period, uint32_t seed)
{
    i = (i % period + period) % period;
    j = (j % period + period) % period;

    uint32_t h = seed * 0x9e3779b9u + (uint32_t)i * 0x85ebca6bu + (uint32_t)j * 0xc2b2ae35u;
    h          = (h ^ h >> 15) * 0x2c1b3c6du;
    h          = (h ^ h >> 12) * 0x297a2d39u;
    return ((h ^ h >> 15) >> 8) / 16777216.0;
}

static double blend(double a, double b, double t) { return a + (b - a) * t * t * (3.0 - 2.0 * t); }

double noise(double u, double v, int period, uint32_t seed)
{
    const double fu = floor(u), fv = floor(v), s = u - fu, t = v - fv;
    const int i = (int)fu, j = (int)fv;
    const double low = blend(lattice(i, j, period, seed), lattice(i + 1, j, period, seed), s);
    const double high =
        blend(lattice(i, j + 1, period, seed), lattice(i + 1, j + 1, period, seed), s);
    return blend(low, high, t);
}

double clouds(double u, double v, int period, uint32_t seed)
{
    double sum = 0.0, weight = 8.0 / 15.0;
    for (int k = 0; k < 4; k++, weight *= 0.5)
        sum += weight * noise(u * (1 << k), v * (1 << k), period << k, seed + (uint32_t)k);
    return sum;
}
