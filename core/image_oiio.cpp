// core/image_oiio.cpp -- see image_oiio.h. The one file that includes OpenImageIO; becomes
// liblux4_oiio.so, which uses nothing of liblux4.
#include "core/image_oiio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace
{

constexpr int MOST_CHANNELS = 64;
constexpr int STRIP         = 64; // rows that are decoded at a time

constexpr int MOST_SIDE             = 32768; // pixels
constexpr OIIO::imagesize_t MOST_GB = 4;     // decoded, and as four floats a pixel

bool refuse(oiio_message *why, const std::string &text)
{
    std::snprintf(why->text, sizeof why->text, "%s", text.c_str());
    for (char *c = why->text; *c; c++) // OpenImageIO's may have several lines
        if (*c == '\n')
            *c = ' ';
    return false;
}

// Runs f, and makes whatever it throws a message.
template <typename F> bool guarded(oiio_message *why, F f)
{
    try {
        return f();
    } catch (const std::bad_alloc &) {
        return refuse(why, "out of memory");
    } catch (const std::exception &e) {
        return refuse(why, e.what());
    } catch (...) {
        return refuse(why, "OpenImageIO failed without a reason");
    }
}

bool encode(const oiio_picture &p, oiio_sink to, oiio_message *why)
{
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput stream(bytes);
    auto out = OIIO::ImageOutput::create(p.name);
    if (!out)
        return refuse(why, OIIO::geterror());
    if (!out->supports("ioproxy") || !out->set_ioproxy(&stream))
        return refuse(why, std::string("cannot write ") + out->format_name() +
                               " pictures: name it .png");
    OIIO::ImageSpec spec(p.width, p.height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    if (!out->open(p.name, spec) || !out->write_image(OIIO::TypeDesc::UINT8, p.rgb) ||
        !out->close())
        return refuse(why, out->geterror());
    if (!to.put(to.context, bytes.data(), bytes.size()))
        return refuse(why, "cannot be stored");
    return true;
}

// A name with the right ending for a picture in memory; empty if it is of no known kind.
std::string name_by_content(const oiio_source &s)
{
    struct kind {
        size_t at;
        std::string magic, name;
    };
    const kind kinds[] = {
        { 0, "\x89PNG\r\n\x1a\n", "memory.png" },
        { 0, "\xff\xd8\xff", "memory.jpg" },
        { 8, "WEBP", "memory.webp" },
        { 0, "#?", "memory.hdr" },
        { 0, "\x76\x2f\x31\x01", "memory.exr" },
        { 0, "BM", "memory.bmp" },
        { 0, "DDS ", "memory.dds" },
    };
    for (const kind &k : kinds)
        if (s.size >= k.at + k.magic.size() &&
            !std::memcmp(static_cast<const char *>(s.bytes) + k.at, k.magic.data(), k.magic.size()))
            return k.name;
    return {};
}

// IEC 61966-2-1 at 16 bits, which hold 8-bit values exactly.
std::vector<float> srgb_table()
{
    std::vector<float> table(65536);
    for (size_t i = 0; i < table.size(); i++) {
        double v = double(i) / 65535.0;
        table[i] = float(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    return table;
}

bool size_allowed(const OIIO::ImageSpec &s, oiio_message *why)
{
    if (s.deep || s.depth > 1)
        return refuse(why, "a flat picture was expected");
    if (s.width < 1 || s.height < 1 || s.width > MOST_SIDE || s.height > MOST_SIDE)
        return refuse(why, std::to_string(s.width) + " x " + std::to_string(s.height) +
                               " pixels, at most " + std::to_string(MOST_SIDE) +
                               " a side are read");
    const OIIO::imagesize_t rgba = OIIO::imagesize_t(s.width) * OIIO::imagesize_t(s.height) * 16;
    const OIIO::imagesize_t size = std::max(s.image_bytes(true), rgba);
    if (s.nchannels < 1 || s.nchannels > MOST_CHANNELS || size > MOST_GB << 30)
        return refuse(why, std::to_string(s.width) + " x " + std::to_string(s.height) +
                               " pixels are more than " + std::to_string(MOST_GB) + " GB, or " +
                               std::to_string(MOST_CHANNELS) + " channels, when decoded");
    return true;
}

// Which channels of a file are read, and as what.
struct choice {
    int first, count;
    int alpha;   // among them; -1: none
    bool decode; // integers, from sRGB, but for alpha
};

choice choose(const OIIO::ImageSpec &s, bool srgb)
{
    const bool integer = s.format == OIIO::TypeDesc::UINT8 || s.format == OIIO::TypeDesc::UINT16;
    const int count    = std::min(s.nchannels, 4);
    return choice{ 0, count, count % 2 == 0 ? count - 1 : -1, srgb && integer };
}

// R, G and B, side by side wherever they are, or the one of a grey picture.
bool choose_radiance(const OIIO::ImageSpec &s, bool srgb, choice *out, oiio_message *why)
{
    const int red   = s.channelindex("R");
    const bool rgb  = red >= 0 && s.channelindex("G") == red + 1 && s.channelindex("B") == red + 2;
    const bool grey = s.nchannels <= 2;
    if (!rgb && !grey) {
        std::string names;
        for (int c = 0; c < std::min(s.nchannels, 6); c++)
            names += " " + std::string(s.channel_name(c));
        return refuse(why, "its channels are" + names + ": R, G and B, or one alone, are expected");
    }
    if (s.x != s.full_x || s.y != s.full_y || s.width != s.full_width || s.height != s.full_height)
        return refuse(why, "it is a part of a picture of " + std::to_string(s.full_width) + " x " +
                               std::to_string(s.full_height) + " pixels: a whole one was expected");
    if (s.get_int_attribute("Orientation", 1) != 1)
        return refuse(why, "it lies turned or mirrored in its file: rows from the top, from left "
                           "to right, are expected");
    *out = choose(s, srgb);
    *out = { rgb ? red : 0, rgb ? 3 : 1, -1, out->decode };
    return true;
}

// Rows begin .. end - 1 of the channels chosen.
bool read_rows(OIIO::ImageInput &in, const OIIO::ImageSpec &s, int begin, int end, const choice &c,
               float *values)
{
    if (!s.tile_width)
        return in.read_scanlines(0, 0, s.y + begin, s.y + end, s.z, c.first, c.first + c.count,
                                 OIIO::TypeDesc::FLOAT, values);
    return in.read_tiles(0, 0, s.x, s.x + s.width, s.y + begin, s.y + end, s.z, s.z + 1, c.first,
                         c.first + c.count, OIIO::TypeDesc::FLOAT, values);
}

// Some rows, linear: of the channels chosen.
struct strip {
    int begin, rows, channels;
    const float *values;
};

std::string place_of(const OIIO::ImageSpec &s, const strip &rows, size_t i)
{
    const size_t pixel = i / size_t(rows.channels), width = size_t(s.width);
    return "column " + std::to_string(pixel % width) + " of row " +
           std::to_string(size_t(rows.begin) + pixel / width);
}

bool values_sound(const OIIO::ImageSpec &s, const strip &rows, oiio_message *why)
{
    const size_t count = size_t(s.width) * size_t(rows.rows) * size_t(rows.channels);
    for (size_t i = 0; i < count; i++) {
        if (!std::isfinite(rows.values[i]))
            return refuse(why,
                          "in " + place_of(s, rows, i) + " is a value that is no finite number");
    }
    return true;
}

// Hands all rows to `use`.
template <typename F>
bool each_strip(OIIO::ImageInput &in, const OIIO::ImageSpec &s, const choice &c, oiio_message *why,
                F use)
{
    static const std::vector<float> table = srgb_table();
    const int height                      = s.tile_width ? std::max(s.tile_height, 1) : STRIP;
    std::vector<float> values(size_t(s.width) * size_t(std::min(height, s.height)) *
                              size_t(c.count));
    for (int y = 0; y < s.height; y += height) {
        const strip rows = { y, std::min(height, s.height - y), c.count, values.data() };
        if (!read_rows(in, s, y, y + rows.rows, c, values.data()))
            return refuse(why, in.geterror());
        if (!values_sound(s, rows, why))
            return false;
        const size_t count = size_t(s.width) * size_t(rows.rows) * size_t(c.count);
        for (size_t i = 0; c.decode && i < count; i++)
            if (int(i % size_t(c.count)) != c.alpha)
                values[i] =
                    table[size_t(std::lround(std::clamp(values[i], 0.0f, 1.0f) * 65535.0f))];
        use(rows);
    }
    return true;
}

// Opens a picture of allowed size, for f.
template <typename F> bool with_picture(const oiio_source &from, oiio_message *why, F f)
{
    OIIO::Filesystem::IOMemReader memory(const_cast<void *>(from.bytes), from.size);
    const std::string name = from.bytes ? name_by_content(from) : from.name;
    if (name.empty())
        return refuse(why, "a picture of no known kind (PNG and JPEG are known)");
    OIIO::ImageSpec wish;
    wish.attribute("oiio:UnassociatedAlpha", 1); // colours as they were before alpha
    OIIO::Filesystem::IOProxy *stream = &memory;
    if (from.bytes) // PNG's reader looks here alone
        wish.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &stream);
    auto in = OIIO::ImageInput::open(name, &wish, from.bytes ? stream : nullptr);
    if (!in)
        return refuse(why, OIIO::geterror());
    const OIIO::ImageSpec s = in->spec();
    return size_allowed(s, why) && f(*in, s);
}

bool load(OIIO::ImageInput &in, const OIIO::ImageSpec &s, const oiio_source &from, oiio_place to,
          oiio_message *why)
{
    choice c = choose(s, from.srgb);
    if (from.radiance && !choose_radiance(s, from.srgb, &c, why))
        return false;
    float *rgba = to.make(to.context, s.width, s.height);
    if (!rgba)
        return refuse(why, "out of memory");
    const float opaque = from.radiance ? 0.0f : 1.0f;
    return each_strip(in, s, c, why, [&](const strip &rows) {
        const size_t channels = size_t(rows.channels);
        const size_t count    = size_t(s.width) * size_t(rows.rows);
        float *out            = rgba + size_t(rows.begin) * size_t(s.width) * 4;
        for (const float *p = rows.values; p < rows.values + count * channels; p += channels) {
            *out++ = p[0];
            *out++ = p[channels < 3 ? 0 : 1];
            *out++ = p[channels < 3 ? 0 : 2];
            *out++ = c.alpha >= 0 ? p[c.alpha] : opaque;
        }
    });
}

} // namespace

bool lux4_oiio_encode(const oiio_picture *picture, oiio_sink to, oiio_message *why)
{
    return guarded(why, [&] { return encode(*picture, to, why); });
}

bool lux4_oiio_load(const oiio_source *from, oiio_place to, oiio_message *why)
{
    return guarded(why, [&] {
        return with_picture(*from, why,
                            [&](auto &in, const auto &s) { return load(in, s, *from, to, why); });
    });
}
