/* data/office/paints.h -- what the things in the office are made of. */
#ifndef OFFICE_PAINTS_H
#define OFFICE_PAINTS_H

#include "data/model/model.h"

enum {
    CARPET,
    WALL,
    ACCENT,
    CEILING,
    BAR,
    CONCRETE,
    NIGHT,
    PAINT,
    WOOD,
    DOOR_WOOD,
    METAL,
    DARK_METAL,
    PLASTIC,
    BLACK,
    FABRIC,
    SEAT,
    SCREEN,
    DIFFUSER,
    BOARD,
    PAPER,
    POT,
    SOIL,
    LEAF,
    BOOK_RED,
    BOOK_BLUE,
    BOOK_GREEN,
    BOOK_OCHRE,
    BOOK_WHITE,
    BOOK_BLACK,
    PAINT_COUNT
};

extern const paint office_paints[PAINT_COUNT];

#endif
