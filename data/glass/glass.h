/* data/glass/glass.h -- a dining room full of pictures and glass: 5.0 x 4.0 x 2.7 m.
 *
 * A corner of its floor is the origin, x east, y north. The window is in the west, the mirror and
 * the tiles in the north.
 */
#ifndef GLASS_GLASS_H
#define GLASS_GLASS_H

#include "data/model/model.h"

enum {
    FLOOR,
    TILES,
    WALL,
    CEILING,
    CARPET,
    TABLE,
    OAK,
    FABRIC,
    LACE,
    CHINA,
    BOOKS,
    PICTURE_1,
    PICTURE_2,
    PICTURE_3,
    FRAME,
    STEEL,
    LACQUER,
    MIRROR,
    CLEAR,
    BLUE,
    GREEN,
    AMBER,
    PARTITION,
    SKY,
    PAINT_COUNT,
};
extern const paint glass_paints[PAINT_COUNT];

/* pictures.c, patterns.c */
extern const picture picture_planks, picture_oak, picture_tiles, picture_tiles_relief,
    picture_wallpaper, picture_carpet, picture_lace, picture_fabric, picture_china, picture_books,
    picture_hills, picture_blocks, picture_rings;

/* glassware.c: what stands on the table, on z = 0. Each is a closed solid of glass but the bowl. */
shape wine_glass(void);
shape carafe(void);
shape vase(void);
shape glass_ball(void);
shape glass_block(void);
shape fruit_bowl(void); /* of china */
shape plate_of_china(void);

/* room.c, furniture.c */
shape room_shell(void);
shape window_frame(void); /* of an opening 1.4 m wide; looks along -y, the wall's face is y = 0 */
shape curtain(void);      /* lace, 1.8 m along x about 0, 1.75 m high */
shape partition(void);    /* along x from 0 to 1.2 m */
shape wall_mirror(void);  /* looks along -y, its back on y = 0 */
shape framed(const char *name, int ink, double width, double height); /* so too */
shape pendant(void); /* its shade's opening is at z = 0, looks down */
shape dining_table(void);
shape dining_chair(void); /* looks along +y */
shape carpet(void);
shape book_case(void); /* 1.0 m along x about 0, looks along -y, its back on y = 0 */

/* layout.c: fills an empty model. */
void glass_build(model *m);

#endif
