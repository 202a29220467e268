/* core/without.h -- effects that a build does not have at all: make WITHOUT="daylight mirrors ...".
 *
 * Such a build is what the program is measured against (make bench-effects): where an effect is
 * off, it may cost no more than where it does not exist. A scene that calls for it is refused.
 */
#ifndef CORE_WITHOUT_H
#define CORE_WITHOUT_H

#ifdef WITHOUT_DAYLIGHT
enum { HAS_DAYLIGHT = 0 };
#else
enum { HAS_DAYLIGHT = 1 };
#endif

#ifdef WITHOUT_MIRRORS
enum { HAS_MIRRORS = 0 }; /* nor glass and holes: nothing that is not matt */
#else
enum { HAS_MIRRORS = 1 };
#endif

#ifdef WITHOUT_TEXTURES
enum { HAS_TEXTURES = 0 };
#else
enum { HAS_TEXTURES = 1 };
#endif

#ifdef WITHOUT_TABLES
enum { HAS_TABLES = 0 }; /* of measured reflection */
#else
enum { HAS_TABLES = 1 };
#endif

#endif
