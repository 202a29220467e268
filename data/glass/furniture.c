/* data/glass/furniture.c -- see glass.h. */
#include "data/glass/glass.h"

/* 1.6 m along x, 0.9 m along y, its top at 0.75 m. */
shape dining_table(void)
{
    shape s = shape_new("Table", 1.0);
    s.ink   = TABLE;
    add_box(&s, (point){ -0.80, -0.45, 0.720 }, (point){ 0.80, 0.45, 0.750 });
    add_box(&s, (point){ -0.70, -0.36, 0.640 }, (point){ 0.70, 0.36, 0.722 });
    for (int i = 0; i < 4; i++) {
        const double x = side_of(i & 1) * 0.70, y = side_of(i & 2) * 0.36;
        add_box(&s, (point){ x - 0.035, y - 0.035, 0.013 }, (point){ x + 0.035, y + 0.035, 0.721 });
    }
    return s;
}

shape dining_chair(void)
{
    shape s = shape_new("Chair", 1.0);
    s.ink   = OAK;
    for (int i = 0; i < 4; i++) {
        const double x = side_of(i & 1) * 0.19, y = side_of(i & 2) * 0.18,
                     top  = i & 2 ? 0.44 : 0.92;
        const point leg[] = { { x, y, 0.013 }, { x, y, 0.42 }, { x, y - (i & 2 ? 0 : 0.05), top } };
        add_tube(&s, &(tube){ leg, 3, 8, 0.019, 0.016 });
    }
    for (int i = 0; i < 2; i++)
        add_box(&s, (point){ -0.19, -0.238 + 0.02 * i, 0.62 + 0.18 * i - 0.02 * i },
                (point){ 0.19, -0.212 + 0.0 * i, 0.70 + 0.18 * i });
    s.ink = FABRIC;
    add_cushion(&s, &(cushion){ .centre     = { 0, 0, 0.45 },
                                .half       = { 0.225, 0.215, 0.035 },
                                .squareness = 0.35,
                                .edge       = 0.6,
                                .segments   = 40,
                                .rings      = 12 });
    return s;
}

shape carpet(void)
{
    shape s = shape_new("Carpet", 1.0);
    s.ink   = CARPET;
    add_box(&s, (point){ -1.4, -1.0, -0.002 }, (point){ 1.4, 1.0, 0.012 });
    return s;
}

/* ---- books -------------------------------------------------------------------------------- */

/* In blocks of a few books each, which the picture on them shows; heights and depths differ. */
static void book_row(shape *s, double z, uint32_t *seed)
{
    const double end = -0.46 + 0.92 * (0.7 + 0.28 * draw(seed));
    s->ink           = BOOKS;
    for (double x = -0.46; x < end - 0.16;) {
        const double wide = 0.03 * (1 + (int)(4.0 * draw(seed))), tall = 0.20 + 0.09 * draw(seed);
        const double deep = 0.17 + 0.07 * draw(seed);
        add_box(s, (point){ x, -deep - 0.03, z - 0.002 }, (point){ x + wide, -0.03, z + tall });
        x += wide + 0.0015;
    }
}

shape book_case(void)
{
    static const double x[] = { -0.50, -0.475, 0.475, 0.50 };
    static const double z[] = { 0.001, 0.08, 0.10, 0.46, 0.48, 0.84, 0.86,
                                1.22,  1.24, 1.60, 1.62, 1.98, 2.00 };
    shape s                 = shape_new("Book case", 1.0);
    uint32_t seed           = 11;
    s.ink                   = OAK;
    add_plate(&s, &(plate){ 1, 4, COUNT(z), x, z,
                            "###"
                            "###"
                            "# #"
                            "###"
                            "# #"
                            "###"
                            "# #"
                            "###"
                            "# #"
                            "###"
                            "# #"
                            "###",
                            -0.32, -0.012 });
    add_box(&s, (point){ -0.485, -0.016, 0.05 }, (point){ 0.485, -0.001, 1.99 });
    for (int i = 0; i < 5; i++)
        book_row(&s, z[2 + 2 * i], &seed);
    return s;
}
