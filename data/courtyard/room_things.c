/* data/courtyard/room_things.c -- see courtyard.h: what stands in the room. Feet keep 1 mm off the
 * floor, what rests on something reaches some millimetres into it. */
#include "data/courtyard/courtyard.h"

shape long_table(void)
{
    shape s = shape_new("Table", 1.0);
    s.ink   = OAK;
    add_box(&s, (point){ -0.42, -0.90, 0.71 }, (point){ 0.42, 0.90, 0.74 });
    s.ink = STEEL;
    for (int i = 0; i < 4; i++) {
        const double x = side_of(i & 1) * 0.36, y = side_of(i & 2) * 0.82;
        add_box(&s, (point){ x - 0.025, y - 0.025, 0.001 }, (point){ x + 0.025, y + 0.025, 0.714 });
    }
    s.ink = PAPER;
    shape_at(&s, (point){ 0.10, 0.35, 0.74 }, 18.0, 0.0);
    add_box(&s, (point){ -0.15, -0.105, -0.002 }, (point){ 0.15, 0.105, 0.004 });
    s.ink = BOOK_BLUE;
    shape_at(&s, (point){ -0.16, -0.30, 0.74 }, -12.0, 0.0);
    add_box(&s, (point){ -0.12, -0.09, -0.002 }, (point){ 0.12, 0.09, 0.028 });
    return s;
}

shape wooden_chair(void)
{
    shape s = shape_new("Chair", 1.0);
    s.ink   = OAK;
    for (int i = 0; i < 4; i++) {
        const double x = side_of(i & 1) * 0.19, y = side_of(i & 2) * 0.18,
                     top  = i & 2 ? 0.44 : 0.86;
        const point leg[] = { { x, y, 0.001 }, { x, y, 0.42 }, { x, y - (i & 2 ? 0 : 0.05), top } };
        add_tube(&s, &(tube){ leg, 3, 8, 0.018, 0.015 });
    }
    add_box(&s, (point){ -0.19, -0.236, 0.66 }, (point){ 0.19, -0.212, 0.84 });
    s.ink = LINEN;
    add_cushion(&s, &(cushion){ .centre     = { 0, 0, 0.45 },
                                .half       = { 0.225, 0.215, 0.03 },
                                .squareness = 0.35,
                                .edge       = 0.6,
                                .segments   = 32,
                                .rings      = 8 });
    return s;
}

static void add_pillow(shape *s, point middle, point half)
{
    add_cushion(s, &(cushion){ .centre     = middle,
                               .half       = half,
                               .squareness = 0.25,
                               .edge       = 0.35,
                               .segments   = 32,
                               .rings      = 10 });
}

shape sofa(void)
{
    shape s = shape_new("Sofa", 1.0);
    s.ink   = LINEN;
    add_box(&s, (point){ 0.04, -0.98, 0.12 }, (point){ 0.86, 0.98, 0.30 });
    add_pillow(&s, (point){ 0.14, 0, 0.45 }, (point){ 0.11, 1.0, 0.30 });
    for (int i = 0; i < 2; i++) {
        add_pillow(&s, (point){ 0.46, side_of(i) * 0.94, 0.36 }, (point){ 0.42, 0.08, 0.23 });
        add_pillow(&s, (point){ 0.54, side_of(i) * 0.43, 0.36 }, (point){ 0.36, 0.43, 0.09 });
    }
    s.ink = STEEL;
    for (int i = 0; i < 4; i++) {
        const double x = i & 1 ? 0.78 : 0.12, y = side_of(i & 2) * 0.90;
        add_box(&s, (point){ x - 0.02, y - 0.02, 0.001 }, (point){ x + 0.02, y + 0.02, 0.13 });
    }
    return s;
}

shape low_table(void)
{
    static const double top[][2] = {
        { 0, 0.34 }, { 0.38, 0.34 }, { 0.40, 0.352 }, { 0.40, 0.365 }, { 0, 0.365 }
    };
    static const double foot[][2] = { { 0, 0.013 },    { 0.22, 0.013 }, { 0.22, 0.022 },
                                      { 0.03, 0.035 }, { 0.03, 0.343 }, { 0, 0.343 } };
    shape s                       = shape_new("Low table", 1.0);
    s.ink                         = OAK;
    add_lathe(&s, &(lathe){ top, COUNT(top), 40, false });
    s.ink = STEEL;
    add_lathe(&s, &(lathe){ foot, COUNT(foot), 24, false });
    return s;
}

shape rug(void)
{
    shape s = shape_new("Rug", 1.0);
    s.ink   = RUG;
    add_box(&s, (point){ -1.0, -1.3, -0.002 }, (point){ 1.0, 1.3, 0.012 });
    return s;
}

/* Books from y = a to b on the board at z. */
static void book_row(shape *s, double a, double b, double z, uint32_t *seed)
{
    const double end = a + (b - a) * (0.45 + 0.5 * draw(seed));
    for (double y = a; y < end - 0.06;) {
        const double thick = 0.02 + 0.035 * draw(seed), tall = 0.19 + 0.10 * draw(seed);
        const double deep = 0.16 + 0.08 * draw(seed);
        s->ink            = BOOK_RED + (int)(draw(seed) * 3.0);
        add_box(s, (point){ -deep - 0.03, y, z - 0.002 }, (point){ -0.03, y + thick, z + tall });
        y += thick + 0.0015;
    }
}

shape shelf_with_books(void)
{
    static const double y[] = { -0.90, -0.875, -0.0125, 0.0125, 0.875, 0.90 };
    static const double z[] = { 0.001, 0.08, 0.10, 0.46, 0.48, 0.84, 0.86, 1.22, 1.24, 1.60, 1.62 };
    shape s                 = shape_new("Shelf", 1.0);
    uint32_t seed           = 17;
    s.ink                   = OAK;
    add_plate(&s, &(plate){ 0, COUNT(y), COUNT(z), y, z,
                            "#####"
                            "#####"
                            "# # #"
                            "#####"
                            "# # #"
                            "#####"
                            "# # #"
                            "#####"
                            "# # #"
                            "#####",
                            -0.32, -0.012 });
    add_box(&s, (point){ -0.016, -0.885, 0.05 }, (point){ -0.001, 0.885, 1.61 });
    for (int i = 0; i < 4; i++) {
        book_row(&s, -0.87, -0.02, z[2 + 2 * i], &seed);
        book_row(&s, 0.02, 0.87, z[2 + 2 * i], &seed);
    }
    return s;
}

shape wall_picture(void)
{
    static const double y[] = { -0.60, -0.57, 0.57, 0.60 }, z[] = { 1.15, 1.18, 2.02, 2.05 };
    shape s = shape_new("Picture", 1.0);
    s.ink   = STEEL;
    add_plate(&s, &(plate){ 0, 4, 4, y, z, "#### ####", -0.003, 0.03 });
    s.ink = PAPER;
    add_box(&s, (point){ -0.002, -0.58, 1.17 }, (point){ 0.015, 0.58, 2.03 });
    s.ink = PICTURE;
    add_box(&s, (point){ 0.010, -0.40, 1.32 }, (point){ 0.018, 0.10, 1.88 });
    s.ink = BOOK_BLUE;
    add_box(&s, (point){ 0.010, -0.10, 1.45 }, (point){ 0.020, 0.38, 1.75 });
    return s;
}
