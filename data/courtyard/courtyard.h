/* data/courtyard/courtyard.h -- a room upstairs, 4 x 8 x 3 m, whose window looks south into a
 * courtyard of 16 x 12.8 m.
 *
 * A corner of the room's floor is the origin, x east, y north; the courtyard lies 3.6 m lower.
 */
#ifndef COURTYARD_COURTYARD_H
#define COURTYARD_COURTYARD_H

#include "data/model/model.h"

enum {
    PARQUET,
    WALL,
    CEILING,
    LACQUER,
    GLASS,
    OAK,
    LINEN,
    RUG,
    STEEL,
    PAPER,
    BOOK_RED,
    BOOK_BLUE,
    BOOK_WHITE,
    PICTURE,
    PLASTER,
    PLINTH,
    COPING,
    CASEMENT,
    DARK_PANE,
    PAVING,
    LAWN,
    BARK,
    LEAF,
    PAINT_COUNT,
};
extern const paint courtyard_paints[PAINT_COUNT];

#define YARD      -3.6 /* m: the height of its ground */
#define EAVES     3.4  /* m: of the tops of all facades */
#define YARD_WEST -6.0 /* m: the faces of the wings */
#define YARD_EAST 10.0

/* The opening that the glass is in: m, x and z. */
#define WINDOW_LEFT  0.4
#define WINDOW_RIGHT 3.6
#define WINDOW_SILL  0.85
#define WINDOW_HEAD  2.70

/* room_shell.c: the room, its south wall inside the facade, and the window in it. */
shape room_shell(void);
shape room_skirting(void);
shape room_window(void); /* frame and sills */
shape room_panes(void);  /* three sheets of glass */

/* yard.c: facades look along -y, their faces are y = 0, their left ends x = 0, the yard z = 0. */
shape own_facade(void); /* in the room's frame; its face is y = -0.40 */
shape facade(const char *name, int bays);
shape yard_ground(void);
shape yard_tree(void);
shape yard_bench(void); /* along x about 0 */

/* room_things.c: what stands in the room, on z = 0. */
shape long_table(void);   /* along y */
shape wooden_chair(void); /* looks along +y */
shape sofa(void);         /* 2.0 m along y about 0, its back on x = 0, looks along +x */
shape low_table(void);
shape rug(void);
shape shelf_with_books(void); /* 1.8 m along y about 0, its back on x = 0, looks along -x */
shape wall_picture(void);     /* looks along +x, its back on x = 0 */

/* courtyard.c: fills an empty model. */
void courtyard_build(model *m);

#endif
