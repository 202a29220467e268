/* data/courtyard/paints.c -- see courtyard.h: all but the glass are matt, the colour is the
 * reflectance. */
#include "data/courtyard/courtyard.h"

const paint courtyard_paints[PAINT_COUNT] = {
    [PARQUET]    = { "Floor parquet", { 0.42, 0.29, 0.18 } },
    [WALL]       = { "Wall paint", { 0.72, 0.71, 0.68 } },
    [CEILING]    = { "Ceiling paint", { 0.84, 0.84, 0.83 } },
    [LACQUER]    = { "White lacquer", { 0.78, 0.78, 0.76 } },
    [GLASS]      = { "Window glass",
                     { 1, 1, 1 },
                     .gloss          = 1,
                     .transmission   = 1,
                     .ior            = 1.52,
                     .seen_from_both = true },
    [OAK]        = { "Oak", { 0.50, 0.36, 0.22 } },
    [LINEN]      = { "Linen", { 0.30, 0.36, 0.38 } },
    [RUG]        = { "Rug", { 0.52, 0.47, 0.40 } },
    [STEEL]      = { "Steel grey", { 0.20, 0.20, 0.21 } },
    [PAPER]      = { "Paper", { 0.78, 0.77, 0.73 } },
    [BOOK_RED]   = { "Book red", { 0.42, 0.09, 0.06 } },
    [BOOK_BLUE]  = { "Book blue", { 0.07, 0.15, 0.36 } },
    [BOOK_WHITE] = { "Book white", { 0.74, 0.72, 0.66 } },
    [PICTURE]    = { "Picture", { 0.55, 0.30, 0.12 } },
    [PLASTER]    = { "Facade plaster", { 0.62, 0.55, 0.42 } },
    [PLINTH]     = { "Facade plinth", { 0.32, 0.30, 0.28 } },
    [COPING]     = { "Facade coping", { 0.36, 0.37, 0.38 } },
    [CASEMENT]   = { "Facade casement", { 0.70, 0.69, 0.66 } },
    [DARK_PANE]  = { "Facade pane", { 0.07, 0.08, 0.09 } },
    [PAVING]     = { "Ground paving", { 0.30, 0.29, 0.27 } },
    [LAWN]       = { "Ground lawn", { 0.08, 0.16, 0.04 } },
    [BARK]       = { "Tree bark", { 0.15, 0.11, 0.08 } },
    [LEAF]       = { "Tree leaf", { 0.12, 0.24, 0.07 } },
};
