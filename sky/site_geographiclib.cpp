// sky/site_geographiclib.cpp -- site.h by way of GeographicLib, which speaks only C++.
//
// A shim: it converts arguments, calls, and turns every exception into a `lux_error`. No other file
// includes the library.
#include "sky/site.h"

#include "core/text.h"

#include <GeographicLib/GeoCoords.hpp>
#include <GeographicLib/Math.hpp>

#include <cmath>
#include <cstring>
#include <exception>
#include <new>

static constexpr std::size_t LONGEST = 200; // bytes; what people write has a quarter of them

static bool refuse(const char *text, const char *why, lux_error *err)
{
    char place[TEXT_QUOTE], reason[TEXT_QUOTE];
    return failed(
        err, ERR_ARGUMENT,
        "\"%s\" is no place (%s): latitude and longitude as 55.7558N 37.6173E or "
        "55d45'21\"N 37d37'2\"E, UTM as 37N 413000 6180000, or MGRS as 37UDB1300080000 is "
        "expected",
        text_quote(place, text), text_quote(reason, why));
}

extern "C" bool site_read(site *out, const char *text, lux_error *err)
try {
    if (strnlen(text, LONGEST + 1) > LONGEST)
        return refuse(text, "too long", err);
    GeographicLib::GeoCoords place(text);
    double latitude = place.Latitude(), longitude = place.Longitude();
    if (!std::isfinite(latitude) || !std::isfinite(longitude)) // "nan nan", "INVALID"
        return refuse(text, "not a number", err);
    *out = { latitude, GeographicLib::Math::AngNormalize(longitude), 0.0 };
    return true;
} catch (const std::bad_alloc &) {
    return failed(err, ERR_MEMORY, "out of memory reading a place");
} catch (const std::exception &e) {
    return refuse(text, e.what(), err);
}
